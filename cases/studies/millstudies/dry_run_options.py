# SPDX-License-Identifier: GPL-3.0-or-later
"""The command line of a study of dry runs whose runs have names."""
import argparse
from collections.abc import Callable, Mapping, Sequence
from fnmatch import fnmatchcase
from typing import TypeVar

Run = TypeVar("Run")


def above_zero(text: str, what: str) -> float:
    """A number above 0; `what` it is, in words. ArgumentTypeError for another text."""
    try:
        value = float(text)
    except ValueError:
        value = 0.0
    if not 0 < value < float("inf"):
        raise argparse.ArgumentTypeError(f"'{text}'; expected {what}")
    return value


def seconds(text: str) -> float:
    """A time above 0 s. ArgumentTypeError for another text."""
    return above_zero(text, "a time above 0 s")


def metres(text: str) -> float:
    """A length above 0 m. ArgumentTypeError for another text."""
    return above_zero(text, "a length above 0 m")


def count(text: str) -> int:
    """A whole number, 1 or more. ArgumentTypeError for another text."""
    if not (text.isascii() and text.isdigit() and int(text) > 0):
        raise argparse.ArgumentTypeError(f"'{text}'; expected a whole number, 1 or more")
    return int(text)


def add_options(parser: argparse.ArgumentParser, all_means: str, duration: str) -> None:
    """Options of the runs: RUN…, --list, --duration, --slice, --ranks, --keep-dumps. all_means: the runs that `all`
    names, and duration: that of a run without --duration, in words of the help."""
    parser.add_argument("runs", nargs="*", metavar="RUN",
                        help=f"names, or patterns such as '12cm_load25_*'; `all`: {all_means}")
    parser.add_argument("--list", action="store_true", help="print the names of all runs, and which are complete")
    parser.add_argument("--duration", type=seconds, help=f"of the turning mill, s [{duration}]")
    parser.add_argument("--slice", type=metres, metavar="LENGTH", help="periodic slices of this length (m) instead")
    parser.add_argument("--ranks", type=count, default=2, help="processes of a run [2]")
    parser.add_argument("--keep-dumps", action="store_true", help="of runs that are made now")


def chosen(patterns: Sequence[str], known: Mapping[str, Run], parser: argparse.ArgumentParser,
           in_all: Callable[[Run], bool] = lambda run: True) -> list[Run]:
    """Runs whose names the patterns match, in the order of `known`, name -> run; the pattern `all`: those that are
    `in_all`. A pattern that matches nothing is an error."""
    for pattern in patterns:
        if pattern != "all" and not any(fnmatchcase(name, pattern) for name in known):
            parser.error(f"no run is named '{pattern}'; --list names them")
    return [run for name, run in known.items() if any(
        in_all(run) if pattern == "all" else fnmatchcase(name, pattern) for pattern in patterns)]
