"""Vibrations of a mechanism that turns, by its speed."""

from __future__ import annotations

import os
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from ._errors import CallError

if TYPE_CHECKING:
    from ._native import FoundCampbell

Array = NDArray[np.float64]


@dataclass(frozen=True)
class CriticalSpeed:
    """A speed at which the rotation excites a mode."""

    speed: float
    """The speed, rad/s."""
    mode: int
    """The number of the mode, from 0."""
    direction: str
    """``forward``, ``backward`` or ``none``."""
    excited_by: str
    """What excites the mode: ``unbalance``, or ``loads fixed in space``."""


@dataclass(frozen=True, eq=False)
class Campbell:
    """The vibrations of a mechanism that turns, by its speed: modes are followed by their vectors."""

    speeds: Array
    """The speeds, rad/s, shape ``(k,)``."""
    frequencies: Array
    """The frequency of each mode with damping, Hz, shape ``(k, n)``."""
    damping: Array
    """Their damping ratios, shape ``(k, n)``."""
    real: Array
    """The real parts of their poles, 1/s, shape ``(k, n)``."""
    directions: NDArray[np.str_]
    """How they turn about the axis: ``forward``, ``backward`` or ``none``, shape ``(k, n)``."""
    moves: list[str]
    """The part that each mode moves most at the last speed; with a direction where the mode does not whirl."""
    frame: str
    """The axes in which the frequencies are told: ``fixed``, or ``turning`` with the mechanism."""
    critical_speeds: list[CriticalSpeed]
    """The critical speeds, ascending."""
    stability_limit: float | None
    """The least speed at which a motion grows, rad/s; None: there is none."""
    _native: FoundCampbell = field(repr=False)

    @classmethod
    def _of(cls, found: FoundCampbell) -> Campbell:
        speeds, frame, limit = found.summary()
        shape = (len(speeds), -1)
        frequencies, damping, real = (np.array(values, dtype=float).reshape(shape) for values in found.numbers())
        return cls(
            speeds=np.array(speeds, dtype=float),
            frequencies=frequencies,
            damping=damping,
            real=real,
            directions=np.array(found.directions()).reshape(shape),
            moves=found.moves(),
            frame=frame,
            critical_speeds=[CriticalSpeed(*own) for own in found.critical_speeds()],
            stability_limit=limit,
            _native=found,
        )

    def save(self, path: str | os.PathLike[str]) -> Path:
        """Write the table, ``.csv``, or the diagram, ``.svg``, and return the path."""
        path = Path(path)
        if path.suffix not in (".csv", ".svg"):
            raise CallError(f"{path} has no ending that says what it is; give a path that ends in .csv or .svg")
        path.write_text(self._native.text(path.suffix.removeprefix(".")), encoding="utf-8", newline="")
        return path
