# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads what function objects have written to CASE/postProcessing/NAME/TIME/FILE.dat."""
import re
from pathlib import Path

import numpy as np


class TableError(RuntimeError):
    """A table that cannot be read; the message names the file, the line and the reason."""


def _read_file(path):
    """Words of the last comment line and the rows of one file."""
    names, rows = [], []
    for number, line in enumerate(path.read_text().splitlines(), start=1):
        if line.startswith("#"):
            names = [word.strip() for word in line[1:].split("\t")]
            continue
        try:
            rows.append([float(word) for word in line.split()])
        except ValueError as error:
            raise TableError(f"{path}: line {number}: {error}") from None
        if len(rows[-1]) != len(rows[0]):
            if number == len(path.read_text().splitlines()):
                rows.pop()  # the flow was killed while it wrote this line
                break
            raise TableError(f"{path}: line {number} has {len(rows[-1])} numbers, the lines before {len(rows[0])}")
    return names, rows


def read_table(case, name, file=None):
    """Column names and rows [times, columns] of a function object's table, the time (s) in the first column.

    A flow that went on after it was broken off wrote further files in folders of later times: from a file's first time on,
    its rows replace those of the files before. TableError where there is none, or the files' columns differ."""
    file = file or name
    folder = Path(case) / "postProcessing" / name
    found = [path for path in folder.glob(f"*/{file}*.dat") if re.fullmatch(rf"{re.escape(file)}(_[\d.e+-]+)?", path.stem)]
    if not found:
        raise TableError(f"{folder}: no {file}.dat; did the flow run with this function object?")
    found.sort(key=lambda path: (float(path.parent.name), path.stat().st_mtime_ns))
    names, rows = None, []
    for path in found:
        columns, later = _read_file(path)
        if names is not None and columns != names:
            raise TableError(f"{path}: its columns are not those of {found[0]}")
        names = columns
        if later:
            rows = [row for row in rows if row[0] < later[0][0] * (1 - 1e-9)] + later
    if not rows:
        raise TableError(f"{found[0]}: no line was written")
    return names, np.array(rows)


def read_columns(case, name):
    """The same as a dictionary: column name -> values [times]; names without their units, `holdUp` for `holdUp_m3`."""
    names, rows = read_table(case, name)
    return {re.sub(r"_(s|m|m3|m3/s|m/s|Nm|W|Pa)$", "", column): rows[:, k] for k, column in enumerate(names)}
