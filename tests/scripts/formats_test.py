#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""FORMATS.md lists what the tools write: every key of theirs is on the page, and every key of the page is theirs."""
import json
import re
import sys
import tempfile
import unittest
from pathlib import Path
from unittest import mock

from millfoam.readings.means import Mean
from millfoam.readings.stirred_flow import StirredFlowNumbers
from millfoam.run import run
from study_scripts import load

ROOT = Path(__file__).resolve().parents[2]
MILLS = [ROOT / "cases" / "mills" / name / "mill.yaml" for name in ("mill_12cm", "mill_30cm", "stirred_A")]
# A mill that is small and differs from those: its slurry starts from a level, it has one size of balls
PLAIN = """geometry: {diameter: 0.12, length: 0.024, ends: periodic, lifters: {count: 0}}
speed: {angular_velocity: 6}
charge: {fill: 0.3, diameter: 0.008}
materials: {ball: glass, wall: glass, ball_wall: glass-glass}
slurry: {density: 1000, plastic_viscosity: 0.001, yield_stress: 0, level: -0.01}
flow: {turns: 12, steady: {hours: 1}}
"""
# A stirred mill may have discs
DISCS = "geometry.impeller.discs=[{height: 0.1, diameter: 0.14, thickness: 0.01}]"
HEAD = {"format", "program", "mill"}  # of every file, described once


def listed(heading):
    """Names in the first column of the tables below a heading of FORMATS.md, up to the next heading."""
    page = (ROOT / "FORMATS.md").read_text(encoding="utf-8")
    section = re.search(rf"^#+ {re.escape(heading)}\n(.*?)(?=^#|\Z)", page, re.M | re.S).group(1)
    rows = re.findall(r"^\| (`[^|]*) \|", section, re.M)
    return [name for row in rows for name in re.findall(r"`([^`]+)`", row)]


def keys(content, before=""):
    """Dotted paths of all values in JSON; `[]` means the items of a list of objects. A null has no keys."""
    found = set()
    for key, value in content.items():
        if isinstance(value, dict):
            found |= keys(value, f"{before}{key}.")
        elif isinstance(value, list) and value and isinstance(value[0], dict):
            for item in value:
                found |= keys(item, f"{before}{key}[].")
        else:
            found.add(before + key)
    return found


def without(found, *names):
    """The paths that are not, and do not lie in, one of the names."""
    return {path for path in found if path.split(".")[0].split("[")[0] not in names}


class Formats(unittest.TestCase):
    def setUp(self):
        self.folder = Path(self.enterContext(tempfile.TemporaryDirectory(prefix="formats-")))
        (self.folder / "mill.yaml").write_text(PLAIN)

    def written(self, name):
        return json.loads((self.folder / name).read_text())

    def same(self, heading, found):
        names = listed(heading)
        self.assertEqual(sorted(names), sorted(set(names)), f"{heading}: a key is twice on the page")
        self.assertEqual(sorted(names), sorted(found), heading)

    def test_the_resolved_mill(self):
        shape = "charge.shape={half_axes: [3, 2, 2], blockiness: 3}"
        mills = (*((mill,) for mill in MILLS), ("mill.yaml", "--set", shape), (MILLS[-1], "--set", DISCS),
                 (MILLS[-1], "--set", "variant=wet", "--set", "flow.coupling=direct"),
                 (next(mill for mill in MILLS if "30cm" in str(mill)), "--set", "flow.tracer={pulse: 0.5}"))
        resolved = [json.loads(run(self.folder, "millMesh", mill, *words, "--resolved", "-")) for mill, *words in mills]
        # Null, or an empty list, where the mill has none
        absent = {"geometry.inlet", "geometry.grates", "geometry.pulp_lifters", "geometry.impeller.discs",
                  "flow.steady", "flow"}
        self.same("derived", set().union(*(keys(mill["derived"]) for mill in resolved)) - absent)
        self.same("mill.json", set(resolved[0]) - {"format", "program"})

    def test_walls_and_mesh(self):
        run(self.folder, "millMesh", "mill.yaml", "--case", ".")
        self.same("walls/walls.json", set(self.written("walls/walls.json")) - HEAD)
        self.same("mesh.json", without(keys(self.written("mesh.json")), *HEAD))

    def test_the_plan_of_a_dry_run(self):
        run(self.folder, "millMesh", "mill.yaml", "--case", ".", "--walls")
        run(self.folder, "millDem", "mill.yaml", "--case", ".", "--deck-only")
        forecast = {"ranks", "rate_balls_steps_per_s", "wall_time_s", "disk_bytes", "memory_bytes"}
        self.same("dem/plan.json", without(keys(self.written("dem/plan.json")), *HEAD) | forecast)

    def test_averages(self):
        for record in range(2):
            (self.folder / f"dump.{100 * record}.txt").write_text(
                f"ITEM: TIMESTEP\n{100 * record}\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS ff ff pp\n0 1\n0 1\n0 1\n"
                "ITEM: ATOMS id type x y z vx vy vz radius\n1 1 0.5 0.5 0.5 0 0 0 0.1\n")
        run(self.folder, "millAverage", "--dumps", "dump.*.txt", "--dt", 1e-4, "--box", 0, 0, 0, 1, 1, 1, "--shape", 2,
            2, 2, "--window", 0.02, "-o", "solids.h5")
        self.same("solids.json", without(keys(self.written("solids.json")), *HEAD))

    def test_the_numbers_of_a_stirred_flow(self):
        with mock.patch.object(sys, "path", [str(ROOT / "cases" / "mills" / "stirred_A"), *sys.path]):
            study = load("mills/stirred_A/stirred_flow.py")
        one = Mean(1.0, 0.1)
        row = study.numbers_of(StirredFlowNumbers(0.0, 1.0, 2.0, {"impeller": one}, *[one] * 3, 0.0, *[one] * 4))
        names = listed("stirred.csv, flow.csv")
        for key in row:
            plain = key.replace("impeller", "PART").replace("_unbalanced_error", "_unbalanced")
            # The page says once what _error is
            self.assertTrue({plain, plain.replace("_error", "")} & set(names), key)
        of_slip = ("slip", "froude", "reynolds")
        self.assertEqual({name for name in names if name.startswith(of_slip)},
                         {key for key in row if key.startswith(of_slip)})

    def test_the_table_of_steps(self):
        source = (ROOT / "openfoam_module" / "record" / "step_table.cpp").read_text()
        self.same("steps.csv", re.findall(r'\{"(\w+)", \[\]\(const StepRow&', source))


if __name__ == "__main__":
    unittest.main()
