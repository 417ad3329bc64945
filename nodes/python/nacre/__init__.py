"""nacre: two-material microstructures that are stiff and tough, simulated and fitted to measurements.

Values are in SI units. Whoever knows the command line finds its commands here: what `nacre COMMAND --json` prints, the
functions return as dicts, with numpy arrays for curves and films.
"""

from ._nacre import *  # noqa: F403 - the names stand in __init__.pyi
from ._nacre import __version__  # noqa: F401
