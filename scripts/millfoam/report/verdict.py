# SPDX-License-Identifier: GPL-3.0-or-later
"""A check of the report's list, and how a number is judged by its limit."""
from dataclasses import dataclass


@dataclass
class Check:
    """state: holds, look (doubtful), fails or unknown; advice: what to do, where it does not hold; lasting: whether a
    longer run cannot make it hold, and then `meaning` says what that means for the numbers."""
    name: str
    state: str
    found: str
    advice: str = ""
    meaning: str = ""

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
