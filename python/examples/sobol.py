# %% [markdown]
"""Which dimension of a blade decides about its first frequency? Sobol indices by SALib."""

# %%
import ancf14
import numpy as np
from SALib.analyze import sobol as indices
from SALib.sample import sobol as sampling

BLADE = """
format = 1
model = { name = "Blade" }
parameters = { length = 1.0, width = 0.05, height = 0.005, young = 70e9 }
material.aluminium = { young = "young", poisson = 0.33, density = 2700 }
section.flat = { shape = "rectangle", width = "width", height = "height" }
beam.blade = { material = "aluminium", section = "flat", from = [0, 0, 0], to = ["length", 0, 0], elements = 6 }
joint.root = { type = "weld", a = "ground", b = "blade.start" }
simulation = { stop = 1 }
"""
BOUNDS = {"length": [0.95, 1.05], "width": [0.045, 0.055], "height": [0.0045, 0.0055], "young": [68e9, 72e9]}
PROBLEM = {"num_vars": len(BOUNDS), "names": list(BOUNDS), "bounds": list(BOUNDS.values())}

# %%
if __name__ == "__main__":
    model = ancf14.Model.from_string(BLADE)
    points = sampling.sample(PROBLEM, 128, seed=1)
    frequency = [model.modes(1, dict(zip(BOUNDS, point, strict=True))).frequency[0] for point in points]
    found = indices.analyze(PROBLEM, np.array(frequency), seed=1)
    for name, share in zip(BOUNDS, found["S1"], strict=True):
        print(f"{name:8} {share:6.3f}")
