#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The runs of the study: their names, and what each changes in the file of mill A."""
import json
import math
import sys
from dataclasses import dataclass

from millfoam.files.mill import Mill
from millstudies.mill_runs import resolved
from millstudies.stirred_settings import FILE, MILLS, print_settings

SPHERES = "spheres"
SHAPES = (SPHERES, "group_1", "group_2", "group_3")  # the groups are variants of mill A
STARTING, TURNS = 0.5, 5  # s from the start of the impeller that are not read; turns of it that are
QUICK_STARTING, QUICK_TURNS = 0.1, 1
RECORD = 0.01  # s between records, as published
# The Rayleigh time of edges of 0.6 mm would halve the time-step of group 3. With these, the tenth of the shortest
# contact limits it, as with the other shapes
SLOW_SHAPES = {"group_3": ("dem.rayleigh_fraction=0.45", "dem.settle_time=0.05")}


@dataclass(frozen=True)
class Run:
    """A run: mill, a key of MILLS; shape of the balls, one of SHAPES."""
    mill: str
    shape: str

    @property
    def name(self) -> str:
        """The name of the run and of its folder."""
        return f"{self.mill}_{self.shape}"

    def settings(self, quick: bool) -> tuple[str, ...]:
        """What it changes in the file, as PATH=VALUE; quick: of the short form. The last turns are averaged, rounded up
        to whole records. RunError if millMesh cannot read the mill."""
        spheres = resolved(FILE, MILLS[self.mill])
        starting, turns = (QUICK_STARTING, QUICK_TURNS) if quick else (STARTING, TURNS)
        averaged = RECORD * math.ceil(turns * spheres.derived("speed", "turn_s") / RECORD)
        return (*self.charge(spheres), *SLOW_SHAPES.get(self.shape, ()), f"dem.record_interval={RECORD:g}",
                f"dem.duration={starting + averaged:g}", f"averages.start={starting:g}",
                f"averages.window={averaged:g}")

    def charge(self, spheres: Mill) -> tuple[str, ...]:
        """Changes that give the mill, resolved with spheres, as many balls of the shape. Of the whole balls of a group,
        its first shapes may have one more each."""
        if self.shape == SPHERES:
            return MILLS[self.mill]
        group = (f"variant={self.shape}",)
        if self.mill == "A":
            return group
        classes = resolved(FILE, group).asked("charge", "classes")
        balls = int(spheres.derived("charge", "balls"))
        for k, one in enumerate(classes):
            one["number"] = balls // len(classes) + (k < balls % len(classes))
        return (*MILLS[self.mill], "charge=" + json.dumps({"classes": classes}))


# The first two are compared with the published power; then spheres, and what takes longest
RUNS = {run.name: run for run in (*(Run("A", shape) for shape in ("group_1", "group_3", SPHERES, "group_2")),
                                  *(Run(mill, shape) for shape in (SPHERES, "group_3") for mill in ("B", "C")))}


if __name__ == "__main__":
    sys.exit(print_settings(RUNS, __doc__))
