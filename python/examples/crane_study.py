# %% [markdown]
"""How far does the load swing after the trolley has stopped, over the mass of the load and the length of the rope?"""

# %%
import ancf14
import numpy as np
from ancf14 import Results


def swing(results: Results) -> np.float64:
    """The width of the swing after the trolley has stopped, m."""
    return np.ptp(results["load_motion.position[1]"][results.time > 3])


# %%
model = ancf14.Model("crane.toml")
study = model.sweep(
    {"payload": [200.0, 800.0], "length": np.linspace(1, 5, 9)},
    {"swing": swing, "pull": "pull.section_force[1]:max"},
)
print(study["swing"].to_pandas().round(3).to_string())

# %%
best = study["swing"].mean("payload").idxmin("length").item()
print(f"the load swings least on a rope of {best:g} m")

# %%
model.run({"payload": 800.0, "length": best}).view("crane_study.html")
