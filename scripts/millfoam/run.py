# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes and runs OpenFOAM cases from a template."""
import subprocess
from pathlib import Path


class RunError(RuntimeError):
    """A program that failed; the message names its log and shows the log's end."""


def write_parameters(case, **values):
    """Writes CASE/parameters, which the template's dictionaries include: one `key value;` a line."""
    (Path(case) / "parameters").write_text("".join(f"{key} {value};\n" for key, value in values.items()))


def run(case, *command, name=None):
    """Runs a command in a case folder into log.NAME (by default the program's name) and returns the log's text."""
    name = name or Path(str(command[0])).name
    log = Path(case) / f"log.{name}"
    with open(log, "w") as out:
        done = subprocess.run([str(word) for word in command], cwd=case, stdout=out, stderr=subprocess.STDOUT)
    text = log.read_text()
    if done.returncode:
        raise RunError(f"{name} failed; {log} ends with:\n" + "\n".join(text.splitlines()[-15:]))
    return text
