"""Is the gallery that scripts/gallery.py makes whole? Every link of its index leads to a file beside it, so that any static host can serve it, and each model has its page."""

import os
import subprocess
import sys
from html.parser import HTMLParser
from pathlib import Path

from conftest import ROOT, executable


class Links(HTMLParser):
    """All addresses of a page."""

    def __init__(self, text: str):
        super().__init__()
        self.found = []
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        self.found += [value for name, value in attributes if name in ("href", "src", "srcset", "action", "data")]


def gallery(folder: Path) -> Path:
    """The gallery that scripts/release.sh has made, ANCF14_GALLERY, which takes minutes; or one in `folder`."""
    if made := os.environ.get("ANCF14_GALLERY"):
        return Path(made)
    environment = {**os.environ, "ANCF14": str(executable())}
    subprocess.run([sys.executable, ROOT / "scripts/gallery.py", folder], check=True, env=environment)
    return folder


def test_every_link_is_there(tmp_path):
    folder = gallery(tmp_path)
    # The pages play as they open.
    links = [link.removesuffix("#play") for link in Links((folder / "index.html").read_text()).found]
    models = {path.stem for path in ROOT.glob("models/*.toml")}
    # Names alone: no scheme, no folder, nothing of this computer.
    assert sorted(links) == sorted(f"{model}.{kind}" for model in models for kind in ("html", "png"))
    for model in models:
        page = (folder / f"{model}.html").read_text()
        assert page.startswith("<!DOCTYPE html>") and 'id="data"' in page
        assert (folder / f"{model}.png").read_bytes().startswith(b"\x89PNG")
        assert not [link for link in Links(page).found if not link.startswith("data:")], model
    assert {path.stem for path in folder.iterdir()} == {*models, "index"}
