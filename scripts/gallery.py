"""Makes a gallery for any static host: target/gallery/index.html, with a picture and a line for each model of models/, and its page of `ancf14 view`, with the solver if scripts/build-wasm.sh
has built it. All links are relative. The book takes the pages from there (scripts/book.sh).

    scripts/build.sh
    python3 scripts/gallery.py [--live=NAME,...] [FOLDER]

With --live only these pages have the solver, which adds 1.4 MB to each. Pictures and lines are those of docs/gallery.md. ANCF14 names another program than target/fmu/ancf14.
"""

import argparse
import os
import re
import shutil
import subprocess
from html import escape
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
ENTRY = re.compile(r"!\[[^]]*\]\(gallery/(?P<name>\w+)\.png\)<br>\[(?P=name)\]\(\.\./models/(?P=name)\.toml\): (?P<line>[^|]+?) *\|")

PAGE = """\
<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; style-src 'unsafe-inline'; img-src 'self'">
<title>Examples of ancf14</title>
<style>
:root {{ color-scheme: light dark; }}
body {{ margin: 0 auto; padding: 16px; max-width: 1320px; font: 15px/1.45 system-ui, -apple-system, "Segoe UI", Roboto, sans-serif; }}
ul {{ display: grid; grid-template-columns: repeat(auto-fill, minmax(min(300px, 100%), 1fr)); gap: 16px; margin: 0; padding: 0; list-style: none; }}
a {{ display: block; height: 100%; color: inherit; text-decoration: none; border: 1px solid #8884; border-radius: 9px; overflow: hidden; }}
a:hover, a:focus-visible {{ border-color: #1f63c8; outline: none; box-shadow: 0 0 0 1px #1f63c8; }}
img {{ display: block; width: 100%; height: auto; }}
a p {{ margin: 8px 12px 12px; }}
</style>
</head>
<body>
<h1>Examples of ancf14</h1>
<p>{introduction}</p>
<ul>
{cards}
</ul>
</body>
</html>
"""
CARD = '<li><a href="{name}.html#play"><img src="{name}.png" width="620" height="430" loading="lazy" alt=""><p><strong>{name}</strong>: {line}</p></a></li>'
INTRODUCTION = "Each picture leads to a page that shows the mechanism in motion."
LIVE = " {which} the solver: change parameters, and simulate again in the browser."


def entries() -> dict[str, str]:
    """The line of each model."""
    found = {entry["name"]: entry["line"] for entry in ENTRY.finditer((ROOT / "docs/gallery.md").read_text(encoding="utf-8"))}
    models = {path.stem for path in ROOT.glob("models/*.toml")}
    if found.keys() != models:
        raise SystemExit(f"docs/gallery.md and models/ differ: {', '.join(sorted(found.keys() ^ models))}; give each model a picture and a line")
    return found


def main(folder: Path, chosen: list[str] | None):
    program = Path(os.environ.get("ANCF14", ROOT / "target/fmu/ancf14")).resolve()
    lines = entries()
    if unknown := set(chosen or []) - lines.keys():
        raise SystemExit(f"--live: there is no model {', '.join(sorted(unknown))}; the models are {', '.join(lines)}")
    has_solver = program.with_name("ancf14.wasm").exists()
    live = [name for name in lines if has_solver and (chosen is None or name in chosen)]
    folder.mkdir(parents=True, exist_ok=True)
    for name in lines:
        model = ROOT / "models" / f"{name}.toml"
        command = [program, "--quiet", "view", model, "-o", folder / f"{name}.html", *(["--live"] if name in live else [])]
        # Warnings about a model, such as a limit point that it is to show, are no news here.
        done = subprocess.run(command, capture_output=True, text=True)
        if done.returncode != 0:
            raise SystemExit(f"{name}: {done.stderr}")
        shutil.copy(ROOT / "docs/gallery" / f"{name}.png", folder)
    cards = "\n".join(CARD.format(name=name, line=escape(line)) for name, line in lines.items())
    which = "All have" if len(live) == len(lines) else f"Those of {', '.join(live)} have"
    introduction = INTRODUCTION + (LIVE.format(which=which) if live else "")
    (folder / "index.html").write_text(PAGE.format(introduction=introduction, cards=cards), encoding="utf-8")
    print(f"{len(lines)} models: open {folder / 'index.html'} in a browser")


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description="Makes a gallery of all models, whose pictures lead to pages that move.")
    parser.add_argument("folder", nargs="?", type=Path, default=ROOT / "target/gallery")
    parser.add_argument("--live", type=lambda names: names.split(","), help="the only models whose pages have the solver")
    words = parser.parse_args()
    main(words.folder, words.live)
