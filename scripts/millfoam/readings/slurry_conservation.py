# SPDX-License-Identifier: GPL-3.0-or-later
"""Whether a flow conserves its slurry and takes in what is asked, from the columns of slurryBalance."""
import numpy as np

CONSERVED = 1e-10  # of the hold-up that may be missing; recorded flows have 4e-14 to 1e-13
AS_ASKED = 1e-6  # of the feed that may be fed too much or too little


def missing_share(columns: dict[str, np.ndarray]) -> float:
    """Largest volume of slurry that the balance misses at one of its times, over the largest hold-up. columns: of
    slurryBalance, m3 [n]."""
    return float(np.abs(columns["missing"]).max() / np.abs(columns["holdUp"]).max())


def feed_error(columns: dict[str, np.ndarray], feed: float) -> float:
    """Largest difference, at one of the times, of the volume that was fed by the inlet's own flux from what was asked
    since the flow began, over all that was asked. columns: of slurryBalance, s and m3 [n]; feed: asked, above 0, m3/s.
    """
    times = columns["Time"]
    return float(np.abs(columns["fed"] - feed * times).max() / (feed * times[-1]))
