"""How far does the load swing after the trolley has stopped, over the mass of the load and the length of the rope?"""

from pathlib import Path

import ancf14
import numpy as np
from ancf14 import Results


def swing(results: Results) -> np.float64:
    """The width of the swing after the trolley has stopped, m."""
    return np.ptp(results["load_motion.position[1]"][results.time > 3])


if __name__ == "__main__":
    model = ancf14.Model(Path(__file__).with_name("crane.toml"))
    study = model.sweep(
        {"payload": [200.0, 800.0], "length": np.linspace(1, 5, 9)},
        {"swing": swing, "pull": "pull.section_force:max"},
    )
    print(study["swing"].to_pandas().round(3).to_string())
    best = study["swing"].mean("payload").idxmin("length").item()
    print(f"the load swings least on a rope of {best:g} m")
