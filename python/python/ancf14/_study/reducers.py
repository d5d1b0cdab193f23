"""Reducers: what a study keeps of the results of a run."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from typing import Any, Protocol, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .._errors import CallError, VariableError
from .._names import Components
from .._results import Results

Array = NDArray[np.float64]

Outputs: TypeAlias = "Iterable[str] | Mapping[str, str | Callable[[Results], ArrayLike]]"
"""Names of results such as ``tip.displacement[3]:max``, or a name of one's own for each of them or for a function of the results."""

REDUCERS: dict[str, Callable[[Array], Any]] = {
    "first": lambda series: series[0],
    "last": lambda series: series[-1],
    "min": lambda series: series.min(axis=0),
    "max": lambda series: series.max(axis=0),
    "mean": lambda series: series.mean(axis=0),
    "rms": lambda series: np.sqrt(np.mean(np.square(series), axis=0)),
}
"""What is made of the rows of a column or a vector; ``rms`` and ``mean`` count each row once."""


class Columns(Protocol):
    """The columns of a run."""

    def __getitem__(self, name: str, /) -> Array:
        """Return a column, or an array of all components of a vector or a table."""
        ...


@dataclass(frozen=True)
class Reduced:
    """One result of a study."""

    name: str
    """Its name in the dataset."""
    column: str | None
    """The column or the vector that it is made from; None for a function of all results."""
    how: str | Callable[[Results], ArrayLike]
    """The reducer; empty for the whole series."""

    @property
    def is_series(self) -> bool:
        """Whether it has a value for each row of results."""
        return self.how == ""

    def of(self, results: Results | Columns) -> Array:
        """Return the value for a run."""
        if callable(self.how):
            assert isinstance(results, Results)
            return np.asarray(self.how(results), dtype=float)
        assert self.column is not None
        series = results[self.column]
        return np.asarray(REDUCERS[self.how](series) if self.how else series, dtype=float)


def reduced(outputs: Outputs, columns: Iterable[str]) -> list[Reduced]:
    """Return the wanted results of a model with these columns; a word that is no column or no reducer is told at once."""
    known = list(columns)
    components = Components(known)
    if isinstance(outputs, str):
        outputs = [outputs]
    named = outputs.items() if isinstance(outputs, Mapping) else ((str(output), output) for output in outputs)
    found = [_one(name, output, known, components) for name, output in named]
    if not found:
        raise CallError("there is nothing to keep; name at least one output, as `tip.displacement[3]:max`")
    names = [one.name for one in found]
    for name in names:
        if names.count(name) > 1 or name in ("error", "warning"):
            raise CallError(f"two results of the study would have the name `{name}`; give them names: {{'a': ..., 'b': ...}}")
    return found


def _one(name: str, output: Any, columns: list[str], components: Components) -> Reduced:
    if callable(output):
        return Reduced(name, None, output)
    if not isinstance(output, str):
        raise CallError(f"{output!r} is no output; give a name such as `tip.displacement[3]:max` or a function of the results")
    column, _, how = output.partition(":")
    if column not in columns and column not in components:
        inside = {own for base in components for own in components.names(base).values()}
        known = ", ".join([*components, *(own for own in columns if own not in inside)])
        raise VariableError(f"the model has no output `{column}`; its outputs are: {known}")
    if how and how not in REDUCERS:
        raise CallError(f"`{output}`: there is no reducer `{how}`; the reducers are {', '.join(REDUCERS)}, and none for the whole series")
    return Reduced(name, column, how)
