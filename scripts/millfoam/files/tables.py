# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads tables of function objects, CASE/postProcessing/NAME/TIME/FILE.dat."""
import re
from pathlib import Path

import numpy as np


class TableError(RuntimeError):
    """A table that cannot be read; the message names the file, the line and the reason."""


def _read_file(path: Path) -> tuple[float, list[str], list[list[float]]]:
    """Time at which the file was begun (s since 1970; of its modification if the file does not name it), words of its
    last comment line, and its rows. A last line without a line end, from a killed flow, is left out."""
    begun, names, rows = path.stat().st_mtime, [], []
    for number, line in enumerate(path.read_text().split("\n")[:-1], start=1):
        if line.startswith("#"):
            names = [word.strip() for word in line[1:].split("\t")]
            if found := re.match(r"#\s*Begun\s*:\s*(\d+)", line):
                begun = float(found.group(1))
            continue
        try:
            rows.append([float(word) for word in line.split()])
        except ValueError as error:
            raise TableError(f"{path}: line {number}: {error}") from None
        if len(rows[-1]) != len(rows[0]):
            raise TableError(f"{path}: line {number} has {len(rows[-1])} numbers, the lines before {len(rows[0])}")
    return begun, names, rows


def read_table(case: Path | str, name: str, file: str | None = None) -> tuple[list[str], np.ndarray]:
    """Column names and rows [times, columns] of a function object's table, the time (s) in the first column.

    A flow that resumed after an interruption has several files. From a file's first time on, its rows replace those of
    earlier files. TableError if there is no file, or the files' columns differ."""
    file = file or name
    folder = Path(case) / "postProcessing" / name
    stem = re.compile(rf"{re.escape(file)}(_[\d.e+-]+)?")
    found = [path for path in folder.glob(f"*/{file}*.dat") if stem.fullmatch(path.stem)]
    if not found:
        raise TableError(f"{folder}: no {file}.dat; did the flow run with this function object?")
    files = sorted((*_read_file(path), path) for path in found)
    names = files[0][1]
    rows: list[list[float]] = []
    for _, columns, later, path in files:
        if columns != names:
            raise TableError(f"{path}: its columns are not those of {files[0][3]}")
        if later:
            rows = [row for row in rows if row[0] < later[0][0] * (1 - 1e-9)] + later
    if not rows:
        raise TableError(f"{found[0]}: no line was written")
    return names, np.array(rows)


def read_columns(case: Path | str, name: str) -> dict[str, np.ndarray]:
    """The same as a dictionary: column name -> values [times]; names without their units, `holdUp` for `holdUp_m3`."""
    names, rows = read_table(case, name)
    return {re.sub(r"_(s|m|m3|m3/s|m/s|N|Nm|W|Pa)$", "", column): rows[:, k] for k, column in enumerate(names)}
