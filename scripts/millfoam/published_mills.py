# SPDX-License-Identifier: GPL-3.0-or-later
"""Dry runs of the published matrix, as studies make them: settings, their mill.yaml, their averages.

M. Malahe, MSc thesis, University of Cape Town, 2012: the 12 cm mill with 4 loads at 8 speeds, the 30 cm mill at 2 speeds."""
import csv
import re
from dataclasses import dataclass
from pathlib import Path

from .dry_runs import with_entries
from .run import RunError

CASES = Path(__file__).resolve().parents[2] / "cases"
LOADS = CASES / "studies" / "dem_matrix" / "loads.csv"
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
        """Of the turning mill, s."""
        return DURATIONS.get((self.mill, self.speed), DURATION)


def published_loads():
    """Load (%) of the 12 cm mill as text -> lines of charge.classes."""
    with open(LOADS, newline="") as file:
        table = list(csv.DictReader(file))
    return {load: [f"    - {{diameter: {line['diameter_m']}, mass: {line[load]}}}" for line in table]
            for load in table[0] if load != "diameter_m"}


def matrix():
    """Every run of the published matrix by name."""
    small = [Setting("12cm", load, speed) for load in published_loads() for speed in SPEEDS]
    large = [Setting("30cm", "31.25", speed) for speed in (60, 75)]
    return {setting.name: setting for setting in small + large}


def mill_text(setting, duration, slice_length):
    """mill.yaml of a run: of the case's own mill, with this charge, speed and duration (s); a periodic slice of that length (m)
    unless it is 0."""
    source = CASES / "mills" / ("mill_12cm/mill_full.yaml" if setting.mill == "12cm" else "mill_30cm/mill.yaml")
    text = with_entries(source.read_text(), fraction_of_critical=f"{setting.speed / 100:g}", duration=f"{duration:g}")
    if setting.mill == "12cm":
        lines = "\n".join(published_loads()[setting.load])
        text = replaced(text, r"(?m)^  classes:\n(    - .*\n)+", f"  classes:\n{lines}\n")
    if slice_length:
        text = replaced(text, r"(?m)^geometry:\n", f"geometry:\n  slice: {slice_length:g}\n")
    return text


def replaced(text, pattern, new):
    """The text with what the pattern finds, which must be there once, replaced."""
    text, count = re.subn(pattern, new, text)
    if count != 1:
        raise RunError(f"mill.yaml: '{pattern}' was found {count} times; expected once")
    return text


def radius_and_length(text):
    """Of a mill.yaml, m; the length of what is computed, a slice's if it is one."""
    value = {key: float(re.search(rf"^  {key}: +(\S+)", text, re.M).group(1)) for key in ("diameter", "length")}
    sliced = re.search(r"^  slice: (\S+)", text, re.M)
    return value["diameter"] / 2, float(sliced.group(1)) if sliced else value["length"]


def averaging(text, left_out=LEFT_OUT, window=WINDOW):
    """millAverage's options for a mill.yaml: the published voxels over the mill's length, in windows (s) from
    `left_out` (s) on."""
    radius, length = radius_and_length(text)
    options = ["--box", -radius, -radius, 0, radius, radius, length, "--shape", VOXELS, VOXELS, 1, "--start", left_out,
               "--window", window]
    return options + (["--periodic", "z"] if re.search(r"^  slice:", text, re.M) else [])


def run_name(name, slice_length):
    """Name of a run's folder; slices have folders of their own."""
    return name + (f"_slice{1e3 * slice_length:g}mm" if slice_length else "")
