"""The results of a run."""

from __future__ import annotations

import difflib
import html
import os
import sys
import tempfile
import webbrowser
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import _native
from ._errors import CallError, VariableError, missing, raising
from ._names import Components

Array = NDArray[np.float64]


class Page:
    """A page that shows a mechanism move, one HTML file. Notebooks show it; ``open``, ``Path`` and the like take it as a path."""

    def __init__(self, path: Path, text: str) -> None:
        self.path = path
        """The file."""
        self.html = text
        """The text of the file."""

    def __fspath__(self) -> str:
        return str(self.path)

    def __repr__(self) -> str:
        return f"<ancf14.Page {str(self.path)!r}>"

    def _repr_html_(self) -> str:
        return f'<iframe srcdoc="{html.escape(self.html)}" width="100%" height="640" style="border: 0"></iframe>'


@dataclass(frozen=True)
class Range:
    """The range over time of a quantity along a beam: arrays of shape ``(stations,)``, or ``(stations, components)`` of a vector.

    A run that ended before the range begins has arrays of no station.
    """

    unit: str
    """Its unit; empty where it has none."""
    description: str
    """Its meaning, with axes and sign."""
    arc_length: Array
    """The undeformed arc lengths of the stations from the start of the beam, m."""
    minimum: Array
    """The lowest values."""
    time_of_minimum: Array
    """The times at which they appear first, s: those of rows, or of steps between them."""
    maximum: Array
    """The highest values."""
    time_of_maximum: Array
    """The times at which they appear first, s: those of rows, or of steps between them."""
    mean: Array
    """The means over time, of the straight lines from row to row."""

    @classmethod
    def _of(cls, row: Any) -> Range:
        _, unit, description, components, stations, values = row
        table = np.array(values, dtype=float).reshape(-1, components, 5)
        columns = [column[:, 0] if components == 1 else column for column in np.moveaxis(table, 2, 0)]
        return cls(unit, description, np.array(stations)[: len(table)], *columns)


class Results(Mapping[str, Array]):
    """The results of a run: ``r["tip.displacement"]`` is an array of shape ``(rows, 3)``, ``r["tip.displacement[3]"]`` of ``(rows,)``.

    All numbers are in the SI units of ``units``.
    """

    time: Array
    """The times of the rows, s, as in results.csv; shape ``(rows,)``."""
    columns: list[str]
    """The names of the columns, in the order of results.csv."""
    units: dict[str, str]
    """The unit of each column and of each vector; empty where it has none."""
    descriptions: dict[str, str]
    """The meaning of each column, with axes and sign."""
    ranges: dict[str, Range]
    """The range over time of each quantity along a beam whose output has ``summary = "range"``, by its name."""

    settings: dict[str, str]
    """The numbers with which a single run is as accurate, changes of the model file by key; empty where the file gives all of them."""
    accuracy: str
    """How many runs it took and the accuracy that is reached, a line; empty where the file leaves neither steps nor elements to the program."""

    @classmethod
    def _of(cls, name: str, variables: list[Any], times: bytes, table: bytes, rerun: tuple[Any, ...]) -> Results:
        results = cls.__new__(cls)
        outputs = [row for row in variables if row[3] == "output"]
        results.name = name
        results.time = np.frombuffer(times).copy()
        results.columns = [row[0] for row in outputs]
        results.descriptions = {row[0]: row[2] for row in outputs}
        results._is_whole = [row[6] for row in outputs]
        # Of a row that was interrupted, a part may be there.
        rows = min(len(results.time), len(table) // 8 // max(len(outputs), 1))
        results.time = results.time[:rows]
        values = np.frombuffer(table)[: rows * len(outputs)].reshape(rows, len(outputs))
        results._values = np.ascontiguousarray(values.T)
        results._places = {name: place for place, name in enumerate(results.columns)}
        results._components = Components(results.columns)
        results.units = {row[0]: row[1] for row in outputs}
        for base in results._components:
            results.units[base] = results.units[next(iter(results._components.names(base).values()))]
        results._rerun = rerun
        results.ranges, results.settings, results.accuracy, results._found = {}, {}, "", None
        return results

    name: str
    """The name of the model."""
    _values: Array
    _is_whole: list[bool]
    _places: dict[str, int]
    _components: Components
    _rerun: tuple[Any, ...]
    _found: tuple[Any, ...] | None
    """The settings as the solver tells them: with the warning, and the text of the model file with them or the reason why there is none."""

    def __getitem__(self, name: str) -> Array:
        """Return a column, or an array of all components of a vector or a table."""
        if name in self._places:
            column: Array = self._values[self._places[name]]
            return column
        if name in self._components:
            return self._components.stack(name, self.__getitem__, (len(self.time),))
        if name == "time":
            return self.time
        near = difflib.get_close_matches(name, [*self._components, *self.columns], 1)
        hint = f"; did you mean `{near[0]}`?" if near else "."
        raise VariableError(f"the results have no column `{name}`{hint} The attribute columns lists all of them")

    def __iter__(self) -> Iterator[str]:
        return iter(self.columns)

    def __len__(self) -> int:
        return len(self.columns)

    def __repr__(self) -> str:
        end = f" to t = {self.time[-1]:g} s" if len(self.time) else ""
        return f"<ancf14.Results of {self.name!r}: {len(self.time)} rows{end}, {len(self.columns)} columns>"

    def to_csv(self, path: str | os.PathLike[str]) -> None:
        """Write the table, with the same bytes as results.csv of ``ancf14 run``."""
        flags = zip(self.columns, self._is_whole, self._values, strict=True)
        columns = [(name, is_whole, values.tolist()) for name, is_whole, values in flags]
        Path(path).write_text(_native.table(self.time.tolist(), columns), encoding="utf-8", newline="")

    def to_pandas(self) -> Any:
        """Return a pandas.DataFrame: a column for each column, the time in s as index. Needs pandas."""
        try:
            import pandas
        except ImportError:
            missing("pandas", "to_pandas")
        index = pandas.Index(self.time, name="time")
        frame = pandas.DataFrame(self._values.T.copy(), index=index, columns=self.columns)
        frame.attrs["units"] = {name: self.units[name] for name in self.columns}
        return frame

    def to_xarray(self) -> Any:
        """Return an xarray.Dataset: vectors have the dimensions time and axis, tables others; units are attributes. Needs xarray."""
        try:
            import xarray
        except ImportError:
            missing("xarray", "to_xarray")
        inside = {name for base in self._components for name in self._components.names(base).values()}
        variables: dict[str, Any] = {}
        for name in [*self._components, *(name for name in self.columns if name not in inside)]:
            values = self[name]
            sizes = values.shape[1:]
            names = ["axis"] if sizes == (3,) else [f"{name}_{k + 1}" for k in range(len(sizes))]
            variables[name] = (["time", *names], values, {"units": self.units[name]})
        data = xarray.Dataset(variables, coords={"time": ("time", self.time, {"units": "s"})}, attrs={"model": self.name})
        return data.assign_coords(axis=["x", "y", "z"]) if "axis" in data.dims else data

    def plot(self, *names: str, axes: Any = None) -> Any:
        """Plot columns or vectors over time, and return the axes of matplotlib. Needs matplotlib."""
        if not names:
            raise CallError("give the names of the columns to plot; the attribute columns lists them")
        columns = {name: self[name] for name in names}
        try:
            import matplotlib.pyplot as plt
        except ImportError:
            missing("matplotlib", "plot")
        axes = plt.subplots()[1] if axes is None else axes
        for name, values in columns.items():
            flat = values.reshape(len(self.time), -1)
            own = [name] if values.ndim == 1 else list(self._components.names(name).values())
            for k, label in enumerate(own):
                axes.plot(self.time, flat[:, k] if values.ndim == 1 else self[label], label=label)
        units = {self.units.get(name, "") for name in names}
        axes.set_xlabel("time (s)")
        axes.set_ylabel(f"({units.pop()})" if len(units) == 1 and units != {""} else "")
        axes.legend()
        return axes

    def view(self, path: str | os.PathLike[str] | None = None) -> Page:
        """Write a page that shows the mechanism move, an HTML file, and return it. Notebooks show it; elsewhere it opens in a browser if no ``path`` is given.

        The page is made from a second run, which has the same results. A run that was repeated with finer steps and meshes is repeated again.
        """
        if not len(self.time):
            raise CallError("there is nothing to view: the run has no row")
        source, overrides, names, values, mesh_error, refinement = self._rerun
        # A run that was repeated is repeated again: its last run has the results.
        last = len(self.time) - 1 if refinement[0] is False else None
        with raising():
            simulation = source.load(overrides)
            if mesh_error:
                simulation.ask_for_mesh_error()
            page, error = simulation.run(names, values, True, last, refinement)[4:2:-1]
        if page is None:
            raise error or CallError("the page cannot be written")
        target = Path(path) if path is not None else Path(tempfile.mkdtemp(prefix="ancf14-")) / "view.html"
        target.write_text(page, encoding="utf-8", newline="")
        if path is None and "ipykernel" not in sys.modules:
            webbrowser.open(target.as_uri())
        return Page(target, page)
