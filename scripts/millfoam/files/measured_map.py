# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads a measured map of the charge from a CSV file."""
import csv
from dataclasses import replace
from pathlib import Path

import numpy as np

from .solids_file import SolidsMap

COLUMNS, VELOCITIES = ("x_m", "y_m", "solidity"), ("vx", "vy")


def read_measured(path: Path | str, like: SolidsMap) -> SolidsMap:
    """A measured map as a SolidsMap on the voxels of another, `like`, with its walls and times.

    path: CSV with a header and the columns x_m, y_m (of a voxel's centre, m), solidity, vx, vy (m/s). vx and vy are
    empty where no velocity was measured; both columns are missing if none was measured at all. The columns have any
    order, other columns and blanks are allowed. Voxels may be missing: their solidity and velocity are NaN. ValueError
    names file, line, column and value of a missing column, a wrong number, a solidity outside 0 to 1, a place that is
    not a voxel's centre, and a voxel that is given twice."""
    solidity, velocity = np.full(like.solidity.shape, np.nan), np.full(like.velocity.shape, np.nan)
    # Spreadsheets put a mark before UTF-8
    with open(path, newline="", encoding="utf-8-sig") as file:
        rows = csv.DictReader(file)
        rows.fieldnames = names = [name.strip() for name in rows.fieldnames or ()]
        measured = VELOCITIES if set(VELOCITIES) & set(names) else ()
        for column in COLUMNS + measured:
            if column not in names:
                raise ValueError(f"{path}, line 1: no column {column} in '{','.join(names)}'; expected "
                                 f"{', '.join(COLUMNS + VELOCITIES)}")
        for row in rows:
            line = rows.line_num
            place = tuple(_voxel(path, line, column, _number(path, row, line, column), edges)
                          for column, edges in (("y_m", like.y), ("x_m", like.x)))
            if np.isfinite(solidity[place]):
                raise ValueError(f"{path}, line {line}, columns x_m, y_m: voxel {row['x_m']}, {row['y_m']} was given "
                                 "before")
            solidity[place] = _number(path, row, line, "solidity", 0, 1)
            if any((row[column] or "").strip() for column in measured):
                velocity[place] = [*(_number(path, row, line, column) for column in measured), 0]
    if not np.isfinite(solidity).any():
        raise ValueError(f"{path}: no voxels")
    return replace(like, solidity=solidity, velocity=velocity)


def _number(path: Path | str, row: dict[str, str], line: int, column: str, lowest: float = -np.inf,
            highest: float = np.inf) -> float:
    """A cell of a CSV as a number within limits."""
    text = (row[column] or "").strip()
    try:
        value = float(text)
    except ValueError:
        value = np.nan
    if not (np.isfinite(value) and lowest <= value <= highest):
        limits = "" if np.isinf(lowest) else f" from {lowest:g} to {highest:g}"
        raise ValueError(f"{path}, line {line}, column {column}: '{text}'; expected a number{limits}")
    return value


def _voxel(path: Path | str, line: int, column: str, value: float, edges: np.ndarray) -> int:
    """Number of the voxel with a centre at `value` (m), within a hundredth of its width."""
    place = (value - edges[0]) / (edges[1] - edges[0]) - 0.5
    index = round(place)
    if abs(place - index) > 0.01 or not 0 <= index < len(edges) - 1:
        raise ValueError(f"{path}, line {line}, column {column}: {value:g} m is not a voxel's centre; expected "
                         f"{len(edges) - 1} voxels between {edges[0]:g} and {edges[-1]:g} m, as the run's")
    return index
