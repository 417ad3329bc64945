# %% [markdown]
# nacre in a notebook: a front and a film. Each `# %%` begins a cell, in Jupyter (by jupytext), VS Code or Spyder.
# `PYTHONPATH=build/python python3 examples/notebook.py` runs it too. Needs numpy and, for the pictures, matplotlib.

# %%
import sys

import nacre
import numpy as np

try:
    import matplotlib.pyplot as plt
except ImportError:
    plt = None
fidelity = sys.argv[1] if len(sys.argv) > 1 and sys.argv[1] in ("full", "fine", "preview", "tiny") else "preview"

# %% [markdown]
# A search: which patterns are stiff and tough? 60 simulations, a minute on two cores.

# %%
gamut = nacre.explore(budget=60, fidelity=fidelity, progress=lambda share, step: print(f"\r{step} {share:.0%}", end=""))
front = gamut["is_on_front"]
print(f"\n{front.sum()} of {gamut['evaluated']} patterns are on the front")
for key, modulus, toughness in zip(
    gamut["pattern"][front], gamut["modulus_pa"][front], gamut["toughness_pa"][front]
):
    print(f"{key}  E {modulus / 1e9:.3f} GPa  T {toughness / 1e6:.3f} MPa")

# %%
if plt is not None:
    plt.scatter(gamut["modulus_pa"] / 1e9, gamut["toughness_pa"] / 1e6, c=np.where(front, "tab:red", "tab:gray"))
    plt.xlabel("E / GPa")
    plt.ylabel("T / MPa")
    plt.show()

# %% [markdown]
# The toughest pattern of the front breaks: its curve, and how far the crack is at a few moments.

# %%
toughest = gamut["pattern"][gamut["toughness_pa"].argmax()]
broken = nacre.simulate(toughest, fidelity=fidelity, film=24)
film = broken["film"]
print(f"{toughest} fails at {100 * film['failure_strain']:.2f} % strain, {film['broken'][-1]} elements have failed")
for frame in range(0, 24, 6):
    print(f"{100 * film['strain'][frame]:6.2f} %  {film['stress_pa'][frame] / 1e6:6.2f} MPa  {film['broken'][frame]}")

# %%
if plt is not None:
    curve = broken["curves"][0]
    plt.plot(100 * curve["strain"], curve["stress_pa"] / 1e6)
    plt.xlabel("strain / %")
    plt.ylabel("stress / MPa")
    plt.show()
    for frame in range(0, 24, 6):
        energy = film["energy_j_per_m3"][frame].copy()
        energy.flat[film["breaks"]["element"][: film["broken"][frame]]] = np.nan
        plt.imshow(energy, origin="lower")
        plt.title(f"{100 * film['strain'][frame]:.2f} %")
        plt.show()
