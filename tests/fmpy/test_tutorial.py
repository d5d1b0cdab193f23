"""Do README.md, docs/first-steps.md and docs/tutorial.md work as they are printed? Each page is followed from an empty folder: its files are saved, its commands are run
in order, and what they print must be the listing on the page. A renamed key, another message or another number would fail here.

A toml, python or sh listing belongs to the page as follows:

- after a line that ends with "`NAME`:", a toml or python listing is the file NAME; if that line begins with "Replace", each section of the listing takes the place
  of the section of the same name in NAME;
- each line of an sh listing is a command; a text listing right after it is what its last command prints;
- wall times differ from run to run and are not compared; a picture in docs/tutorial/ is compared with the file of that name that a command wrote.

ANCF14_BLESS=1 writes the printed listings and the pictures anew.
"""

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

from conftest import ROOT, executable

PAGES = ["README.md", "docs/first-steps.md", "docs/tutorial.md"]
# Commands whose work the fixture, the Rust tests of the front door, or the tests of the release do.
DONE_ELSEWHERE = [
    "sh scripts/build.sh --quick",
    "cargo run --release --example first",
    "pip install ancf14-*_$(uname -m).whl",
    "python heights.py",
]
LISTING = re.compile(r"^```(\w+)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
WALL_TIME = re.compile(r"[\d.e-]+ s wall time, [\d.e-]+ times (faster|slower) than real time")
BLESS = "ANCF14_BLESS" in os.environ


@pytest.fixture(scope="module")
def home(tmp_path_factory) -> Path:
    """A home with the program, installed by the command of README.md."""
    home = tmp_path_factory.mktemp("home")
    (line,) = re.findall(r"^sh scripts/install\.sh .*$", (ROOT / "README.md").read_text(), re.MULTILINE)
    environment = os.environ | {"HOME": str(home), "ANCF14_BUILD": str(executable().resolve().parent)}
    subprocess.run(["sh", "-e", "-c", line], cwd=ROOT, env=environment, check=True)
    assert (home / ".local/bin/ancf14").is_file()
    return home


def sections(text) -> list[str]:
    """The parts of a TOML file, each from its `[header]` on."""
    return re.split(r"^(?=\[)", text, flags=re.MULTILINE)


def replaced(text, listing) -> str:
    """The TOML file `text` with the sections of `listing` in place of its own."""
    parts = sections(text)
    for section in sections(listing)[1:]:
        header = section.splitlines()[0]
        (index,) = [i for i, part in enumerate(parts) if part.startswith(header)]
        parts[index] = section.rstrip("\n") + "\n\n"
    return "".join(parts)


def typed(line, folder, home) -> subprocess.CompletedProcess:
    """`line` as a reader types it."""
    paths = [home / ".local/bin", Path(sys.executable).parent, os.environ["PATH"]]
    environment = os.environ | {"HOME": str(home), "PATH": ":".join(map(str, paths))}
    return subprocess.run(["sh", "-c", line], cwd=folder, env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)


def follow(page, text, folder, home) -> tuple[int, list[tuple[str, slice, str]]]:
    """Does what the page says. Returns the number of commands; and for each whose output is printed: the command, where the output is, what it printed now."""
    ran, compared, last = 0, [], None
    for listing in LISTING.finditer(text):
        kind, body = listing.groups()
        before = text[: listing.start()].rstrip().rsplit("\n", 1)[-1]
        if kind == "sh":
            last = None
            for line in body.splitlines():
                if line not in DONE_ELSEWHERE and "scripts/install.sh" not in line:
                    last = (line, typed(line, folder, home).stdout)
                    ran += 1
        elif kind == "text" and last is not None:
            compared.append((last[0], slice(*listing.span(2)), last[1]))
            last = None
        elif kind in ["toml", "python"]:
            name = re.search(r"`([\w.]+)`:$", before)
            assert name, f"{page}: which file is the listing after {before!r}?"
            file = folder / name[1]
            file.write_text(replaced(file.read_text(), body) if before.startswith("Replace") else body)
    return ran, compared


@pytest.mark.parametrize("page", PAGES)
def test_page_works_as_printed(page, home, tmp_path):
    text = (ROOT / page).read_text()
    ran, compared = follow(page, text, tmp_path, home)
    assert ran >= 3
    if page == "README.md":
        for file in ["rotor.html", "cantilever-results/results.csv", "cantilever.fmu"]:
            assert (tmp_path / file).stat().st_size > 0, file
    else:
        assert len(compared) >= 2
    for command, place, now in reversed(compared):
        same = WALL_TIME.sub("...", now) == WALL_TIME.sub("...", text[place])
        assert same or BLESS, f"{page}: {command} prints\n{now}"
        if not same:
            text = text[: place.start] + now + text[place.stop :]
    for picture in re.findall(r"\(tutorial/([\w.]+)\)", text):
        stored = ROOT / "docs/tutorial" / picture
        if BLESS:
            stored.parent.mkdir(exist_ok=True)
            stored.write_bytes((tmp_path / picture).read_bytes())
        assert stored.read_bytes() == (tmp_path / picture).read_bytes(), f"{picture} is not what the page's commands draw"
    if BLESS:
        (ROOT / page).write_text(text)


def test_commands_of_the_table_run(home, tmp_path):
    text = (ROOT / "docs/first-steps.md").read_text()
    (model,) = [body for kind, body in LISTING.findall(text) if kind == "toml"]
    (tmp_path / "m.toml").write_text(model)
    commands = re.findall(r"^\| `(ancf14 .*?)` \|", text, re.MULTILINE)
    assert len(commands) >= 6
    for command in commands:
        ran = typed(command, tmp_path, home)
        assert ran.returncode == 0, f"{command}: {ran.stdout}"


def test_key_numbers_are_those_of_the_tables():
    accuracy = (ROOT / "docs/accuracy.md").read_text()
    chapter = accuracy.split("## How accurate, how fast")[1].split("\n## ")[0].replace("\n", " ")
    table, text = chapter.split("On one thread")
    summary = (ROOT / "docs/validation.md").read_text().split("## Summary")[1].split("\n## ")[0]
    errors = re.findall(r"\d\.\d+(?: %|e-\d+)|\de-\d+", table)
    assert len(errors) == 6
    for error in errors:
        assert error.removesuffix(" %") in summary, f"{error} is not in docs/validation.md"
    rows = [line.split(" | ") for line in (ROOT / "docs/performance.md").read_text().splitlines() if line.startswith("| ")]
    all_ratios = []
    for case, words in [("rotating shaft, 2.5 s", "rotating shaft"), ("lateral buckling", "lateral buckling"), ("Princeton beam", "Princeton beam")]:
        ratios = [float(row[3]) for row in rows if row[0].startswith(f"| {case}")]
        assert f"{min(ratios):.0f} to {max(ratios):.0f} times less " in text.split(words)[0][-40:], f"{case}: {ratios}"
        all_ratios += ratios
    assert f"{min(all_ratios):.0f} to {max(all_ratios):.0f} times less " in (ROOT / "README.md").read_text()


@pytest.mark.parametrize("page", sorted([*ROOT.glob("*.md"), *ROOT.glob("docs/**/*.md")]), ids=lambda page: str(page.relative_to(ROOT)))
def test_links_lead_somewhere(page):
    text = re.sub(r"^```.*?^```$", "", page.read_text(), flags=re.MULTILINE | re.DOTALL)
    for link in re.findall(r"\]\(([^)\s]+)\)", text):
        path, _, anchor = link.partition("#")
        target = page.parent / path if path else page
        assert link.startswith("https://") or target.exists(), f"{page.name} links to {link}, which is not there"
        if anchor and not link.startswith("https://"):
            titles = re.findall(r"^#+ (.*)$", target.read_text(), re.MULTILINE)
            assert anchor in [re.sub(r"[^\w\- ]", "", title.lower()).replace(" ", "-") for title in titles], link


def test_sections_are_replaced():
    assert replaced("a = 1\n\n[b]\nc = 2\n\n[d]\ne = 3\n", "[b]\nc = 4\n") == "a = 1\n\n[b]\nc = 4\n\n[d]\ne = 3\n"
