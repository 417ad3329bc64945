# Types of the module; what functions take and return is told by their docstrings.
import os
from typing import Any, Callable, Dict, List, Optional, Sequence, Union, overload

import numpy as np
import numpy.typing as npt

__version__: str

Path = Union[str, "os.PathLike[str]"]
Design = Union[Path, npt.NDArray[Any]]
Parameters = Union[Path, Dict[str, Any], None]
Progress = Optional[Callable[[float, str], object]]

class InputError(ValueError): ...
class NoSpace(OSError): ...
class DatabaseUnavailable(OSError): ...

def pattern(pattern: Design) -> npt.NDArray[np.uint8]: ...
def key(pattern: Design) -> str: ...
def default_parameters() -> Dict[str, Dict[str, Any]]: ...
def read_parameters(params: Parameters) -> Dict[str, Dict[str, Any]]: ...
@overload
def simulate(
    patterns: Design,
    *,
    params: Parameters = ...,
    test: str = ...,
    fidelity: str = ...,
    specimens: int | None = ...,
    strength_cv: Optional[float] = ...,
    criterion: Optional[str] = ...,
    refine: int = ...,
    film: int = ...,
    progress: Progress = ...,
) -> Dict[str, Any]: ...
@overload
def simulate(
    patterns: Sequence[Design],
    *,
    params: Parameters = ...,
    test: str = ...,
    fidelity: str = ...,
    specimens: int | None = ...,
    strength_cv: Optional[float] = ...,
    criterion: Optional[str] = ...,
    refine: int = ...,
    film: int = ...,
    progress: Progress = ...,
) -> List[Dict[str, Any]]: ...
def read_film(path: Path) -> Dict[str, Any]: ...
def explore(
    *,
    params: Parameters = ...,
    algorithm: str = ...,
    budget: int = ...,
    fidelity: str = ...,
    seed: int = ...,
    population: int = ...,
    batch: int = ...,
    specimens: int = ...,
    out: Optional[Path] = ...,
    cache: Optional[Path] = ...,
    known: Optional[Path] = ...,
    former: Optional[Path] = ...,
    progress: Progress = ...,
) -> Dict[str, Any]: ...
def measure(
    patterns: Union[Design, Sequence[Design]],
    lab: Path,
    out: Path,
    *,
    test: str = ...,
    orientation: Union[int, str] = ...,
    progress: Progress = ...,
) -> Dict[str, Any]: ...
def calibrate(
    set: Path,
    *,
    start: Parameters = ...,
    ranges: Optional[Path] = ...,
    out: Optional[Path] = ...,
    fidelity: str = ...,
    begin_at: Optional[str] = ...,
    budget: int = ...,
    modulus_budget: int = ...,
    hold_out: int = ...,
    search: str = ...,
    searches: int = ...,
    ensemble: int = ...,
    discretisation_floor: Optional[Path] = ...,
    store: Optional[Path] = ...,
    seed: int = ...,
    progress: Progress = ...,
) -> Dict[str, Any]: ...
def diagnose(
    set: Path,
    *,
    params: Parameters = ...,
    ranges: Optional[Path] = ...,
    fidelity: str = ...,
    fracture: bool = ...,
    kept_emulator: bool = ...,
    search: int = ...,
    bootstraps: int = ...,
    discretisation_floor: Optional[Path] = ...,
    store: Optional[Path] = ...,
    seed: int = ...,
    progress: Progress = ...,
) -> Dict[str, Any]: ...
def read_run(run: Path) -> Dict[str, Any]: ...
