"""The store of a study, a Zarr group on the disk: what is in it need not be computed again."""

from __future__ import annotations

import hashlib
import os
from dataclasses import asdict
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .._errors import CallError, missing
from .points import POINT, Points
from .reducers import Array, Reduced
from .settings import Found, Refinement
from .work import Done, Recipe

BYTES = 1 << 20
"""The size of a chunk of an array on the disk, about."""
OPEN = -1
"""The code of a point that is not known. Others are 0, or the place of a message, from 1."""


def fingerprint(recipe: Recipe, points: Points, refinement: Refinement) -> str:
    """Return a word that two studies have in common if they are the same: model, parameters, outputs, settings."""
    digest = hashlib.sha256()

    def add(thing: Any) -> None:
        if isinstance(thing, dict):
            for key, value in thing.items():
                add(key)
                add(value)
        elif isinstance(thing, list | tuple):
            digest.update(f"[{len(thing)}".encode())
            for entry in thing:
                add(entry)
        elif isinstance(thing, np.ndarray):
            digest.update(f"{thing.dtype}{thing.shape}".encode())
            digest.update(thing.tobytes())
        elif callable(thing):
            code = getattr(thing, "__code__", None)
            add([getattr(thing, "__qualname__", repr(type(thing))), code.co_code.hex() if code else "", repr(code.co_consts) if code else ""])
        else:
            digest.update(f"{type(thing).__name__}:{thing!r};".encode())

    add(recipe.model.__reduce__()[1])
    add([points.names, [[_plain(value) for value in row] for row in points.values]])
    add([[output.name, output.column, output.how] for output in recipe.outputs])
    add(recipe.settings)
    add(refinement)
    return digest.hexdigest()


def _plain(value: Any) -> Any:
    return value.tolist() if isinstance(value, np.ndarray | np.generic) else value


class Store:
    """A Zarr group with an array for each output, along the points in their order, and a code for each point."""

    def __init__(self, path: str | os.PathLike[str], study: str, points: Points, outputs: list[Reduced]) -> None:
        self._group: Any
        try:
            import zarr
        except ImportError:
            missing("zarr", "a store")
        self.path = Path(path)
        self._points, self._outputs = points, outputs
        for output in outputs:
            if "/" in output.name:
                raise CallError(f"an output with a store must have no `/` in its name, `{output.name}` has one; give it another name")
        if self.path.exists() and any(self.path.iterdir()):
            try:
                self._group = zarr.open_group(self.path, mode="r+")
                own = self._group.attrs.get("study")
            except (ValueError, FileNotFoundError) as reason:
                raise CallError(f"{self.path} is no store of a study ({reason}); choose another path") from None
            if own != study:
                raise CallError(
                    f"{self.path} has another study: its model, parameters, outputs or settings are not those of this call; choose another path, or "
                    "delete it"
                )
            return
        self._group = zarr.create_group(self.path, attributes={"study": study, "messages": []})
        for name, (_, values) in points.coordinates().items():
            column = np.array([row[points.names.index(name)] for row in points.values]) if points.axes is not None else np.array(values)
            if column.dtype.kind in "fiub":
                self._create(name, column.shape[1:], column.dtype)[:] = column
        # These come last: a store that has them is whole.
        for name in ("warning", "error"):
            self._create(name, (), np.dtype("i4"), OPEN)

    def _create(self, name: str, shape: tuple[int, ...], dtype: np.dtype[Any], fill: float = 0) -> Any:
        size = int(np.prod(shape, dtype=int)) * dtype.itemsize
        rows = max(1, min(len(self._points), BYTES // max(size, 1)))
        inner = [f"{name}_{k + 1}" for k in range(len(shape))]
        return self._group.create_array(
            name,
            shape=(len(self._points), *shape),
            chunks=(rows, *(max(length, 1) for length in shape)),
            dtype=dtype,
            fill_value=fill,
            dimension_names=[POINT, *inner],
        )

    def read(self) -> tuple[list[str | None], list[str], dict[str, Array], Array | None]:
        """Return the message, the warnings and the values of each point that is known."""
        if "error" not in self._group:
            raise CallError(f"{self.path} was given up before its study began; delete it")
        texts = self._group.attrs["messages"]
        codes, told = self._group["error"][:], self._group["warning"][:]
        errors = [None if code == OPEN else texts[code - 1] if code else "" for code in codes.tolist()]
        warned = [texts[code - 1] if code > 0 else "" for code in told.tolist()]
        values = {output.name: self._group[output.name][:] for output in self._outputs if output.name in self._group}
        times = np.array(self._group.attrs["time"]) if "time" in self._group.attrs else None
        return errors, warned, values, times

    def found(self) -> Found | None:
        """Return the steps and meshes of all points; None: they are not known."""
        own = self._group.attrs.get("found")
        return None if own is None else Found(own["settings"], own["accuracy"], own["warning"])

    def keep(self, found: Found) -> None:
        """Keep the steps and meshes of all points: a study that goes on has the same."""
        self._group.attrs["found"] = asdict(found)

    def write(self, done: Done, times: Array | None) -> None:
        """Add the runs of a chunk. Their codes are written last: a store that lost its program in between does not know them."""
        if times is not None and "time" not in self._group.attrs:
            self._group.attrs["time"] = times.tolist()
        numbers = np.asarray(done.numbers)
        for place, output in enumerate(self._outputs):
            known = [(number, values[place]) for number, values in zip(numbers, done.values, strict=True) if values is not None]
            if not known:
                continue
            if output.name not in self._group:
                self._create(output.name, known[0][1].shape, np.dtype("f8"), np.nan)
            self._put(output.name, np.array([number for number, _ in known]), np.array([value for _, value in known]))
        codes = [self._codes(texts) for texts in (done.warnings, done.errors)]
        for name, own in zip(("warning", "error"), codes, strict=True):
            self._put(name, numbers, np.array(own, dtype="i4"))

    def _put(self, name: str, numbers: NDArray[Any], values: NDArray[Any]) -> None:
        array = self._group[name]
        if len(numbers) and numbers[-1] - numbers[0] == len(numbers) - 1:
            array[numbers[0] : numbers[-1] + 1] = values
        else:
            array.oindex[numbers] = values

    def _codes(self, texts: list[str]) -> list[int]:
        """Return the codes of messages; those that are new join the list."""
        known: list[str] = list(self._group.attrs["messages"])
        count = len(known)
        places = {text: place for place, text in enumerate(known, 1)}
        for text in texts:
            if text and text not in places:
                known.append(text)
                places[text] = len(known)
        if len(known) > count:
            self._group.attrs["messages"] = known
        return [places[text] if text else 0 for text in texts]
