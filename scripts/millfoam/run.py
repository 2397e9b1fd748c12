# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes and runs OpenFOAM cases from a template, and prints which limits a verification case misses."""
import argparse
import math
import os
import re
import shutil
import subprocess
from collections.abc import Callable, Iterable, Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any, TypeVar

Item = TypeVar("Item")
Result = TypeVar("Result")


class RunError(RuntimeError):
    """A program that failed; the message names its log and shows the log's end."""


def copy_case(case: Path | str, *folders: Path) -> None:
    """Makes a case of what is in these folders; files of a later folder replace those of the ones before."""
    for folder in folders:
        shutil.copytree(folder, case, dirs_exist_ok=True)


def write_parameters(case: Path | str, **values: Any) -> None:
    """Writes CASE/parameters, which the template's dictionaries include: one `key value;` on each line."""
    (Path(case) / "parameters").write_text("".join(f"{key} {value};\n" for key, value in values.items()))


def stop_mill(case: Path | str) -> None:
    """Sets omega of CASE/constant/millProperties to 0: slurryFoam refuses a mill that turns while its walls rest."""
    properties = Path(case) / "constant" / "millProperties"
    text, count = re.subn(r"^omega .*;$", "omega 0;", properties.read_text(), flags=re.MULTILINE)
    if count != 1:
        raise RunError(f"{properties}: {count} lines 'omega ...;', expected one")
    properties.write_text(text)


def run(case: Path | str, *command: Any) -> str:
    """Runs a command in a case folder into log.NAME (the program's) and returns the log's text."""
    name = Path(str(command[0])).name
    log = Path(case) / f"log.{name}"
    # OpenFOAM takes its folder's name from PWD
    environment = {**os.environ, "PWD": str(Path(case).resolve())}
    with open(log, "w") as out:
        done = subprocess.run([str(word) for word in command], cwd=case, env=environment, stdout=out,
                              stderr=subprocess.STDOUT)
    text = log.read_text()
    if done.returncode:
        raise RunError(f"{name} failed; {log} ends with:\n" + "\n".join(text.splitlines()[-15:]))
    return text


def set_options(changes: Iterable[str]) -> list[str]:
    """Settings `path=value` of a mill as a tool's options."""
    return [word for change in changes for word in ("--set", change)]


def case_options(description: str | None, quick: str | None = None) -> argparse.Namespace:
    """Options of a verification case's script: `jobs`, and `quick` if there is a text about the quick form."""
    parser = argparse.ArgumentParser(description=description)
    if quick:
        parser.add_argument("--quick", action="store_true", help=quick)
    parser.add_argument("--jobs", type=int, default=2, help="runs at a time")
    return parser.parse_args()


def fresh_runs(here: Path | str) -> Path:
    """The folder `runs` of a verification case, empty."""
    work = Path(here) / "runs"
    shutil.rmtree(work, ignore_errors=True)
    work.mkdir()
    return work


def run_jobs(function: Callable[[Item], Result], items: Iterable[Item], jobs: int) -> list[Result]:
    """[function(item), …] in the items' order, so many at a time."""
    with ThreadPoolExecutor(jobs) as pool:
        return list(pool.map(function, items))


def marked(line: str, missed: bool | list[str], word: str = "MISSED") -> str:
    """A line of a table, with a word at its end if what it shows missed a limit; missed: whether, or the limits'
    names, which follow the word."""
    names = f": {', '.join(missed)}" if isinstance(missed, list) else ""
    return f"{line}  {word}{names}" if missed else line


def limit_table(rows: Sequence[tuple[str, float, float]], limit: str = "allowed",
                word: str = "MISSED") -> tuple[list[str], int]:
    """Lines of a table of (what, found, largest that is allowed), and how many are larger or not a number; limit: what
    the head calls the last column."""
    width = max((len(what) for what, *_ in rows), default=0)
    lines = [f"{'':<{width}} {'found':>10} {limit:>10}"]
    beyond = [not (math.isfinite(found) and found <= largest) for _, found, largest in rows]
    lines += [marked(f"{what:<{width}} {found:10.4g} {largest:10.3g}", bad, word)
              for (what, found, largest), bad in zip(rows, beyond)]
    return lines, sum(beyond)


def write_table(lines: Iterable[str], out: Path) -> None:
    """Prints the lines of a verification case's table, and writes them into a file."""
    text = "\n".join(lines)
    print(text)
    out.write_text(text + "\n")
