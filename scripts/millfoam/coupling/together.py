# SPDX-License-Identifier: GPL-3.0-or-later
"""Balls and flow at the same time: two programs that exchange forces and averages, and resume at the same time."""
import os
import shutil
import signal
import subprocess
import threading
import time
from collections.abc import Sequence
from pathlib import Path
from typing import IO

import numpy as np

from ..files.data_files import read_json

EXCHANGE = "exchange"  # folder of the pipes, in the case
BALLS_LOG = "log.balls"
WAIT = 0.2  # s, between two looks at the programs
# Settings of Open MPI with which the ranks of two programs share the cores
SHARED_CORES = {"OMPI_MCA_mpi_yield_when_idle": "1", "OMPI_MCA_hwloc_base_binding_policy": "none"}


class TogetherError(RuntimeError):
    """One of the two programs has failed."""


def flow_folders(case: Path) -> list[Path]:
    """Folders with the flow's times: one for each rank, or the case."""
    return sorted(case.glob("processor[0-9]*")) or [case]


def flow_times(folder: Path) -> dict[str, float]:
    """Name -> flow time (s) of the times after 0 in a folder."""
    found = {}
    for path in folder.iterdir():
        try:
            value = float(path.name)
        except ValueError:
            continue
        if path.is_dir() and value > 0:
            found[path.name] = value
    return found


def restart_times(case: Path) -> dict[Path, float]:
    """Restart file -> flow time (s) of a run of balls with a flow, oldest first; none if it has not begun."""
    order = case / "dem" / "fluid.json"
    if not order.is_file():
        return {}
    content = read_json(order, "fluid")
    begin, step = content["exchange"]["begin"], content["timestep_s"]
    files = sorted((int(path.suffix[1:]), path) for path in (case / "dem").glob("restart.*")
                   if path.suffix[1:].isdigit())
    return {path: (number - begin) * step for number, path in files if number > begin}


def align(case: Path) -> float:
    """Makes both programs resume at the same time: removes what one of them has beyond the latest time that both
    have, and returns that time, s. 0: they begin anew. Balls that have ended would not meet the flow again, so both
    compute the last piece anew; run.json, which marks their run as complete, goes."""
    restarts = restart_times(case)
    end = max(restarts.values(), default=0.0) if (case / "dumps" / "run.json").is_file() else np.inf
    folders = flow_folders(case)
    interval = read_json(case / "dem" / "fluid.json", "fluid")["timestep_s"] if restarts else 0.0
    common = 0.0
    for at in restarts.values():
        met = all(any(abs(value - at) <= interval for value in flow_times(folder).values()) for folder in folders)
        if met and at < end:
            common = max(common, at)
    for path, at in restarts.items():
        if at > common + interval:
            path.unlink()
    # Those that were put together, too: slurryFoam would not replace later ones of the case
    for folder in {*folders, case}:
        for name, value in flow_times(folder).items():
            if value > common + interval:
                shutil.rmtree(folder / name)
    # Last: an interrupted call must know again that the balls have ended
    (case / "dumps" / "run.json").unlink(missing_ok=True)
    return common


def remove_pipes(case: Path) -> None:
    """Removes the pipes of a case. Programs that have opened them keep them."""
    for pipe in (case / EXCHANGE).glob("to_*"):
        pipe.unlink()


def run_together(balls: Sequence[str], flow: Sequence[str], case: Path, flow_log: IO[str] | None = None) -> None:
    """Runs both programs in a case until both have ended; the balls' output goes to log.balls, the flow's to flow_log
    or, without it, to the output of this program. Each ends when this program is killed. SHARED_CORES are set unless
    the environment has them. If one program fails, the other is ended. TogetherError with the last lines of the balls'
    log if they fail, or with the exit codes if the flow fails before them."""
    remove_pipes(case)
    # OpenFOAM takes its folder's name from PWD
    environment = {**SHARED_CORES, **os.environ, "PWD": str(case.resolve())}

    def start(command: Sequence[str], out: IO[str] | IO[bytes] | None) -> subprocess.Popen[bytes]:
        return subprocess.Popen(["setpriv", "--pdeathsig", "TERM", *command], cwd=case, env=environment, stdout=out,
                                stderr=subprocess.STDOUT if out else None)
    log = case / BALLS_LOG
    with open(log, "wb") as out:
        programs = [start(balls, out), start(flow, flow_log)]
    ended: list[subprocess.Popen[bytes]] = []  # in their order
    stopped = []

    def follow(program: subprocess.Popen[bytes]) -> None:
        program.wait()
        ended.append(program)
    followers = [threading.Thread(target=follow, args=(program,), daemon=True) for program in programs]
    for follower in followers:
        follower.start()
    try:
        while len(ended) < len(programs):
            if any(program.returncode for program in ended):
                # The other one notices that the pipe is closed, unless it waits for its opening
                time.sleep(10 * WAIT)
                break
            time.sleep(WAIT)
    finally:
        for program in programs:
            if program.poll() is None:
                stopped.append(program)
                program.send_signal(signal.SIGTERM)
        for follower in followers:
            follower.join()
        remove_pipes(case)
    names = dict(zip(programs, (Path(balls[0]).name, Path(flow[0]).name)))
    failed = [program for program in sorted(programs, key=ended.index)
              if program.returncode and program not in stopped]
    ends = ", ".join(f"{names[program]} ended with {program.returncode}" for program in failed)
    if failed[:1] == programs[:1]:
        lines = log.read_text(errors="replace").splitlines()
        raise TogetherError(f"{ends}; {log} ends with:\n" + "\n".join(lines[-15:]))
    if failed:
        raise TogetherError(ends)
