# SPDX-License-Identifier: GPL-3.0-or-later
"""When a flow with flow.steady ends.

    python3 -m millfoam.report.steady CASE ASKED    prints the flow time (s) up to which it is to be computed next, or
                                                    writes steady.json and prints "end". ASKED: file with the time that
                                                    was asked for last, "flowDuration TIME;", if there is one

The flow ends when the slurry is steady by the report's rule over the last turns that the mill asks for, at
flow.duration, or after a piece in which the hours of wall time that the mill allows are over. Where these turns are too
few to decide, because their errors are too large, the whole turns of the last half of the flow are judged."""
import re
import sys
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ..files.data_files import write_json
from ..files.flow_record import read_flow_record, wall_time
from ..files.mill import Mill, read_mill
from ..files.tables import TableError, read_columns
from ..readings.batches import whole_turns
from .steadiness import judge_steadiness
from .verdict import Check

HOUR = 3600.0
START = 0.5  # of the judged turns, before them
SLACK = 1e-6  # of a time


@dataclass(frozen=True)
class End:
    """reason: steady, duration or hours; time from which averages are taken, and at which the flow ends, s; found: the
    verdict on this time in words."""
    reason: str
    begin: float
    end: float
    found: str


def judge_end(mill: Mill, columns: dict[str, np.ndarray], span: float) -> tuple[float, Check]:
    """Time (s) from which the end of a Mill's flow is judged, and the verdict: over the last `span` (s) or, where this
    is undecided, over the whole turns of the last half if they are more and hold. columns: of slurryBalance."""
    last = float(columns["Time"][-1])

    def judge(begin: float) -> Check:
        return judge_steadiness(columns, begin, mill.turn, mill.radius, mill.flow("feed_m3_s", 0.0), mill.machine)
    begin, longer = max(last - span, 0.0), last - whole_turns(last / 2, mill.turn) * mill.turn
    check = judge(begin)
    if check.undecided and longer < begin - mill.turn / 2:
        more = judge(longer)
        return (longer, more) if more.state == "holds" else (begin, check)
    return begin, check


def next_time(mill: Mill, columns: dict[str, np.ndarray] | None, hours: float) -> float | End:
    """Flow time (s) up to which a Mill's flow is to be computed next, or its End. columns: of slurryBalance up to the
    end of the last piece, None before the flow; hours: of wall time that it took."""
    asked, duration = mill.flow("steady"), mill.flow("duration_s")
    span = asked["turns"] * mill.turn
    first = min((1 + START) * span, duration)
    last = 0.0 if columns is None else float(columns["Time"][-1])
    if columns is None or last < first * (1 - SLACK):
        return first
    begin, check = judge_end(mill, columns, span)
    late = asked["hours"] is not None and hours >= asked["hours"]
    for reason, reached in (("steady", check.state == "holds"), ("duration", last >= duration * (1 - SLACK)),
                            ("hours", late)):
        if reached:
            return End(reason, begin, last, check.found)
    # By half of the turns, so that each half is compared with the one before it
    return min(last + span / 2, duration)


def unfinished(folder: Path, columns: dict[str, np.ndarray] | None, asked: Path) -> str | None:
    """The time that was asked for last, as it was written, if the flow has not come to it or was interrupted."""
    found = re.fullmatch(r"flowDuration (\S+);\s*", asked.read_text()) if asked.is_file() else None
    if not found:
        return None
    short = columns is None or columns["Time"][-1] < float(found[1]) * (1 - SLACK)
    return found[1] if short or read_flow_record(folder).complete is False else None


def main(folder: Path, asked: Path) -> None:
    mill = read_mill(folder, None)
    try:
        columns = read_columns(folder, "slurryBalance")
    except TableError:
        columns = None
    again = unfinished(folder, columns, asked)
    if again is not None:
        print(again)
        return
    found = next_time(mill, columns, wall_time(folder) / HOUR)
    if not isinstance(found, End):
        print(f"{found:.10g}")
        return
    write_json(folder / "steady.json", {
        "format": "millfoam-steady", "program": mill.content.get("program"), "mill": mill.fingerprint,
        "reason": found.reason, "begin_s": found.begin, "end_s": found.end, "found": found.found})
    print("end")


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(f"{__doc__}\nexpected CASE and ASKED")
    try:
        main(Path(sys.argv[1]), Path(sys.argv[2]))
    except (RuntimeError, OSError) as error:
        sys.exit(f"steady: error: {error}")
