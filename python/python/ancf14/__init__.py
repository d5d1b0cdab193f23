"""Flexible beams, cables, shafts and springs: a solver for ANCF14 beams.

    import ancf14
    results = ancf14.Model("cantilever.toml").run({"strip.height": 0.005}, stop=2)
    results.time, results["tip.displacement"]

All numbers are in SI units and radians.
"""

from ._campbell import Campbell, CriticalSpeed
from ._errors import CallError, Error, Interrupted, ModelError, RunError, SolverWarning, VariableError
from ._instance import Instance, State
from ._linear import Linearization
from ._model import Model, Picture, Variable
from ._modes import Modes
from ._native import __version__
from ._results import Page, Range, Results

__all__ = [
    "CallError",
    "Campbell",
    "CriticalSpeed",
    "Error",
    "Instance",
    "Interrupted",
    "Linearization",
    "Model",
    "ModelError",
    "Modes",
    "Page",
    "Picture",
    "Range",
    "Results",
    "RunError",
    "SolverWarning",
    "State",
    "Variable",
    "VariableError",
    "__version__",
]
