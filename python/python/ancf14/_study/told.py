"""The warnings of a study: one text for all that differ in their numbers only."""

from __future__ import annotations

import re
from collections.abc import Iterable

_NUMBER = re.compile(r"(?<![\w.])[-+]?\d+(?:\.\d+)?(?:[eE][-+]?\d+)?(?![\w.]*\w)")
"""A number that is not a part of a name."""


def grouped(texts: Iterable[str], count: int) -> list[str]:
    """Return one line for each kind of warning of ``count`` points, the most frequent first: in how many points it is, and the range of its numbers.

    ``texts`` has the warnings of each point, a line each.
    """
    kinds: dict[tuple[str, ...], list[list[str]]] = {}
    for text in texts:
        for line in dict.fromkeys(text.splitlines()):
            kinds.setdefault(tuple(_NUMBER.split(line)), []).append(_NUMBER.findall(line))
    found = sorted(kinds.items(), key=lambda kind: -len(kind[1]))
    return [f"{len(rows)} of {count} points: {_line(words, rows)}" for words, rows in found]


def _line(words: tuple[str, ...], rows: list[list[str]]) -> str:
    """Return a line with the range of each of its numbers."""
    line = words[0]
    for place, behind in enumerate(words[1:]):
        numbers = [row[place] for row in rows]
        least, most = min(numbers, key=float), max(numbers, key=float)
        line += (least if float(least) == float(most) else f"{least} to {most}") + behind
    return line
