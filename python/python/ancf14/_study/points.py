"""The points of a study: a grid of values, or a list of samples."""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, TypeAlias

from .._errors import CallError

Space: TypeAlias = "Mapping[str, Any] | Iterable[Mapping[str, Any]]"
"""Values by parameter, of which all combinations are computed, or the parameters of each run; a table of pandas is a list of runs."""

POINT = "point"
"""The dimension of a list of samples, and of what a store has."""


@dataclass(frozen=True)
class Points:
    """The parameters of all runs, in order."""

    names: list[str]
    values: list[tuple[Any, ...]]
    """The values of each run, in the order of the names."""
    axes: dict[str, list[Any]] | None
    """The values along each dimension of a grid, the last of which runs fastest; None for samples."""

    def __len__(self) -> int:
        return len(self.values)

    def middle(self) -> int:
        """Return the number of the run in the middle: of a grid, in the middle of each dimension."""
        number = 0
        for count in self.shape:
            number = number * count + count // 2
        return number

    def parameters(self, number: int) -> dict[str, Any]:
        """Return the changed parameters of a run."""
        return dict(zip(self.names, self.values[number], strict=True))

    @property
    def shape(self) -> tuple[int, ...]:
        """The number of values along each dimension."""
        return (len(self),) if self.axes is None else tuple(len(axis) for axis in self.axes.values())

    @property
    def dimensions(self) -> tuple[str, ...]:
        """The name of each dimension."""
        return (POINT,) if self.axes is None else tuple(self.axes)

    def coordinates(self) -> dict[str, tuple[str, list[Any]]]:
        """Return the dimension and the values of each parameter along it, lists as text."""
        if self.axes is not None:
            return {name: (name, [_label(value) for value in axis]) for name, axis in self.axes.items()}
        columns = zip(*self.values, strict=True)
        return {name: (POINT, [_label(value) for value in column]) for name, column in zip(self.names, columns, strict=True)}


def points(space: Space) -> Points:
    """Return the points of a grid or of a list of samples."""
    rows = _rows(space)
    if rows is None:
        assert isinstance(space, Mapping)
        axes = {name: _axis(name, values) for name, values in space.items()}
        found = Points(list(axes), list(itertools.product(*axes.values())), axes)
    else:
        names = list(rows[0]) if rows else []
        for number, row in enumerate(rows):
            if set(row) != set(names):
                raise CallError(f"sample {number} has the parameters {sorted(row)}, the first one has {sorted(names)}; give all the same")
        found = Points(names, [tuple(row[name] for name in names) for row in rows], None)
    if not found.names or not len(found):
        raise CallError("there is nothing to compute; give at least one parameter and one value of it")
    for name in found.names:
        if name in (POINT, "time", "axis", "error", "warning"):
            raise CallError(f"the parameter `{name}` has the name of a dimension or a result of the study; rename it in the model file")
    return found


def _rows(space: Space) -> list[dict[str, Any]] | None:
    """Return the samples as a list, or None for a grid."""
    if hasattr(space, "to_dict") and hasattr(space, "columns"):
        return list(space.to_dict("records"))
    if isinstance(space, Mapping):
        return None
    rows = list(space)
    if not all(isinstance(row, Mapping) for row in rows):
        raise CallError("a study needs a mapping of values by parameter, a list of mappings, or a table of pandas")
    return [dict(row) for row in rows]


def _axis(name: str, values: Iterable[Any]) -> list[Any]:
    if isinstance(values, str) or not isinstance(values, Iterable):
        raise CallError(f"the values of `{name}` must be a list or an array, {values!r} is one value: give [{values!r}]")
    axis = list(values)
    labels = [_label(value) for value in axis]
    if len(set(labels)) < len(labels):
        raise CallError(f"a value of `{name}` occurs twice in the grid; give each value once")
    return axis


def _label(value: Any) -> Any:
    """Return a value as a coordinate: a list, such as a force, has its text."""
    is_list = isinstance(value, Sequence) and not isinstance(value, str) or getattr(value, "ndim", 0) > 0
    return str(list(value)) if is_list else value
