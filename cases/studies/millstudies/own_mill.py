# SPDX-License-Identifier: GPL-3.0-or-later
"""Results that belong to another mill than mill.json's, which has changed since."""
from millfoam.files.mill_case import MillCase
from millfoam.report.stages import same_mill


def require_own_mill(case: MillCase) -> None:
    """RuntimeError, with file and fingerprints, if a stage of a case was made for another mill."""
    check = same_mill(case)
    if check.state == "fails":
        raise RuntimeError(f"its mill has changed: {check.found}")
