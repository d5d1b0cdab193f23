"""A model: its variables, runs, modes, drawing and FMU."""

from __future__ import annotations

import functools
import os
import warnings
from collections.abc import Callable, Iterable, Mapping, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _native
from ._campbell import Campbell
from ._errors import CallError, Interrupted, ModelError, RunError, SolverWarning, VariableError, error_of, raising, warn
from ._linear import Linearization
from ._modes import Modes
from ._names import Components
from ._results import Range, Results
from ._source import Source
from ._study import sweep
from ._study.points import Space
from ._study.reducers import Outputs
from ._study.sweep import Progress
from ._instance import Instance

Value: TypeAlias = "float | int | bool | str | np.number[Any] | Sequence[float | int | str]"
"""A number, a word or an expression of a model file, or a list of them."""

Parameters: TypeAlias = Mapping[str, Value]
"""Changes of a model file by key, as those of ``--set`` of the command line."""

Inputs: TypeAlias = "Mapping[str, Callable[[float], ArrayLike] | ArrayLike]"
"""Values of inputs: a constant, an array with one entry per row of results, or a function of time in s."""


@dataclass(frozen=True)
class Variable:
    """A variable of a model."""

    name: str
    value: float | None
    """The value in ``unit``; None for results."""
    unit: str
    """The SI unit, as ``m``, ``N.m`` or ``rad/s``; empty if the variable has none."""
    description: str
    kind: str
    """``parameter``, ``tunable`` (it can also be set between two steps), ``calculated``, ``input`` or ``output``."""
    bounds: tuple[float | None, float | None]
    """The smallest and the largest possible value, in ``unit``; None where there is no bound."""


class Picture:
    """A drawing, which notebooks show."""

    def __init__(self, svg: str) -> None:
        self.svg = svg
        """The text of the picture."""

    def _repr_svg_(self) -> str:
        return self.svg


def _text(value: Value) -> str:
    """Return a value as a model file writes it."""
    match value:
        case bool() | np.bool_():
            return "true" if value else "false"
        case str():
            return value
        case int() | np.integer():
            return str(int(value))
        case float() | np.floating():
            return repr(float(value))
    if isinstance(value, Iterable):
        entries = [f'"{entry}"' if isinstance(entry, str) else _text(entry) for entry in value]
        return f"[{', '.join(entries)}]"
    raise TypeError(f"{value!r} is not a value of a model file; give a number, a string or a list of them")


class Model:
    """A model file.

    ``parameters`` changes numbers and words of the file by key, as ``--set`` of the command line does:
    ``Model("crane.toml", {"boom.elements": 12})``.

    The files that the model includes, and the tables of its functions, lie in its folder or below. ``allow_outside=True`` lets it read files elsewhere; only for a model that you trust.

    Raises ModelError if the file has mistakes; the message underlines each of them.
    """

    def __init__(
        self, file: str | os.PathLike[str], parameters: Parameters | None = None, *, allow_outside: bool = False
    ) -> None:
        try:
            # The bytes as they are: their ends of lines count in the GUID of an FMU.
            with open(file, encoding="utf-8", newline="") as opened:
                text = opened.read()
        except (OSError, UnicodeDecodeError) as reason:
            raise ModelError(f"cannot read {os.fspath(file)}: {reason}") from None
        folder = os.path.dirname(os.path.abspath(file))
        self._load(Source(os.fspath(file), text, folder, allow_outside), parameters)

    @classmethod
    def from_string(cls, text: str, parameters: Parameters | None = None, *, name: str = "model.toml") -> Model:
        """Load a model from its text; messages call it ``name``."""
        model = cls.__new__(cls)
        model._load(Source(name, text, None, False), parameters)
        return model

    def _load(self, source: Source, parameters: Parameters | None) -> None:
        self._source = source
        self._overrides = [(key, _text(value)) for key, value in (parameters or {}).items()]
        simulation = self._open()
        self.name = simulation.name()
        """The name of the model."""
        kinds: dict[str, dict[str, Variable]] = {"parameter": {}, "input": {}, "output": {}}
        for own, unit, description, kind, value, bounds, _ in simulation.variables():
            variable = Variable(own, value, unit, description, kind, bounds)
            kinds[kind if kind in kinds else "parameter"][own] = variable
        self.parameters: dict[str, Variable] = kinds["parameter"]
        """The numbers of the model file by name."""
        self.inputs: dict[str, Variable] = kinds["input"]
        """The numbers that a program gives during a run, by name."""
        self.outputs: dict[str, Variable] = kinds["output"]
        """The results by name, a column of results.csv each."""
        self._notes = simulation.take_warnings()
        warn(self._notes)

    def __repr__(self) -> str:
        count = f"{len(self.parameters)} parameters, {len(self.inputs)} inputs, {len(self.outputs)} outputs"
        return f"<ancf14.Model {self.name!r}: {count}>"

    def __reduce__(self) -> tuple[Any, ...]:
        return _loaded, (self._source, self._overrides)

    def _open(self, changes: Sequence[tuple[str, str]] = ()) -> _native.Simulation:
        changed = dict([*self._overrides, *changes])
        with raising():
            return self._source.load(list(changed.items()))

    def run(
        self,
        parameters: Parameters | None = None,
        *,
        stop: float | None = None,
        output_step: float | None = None,
        inputs: Inputs | None = None,
        mesh_error: bool = True,
        refine: bool | None = None,
        budget: float | None = None,
    ) -> Results:
        """Simulate, and return the results of all outputs; their bits are those of ``ancf14 run``.

        ``parameters`` changes the model file by key, as ``--set`` does. ``stop`` is the end of the run and ``output_step`` the
        time between two rows of results, both in s; the defaults are those of the model file.

        ``inputs`` gives values to inputs, in their SI units: a constant, an array with an entry for each row of results, or a
        function of the time in s. ``foot.position`` names the three components of a vector at once: a constant of shape
        ``(3,)``, an array of shape ``(rows, 3)``. The value at a row acts until the next row.

        Other threads of Python can work during the run. Ctrl-C stops the run and raises Interrupted, whose ``results`` has the
        rows so far. A step that cannot be computed raises RunError, also with ``results``. Warnings of the solver are issued as
        SolverWarning, among them those about errors of the steps and of the mesh that are larger than a reader expects. For the
        mesh error of a motion the model runs once more on a second thread, with half the elements: ``mesh_error=False`` leaves that
        out.

        Where the model file leaves the steps or the elements of a beam to the program, and the results are not accurate to 0.5 % of their range, the
        model runs again with finer steps and meshes, as by ``ancf14 run``: ``budget`` is what these runs may cost together, over the cost of
        the first one (by default 20, and half a minute in any case). ``refine=True`` also does so where the file has an ``accuracy``; ``refine=False`` runs once. ``Results.settings`` has the numbers that were found.
        """
        told: list[str] = []
        try:
            return self._run(parameters, stop=stop, output_step=output_step, inputs=inputs, told=told, mesh_error=mesh_error, refine=refine, budget=budget)
        finally:
            warn(told)

    @staticmethod
    def _changes(parameters: Parameters | None) -> list[tuple[str, str]]:
        return [(key, _text(value)) for key, value in (parameters or {}).items()]

    @staticmethod
    def _ends(stop: float | None, output_step: float | None) -> list[tuple[str, str]]:
        """Return the changes by the end of a run and the time between its rows."""
        given = (("simulation.stop", stop), ("simulation.output_step", output_step))
        return [(key, _text(float(value))) for key, value in given if value is not None]

    def _run(
        self,
        parameters: Parameters | None,
        *,
        stop: float | None,
        output_step: float | None,
        inputs: Inputs | None,
        told: list[str],
        mesh_error: bool = False,
        judged: Sequence[str] | None = None,
        refine: bool | None = False,
        budget: float | None = None,
    ) -> Results:
        """Simulate; the warnings go to ``told``, those about errors only of the results ``judged``, if given. With ``mesh_error`` a second run beside a motion, with half the elements, tells the mesh error."""
        changes = self._changes(parameters) + self._ends(stop, output_step)
        simulation = self._open(changes)
        if mesh_error:
            simulation.ask_for_mesh_error()
        if judged is not None:
            simulation.judge_only(judged)
        with raising():
            times = simulation.times() if inputs else []
        names, values = self._table(inputs or {}, times)
        overrides = list(dict([*self._overrides, *changes]).items())
        with raising():
            variables = simulation.variables()
            times_found, table, warnings, error, _, ranges, found = simulation.run(names, values, refinement=(refine, budget))
        rerun = (self._source, overrides, names, values, mesh_error, (False, None) if found is None else (refine, budget))
        results = Results._of(self.name, variables, times_found, table, rerun)
        results.ranges = {row[0]: Range._of(row) for row in ranges}
        if found is not None:
            results.settings, results.accuracy = dict(found[0]), found[1]
            results._found = found
        # Those about the file were issued when it was loaded.
        told += [warning for warning in warnings if warning not in self._notes]
        if error is None:
            return results
        if isinstance(error, KeyboardInterrupt):
            reached = f"the rows up to t = {results.time[-1]:g} s are" if len(results.time) else "no row is"
            raise Interrupted(f"the run was interrupted; {reached} in the attribute results", results) from None
        if not isinstance(error, _native.Refusal):
            raise error
        public = error_of(error)
        if isinstance(public, RunError):
            public.results = results
        raise public

    def _table(self, inputs: Inputs, times: list[float]) -> tuple[list[str], list[float]]:
        """Return the names of the driven inputs and their values, row by row."""
        components = Components(self.inputs)
        names: list[str] = []
        columns: list[NDArray[np.float64]] = []
        for name, given in inputs.items():
            if name in self.inputs:
                shape: tuple[int, ...] = ()
                own = [name]
            elif name in components:
                shape, own = components.shape(name), list(components.names(name).values())
            else:
                known = ", ".join([*components, *self.inputs]) or "none"
                raise VariableError(f"the model has no input `{name}`; its inputs are: {known}")
            values = np.array([given(time) for time in times] if callable(given) else given, dtype=float)
            if values.shape == shape and not callable(given):
                values = np.broadcast_to(values, (len(times), *shape))
            if values.shape != (len(times), *shape):
                raise CallError(
                    f"the values of input `{name}` have the shape {values.shape}; give a constant of shape {shape}, or an array of "
                    f"shape {(len(times), *shape)}, one entry for each row of results"
                )
            names += own
            columns.append(values.reshape(len(times), -1))
        return names, np.hstack(columns).ravel().tolist() if columns else []

    def sweep(
        self,
        space: Space,
        outputs: Outputs,
        *,
        stop: float | None = None,
        output_step: float | None = None,
        inputs: Inputs | None = None,
        executor: Executor | None = None,
        store: str | os.PathLike[str] | None = None,
        progress: Progress = False,
        refine: bool | Literal["each"] | None = None,
        budget: float | None = None,
    ) -> Any:
        """Run the model for many parameters, and return an xarray.Dataset.

        ``space`` is a grid, ``{"payload": [200, 400], "boom.elements": [4, 8]}``, of which all combinations are computed and whose parameters are the
        dimensions of the dataset; or a list of samples, ``[{"payload": 200, ...}, ...]`` or a table of pandas, with the dimension ``point``.

        ``outputs`` names what is kept of each run: ``"tip.displacement[3]:max"``, a column or a vector with one of the reducers ``first``, ``last``,
        ``min``, ``max``, ``mean``, ``rms`` of its rows, or without one for the whole series. A mapping gives names, also to functions of Results:
        ``{"peak": "tip.displacement[3]:max", "swing": lambda r: np.ptp(r["tip.displacement[1]"])}``. Units are attributes.

        ``executor`` is any executor of ``concurrent.futures``, or of a package that follows it: by default threads, one for each core, which need no more than
        that since runs free the GIL; ``dask.distributed.Client(...).get_executor()`` for a cluster. Results and their order do not depend on it.

        A point that fails is NaN; its message is in ``error``, and warnings of the solver are in ``warning``. If the parameters cannot be those of the model,
        ModelError is raised. ``store`` names a folder, a Zarr group: what is in it is not computed again, so that a study goes on where it ended.
        ``progress`` is True for a bar (needs tqdm), or a function of the numbers of known and of all points.

        Where the model file leaves the steps or the elements of a beam to the program, the point in the middle of each dimension runs again with finer steps and meshes until
        the results that are kept are accurate, as in ``run``. All points then run once with its numbers, which are in ``attrs["settings"]``: one
        discretization makes smooth responses. ``refine="each"`` finds them for each point, ``refine=True`` also where the file has an ``accuracy``, and
        ``refine=False`` runs all points as the file begins. ``budget`` bounds the cost of the search, as in ``run``.

        ``stop``, ``output_step`` and ``inputs`` are those of ``run``, for all points. Ctrl-C raises Interrupted, whose ``results`` has the points so far.
        Needs xarray, and zarr for a store.
        """
        return sweep(
            self,
            space,
            outputs,
            {"stop": stop, "output_step": output_step, "inputs": inputs},
            (refine, budget),
            executor=executor,
            store=store,
            progress=progress,
        )

    def instance(self, parameters: Parameters | None = None) -> Instance:
        """Return a simulation to advance step by step, with the parameters changed."""
        return Instance(self._source, list(dict([*self._overrides, *self._changes(parameters)]).items()))

    def modes(self, count: int = 10, parameters: Parameters | None = None) -> Modes:
        """Find the ``count`` lowest natural modes about the initial state.

        Beams whose ``elements`` the model file leaves to the program get as many as the frequencies need to be right to 0.5 %.
        """
        simulation = self._open(self._changes(parameters))
        with raising():
            simulation.initialize()
            found = simulation.modes(count)
        warn(found[-1])
        return Modes._of(found)

    def linearize(
        self,
        inputs: Sequence[str] | None = None,
        outputs: Sequence[str] | None = None,
        at: str | float = "start",
        parameters: Parameters | None = None,
        *,
        steady: tuple[str, float] | None = None,
        without_gravity: bool = False,
    ) -> Linearization:
        """Return the linear system about a state, with exact matrices.

        ``inputs`` and ``outputs`` name inputs and columns of results, vectors as a whole: ``["push.force"]``; by default all of them. The motion of a drive is
        an input as its acceleration, ``"motor.acceleration"``. ``at`` is ``"start"``, ``"equilibrium"``, or a time of the run in s.
        ``steady=("motor", 100.0)`` is about the steady rotation that this drive makes, rad/s, without gravity where ``without_gravity`` says so.
        """
        if steady is None and without_gravity:
            raise CallError("without_gravity is for a steady rotation; give steady as well")
        if steady is not None and at != "start":
            raise CallError("a steady rotation has no other state: leave out at")
        if isinstance(at, str) and at not in ("start", "equilibrium"):
            raise CallError(f'at is "start", "equilibrium" or a time in s, not {at!r}')
        for name, given in (("inputs", inputs), ("outputs", outputs)):
            if isinstance(given, str):
                raise CallError(f"{name} is a list of names, not a string; give [{given!r}]")
        changes = self._changes(parameters)
        simulation = self._open(changes)
        if at == "equilibrium" and not simulation.begins_at_equilibrium():
            simulation = self._open([*changes, ("simulation.initial", "equilibrium")])
        with raising():
            simulation.initialize()
            if not isinstance(at, str) and at > 0:
                simulation.advance(float(at))
            turn = None if steady is None else (steady[0], float(steady[1]), without_gravity)
            found = simulation.linearize(inputs, outputs, turn)
        warn([warning for warning in simulation.take_warnings() if warning not in self._notes])
        warn(found.warnings())
        return Linearization._of(found, simulation)

    def campbell(
        self,
        drive: str,
        speeds: Sequence[float] | NDArray[np.floating[Any] | np.integer[Any]],
        count: int = 8,
        parameters: Parameters | None = None,
        *,
        without_gravity: bool = False,
    ) -> Campbell:
        """Return the vibrations of the mechanism by the speed of ``drive``, rad/s, which rises from one of ``speeds`` to the next.

        ``count`` is the number of modes, the softest ones of the first speed, which are followed by their vectors. Modes that have the pole of the last one are followed too.
        """
        wanted = [float(speed) for speed in speeds]
        if not wanted or any(next_one <= one for one, next_one in zip(wanted, wanted[1:])) or not np.all(np.isfinite(wanted)):
            raise CallError("speeds rise from one to the next, and there is at least one")
        if count < 1:
            raise CallError(f"count is at least 1, not {count}")
        simulation = self._open(self._changes(parameters))
        with raising():
            simulation.initialize()
            found = simulation.campbell(drive, wanted, count, without_gravity)
        warn([warning for warning in simulation.take_warnings() if warning not in self._notes])
        warn(found.warnings())
        return Campbell._of(found)

    def draw(self, path: str | os.PathLike[str] | None = None) -> Picture:
        """Draw the mechanism, as SVG; with a ``path`` also write it to that file."""
        picture = Picture(self._open().drawing())
        if path is not None:
            Path(path).write_text(picture.svg, encoding="utf-8", newline="")
        return picture

    def pack(self, path: str | os.PathLike[str], *, fmi: int = 2, refine: bool = True, inputs: Inputs | None = None) -> Path:
        """Pack the model as an FMU for co-simulation, write it to ``path`` and return the path.

        ``fmi`` is the version of the standard: 2 for FMI 2.0, 3 for FMI 3.0.

        Where the model file leaves the elements of a beam to the program, the model runs first, with ``inputs`` as in ``run``, and the FMU gets the elements
        and steps with which its results are accurate; ``refine=False`` keeps the first automatic meshes.

        Raises CallError if the model was loaded with changed parameters: an FMU has the model file itself.
        """
        if self._overrides:
            raise CallError("an FMU has the model file itself; load the model without parameters, and set them in the host")
        path = Path(path)
        if path.suffix.lower() != ".fmu":
            raise CallError(f"an FMU has a name that ends in .fmu, {path} does not")
        if fmi not in (2, 3):
            raise CallError(f"fmi is 2 or 3, not {fmi}")
        library = Path(__file__).with_name(_native.LIBRARY)
        simulation = self._open()
        searches = refine and simulation.leaves_mesh()
        if inputs is not None and not searches:
            reason = "the model file gives them all" if refine else "refine=False keeps the first ones"
            raise CallError(f"inputs are for finding the elements of beams, but {reason}; leave out inputs")
        source = self._tuned(inputs) if searches else None
        if source is not None:
            with raising():
                simulation = source.load([])
        path.write_bytes(simulation.pack(str(library), fmi))
        return path

    def _tuned(self, inputs: Inputs | None) -> Source | None:
        """Return the model with the elements and steps with which its results are accurate; None, with a warning: they cannot be found."""
        told: list[str] = []
        try:
            results = self._run(None, stop=None, output_step=None, inputs=inputs, told=told, mesh_error=True, refine=None)
        except RunError as reason:
            warn([f"the FMU keeps its first automatic meshes: {reason}"])
            return None
        if results._found is None:
            warn(["the FMU keeps its first automatic meshes: the model begins with a state, or has too many results"])
            return None
        *_, warning, text, reason_text = results._found
        if text is None:
            warn([f"the FMU keeps its first automatic meshes: {reason_text}"])
            return None
        warn([warning] if warning else [])
        return self._source._replace(text=text)


def _loaded(source: Source, overrides: list[tuple[str, str]]) -> Model:
    """Return a model from a pickle. Its warnings were issued when it was loaded from the file."""
    return _cached(source, tuple(overrides))


@functools.lru_cache(maxsize=8)
def _cached(source: Source, overrides: tuple[tuple[str, str], ...]) -> Model:
    """Return a model from a pickle; a worker of a study gets the same one with every chunk."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", SolverWarning)
        model = Model.__new__(Model)
        model._load(source, dict(overrides))
        return model
