#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The runs of the study: their names, and what each changes in the file of mill A."""
import sys
from collections.abc import Iterator
from dataclasses import dataclass

from millstudies.mill_runs import resolved
from millstudies.stirred_settings import FILE, MILLS, print_settings

SPEEDS = {"1.8": 1.846, "2.2": 2.215, "1.5": 1.477}  # as the runs name it -> of the pins' tips, m/s
STARTING, TURNS = 0.8, 5  # s from the start of the impeller that are not read; turns of it that are
QUICK_STARTING, QUICK_TURNS = 0.1, 2
# A dump of mill C takes 3 MB
ALWAYS = ("dem.record_interval=0.01",)


@dataclass(frozen=True)
class Run:
    """A run: mill, a key of MILLS; speed of the pins' tips, a key of SPEEDS; slurry: dry or wet."""
    mill: str
    speed: str
    slurry: str = "dry"

    @property
    def name(self) -> str:
        """The name of the run and of its folder."""
        return f"{self.mill}_{self.speed}_{self.slurry}"

    def settings(self, quick: bool) -> tuple[str, ...]:
        """What it changes in the file, as PATH=VALUE; quick: of the short form. The last turns are averaged.
        RunError if millMesh cannot read the mill."""
        mill = (*MILLS[self.mill], f"speed.tip_speed={SPEEDS[self.speed]}")
        starting, turns = (QUICK_STARTING, QUICK_TURNS) if quick else (STARTING, TURNS)
        averaged = turns * resolved(FILE, mill).derived("speed", "turn_s")
        return (*mill, *ALWAYS, f"dem.duration={starting + averaged:.6f}", f"averages.start={starting}",
                f"averages.window={averaged:.6f}")


def all_runs() -> Iterator[Run]:
    """Every mill at every speed, dry: mill A first, because its run at 1.8 m/s is the shortest to compare."""
    for speed in SPEEDS:
        for mill in MILLS:
            yield Run(mill, speed)


RUNS = {run.name: run for run in all_runs()}


if __name__ == "__main__":
    sys.exit(print_settings(RUNS, __doc__))
