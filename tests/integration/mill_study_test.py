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
from millfoam.readings.means import Mean
from millfoam.run import RunError, run
from millstudies import mill_runs, steady_flows
from millstudies.convergence import judge
from millstudies.mill_runs import Setting

TILTS = (25.0, 29.0)  # of a pool's surface in two turns, degrees: it is higher on the rising side
TIMES_OF_TURN = 4
SHARE, SOLIDITY = 0.9, 0.4  # of slurry below the surface; of the balls on the rising side
BALANCE = ("Time_s", "holdUp_m3", "x_m", "y_m", "power_W")
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
    """Half of the turning mill full of slurry with some air in it, its surface through the axis, steeper in the second
    of two turns; balls on the rising side only."""

    @classmethod
    def setUpClass(cls):
        case = Path(tempfile.mkdtemp(prefix="tilted-pool-"))
        cls.addClassCleanup(shutil.rmtree, case)
        mill = mill_runs.resolved(mill_runs.MILL, ("resolution.cell_size=0.003", "flow.turns=2",
                                                   "flow.averages.start=0"))
        mill_runs.write_mill(mill, case)
        (case / "constant").mkdir()
        shutil.copy(mill_runs.TEMPLATE / "constant" / "bedProperties", case / "constant")
        run(case, "millMesh", "mill.json", "--case", ".")
        for number in range(2 * TIMES_OF_TURN + 1):
            folder = case / f"{number * mill.turn / TIMES_OF_TURN:.10g}"
            folder.mkdir()
            (folder / "alpha.slurry").write_text("")
        cls.flow = MillFlow(case)
        for number, (time, path) in enumerate(cls.flow.frames[1:]):
            cls.write_frame(time, path, TILTS[number // TIMES_OF_TURN])
        cls.write_table(case / "postProcessing" / "slurryBalance" / "0" / "slurryBalance.dat", mill.turn)
        cls.readings = steady_flows.read_turns(case)

    @classmethod
    def write_frame(cls, time, path, tilt):
        flow = cls.flow
        points, column = slurry_in_cells.samples(flow)
        x, y = flow.turned(points, time).T

        def share_of_columns(inside):
            return (np.bincount(column, inside, len(flow.column_centres)) / slurry_in_cells.SAMPLES**2)[flow.column]

        # The mill turns clockwise: it rises at x < 0
        write_field(path / "alpha.slurry", SHARE * share_of_columns(y + x * np.tan(np.radians(tilt)) < 0))
        write_field(path / "solidity", SOLIDITY * share_of_columns(x < 0))
        cells = len(flow.centres)
        write_field(path / "U", np.zeros((cells, 3)))
        write_field(path / "solidsVelocity", np.tile([0.1, 0.0, 0.0], (cells, 1)))
        write_field(path / "solidsDiameter", np.full(cells, 0.005))

    @classmethod
    def write_table(cls, path, turn):
        """Height -15 mm, then -13 mm; x 2 mm; power 10 mW, then 20 mW. A row is of the time before it."""
        times = turn * np.arange(1, 401) / 200
        later = times > turn * (1 + 1e-9)
        columns = times, 1e-4 + 0 * times, 0.002 + 0 * times, -0.015 + 0.002 * later, 0.01 + 0.01 * later
        path.parent.mkdir(parents=True)
        rows = ["\t".join(f"{value:.17g}" for value in row) for row in zip(*columns)]
        path.write_text("\n".join(["# " + "\t".join(BALANCE), *rows]) + "\n")

    def assert_mean(self, name, value, error, delta):
        mean = self.readings.mean(name)
        self.assertAlmostEqual(mean.value, value, delta=delta, msg=name)
        self.assertAlmostEqual(mean.error, error, delta=delta, msg=name)

    def test_toe_and_shoulder_are_where_the_surface_meets_the_shell(self):
        # A cell of the mesh is 2.9 degrees long, a bin 3; the turns' means are 27 +- 2 degrees
        self.assert_mean("toe", np.mean(TILTS) - 90, 2, 0.75)
        self.assert_mean("shoulder", np.mean(TILTS) + 90, 2, 0.75)

    def test_numbers_of_the_table_are_means_of_turns(self):
        self.assert_mean("height", -14, 1, 1e-6)
        self.assert_mean("x", 2, 0, 1e-6)
        self.assert_mean("power", 0.015 / 0.024, 0.005 / 0.024, 1e-6)

    def test_a_height_that_differs_between_the_turns_is_not_steady(self):
        self.assertEqual(self.readings.steady, "no")
        self.assertRegex(self.readings.drift, "centre's y \\+2")

    def test_the_pool_is_the_slurry_clear_of_the_balls(self):
        by_turn = [(90 - tilt) / (90 - tilt + (1 - SOLIDITY) * (90 + tilt)) for tilt in TILTS]
        # The pool's border is in pixels of 2 mm, on a radius of 60
        self.assert_mean("pool", 100 * np.mean(by_turn), 50 * abs(np.diff(by_turn)[0]), 2)

    def test_air_in_the_wet_bed_is_what_the_slurry_lacks(self):
        # With some air of the cells that the surface cuts, of 3 mm on a radius of 60
        for name in ("cell air", "map air"):
            self.assert_mean(name, 100 * (1 - SHARE), 0, 2)

    def test_reynolds_number_is_that_of_the_slip(self):
        np.testing.assert_allclose(self.readings.reynolds_percentiles((5, 50)),
                                   1239 * (1 - SOLIDITY) * 0.1 * 0.005 / 0.0014, rtol=1e-9)

    def test_share_map_is_a_tilted_half(self):
        wet = self.readings.share[np.isfinite(self.readings.share)]
        self.assertAlmostEqual(wet.mean(), SHARE / 2, delta=0.01)


class LayersOfTurns(unittest.TestCase):
    """Mean heights of four layers in six turns, whose scatter is 1 mm."""

    def heights(self, offsets):
        scatter = 1e-3 * np.random.default_rng(1).standard_normal((6, 4))
        together = 0.05 * np.arange(6)[:, None]  # all layers move alike
        return together + np.asarray(offsets) + scatter

    def test_layers_that_differ_for_good_are_apart(self):
        heights = self.heights([0, 0.003, 0.006, 0.009])
        spread, (by_chance, limit) = steady_flows.spread_of(heights), steady_flows.chance_of(heights)
        self.assertAlmostEqual(spread.value, np.std([0, 3, 6, 9], ddof=1) * 1e-3, delta=5e-4)
        self.assertAlmostEqual(by_chance, 1e-3 / np.sqrt(6), delta=1.5e-4)
        self.assertLess(spread.error, 1e-3)
        self.assertGreater(spread.value, limit)

    def test_layers_that_differ_by_chance_are_not(self):
        heights = self.heights([0, 0, 0, 0])
        self.assertLess(steady_flows.spread_of(heights).value, steady_flows.chance_of(heights)[1])


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
            self.write(folder / "solids.json", {"format": "millfoam-averages", "mill": {"averages": mill["averages"]},
                                                "time0_s": 0.5})
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
        for setting in (Setting("one"), Setting("fine", flow=mill_runs.FINE)):
            self.made(setting)
            beds.append(run(self.case, "foamDictionary", "constant/bedProperties", "-keywords").split())
        self.assertEqual((self.case_of("one") / "solids.h5").resolve(),
                         (self.case_of("fine") / "solids.h5").resolve())
        self.assertIn("fingerprint", beds[0])
        self.assertEqual([line for line in beds[0] if line not in beds[1]], ["fingerprint"])

    def test_a_setting_changes_what_it_says_and_nothing_else(self):
        plain = keys_of(mill_runs.resolved(mill_runs.MILL, mill_runs.BASE).content["mill"])
        steps = mill_runs.time_step_limits(0.5)
        other = keys_of(mill_runs.resolved(mill_runs.MILL, (
            *mill_runs.BASE, *mill_runs.FINE, *steps, "flow.law=Ergun", "flow.multiplier=0")).content["mill"])
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
        own = [*drag.settings((), ""), *resolution.study(True)[0].values()]
        fine = drag.settings(mill_runs.FINE, "fine_")
        mills = {one.name: mill_runs.resolved(mill_runs.MILL, (*mill_runs.BASE, *one.averages, *one.flow))
                 for one in [*own, *fine]}
        self.assertEqual(len({mill.fingerprint["flow"] for mill in mills.values()}), len(mills))
        for prefix, cells, layers in (("", 0.0045, 10), ("fine_", 0.003, 20)):
            for law in drag.laws():
                self.assertEqual(mills[prefix + law].flow("law"), law)
                self.assertEqual(mills[prefix + law].asked("resolution", "cell_size"), cells)
                self.assertEqual(mills[prefix + law].asked("resolution", "layers"), layers)
            self.assertEqual(mills[prefix + "no_drag"].flow("multiplier"), 0)
            whole = mills[prefix + "whole_run"].content["derived"]["averages"]
            self.assertEqual((whole["start_s"], whole["window_s"]), (1.0, 1.0))
        self.assertEqual(mills["window_0.025"].asked("averages", "window"), 0.025)
        self.assertEqual(mills["no_tension_3mm"].slurry("surface_tension_N_m"), 0)
        self.assertEqual([mills[name].asked("resolution", "cell_size") for name in ("cells_1.5mm", "no_tension_3mm")],
                         [0.0015, 0.003])
        self.assertEqual([mills[f"layers_{count}"].content["derived"]["resolution"]["layers"] for count in (4, 8, 16)],
                         [4, 8, 16])
        shapes = [mills[name].content["derived"]["averages"]["shape"]
                  for name in ("voxel_7.33mm", resolution.BASE, "voxel_16.5mm")]
        self.assertEqual(shapes, [[18, 18, 3], [12, 12, 2], [8, 8, 1]])
        for mill in mills.values():
            self.assertEqual((mill.length, mill.derived("charge", "balls")), (0.024, 3521))
            self.assertAlmostEqual((mill.flow("duration_s") - mill.flow("averages_start_s")) / mill.turn, 6, delta=1e-3)

    def test_the_studies_take_the_mills_own_case_for_more_turns(self):
        own = keys_of(mill_runs.resolved(mill_runs.MILL).content["mill"])
        base = keys_of(mill_runs.resolved(mill_runs.MILL, mill_runs.BASE).content["mill"])
        self.assertEqual({key for key in own if own[key] != base.get(key)}, {"flow.turns", "flow.averages.start"})

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

    def test_four_sizes_are_fitted_and_scatter_widens_the_bar(self):
        sizes = np.array([1.5, 2.25, 3.0, 4.5])
        exact = 10 + 0.3 * sizes
        found = judge(sizes, exact, 4.5)
        self.assertAlmostEqual(found.limit, 10, places=6)
        self.assertAlmostEqual(found.bar, 1.25 * 0.3 * 4.5, places=6)
        off = judge(sizes, exact + [0.1, -0.1, 0.1, 0], 4.5)
        self.assertGreater(off.bar, found.bar / 2)
        scattered = judge(sizes, [10.0, 12.0, 9.0, 11.0], 4.5)
        self.assertTrue(np.isnan(scattered.order) and np.isnan(scattered.limit))
        self.assertGreater(scattered.bar, 3)

    def test_a_family_is_seen_where_two_values_differ_by_more_than_their_errors(self):
        seen = load(mill_runs.ROOT / "cases" / "studies" / "mill_resolution" / "mill_resolution.py").seen
        self.assertTrue(seen([Mean(1, 0.1), Mean(1.5, 0.1), Mean(1.2, 0.1)]))
        self.assertFalse(seen([Mean(1, 0.1), Mean(1.4, 0.1), Mean(1.2, 0.1)]))

    def test_two_sizes_are_taken_as_first_order(self):
        found = judge((0.5, 1.0), [2.0, 2.4], 1.0)
        self.assertAlmostEqual(found.limit, 1.6)
        self.assertAlmostEqual(found.bar, 1.25 * 0.8)


if __name__ == "__main__":
    unittest.main(verbosity=2)
