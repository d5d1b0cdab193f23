"""Hooks of MkDocs that make the book from the pages as they are in the repository (mkdocs.yml).

- Pages in the root of the repository join the book in the folder `project`.
- A link to another file of the repository leads to a copy of that file in the folder `files`; a link to a folder becomes plain text.
- Headings have the anchors that forges give them.
- Pictures of the gallery lead to pages that move, where scripts/gallery.py has made them with the program of these sources.
- Formulas become MathML, so that they need no script. A formula that is not understood ends the build.
"""

import html
import os
import posixpath
import re
from pathlib import Path
from xml.etree import ElementTree

from latex2mathml.converter import convert
from mkdocs.exceptions import PluginError
from mkdocs.structure.files import File

MATH = "{http://www.w3.org/1998/Math/MathML}"
ElementTree.register_namespace("", MATH.strip("{}"))

ROOT = Path(__file__).resolve().parents[2]
# Pages outside of docs/, and where the book has them.
PROJECT = {
    "README.md": "index.md",
    "ARCHITECTURE.md": "project/architecture.md",
    "CONTRIBUTING.md": "project/contributing.md",
    "SECURITY.md": "project/security.md",
    "STYLE.md": "project/style.md",
}
# Files that the theme needs beside its own.
ASSETS = ["book.css", "iframe-worker.js"]
# A listing, code within a line, or a link: code stays as it is.
LINK = re.compile(r"^```.*?^```|`[^`\n]+`|(!?\[(?:`[^`]*`|[^\]`])*\]\()([^)\s]+)\)", re.MULTILINE | re.DOTALL)
# A picture of the gallery.
PICTURE = re.compile(r"!\[[^]]*\]\(gallery/(\w+)\.png\)")
FORMULA = re.compile(r'<(span|div) class="arithmatex">\\([(\[])(.*?)\\[)\]]</\1>', re.DOTALL)
TAG = re.compile(r"\\tag\{([^{}]*)\}")
PRIMES = {"\u2032", "\u2033", "\u2034"}
# The letters of an upright word, each an identifier of its own.
WORD = re.compile(r'<mrow>(<mi mathvariant="normal">\w</mi>(?:<m[in](?: mathvariant="normal")?>\w+</m[in]>)+)</mrow>')


def anchor(title: str, separator: str) -> str:
    """The anchor of a heading on a forge."""
    return re.sub(r"[^\w\- ]", "", title.lower()).replace(" ", separator)


def linked(folder: str, link: str) -> tuple[str | None, str]:
    """The path in the repository that `link` of a page in `folder` names, if it names one; and the anchor."""
    path, mark, rest = link.partition("#")
    if not path or "://" in link or link.startswith("mailto:"):
        return None, mark + rest
    return posixpath.normpath(posixpath.join(folder, path)), mark + rest


def in_book(path: str) -> str | None:
    """Where the book has the file `path` of the repository; none for a folder and for a file that does not exist."""
    if path in PROJECT:
        return PROJECT[path]
    if path.startswith("docs/"):
        return path.removeprefix("docs/")
    # Another page would be one of the book.
    return f"files/{path}{'.txt' if path.endswith('.md') else ''}" if (ROOT / path).is_file() else None


def rewritten(text: str, folder: str, page: str) -> str:
    """The links of `text`, from a file in `folder` of the repository, as they must be in `page` of the book."""

    def replace(match: re.Match[str]) -> str:
        if match[1] is None:
            return match[0]
        path, rest = linked(folder, match[2])
        if path is None:
            return match[0]
        target = in_book(path)
        if target is None:
            return match[1].removeprefix("[").removesuffix("](") if (ROOT / path).is_dir() else match[0]
        return f"{match[1]}{posixpath.relpath(target, posixpath.dirname(page) or '.')}{rest})"

    return LINK.sub(replace, text)


def moving() -> dict[str, Path]:
    """The pages that move, by the names of their models. A page of other sources is left out: its first comment has a hash of the program in it."""
    folder = os.environ.get("ANCF14_GALLERY")
    if not folder:
        return {}
    mark = (ROOT / "viewer/dist/viewer.js").read_text(encoding="utf-8").partition("\n")[0]
    pages = [page for page in sorted(Path(folder).glob("*.html")) if page.stem != "index"]
    return {page.stem: page for page in pages if mark in page.read_text(encoding="utf-8")}


def lower_prime(element: ElementTree.Element) -> None:
    """Sets a prime beside its letter: fonts draw it high and small, and as an exponent it would be raised and made smaller once more."""
    if element.tag not in {f"{MATH}msup", f"{MATH}msubsup"} or element[-1].text not in PRIMES:
        return
    base, prime = element[0], element[-1]
    prime.tag, prime.attrib = f"{MATH}mo", {"form": "postfix", "stretchy": "false", "lspace": "0", "rspace": "0"}
    row = ElementTree.Element(f"{MATH}mrow")
    row.extend([base, prime])
    element.remove(prime)
    if element.tag == f"{MATH}msubsup":
        element.tag = f"{MATH}msub"
        element[0] = row
    else:
        element.tag = f"{MATH}mrow"
        element[:] = [row]


def mathml(formula: str, display: str) -> str:
    """The formula, written in LaTeX, as MathML."""
    # Markdown of forges takes two strokes for one, so that the pages end rows with \\cr; the converter knows other names of both.
    text = formula.replace("\\cr", "\\\\").replace("{aligned}", "{align*}")
    converted = convert(text, display=display)
    # A command or a mark that is not known would appear as text.
    if "\\" in converted or "<mi>&</mi>" in converted:
        raise ValueError(converted)
    # Strokes around a value have no space inside.
    converted = converted.replace("<mo>&#x0007C;</mo>", '<mo stretchy="false" lspace="0" rspace="0">|</mo>')
    tree = ElementTree.fromstring(WORD.sub(lambda word: f"<mi>{re.sub('<[^>]*>', '', word[1])}</mi>", converted))
    for element in list(tree.iter()):
        lower_prime(element)
    return ElementTree.tostring(tree, encoding="unicode")


def on_config(config):
    config["mdx_configs"].setdefault("toc", {})["slugify"] = anchor
    return config


def on_files(files, config):
    for source, page in PROJECT.items():
        if page.startswith("project/"):
            files.append(File.generated(config, page, abs_src_path=str(ROOT / source)))
    for name in ASSETS:
        files.append(File.generated(config, f"assets/{name}", abs_src_path=str(Path(__file__).parent / name)))
    for name, path in moving().items():
        files.append(File.generated(config, f"gallery/{name}.html", abs_src_path=str(path)))
    texts = [(posixpath.dirname(f"docs/{file.src_uri}"), Path(file.abs_src_path)) for file in files if file.src_uri.endswith(".md") and file.generated_by is None]
    texts += [("", ROOT / source) for source in PROJECT]
    copied = {}
    for folder, path in texts:
        for match in LINK.finditer(path.read_text(encoding="utf-8")):
            source = linked(folder, match[2])[0] if match[1] else None
            target = source and in_book(source)
            if target and target.startswith("files/"):
                copied[target] = source
    for target, source in sorted(copied.items()):
        files.append(File.generated(config, target, abs_src_path=str(ROOT / source)))
    return files


def on_page_markdown(markdown, page, config, files):
    source = next((name for name, own in PROJECT.items() if own == page.file.src_uri and own.startswith("project/")), None)
    folder = "" if source else posixpath.dirname(f"docs/{page.file.src_uri}")
    text = rewritten(markdown, folder, page.file.src_uri)
    if page.file.src_uri != "gallery.md":
        return text
    pages = moving()
    return PICTURE.sub(lambda picture: f"[{picture[0]}](gallery/{picture[1]}.html#play)" if picture[1] in pages else picture[0], text)


def on_page_content(content, page, config, files):
    def replace(match: re.Match[str]) -> str:
        formula = html.unescape(match[3]).strip()
        tag = TAG.search(formula)
        display = "block" if match[2] == "[" else "inline"
        try:
            converted = mathml(TAG.sub("", formula), display)
        except Exception as reason:
            raise PluginError(f"{page.file.src_uri}: the formula {formula!r} is not understood: {reason!r}") from reason
        if display == "inline":
            return converted
        number = f'<span class="number">({tag[1]})</span>' if tag else ""
        return f'<div class="formula">{converted}{number}</div>'

    return FORMULA.sub(replace, content)
