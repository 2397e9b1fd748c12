# SPDX-License-Identifier: GPL-3.0-or-later
"""Results that belong to another mill than mill.json's, which has changed since."""
from millfoam.files.mill_case import MillCase
from millfoam.report.stages import same_mill, stages

from .mill_runs import OTHER_MESH


def require_own_mill(case: MillCase) -> None:
    """RuntimeError, with file and fingerprints, if a stage of a case was made for another mill. A flow that takes the
    balls of another mesh (mill_runs.OTHER_MESH) must be the mill's own, its balls need not."""
    check = same_mill(case)
    if check.state == "fails" and not (takes_other_balls(case) and has_own_flow(case)):
        raise RuntimeError(f"its mill has changed: {check.found}")


def takes_other_balls(case: MillCase) -> bool:
    """Whether a case's flow was made to take the balls of another mesh."""
    bed = case.folder / "constant" / "bedProperties"
    return bed.is_file() and OTHER_MESH in bed.read_text()


def has_own_flow(case: MillCase) -> bool:
    """Whether the stages of a case that name a flow name that of its mill."""
    return all(stage.mill.get("flow") in (None, "", case.mill.fingerprint["flow"]) for stage in stages(case))
