# SPDX-License-Identifier: GPL-3.0-or-later
"""A shortened run of the 12 cm mill, every stage real: the result must be a mill.

The mill case itself with coarser cells and less time: slurryFoam with the law's drag and with none, and interFoam with
particleDrag."""
import re
import shutil
import tempfile
import unittest
from pathlib import Path

import numpy as np

from millfoam import foam, solids
from millfoam.mill_flow import MillFlow
from millfoam.run import run
from millfoam.slurry import read_slurry_map
from millfoam.tables import read_columns

ROOT = Path(__file__).resolve().parents[2]
CASE, SCRIPTS = ROOT / "cases" / "mills" / "mill_12cm", ROOT / "scripts"
START, END, LATE = 0.4, 0.4, 0.2  # DEM time at flow time 0; the flow's end; averages from then on, s
MULTIPLIERS = {"law": 1, "off": 0}  # on slurryFoam's drag


def replace(path, *changes):
    """Replaces each pattern, which must be there once, in a file of the case."""
    text = path.read_text()
    for pattern, new in changes:
        text, count = re.subn(pattern, new, text, flags=re.M)
        if count != 1:
            raise AssertionError(f"{path}: '{pattern}' found {count} times")
    path.write_text(text)


class MillRun(unittest.TestCase):
    logs = {}  # of slurryFoam, by name

    @classmethod
    def setUpClass(cls):
        cls.folder = Path(tempfile.mkdtemp(prefix="mill-run-"))
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        charge = cls.folder / "charge"
        charge.mkdir()
        for part in ("system", "constant", "0.orig"):
            shutil.copytree(CASE / part, charge / part, ignore=shutil.ignore_patterns("polyMesh", "millProperties"))
        shutil.copy(CASE / "mill.yaml", charge)
        replace(charge / "mill.yaml", (r"cell_size: \S+", "cell_size: 0.005"), (r"layers: \S+", "layers: 3"),
                (r"  duration: \S+", f"  duration: {START + END}"))
        replace(charge / "system" / "controlDict", (r"^endTime +[^;]+", f"endTime {END}"),
                (r"^( +start +)[^;]+", rf"\g<1>{LATE}"))
        run(charge, "millMesh", "mill.yaml", "--case", ".", "--at-time", START)
        run(charge, "millDem", "mill.yaml", "--case", ".")
        length = foam.read_dictionary(charge / "constant" / "millProperties")["length"]
        run(charge, "millAverage", "--dumps", "dumps/dump.*.txt", "--box", -0.066, -0.066, 0, 0.066, 0.066, length,
            "--shape", 12, 12, 2, "--periodic", "z", "--inside", "walls/*.stl", "--start", START, "--window", 0.05,
            "-o", "solids.h5")
        shutil.copytree(charge / "0.orig", charge / "0")
        cls.flows = {name: cls.slurry_foam(charge, name, multiplier) for name, multiplier in MULTIPLIERS.items()}
        cls.flows["stock"] = cls.inter_foam(charge)
        cls.solids = solids.read_map(charge / "solids.h5", START + LATE, START + END)
        cls.print_summary()

    @classmethod
    def slurry_foam(cls, charge, name, multiplier):
        case = cls.folder / name
        shutil.copytree(charge, case, ignore=shutil.ignore_patterns("dumps"))
        replace(case / "constant" / "bedProperties", (r"multiplier +\S+;", f"multiplier {multiplier};"))
        run(case, "slurryStart")
        cls.logs[name] = run(case, "slurryFoam")
        return MillFlow(case)

    @classmethod
    def inter_foam(cls, charge):
        case = cls.folder / "stock"
        shutil.copytree(charge, case, ignore=shutil.ignore_patterns("dumps"))
        shutil.copytree(CASE / "stock.orig", case, dirs_exist_ok=True)
        (case / "constant" / "bedProperties").unlink()
        run(case, "setAlphaField")
        run(case, "millInterFoam")
        return MillFlow(case)

    @classmethod
    def print_summary(cls):
        print("centroid, mm:  charge  x {:.1f}  y {:.1f}".format(*1e3 * np.array(cls.solids.centroid())))
        for name in cls.flows:
            print("centroid, mm:  slurry, {}  x {:.1f}  y {:.1f};  slip over ball speed {:.2f}".format(
                name, *1e3 * cls.late_centroids(name).mean(axis=0), cls.slip(name)))

    @classmethod
    def late_centroids(cls, name):
        """Centroid (x, y) of the slurry, m, in every frame from LATE on."""
        flow = cls.flows[name]
        return np.array([flow.slurry_centroid(*frame) for frame in flow.frames if frame[0] >= LATE - 1e-9])

    @classmethod
    def slip(cls, name):
        """Mean slip |u_s - U| over mean |u_s| of the balls in slurry, from LATE on."""
        slip = speed = 0.0
        flow = cls.flows[name]
        for time, path in flow.frames:
            if time < LATE - 1e-9:
                continue
            weight = flow.field("solidity", path) * flow.field("alpha.slurry", path) * flow.volumes
            balls = flow.field("solidsVelocity", path)
            slip += (weight * np.linalg.norm(balls - flow.field("U", path), axis=1)).sum()
            speed += (weight * np.linalg.norm(balls, axis=1)).sum()
        return slip / speed

    def test_charge_lies_on_the_rising_side_and_below_the_axis(self):
        x, y = self.solids.centroid()
        self.assertLess(x, 0)
        self.assertLess(y, 0)

    def test_slurry_lies_on_the_rising_side(self):
        for name in ("law", "stock"):
            self.assertTrue(np.all(self.late_centroids(name)[:, 0] < 0), name)

    def test_without_drag_the_slurry_does_not_follow_the_charge(self):
        # The lifters alone carry some slurry up, but less than the charge does at any time; and among the balls the
        # slurry moves with them only where they drag it.
        self.assertTrue(np.all(self.late_centroids("off")[:, 0] > self.late_centroids("law")[:, 0]))
        self.assertLess(self.slip("law"), 0.5)
        self.assertGreater(self.slip("off"), 2 * self.slip("law"))

    def test_slurry_is_conserved(self):
        # What is written has eight digits
        for name, share in (("law", 1e-7), ("off", 1e-7), ("stock", 1e-3)):
            volumes = [self.flows[name].slurry(path).sum() for _, path in self.flows[name].frames[1:]]
            self.assertLess(np.ptp(volumes), share * volumes[0], name)

    def test_time_steps_stay_long(self):
        for name, log in self.logs.items():
            steps = np.array(re.findall(r"^deltaT = (\S+)", log, re.M), dtype=float)
            self.assertGreater(steps.min(), np.median(steps) / 20, name)

    def test_the_slurry_carries_a_part_of_the_balls_and_says_so(self):
        # At rest it would be their buoyancy, 1239/2700
        mean, high = self.flows["law"].load(LATE)
        self.assertGreater(mean, 0.1)
        self.assertLess(mean, 2)
        self.assertGreater(high, mean)

    def test_every_cell_of_every_field_is_finite(self):
        for flow in self.flows.values():
            self.assertAlmostEqual(flow.frames[-1][0], END)
            for _, path in flow.frames:
                for field in ("U", "p_rgh", "alpha.slurry"):
                    flow.field(field, path)  # raises where a value is not finite

    def test_slurry_is_slower_than_the_shell_on_average(self):
        # Nothing but the shell and what it lifts drives the slurry.
        flow = self.flows["law"]
        _, path = flow.frames[-1]
        weight = flow.field("alpha.slurry", path) * flow.volumes
        speed = np.linalg.norm(flow.field("U", path), axis=1)
        self.assertLess((speed * weight).sum() / weight.sum(), abs(flow.omega) * flow.radius)

    def test_slurry_is_balanced(self):
        for name, flow in self.flows.items():
            told = read_columns(flow.case, "slurryBalance")
            self.assertLess(np.abs(told["missing"]).max(), 1e-6 * told["holdUp"][0], name)

    def test_slurry_on_voxels_is_where_it_is_in_the_cells(self):
        flow = self.flows["law"]
        x, y = read_slurry_map(flow.case / "slurry.h5", START + LATE, START + END).centroid()
        np.testing.assert_allclose((x, y), self.late_centroids("law").mean(axis=0), atol=5e-4)

    def test_a_report_is_written(self):
        case = self.flows["law"].case
        run(case, SCRIPTS / "report", ".")
        text = (case / "report.html").read_text()
        for words in ("Slurry is conserved", "Tangential velocity", "Hold-up", "data:image/png", "level: -0.002"):
            self.assertTrue(words in text, words)


if __name__ == "__main__":
    unittest.main(verbosity=2)
