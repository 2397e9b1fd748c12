# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the stages of a mill's case as its Allrun does; changes its dictionaries."""
import fcntl
import os
import re
import signal
import subprocess
from pathlib import Path

import numpy as np

from millfoam.coupling.passes import direct_case, given
from millfoam.files.data_files import read_csv
from millfoam.run import run
from waiting import wait_for

SCRIPTS = Path(__file__).resolve().parents[2] / "scripts"
STAGES = 'cd "$1"; . "$2/case_functions"; . "$2/mill_stages"; shift 2; run_mill "$@"'
# Its steps but those of UNDRAWN, which a test does not look at
UNDRAWN = """eval "$(declare -f step | sed '1s/step/made_step/')"
step() { case " $UNDRAWN " in *" $1 "*) : > "log.$1" ;; *) made_step "$@" ;; esac; }
"""


def run_mill(folder, mill, *changes, until=None, charge=None, undrawn=""):
    """What the stages of the mill in a mill.yaml, changed by `path=value`, say; they run in a folder, up to one of
    them, and take the charge of another case's folder where one is given. undrawn: "pictures", "report" or both, which
    are left out. RunError where a stage fails."""
    folder = Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    options = [word for change in changes for word in ("--set", change)]
    options += ["--until", until] if until else []
    options += ["--charge", charge] if charge else []
    stages = STAGES.replace("run_mill", f"UNDRAWN='{undrawn}'\n{UNDRAWN}run_mill") if undrawn else STAGES
    return run(folder, "bash", "-c", stages, "run_mill", folder, SCRIPTS, ".", mill, *options)


def force_difference(direct, begin):
    """Relative difference between the mean force that a flow gives to balls that move at the same time, and the one
    that they take from a DEM time on, s; direct: folder of both."""
    force, _ = given(direct_case(direct))
    rows = read_csv(direct / "dumps" / "fluid.csv")
    within = rows["time_s"] > begin
    taken = np.array([np.mean(rows[f"force_{axis}_N"][within]) for axis in "xyz"])
    return np.linalg.norm(force - taken) / np.linalg.norm(force)


def is_free(lock):
    """Whether no process holds this file any more."""
    with open(lock) as file:
        try:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            return False
    return True


def kill_mill_when(folder, mill, condition):
    """Starts or resumes all stages of the mill in a mill.yaml, kills every process when the condition comes true, and
    gives what they said. AssertionError if they end before."""
    folder = Path(folder)
    said = folder / "output"
    with open(said, "w+") as output:
        process = subprocess.Popen(["bash", "-c", STAGES, "run_mill", folder, SCRIPTS, ".", mill], cwd=folder,
                                   stdout=output, stderr=subprocess.STDOUT, start_new_session=True)
        came = wait_for(lambda: condition() or process.poll() is not None, 120)
        ended = process.poll() is not None
        os.killpg(process.pid, signal.SIGKILL)
        process.wait()
    if ended or not came:
        raise AssertionError(said.read_text())
    locks = [folder / ".stages" / "lock", *folder.glob("**/dem/lock")]
    if not wait_for(lambda: all(map(is_free, locks)), 30):
        raise AssertionError("a process outlives Allrun")
    return said.read_text()


def replace(path, *changes):
    """Replaces each pattern (pattern, new), which must be there once, in a dictionary of a case."""
    text = path.read_text()
    for pattern, new in changes:
        text, count = re.subn(pattern, new, text, flags=re.M)
        if count != 1:
            raise AssertionError(f"{path}: '{pattern}' found {count} times")
    path.write_text(text)
