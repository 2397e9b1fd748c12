#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The fed mill's first hundredths of a second, coarse and without balls: what is fed is there, what is written can be
resumed."""
import re
import shutil
import sys
import tempfile
import unittest
from pathlib import Path

import h5py
import numpy as np

from millfoam.files import foam
from millfoam.files.tables import read_columns
from millfoam.files.written_times import MillFlow
from millfoam.readings import axial
from millfoam.run import run
from mill_case import run_mill

CASE = Path(__file__).resolve().parents[2] / "cases" / "mills" / "mill_30cm"
FEED, HALF, END, WRITTEN = 65.3e-6, 0.01, 0.02, 0.008  # m3/s, s: ends of two runs, and what does not divide them
# Short steps: the pool at the start reaches the outlet's lip, and splashes over it in long ones
CHANGES = ("flow.max_time_step=0.001",
           "resolution={counts: {gap: 2, lifter: 1, height: 1, ring: 10}, layers: 9}", "geometry.pulp_lifters.layers=2",
           "flow.balls=no", f"flow.duration={END}", f"flow.write_interval={WRITTEN}",
           "flow.averages={start: 0, window: 0.02, interval: 0.005}")


class FedMill(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.case = Path(tempfile.mkdtemp(prefix="mill-30cm-"))
        cls.addClassCleanup(shutil.rmtree, cls.case)
        # As Allrun's variant fluid_only_75
        cls.stages = run_mill(cls.case, CASE / "mill.yaml", *CHANGES, until="start")
        for end in (HALF, END):  # the second resumes from the first's last time
            run(cls.case, "foamDictionary", "-entry", "endTime", "-set", end, "system/controlDict")
            run(cls.case, "slurryFoam")
        cls.flow = MillFlow(cls.case)

    def start_volume(self):
        """Volume of the slurry at time 0, m3."""
        return (self.flow.field("alpha.slurry", self.flow.frames[0][1]) * self.flow.volumes).sum()

    def test_a_flow_without_balls_takes_no_charge(self):
        self.assertEqual(re.findall(r"^Running (\w+):", self.stages, re.M), ["mesh", "check", "start"])

    def test_both_ends_are_met_and_written_whatever_the_interval(self):
        times = [time for time, _ in self.flow.frames]
        np.testing.assert_allclose(times, [0, WRITTEN, HALF, HALF + WRITTEN, END], atol=1e-12)

    def test_what_was_measured_goes_on_from_the_first_end(self):
        columns = read_columns(self.case, "slurryBalance")
        np.testing.assert_allclose(columns["fed"], FEED * columns["Time"], rtol=1e-6)
        self.assertLess(np.abs(columns["missing"]).max(), 1e-10 * columns["holdUp"][0])
        with h5py.File(self.case / "slurry.h5") as file:
            self.assertEqual(list(file["window/ends_short"][:]), [0])
            np.testing.assert_allclose((file["window/begin"][0], file["window/end"][0]), (0, END), atol=1e-9)

    def test_the_slurry_grows_by_the_feed(self):
        times, volumes = axial.slurry_volumes(self.case)
        self.assertAlmostEqual(times[-1], END, delta=1e-9)
        self.assertEqual(len(list((self.case / "postProcessing" / "flow").glob("[0-9]*"))), 2)
        start = self.start_volume()
        # At rest the pool just reaches the outlet's lip: next to nothing leaves in this time
        self.assertAlmostEqual((volumes[-1] - start) / (FEED * END), 1, delta=0.02)

    def test_the_pool_is_that_of_the_level(self):
        radius, level, length = 0.15, -0.0467, 0.305 + 0.033
        segment = radius ** 2 * np.arccos(-level / radius) + level * np.sqrt(radius ** 2 - level ** 2)
        start = self.start_volume()
        # Eight lifters of 1 cm2 are below that level
        self.assertAlmostEqual(start / ((segment - 8e-4) * length), 1, delta=0.005)

    def test_the_profile_along_the_axis_is_flat_at_first(self):
        profile = axial.axial_profile(self.flow, 0)
        self.assertEqual(len(profile.z), 9)
        self.assertLess(np.ptp(profile.height[:-1]), 2e-3)
        self.assertAlmostEqual(profile.height.mean(), -0.09, delta=0.01)

    def test_profiles_are_drawn(self):
        output = run(self.case, sys.executable, CASE / "axial.py", ".")
        self.assertRegex(output, r"feed 65\.3 ml/s, discharge")
        self.assertIn("\n3 Gaussians: not known: 9 places along the axis;", output)
        for name in ("axial.csv", "axial.png", "z_velocity.png"):
            self.assertGreater((self.case / "pictures" / name).stat().st_size, 300, name)

    def test_slurry_enters_by_the_feed_alone(self):
        alpha = foam.read_field(self.flow.frames[-1][1] / "alpha.slurry", self.flow.mesh.cells)
        self.assertGreaterEqual(alpha.min(), -1e-8)
        self.assertLessEqual(alpha.max(), 1 + 1e-8)
        height = self.flow.turned(self.flow.centres[:, :2], END)[:, 1]
        away = (self.flow.centres[:, 2] > 0.1) & (height > 0.0) & (np.hypot(*self.flow.centres[:, :2].T) < 0.12)
        self.assertLess(alpha[away].max(), 1e-6)


if __name__ == "__main__":
    unittest.main(verbosity=2)
