# SPDX-License-Identifier: GPL-3.0-or-later
"""Dry runs of the published matrix, as studies make them: settings, their mills, their averages.

M. Malahe, MSc thesis, University of Cape Town, 2012: the 12 cm mill with 4 loads at 8 speeds, the 30 cm mill at 2
speeds. As a program it prints the setting of the charge of a load."""
import csv
import sys
from dataclasses import dataclass

from .mill_runs import ROOT, resolved

MILLS = {name: ROOT / "cases" / "mills" / f"mill_{name}" / "mill.yaml" for name in ("12cm", "30cm")}
LOADS = ROOT / "cases" / "studies" / "dem_matrix" / "loads.csv"
SPEEDS = tuple(range(40, 120, 10))  # % of critical
LEFT_OUT, WINDOW, VOXELS = 1.0, 0.1, 65  # of the averages: s, s, across the mill
DURATIONS = {("30cm", 60): 6.25, ("30cm", 75): 5.0}  # s; of the 12 cm mill:
DURATION = 4.0


@dataclass(frozen=True)
class Setting:
    """One run: mill, share of its volume that the charge fills (%), speed (% of critical)."""
    mill: str
    load: str
    speed: int

    @property
    def name(self):
        return f"{self.mill}_load{self.load}_speed{self.speed}"

    @property
    def duration(self):
        """Duration of the turning mill, s."""
        return DURATIONS.get((self.mill, self.speed), DURATION)


def published_loads():
    """Load (%) of the 12 cm mill as text -> [(diameter in m, mass in kg), …]."""
    with open(LOADS, newline="") as file:
        table = list(csv.DictReader(file))
    return {load: [(float(line["diameter_m"]), float(line[load])) for line in table]
            for load in table[0] if load != "diameter_m"}


def charge_setting(load):
    """The setting `path=value` of the 12 cm mill's charge with that published load (% as text). ValueError if it is
    none."""
    loads = published_loads()
    if load not in loads:
        raise ValueError(f"{LOADS}: no load {load} %; expected one of {', '.join(loads)}")
    return "charge.classes=[" + ", ".join(f"{{diameter: {diameter:g}, mass: {mass:g}}}"
                                          for diameter, mass in loads[load]) + "]"


def matrix():
    """Every run of the published matrix by name."""
    small = [Setting("12cm", load, speed) for load in published_loads() for speed in SPEEDS]
    large = [Setting("30cm", "31.25", speed) for speed in (60, 75)]
    return {setting.name: setting for setting in small + large}


def averages(voxels, start, window):
    """The setting of averages over the axis: voxels across the mill, in windows (s) from `start` (s) on."""
    return f"averages={{counts: {{across: {voxels}, along: 1}}, start: {start:g}, window: {window:g}}}"


def mill(setting, duration, slice_length, left_out=LEFT_OUT, window=WINDOW, changes=()):
    """The Mill of a run: the case's own, with this charge, speed and duration (s), and averaged on the published voxels
    over its length; a periodic slice of that length (m) unless it is 0 or None; with further settings `path=value`."""
    name = setting.mill.replace("cm", " cm")
    own = [f"title={name} mill, {setting.load} % load, {setting.speed} % of critical speed",
           f"speed.fraction_of_critical={setting.speed / 100:g}", f"dem.duration={duration:g}",
           averages(VOXELS, left_out, window), f"geometry.slice={f'{slice_length:g}' if slice_length else '~'}"]
    if setting.mill == "12cm":
        own.append(charge_setting(setting.load))
    return resolved(MILLS[setting.mill], (*own, *changes))


def run_name(name, slice_length):
    """Name of a run's folder; slices have folders of their own."""
    return name + (f"_slice{1e3 * slice_length:g}mm" if slice_length else "")


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(f"published_mills: expected one load in %, got {len(sys.argv) - 1} arguments")
    try:
        print(charge_setting(sys.argv[1]))
    except ValueError as error:
        sys.exit(str(error))
