"""The steps and meshes of a study: those with which the point in its middle is accurate."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Literal, TypeAlias

from .._errors import Error
from .points import Points
from .work import Recipe

Refinement: TypeAlias = 'tuple[bool | Literal["each"] | None, float | None]'
"""Whether the steps and meshes are found, as ``Model.sweep`` says, and the bound of the cost."""


@dataclass(frozen=True)
class Found:
    """The numbers of all points of a study."""

    settings: dict[str, str] = field(default_factory=dict)
    """Changes of the model file by key."""
    accuracy: str = ""
    """How they were found, a line."""
    warning: str = ""
    """The results that are not accurate all the same."""


def find(recipe: Recipe, points: Points, refinement: Refinement) -> Found:
    """Run the point in the middle until the results that are kept are accurate; where it fails or is at rest, the first or the last one."""
    refine, budget = refinement
    if refine is False or refine == "each":
        return Found()
    found = Found()
    for number in dict.fromkeys((points.middle(), 0, len(points) - 1)):
        parameters = points.parameters(number)
        try:
            # Otherwise the run would find nothing.
            if refine is None and not recipe.model._open(recipe.model._changes(parameters)).is_repeated():
                return found
            results = recipe.model._run(
                parameters, told=[], judged=recipe.judged(), mesh_error=True, refine=refine, budget=budget, **recipe.settings
            )
        except Error:
            # The study has its message.
            continue
        if results._found is None:
            return found
        found = Found(results.settings, results.accuracy, results._found[2] or "")
        if not found.accuracy.endswith("nothing to judge"):
            return found
    return found
