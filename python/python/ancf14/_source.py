"""The text of a model, and where the files are that it names."""

from __future__ import annotations

from typing import NamedTuple

from . import _native


class Source(NamedTuple):
    """What a simulation is loaded from."""

    file: str
    """What messages call it."""
    text: str
    folder: str | None
    """The folder of the model file, to which the files that it names are relative; None: it is a text without a folder, which names none."""
    allow_outside: bool
    """Whether it may name files outside of that folder."""

    def load(self, overrides: list[tuple[str, str]]) -> _native.Simulation:
        """Return a simulation of it with changed numbers and words."""
        return _native.Simulation(self.file, self.text, overrides, self.folder, self.allow_outside)
