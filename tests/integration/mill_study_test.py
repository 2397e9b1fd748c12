# SPDX-License-Identifier: GPL-3.0-or-later
"""What the mill studies read off a flow, on slurries whose answers are known; and that runs are made once."""
import shutil
import tempfile
import unittest
from pathlib import Path

import numpy as np

from millfoam import mill_runs, slurry_shape
from millfoam.convergence import judge
from millfoam.mill_flow import MillFlow
from millfoam.run import RunError, run

TILT = 25.0  # of a pool's surface, degrees: it stands higher on the rising side
TIMES = (0.1, 0.2, 0.3)
FIELD = "FoamFile {{ version 2.0; format ascii; class vol{kind}Field; }}\ninternalField nonuniform List<{item}> {count}\n(\n{rows}\n);\n"


def write_field(path, values):
    rows = values if values.ndim == 1 else [f"({' '.join(map(str, row))})" for row in values]
    kind, item = ("Scalar", "scalar") if values.ndim == 1 else ("Vector", "vector")
    path.write_text(FIELD.format(kind=kind, item=item, count=len(values), rows="\n".join(map(str, rows))))


class ToeAndShoulder(unittest.TestCase):
    def ring(self, *arcs):
        """Share in the ring's bins: 1 within the arcs (begin, end) in degrees, 0 outside, straight over four bins between."""
        angles, share = slurry_shape.bin_centres(), 0.0
        for begin, end in arcs:
            from_middle = np.abs((angles - (begin + end) / 2 + 180) % 360 - 180)
            share = share + np.clip(((end - begin) / 2 - from_middle) / (4 * slurry_shape.BIN) + 0.5, 0, 1)
        return share

    def test_ends_of_an_arc_are_found_between_the_bins(self):
        np.testing.assert_allclose(slurry_shape.toe_and_shoulder(self.ring((-41.3, 67.9))), (-41.3, 67.9), atol=1e-9)

    def test_slurry_may_reach_past_the_top(self):
        np.testing.assert_allclose(slurry_shape.toe_and_shoulder(self.ring((10.4, 200.2))), (10.4, -159.8), atol=1e-9)

    def test_a_smaller_arc_is_not_the_slurry(self):
        np.testing.assert_allclose(slurry_shape.toe_and_shoulder(self.ring((-20, 50), (90, 110))), (-20, 50), atol=1e-9)

    def test_no_slurry_and_nothing_else_have_no_ends(self):
        bins = len(slurry_shape.bin_centres())
        self.assertTrue(np.all(np.isnan(slurry_shape.toe_and_shoulder(np.zeros(bins)))))
        self.assertTrue(np.all(np.isnan(slurry_shape.toe_and_shoulder(np.ones(bins)))))

    def test_angles_count_from_straight_down_to_the_rising_side(self):
        clockwise, other = -1.0, 1.0
        self.assertAlmostEqual(slurry_shape.shell_angle(0.0, -1.0, clockwise), 0)
        self.assertAlmostEqual(slurry_shape.shell_angle(-1.0, 0.0, clockwise), 90)
        self.assertAlmostEqual(slurry_shape.shell_angle(1.0, 0.0, other), 90)


class TiltedPool(unittest.TestCase):
    """Half of the turning mill full of slurry, its surface through the axis; the balls everywhere of solidity 0.4."""

    @classmethod
    def setUpClass(cls):
        case = Path(tempfile.mkdtemp(prefix="tilted-pool-"))
        cls.addClassCleanup(shutil.rmtree, case)
        (case / "constant").mkdir()
        for name in ("mill.yaml", "constant/bedProperties"):
            shutil.copy(mill_runs.MILL / name, case / name)
        run(case, "millMesh", "mill.yaml", "--case", ".", "--at-time", 1)
        for time in (0.0, *TIMES):
            (case / f"{time:g}").mkdir()
            (case / f"{time:g}" / "alpha.slurry").write_text("")
        (case / "log.slurryFoam").write_text("Time = 0.1\nTime = 0.2\n")
        cls.flow = MillFlow(case)
        for time, path in cls.flow.frames:
            cls.write_frame(time, path)
        cls.shape = slurry_shape.read_shape(cls.flow, TIMES[0])

    @classmethod
    def write_frame(cls, time, path):
        flow = cls.flow
        points, column = slurry_shape.samples(flow)
        x, y = flow.turned(points, time).T
        tilt = np.radians(TILT)
        # The mill turns clockwise: it rises at x < 0
        below = y + x * np.tan(tilt) < 0
        share = np.bincount(column, below, minlength=len(flow.column_centres)) / slurry_shape.SAMPLES**2
        x, y = flow.turned(flow.centres[:, :2], time).T
        cells = len(flow.centres)
        write_field(path / "alpha.slurry", share[flow.column])
        write_field(path / "U", time * np.stack([-y, x, 0 * x], axis=1))  # turning at the rate `time`
        write_field(path / "solidity", np.full(cells, 0.4))
        write_field(path / "solidsVelocity", np.stack([-time * y + 0.1, time * x, 0 * x], axis=1))
        write_field(path / "solidsDiameter", np.full(cells, 0.005))

    def test_toe_and_shoulder_are_where_the_surface_meets_the_shell(self):
        for name, angle in (("toe", TILT - 90), ("shoulder", TILT + 90)):
            # A cell of the mesh is 2.9 degrees long, a bin 3
            self.assertLess(abs(self.shape.numbers[name][0] - angle), 0.75, name)

    def test_centre_lies_on_the_normal_of_the_surface(self):
        x, y = (self.shape.numbers[name][0] for name in ("centre_x", "centre_y"))
        self.assertAlmostEqual(np.degrees(np.arctan2(-x, -y)), TILT, delta=0.5)

    def test_torque_is_the_weights_and_the_gain_of_angular_momentum(self):
        frame = slurry_shape.read_frame(self.flow, *self.flow.frames[1])
        mass = 1239 * 0.6 * self.flow.volumes.sum() / 2
        x, y = self.flow.centres[:, :2].T
        inertia = 1239 * (frame.slurry * (x**2 + y**2)).sum()
        expected = 9.81 * mass * self.shape.numbers["centre_x"][0] + inertia  # spun up by 1 rad/s each second
        # The mesh turns by 37 degrees from time to time: the slurry's inertia is its cells'
        self.assertAlmostEqual(self.shape.numbers["torque"][0] / expected, 1, delta=2e-3)

    def test_slurry_on_the_rising_side_takes_power(self):
        self.assertAlmostEqual(self.shape.numbers["power"][0] / (self.shape.numbers["torque"][0] * self.flow.omega / 0.024), 1)
        self.assertGreater(self.shape.numbers["power"][0], 0)

    def test_reynolds_number_is_that_of_the_slip(self):
        np.testing.assert_allclose(self.shape.reynolds_percentiles((5, 50, 95)), 1239 * 0.6 * 0.1 * 0.005 / 0.0014, rtol=1e-9)

    def test_share_map_is_a_tilted_half(self):
        wet = self.shape.share[np.isfinite(self.shape.share)]
        self.assertAlmostEqual(wet.mean(), 0.5, delta=0.01)


class MadeOnce(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp(prefix="made-once-")) / "run"
        self.addCleanup(shutil.rmtree, self.folder.parent)
        self.made = 0

    def make(self, folder):
        self.made += 1
        self.assertEqual(sorted(path.name for path in folder.iterdir()), ["constant", "mill.yaml"])
        (folder / "result").write_text("")

    def interrupted(self, folder):
        (folder / "half").write_text("")
        raise RunError("stopped")

    def test_a_whole_run_is_kept_and_a_changed_or_interrupted_one_is_made_anew(self):
        files = {"mill.yaml": "a: 1\n", "constant/g": "9.81"}
        with self.assertRaises(RunError):
            mill_runs.make_once(self.folder, files, self.interrupted)
        for _ in range(2):
            mill_runs.make_once(self.folder, files, self.make)
        self.assertEqual(self.made, 1)
        mill_runs.make_once(self.folder, {**files, "constant/g": "1.62"}, self.make)
        self.assertEqual(self.made, 2)

    def test_a_setting_changes_the_mill_case_and_nothing_else(self):
        plain = mill_runs.case_files(mill_runs.Setting("plain"))
        other = mill_runs.case_files(mill_runs.Setting("other", steps=0.5, cell_size=0.0045, layers=2, law="Ergun", multiplier=0))
        changed = {name for name in plain if plain[name] != other[name]}
        self.assertEqual(changed, {"mill.yaml", "system/controlDict", "constant/bedProperties"})
        lines = [pair for name in changed for pair in zip(plain[name].splitlines(), other[name].splitlines()) if len(set(pair)) > 1]
        self.assertEqual(len(lines), 8)  # cell size, layers; four limits on the time-step; law, multiplier

    def test_a_case_without_the_entry_is_refused(self):
        with self.assertRaisesRegex(RunError, "controlDict: 'maxCo' was found 0 times"):
            mill_runs.changed("maxAlphaCo 1;\n", "controlDict", {"maxCo": 1})


class ErrorBars(unittest.TestCase):
    SIZES = (2.3, 3.0, 4.5)

    def test_order_and_limit_of_an_exact_power_come_back(self):
        for order in (0.7, 1.0, 2.0):
            values = [10 + 0.3 * size**order for size in self.SIZES]
            found = judge(self.SIZES, values, 3.0)
            self.assertAlmostEqual(found.order, order, places=6)
            self.assertAlmostEqual(found.limit, 10, places=6)
            self.assertAlmostEqual(found.bar, 1.25 * 0.3 * 3.0**order, places=6)

    def test_what_is_not_monotone_has_no_order_and_its_range_as_bar(self):
        found = judge(self.SIZES, [1.0, 1.4, 0.8], 3.0)
        self.assertTrue(np.isnan(found.order) and np.isnan(found.limit))
        self.assertAlmostEqual(found.bar, 0.6)

    def test_two_sizes_are_taken_as_first_order(self):
        found = judge((0.5, 1.0), [2.0, 2.4], 1.0)
        self.assertAlmostEqual(found.limit, 1.6)
        self.assertAlmostEqual(found.bar, 1.25 * 0.8)


if __name__ == "__main__":
    unittest.main(verbosity=2)
