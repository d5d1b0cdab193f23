"""Natural modes."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Modes:
    """The lowest natural modes, ``k`` of them, at ``p`` places: the nodes of all beams, then bodies."""

    frequency: Array
    """Frequencies, Hz, shape ``(k,)``; 0 for modes that do not vibrate."""
    angular_frequency: Array
    """Angular frequencies, rad/s, shape ``(k,)``."""
    growth_rate: Array
    """Rates of growth, 1/s, shape ``(k,)``; 0 for modes that are not unstable."""
    eigenvalue: Array
    """Squares of the angular frequencies, 1/s², shape ``(k,)``; negative for unstable modes."""
    modal_mass: Array
    """Modal masses, kg, or kg m² for modes that are largest at a rotation, shape ``(k,)``."""
    damping_ratio: Array
    """Damping ratios to first order, without dry friction, shape ``(k,)``; 0 for modes that do not vibrate."""
    mesh_error: Array
    """Errors of the frequencies because of the mesh, as shares, shape ``(k,)``; NaN where not known."""
    shear: Array
    """Shares by which the shear of beams, which is left out, would lower the frequencies, shape ``(k,)``; NaN where not known."""
    kind: list[str]
    """``vibration``, ``free`` or ``unstable`` for each mode."""
    largest: list[str]
    """The coordinate at which each mode is largest."""
    places: list[str]
    """The names of the places."""
    position: Array
    """The positions of the places, m, shape ``(p, 3)``."""
    displacement: Array
    """The displacement of each place in each mode, scaled to a largest motion of 1 m or 1 rad, shape ``(k, p, 3)``."""
    rotation: Array
    """The small rotation of each place in each mode, rad, shape ``(k, p, 3)``."""

    def __len__(self) -> int:
        return len(self.kind)

    @classmethod
    def _of(cls, found: tuple[Any, ...]) -> Modes:
        modes, places, positions, displacements, turns, _ = found
        numbers = np.array([mode[2] for mode in modes], dtype=float).reshape(-1, 7)
        omega, growth, eigenvalue, mass, ratio, error, shear = (np.ascontiguousarray(column) for column in numbers.T)
        shape = (len(modes), len(places), 3)
        return cls(
            frequency=omega / (2 * np.pi),
            angular_frequency=omega,
            growth_rate=growth,
            eigenvalue=eigenvalue,
            modal_mass=mass,
            damping_ratio=ratio,
            mesh_error=error,
            shear=shear,
            kind=[mode[0] for mode in modes],
            largest=[mode[1] for mode in modes],
            places=places,
            position=np.array(positions, dtype=float).reshape(-1, 3),
            displacement=np.array(displacements, dtype=float).reshape(shape),
            rotation=np.array(turns, dtype=float).reshape(shape),
        )
