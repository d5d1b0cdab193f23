# %% [markdown]
"""Campbell's diagram of a shaft, and the speed from which the damping of its material makes it whirl."""

# %%
from pathlib import Path

import ancf14
import numpy as np

MODEL = ancf14.Model(Path("../../models/rotating_shaft.toml"))
SPEEDS = np.arange(0, 121, 5)


def diagram(air: float) -> ancf14.Campbell:
    """Frequencies and damping by speed, with the damping ``air`` in proportion to the mass of the shaft, 1/s, and a disk without unbalance."""
    changes = {"body.disk.position[3]": 0.0, "material.steel.damping": 1e-4, "material.steel.mass_damping": air}
    return MODEL.campbell("run_up", SPEEDS, parameters=changes, without_gravity=True)


# %% [markdown]
# The material turns with the shaft, and beyond the critical speed its damping drives the forward whirl. The air stands still, and its damping holds the whirl.
# With the damping ratios of both at rest, the whirl begins at the critical speed times `1 + air/material`.

# %%
if __name__ == "__main__":
    material, both = diagram(0.0), diagram(1.0)
    both.save("whirl.svg")
    critical = next(own.speed for own in material.critical_speeds if own.direction == "forward")
    inside, whole = material.damping[0, 1], both.damping[0, 1]
    expected = critical * whole / inside
    print(f"critical speed {critical:.3f} rad/s")
    print(f"without air, the shaft whirls from {material.stability_limit:.3f} rad/s on")
    print(f"with air, from {both.stability_limit:.2f} rad/s on; the damping ratios tell {expected:.2f} rad/s")
