# SPDX-License-Identifier: GPL-3.0-or-later
"""The notes in the dumps' folder of a dry run, and the dumps by their steps (layout: dem_driver/README.md)."""
import re
from pathlib import Path
from typing import Any

import numpy as np

from .data_files import number, read_json, read_text


def read_notes(dumps: Path | str) -> dict[str, Any]:
    """DIR/dumps/run.json: timestep_s, interval (steps between dumps), angular_velocity_rad_s, …; RuntimeError names
    what is wrong with it."""
    return read_json(Path(dumps) / "run.json", "dumps")


def read_timestep(dumps: Path | str) -> float:
    """The dry run's time-step from DIR/dumps/run.json, s."""
    return number(read_notes(dumps), Path(dumps) / "run.json", "timestep_s")


def numbered_dumps(folder: Path | str, kind: str = "dump") -> list[tuple[int, Path]]:
    """[(step, path)] of a folder's `<kind>.<step>.txt`, by step; RuntimeError if there are none, as of a dry run with
    `dem.dumps: no`."""
    found = sorted((int(path.name.split(".")[1]), path) for path in Path(folder).glob(f"{kind}.*.txt"))
    if not found:
        notes = Path(folder) / "run.json"
        reason = ", because the run wrote none (dem.dumps: no)" if (
            kind == "dump" and notes.is_file() and read_notes(folder).get("dumps") == 0) else ""
        raise RuntimeError(f"{folder}: no {kind}.<step>.txt{reason}")
    return found


def read_columns(path: Path) -> dict[str, np.ndarray]:
    """All columns [balls] of a dump by their names, in the dump's units; RuntimeError if it is no dump of balls, or not
    complete."""
    parts = read_text(path).split("ITEM: ATOMS", 1)
    if len(parts) != 2:
        raise RuntimeError(f"{path}: no line 'ITEM: ATOMS'; expected a dump of balls")
    head, _, rows = parts[1].partition("\n")
    names, values = head.split(), rows.split()
    count = re.search(r"ITEM: NUMBER OF ATOMS\s+(\d+)", parts[0])
    if not rows.endswith("\n"):
        raise RuntimeError(f"{path}: no end of the last line: the dump is not complete")
    if count and len(values) != int(count[1]) * len(names):
        raise RuntimeError(f"{path}: {len(values)} values of balls; expected {int(count[1])} balls of {len(names)} "
                           "columns each: the dump is not complete")
    try:
        return dict(zip(names, np.array(values, dtype=float).reshape(-1, len(names)).T))
    except ValueError as error:
        raise RuntimeError(f"{path}: {error}; expected a number for each ball in each column") from error


def read_balls(path: Path, *columns: str) -> np.ndarray:
    """Columns of a dump by their names -> [balls, columns], in the dump's units; RuntimeError names the file and what
    it does not have."""
    return columns_of(read_columns(path), path, *columns)


def columns_of(read: dict[str, np.ndarray], path: Path, *columns: str) -> np.ndarray:
    """As read_balls, of the columns that were `read` from path."""
    missing = [name for name in columns if name not in read]
    if missing:
        raise RuntimeError(f"{path}: no column {', '.join(missing)}; it has {', '.join(read)}")
    return np.stack([read[name] for name in columns], axis=1)
