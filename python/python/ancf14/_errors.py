"""Errors and warnings."""

from __future__ import annotations

import sys
import warnings
from typing import Any, NoReturn

from . import _native


class Error(Exception):
    """The base of all errors of this package.

    ``line`` is the line of the model file that the error is about, counted from 1, or None.
    """

    def __init__(self, message: str, line: int | None = None) -> None:
        super().__init__(message)
        self.line = line


class ModelError(Error, ValueError):
    """A model file has mistakes. The message shows all of them, each with its line underlined."""


class VariableError(Error, KeyError):
    """No variable has this name. The message suggests the nearest name."""

    __str__ = Exception.__str__


class CallError(Error, ValueError):
    """A value or a call is not possible, or not now: a value out of its range, a result before ``initialize``."""


class RunError(Error, RuntimeError):
    """The solver cannot compute the initial state or a step, or the executor of a study has broken.

    ``results`` has the rows or the points before the failure, or is None.
    """

    results: Any = None


class Interrupted(KeyboardInterrupt):
    """Ctrl-C stopped a run or a study. ``results`` has the rows or the points up to then."""

    def __init__(self, message: str, results: Any) -> None:
        super().__init__(message)
        self.results = results


class SolverWarning(UserWarning):
    """Something in a legal model that is probably not meant, or results that should not be trusted."""


_KINDS: dict[str, type[Error]] = {"model": ModelError, "name": VariableError, "call": CallError, "run": RunError}


def error_of(refusal: BaseException) -> Error:
    """Return the public error for a refusal of the native module."""
    kind, message, line = refusal.args
    return _KINDS[kind](message, line)


class raising:
    """A context that raises public errors for refusals of the native module."""

    def __enter__(self) -> None:
        return None

    def __exit__(self, kind: object, refusal: BaseException | None, trace: object) -> None:
        if isinstance(refusal, _native.Refusal):
            raise error_of(refusal) from None


def warn(messages: list[str]) -> None:
    """Issue warnings of the solver, at the line that called this package."""
    level, frame = 1, sys._getframe()
    while frame.f_back is not None and frame.f_globals.get("__package__") == __package__:
        level, frame = level + 1, frame.f_back
    for message in messages:
        warnings.warn(message, SolverWarning, stacklevel=level)


def missing(package: str, purpose: str) -> NoReturn:
    """Say that an optional package is not installed."""
    raise ImportError(f"{purpose} needs {package}, which is not installed; install it: pip install {package}") from None
