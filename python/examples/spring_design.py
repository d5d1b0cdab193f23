# %% [markdown]
"""The lightest helical spring of a stiffness: wire and coil by optimization, on the model of the shipped example."""

# %%
import ancf14
import numpy as np
from scipy.optimize import minimize

MODEL = ancf14.Model("../../models/helical_spring.toml", {"coil.elements": 24})
STIFFNESS, STRESS, PULL = 400.0, 6e8, 0.01


def answers(wire: float, coil: float) -> tuple[float, float]:
    """Stiffness, N/m, and the largest stress, Pa, of a spring with these radii, m."""
    results = MODEL.run({"wire.radius": wire, "radius": coil, "pull": PULL}, output_step=1.0)
    return results["puller_force.effort"][-1] / PULL, results["middle.stress"].max()


def mass(wire: float, coil: float) -> float:
    """The mass of two turns, about, kg."""
    return 7850 * np.pi * wire**2 * 2 * 2 * np.pi * coil


# %%
if __name__ == "__main__":
    limits = [
        {"type": "eq", "fun": lambda x: answers(*(x * 1e-3))[0] / STIFFNESS - 1},
        {"type": "ineq", "fun": lambda x: 1 - answers(*(x * 1e-3))[1] / STRESS},
    ]
    found = minimize(lambda x: 1e2 * mass(*(x * 1e-3)), [1.0, 20.0], method="SLSQP", bounds=[(0.5, 2), (8, 40)], constraints=limits, options={"eps": 1e-4})
    stiffness, stress = answers(*(found.x * 1e-3))
    print(f"wire {found.x[0]:.2f} mm, coil {found.x[1]:.1f} mm: {stiffness:.0f} N/m, {stress / 1e6:.0f} MPa, {1e3 * mass(*(found.x * 1e-3)):.1f} g")
