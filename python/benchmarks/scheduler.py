"""What limits a study on a large cluster? A scheduler that gives out chunks one after the other, and workers that compute them, simulated for the chunks
that `sweep` makes; and the bytes of a chunk.

    python python/benchmarks/scheduler.py
"""

import heapq
import pickle
import random
from pathlib import Path

import ancf14
from ancf14._study.reducers import reduced
from ancf14._study.sweep import chunk_size
from ancf14._study.work import Recipe, chunk

CRANE = Path(__file__).parents[1] / "examples" / "crane.toml"
LATENCY = 5e-3
"""From the end of a chunk to the scheduler's knowledge of it, s."""
SPREAD = 0.3
"""Standard deviation of the logarithm of how long a run takes."""


def study(points: int, workers: int, seconds: float, rate: float) -> tuple[int, int, float, float]:
    """Points in a chunk, chunks, time until the end in s, and the share of it that the workers compute."""
    size = chunk_size(points, workers, seconds)
    chance = random.Random(1)
    free = [0.0] * workers
    clock = work = end = 0.0
    left, chunks = points, 0
    while left:
        own = min(size, left)
        left, chunks = left - own, chunks + 1
        clock = max(clock, heapq.heappop(free)) + 1 / rate
        # The means of many runs are nearly alike.
        duration = own * seconds * chance.lognormvariate(0, SPREAD / own**0.5)
        work += duration
        end = max(end, clock + duration)
        heapq.heappush(free, clock + duration + LATENCY)
    return size, chunks, end, work / workers / end


if __name__ == "__main__":
    model = ancf14.Model(CRANE)
    recipe = Recipe(model, reduced(["load_motion.position:max"], model.outputs), {"stop": None, "output_step": None, "inputs": None})
    for size in (1, 100, 1000):
        points = [{"payload": 200.0 + number, "length": 3.0} for number in range(size)]
        print(f"a chunk of {size} points: {len(pickle.dumps((chunk, recipe, list(range(size)), points)))} bytes")
    print("\n| a run | chunks per second | points in a chunk | chunks | until the end | computing |\n|---|---|---|---|---|---|")
    for rate in (200.0, 1000.0):
        for seconds in (1e-3, 1e-2, 1e-1, 1.0):
            size, chunks, end, share = study(1_000_000, 1000, seconds, rate)
            print(f"| {1e3 * seconds:g} ms | {rate:g} | {size} | {chunks} | {end:.1f} s | {100 * share:.0f} % |")
