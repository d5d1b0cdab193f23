"""Does the first example of docs/first-steps.md work as it is printed? The file is saved and run, and its output is the listing on the page."""

import re
import subprocess
import sys
from pathlib import Path

from conftest import ROOT

PAGE = (ROOT / "docs/first-steps.md").read_text()


def test_the_first_example_prints_what_the_page_says() -> None:
    (section,) = re.findall(r"^## Python$(.*?)^## ", PAGE, re.MULTILINE | re.DOTALL)
    (model,) = re.findall(r"`cantilever\.toml`:\n\n```toml\n(.*?)^```$", PAGE, re.MULTILINE | re.DOTALL)
    (program,) = re.findall(r"`heights\.py`:\n\n```python\n(.*?)^```$", section, re.MULTILINE | re.DOTALL)
    (printed,) = re.findall(r"^```text\n(.*?)^```$", section, re.MULTILINE | re.DOTALL)
    Path("cantilever.toml").write_text(model)
    Path("heights.py").write_text(program)
    done = subprocess.run([sys.executable, "heights.py"], capture_output=True, text=True, check=True)
    assert (done.stdout, done.stderr) == (printed, "")
    checked = [sys.executable, "-m", "mypy", "--strict", "--cache-dir", "/dev/null", "heights.py"]
    assert subprocess.run(checked, capture_output=True, text=True, check=False).returncode == 0
