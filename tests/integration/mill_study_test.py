# SPDX-License-Identifier: GPL-3.0-or-later
"""What the mill studies read off a flow, on slurries whose answers are known; and that runs are made once."""
import json
import shutil
import tempfile
import unittest
from pathlib import Path
from unittest import mock

import numpy as np

from dry_study_test import load
from millfoam.files.mill import read_mill
from millfoam.files.written_times import MillFlow
from millfoam.readings import shell_angles, slurry_in_cells
from millfoam.run import RunError, run, set_options
from millstudies import mill_runs
from millstudies.convergence import judge
from millstudies.mill_runs import Setting

TILT = 25.0  # of a pool's surface, degrees: it is higher on the rising side
TIMES = (0.1, 0.2, 0.3)
FIELD = ("FoamFile {{ version 2.0; format ascii; class vol{kind}Field; }}\n"
         "internalField nonuniform List<{item}> {count}\n(\n{rows}\n);\n")


def write_field(path, values):
    rows = values if values.ndim == 1 else [f"({' '.join(map(str, row))})" for row in values]
    kind, item = ("Scalar", "scalar") if values.ndim == 1 else ("Vector", "vector")
    path.write_text(FIELD.format(kind=kind, item=item, count=len(values), rows="\n".join(map(str, rows))))


def keys_of(mill, path=""):
    """A resolved mill's keys by their dotted path -> value."""
    found = {}
    for key, value in mill.items():
        found.update(keys_of(value, f"{path}{key}.") if isinstance(value, dict) else {path + key: value})
    return found


class ToeAndShoulder(unittest.TestCase):
    def ring(self, *arcs):
        """Share in the ring's bins: 1 within the arcs (begin, end) in degrees, 0 outside, straight over four bins
        between."""
        angles, share = shell_angles.bin_centres(), 0.0
        for begin, end in arcs:
            from_middle = np.abs((angles - (begin + end) / 2 + 180) % 360 - 180)
            share = share + np.clip(((end - begin) / 2 - from_middle) / (4 * shell_angles.BIN) + 0.5, 0, 1)
        return share

    def test_ends_of_an_arc_are_found_between_the_bins(self):
        np.testing.assert_allclose(shell_angles.toe_and_shoulder(self.ring((-41.3, 67.9))), (-41.3, 67.9), atol=1e-9)

    def test_slurry_may_reach_past_the_top(self):
        np.testing.assert_allclose(shell_angles.toe_and_shoulder(self.ring((10.4, 200.2))), (10.4, -159.8), atol=1e-9)

    def test_a_smaller_arc_is_not_the_slurry(self):
        np.testing.assert_allclose(shell_angles.toe_and_shoulder(self.ring((-20, 50), (90, 110))), (-20, 50), atol=1e-9)

    def test_no_slurry_and_nothing_else_have_no_ends(self):
        bins = len(shell_angles.bin_centres())
        self.assertTrue(np.all(np.isnan(shell_angles.toe_and_shoulder(np.zeros(bins)))))
        self.assertTrue(np.all(np.isnan(shell_angles.toe_and_shoulder(np.ones(bins)))))

    def test_angles_count_from_straight_down_to_the_rising_side(self):
        clockwise, other = -1.0, 1.0
        self.assertAlmostEqual(shell_angles.shell_angle(0.0, -1.0, clockwise), 0)
        self.assertAlmostEqual(shell_angles.shell_angle(-1.0, 0.0, clockwise), 90)
        self.assertAlmostEqual(shell_angles.shell_angle(1.0, 0.0, other), 90)


class TiltedPool(unittest.TestCase):
    """Half of the turning mill full of slurry, its surface through the axis; the balls everywhere of solidity 0.4."""

    @classmethod
    def setUpClass(cls):
        case = Path(tempfile.mkdtemp(prefix="tilted-pool-"))
        cls.addClassCleanup(shutil.rmtree, case)
        (case / "constant").mkdir()
        shutil.copy(mill_runs.TEMPLATE / "constant" / "bedProperties", case / "constant")
        run(case, "millMesh", mill_runs.MILL, "--case", ".", *set_options(mill_runs.FINE))
        for time in (0.0, *TIMES):
            (case / f"{time:g}").mkdir()
            (case / f"{time:g}" / "alpha.slurry").write_text("")
        cls.flow = MillFlow(case)
        for time, path in cls.flow.frames:
            cls.write_frame(time, path)
        cls.shape = slurry_in_cells.read_shape(cls.flow, TIMES[0])

    @classmethod
    def write_frame(cls, time, path):
        flow = cls.flow
        points, column = slurry_in_cells.samples(flow)
        x, y = flow.turned(points, time).T
        tilt = np.radians(TILT)
        # The mill turns clockwise: it rises at x < 0
        below = y + x * np.tan(tilt) < 0
        share = np.bincount(column, below, minlength=len(flow.column_centres)) / slurry_in_cells.SAMPLES**2
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
        frame = slurry_in_cells.read_frame(self.flow, *self.flow.frames[1])
        mass = 1239 * 0.6 * self.flow.volumes.sum() / 2
        x, y = self.flow.centres[:, :2].T
        inertia = 1239 * (frame.slurry * (x**2 + y**2)).sum()
        expected = 9.81 * mass * self.shape.numbers["centre_x"][0] + inertia  # spun up by 1 rad/s each second
        # The mesh turns by 37 degrees from time to time: the slurry's inertia is its cells'
        self.assertAlmostEqual(self.shape.numbers["torque"][0] / expected, 1, delta=2e-3)

    def test_slurry_on_the_rising_side_takes_power(self):
        torque, power = (self.shape.numbers[name][0] for name in ("torque", "power"))
        self.assertAlmostEqual(power / (torque * self.flow.omega / 0.024), 1)
        self.assertGreater(power, 0)

    def test_reynolds_number_is_that_of_the_slip(self):
        np.testing.assert_allclose(self.shape.reynolds_percentiles((5, 50, 95)), 1239 * 0.6 * 0.1 * 0.005 / 0.0014,
                                   rtol=1e-9)

    def test_share_map_is_a_tilted_half(self):
        wet = self.shape.share[np.isfinite(self.shape.share)]
        self.assertAlmostEqual(wet.mean(), 0.5, delta=0.01)


class MadeOnce(unittest.TestCase):
    """Runs whose programs, but millMesh, only leave the files that say they came to their end."""

    def setUp(self):
        self.runs = Path(tempfile.mkdtemp(prefix="made-once-"))
        self.addCleanup(shutil.rmtree, self.runs)
        self.commands, self.failing = [], None
        patched = mock.patch.object(mill_runs, "run", self.run_program)
        patched.start()
        self.addCleanup(patched.stop)

    def run_program(self, folder, name, *words):
        self.commands.append(name)
        if name == self.failing:
            raise RunError("stopped")
        if name == "millMesh":
            run(folder, name, *words)
        mill = read_mill(folder).fingerprint
        if name == "millAverage":
            self.assertTrue((folder / words[words.index("--case") + 1] / "mill.json").is_file())
            self.write(folder / "solids.json", {"format": "millfoam-averages", "mill": {"averages": mill["averages"]}})
            (folder / "solids.h5").write_text("")
        if name == "slurryFoam":
            self.assertTrue((folder / "solids.h5").is_file() and (folder / "0" / "U").is_file())
            self.write(folder / "postProcessing" / "flow" / "0" / "flow.json",
                       {"format": "millfoam-flow", "mill": {"flow": mill["flow"]}, "complete": True})

    def write(self, path, content):
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(json.dumps(content))

    def made(self, setting):
        """Programs that a setting's run takes."""
        self.commands.clear()
        self.case = mill_runs.make_run(setting, self.runs)
        return self.commands

    ALL = ["millMesh", "millDem", "millAverage", "millMesh", "slurryStart", "slurryFoam"]

    def test_a_complete_run_is_kept_and_a_changed_or_interrupted_one_is_made_again(self):
        plain = Setting("one")
        for self.failing in ("millDem", "millAverage", "slurryFoam"):
            with self.assertRaises(RunError):
                self.made(plain)
        self.failing = None
        (self.case_of("one") / "half").write_text("")
        self.assertEqual(self.made(plain), self.ALL[3:])
        self.assertFalse((self.case / "half").exists())
        self.assertEqual(self.made(plain), [])
        (self.case / "constant" / "g").write_text("value (0 -1.62 0);")
        self.assertEqual(self.made(plain), self.ALL[3:])
        self.assertEqual(self.made(Setting("one", flow=("flow.law=Ergun",))), self.ALL[3:])
        self.assertEqual(self.made(Setting("one", averages=("averages.window=0.1",))), self.ALL)
        self.assertEqual(self.made(plain), self.ALL[3:])
        summary = self.case / "postProcessing" / "flow" / "0" / "flow.json"
        self.write(summary, {**json.loads(summary.read_text()), "complete": False})
        self.assertEqual(self.made(plain), self.ALL[3:])

    def case_of(self, name):
        return self.runs / "flows" / name

    def test_flows_share_their_balls_and_averages_their_charge(self):
        self.made(Setting("one"))
        self.assertEqual(self.made(Setting("other", flow=("flow.law=Ergun",))), self.ALL[3:])
        self.made(Setting("window", averages=("averages.window=0.1",)))
        self.assertEqual(len(list(self.runs.glob("charge_*"))), 1)
        self.assertEqual(len(list(self.runs.glob("averages_*"))), 2)
        balls = {name: (self.case_of(name) / "solids.h5").resolve() for name in ("one", "other", "window")}
        self.assertEqual(balls["one"], balls["other"])
        self.assertNotEqual(balls["one"], balls["window"])

    def test_a_flow_on_another_mesh_takes_the_same_balls_and_only_it_says_so(self):
        beds = []
        for setting in (Setting("one"), Setting("coarse", flow=mill_runs.COARSE)):
            self.made(setting)
            beds.append(run(self.case, "foamDictionary", "constant/bedProperties", "-keywords").split())
        self.assertEqual((self.case_of("one") / "solids.h5").resolve(),
                         (self.case_of("coarse") / "solids.h5").resolve())
        self.assertIn("fingerprint", beds[0])
        self.assertEqual([line for line in beds[0] if line not in beds[1]], ["fingerprint"])

    def test_a_setting_changes_what_it_says_and_nothing_else(self):
        plain = keys_of(mill_runs.resolved(mill_runs.MILL, mill_runs.BASE).content["mill"])
        steps = mill_runs.time_step_limits(0.5)
        other = keys_of(mill_runs.resolved(mill_runs.MILL, (
            *mill_runs.BASE, *mill_runs.COARSE, *steps, "flow.law=Ergun", "flow.multiplier=0")).content["mill"])
        limits = {f"flow.{key}" for key in mill_runs.LIMITS}
        changed = {key for key in plain if plain[key] != other.get(key)}
        # The mesh's cells and layers set the usual voxels and slices of the flow's averages
        self.assertEqual(changed,
                         {"resolution.cell_size", "resolution.layers", "flow.law", "flow.multiplier", "flow.slices",
                          "flow.averages.voxel_size", *limits})
        self.assertEqual(plain.keys(), other.keys())
        for key in limits:
            self.assertAlmostEqual(other[key], plain[key] / 2)

    def test_every_run_of_the_studies_is_accepted_and_asks_for_what_it_names(self):
        folder = mill_runs.ROOT / "cases" / "studies"
        drag, resolution = (load(folder / name / f"{name}.py") for name in ("mill_drag_comparison", "mill_resolution"))
        for mesh, prefix, cells in (((), "", 0.003), (mill_runs.COARSE, "coarse_", 0.0045)):
            settings = {one.name: one
                        for one in [*drag.settings(mesh, prefix), *resolution.study(bool(prefix))[0].values()]}
            mills = {name: mill_runs.resolved(mill_runs.MILL, (*mill_runs.BASE, *one.averages, *one.flow))
                     for name, one in settings.items()}
            self.assertEqual(len({mill.fingerprint["flow"] for mill in mills.values()}), len(mills))
            for law in drag.laws():
                self.assertEqual(mills[prefix + law].flow("law"), law)
                self.assertEqual(mills[prefix + law].asked("resolution", "cell_size"), cells)
            self.assertEqual(mills[prefix + "no_drag"].flow("multiplier"), 0)
            whole = mills[prefix + "whole_run"].content["derived"]["averages"]
            self.assertEqual((whole["start_s"], whole["window_s"]), (1.0, 0.6))
            self.assertEqual(mills[prefix + "window_0.025"].asked("averages", "window"), 0.025)
            shapes = [mills[prefix + name].content["derived"]["averages"]["shape"]
                      for name in ("voxel_7.33mm", resolution.BASE, "voxel_16.5mm")]
            self.assertEqual(shapes, [[18, 18, 3], [12, 12, 2], [8, 8, 1]])
            for mill in mills.values():
                self.assertEqual((mill.length, mill.derived("charge", "balls")), (0.024, 3521))
                self.assertEqual(mill.flow("duration_s"), 0.6)

    def test_a_setting_of_an_unknown_key_is_refused(self):
        with self.assertRaisesRegex(RunError, "flow.maxCo' is unknown"):
            mill_runs.resolved(mill_runs.MILL, ["flow.maxCo=1"])


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
