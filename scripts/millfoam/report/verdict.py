# SPDX-License-Identifier: GPL-3.0-or-later
"""A check of the report's list, and how its limit judges a number."""
from dataclasses import dataclass


@dataclass
class Check:
    """state: holds, look (doubtful), fails or unknown; advice: what to do if it does not hold; meaning: what a failure
    means for the numbers, only of checks that a longer run cannot make hold; undecided: whether it is doubtful only
    because its errors are too large."""
    name: str
    state: str
    found: str
    advice: str = ""
    meaning: str = ""
    undecided: bool = False

    @property
    def lasting(self) -> bool:
        """Whether a longer run cannot make the check hold."""
        return bool(self.meaning) and self.state in ("look", "fails")


def judged(name: str, value: float, limit: float, found: str, advice: str, *, doubtful: float | None = None,
           meaning: str = "") -> Check:
    """A check that holds up to `limit`, is doubtful up to `doubtful`, and fails beyond."""
    if value <= limit:
        return Check(name, "holds", found)
    return Check(name, "look" if doubtful is not None and value <= doubtful else "fails", found, advice, meaning)
