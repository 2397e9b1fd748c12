# SPDX-License-Identifier: GPL-3.0-or-later
"""Published numbers of three stirred mills: Ssebunnya, PhD thesis, University of Cape Town, 2024.

Its powers are printed 60 times too high (turns a minute taken as turns a second); they are divided by 60 here. They do
not agree with the power that its torques give, so that only ratios between runs are compared. Its numbers are over the
last five turns of runs of 5 s, at 1.8 m/s at the pins' tips where no other speed is given."""
from dataclasses import dataclass


@dataclass(frozen=True)
class DryRun:
    """A published dry run: mean speed of the balls, m/s; power, W."""
    speed: float
    power: float


@dataclass(frozen=True)
class WetRun:
    """A published run of spheres with slurry: mean speed of the balls, m/s; power that the impeller gives to the balls,
    and to balls and slurry, W for each m3 of slurry."""
    speed: float
    balls: float
    whole: float


# Mill and shape of its balls, groups of superquadrics
DRY = {("A", "group_1"): DryRun(0.713, 498 / 60), ("A", "group_3"): DryRun(0.545, 673 / 60),
       ("B", "group_3"): DryRun(0.500, 883 / 60)}
# Mill and speed of the tips, m/s
WET = {("A", "1.5"): WetRun(0.46, 275e3 / 60, 375e3 / 60), ("A", "1.8"): WetRun(0.60, 410e3 / 60, 558e3 / 60),
       ("A", "2.2"): WetRun(0.73, 531e3 / 60, 792e3 / 60), ("B", "1.8"): WetRun(0.59, 405e3 / 60, 524e3 / 60)}
# Mean speed of the balls with slurry in A, m/s, by their shape
WET_SPEEDS = {"spheres": WET["A", "1.8"].speed, "group_1": 0.668, "group_3": 0.573}
# Range of the solidity of group 3, dry: under the lower pins, and above that
SOLIDITY = {"below": (0.6, 0.8), "impeller": (0.3, 0.6)}
