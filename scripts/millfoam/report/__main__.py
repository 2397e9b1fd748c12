# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes one HTML file with all figures about a mill's case, or about several cases that it compares.

    scripts/report CASE            writes CASE/report.html
    scripts/report CASE CASE …     writes comparison.html, which compares the others with the first case

CASE is the folder of a mill's case that was run, or of a dry run."""
import argparse
import sys
from pathlib import Path

import matplotlib

from .build import compare_cases, report_case


def require_report_or_nothing(path: Path) -> None:
    """RuntimeError if another file than a report is at `path`: it would be overwritten."""
    if not path.is_file() or path.stat().st_size == 0:
        return
    with path.open("rb") as file:
        head = file.read(200).lower()
    if b"<!doctype html" not in head:
        raise RuntimeError(f"-o {path}: this file exists and is not HTML; expected another name, like report.html")


def main() -> None:
    matplotlib.use("Agg")
    parser = argparse.ArgumentParser(prog="report", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("cases", nargs="+", type=Path, metavar="CASE")
    parser.add_argument("--begin", type=float,
                        help="time at which the averages begin, s [at the mill's flow.averages.start, or at half of "
                             "the flow's time where at most half of the planned averaged time was computed]")
    parser.add_argument("--measured", type=Path, metavar="CSV",
                        help="compares the charge with a measured map on the run's voxels: x_m, y_m, solidity, vx, vy")
    parser.add_argument("--tracer", type=Path, action="append", default=[], metavar="FILE",
                        help="compares the charge with a tracer's track, lines of t, x, y, z in s and m; may be given "
                             "again")
    parser.add_argument("-o", "--output", type=Path, help="the file to write")
    options = parser.parse_args()
    if len(options.cases) == 1:
        output = options.output or options.cases[0] / "report.html"
        text = report_case(options.cases[0], options.begin, options.measured, options.tracer)
    elif options.measured or options.tracer:
        raise RuntimeError(f"--measured and --tracer are for one case; {len(options.cases)} were given")
    else:
        output = options.output or Path("comparison.html")
        text = compare_cases(options.cases, options.begin)
    require_report_or_nothing(output)
    # An older report stays until the new one is complete
    part = output.with_name(output.name + ".part")
    part.write_text(text, encoding="utf-8")
    part.replace(output)
    print(output)


if __name__ == "__main__":
    try:
        main()
    except (RuntimeError, OSError) as error:
        sys.exit(f"report: error: {error}")
