"""Does VTK itself, the library in ParaView and PyVista, read what `ancf14 export` writes, and does it find the numbers of results.csv there?

Both come from one state of the solver, by the same functions of a section, a joint or a body: they differ by the rounding of a few sums, EPS of the largest number in such a sum.
"""

import csv
import math
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest
from conftest import ROOT, run
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkDataArray
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

# Sums have less than ten terms, each with a relative rounding of 1.1e-16.
EPS = 10 * 1.1e-16


class Piece:
    """What VTK finds in a file."""

    def __init__(self, file: Path):
        complaints = []
        reader = vtkXMLPolyDataReader()
        reader.AddObserver("ErrorEvent", lambda *event: complaints.append(event))
        reader.AddObserver("WarningEvent", lambda *event: complaints.append(event))
        assert reader.CanReadFile(str(file)), file
        reader.SetFileName(str(file))
        reader.Update()
        self.data = reader.GetOutput()
        assert not complaints and self.data.GetNumberOfPoints() > 0, file
        self.points = vtk_to_numpy(self.data.GetPoints().GetData())
        (self.time,) = vtk_to_numpy(self.data.GetFieldData().GetArray("TimeValue"))

    def __getitem__(self, name) -> np.ndarray:
        """An array over the points, or else over the cells."""
        arrays = self.data.GetPointData() if self.data.GetPointData().HasArray(name) else self.data.GetCellData()
        found = arrays.GetAbstractArray(name)
        if found.IsA("vtkStringArray"):
            return np.array([found.GetValue(number) for number in range(found.GetNumberOfValues())])
        return vtk_to_numpy(found)

    def unit(self, name) -> str | None:
        return self.data.GetPointData().GetArray(name).GetInformation().Get(vtkDataArray.UNITS_LABEL())

    def cell(self, number) -> list[int]:
        points = self.data.GetCell(number).GetPointIds()
        return [points.GetId(place) for place in range(points.GetNumberOfIds())]


class Exported:
    """A model of models/, or of a file, simulated into results.csv and into files of VTK."""

    def __init__(self, model: str | Path, folder: Path, *words):
        self.folder = folder / "vtk"
        file = ROOT / "models" / f"{model}.toml" if isinstance(model, str) else model
        run("run", file, "-o", folder / "results", *words)
        run("export", file, "--vtk", self.folder, *words)
        with open(folder / "results" / "results.csv", newline="") as file:
            names, *rows = csv.reader(file)
        self.columns = {name: [float(row[place]) for row in rows] for place, name in enumerate(names)}

    def series(self, kind: str) -> list[Piece]:
        """The files that the list of a kind names, each at the time that the list says."""
        pieces = []
        for entry in ElementTree.parse(self.folder / f"{kind}.pvd").getroot().iter("DataSet"):
            pieces.append(Piece(self.folder / entry.get("file")))
            assert pieces[-1].time == float(entry.get("timestep"))
        assert [piece.time for piece in pieces] == self.columns["time"]
        return pieces

    def vector(self, name: str) -> np.ndarray:
        """Rows of the three components of an output."""
        return np.array([self.columns[f"{name}[{axis}]"] for axis in (1, 2, 3)]).T


def close(found, expected, size=0.0):
    """Whether both agree to the rounding of sums of numbers up to `size`, or up to the largest one."""
    found, expected = np.asarray(found), np.asarray(expected)
    assert found.shape == expected.shape
    bound = EPS * max(size, np.abs(expected).max())
    assert np.abs(found - expected).max() <= bound, (np.abs(found - expected).max(), bound)


@pytest.fixture(scope="module")
def cantilever(tmp_path_factory) -> Exported:
    return Exported("cantilever", tmp_path_factory.mktemp("cantilever"), "--set", "simulation.stop=0.1")


@pytest.fixture(scope="module")
def four_bar(tmp_path_factory) -> Exported:
    return Exported("four_bar", tmp_path_factory.mktemp("four_bar"), "--set", "simulation.stop=0.2")


@pytest.fixture(scope="module")
def crane(tmp_path_factory) -> Exported:
    return Exported("crane", tmp_path_factory.mktemp("crane"), "--set", "simulation.stop=0.1", "--set", "foot.input=false", "--set", 'foot.position[1]="0.2*t"')


def test_a_beam_is_where_its_outputs_are(cantilever):
    beams = cantilever.series("beams")
    displacement = cantilever.vector("tip.displacement")
    close([piece["displacement"][-1] for piece in beams], displacement, 1.0)
    close([piece.points[-1] for piece in beams], displacement + [1.0, 0.0, 0.0], 1.0)
    assert np.abs(displacement).max() > 0.01, "nothing moves"
    close([piece["curvature_y"][0] for piece in beams], cantilever.columns["root_section.curvature[1]"])
    close([piece["speed"][-1] for piece in beams], np.linalg.norm(cantilever.vector("tip.velocity"), axis=1))
    for piece in beams:
        assert piece.data.GetNumberOfLines() == 1 and piece.cell(0) == list(range(len(piece.points)))
        assert list(piece["name"]) == ["arm"] and piece["fraction"][0] == 0 and piece["fraction"][-1] == 1
    assert beams[0].unit("curvature_y") == "1/m" and beams[0].unit("speed") == "m/s" and beams[0].unit("axial_strain") is None


def test_places_are_global(tmp_path):
    """Far from the origin the solver counts from the middle of the system; files have global places."""
    far = Exported("crane", tmp_path, "--set", "simulation.stop=0.1", *(
        word for part, x in (("foot.position", 1e6), ("boom.from", 1e6), ("boom.to", 1e6 + 4.5), ("rope.from", 1e6 + 4.5), ("rope.to", 1e6 + 4.5), ("load.position", 1e6 + 4.5), ("hook.at", 1e6 + 4.5))
        for word in ("--set", f"{part}[1]={x}")))
    close([piece.points.mean(axis=0) for piece in far.series("bodies")], far.vector("load_motion.position"))
    tips = [piece.points[piece.cell(0)[-1]] for piece in far.series("beams")]
    close(tips, far.vector("boom_tip.position"))
    assert tips[0][0] > 1e6


def test_sections_have_their_size_and_their_axes(cantilever):
    width, height = 0.02, 0.005
    for piece in cantilever.series("beams"):
        close(piece["half_size"], np.tile([width / 2, height / 2], (len(piece.points), 1)))
        close(piece["radius"], np.full(len(piece.points), math.sqrt(width * height) / 2))
        axes = np.stack([piece[name] for name in ("axis_x", "axis_y", "axis_z")], axis=1)
        close(axes @ axes.transpose(0, 2, 1), np.broadcast_to(np.eye(3), axes.shape))
        close(np.linalg.det(axes), np.ones(len(axes)))
        # Sections stand across the beam, which is drawn along x and bends in the plane of x and z.
        lines = np.gradient(piece.points, piece["fraction"], axis=0)
        lines /= np.linalg.norm(lines, axis=1)[:, None]
        # Differences over 1/64 of a beam that bends by less than 1 rad are off by less than (1/64)²/2 inside, and 1/128 at the ends.
        assert np.abs(axes[:, 0] - lines).max() < 1 / 128


def test_sections_carry_what_results_say(four_bar):
    beams = four_bar.series("beams")
    (rocker,) = [number for number, name in enumerate(beams[0]["name"]) if name == "rocker"]
    at = lambda piece: [point for point in piece.cell(rocker) if piece["fraction"][point] == 0.5][0]
    force = [[piece[name][at(piece)] for name in ("axial_force", "shear_y", "shear_z")] for piece in beams]
    close(force, four_bar.vector("rocker_load.section_force"))
    assert np.ptp(force) > 1, "no force"
    moments = [[piece[name][at(piece)] for name in ("torque", "moment_y", "moment_z")] for piece in beams]
    close(moments, four_bar.vector("rocker_load.section_moment"))
    close([piece["stress"][at(piece)] for piece in beams], four_bar.columns["rocker_load.stress"])


def test_joints_have_their_reactions(four_bar):
    joints = four_bar.series("joints")
    (pivot,) = np.flatnonzero(joints[0]["name"] == "rocker_pivot")
    close([piece["force"][pivot] for piece in joints], four_bar.vector("rocker_side.reaction_force"))
    close([piece["moment"][pivot] for piece in joints], four_bar.vector("rocker_side.reaction_moment"))


def test_bodies_are_closed_and_where_their_outputs_are(crane):
    bodies = crane.series("bodies")
    position = crane.vector("load_motion.position")
    close([piece.points.mean(axis=0) for piece in bodies], position)
    assert np.ptp(position, axis=0).max() > 1e-5, "nothing moves"
    for piece in bodies:
        assert piece.data.GetNumberOfPolys() == 6 and set(piece["name"]) == {"load"} and set(piece["mass"]) == {500.0}


BOB = """format = 1
[model]
name = "Bob"
gravity = [5, 0, -9.81]
[body.bob]
mass = 1.0
position = [0, 0, -1]
inertia = [0.1, 0.2, 0.25]
[joint.hinge]
type = "revolute"
a = "ground"
b = "bob"
at = [0, 0, 0]
axis = [0, 1, 0]
[output.place]
at = "bob"
quantities = ["position"]
[simulation]
stop = 0.5
step = 0.01
"""


def test_bodies_turn(tmp_path):
    """A body on a hinge at the origin turns about y like the line from the hinge to its center. Its box has the edges of its inertia: 12/m times half the sum of two moments minus the third."""
    (tmp_path / "bob.toml").write_text(BOB)
    bob = Exported(tmp_path / "bob.toml", tmp_path)
    pieces, places = bob.series("bodies"), bob.vector("place.position")
    corners = pieces[0].points - places[0]
    moments = np.array([0.1, 0.2, 0.25])
    edges = np.sqrt(12 * (moments.sum() / 2 - moments))
    close(np.sort(np.ptp(corners, axis=0)), np.sort(edges), 1.0)
    for piece, (x, _, z) in zip(pieces, places):
        turn = np.array([[-z, 0, -x], [0, 1, 0], [x, 0, -z]])
        # Newton's corrections end at 1e-10 of the size, far above rounding.
        assert np.abs(piece.points - corners @ turn.T - [x, 0, z]).max() < 1e-8
    assert abs(places[-1][0]) > 0.2, "nothing turns"


def test_a_corner_begins_another_line(tmp_path):
    """At a corner of a beam two sections stand at one place, across different pieces: a line through both would have no direction there."""
    bar = Exported(ROOT / "tests/machines/anti_roll_bar.toml", tmp_path)
    for piece in bar.series("beams"):
        lines = [piece.cell(number) for number, name in enumerate(piece["name"]) if name == "bar"]
        assert len(lines) == 3 and set(piece["beam"]) == {0}
        for before, after in zip(lines, lines[1:]):
            assert before[-1] + 1 == after[0] and piece["fraction"][before[-1]] == piece["fraction"][after[0]]
            close(piece.points[before[-1]], piece.points[after[0]])
        for line in lines:
            assert np.linalg.norm(np.diff(piece.points[line], axis=0), axis=1).min() > 0


def test_loads_are_what_the_file_says(tmp_path):
    elastica = Exported("elastica", tmp_path / "elastica", "--set", "unit_force=2.5")
    for piece in elastica.series("loads"):
        close(piece["force"], [[0.0, 2.5 * piece.time, 0.0]], 1.0)
    assert piece.time == 10 and piece.unit("force") == "N"
    # A load along a beam is per length.
    blade = Exported("blade", tmp_path / "blade", "--set", "simulation.stop=0.05", "--set", 'wind.force[1]="300*t"')
    for piece in blade.series("line_loads"):
        close(piece["force"], np.tile([300 * piece.time, 0.0, 0.0], (len(piece.points), 1)), 1.0)
    assert piece.unit("force") == "N/m" and not (blade.folder / "loads.pvd").exists()


def test_stress_that_nobody_knows_is_no_number(tmp_path):
    wheel = Exported("bicycle_wheel", tmp_path, "--set", "simulation.stop=0.1")
    for piece in wheel.series("beams"):
        for number, name in enumerate(piece["name"]):
            assert np.isnan(piece["stress"][piece.cell(number)]).all() == (name == "rim"), name
