#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The runs of the study: their names, and what each changes in the 30 cm mill's file."""
import argparse
import sys
from dataclasses import dataclass

SPEEDS = (75, 60)  # % of critical
SOLIDS = (20, 30, 40)  # % of the slurry's mass
LAWS = {75: ("Beetstra", "ErgunWenYu"), 60: ("Beetstra",)}
# What is not published of the mill, and of the way to compute it: name -> changes, and whether balls see them
UNKNOWNS = {
    "open_grates": (("geometry.pulp_lifters=~",), True),
    "narrow_lifters": (("geometry.lifters.width=0.005",), True),
    "wide_lifters": (("geometry.lifters.width=0.020",), True),
    "layers_17": (("resolution.layers=17",), False),
    "layers_66": (("resolution.layers=66",), False),
}
SEED = "dem.seed=20124"
DIRECT, ITERATED = "flow.coupling=direct", "flow.coupling=iterated"
# Changes from pass to pass are judged by means of three turns; more passes than these take days
PASSES = ("flow.passes=3",)
THREE_TURNS = ("flow.averages.start=1.8",)
# That of Beetstra_75_20, at the published level between balls at rest; between moving balls there is room for 4.91 l
SAME_VOLUME = ("flow.start={volume: 0.00371}",)
# One field of the charge for the whole flow: of all that follows its first turn and a half
WHOLE = ("averages.start=1.4", "averages.window=3.6", "flow.out_of_range=hold")
# Coarse and short, but a turn of the mill is averaged
QUICK = ("variant=quick", "flow.duration=2.1", "flow.averages.start=0.7", "flow.out_of_range=repeat")
QUICK_WHOLE = ("averages.start=0.3", "averages.window=0.2")
# The published voxels, of the slurry too
FULL = ("flow.averages.counts={across: 33, along: 33}",)
# A write of all fields takes 10 MB; the numbers are from tables and slurry.h5
ALWAYS = ("flow.write_interval=0.25",)


@dataclass(frozen=True)
class Run:
    """A run: speed (% of critical), solids (% of the slurry's mass; None: a dry run), law (None: no balls in the flow),
    changes of the mill's file, the dry run whose averages it takes or whose files it continues (`copies`)."""
    name: str
    speed: int
    solids: int | None = None
    law: str | None = None
    changes: tuple[str, ...] = ()
    dry: str | None = None
    copies: bool = False

    @property
    def way(self):
        """How it gets its charge: `dry` it makes one, `alone` none, `takes` the averages or `copies` the dry run."""
        if self.solids is None:
            return "dry"
        return "alone" if self.law is None else "copies" if self.copies else "takes"

    @property
    def feels_slurry(self):
        """Whether its balls feel the slurry, at the same time as the flow or in turn with it."""
        return not {DIRECT, ITERATED}.isdisjoint(self.changes)

    def settings(self, quick):
        """What it changes in the mill's file, as PATH=VALUE; quick: of the coarse and short form."""
        slurry = f"variant=slurry_{self.solids or 20}_speed_{self.speed}"
        balls = () if self.solids is None else ("flow.balls=no",) if self.law is None else (f"flow.law={self.law}",)
        if not quick:
            turns = THREE_TURNS if ITERATED in self.changes else ()
            return (slurry, *ALWAYS, *FULL, *balls, *self.changes, *turns)
        return (slurry, *ALWAYS, *QUICK, *FULL, *balls, *self.changes, *(QUICK_WHOLE if self.changes == WHOLE else ()))


def published():
    """The runs of the published study."""
    for speed in SPEEDS:
        yield from (Run(f"fluid_{speed}_{solids}", speed, solids) for solids in SOLIDS)
    for speed in SPEEDS:
        yield Run(f"dry_{speed}", speed)
        yield from (Run(f"{law}_{speed}_{solids}", speed, solids, law, dry=f"dry_{speed}")
                    for solids in SOLIDS for law in LAWS[speed])
    yield Run("whole_75_20", 75, 20, "Beetstra", WHOLE, "dry_75", copies=True)


def others():
    """Runs that change one thing of Beetstra_75_20 and fluid_75_20."""
    yield Run("direct_75_20", 75, 20, "Beetstra", (DIRECT, *SAME_VOLUME), "dry_75", copies=True)
    yield Run("iterated_75_20", 75, 20, "Beetstra", (ITERATED, *PASSES, *SAME_VOLUME), "dry_75", copies=True)
    for name, (changes, balls_see) in UNKNOWNS.items():
        yield Run(f"fluid_{name}", 75, 20, changes=changes)
        if balls_see:
            yield Run(f"dry_{name}", 75, changes=changes)
        yield Run(name, 75, 20, "Beetstra", changes, f"dry_{name}" if balls_see else "dry_75")
    yield Run("dry_seed", 75, changes=(SEED,))
    yield Run("seed", 75, 20, "Beetstra", (SEED,), "dry_seed")


PUBLISHED = frozenset(run.name for run in published())
RUNS = {run.name: run for run in (*published(), *others())}


def is_published(run):
    """Whether a run is one of the published study's, with the charge of the whole run left out: its flow is that of
    Beetstra_75_20 otherwise."""
    return run.name in PUBLISHED and not run.copies


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    what = parser.add_mutually_exclusive_group(required=True)
    what.add_argument("--names", action="store_true", help="prints the names of all runs")
    what.add_argument("--unknown", choices=UNKNOWNS, metavar="NAME",
                      help="prints whether balls see this change (yes or no), then its settings, one in a line")
    what.add_argument("--settings", choices=RUNS, metavar="RUN",
                      help="prints how it gets its charge and from which dry run, then its settings, one in a line")
    parser.add_argument("--quick", action="store_true", help="settings of the coarse and short form")
    options = parser.parse_args()
    if options.names:
        print(*RUNS, sep="\n")
        return 0
    if options.unknown:
        changes, balls_see = UNKNOWNS[options.unknown]
        print("yes" if balls_see else "no", *changes, sep="\n")
        return 0
    run = RUNS[options.settings]
    print(run.way, run.dry or "", *run.settings(options.quick), sep="\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
