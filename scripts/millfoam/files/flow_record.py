# SPDX-License-Identifier: GPL-3.0-or-later
"""slurryFoam's record of its steps: rows of postProcessing/flow/START/steps.csv, and START/flow.json, a summary of each
start."""
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from .data_files import DataError, read_csv, read_json


@dataclass
class FlowRecord:
    """Record of a flow with all its restarts. steps: column -> values over the steps, or None; summaries: [(path,
    content)] of the starts in order of time."""
    steps: dict[str, np.ndarray] | None
    summaries: list[tuple[Path, dict[str, Any]]]

    @property
    def last(self) -> dict[str, Any]:
        """Summary of the last start; empty if none was written."""
        return self.summaries[-1][1] if self.summaries else {}

    @property
    def complete(self) -> bool | None:
        """Whether the last start reached its end; None without a summary."""
        return self.last.get("complete")


def starts(folder: Path | str) -> list[tuple[float, Path]]:
    """[(start, folder)] of CASE/postProcessing/flow in order of time."""
    found = []
    for place in (Path(folder) / "postProcessing" / "flow").glob("*"):
        try:
            found.append((float(place.name), place))
        except ValueError:
            continue
    return sorted(found)


def joined(parts: list[tuple[float, dict[str, np.ndarray]]]) -> dict[str, np.ndarray]:
    """Columns of steps from [(start time, columns)] in order of time. Steps of an earlier start that end after a later
    start were computed again and are left out. DataError if columns differ."""
    names = list(parts[0][1])
    rows = np.empty((0, len(names)))
    for start, columns in parts:
        if list(columns) != names:
            raise DataError(f"steps.csv of the start at {start:g} s: its columns are not those of the first start")
        slack = 1e-9 * max(1.0, abs(start))
        rows = np.concatenate([rows[rows[:, names.index("time_s")] <= start + slack],
                               np.column_stack(list(columns.values()))])
    return dict(zip(names, rows.T))


def wall_time(folder: Path | str) -> float:
    """Wall time of all starts of a flow, s; 0 if slurryFoam wrote no steps."""
    tables = [read_csv(place / "steps.csv") for _, place in starts(folder) if (place / "steps.csv").is_file()]
    return float(sum(columns["wall_s"][-1] for columns in tables if len(columns["wall_s"])))


def read_flow_record(folder: Path | str) -> FlowRecord:
    """FlowRecord of a case's folder, empty if slurryFoam wrote none; DataError for a file that cannot be read."""
    found = starts(folder)
    parts = [(start, read_csv(place / "steps.csv")) for start, place in found if (place / "steps.csv").is_file()]
    for start, columns in parts:
        if "time_s" not in columns:
            raise DataError(f"{folder}/postProcessing/flow: steps.csv of the start at {start:g} s has no column time_s")
    summaries = [(place / "flow.json", read_json(place / "flow.json", "flow"))
                 for _, place in found if (place / "flow.json").is_file()]
    return FlowRecord(joined(parts) if parts else None, summaries)
