# SPDX-License-Identifier: GPL-3.0-or-later
"""Tables of dry runs of stirred mills: a line for each run in a CSV, and a column for each run in a text."""
from collections.abc import Iterator, Sequence
from dataclasses import asdict
from pathlib import Path

import numpy as np

from millfoam.files.data_files import write_csv
from millfoam.readings.means import Mean
from millstudies.compared_runs import NOT_TESTED, Verdict
from millstudies.mean_columns import Row, mean_columns
from millstudies.stirred_runs import Numbers

IN_LINE = 5  # runs next to each other in the printed table


def drive_columns(one: Numbers) -> Row:
    """Columns of a run: turns that are read, drift, power and torques. The power of a part is its torque times the
    impeller's speed: what the part takes out of the drive."""
    row: Row = {"balls": one.balls, "turns": one.turns, "read from, s": one.begin,
                "drift in these turns": " ".join(one.drifting) or "none",
                "millDem: steady": "yes" if one.whole_steady else "no", **mean_columns("power, W", one.power)}
    for part, torque in one.torques.items():
        row |= mean_columns(f"torque on {part}, N m", torque)
        if part != "impeller":
            row |= mean_columns(f"power by {part}, W", Mean(torque.value, torque.error), one.mill.omega)
    return row | mean_columns("at rest over impeller, 1", one.at_rest)


def cell(row: Row, key: str) -> str:
    """A row's entry in the printed table, with its error; a dash for a number that is not known."""
    value, error = row[key], row.get(f"{key} ±")
    if value is None or isinstance(value, float) and np.isnan(value):
        return "–"
    if error is not None:
        return f"{value:.4g} ± {error:.2g}"
    return f"{value:.4g}" if isinstance(value, float) else str(value)


def lines_of(rows: Sequence[Row]) -> Iterator[str]:
    """The table as text: a line for each quantity and a column for each run."""
    for begin in range(0, len(rows), IN_LINE):
        block = rows[begin:begin + IN_LINE]
        for key in (one for one in block[0] if not one.endswith(" ±")):
            yield key.ljust(39) + "".join(cell(row, key).rjust(20) for row in block)
        yield ""


def write_study(root: Path, name: str, rows: Sequence[Row], judged: Sequence[Verdict], missing: Sequence[str]) -> str:
    """Writes runs.csv, statements.csv and NAME.txt, with both and the runs that are missing, into a folder. Returns
    this text."""
    write_csv(root / "runs.csv", rows)
    write_csv(root / "statements.csv", [asdict(one) for one in judged])
    known = [one for one in judged if one.verdict != NOT_TESTED]
    lines = [*lines_of(rows), *(f"{one.verdict:<13} {one.statement}; {one.runs}: {one.figure}" for one in known), "",
             f"not tested, because a run is not finished: {len(judged) - len(known)} statements",
             *(f"not finished: {text}" for text in missing)]
    text = "\n".join(lines) + "\n"
    (root / f"{name}.txt").write_text(text)
    return text
