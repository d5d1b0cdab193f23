"""What a worker does: a chunk of runs of one model."""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from .. import _native
from .._errors import CallError, ModelError, raising
from .._names import Components
from .reducers import Array, Reduced

if TYPE_CHECKING:
    from .._model import Model


SLICE = 64
"""The solver runs so many points before their rows are reduced: all rows of a chunk might not fit into memory."""


@dataclass(frozen=True)
class Recipe:
    """All that the runs of a study have in common; it goes to the workers with every chunk."""

    model: Model
    outputs: list[Reduced]
    settings: dict[str, Any]
    """Keyword arguments of ``Model.run``."""
    found: dict[str, str] = field(default_factory=dict)
    """Steps and meshes of all points, as parameters of ``Model.run``; those of a point come before them."""

    def parameters(self, point: dict[str, Any]) -> dict[str, Any]:
        """Return the parameters of a point, before which the steps and meshes of the study step back."""
        given = [*point, *(key for key, _ in self.model._overrides)]
        found = {key: value for key, value in self.found.items() if not any(own == key or own.endswith("." + key) for own in given)}
        return {**found, **point}

    def fitting(self, point: dict[str, Any]) -> dict[str, Any]:
        """Return the parameters of a point without the meshes of beams that it lacks, as copies."""
        try:
            variables = self.model._open(self.model._changes(point)).variables()
        except ModelError:
            return self.parameters(point)
        meshed = {name.removesuffix(".elements") for name, *_ in variables if name.endswith(".elements")}
        own = self.parameters(point)
        lacks = [key for key in self.found if key not in point and not key.startswith("simulation.") and key.rpartition(".")[0] not in meshed]
        return {key: value for key, value in own.items() if key not in lacks}

    def is_plain(self) -> bool:
        """Return whether only columns are kept, of runs that are not repeated and have no inputs."""
        inputs, refine = self.settings.get("inputs"), self.settings.get("refine", False)
        return self.judged() is not None and not inputs and refine is False

    def judged(self) -> list[str] | None:
        """Return the results whose errors matter: those that are kept. None: all, as a function may read any."""
        columns = [output.column for output in self.outputs]
        return None if None in columns else [column for column in columns if column is not None]


@dataclass
class Done:
    """The runs of a chunk, in its order."""

    numbers: Sequence[int]
    """The numbers of their points."""
    seconds: float = 0.0
    """How long all of them took."""
    errors: list[str] = field(default_factory=list)
    """Why each failed; empty where it did not."""
    warnings: list[str] = field(default_factory=list)
    """The warnings of the solver in each, a line each."""
    values: list[list[Array] | None] = field(default_factory=list)
    """The wanted results of each, None where it failed."""
    times: Array | None = None
    """The times of the rows, if a whole series is wanted and a run has come to its end."""


def chunk(recipe: Recipe, numbers: Sequence[int], points: Sequence[dict[str, Any]]) -> Done:
    """Run the points of a chunk one after the other. A point that fails has its message; the others go on."""
    begin = time.perf_counter()
    done = Done(numbers)
    if recipe.is_plain():
        _run_all(recipe, points, done)
        done.seconds = time.perf_counter() - begin
        return done
    for parameters in points:
        told: list[str] = []
        values: list[Array] | None = None
        error = ""
        try:
            values = _run(recipe, parameters, done, told)
        except DifferentRows:
            raise
        except Exception as reason:
            error = str(reason) or type(reason).__name__
        done.errors.append(error)
        done.warnings.append("\n".join(told))
        done.values.append(values)
    done.seconds = time.perf_counter() - begin
    return done


class DifferentRows(CallError):
    """Two runs have different times, so that their series do not fit into one array."""


class _Columns:
    """The columns of a run that a study keeps."""

    def __init__(self, columns: dict[str, int], components: Components) -> None:
        self._columns, self._components = columns, components
        self.time: Array = np.empty(0)
        self._values: Array = np.empty((0, 0))

    def fill(self, times: bytes, values: bytes) -> None:
        """Take the rows of another run."""
        self.time = np.frombuffer(times)
        self._values = np.frombuffer(values).reshape(len(self.time), -1).T.copy()

    def __getitem__(self, name: str) -> Array:
        if name in self._columns:
            column: Array = self._values[self._columns[name]]
            return column
        return self._components.stack(name, self.__getitem__, (len(self.time),))


def _run_all(recipe: Recipe, points: Sequence[dict[str, Any]], done: Done) -> None:
    """Run all points in the solver, without a return to Python in between."""
    model = recipe.model
    components = Components(model.outputs)
    named = [output.column for output in recipe.outputs if output.column is not None]
    bases = [name for name in named if name not in model.outputs]
    own = [[name] if name in model.outputs else list(components.names(name).values()) for name in named]
    wanted = list(dict.fromkeys(name for names in own for name in names))
    shapes = [(base, len(components.names(base))) for base in dict.fromkeys(bases)]
    columns = _Columns({name: number for number, name in enumerate(wanted)}, components)
    ends = model._ends(recipe.settings.get("stop"), recipe.settings.get("output_step"))

    def run(parameters: Sequence[dict[str, Any]]) -> list[Any]:
        changes = [list(dict([*model._overrides, *model._changes(own), *ends]).items()) for own in parameters]
        with raising():
            return _native.study(model._source, changes, (wanted, shapes), recipe.judged() or [])

    for first in range(0, len(points), SLICE):
        own_points = points[first : first + SLICE]
        for point, found in zip(own_points, run([recipe.parameters(point) for point in own_points]), strict=True):
            if found[0] is not None and recipe.found:
                # Copies of the middle point may be missing here.
                fitting = recipe.fitting(point)
                if fitting != recipe.parameters(point):
                    (found,) = run([fitting])
            error, warnings, times, values = found
            done.errors.append(error or "")
            # Those about the file were issued when it was loaded.
            done.warnings.append("\n".join(warning for warning in warnings if warning not in model._notes))
            if error is not None:
                done.values.append(None)
                continue
            columns.fill(times, values)
            done.values.append([output.of(columns) for output in recipe.outputs])
            if any(output.is_series for output in recipe.outputs):
                if done.times is None:
                    done.times = columns.time.copy()
                expect_same(done.times, columns.time)


def _run(recipe: Recipe, parameters: dict[str, Any], done: Done, told: list[str]) -> list[Array]:
    """Run one point; collects what the solver warns of in ``told``."""
    try:
        results = recipe.model._run(recipe.parameters(parameters), told=told, judged=recipe.judged(), **recipe.settings)
    except ModelError:
        fitting = recipe.fitting(parameters) if recipe.found else {}
        if not fitting or fitting == recipe.parameters(parameters):
            raise
        results = recipe.model._run(fitting, told=told, judged=recipe.judged(), **recipe.settings)
    values = [output.of(results) for output in recipe.outputs]
    if any(output.is_series for output in recipe.outputs):
        if done.times is None:
            done.times = results.time
        expect_same(done.times, results.time)
    return values


def expect_same(times: Array, other: Array) -> None:
    """Raise DifferentRows unless two series have the same times."""
    if not np.array_equal(times, other):
        raise DifferentRows(
            f"one run has {len(other)} rows up to t = {other[-1]:g} s, another one has {len(times)} up to {times[-1]:g} s; whole series need "
            "the same `stop` and `output_step` in all runs: keep numbers instead, as `:max`"
        )
