# %% [markdown]
"""A controller in the loop: it moves the trolley so that the load does not swing."""

# %%
from pathlib import Path

import ancf14
import numpy as np

STEP = 0.02
FILE = Path("crane.toml")


def travel(damping: float) -> float:
    """The width of the swing of the load in the last two seconds, m, if a swing moves the trolley after it with the gain ``damping``."""
    text = FILE.read_text().replace('position = ["2*smoothstep(0, 3, t)", 0, 0]', "position = [0, 0, 0]\ninput = true")
    instance = ancf14.Model.from_string(text).instance()
    instance.initialize()
    place, swings = 0.0, []
    for k in range(round(8 / STEP)):
        time = k * STEP
        wanted, speed = 2 * min(time / 3, 1), 2 / 3 if time < 3 else 0
        ahead = instance["load_motion.position[1]"] - place
        place += STEP * (speed + 0.3 * (wanted - place) + damping * ahead)
        instance["trolley.position[1]"] = place
        instance.step(STEP)
        swings.append(instance["load_motion.position[1]"] - place)
    return float(np.ptp(swings[-round(2 / STEP) :]))


# %%
if __name__ == "__main__":
    for damping in (0.0, 1.0):
        print(f"gain {damping:g}: the load swings by {travel(damping):.3f} m")
