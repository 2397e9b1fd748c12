# SPDX-License-Identifier: GPL-3.0-or-later
"""Waits for what other programs do."""
import time


def wait_for(condition, seconds):
    """Whether the condition comes true within so many seconds."""
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        if condition():
            return True
        time.sleep(0.02)
    return False
