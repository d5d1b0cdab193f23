"""The program ``ancf14`` of the wheel: the same command line as the program in Rust."""

import signal
import sys
from pathlib import Path

from . import _native


def main() -> int:
    """Run the command line with the arguments of the process, and return its exit code."""
    # The command line ends runs on Ctrl-C by itself, and keeps their rows.
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    return _native.command(["ancf14", *sys.argv[1:]], str(Path(__file__).with_name("ancf14")))
