"""Linear systems."""

from __future__ import annotations

import os
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from ._errors import CallError, RunError, missing, raising, warn
from ._native import LIBRARY

if TYPE_CHECKING:
    from ._native import LinearSystem, Simulation

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Linearization:
    """The linear system about a state: ``dx/dt = A x + B (u - u0)``, ``y - y0 = C x + D (u - u0)``.

    States are changes of independent coordinates, then their rates, then value and rate of each input that prescribes a motion: such an input is its acceleration.
    """

    A: Array
    """The matrix of the states, shape ``(n, n)``."""
    B: Array
    """What the inputs do to the states, shape ``(n, k)``."""
    C: Array
    """The outputs from the states, shape ``(m, n)``."""
    D: Array
    """The outputs from the inputs, shape ``(m, k)``."""
    states: list[str]
    """The names of the states."""
    inputs: list[str]
    """The names of the inputs."""
    outputs: list[str]
    """The names of the outputs, those of columns of results."""
    units: dict[str, str]
    """The SI units of states, inputs and outputs by name."""
    u0: Array
    """The inputs in the state that the system is about, shape ``(k,)``."""
    y0: Array
    """The outputs in that state, shape ``(m,)``."""
    time: float
    """The time of that state, s."""
    bound: float | None
    """Of a reduced system by balanced truncation the bound of its error, over the response to a sudden change of an input."""
    error: float | None
    """Of a reduced system the largest error that responses at many frequencies show, over the response to a sudden change of an input."""
    _native: LinearSystem = field(repr=False)
    _simulation: Simulation = field(repr=False)

    @classmethod
    def _of(cls, found: LinearSystem, simulation: Simulation) -> Linearization:
        reduction = found.reduction()
        states, inputs, outputs = found.signals()
        n, k, m = len(states), len(inputs), len(outputs)
        shapes = [(n, n), (n, k), (m, n), (m, k)]
        a, b, c, d = (np.frombuffer(values, dtype="<f8").reshape(shape, order="F").copy() for values, shape in zip(found.matrices(), shapes))
        return cls(
            A=a,
            B=b,
            C=c,
            D=d,
            states=[name for name, _, _ in states],
            inputs=[name for name, _, _ in inputs],
            outputs=[name for name, _, _ in outputs],
            units={name: unit for name, unit, _ in [*states, *inputs, *outputs]},
            u0=np.array([value for _, _, value in inputs], dtype=float),
            y0=np.array([value for _, _, value in outputs], dtype=float),
            time=found.time(),
            bound=None if reduction is None else reduction[2],
            error=None if reduction is None else reduction[3],
            _native=found,
            _simulation=simulation,
        )

    def _found(self) -> list[tuple[str, float, float]]:
        try:
            return self._native.poles()
        except RuntimeError as reason:
            raise RunError(str(reason)) from None

    @property
    def poles(self) -> NDArray[np.complex128]:
        """The poles of the mechanism, rad/s, by rising size; of a pair the one with the positive imaginary part."""
        return np.array([complex(real, imaginary) for _, real, imaginary in self._found()], dtype=complex)

    @property
    def kinds(self) -> list[str]:
        """How the motion of each pole goes on: ``rigid``, ``oscillating``, ``overdamped`` or ``unstable``."""
        return [kind for kind, _, _ in self._found()]

    @property
    def frequencies(self) -> Array:
        """The frequency of each pole without damping, ``|pole|/(2 pi)``, Hz."""
        return np.abs(self.poles) / (2 * np.pi)

    @property
    def damping(self) -> Array:
        """The damping ratio of each pole, ``-Re pole/|pole|``; 0 for rigid motions."""
        poles, rigid = self.poles, np.array([kind == "rigid" for kind in self.kinds], dtype=bool)
        size = np.where(rigid | (poles == 0), 1.0, np.abs(poles))
        return np.where(rigid, 0.0, -poles.real / size)

    def reduce(self, error: float | None = None, order: int | None = None, method: str = "balanced") -> Linearization:
        """Return the system with fewer states: as few as keep the ``error``, a share of the response to a sudden change of an input (default 0.01), or ``order`` of them.

        ``method`` is ``"balanced"``, with a bound of the error, ``"modal"``: the modes with the largest peaks, and the static responses of the others, or
        ``"craig-bampton"``: the softest modes with prescribed motions held, and the static responses to the inputs, with symmetric matrices.
        """
        if method not in ("balanced", "modal", "craig-bampton"):
            raise CallError(f'method is "balanced", "modal" or "craig-bampton", not {method!r}')
        if error is not None and order is not None:
            raise CallError("error and order exclude each other; give one of them")
        if error is not None and not 0 < error < 1:
            raise CallError(f"error is a share between 0 and 1, not {error}")
        if order is not None and order < 1:
            raise CallError(f"order is at least 1, not {order}")
        share = 0.01 if error is None and order is None else error
        with raising():
            found = self._simulation.reduce(self._native, share, order or 0, method)
        return Linearization._of(found, self._simulation)

    def to_control(self) -> Any:
        """Return a ``StateSpace`` of python-control, which it needs. Names have ``_`` for dots there, which python-control does not take."""
        try:
            import control
        except ImportError:
            missing("control", "a system of python-control")
        states, inputs, outputs = ([name.replace(".", "_") for name in names] for names in (self.states, self.inputs, self.outputs))
        return control.ss(self.A, self.B, self.C, self.D, states=states, inputs=inputs, outputs=outputs)

    def save(self, path: str | os.PathLike[str]) -> Path:
        """Write the system to a file whose ending says what it is, and return the path: ``.npz`` for numpy, ``.mat`` for MATLAB and Octave, ``.json``, ``.mo`` for Modelica."""
        path = Path(path)
        kind = path.suffix.removeprefix(".")
        if kind not in ("npz", "mat", "json", "mo"):
            raise CallError(f"{path} has no ending that says what it is; give a path that ends in .npz, .mat, .json or .mo")
        path.write_bytes(self._native.file(kind))
        return path

    def pack(self, path: str | os.PathLike[str], *, fmi: int = 2) -> Path:
        """Pack the system as a small FMU for co-simulation and Model Exchange, write it to ``path`` and return the path.

        ``fmi`` is the version of the standard: 2 for FMI 2.0, 3 for FMI 3.0. The FMU is right for small motions about the state of the system. It can have at
        most 300 states: reduce larger systems first. A warning gives the reason where the FMU of a reduced system cannot estimate its own error.
        """
        path = Path(path)
        if path.suffix.lower() != ".fmu":
            raise CallError(f"an FMU has a name that ends in .fmu, {path} does not")
        if fmi not in (2, 3):
            raise CallError(f"fmi is 2 or 3, not {fmi}")
        library = Path(__file__).with_name(LIBRARY)
        try:
            content, warnings = self._simulation.pack_linear(self._native, str(library), fmi)
        except RuntimeError as reason:
            raise RunError(str(reason)) from None
        path.write_bytes(content)
        warn(warnings)
        return path
