"""Is a study the runs that it says, whatever computes them? A point in a wrong place, a lost digit, a point that is computed twice or a message that is lost shows."""

import os
import signal
import subprocess
import sys
import warnings
from collections.abc import Iterator
from concurrent.futures import Executor, ProcessPoolExecutor, ThreadPoolExecutor
from contextlib import contextmanager
from multiprocessing import get_context
from pathlib import Path
from typing import Any

import ancf14
import numpy as np
import pandas
import pytest
import xarray
from ancf14._study.points import points
from ancf14._study.reducers import reduced
from ancf14._study.work import Recipe, chunk
from dask.distributed import Client, LocalCluster

from conftest import MODELS
from test_runs import PUSHED

SWING = """
format = 1
model = { name = "Swing", gravity = [0, 0, -9.81] }
parameters = { mass = 2.0, length = 1.0 }
body.bob = { mass = "mass", inertia = [0.1, 0.1, 0.1], position = ["length", 0, 0] }
joint.pivot = { type = "revolute", a = "ground", b = "bob", at = [0, 0, 0], axis = [0, 1, 0] }
load.push = { at = "bob", force = [0, 0, 0], input = true }
output.bob = { at = "bob", quantities = ["displacement"] }
simulation = { stop = 0.1, step = 1e-2, output_step = 2e-2 }
"""
GRID: dict[str, Any] = {"length": np.linspace(0.5, 1.5, 7), "simulation.spectral_radius": [0.8, 0.9, 1.0]}
OUTPUTS = ["bob.displacement[3]:min", "bob.displacement:last", "bob.displacement"]


def swing() -> ancf14.Model:
    return ancf14.Model.from_string(SWING)


def span(results: ancf14.Results) -> np.float64:
    return np.ptp(results["bob.displacement[1]"])


@contextmanager
def cluster() -> Iterator[Client]:
    with LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as workers, Client(workers) as client:
        yield client


def test_a_grid_has_the_numbers_of_single_runs() -> None:
    model = swing()
    study = model.sweep(GRID, OUTPUTS)
    assert study["bob.displacement"].dims == ("length", "simulation.spectral_radius", "time", "axis")
    assert study["bob.displacement[3]:min"].dims == ("length", "simulation.spectral_radius")
    for length in GRID["length"]:
        for radius in GRID["simulation.spectral_radius"]:
            results = model.run({"length": length, "simulation.spectral_radius": radius})
            point = study.sel({"length": length, "simulation.spectral_radius": radius})
            assert point["bob.displacement"].values.tobytes() == results["bob.displacement"].tobytes()
            assert point["bob.displacement:last"].values.tobytes() == results["bob.displacement"][-1].tobytes()
            assert point["bob.displacement[3]:min"] == results["bob.displacement[3]"].min()
    assert study["time"].values.tobytes() == results.time.tobytes()
    assert (study["error"] == "").all()


def test_units_and_meanings_are_there() -> None:
    study = swing().sweep({"mass": [1, 2], "length": [1.0]}, OUTPUTS)
    assert study["bob.displacement[3]:min"].attrs["units"] == "m" and study["bob.displacement"].attrs["units"] == "m"
    assert "displacement" in study["bob.displacement[3]:min"].attrs["long_name"]
    assert study.attrs["model"] == "Swing" and study["time"].attrs["units"] == "s"
    assert list(study["axis"].values) == ["x", "y", "z"]


def test_warnings_are_about_what_a_study_keeps_and_come_by_kind() -> None:
    model = ancf14.Model.from_string(SWING.replace("stop = 0.1, step = 1e-2, output_step = 2e-2", "stop = 2, step = 5e-2"))
    lengths = {"length": [0.5, 0.7, 0.9]}
    kept = model.sweep(lengths, ["bob.displacement:last"])
    assert all("bob.displacement is off by about" in text for text in kept["warning"].values)
    # Three texts that differ in their numbers are one kind.
    assert len(set(kept["warning"].values.tolist())) == 3
    (line,) = kept.attrs["warnings"]
    assert line.startswith("3 of 3 points: bob.displacement is off by about ") and " to " in line
    other = model.sweep(lengths, ["statistics.steps:last"])
    assert (other["warning"] == "").all() and "warnings" not in other.attrs


def rod(simulation: str) -> ancf14.Model:
    """A rod that falls, whose elements are left to the program."""
    return ancf14.Model.from_string(f"""
format = 1
model = {{ name = "Rod", gravity = [0, 0, -9.81] }}
material.steel = {{ young = 2.1e11, poisson = 0.3, density = 7850 }}
section.round = {{ shape = "circle", radius = 0.002 }}
beam.arm = {{ material = "steel", section = "round", from = [0, 0, 0], to = [1, 0, 0] }}
joint.root = {{ type = "weld", a = "ground", b = "arm.start" }}
output.tip = {{ at = "arm.end", quantities = ["displacement", "velocity"] }}
simulation = {{ stop = 0.4, output_step = 1e-2{simulation} }}
""")


RADII = {"round.radius": [0.0018, 0.002, 0.0022]}


def test_steps_and_meshes_are_those_of_the_middle_point(tmp_path: Path) -> None:
    model = rod("")
    own = model.run({"round.radius": 0.002})
    assert own.settings and "runs, " in own.accuracy
    study = model.sweep(RADII, ["tip.velocity"], store=tmp_path / "store")
    assert study.attrs["settings"] == ", ".join(f"{key} = {value}" for key, value in own.settings.items())
    assert study.attrs["accuracy"] == own.accuracy
    # Each point is one run with these numbers.
    for radius in RADII["round.radius"]:
        point = model.run({**own.settings, "round.radius": radius}, refine=False)
        assert point.settings == {} and point.accuracy == ""
        assert study["tip.velocity"].sel({"round.radius": radius}).values.tobytes() == point["tip.velocity"].tobytes()
    # A store knows them: nothing is found again.
    again = model.sweep(RADII, ["tip.velocity"], store=tmp_path / "store")
    assert again.equals(study) and again.attrs == study.attrs
    coarse = model.sweep(RADII, ["tip.velocity"], refine=False)
    assert "settings" not in coarse.attrs and not coarse.equals(study)
    with pytest.raises(ancf14.CallError, match="another study"):
        model.sweep(RADII, ["tip.velocity"], refine=False, store=tmp_path / "store")


def test_each_point_may_have_its_own_steps_and_mesh() -> None:
    model = rod("")
    study = model.sweep(RADII, ["tip.velocity"], refine="each")
    for radius in RADII["round.radius"]:
        point = model.run({"round.radius": radius})
        assert study["tip.velocity"].sel({"round.radius": radius}).values.tobytes() == point["tip.velocity"].tobytes()


def test_only_results_that_are_kept_decide_about_the_settings() -> None:
    # The displacement is accurate at once, the velocity is not.
    kept = rod("").sweep(RADII, ["tip.displacement[3]:min"])
    assert kept.attrs["accuracy"].startswith("1 run, ")
    assert rod("").sweep(RADII, ["tip.velocity[3]:min"]).attrs["accuracy"].startswith("2 runs, ")


def test_settings_that_are_not_fine_enough_are_told() -> None:
    with pytest.warns(ancf14.SolverWarning, match="the steps and meshes of the study are not fine enough: tip.velocity is off by"):
        rod(", accuracy = 3e-2").sweep(RADII, ["tip.velocity"], budget=1e-3)


def test_numbers_of_a_point_come_before_those_that_are_found() -> None:
    study = rod("").sweep({"arm.elements": [3, 4, 5]}, ["tip.velocity"])
    assert "settings" not in study.attrs and study.attrs["accuracy"].startswith("1 run, accuracy of the steps reached: ")
    fine = rod("").sweep({"simulation.accuracy": [1e-3, 1e-4]}, ["tip.velocity"])
    assert "arm.elements" in fine.attrs["settings"]
    assert not np.array_equal(fine["tip.velocity"][0], fine["tip.velocity"][1])


def test_samples_keep_their_order() -> None:
    model = swing()
    samples = [{"length": 1.2, "mass": 1}, {"length": 0.8, "mass": 3}, {"length": 1.2, "mass": 1}]
    study = model.sweep(samples, ["bob.displacement[3]:min"])
    assert study["bob.displacement[3]:min"].dims == ("point",)
    assert study["length"].values.tolist() == [1.2, 0.8, 1.2]
    expected = [model.run(sample)["bob.displacement[3]"].min() for sample in samples]
    assert study["bob.displacement[3]:min"].values.tolist() == expected
    assert model.sweep(pandas.DataFrame(samples), ["bob.displacement[3]:min"]).equals(study)


def test_reducers_are_what_they_say() -> None:
    model = swing()
    series = model.run({"length": 1.1})["bob.displacement"]
    names = ["first", "last", "min", "max", "mean", "rms"]
    study = model.sweep({"length": [1.1]}, [f"bob.displacement:{name}" for name in names]).isel(length=0)
    expected = [series[0], series[-1], series.min(0), series.max(0), series.mean(0), np.sqrt((series**2).mean(0))]
    for name, value in zip(names, expected, strict=True):
        assert study[f"bob.displacement:{name}"].values.tobytes() == value.tobytes(), name


def test_functions_of_the_results_have_names() -> None:
    study = swing().sweep({"length": [1.0, 1.1]}, {"swing": span, "rows": lambda r: [len(r.time), 0], "lowest": "bob.displacement[3]:min"})
    assert study["swing"].dims == ("length",) and study["rows"].shape == (2, 2)
    assert study["swing"][1] == span(swing().run({"length": 1.1}))
    assert (study["rows"] == [6, 0]).all()


def test_inputs_and_settings_are_those_of_run() -> None:
    model, push = swing(), {"push.force[3]": np.arange(11.0)}
    study = model.sweep({"mass": [1, 2]}, ["bob.displacement"], stop=0.2, inputs=push)
    own = model.run({"mass": 2}, stop=0.2, inputs=push)
    assert study["bob.displacement"].sel(mass=2).values.tobytes() == own["bob.displacement"].tobytes()


def test_a_point_that_fails_has_its_message_and_the_others_go_on() -> None:
    study = swing().sweep({"mass": [1.0, -1.0, 2.0]}, ["bob.displacement", "bob.displacement[3]:min"])
    assert np.isfinite(study["bob.displacement"].sel(mass=[1, 2])).all()
    assert np.isnan(study["bob.displacement"].sel(mass=-1)).all() and np.isnan(study["bob.displacement[3]:min"].sel(mass=-1))
    assert "mass" in study["error"].sel(mass=-1).item() and study["error"].sel(mass=1).item() == ""


def test_a_function_that_fails_has_its_message() -> None:
    study = swing().sweep({"mass": [1.0]}, {"bad": lambda r: r["nothing"]})
    assert "no column `nothing`" in study["error"].item() and np.isnan(study["bad"]).all()


def test_warnings_of_the_solver_are_kept() -> None:
    study = swing().sweep({"simulation.step": [1e-3, 0.05]}, ["bob.displacement[3]:min"])
    short, long = study["warning"].values
    assert short == "" and "simulation.step = 0.05 s" in long


def test_the_middle_of_a_grid_is_that_of_each_dimension() -> None:
    grid = points({"a": [0, 1, 2, 3], "b": [0, 1, 2], "c": [5]})
    assert grid.parameters(grid.middle()) == {"a": 2, "b": 1, "c": 5}
    samples = points([{"a": 0}, {"a": 1}, {"a": 2}])
    assert samples.middle() == 1


def test_a_middle_point_at_rest_finds_nothing() -> None:
    """A load from -F to F: in the middle nothing moves, and the first point finds the mesh."""
    text = (MODELS / "cantilever.toml").read_text().replace("elements = 8\n", "").replace("step = 1e-3\n", "").replace("-9.81", '"-g"')
    model = ancf14.Model.from_string(text + "[parameters]\ng = 9.81\n")
    study = model.sweep({"g": [-400.0, 0.0, 400.0]}, ["tip.velocity"], stop=0.5)
    assert study.attrs["accuracy"] == model.run({"g": -400.0}, stop=0.5).accuracy


def test_copies_that_a_point_lacks_have_no_mesh() -> None:
    text = """
format = 1
model = { name = "Comb", gravity = [0, 0, -9.81] }
parameters = { teeth = 3 }
material.steel = { young = 2.1e11, poisson = 0.3, density = 7850 }
section.round = { shape = "circle", radius = 0.005 }
copy.all.count = "teeth"
copy.all.beam.tooth = { material = "steel", section = "round", from = [0, "k", 0], to = [1, "k", 0] }
copy.all.joint.root = { type = "weld", a = "ground", b = "tooth.start" }
output.tip = { at = "tooth[1].end", quantities = ["displacement"] }
simulation = { analysis = "static", stop = 1, step = 0.5 }
"""
    model = ancf14.Model.from_string(text)
    for outputs in (["tip.displacement"], {"all": lambda r: r["tip.displacement"]}):
        study = model.sweep({"teeth": [1, 2, 3]}, outputs)
        assert (study["error"] == "").all() and study.attrs["settings"].count("elements") == 2, study


def test_tables_have_one_shape() -> None:
    text = PUSHED.replace("output.tip", 'output.line = { on = "arm", stations = 3, quantities = ["displacement"] }\noutput.tip')
    study = ancf14.Model.from_string(text).sweep([{"line.stations": 3}, {"line.stations": 5}], ["line.displacement:last"])
    assert study["error"].values[0] == "" and "one shape in all runs" in study["error"].values[1]


def told_of(model: ancf14.Model, parameters: dict[str, Any], stop: float | None) -> list[str]:
    """The warnings of a single run."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        model.run(parameters, stop=stop, refine=False, mesh_error=False)
    return [str(warning.message) for warning in caught]


@pytest.mark.parametrize(
    ("key", "values"),
    [
        ("steel.density", [7850, 7.85, 7800, -1, 7850]),
        ("arm.elements", [8, 4, 100, 8]),
        ("arm.strain", ["small", "large", "small"]),
        ("strip.height", [0.005, "strip.width/4", 0.006]),
        ("simulation.step", [1e-3, 2e-3, 1e-3]),
        ("end", [0.02, 0.03, 0.01]),
        ("turn", [0.0, 9.0, 0.5]),
    ],
)
def test_points_do_not_depend_on_those_before_them(key: str, values: list[Any]) -> None:
    """Points of a chunk share an instance where they can: each has the bits and the warnings of a run of its own, also behind one that fails."""
    text = (MODELS / "cantilever.toml").read_text()
    settings: dict[str, Any] = {"stop": 0.02}
    if key == "end":
        # The end of the run is a number of the file.
        text, settings = text.replace("stop = 1.0", 'stop = "end"') + "[parameters]\nend = 0.02\n", {}
    elif key == "turn":
        # So is the mesh.
        text = text.replace("elements = 8", 'pretwist = "turn"') + "[parameters]\nturn = 0.0\n"
    elif key == "simulation.step":
        # And the rows.
        text = text.replace("output_step = 5e-3", "")
    model = ancf14.Model.from_string(text)
    samples = [{key: value} for value in values]
    recipe = Recipe(model, reduced(["tip.velocity:min", "tip.velocity:rms"], model.outputs), settings)
    done = chunk(recipe, range(len(samples)), samples)
    for number, sample in enumerate(samples):
        try:
            own = model.run(sample, stop=settings.get("stop"), refine=False)
        except ancf14.Error as reason:
            assert done.errors[number] == str(reason) and done.values[number] is None
            continue
        found = done.values[number]
        assert done.errors[number] == "" and found is not None
        series = own["tip.velocity"]
        assert found[0].tobytes() == series.min(axis=0).tobytes()
        assert found[1].tobytes() == np.sqrt(np.mean(np.square(series), axis=0)).tobytes()
        notes = [text for text in told_of(model, sample, settings.get("stop")) if "is off by" not in text and "the error of" not in text]
        assert [text for text in done.warnings[number].splitlines() if "is off by" not in text and "the error of" not in text] == notes
    assert any("unusually light" in text for text in done.warnings) or key != "steel.density"


@pytest.mark.parametrize(
    ("space", "outputs", "kind", "words"),
    [
        ({"mas": [1, 2]}, OUTPUTS, ancf14.ModelError, "mass"),
        ({"mass": [1]}, ["bob.displacment:max"], ancf14.VariableError, "bob.displacement"),
        ({"mass": [1]}, ["bob.displacement:maximum"], ancf14.CallError, "max"),
        ({"mass": 1}, OUTPUTS, ancf14.CallError, "[1]"),
        ({"mass": [1, 1]}, OUTPUTS, ancf14.CallError, "twice"),
        ({}, OUTPUTS, ancf14.CallError, "nothing"),
        ({"mass": []}, OUTPUTS, ancf14.CallError, "nothing"),
        ([{"mass": 1}, {"length": 1}], OUTPUTS, ancf14.CallError, "sample 1"),
        ({"mass": [1]}, [], ancf14.CallError, "nothing"),
        ({"mass": [1]}, ["bob.displacement", "bob.displacement"], ancf14.CallError, "name"),
    ],
)
def test_mistakes_are_told_before_the_first_run(space: object, outputs: object, kind: type[Exception], words: str) -> None:
    with pytest.raises(kind) as told:
        swing().sweep(space, outputs)  # type: ignore[arg-type]
    assert words in str(told.value)


def test_whole_series_need_the_same_rows() -> None:
    samples = [{"simulation.stop": 0.1}, {"simulation.stop": 0.2}]
    with pytest.raises(ancf14.CallError, match="the same `stop`"):
        swing().sweep(samples, ["bob.displacement"])
    assert np.isfinite(swing().sweep(samples, ["bob.displacement:last"])["bob.displacement:last"]).all()


def executors() -> dict[str, Executor]:
    return {"one": ThreadPoolExecutor(1), "four": ThreadPoolExecutor(4), "processes": ProcessPoolExecutor(2, get_context("spawn"))}


@pytest.mark.parametrize("name", ["one", "four", "processes"])
def test_executors_change_nothing(name: str) -> None:
    expected = swing().sweep(GRID, [*OUTPUTS, "bob.displacement[3]:min"][:3])
    with executors()[name] as executor:
        assert swing().sweep(GRID, OUTPUTS, executor=executor).equals(expected)


def test_dask_loses_a_worker_and_finishes_with_the_same_bits() -> None:
    grid = {"length": np.linspace(0.5, 1.5, 400)}
    outputs: Any = {"lowest": "bob.displacement[3]:min", "swing": span}
    expected = swing().sweep(grid, outputs)
    killed: list[int] = []
    with cluster() as client:
        workers = list(client.run(os.getpid).values())

        def kill(known: int, _: int) -> None:
            if known >= 20 and not killed:
                killed.append(workers[0])
                os.kill(workers[0], signal.SIGKILL)

        study = swing().sweep(grid, outputs, executor=client.get_executor(), progress=kill)
    assert killed and study.equals(expected)


def test_a_broken_executor_keeps_what_is_known() -> None:
    grid = {"length": np.linspace(0.5, 1.5, 300)}
    executor = ProcessPoolExecutor(1, get_context("spawn"))
    pid = executor.submit(os.getpid).result()

    def kill(known: int, _: int) -> None:
        if known:
            os.kill(pid, signal.SIGKILL)

    with pytest.raises(ancf14.RunError, match="known") as told:
        swing().sweep(grid, ["bob.displacement[3]:min"], executor=executor, store="study.zarr", progress=kill)
    assert told.value.results is not None
    known = np.isfinite(told.value.results["bob.displacement[3]:min"].values).sum()
    assert 0 < known < 300
    resumed: list[int] = []
    study = swing().sweep(grid, ["bob.displacement[3]:min"], store="study.zarr", progress=lambda count, _: resumed.append(count))
    assert resumed[0] == known and resumed[-1] == 300
    assert study.equals(swing().sweep(grid, ["bob.displacement[3]:min"]))


@pytest.mark.parametrize("outputs", [OUTPUTS, ["bob.displacement[3]:min"]])
def test_a_study_goes_on_where_it_ended(outputs: list[str]) -> None:
    model = swing()

    def stop(known: int, _: int) -> None:
        if known >= 5:
            raise KeyboardInterrupt

    with pytest.raises(ancf14.Interrupted, match="the same call goes on"):
        model.sweep(GRID, outputs, store="study.zarr", progress=stop, executor=ThreadPoolExecutor(1))
    counts: list[int] = []
    study = model.sweep(GRID, outputs, store="study.zarr", progress=lambda known, _: counts.append(known))
    assert 5 <= counts[0] < 21 and counts[-1] == 21
    assert study.equals(model.sweep(GRID, outputs))
    # A store that is whole computes nothing, and can be read without this package.
    counts.clear()
    assert model.sweep(GRID, outputs, store="study.zarr", progress=lambda known, _: counts.append(known)).equals(study)
    assert counts == [21]
    stored = xarray.open_zarr("study.zarr", consolidated=False)
    assert stored["bob.displacement[3]:min"].values.tobytes() == study["bob.displacement[3]:min"].values.tobytes()
    assert stored["length"].values.tolist() == np.repeat(GRID["length"], 3).tolist()


def test_messages_are_stored() -> None:
    space = {"mass": [1.0, -1.0], "simulation.step": [1e-3, 0.05]}
    study = swing().sweep(space, ["bob.displacement[3]:min"], store="study.zarr")
    again = swing().sweep(space, ["bob.displacement[3]:min"], store="study.zarr")
    assert "mass" in study["error"].sel(mass=-1)[0].item() and again.equals(study)
    assert (again["warning"] != "").any()


def test_another_study_does_not_mix_with_a_store() -> None:
    swing().sweep({"mass": [1, 2]}, {"swing": span}, store="study.zarr")
    others: list[tuple[ancf14.Model, Any, Any, float | None]] = [
        (swing(), {"mass": [1, 3]}, {"swing": span}, None),
        (swing(), {"mass": [1, 2]}, {"swing": lambda r: 0.0}, None),
        (swing(), {"mass": [1, 2]}, {"swing": span}, 0.2),
        (ancf14.Model.from_string(SWING.replace("-9.81", "-9.80")), {"mass": [1, 2]}, {"swing": span}, None),
    ]
    for model, space, outputs, stop in others:
        with pytest.raises(ancf14.CallError, match="another study"):
            model.sweep(space, outputs, store="study.zarr", stop=stop)
    Path("other").mkdir()
    Path("other/file").write_text("")
    with pytest.raises(ancf14.CallError, match="no store"):
        swing().sweep({"mass": [1]}, {"swing": span}, store="other")


def test_a_study_survives_the_end_of_its_process() -> None:
    script = f"""
import os, ancf14, numpy as np
def leave(known, _):
    if known >= 40:
        os._exit(9)
ancf14.Model.from_string('''{SWING}''').sweep({{"length": np.linspace(0.5, 1.5, 200)}}, ["bob.displacement:min"], store="study.zarr", progress=leave)
"""
    assert subprocess.run([sys.executable, "-c", script], check=False).returncode == 9
    counts: list[int] = []
    grid = {"length": np.linspace(0.5, 1.5, 200)}
    model = swing()
    study = model.sweep(grid, ["bob.displacement:min"], store="study.zarr", progress=lambda known, _: counts.append(known))
    assert 40 <= counts[0] < 200 and study.equals(model.sweep(grid, ["bob.displacement:min"]))


def test_progress_ends_with_all_points() -> None:
    counts: list[tuple[int, int]] = []
    swing().sweep({"mass": np.arange(1.0, 31.0)}, ["bob.displacement:min"], progress=lambda known, total: counts.append((known, total)))
    assert counts[0] == (0, 30) and counts[-1] == (30, 30)
    assert [known for known, _ in counts] == sorted(known for known, _ in counts)
