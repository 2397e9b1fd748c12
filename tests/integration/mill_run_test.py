# SPDX-License-Identifier: GPL-3.0-or-later
"""A shortened run of the 12 cm mill, every stage real: the result must be a mill.

The mill case itself with coarser cells and less time, run with the law's drag, with twice of it, and with none."""
import re
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

import numpy as np

from millfoam import foam, solids
from millfoam.mill_flow import MillFlow

CASE = Path(__file__).resolve().parents[2] / "cases" / "mills" / "mill_12cm"
START, END, LATE = 0.4, 0.4, 0.2  # DEM time at flow time 0; the flow's end; averages from then on, s
DRAGS = {"law": 1, "doubled": 2, "off": 0}


def call(name, *command, cwd):
    """Runs a stage; a failure shows the end of its log."""
    log = cwd / f"log.{name}"
    with open(log, "w") as out:
        done = subprocess.run([str(word) for word in command], cwd=cwd, stdout=out, stderr=subprocess.STDOUT)
    if done.returncode:
        raise AssertionError(f"{name} failed; its log ends with:\n" + "\n".join(log.read_text().splitlines()[-15:]))
    return log.read_text()


def replace(path, *changes):
    """Replaces each pattern, which must be there once, in a file of the case."""
    text = path.read_text()
    for pattern, new in changes:
        text, count = re.subn(pattern, new, text, flags=re.M)
        if count != 1:
            raise AssertionError(f"{path}: '{pattern}' found {count} times")
    path.write_text(text)


class MillRun(unittest.TestCase):
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
        replace(charge / "system" / "controlDict", (r"^endTime +[^;]+", f"endTime {END}"))
        call("mesh", "millMesh", "mill.yaml", "--case", ".", "--at-time", START, cwd=charge)
        call("dem", "millDem", "mill.yaml", "--case", ".", cwd=charge)
        length = foam.read_dictionary(charge / "constant" / "millProperties")["length"]
        cls.ledger = call("average", "millAverage", "--dumps", "dumps/dump.*.txt", "--box", -0.066, -0.066, 0, 0.066,
                          0.066, length, "--shape", 12, 12, 2, "--start", START, "--window", 0.05, "--periodic", "z",
                          "-o", "solids.h5", cwd=charge)
        shutil.copytree(charge / "0.orig", charge / "0")
        call("pool", "setAlphaField", cwd=charge)
        cls.flows = {name: cls.flow(charge, name, multiplier) for name, multiplier in DRAGS.items()}
        cls.solids = solids.read_map(charge / "solids.h5", START + LATE, START + END)

    @classmethod
    def flow(cls, charge, name, multiplier):
        case = cls.folder / name
        shutil.copytree(charge, case, ignore=shutil.ignore_patterns("dumps"))
        replace(case / "constant" / "fvOptions", (r"multiplier +\S+;", f"multiplier {multiplier};"))
        call("flow", "millInterFoam", cwd=case)
        return MillFlow(case)

    def late_centroid(self, name):
        """Mean centroid (x, y) of the slurry from LATE on, m."""
        flow = self.flows[name]
        return np.mean([flow.slurry_centroid(*frame) for frame in flow.frames if frame[0] >= LATE - 1e-9], axis=0)

    def test_charge_lies_on_the_rising_side_and_below_the_axis(self):
        x, y = self.solids.centroid()
        self.assertLess(x, -0.005)
        self.assertLess(y, -0.005)

    def test_slurry_lies_on_the_rising_side(self):
        self.assertLess(self.late_centroid("law")[0], -0.005)

    def test_doubled_drag_raises_the_slurry(self):
        self.assertGreater(self.late_centroid("doubled")[1], self.late_centroid("law")[1] + 1e-5)

    def test_without_drag_the_slurry_does_not_follow_the_charge(self):
        self.assertGreater(self.late_centroid("off")[0], self.late_centroid("law")[0] / 2)

    def test_slurry_is_conserved(self):
        for name, flow in self.flows.items():
            volumes = [flow.slurry_volume(path) for _, path in flow.frames]
            self.assertLess(np.ptp(volumes), 1e-3 * volumes[0], name)

    def test_every_cell_of_every_field_is_finite(self):
        for flow in self.flows.values():
            self.assertAlmostEqual(flow.frames[-1][0], END)
            for _, path in flow.frames:
                for field in ("U", "p_rgh", "alpha.slurry"):
                    self.assertTrue(np.all(np.isfinite(flow.field(field, path))))

    def test_slurry_is_slower_than_the_shell_on_average(self):
        flow = self.flows["law"]
        _, path = flow.frames[-1]
        weight = flow.field("alpha.slurry", path) * flow.volumes
        speed = np.linalg.norm(flow.field("U", path), axis=1)
        self.assertLess((speed * weight).sum() / weight.sum(), abs(flow.omega) * flow.radius)


if __name__ == "__main__":
    unittest.main(verbosity=2)
