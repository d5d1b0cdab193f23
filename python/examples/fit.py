# %% [markdown]
"""Young's modulus and damping of a beam from the record of its tip, by least squares."""

# %%
import ancf14
import numpy as np
from numpy.typing import NDArray
from scipy.optimize import least_squares

PLUCKED = """
format = 1
model = { name = "Plucked" }
parameters = { young = 70e9, damping = 1e-3 }
material.alloy = { young = "young", poisson = 0.33, density = 2700, damping = "damping" }
section.flat = { shape = "rectangle", width = 0.02, height = 0.004 }
beam.arm = { material = "alloy", section = "flat", from = [0, 0, 0], to = [0.5, 0, 0], elements = 3 }
joint.root = { type = "weld", a = "ground", b = "arm.start" }
load.pluck = { at = "arm.end", force = [0, 0, "if(t < 0.02, 5, 0)"] }
output.tip = { at = "arm.end", quantities = ["displacement"] }
simulation = { stop = 0.4, step = 1e-3, output_step = 2e-3 }
"""
MODEL = ancf14.Model.from_string(PLUCKED)


def motion(young: float, damping: float) -> NDArray[np.float64]:
    """The height of the tip over time, m."""
    return MODEL.run({"young": young, "damping": damping})["tip.displacement[3]"]


# %%
if __name__ == "__main__":
    noise = np.random.default_rng(1).normal(0, 2e-4, 201)
    record = motion(72.5e9, 8e-4) + noise
    # The logarithms are of one size.
    fit = least_squares(lambda x: motion(*np.exp(x)) - record, np.log([70e9, 1.5e-3]), diff_step=1e-4)
    young, damping = np.exp(fit.x)
    deviation = np.sqrt(np.diag(np.linalg.inv(fit.jac.T @ fit.jac)) * 2 * fit.cost / (len(record) - 2))
    print(f"Young's modulus {young / 1e9:.2f} GPa +- {100 * deviation[0]:.2f} %, damping {damping:.2e} s +- {100 * deviation[1]:.1f} %")
