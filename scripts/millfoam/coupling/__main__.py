# SPDX-License-Identifier: GPL-3.0-or-later
"""Coupling of balls and slurry, by passes or at the same time.

    python3 -m millfoam.coupling forces PASS BEFORE   writes PASS/forces.h5, what the balls of PASS will feel: the
                                                      forces of the flow in BEFORE, relaxed by those that moved its
                                                      balls
    python3 -m millfoam.coupling judge CASE N         compares N passes of CASE (CASE itself, CASE/pass_2, …): writes
                                                      coupling.csv, coupling.json and coupling.png
    python3 -m millfoam.coupling together CASE BEFORE -np N [--resume]
                                                      runs the balls of CASE, from the last state of the dry run in
                                                      BEFORE on, and the flow of CASE at the same time
    python3 -m millfoam.coupling direct CASE          writes coupling.json of a CASE whose balls and flow in CASE/direct
                                                      ran at the same time"""
import argparse
import sys
from pathlib import Path

import matplotlib

from ..files.data_files import write_json
from ..files.flow_record import read_flow_record
from ..files.mill import read_mill
from ..files.slurry_file import read_ball_forces
from . import ball_forces, passes, table, together


def make_forces(folder: Path, before: Path) -> None:
    """Writes FOLDER/forces.h5 from the flow in `before`. RuntimeError if that flow has no forces."""
    share = read_mill(folder).flow("relaxation")
    slurry = before / "slurry.h5"
    forces = read_ball_forces(slurry)
    # The dry pass had no forces; they are no estimate to be relaxed by
    if (before / passes.FORCES).is_file():
        forces = ball_forces.relaxed(forces, read_ball_forces(before / passes.FORCES), share)
    else:
        share = 1.0
    ball_forces.write_ball_forces(folder / passes.FORCES, forces, slurry, {"relaxation": share})


def judge(case: Path, count: int) -> None:
    """Writes coupling.csv, coupling.json and coupling.png of the first `count` passes of a case, and prints the
    table."""
    mill = read_mill(case)
    folders = [case, *(case / f"pass_{number}" for number in range(2, count + 1))]
    found = [passes.read_pass(number, folder) for number, folder in enumerate(folders, start=1)]
    changes = [passes.change(*pair) for pair in zip(found, found[1:])]
    settled = passes.settled(changes, found[-1])
    table.write_csv(case / "coupling.csv", found, changes)
    means = {key: [one.quantities[key] for one in found] for key in passes.QUANTITIES}
    table.passes_figure([one.number for one in found], means).savefig(case / "coupling.png", dpi=140)
    content = table.result(mill, found, changes, settled, int(mill.flow("passes") or 0))
    write_json(case / "coupling.json", content)
    print("\n".join(table.lines(found, changes)))
    if settled:
        print("settled: in the last two passes nothing changed by more than its statistical error")
    elif changes:
        print(f"not settled: most of all changed the {changes[-1].largest}")


def run_direct(case: Path, before: Path, ranks: int, resume: bool) -> None:
    """Runs balls and flow of a case until both have ended; `resume`: from the latest time that both have, and not at
    all if both have ended."""
    balls = ["millDem", "mill.json", "--case", ".", "--continue", str(before), "--with-flow", together.EXCHANGE,
             "-np", str(ranks)]
    flow = ["slurryFoam"] if ranks == 1 else ["mpirun", "-np", str(ranks), "slurryFoam", "-parallel"]
    if resume and (case / "dumps" / "run.json").is_file() and read_flow_record(case).complete:
        print("Balls and flow are complete", file=sys.stderr)
        return
    if resume:
        common = together.align(case)
        print(f"Balls and flow resume at the flow's time {common:g} s" if common else "Balls and flow begin anew",
              file=sys.stderr)
        # Balls that cannot resume must not begin anew beside a flow that does
        balls += ["--resume"] if common else ["--resume", "--or-anew"]
    together.run_together(balls, flow, case)


def judge_direct(case: Path) -> None:
    """Writes coupling.json of balls and flow that ran at the same time, and prints what they gave to each other."""
    folder = case / "direct"
    found = passes.direct_case(folder)
    exchanged = passes.exchanged_forces(folder)
    load = found.load[0] if found.load else None
    write_json(case / "coupling.json", table.direct_result(found.mill, folder.name, load, exchanged))
    print(f"mean force of the flow on the balls: {exchanged.given:.4g} N by the flow, {exchanged.taken:.4g} N by the "
          f"balls; they differ by {exchanged.disagreement:.2%}")
    if exchanged.torque_disagreement is not None:
        print(f"its torque: {exchanged.given_torque:.4g} N m by the flow, {exchanged.taken_torque:.4g} N m by the "
              f"balls; they differ by {exchanged.torque_disagreement:.2%} of the drive's torque on the balls")
    if exchanged.added is not None:
        print(f"the balls got {exchanged.added:.2%} of the drive's torque because voxels spread them")
    if exchanged.unbalanced is not None:
        print(f"by the slurry's own balance it differs by {table.cell(exchanged.unbalanced, 100)} % of the drive's "
              "torque")


def main() -> None:
    matplotlib.use("Agg")
    parser = argparse.ArgumentParser(prog="millfoam.coupling", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(dest="command", required=True)
    forces = commands.add_parser("forces", help="writes what the balls of the next pass feel")
    forces.add_argument("folder", type=Path, metavar="PASS")
    forces.add_argument("before", type=Path, metavar="BEFORE")
    judged = commands.add_parser("judge", help="compares the passes of a case")
    judged.add_argument("case", type=Path, metavar="CASE")
    judged.add_argument("count", type=int, metavar="N")
    runs = commands.add_parser("together", help="runs balls and flow at the same time")
    runs.add_argument("case", type=Path, metavar="CASE")
    runs.add_argument("before", type=Path, metavar="BEFORE")
    runs.add_argument("-np", dest="ranks", type=int, default=1, metavar="N")
    runs.add_argument("--resume", action="store_true")
    direct = commands.add_parser("direct", help="compares what balls and flow gave to each other")
    direct.add_argument("case", type=Path, metavar="CASE")
    options = parser.parse_args()
    if options.command == "forces":
        make_forces(options.folder, options.before)
    elif options.command == "together":
        run_direct(options.case, options.before, options.ranks, options.resume)
    elif options.command == "direct":
        judge_direct(options.case)
    else:
        judge(options.case, options.count)


if __name__ == "__main__":
    try:
        main()
    except (RuntimeError, OSError, ValueError) as error:
        sys.exit(f"millfoam.coupling: error: {error}")
