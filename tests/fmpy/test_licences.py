"""Are the licences in every FMU those of what is in its library, and those beside the program of what is in that, and those in a page with the solver of what is in the solver? The committed pages must be what scripts/licenses.py makes of Cargo.lock:
a crate that came, went or changed its version makes them differ. FMI 2.0.1 and later want the page at documentation/licenses/license.txt."""

import sys
import zipfile

import pytest
from conftest import ROOT

sys.path.insert(0, str(ROOT / "scripts"))
import licenses  # noqa: E402

COMMITTED = {page: (ROOT / "licenses" / page).read_text() for page in licenses.PAGES}


@pytest.mark.parametrize("page", licenses.PAGES)
def test_the_page_is_current(page):
    assert COMMITTED[page] == licenses.text(page), "run target/python-env/bin/python scripts/licenses.py"


@pytest.mark.parametrize(
    ("page", "some"),
    [
        ("license.txt", {"faer", "nalgebra", "toml", "libc", "uuid"}),
        ("program.txt", {"faer", "clap", "pyo3", "plotters"}),
        ("solver.txt", {"faer", "nalgebra", "miniz_oxide", "serde_json"}),
    ],
)
def test_every_crate_has_its_text(page, some):
    """The names of the list stand above the texts again; the standard library's licence is the MIT one there, too."""
    names = [f"{package['name']} {package['version']}" for package in licenses.linked(page)]
    assert len(names) > 40 and {name.split()[0] for name in names} >= some
    headings = [line for line in COMMITTED[page].split("\n") if any(line.startswith(name) and ": " not in line for name in names)]
    for name in names:
        assert any(name in heading.split(", ") for heading in headings), name


def test_the_fmu_has_it(fmu):
    with zipfile.ZipFile(fmu) as archive:
        assert archive.read("documentation/licenses/license.txt").decode() == COMMITTED["license.txt"]
        assert 'href="licenses/license.txt"' in archive.read("documentation/index.html").decode()
