"""The results of a study, point by point, and the dataset of all of them."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any

import numpy as np

from .._errors import CallError
from .._native import __version__
from .points import Points
from .reducers import Array, Reduced
from .settings import Found, Refinement
from .store import Store, fingerprint
from .told import grouped
from .work import Done, Recipe, expect_same

if TYPE_CHECKING:
    from .._model import Model

NOT_COMPUTED = "not computed"
"""The message of a point that a study has not come to."""


class Table:
    """What is known of each point, in memory and in the store."""

    def __init__(
        self, model: Model, points: Points, recipe: Recipe, refinement: Refinement, store: str | os.PathLike[str] | None
    ) -> None:
        self._model, self._points, self._outputs = model, points, recipe.outputs
        self._errors: list[str | None] = [None] * len(points)
        self._warnings = [""] * len(points)
        self._values: dict[str, Array] = {}
        self._times: Array | None = None
        self.found: Found | None = None
        """The steps and meshes of all points; None: they are to be found."""
        self._store = Store(store, fingerprint(recipe, points, refinement), points, recipe.outputs) if store is not None else None
        if self._store is not None:
            self._errors, self._warnings, self._values, self._times = self._store.read()
            self.found = self._store.found()
        self.count = sum(error is not None for error in self._errors)
        """The number of points that are known."""

    def keep(self, found: Found) -> None:
        """Take the steps and meshes of all points."""
        self.found = found
        if self._store is not None:
            self._store.keep(found)

    def missing(self) -> list[int]:
        """Return the numbers of the points that are not known."""
        return [number for number, error in enumerate(self._errors) if error is None]

    def remains(self) -> str:
        """Say how far the study is, and how it goes on."""
        known = f"{self.count} of {len(self._points)} points are known"
        if self._store is not None:
            return f"{known} and stand in {self._store.path}: the same call goes on from there"
        return f"{known}, in the attribute results; with `store=` a study goes on where it ended"

    def put(self, done: Done) -> None:
        """Take the runs of a chunk."""
        if done.times is not None:
            if self._times is None:
                self._times = done.times
            expect_same(self._times, done.times)
        for number, error, told, values in zip(done.numbers, done.errors, done.warnings, done.values, strict=True):
            self.count += self._errors[number] is None
            self._errors[number], self._warnings[number] = error, told
            for output, value in zip(self._outputs, values or [], strict=False):
                self._array(output, value)[number] = value
        if self._store is not None:
            self._store.write(done, self._times)

    def _array(self, output: Reduced, value: Array) -> Array:
        """Return the array of an output, with a value for each point, as large as the first value."""
        if output.name not in self._values:
            self._values[output.name] = np.full((len(self._points), *value.shape), np.nan)
        array = self._values[output.name]
        if array.shape[1:] != value.shape:
            raise CallError(
                f"`{output.name}` has the shape {value.shape} in one run and {array.shape[1:]} in another; a study needs one shape in all runs"
            )
        return array

    def dataset(self) -> Any:
        """Return the xarray.Dataset."""
        import xarray

        points, known = self._points, self._model.parameters
        coordinates: dict[str, Any] = {}
        for name, (dimension, values) in points.coordinates().items():
            about = {"units": known[name].unit, "long_name": known[name].description} if name in known else {}
            coordinates[name] = (dimension, values, about)
        variables: dict[str, Any] = {}
        for output in self._outputs:
            array = self._values.get(output.name, np.full(len(points), np.nan))
            inner = self._inner(output, array.shape[1:])
            variables[output.name] = ((*points.dimensions, *inner), array.reshape(*points.shape, *array.shape[1:]), self._about(output))
        if "axis" in {name for dimensions, *_ in variables.values() for name in dimensions}:
            coordinates["axis"] = ["x", "y", "z"]
        if self._times is not None:
            coordinates["time"] = ("time", self._times, {"units": "s"})
        errors = [NOT_COMPUTED if error is None else error for error in self._errors]
        for name, texts in (("error", errors), ("warning", self._warnings)):
            variables[name] = (points.dimensions, np.array(texts, dtype=object).reshape(points.shape))
        attributes: dict[str, Any] = {"model": self._model.name, "ancf14": __version__}
        if self.found is not None and self.found.settings:
            attributes["settings"] = ", ".join(f"{key} = {value}" for key, value in self.found.settings.items())
        if self.found is not None and self.found.accuracy:
            attributes["accuracy"] = self.found.accuracy
        if any(self._warnings):
            attributes["warnings"] = grouped(self._warnings, len(points))
        return xarray.Dataset(variables, coordinates, attributes)

    def _inner(self, output: Reduced, shape: tuple[int, ...]) -> list[str]:
        """Return the dimensions of one value."""
        names = ["time"] if output.is_series and shape else []
        rest = shape[len(names) :]
        return names + (["axis"] if rest == (3,) and output.column else [f"{output.name}_{k + 1}" for k in range(len(rest))])

    def _about(self, output: Reduced) -> dict[str, str]:
        """Return the unit and the meaning of an output, as far as they are known."""
        if output.column is None:
            return {}
        results = self._model.outputs
        own = results.get(output.column) or next(value for name, value in results.items() if name.startswith(f"{output.column}["))
        about = own.description if output.column in results else ""
        return {"units": own.unit, **({"long_name": about} if about else {})}
