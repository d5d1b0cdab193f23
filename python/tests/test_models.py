"""Do the variables, modes, drawings, FMUs and tables of a model say what the command line says?"""

import csv
import html
import pickle
import re
import sys
import zipfile
from pathlib import Path

import ancf14
import numpy as np
import pytest

from conftest import MODELS, ROOT, program
from test_runs import PUSHED

CANTILEVER = MODELS / "cantilever.toml"
ROD = """
format = 1
[model]
name = "Rod"
[material.steel]
young = 2.1e11
poisson = 0.3
density = 7850
[section.rod]
shape = "circle"
radius = 0.01
[beam.arm] # the rod
material = "steel"
section = "rod"
from = [0, 0, 0]
to = [1, 0, 0] # m
[joint.root]
type = "weld"
a = "ground"
b = "arm.start"
[load.push]
at = "arm.end"
force = [0, 0, "3e5*t"]
[output.tip]
at = "arm.end"
quantities = ["displacement"]
[simulation]
analysis = "static"
stop = 1
step = 0.25
"""
"""A rod that a force bends to a hook: 8 elements are not enough."""


def test_variables_have_values_units_and_bounds() -> None:
    model = ancf14.Model.from_string(PUSHED)
    density = model.parameters["steel.density"]
    assert (density.value, density.unit, density.kind) == (7850, "kg/m3", "parameter") and density.description
    assert model.parameters["arm.elements"].bounds == (1, 100_000) and density.bounds == (None, None)
    assert model.inputs["push.force[3]"].unit == "N" and model.inputs["push.force[3]"].kind == "input"
    assert model.outputs["tip.displacement[1]"].value is None
    assert list(model.outputs) == model.run().columns
    assert "Pushed" in repr(model)


def test_the_version_is_that_of_the_workspace() -> None:
    import tomllib

    workspace = tomllib.loads((ROOT / "Cargo.toml").read_text())
    assert ancf14.__version__ == workspace["workspace"]["package"]["version"]
    assert program(Path.cwd(), "--version").stdout == f"ancf14 {ancf14.__version__}\n"


def test_modes_are_those_of_the_command_line() -> None:
    assert program(Path.cwd(), "modes", str(CANTILEVER), "--count", "4", "-o", "out").returncode == 0
    with open("out/modes.csv", newline="") as table:
        rows = list(csv.DictReader(table))
    modes = ancf14.Model(CANTILEVER).modes(4)
    assert len(modes) == len(rows) == 4
    for name in ("angular_frequency", "growth_rate", "eigenvalue", "modal_mass", "damping_ratio", "mesh_error", "shear"):
        assert getattr(modes, name).tolist() == [float(row[name]) for row in rows], name
    assert modes.kind == [row["kind"] for row in rows] and modes.largest == [row["moves"] for row in rows]
    assert modes.displacement.shape == (4, len(modes.places), 3) == modes.rotation.shape
    assert np.abs(modes.displacement).max() == pytest.approx(1, rel=1e-12)  # scaled so
    assert modes.position.shape == (len(modes.places), 3)


def test_pictures_and_fmus_have_the_bytes_of_the_command_line() -> None:
    assert program(Path.cwd(), "check", str(CANTILEVER), "--draw", "drawn.svg").returncode == 0
    picture = ancf14.Model(CANTILEVER).draw("own.svg")
    assert Path("own.svg").read_bytes() == Path("drawn.svg").read_bytes() and picture._repr_svg_() == picture.svg
    packed = program(Path.cwd(), "pack", str(CANTILEVER), "-o", "packed.fmu")
    assert packed.returncode == 0, packed.stderr
    path = ancf14.Model(CANTILEVER).pack("own.fmu")
    assert path.read_bytes() == Path("packed.fmu").read_bytes()
    packed = program(Path.cwd(), "pack", str(CANTILEVER), "--fmi", "3", "-o", "packed3.fmu")
    assert packed.returncode == 0, packed.stderr
    path = ancf14.Model(CANTILEVER).pack("own3.fmu", fmi=3)
    assert path.read_bytes() == Path("packed3.fmu").read_bytes()
    with pytest.raises(ancf14.CallError, match="2 or 3"):
        ancf14.Model(CANTILEVER).pack("own.fmu", fmi=1)
    with pytest.raises(ancf14.CallError, match="without parameters"):
        ancf14.Model(CANTILEVER, {"arm.elements": 2}).pack("own.fmu")


def test_an_fmu_runs_on_every_platform_of_the_wheel() -> None:
    package = Path(ancf14.__file__).parent
    path = ancf14.Model(CANTILEVER).pack("own.fmu", fmi=3)
    with zipfile.ZipFile(path) as archive:
        packed = {name.split("/")[1]: archive.read(name) for name in archive.namelist() if name.startswith("binaries/")}
    others = {file.parent.name: file.read_bytes() for file in package.glob("*-*/*ancf14.*")}
    assert packed == others | {"x86_64-linux": (package / "libancf14.so").read_bytes()}


def test_results_become_tables_plots_and_a_page() -> None:
    results = ancf14.Model.from_string(PUSHED).run()
    frame = results.to_pandas()
    assert list(frame.columns) == results.columns and frame.index.name == "time"
    assert (frame["tip.displacement[3]"].to_numpy() == results["tip.displacement[3]"]).all()
    data = results.to_xarray()
    assert data["tip.displacement"].dims == ("time", "axis") and data["tip.displacement"].attrs["units"] == "m"
    assert (data["tip.displacement"].sel(axis="z").to_numpy() == results["tip.displacement[3]"]).all()
    assert len(results.plot("tip.displacement").lines) == 3
    page = results.view("page.html")
    assert Path(page).read_text() == page.html and page.html.startswith("<!") and "Pushed" in page.html


def test_a_page_shows_the_run_that_has_the_results() -> None:
    """A run that was repeated with finer steps and meshes: the page has its elements, as that of the command line."""
    Path("rod.toml").write_text(ROD)
    done = program(Path.cwd(), "run", "rod.toml", "-o", "out", "--view")
    assert done.returncode == 0, done.stderr
    results = ancf14.Model("rod.toml").run()
    assert results.accuracy.startswith("2 runs, 16 elements")
    assert results.view("page.html").html == Path("out/view.html").read_text()


def test_a_file_keeps_its_ends_of_lines() -> None:
    """As the program packs it: the GUID of an FMU is that of the text."""
    Path("rod.toml").write_text(ROD, newline="\r\n")
    packed = program(Path.cwd(), "pack", "rod.toml", "-o", "packed.fmu", "--no-refine")
    assert packed.returncode == 0, packed
    assert ancf14.Model("rod.toml").pack("own.fmu", refine=False).read_bytes() == Path("packed.fmu").read_bytes()


def test_units_have_the_elements_that_were_found() -> None:
    Path("rod.toml").write_text(ROD)
    model = ancf14.Model("rod.toml")
    packed = program(Path.cwd(), "pack", "rod.toml", "-o", "packed.fmu")
    assert packed.returncode == 0 and "elements = 16" in packed.stdout, packed
    assert model.pack("own.fmu").read_bytes() == Path("packed.fmu").read_bytes()
    packed = program(Path.cwd(), "pack", "rod.toml", "-o", "first.fmu", "--no-refine")
    assert packed.returncode == 0, packed
    first = model.pack("own.fmu", refine=False).read_bytes()
    assert first == Path("first.fmu").read_bytes() != Path("packed.fmu").read_bytes()
    # Numbers that only a host asks for are found with its inputs.
    pushed = ancf14.Model.from_string(ROD.replace('[0, 0, "3e5*t"]', "[0, 0, 0]\ninput = true"))
    pushed.pack("own.fmu", inputs={"push.force[3]": lambda time: 4e5 * time})
    with zipfile.ZipFile("own.fmu") as unit:
        assert "elements = 16" in unit.read("resources/model.toml").decode()
    with pytest.raises(ancf14.CallError, match="leave out inputs"):
        ancf14.Model(CANTILEVER).pack("own.fmu", inputs={})


def test_notebooks_show_the_page(monkeypatch: pytest.MonkeyPatch) -> None:
    opened: list[str] = []
    monkeypatch.setattr("webbrowser.open", opened.append)
    results = ancf14.Model.from_string(PUSHED).run()
    page = results.view()
    assert opened == [page.path.as_uri()]
    monkeypatch.setitem(sys.modules, "ipykernel", sys)
    page = results.view()
    assert len(opened) == 1
    # What a browser takes from the frame is the page, letter by letter.
    frame = re.fullmatch(r'<iframe srcdoc="([^"]*)"[^>]*></iframe>', page._repr_html_())
    assert frame and html.unescape(frame[1]) == page.html


@pytest.mark.parametrize(("package", "method"), [("pandas", "to_pandas"), ("xarray", "to_xarray")])
def test_missing_packages_are_named(monkeypatch: pytest.MonkeyPatch, package: str, method: str) -> None:
    results = ancf14.Model.from_string(PUSHED).run()
    monkeypatch.setitem(sys.modules, package, None)
    with pytest.raises(ImportError, match=f"pip install {package}"):
        getattr(results, method)()


def test_exit_codes_are_those_of_the_program() -> None:
    assert program(Path.cwd(), "run", "nowhere.toml").returncode == 2
    assert program(Path.cwd(), "--help").returncode == 0


def test_included_files_lie_in_the_folder_of_the_model(tmp_path: Path) -> None:
    folder = tmp_path / "models"
    folder.mkdir()
    (folder / "pull.csv").write_text("time,force\n0,1\n1,3\n")
    (tmp_path / "pull.csv").write_text("time,force\n0,1\n1,3\n")
    text = """format = 1
[model]
name = "Pull"
[function.pull]
file = "FILE"
[body.b]
mass = 1
position = [0, 0, 0]
inertia = [1, 1, 1]
[load.l]
at = "b"
force = ["pull(t)", 0, 0]
[output.b_motion]
at = "b"
quantities = ["velocity"]
[simulation]
stop = 1
"""
    (folder / "inside.toml").write_text(text.replace("FILE", "pull.csv"))
    (folder / "outside.toml").write_text(text.replace("FILE", "../pull.csv"))
    inside = ancf14.Model(folder / "inside.toml")
    with pytest.raises(ancf14.ModelError, match="outside of the folder of the model file"):
        ancf14.Model(folder / "outside.toml")
    outside = ancf14.Model(folder / "outside.toml", allow_outside=True)
    # The impulse of the line, 2 N s; the table is a straight line, which steps take exactly.
    for model in (inside, outside, pickle.loads(pickle.dumps(outside))):
        assert abs(model.run()["b_motion.velocity[1]"][-1] - 2) < 1e-9
    with pytest.raises(ancf14.ModelError, match="without a folder"):
        ancf14.Model.from_string(text.replace("FILE", "pull.csv"))


def test_mistakes_in_parameters_are_shown_as_parameters() -> None:
    with pytest.raises(ancf14.ModelError) as caught:
        ancf14.Model(CANTILEVER, {"arm.elemnts": 4})
    message = str(caught.value)
    assert "command line" not in message and "--set" not in message
    # The underline stands below the wrong word.
    lines = message.splitlines()
    place = next(number for number, line in enumerate(lines) if "arm.elemnts=4" in line)
    assert "in the changes to the model file" in message and lines[place + 1].index("^") == lines[place].index("arm.elemnts")
