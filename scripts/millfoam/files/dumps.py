# SPDX-License-Identifier: GPL-3.0-or-later
"""The notes in the dumps' folder of a dry run, and the dumps by their steps (layout: dem_driver/README.md)."""
from pathlib import Path
from typing import Any

from .data_files import number, read_json


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
