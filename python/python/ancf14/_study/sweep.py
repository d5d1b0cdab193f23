"""The study: chunks of points for the workers of an executor, and the dataset of what they return."""

from __future__ import annotations

import itertools
import math
import os
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import BrokenExecutor, Executor, Future, ThreadPoolExecutor
from contextlib import ExitStack
from dataclasses import replace
from queue import SimpleQueue
from typing import TYPE_CHECKING, Any, TypeAlias

from .._errors import CallError, Error, Interrupted, RunError, missing, warn
from .points import Points, Space, points
from .reducers import Outputs, reduced
from .settings import Refinement, find
from .table import Table
from .work import DifferentRows, Done, Recipe, chunk

if TYPE_CHECKING:
    from .._model import Model

Progress: TypeAlias = "bool | Callable[[int, int], object]"
"""Whether to show a bar, or a function of the number of points that are done and of all."""

SECONDS = 1.0
"""How long a chunk should take: what a scheduler needs for a task, about a millisecond, is then nothing."""
SHARES = 8
"""A worker gets at least so many chunks, or one that is slow would keep the others waiting at the end."""
RATE = 200.0
"""How many chunks a scheduler gives out in a second, at least: with many workers chunks are longer, or most of them would wait for the next one."""


def sweep(
    model: Model,
    space: Space,
    outputs: Outputs,
    settings: dict[str, Any],
    refinement: Refinement,
    *,
    executor: Executor | None,
    store: str | os.PathLike[str] | None,
    progress: Progress,
) -> Any:
    """Compute a study; ``Model.sweep`` says how."""
    try:
        import xarray  # noqa: F401
    except ImportError:
        missing("xarray", "sweep")
    wanted = points(space)
    if refinement[0] not in (None, True, False, "each"):
        raise CallError(f'refine is True, False, None or "each", not {refinement[0]!r}')
    if refinement[0] == "each":
        settings = {**settings, "mesh_error": True, "refine": None, "budget": refinement[1]}
    recipe = Recipe(model, reduced(outputs, model.outputs), settings)
    _expect_one_to_load(model, wanted)
    table = Table(model, wanted, recipe, refinement, store)
    with ExitStack() as stack:
        if executor is None:
            pool = ThreadPoolExecutor(_cores(), thread_name_prefix="ancf14 sweep")
            stack.callback(pool.shutdown, wait=False, cancel_futures=True)
        show = stack.enter_context(_Bar(progress, len(wanted)))
        show(table.count)
        try:
            if table.found is None:
                table.keep(find(recipe, wanted, refinement))
            assert table.found is not None
            if table.found.warning:
                warn([f"the steps and meshes of the study are not fine enough: {table.found.warning}"])
            recipe = replace(recipe, found=table.found.settings)
            for done in _chunks(recipe, wanted, table.missing(), executor or pool):
                table.put(done)
                show(table.count)
        except KeyboardInterrupt:
            raise Interrupted(f"the study was interrupted; {table.remains()}", table.dataset()) from None
        except BrokenExecutor as reason:
            error = RunError(f"the executor has lost its workers ({reason}); {table.remains()}")
            error.results = table.dataset()
            raise error from reason
    return table.dataset()


def _expect_one_to_load(model: Model, wanted: Points) -> None:
    """Raise the error of the first point if neither it nor the middle nor the last one can be loaded: a name is wrong, not a value."""
    first: Error | None = None
    for number in (0, len(wanted) // 2, len(wanted) - 1):
        try:
            model._open(model._changes(wanted.parameters(number)))
            return
        except Error as reason:
            first = first or reason
    assert first is not None
    raise first


def _chunks(recipe: Recipe, wanted: Points, numbers: Sequence[int], executor: Executor) -> Iterator[Done]:
    """Compute the points with these numbers, in the order in which they are done.

    First each worker gets one point; the time of the first that is done says how many make a chunk of the rest.
    """
    workers = _workers(executor)
    waiting = iter(numbers)
    finished: SimpleQueue[Future[Done]] = SimpleQueue()
    futures: set[Future[Done]] = set()

    def submit(size: int) -> bool:
        own = list(itertools.islice(waiting, size))
        if own:
            future = executor.submit(chunk, recipe, own, [wanted.parameters(number) for number in own])
            futures.add(future)
            future.add_done_callback(finished.put)
        return bool(own)

    try:
        for _ in range(workers):
            submit(1)
        while futures:
            future = finished.get()
            # The result of a future that stays in the set would be kept.
            futures.discard(future)
            done = _result(future)
            yield done
            while submit(chunk_size(len(numbers), workers, done.seconds / len(done.numbers))):
                pass
    finally:
        for future in futures:
            future.cancel()


def chunk_size(count: int, workers: int, seconds: float) -> int:
    """Return how many of ``count`` points make a chunk if a run takes ``seconds``."""
    per_second = 1 / max(seconds, 1e-6)
    wanted = min(SECONDS * per_second, count / (SHARES * workers))
    return math.ceil(min(max(wanted, workers / RATE * per_second), count / workers))


def _result(future: Future[Done]) -> Done:
    try:
        return future.result()
    except (BrokenExecutor, DifferentRows):
        raise
    except Exception as reason:
        raise CallError(
            f"a worker of the executor cannot compute the study: {type(reason).__name__}: {reason}. Workers in other processes need this package, "
            "and functions of `outputs` and `inputs` that can be pickled: defined in a module, not in a call"
        ) from reason


def _workers(executor: Executor) -> int:
    """Return how many points an executor works on at once, as far as it says so."""
    client = getattr(executor, "_client", None)
    if client is not None and hasattr(client, "nthreads"):
        return max(1, int(sum(client.nthreads().values())))
    count = getattr(executor, "_max_workers", None)
    return count if isinstance(count, int) and count > 0 else _cores()


def _cores() -> int:
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


class _Bar:
    """How far the study is, for a person or a function."""

    def __init__(self, progress: Progress, total: int) -> None:
        self._total = total
        self._call = progress if callable(progress) else None
        self._bar: Any = None
        if progress is True:
            try:
                from tqdm.auto import tqdm
            except ImportError:
                missing("tqdm", "a progress bar")
            self._bar = tqdm(total=total, unit="run")

    def __enter__(self) -> _Bar:
        return self

    def __exit__(self, *_: object) -> None:
        if self._bar is not None:
            self._bar.close()

    def __call__(self, count: int) -> None:
        if self._call is not None:
            self._call(count, self._total)
        if self._bar is not None:
            self._bar.update(count - self._bar.n)
