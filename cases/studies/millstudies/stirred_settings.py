# SPDX-License-Identifier: GPL-3.0-or-later
"""The mills of the studies of stirred mills, and the command `runs.py` of each study, which names its runs and what
they change in the file of mill A."""
import argparse
from collections.abc import Mapping
from pathlib import Path
from typing import Protocol

FILE = Path(__file__).resolve().parents[2] / "mills" / "stirred_A" / "mill.yaml"
MILLS: dict[str, tuple[str, ...]] = {"A": (), "B": ("variant=mill_B",), "C": ("variant=mill_C",)}  # -> changes of A


class Run(Protocol):
    """A run of a study."""

    def settings(self, quick: bool) -> tuple[str, ...]:
        """What it changes in FILE, as PATH=VALUE; quick: of the short form."""


def print_settings(runs: Mapping[str, Run], description: str | None) -> int:
    """The command line of `runs.py`: prints the names of all runs, or the settings of one, a line each. The status."""
    parser = argparse.ArgumentParser(description=description)
    what = parser.add_mutually_exclusive_group(required=True)
    what.add_argument("--names", action="store_true", help="prints the names of all runs")
    what.add_argument("--settings", choices=runs, metavar="RUN", help="prints its settings, one in a line")
    parser.add_argument("--quick", action="store_true", help="settings of the short form")
    options = parser.parse_args()
    print(*(runs if options.names else runs[options.settings].settings(options.quick)), sep="\n")
    return 0
