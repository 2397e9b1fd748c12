# SPDX-License-Identifier: GPL-3.0-or-later
"""A shortened run of the 12 cm mill, every stage but its pictures real: the result must be a mill; and what Allrun
makes again.

The mill itself with coarser cells, less time, and balls of 4 mm for those of 2 and 3 mm: slurryFoam with the law's drag
and with none, and interFoam with particleDrag."""
import fcntl
import os
import re
import shutil
import tempfile
import unittest
from pathlib import Path
from unittest import mock

import h5py
import numpy as np

from millfoam.files import foam, solids_file
from millfoam.files.data_files import read_json
from millfoam.files.flow_record import read_flow_record
from millfoam.files.mill_case import MillCase
from millfoam.files.slurry_file import read_slurry_map
from millfoam.files.tables import read_columns
from millfoam.files.written_times import MillFlow
from millfoam.report.stages import same_mill
from millfoam.run import RunError, run
from mill_case import run_mill
import mills_test

ROOT = Path(__file__).resolve().parents[2]
MILL = ROOT / "cases" / "mills" / "mill_12cm" / "mill.yaml"
START, END, LATE = 0.3, 0.4, 0.2  # DEM time at flow time 0; the flow's end; averages from then on, s
CLASSES = ((0.008, 0.091), (0.006, 0.133), (0.005, 0.155), (0.004, 0.444))  # m, kg
CHANGES = ("resolution={cell_size: 0.005, layers: 10}", "dem.youngs_modulus=5e6",
           f"charge.classes=[{', '.join(f'{{diameter: {size}, mass: {mass}}}' for size, mass in CLASSES)}]",
           f"dem.duration={START + END}", f"flow.duration={END}",
           f"averages={{voxel_size: 0.011, window: 0.05, start: {START}}}", "flow.write_interval=0.02",
           f"flow.averages={{start: {LATE}, window: 0.05}}")
os.environ["MILLFOAM_NP"] = "1"  # of all flows here
VARIANTS = {"law": (), "off": ("flow.multiplier=0",), "stock": ("flow.solver=interFoam",)}


class ShortMill(unittest.TestCase):
    """Three flows through one charge."""

    @classmethod
    def setUpClass(cls):
        cls.folder = Path(tempfile.mkdtemp(prefix="mill-run-"))
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        cls.flows = {}
        for name, changes in VARIANTS.items():
            run_mill(cls.folder / name, MILL, *CHANGES, *changes, undrawn="pictures",
                     charge=None if name == "law" else cls.folder / "law")
            cls.flows[name] = MillFlow(cls.folder / name)
        cls.solids = solids_file.read_map(cls.folder / "law" / "solids.h5", START + LATE, START + END)
        cls.print_summary()

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
        for name in ("law", "off"):
            steps = read_flow_record(self.folder / name).steps["deltaT_s"]
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
            columns = read_columns(flow.case, "slurryBalance")
            self.assertLess(np.abs(columns["missing"]).max(), 1e-6 * columns["holdUp"][0], name)

    def test_slurry_on_voxels_is_where_it_is_in_the_cells(self):
        flow = self.flows["law"]
        x, y = read_slurry_map(flow.case / "slurry.h5", START + LATE, START + END).centroid()
        np.testing.assert_allclose((x, y), self.late_centroids("law").mean(axis=0), atol=5e-4)

    def test_reports_are_written(self):
        for name, words in (("law", "multiplier: 1.0"), ("off", "multiplier: 0.0"), ("stock", "solver: interFoam")):
            text = (self.folder / name / "report.html").read_text()
            for part in ("Slurry is conserved", "Tangential velocity", "Hold-up", "data:image/png", words):
                self.assertTrue(part in text, f"{name}: {part}")


class Again(mills_test.GlassMill, unittest.TestCase):
    """A small mill that was run: what it is, and what a second call keeps, makes again and refuses."""
    CALLS = (("--until", "flow"), ())

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.whole = cls.case
        cls.again = cls.stages(cls.outputs[-1])
        # What these calls have set up is there
        cls.enterClassContext(mock.patch.dict(os.environ, without_setup="yes"))

    def setUp(self):
        folder = Path(tempfile.mkdtemp(prefix="mill-again-"))
        self.addCleanup(shutil.rmtree, folder)
        self.case = folder / "case"
        shutil.copytree(self.whole, self.case, symlinks=True)

    @staticmethod
    def stages(output):
        """(stages that were made, stages that were kept) of what an Allrun said."""
        return tuple(re.findall(rf"^{word} (\w+):", output, re.M) for word in ("Running", "Keeping"))

    def allrun(self, *options):
        """(stages that were made, stages that were kept) of an Allrun."""
        return self.stages(run(self.case, "./Allrun", *options))

    def refused(self, *command):
        """What a program says that fails, without its line breaks."""
        with self.assertRaises(RunError):
            run(self.case, *command)
        return " ".join((self.case / f"log.{Path(command[0]).name}").read_text().split())

    FLOW_STAGES = ["mesh", "check", "start", "flow"]

    def test_everything_is_kept_and_costs_are_of_all_calls(self):
        made, kept = self.again
        self.assertEqual(kept, ["walls", "charge", "average", *self.FLOW_STAGES])
        self.assertEqual(made, ["pictures", "report"])
        self.assertEqual(self.costs(), sorted(["walls", "charge", "average", *self.FLOW_STAGES, "pictures", "report"]))
        self.allrun("--set", "flow.law=Hill", "--until", "start")
        self.assertEqual(self.costs(), sorted(["walls", "charge", "average", *self.FLOW_STAGES]))

    def costs(self):
        """The stages of log.costs, sorted."""
        return sorted(line.split(",")[0] for line in (self.case / "log.costs").read_text().splitlines())

    def test_a_mill_that_a_tool_refuses_leaves_all_results_valid(self):
        poor = "resolution={counts: {gap: 1, lifter: 1, height: 1, ring: 40}, layers: 2}"
        for change, words in (("dem.dumps=no", "dem.dumps"), (poor, "choose another resolution")):
            costs = (self.case / "log.costs").read_text()
            for until in ((), ("--until", "charge")):
                self.assertIn(words, self.refused("./Allrun", "--set", change, *until))
            self.assertEqual(self.allrun("--until", "flow"), ([], ["walls", "charge", "average", *self.FLOW_STAGES]))
            for stage in ("charge", "mesh"):
                lines = [[line for line in text.splitlines() if line.startswith(f"{stage},")]
                         for text in (costs, (self.case / "log.costs").read_text())]
                self.assertEqual(lines[1][0], lines[0][0])
            self.assertNotIn("~", (self.case / "log.costs").read_text())

    def test_a_result_that_is_gone_is_made_again(self):
        for file, stage, until in (("0.05", "flow", "flow"), ("slurry.h5", "start", "flow"),
                                   ("constant/polyMesh/points", "mesh", "mesh"), ("solids.h5", "average", "average")):
            path = self.case / file
            shutil.rmtree(path) if path.is_dir() else path.unlink()
            made, _ = self.allrun("--until", until)
            self.assertEqual(made[0], stage)
            self.assertTrue(path.exists())

    def test_averages_without_dumps_say_which_stage_makes_them(self):
        for path in (self.case / "dumps").glob("dump.*.txt"):
            path.unlink()
        output = self.refused("./Allrun", "--set", "averages.window=0.05")
        self.assertIn("no dump.*.txt; expected those of the dry run: remove .stages/charge", output)
        self.assertEqual(self.allrun("--until", "flow"), ([], ["walls", "charge", "average", *self.FLOW_STAGES]))

    def test_files_of_the_owner_that_begin_with_a_digit_are_kept(self):
        (self.case / "2024-05-01").write_text("a note\n")
        (self.case / "30cm_2").mkdir()
        (self.case / "7").write_text("a file, not a time\n")
        self.allrun("--set", "flow.max_courant=0.4", "--until", "start")
        for name in ("2024-05-01", "30cm_2", "7"):
            self.assertTrue((self.case / name).exists(), name)
        self.assertFalse((self.case / "0.05").exists())

    def test_a_number_of_processes_is_checked_first(self):
        for number in ("abc", "0", "-1", "1.5"):
            with mock.patch.dict(os.environ, {"MILLFOAM_NP": number}):
                self.assertIn(f"MILLFOAM_NP is '{number}', the number of processes; expected a whole number from 1 on",
                              self.refused("./Allrun"))

    def test_another_law_makes_mesh_and_flow_again(self):
        made, kept = self.allrun("--until", "flow", "--set", "flow.law=Hill")
        self.assertEqual((made, kept), (self.FLOW_STAGES, ["walls", "charge", "average"]))
        self.assertEqual(read_json(self.case / "mill.json", "mill")["derived"]["flow"]["law"], "Hill")
        # The charge that was kept belongs to this mill too
        self.assertEqual(same_mill(MillCase(self.case)).state, "holds")

    def test_another_window_makes_the_averages_again(self):
        made, kept = self.allrun("--until", "flow", "--set", "averages.window=0.05")
        self.assertEqual((made, kept), (["average", *self.FLOW_STAGES], ["walls", "charge"]))
        self.assertEqual(read_json(self.case / "solids.json", "averages")["windows"], 4)

    def test_another_speed_makes_the_charge_again(self):
        made, kept = self.allrun("--until", "charge", "--set", "speed.fraction_of_critical=0.6")
        self.assertEqual((made, kept), (["charge"], ["walls"]))

    def test_two_at_a_time_are_refused(self):
        with open(self.case / ".stages" / "lock", "w") as lock:
            fcntl.flock(lock, fcntl.LOCK_EX)
            output = self.refused("./Allrun")
        self.assertIn("another Allrun is running in", output)

    def test_solids_of_an_older_dry_run_are_found(self):
        self.allrun("--until", "charge", "--set", "dem.seed=7")
        shutil.rmtree(self.case / ".stages")
        run(self.case, "millMesh", "mill.json", "--case", ".")
        for time in foam.times(self.case):
            shutil.rmtree(time[1])
        shutil.copytree(self.case / "0.orig", self.case / "0")
        output = self.refused("slurryStart")
        old, new = (read_json(folder / "mill.json", "mill")["fingerprint"]["averages"]
                    for folder in (self.whole, self.case))
        self.assertNotEqual(old, new)
        for words in ("solids.h5", old, new, "millAverage"):
            self.assertIn(words, output)

    def test_averages_of_dumps_of_another_mill_are_refused(self):
        output = self.refused("millAverage", "mill.yaml", "--case", ".", "--set", "dem.seed=7")
        self.assertIn("run millDem again", output)

    def test_a_flow_at_another_speed_than_the_charge_is_refused(self):
        properties = self.case / "constant" / "millProperties"
        run(self.case, "foamDictionary", "-entry", "omega", "-set", "2.5", properties)
        output = self.refused("slurryFoam")
        for words in ("2.5", "4.00287", "millAverage"):
            self.assertIn(words, output)

    def test_a_finished_flow_is_not_started_over(self):
        before = (self.case / "0.05" / "alpha.slurry").read_bytes()
        self.assertIn("0.05", self.refused("slurryStart"))
        self.assertEqual((self.case / "0.05" / "alpha.slurry").read_bytes(), before)

    def test_slurry_of_another_solver_is_conserved_and_back_from_it_the_flow_is_the_first_one(self):
        properties = self.case / "constant" / "bedProperties"
        properties.write_text(properties.read_text() + "// a change of the case's owner\n")
        dictionaries = {path: path.read_text() for folder in ("0.orig", "constant", "system")
                        for path in (self.case / folder).glob("*") if path.is_file()}
        made, kept = self.allrun("--until", "flow", "--set", "flow.solver=interFoam", "--set",
                                 "flow.write_interval=0.03")
        self.assertEqual((made, kept), (self.FLOW_STAGES, ["walls", "charge", "average"]))
        self.assertIn("slurry.gif", run(self.case, ROOT / "scripts" / "plot_mill", "."))
        # Whose balls displace none: its share of the whole cells
        flow = MillFlow(self.case)
        start = (flow.field("alpha.slurry", flow.frames[0][1]) * flow.volumes).sum()
        np.testing.assert_allclose([time for time, _ in flow.frames], [0, 0.03, 0.05], atol=1e-12)
        alpha = flow.field("alpha.slurry", flow.frames[-1][1])
        self.assertAlmostEqual((alpha * flow.volumes).sum() / start, 1, delta=1e-3)
        self.assertAlmostEqual(flow.slurry_volumes()[1] / start, 1, delta=1e-3)

        self.assertTrue((self.case / "constant" / "fvOptions").is_file())
        self.assertFalse(properties.exists())
        self.allrun("--until", "flow")
        self.assertFalse((self.case / "constant" / "fvOptions").exists())
        for path, text in dictionaries.items():
            if path.name != "millProperties":  # which has the versions' fingerprints
                self.assertEqual(path.read_text(), text, path)
        first, again = (MillFlow(case) for case in (self.whole, self.case))
        np.testing.assert_allclose(again.field("U", again.frames[-1][1]), first.field("U", first.frames[-1][1]),
                                   rtol=1e-9, atol=1e-12)

    def test_a_flow_without_balls_keeps_its_bed_for_the_next_with_them(self):
        properties = self.case / "constant" / "bedProperties"
        text = properties.read_text() + "// a change of the case's owner\n"
        properties.write_text(text)
        self.allrun("--set", "flow.balls=no", "--until", "start")
        self.assertFalse(properties.exists())
        self.allrun("--until", "start")
        self.assertEqual(properties.read_text(), text)

    def test_a_shorter_dry_run_starts_from_the_beginning(self):
        made, kept = self.allrun("--until", "average", "--set", "dem.duration=0.3")
        self.assertEqual((made, kept), (["charge", "average"], ["walls"]))
        self.assertAlmostEqual(read_json(self.case / "dumps" / "results.json", "charge")["duration_s"], 0.3)

    def test_a_plan_leaves_the_case_as_it_is(self):
        before = (self.case / "mill.json").read_bytes()
        self.allrun("--plan", "--set", "flow.law=Hill")
        self.assertEqual((self.case / "mill.json").read_bytes(), before)
        self.assertTrue((self.case / "plan.json").is_file())

    def test_a_charge_of_a_folder_without_averages_is_refused(self):
        self.assertIn("whose averages are made", self.refused("./Allrun", "--charge", "constant"))
        other = self.case.with_name("other")
        run(self.case, ROOT / "scripts" / "new_mill", "mill.yaml", other)
        for damage, words in ((lambda path: path.write_text(path.read_text()[:100]), "solids.json is missing or not"),
                              (lambda path: path.unlink(), "solids.json is missing or not"),
                              (lambda path: (path.parent / "solids.h5").unlink(), "no solids.h5; expected")):
            damage(self.case / "solids.json")
            with self.assertRaises(RunError) as refusal:
                run(other, "./Allrun", "--charge", self.case, "--until", "mesh")
            self.assertIn(words, str(refusal.exception))
            self.assertNotIn("Traceback", str(refusal.exception))

    def test_a_case_takes_the_charge_of_another_only_if_it_is_its_own(self):
        other = self.case.with_name("other")
        run(self.case, ROOT / "scripts" / "new_mill", "mill.yaml", other)
        run(other, "./Allrun", "--charge", self.case, "--until", "start")
        share = (other / "0" / "alpha.slurry").read_bytes()
        self.assertEqual(share, (self.case / "0" / "alpha.slurry").read_bytes())
        with self.assertRaisesRegex(RunError, "its averages have the fingerprint"):
            run(other, "./Allrun", "--charge", self.case, "--set", "dem.seed=7")
        self.assertEqual((other / "0" / "alpha.slurry").read_bytes(), share)
        self.assertEqual(read_json(other / "mill.json", "mill")["mill"],
                         read_json(self.case / "mill.json", "mill")["mill"])
        self.assertIn("has averages of its own", self.refused("./Allrun", "--charge", self.whole))

    def test_a_case_that_took_its_charge_makes_its_own_later(self):
        other = self.case.with_name("other")
        run(self.case, ROOT / "scripts" / "new_mill", "mill.yaml", other)
        run(other, "./Allrun", "--charge", self.case, "--until", "mesh")
        before = (self.case / "solids.json").read_bytes()
        run(other, "./Allrun", "--set", "dem.seed=7", "--until", "average")
        self.assertEqual((self.case / "solids.json").read_bytes(), before)
        self.assertFalse((other / "solids.h5").is_symlink() or (other / "solids.json").is_symlink())

    def test_other_walls_from_cad_make_the_charge_again(self):
        parts = [f"{path.stem}={path}" for path in sorted((self.case / "walls").glob("*.stl"))]
        run(self.case, "millMesh", "surface", *parts, "--case", ".", "--ends", "periodic")
        made, kept = self.allrun("--until", "charge")
        self.assertEqual((made, kept), (["charge"], ["walls"]))
        self.assertEqual(read_json(self.case / "walls" / "walls.json", "walls")["source"], "cad")
        # The mesh is that of the mill, and leaves these walls
        made, _ = self.allrun("--until", "mesh")
        self.assertEqual(made, ["average", "mesh"])
        self.assertIn("is from CAD and stays", (self.case / "log.mesh").read_text())
        self.assertEqual(read_json(self.case / "walls" / "walls.json", "walls")["source"], "cad")
        self.assertEqual(self.allrun("--until", "mesh"), ([], ["walls", "charge", "average", "mesh"]))

    def test_walls_from_cad_stay_from_the_first_allrun_on(self):
        other, drawn = self.case.with_name("other"), self.case.with_name("drawn")
        run(self.case, ROOT / "scripts" / "new_mill", "mill.yaml", other)
        low = "geometry.lifters.height=0.028"
        run(other, "millMesh", "mill.yaml", "--case", drawn, "--walls", "--set", low)
        parts = [f"{path.stem}={path}" for path in sorted((drawn / "walls").glob("*.stl"))]
        surface = ("millMesh", "surface", *parts, "--case", ".", "--ends", "periodic")
        lifters = other / "walls" / "lifters.stl"
        run(other, "millMesh", "mill.yaml", "--case", ".", "--walls")
        of_mill = lifters.read_bytes()
        run(other, *surface)
        of_cad = lifters.read_bytes()
        self.assertNotEqual(of_cad, of_mill)
        self.assertIn("Keeping walls: they are from CAD", run(other, "./Allrun", "--until", "walls"))
        self.assertEqual(lifters.read_bytes(), of_cad)
        # The geometry changes, and nobody has said that these walls are still its own
        changed = ("./Allrun", "--until", "walls", "--set", low)
        for _ in range(2):
            with self.assertRaisesRegex(RunError, "walls/walls.json: these walls from CAD were there before"):
                run(other, *changed)
        run(other, *surface)
        self.assertIn("Keeping walls: they are from CAD", run(other, *changed))
        self.assertEqual(lifters.read_bytes(), of_cad)
        run(other, "millMesh", "mill.yaml", "--case", ".", "--walls")
        self.assertIn("Running walls", run(other, "./Allrun", "--until", "walls"))
        self.assertEqual(lifters.read_bytes(), of_mill)

    def test_statistics_of_the_contacts_make_the_charge_again(self):
        made, _ = self.allrun("--until", "charge", "--set", "dem.contact_statistics=true")
        self.assertEqual(made, ["charge"])
        self.assertTrue([*(self.case / "dumps").glob("contact_*.csv")])

    def test_the_description_is_not_overwritten(self):
        before = (self.case / "mill.yaml").read_bytes()
        output = self.refused("millMesh", "mill.yaml", "--resolved", "mill.yaml")
        self.assertIn("exists and is not a resolved mill", output)
        self.assertIn("exists and is not HTML", self.refused(ROOT / "scripts" / "report", ".", "-o", "mill.yaml"))
        self.assertEqual((self.case / "mill.yaml").read_bytes(), before)

    def test_a_resolved_mill_goes_into_a_pipe(self):
        run(self.case, "bash", "-c", "mkfifo pipe; cat pipe > copy.json & "
            "millMesh mill.yaml --resolved pipe; wait; test -p pipe")
        self.assertEqual(read_json(self.case / "copy.json", "mill")["mill"],
                         read_json(self.case / "mill.json", "mill")["mill"])

    def test_a_flow_that_was_not_joined_is_reported_as_such(self):
        for time, path in foam.times(self.case):
            if time > 0:
                shutil.rmtree(path)
        (self.case / "processor0").mkdir()
        output = run(self.case, ROOT / "scripts" / "report", ".")
        self.assertIn("report.html", output)
        self.assertIn("reconstructPar", (self.case / "report.html").read_text())

    def test_averages_by_the_mill_are_those_by_hand(self):
        run(self.case, "millAverage", "--dumps", "dumps/dump.*.txt", "--box", -0.3, -0.3, 0, 0.3, 0.3, 0.1,
            "--shape", 8, 8, 1, "--periodic", "z", "--inside", "walls/*.stl", "--start", 0.2, "--window", 0.1,
            "-o", "by_hand.h5")
        run(self.case, "millAverage", "mill.yaml", "--case", ".")
        with h5py.File(self.case / "solids.h5") as mine, h5py.File(self.case / "by_hand.h5") as hand:
            for name in ("solidity", "velocity", "grid/insideFraction", "window/begin", "window/end"):
                np.testing.assert_allclose(mine[name][:], hand[name][:], rtol=1e-9, atol=1e-12, err_msg=name)


if __name__ == "__main__":
    unittest.main(verbosity=2)
