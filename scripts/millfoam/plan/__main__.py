# SPDX-License-Identifier: GPL-3.0-or-later
"""Predicts time, disk and memory of every stage of a mill's case, from trials on this machine.

    python3 -m millfoam.plan FOLDER -np N [--charge OTHER] [--until STAGE]

FOLDER contains mill.json. Prints a table and writes FOLDER/plan.json. scripts/README.md, "What it will cost", says what
is measured here and what is calibrated on earlier runs."""
import argparse
import os
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from ..files.data_files import DataError, write_json
from ..files.mill import Mill, NoMill, read_mill
from ..run import RunError
from .stages import STAGES, FlowPlan, Stage, make_stages, total
from .trial import MeshTrial

BUSY = 0.4  # load per core above which the plan reports that other programs are running
SHORT = 10.0  # s; shorter times are printed as "< 10 s"


def time_text(seconds: float) -> str:
    """Time in words: `< 10 s`, `25 s`, `12 min`, `3.4 h`."""
    if seconds < SHORT:
        return f"< {SHORT:.0f} s"
    if seconds < 120:
        return f"{seconds:.0f} s"
    return f"{seconds / 60:.0f} min" if seconds < 7200 else f"{seconds / 3600:.1f} h"


def size_text(size: float) -> str:
    """Bytes in words: `< 1 MB`, `25 MB`, `1.9 GB`."""
    if size < 1e6:
        return "< 1 MB"
    return f"{size / 1e6:.0f} MB" if size < 1e9 else f"{size / 1e9:.1f} GB"


def table(stages: Sequence[Stage]) -> list[str]:
    """Lines of the table of Stages, with their total."""
    rows = [("stage", "time", "disk", "memory", "from")]
    rows += [(one.name, time_text(one.time), size_text(one.disk), size_text(one.memory), one.source)
             for one in [*stages, total(stages)]]
    return [f"{row[0]:20} {row[1]:>8} {row[2]:>9} {row[3]:>9}   {row[4]}".rstrip() for row in rows]


def write_plan(path: Path, mill: Mill, ranks: int, charge: str | None, stages: Sequence[Stage],
               plan: FlowPlan | None, mesh: MeshTrial) -> None:
    """Writes plan.json: the Stages as numbers, and the numbers from which the flow's are computed, if it has one."""
    def numbers(one: Stage) -> dict[str, Any]:
        return {"time_s": one.time, "disk_bytes": round(one.disk), "memory_bytes": round(one.memory)}
    content = {"format": "millfoam-plan", "program": "plan", "tools": mill.content.get("program"),
               "mill": mill.fingerprint, "ranks": ranks, "charge_from": charge, "cells": mesh.cells,
               "flow_steps": plan and plan.steps, "flow_time_step_s": plan and plan.time_step,
               "written_times": plan and plan.written_times,
               "stages": [{"stage": one.name, **numbers(one), "from": one.source} for one in stages],
               "total": numbers(total(stages))}
    write_json(path, content)


def main() -> None:
    parser = argparse.ArgumentParser(prog="plan",
                                     description="predicts time, disk and memory of every stage of a mill's case")
    parser.add_argument("folder", help="folder with the resolved mill, mill.json")
    parser.add_argument("-np", dest="ranks", type=int, default=1, metavar="N", help="number of processes")
    parser.add_argument("--charge", metavar="FOLDER", help="case from which the charge and its averages are taken")
    parser.add_argument("--until", choices=STAGES, metavar="STAGE",
                        help=f"the last stage of the plan: one of {', '.join(STAGES)}; without it, all stages")
    options = parser.parse_args()
    if options.ranks < 1:
        parser.error(f"-np {options.ranks}: expected 1 or more")
    before = os.getloadavg()[0]
    try:
        mill = read_mill(options.folder, None)
        stages, plan, mesh = make_stages(mill, options.ranks, options.charge, options.until)
        write_plan(Path(options.folder) / "plan.json", mill, options.ranks, options.charge, stages, plan, mesh)
    except (NoMill, DataError, RunError) as error:
        sys.exit(str(error))
    except OSError as error:
        sys.exit(f"plan: {error.filename or options.folder}: {error.strerror or error}")
    print("\n".join(table(stages)))
    if plan:
        print(f"The flow: {mesh.cells} cells, about {plan.steps} steps of {1e3 * plan.time_step:.3g} ms, "
              f"{plan.written_times} written times, on {options.ranks} process{'es' if options.ranks > 1 else ''}")
    cores = os.cpu_count() or 1
    if before > BUSY * cores:
        print(f"Other programs were running (load {before:.1f} on {cores} cores): a free machine takes less time")
    if options.charge:
        print(f"The charge and its averages are those of {options.charge}; the costs of that case are not counted here")


if __name__ == "__main__":
    main()
