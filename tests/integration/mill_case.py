# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the stages of a mill's case as its Allrun does; changes its dictionaries."""
import re
from pathlib import Path

from millfoam.run import run

SCRIPTS = Path(__file__).resolve().parents[2] / "scripts"
STAGES = 'cd "$1"; . "$2/case_functions"; . "$2/mill_stages"; shift 2; run_mill "$@"'


def run_mill(folder, mill, *changes, until=None, charge=None):
    """What the stages of the mill in a mill.yaml, changed by `path=value`, say; they run in a folder, up to one of
    them, and take the charge of another case's folder where one is given. RunError where a stage fails."""
    folder = Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    options = [word for change in changes for word in ("--set", change)]
    options += ["--until", until] if until else []
    options += ["--charge", charge] if charge else []
    return run(folder, "bash", "-c", STAGES, "run_mill", folder, SCRIPTS, ".", mill, *options)


def replace(path, *changes):
    """Replaces each pattern (pattern, new), which must be there once, in a dictionary of a case."""
    text = path.read_text()
    for pattern, new in changes:
        text, count = re.subn(pattern, new, text, flags=re.M)
        if count != 1:
            raise AssertionError(f"{path}: '{pattern}' found {count} times")
    path.write_text(text)
