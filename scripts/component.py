"""Runs the unit as a component of WebAssembly in wasmtime, as the draft of FMI-LS-WASM describes it, and compares it with the library for this computer: a table of models with the
largest difference of an output, as a share of the largest value of that output.

    sh scripts/build-component.sh
    target/component-env/bin/python scripts/component.py [FOLDER]

FOLDER has the program, its library and wasm32-wasip2/ancf14.wasm (target/fmu if it is not given). Fails if FMUs do not contain the component, if a difference is larger than 1e-5, if a state that comes back
gives other bits, or if an illegal call is accepted.
"""

import csv
import math
import subprocess
import sys
import tempfile
import time
import zipfile
from pathlib import Path
from xml.etree import ElementTree

from wasmtime import Engine, Store, WasiConfig
from wasmtime.component import Component, Linker

ROOT = Path(__file__).resolve().parent.parent
FOLDER = Path(sys.argv[1]) if len(sys.argv) > 1 else ROOT / "target/fmu"
# Model, stop time and communication step, s.
RUNS = [("pendulum", 1, 0.01), ("crane", 2, 0.02), ("four_bar", 0.5, 0.02), ("lateral_buckling", 0.2, 5e-4), ("rotating_shaft", 0.05, 2e-3)]
# The last digits of sin and exp grow in chaotic motions; these are not.
LIMIT = 1e-5
COMPONENT = "wasm32-wasip2/ancf14.wasm"
CO_SIMULATION = "fmi:fmi3/co-simulation@3.0.0"


class Unit:
    """An instance in wasmtime, with the resources of an FMU."""

    def __init__(self, engine, component, resources: Path, token: str):
        self.lines, self.updates, self.ask = [], [], None
        linker = Linker(engine)
        linker.add_wasip2()
        with linker.root() as root:
            with root.add_instance("fmi:fmi3/callbacks@3.0.0") as callbacks:
                callbacks.add_func("log-message", lambda _store, *words: self.lines.append(words))
                for name in ["clock-update", "lock-preemption", "unlock-preemption"]:
                    callbacks.add_func(name, lambda _store: None)
            with root.add_instance("fmi:fmi3/intermediate-update-callbacks@3.0.0") as callbacks:
                callbacks.add_func("intermediate-update", self.update)
        self.store = Store(engine)
        wasi = WasiConfig()
        wasi.preopen_dir(str(resources), "/resources", False)
        self.store.set_wasi(wasi)
        self.instance = linker.instantiate(self.store, component)
        self.inside = self.instance.get_export_index(self.store, CO_SIMULATION)
        name = "[static]co-simulation-instance.instantiate-co-simulation"
        self.handle = self.function(name)(self.store, "unit", token, "/resources/", False, False, False, self.wants_updates(), [])
        assert self.handle is not None, self.lines

    def wants_updates(self):
        return False

    def update(self, _store, time, _set, _get, _finished, can_return):
        self.updates.append(time)
        return (bool(can_return and self.ask and time > self.ask), time)

    def function(self, name):
        return self.instance.get_func(self.store, self.instance.get_export_index(self.store, name, self.inside))

    def call(self, name, *words):
        function = self.function(f"[method]co-simulation-instance.{name}")
        result = function(self.store, self.handle, *words)
        function.post_return(self.store)
        return result

    def value(self, name, *words):
        """What a call gives that must succeed."""
        result = self.call(name, *words)
        # What is refused is the name of its status.
        assert not isinstance(result, str), (name, result, self.lines)
        return result

    def done(self, name, *words):
        """A call that must succeed and gives nothing else."""
        status = self.call(name, *words)
        assert status in ("ok", "warning"), (name, status, self.lines)

    def initialize(self):
        self.done("enter-initialization-mode", None, 0.0, None)
        self.done("exit-initialization-mode")


class Listener(Unit):
    """An instance that hears of internal steps."""

    def wants_updates(self):
        return True


def outputs(description):
    """Names of the elements of all Float64 outputs as results.csv has them, and the references of the variables."""
    names, references = [], []
    for variable in description.find("ModelVariables").iter("Float64"):
        if variable.get("causality") == "output":
            references.append(int(variable.get("valueReference")))
            extents = [int(dimension.get("start")) for dimension in variable.iter("Dimension")]
            indices = [()]
            for extent in extents:
                indices = [(*index, k + 1) for index in indices for k in range(extent)]
            names += [variable.get("name") + (f"[{','.join(map(str, index))}]" if index else "") for index in indices]
    return names, references


def difference(found, expected):
    """The largest difference of an output, as a share of its largest expected value; infinite if a value is not finite, or not zero as all expected values are."""
    if not all(map(math.isfinite, [*found, *expected])):
        return math.inf
    largest = max(abs(a - b) for a, b in zip(found, expected, strict=True))
    scale = max(map(abs, expected))
    return 0.0 if largest == 0 else largest / scale if scale > 0 else math.inf


def compared(engine, component, model, stop, step, folder):
    """The largest difference, and seconds that initialization and steps take."""
    subprocess.run([FOLDER / "ancf14", "pack", ROOT / f"models/{model}.toml", "--fmi", "3", "-o", folder / f"{model}.fmu"], check=True, capture_output=True)
    with zipfile.ZipFile(folder / f"{model}.fmu") as archive:
        archive.extractall(folder / model)
    packed = next((folder / model / "binaries/wasm32-wasip2").iterdir())
    assert packed.read_bytes() == (FOLDER / COMPONENT).read_bytes()
    assert (folder / model / "extra/org.modelica.fmi-ls-wasm/manifest.xml").is_file()
    settings = ["--set", f"simulation.stop={stop}", "--set", f"simulation.output_step={step}"]
    subprocess.run([FOLDER / "ancf14", "run", ROOT / f"models/{model}.toml", *settings, "--out", folder / f"{model}-run"], check=True, capture_output=True)
    with open(folder / f"{model}-run/results.csv", newline="") as file:
        header, *rows = csv.reader(file)
    expected = [dict(zip(header, map(float, row))) for row in rows]
    description = ElementTree.parse(folder / model / "modelDescription.xml").getroot()
    names, references = outputs(description)
    unit = Unit(engine, component, folder / model / "resources", description.get("instantiationToken"))
    begin = time.perf_counter()
    unit.initialize()
    found = [unit.value("get-float64", references)]
    for k in range(round(stop / step)):
        unit.value("do-step", k * step, step, False)
        found.append(unit.value("get-float64", references))
    spent = time.perf_counter() - begin
    unit.done("terminate")
    assert len(found) == len(expected), (len(found), len(expected))
    columns = [([row[place] for row in found], [row[name] for row in expected]) for place, name in enumerate(names)]
    assert columns
    return len(names), len(found), max(difference(*column) for column in columns), spent


def states_and_refusals(engine, component, folder):
    """A state comes back to the bit, also after an early return; illegal calls are refused with a reason."""
    description = ElementTree.parse(folder / "pendulum/modelDescription.xml").getroot()
    _, references = outputs(description)
    unit = Listener(engine, component, folder / "pendulum/resources", description.get("instantiationToken"))
    assert unit.call("do-step", 0.0, 0.01, False) == "error" and "not allowed now" in unit.lines[-1][3]
    assert unit.call("enter-event-mode") == "error" and "no events" in unit.lines[-1][3]
    unit.initialize()
    state = unit.value("get-fmu-state")
    assert not unit.value("do-step", 0.0, 0.01, False).__dict__["early-return"]
    assert len(unit.updates) > 1, unit.updates
    whole = unit.value("get-float64", references)
    unit.done("set-fmu-state", state)
    unit.ask = unit.updates[0]
    answer = unit.value("do-step", 0.0, 0.01, False).__dict__
    assert answer["early-return"] and answer["last-successful-time"] < 0.01
    unit.ask = None
    reached = answer["last-successful-time"]
    unit.value("do-step", reached, 0.01 - reached, False)
    assert unit.value("get-float64", references) == whole
    return len(unit.updates)


def main():
    engine = Engine()
    begin = time.perf_counter()
    component = Component.from_file(engine, str(FOLDER / COMPONENT))
    print(f"compiled in {time.perf_counter() - begin:.1f} s")
    worst = 0.0
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        print("| model | outputs | rows | difference | s |\n|---|---|---|---|---|")
        for model, stop, step in RUNS:
            count, rows, largest, spent = compared(engine, component, model, stop, step, folder)
            worst = max(worst, largest)
            told = f"{largest:.0e}" if largest else "bit-identical"
            print(f"| `models/{model}.toml`, {stop} s | {count} | {rows} | {told} | {spent:.1f} |", flush=True)
        states_and_refusals(engine, component, folder)
    print(f"{'1 passed, 0 failed' if worst <= LIMIT else '0 passed, 1 failed'}")
    sys.exit(worst > LIMIT)


if __name__ == "__main__":
    main()
