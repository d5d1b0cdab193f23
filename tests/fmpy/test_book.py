"""Does the book work from disk, as a release has it? Its search must find pages, formulas must be there without a script, and no page may name what it would load from the net.

scripts/book.sh builds the book; it ends with an error where a link or an anchor leads nowhere.
"""

import os
import re
import subprocess
from pathlib import Path

import pytest

from conftest import ROOT

BROWSERS = [os.environ.get("CHROMIUM", ""), "/usr/bin/chromium", "/usr/bin/chromium-browser", "/usr/bin/google-chrome"]


@pytest.fixture(scope="module")
def book() -> Path:
    folder = Path(os.environ.get("CARGO_TARGET_DIR", ROOT / "target")) / "book"
    if not (folder / "index.html").is_file():
        subprocess.run([ROOT / "scripts/book.sh"], check=True)
    return folder


def test_the_search_finds_pages_from_disk(book):
    browser = next(path for path in BROWSERS if path and Path(path).is_file())
    page = f"file://{book}/index.html?q=capstan"
    options = ["--headless", "--no-sandbox", "--disable-gpu", "--virtual-time-budget=15000", "--dump-dom"]
    shown = subprocess.run([browser, *options, page], capture_output=True, text=True, check=True, timeout=120).stdout
    found = re.findall(r'<a href="([^"?]*)[^"]*" class="md-search-result__link"', shown)
    assert f"file://{book}/language/contact.html" in found, found


def test_formulas_are_there(book):
    text = (book / "theory/kinematics.html").read_text()
    assert text.count("<math ") > 100
    assert "arithmatex" not in text and "\\(" not in text


def test_every_page_of_the_repository_is_a_page_of_the_book(book):
    pages = [path.relative_to(ROOT / "docs").with_suffix(".html") for path in ROOT.glob("docs/**/*.md")]
    assert len(pages) > 50
    assert [str(page) for page in pages if not (book / page).is_file()] == []
