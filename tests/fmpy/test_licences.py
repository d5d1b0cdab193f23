"""Are the licences in every FMU those of what is in its library? The committed page must be what scripts/licenses.py makes of Cargo.lock:
a crate that came, went or changed its version makes them differ. FMI 2.0.1 and later want the page at documentation/licenses/license.txt."""

import sys
import zipfile

from conftest import ROOT

sys.path.insert(0, str(ROOT / "scripts"))
import licenses  # noqa: E402

COMMITTED = (ROOT / "licenses/license.txt").read_text()


def test_the_page_is_current():
    assert COMMITTED == licenses.page(), "run target/python-env/bin/python scripts/licenses.py"


def test_every_crate_has_its_text():
    """The names of the list stand above the texts again; the standard library's licence is the MIT one there, too."""
    names = [f"{package['name']} {package['version']}" for package in licenses.linked()]
    assert len(names) > 40 and {name.split()[0] for name in names} >= {"faer", "nalgebra", "toml", "libc", "uuid"}
    headings = [line for line in COMMITTED.split("\n") if any(line.startswith(name) and ": " not in line for name in names)]
    for name in names:
        assert any(name in heading.split(", ") for heading in headings), name


def test_the_fmu_has_it(fmu):
    with zipfile.ZipFile(fmu) as archive:
        assert archive.read("documentation/licenses/license.txt").decode() == COMMITTED
        assert 'href="licenses/license.txt"' in archive.read("documentation/index.html").decode()
