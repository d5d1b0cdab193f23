"""A simulation that a program advances step by step."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from . import _native
from ._errors import CallError, raising, warn
from ._names import Components
from ._source import Source


@dataclass(frozen=True)
class State:
    """A saved state of an Instance: parameters, inputs, time and motion. It can be pickled, and restored in another process."""

    _bytes: bytes
    _pace: tuple[float, float, int]


class Instance:
    """A simulation to advance step by step, made by Model.instance.

    ``u["payload"] = 800`` sets a parameter (before ``initialize``), a tunable parameter or an input; ``u["boom_tip.position"]``
    reads any variable, in its SI unit. A name without its index stands for all components: an array of shape ``(3,)``.
    """

    def __init__(self, source: Source, overrides: list[tuple[str, str]]) -> None:
        self._made_from = (source, overrides)
        with raising():
            self._simulation = source.load(overrides)
        variables = self._simulation.variables()
        self._components = Components(row[0] for row in variables)
        self._results = {row[0].split("[")[0] for row in variables if row[3] == "output"}
        self._pace = (0.0, 0.0, 0)
        """A time, a step and how many such steps followed: the time is not a running sum."""

    def __repr__(self) -> str:
        return f"<ancf14.Instance {self._simulation.name()!r} at t = {self.time:g} s>"

    @property
    def time(self) -> float:
        """The time reached, s."""
        return self._simulation.time()

    def __getitem__(self, name: str) -> Any:
        """Return the value of a variable, or an array of all its components, in its SI unit."""
        with raising():
            if name in self._components:
                return self._components.stack(name, self._simulation.value)
            return self._simulation.value(name)

    def __setitem__(self, name: str, value: ArrayLike) -> None:
        with raising():
            if name not in self._components:
                self._simulation.set(name, float(np.asarray(value, dtype=float)[()]))
                return
            values = np.asarray(value, dtype=float)
            shape = self._components.shape(name)
            if name in self._results:
                # It cannot be set, whatever its shape; the message says why.
                self._simulation.set(next(iter(self._components.names(name).values())), 0.0)
            if values.shape != shape:
                raise CallError(f"the value of `{name}` has the shape {values.shape}; give one of shape {shape}")
            before = self._simulation.save()
            try:
                for index, component in self._components.names(name).items():
                    self._simulation.set(component, float(values[index]))
            except _native.Refusal:
                self._simulation.restore(before)
                raise

    def initialize(self) -> None:
        """Find the initial state; from here on there are results."""
        with raising():
            self._simulation.initialize()
        self._told()

    def step(self, step: float) -> None:
        """Advance by ``step``, s."""
        start, length, count = self._pace
        if length != step:
            start, length, count = self.time, step, 0
        self._reach(start + (count + 1) * length)
        self._pace = (start, length, count + 1)

    def advance(self, time: float) -> None:
        """Advance to the time ``time``, s. Results are bit-identical to those of ``ancf14 run`` at multiples of simulation.step."""
        self._reach(time)
        self._pace = (0.0, 0.0, 0)

    def _reach(self, time: float) -> None:
        try:
            with raising():
                self._simulation.advance(time)
        finally:
            self._told()

    def finish(self) -> None:
        """End the run, with the warnings about the run as a whole. Values can still be read."""
        with raising():
            self._simulation.finish()
        self._told()

    def reset(self) -> None:
        """Go back to the model as loaded, parameters and inputs included."""
        with raising():
            self._simulation.reset()
        self._pace = (0.0, 0.0, 0)

    @property
    def state(self) -> State:
        """A copy of all that changes. Assign it to go back: all that follows has the same bits."""
        with raising():
            return State(self._simulation.save(), self._pace)

    @state.setter
    def state(self, state: State) -> None:
        with raising():
            self._simulation.restore(state._bytes)
        self._pace = state._pace

    def _told(self) -> None:
        warn(self._simulation.take_warnings())

    def __reduce__(self) -> tuple[Any, ...]:
        return _restored, (*self._made_from, self.state)


def _restored(source: Source, overrides: list[tuple[str, str]], state: State) -> Instance:
    """Return an instance from a pickle."""
    instance = Instance(source, overrides)
    instance._simulation.take_warnings()
    instance.state = state
    return instance


