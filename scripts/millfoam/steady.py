# SPDX-License-Identifier: GPL-3.0-or-later
"""When a flow with flow.steady ends.

    python3 -m millfoam.steady CASE     prints the flow time (s) up to which it is to be computed next, or writes
                                        steady.json and prints "end"

It ends when the slurry is steady by the report's rule over the last turns that the mill asks for, at flow.duration, or
after the hours of wall time that the mill allows."""
import sys
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from .files.data_files import write_json
from .files.flow_record import read_flow_record
from .files.mill import Mill, read_mill
from .files.tables import TableError, read_columns
from .report.steadiness import judge_steadiness

HOUR = 3600.0


@dataclass(frozen=True)
class End:
    """reason: steady, duration or hours; time from which averages are taken, and at which the flow ends, s; found: the
    verdict on this time in words."""
    reason: str
    begin: float
    end: float
    found: str


def next_time(mill: Mill, columns: dict[str, np.ndarray] | None, hours: float) -> float | End:
    """Flow time (s) up to which a Mill's flow is to be computed next, or its End. columns: of slurryBalance, None
    before the flow; hours: of wall time that it took."""
    asked, duration = mill.flow("steady"), mill.flow("duration_s")
    span = asked["turns"] * mill.turn
    # The flow's start is not judged
    first = min(1.5 * span, duration)
    last = 0.0 if columns is None else float(columns["Time"][-1])
    if columns is None or last < first * (1 - 1e-6):
        return first
    begin = last - span
    check = judge_steadiness(columns, begin, mill.turn, mill.radius, mill.flow("feed_m3_s", 0.0))
    late = asked["hours"] is not None and hours >= asked["hours"]
    for reason, reached in (("steady", check.state == "holds"), ("duration", last >= duration * (1 - 1e-6)),
                            ("hours", late)):
        if reached:
            return End(reason, begin, last, check.found)
    # By half of the turns, so that each half is compared with the one before it
    return min(last + span / 2, duration)


def main(folder: Path) -> None:
    mill = read_mill(folder)
    steps = read_flow_record(folder).steps
    try:
        columns = read_columns(folder, "slurryBalance")
    except TableError:
        columns = None
    found = next_time(mill, columns, 0.0 if steps is None else steps["wall_s"].sum() / HOUR)
    if not isinstance(found, End):
        print(f"{found:.10g}")
        return
    write_json(folder / "steady.json", {
        "format": "millfoam-steady", "program": mill.content.get("program"), "mill": mill.fingerprint,
        "reason": found.reason, "begin_s": found.begin, "end_s": found.end, "found": found.found})
    print("end")


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(f"{__doc__}\nexpected one CASE")
    main(Path(sys.argv[1]))
