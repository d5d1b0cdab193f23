# %% [markdown]
"""How hard is the hook pulled? A particle filter: each particle is a saved state with a force of its own; those that fit the measured tip go on."""

# %%
import ancf14
import numpy as np

HOOK = """
format = 1
model = { name = "Hook", gravity = [0, 0, -9.81] }
material.steel = { young = 2.1e11, poisson = 0.3, density = 7850, damping = 1e-3 }
section.rod = { shape = "circle", radius = 0.005 }
beam.arm = { material = "steel", section = "rod", from = [0, 0, 0], to = [1, 0, 0], elements = 2 }
joint.root = { type = "weld", a = "ground", b = "arm.start" }
load.hook = { at = "arm.end", force = [0, 0, 0], input = true }
output.tip = { at = "arm.end", quantities = ["position"] }
simulation = { stop = 1, step = 5e-3 }
"""
STEP, STEPS, COUNT, NOISE = 0.02, 25, 60, 2e-3

# %%
if __name__ == "__main__":
    chance = np.random.default_rng(1)
    instance = ancf14.Model.from_string(HOOK).instance()
    instance.initialize()
    start = instance.state

    def ahead(state: ancf14.State, force: float) -> tuple[ancf14.State, float]:
        """The state a step later under a force, and the height of the tip there, m."""
        instance.state = state
        instance["hook.force[3]"] = -force
        instance.step(STEP)
        return instance.state, instance["tip.position[3]"]

    true, states, forces = start, [start] * COUNT, chance.uniform(5, 40, COUNT)
    for _ in range(STEPS):
        true, height = ahead(true, 22.0)
        measured = height + chance.normal(0, NOISE)
        moved = [ahead(state, force) for state, force in zip(states, forces, strict=True)]
        weights = np.exp(-(((np.array([tip for _, tip in moved]) - measured) / NOISE) ** 2) / 2) + 1e-300
        chosen = chance.choice(COUNT, COUNT, p=weights / weights.sum())
        states = [moved[k][0] for k in chosen]
        forces = forces[chosen] + chance.normal(0, 0.3, COUNT)
    print(f"the force is {forces.mean():.1f} N +- {forces.std():.1f} N")
