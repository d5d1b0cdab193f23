"""Names of variables: ``tip.displacement[3]`` is a component of ``tip.displacement``."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

_COMPONENT = re.compile(r"(.*)\[(\d+(?:,\s*\d+)*)\]")


class Components:
    """The components of vectors and tables among names of variables."""

    def __init__(self, names: Iterable[str]) -> None:
        self._all: dict[str, dict[tuple[int, ...], str]] = {}
        for name in names:
            found = _COMPONENT.fullmatch(name)
            if found:
                index = tuple(int(number) - 1 for number in found[2].split(","))
                self._all.setdefault(found[1], {})[index] = name

    def __contains__(self, base: object) -> bool:
        return base in self._all

    def __iter__(self) -> Iterator[str]:
        return iter(self._all)

    def shape(self, base: str) -> tuple[int, ...]:
        """Return the shape of a vector, ``(3,)``, or of a table."""
        return tuple(max(index) + 1 for index in zip(*self._all[base], strict=True))

    def names(self, base: str) -> dict[tuple[int, ...], str]:
        """Return the names of all components by their index, from 0."""
        return self._all[base]

    def stack(self, base: str, value: Callable[[str], Any], lead: tuple[int, ...] = ()) -> NDArray[np.float64]:
        """Return the array of the values of all components, NaN where there is none; ``lead`` is the shape of one value."""
        array = np.full(lead + self.shape(base), np.nan)
        for index, name in self._all[base].items():
            place: tuple[Any, ...] = (..., *index)
            array[place] = value(name)
        return array
