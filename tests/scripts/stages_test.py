#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Functions of scripts/case_functions and scripts/mill_stages on folders of a few files."""
import fcntl
import gzip
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
SCRIPTS = ROOT / "scripts"
FUNCTIONS = (SCRIPTS / "case_functions").read_text()
# What follows the setup of the machine
FUNCTIONS = FUNCTIONS[FUNCTIONS.index("# Programs say in many ways"):]
PYTHON = f"MILLFOAM_PYTHON={sys.executable}\n"
END = "\n// ************************************************************************* //\n"


class Stages(unittest.TestCase):
    def setUp(self):
        self.folder = Path(self.enterContext(tempfile.TemporaryDirectory(prefix="stages-")))

    def write(self, name, text):
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
        return path

    def bash(self, commands):
        """Exit code, output and messages of commands after both files' functions."""
        done = subprocess.run(["bash", "-c", f"set -eu -o pipefail\n{FUNCTIONS}\n. {SCRIPTS}/mill_stages\n{commands}"],
                              text=True, cwd=self.folder, capture_output=True)
        return done.returncode, done.stdout, done.stderr


class Dictionaries(Stages):
    def test_what_an_editor_leaves_is_none(self):
        for name in ("system/controlDict", "constant/g", "0.orig/U"):
            self.write(name, name)
        before = self.bash("dictionaries")
        self.assertEqual(before[0], 0)
        for name in ("system/.controlDict.swp", "system/controlDict~", "0.orig/#U#", "constant/bedProperties.unused"):
            self.write(name, "another")
        self.assertEqual(self.bash("dictionaries"), before)
        self.write("system/controlDict", "changed")
        self.assertNotEqual(self.bash("dictionaries"), before)


class Solvers(Stages):
    def test_a_change_that_was_killed_loses_no_dictionary(self):
        names = [path.relative_to(SCRIPTS / "mill_case" / "interFoam")
                 for path in (SCRIPTS / "mill_case" / "interFoam").rglob("*") if path.is_file()]
        for name in names:
            self.write(name, "own slurryFoam")
            self.write(f"{name}.interFoam", "own interFoam")
        first = names[0]
        moves = (f"mv {first} {first}.slurryFoam", f"mv {first}.interFoam {first}")
        for killed_after in range(3):
            with self.subTest(killed_after=killed_after):
                before = "; ".join(moves[:killed_after]) or "true"
                code, _, errors = self.bash(f"mill_template={SCRIPTS}/mill_case; {before}; change_solver interFoam")
                self.assertEqual(code, 0, errors)
                self.assertEqual({(self.folder / name).read_text() for name in names}, {"own interFoam"})
                self.bash(f"mill_template={SCRIPTS}/mill_case; change_solver slurryFoam")
                self.assertEqual({(self.folder / name).read_text() for name in names}, {"own slurryFoam"})


class Removal(Stages):
    def test_folders_in_which_an_allrun_works_stay(self):
        for name in ("runs/a", "runs/b"):
            self.write(f"{name}/.stages/lock", "")
        code, _, errors = self.bash("exec 8> runs/b/.stages/lock; flock -n 8; remove_runs runs quick")
        self.assertEqual(code, 1)
        self.assertIn("an Allrun works in runs/b; nothing was removed", errors)
        self.assertTrue((self.folder / "runs" / "a").is_dir())
        self.assertEqual(self.bash("remove_runs runs quick")[0], 0)
        self.assertFalse((self.folder / "runs").exists())

    # Lock of a program in a run, and the run that it is in
    LOCKS = {"runs/a/.stages/lock": "runs/a", "runs/a/dem/lock": "runs/a", "runs/a/direct/dem/lock": "runs/a/direct",
             "runs/a/solids.h5.lock": "runs/a", "runs/flows/a/postProcessing/flow/.lock": "runs/flows/a",
             "runs/.charge_0a.lock": "runs/charge_0a", "runs/flows/.a.lock": "runs/flows/a", "runs/a.lock": "runs/a"}

    def test_each_lock_of_a_program_keeps_them(self):
        for lock, run in self.LOCKS.items():
            with self.subTest(lock=lock):
                self.write("runs/whole/dumps/dump.0.txt", "balls")
                with open(self.write(lock, ""), "w") as held:
                    fcntl.flock(held, fcntl.LOCK_EX)
                    code, _, errors = self.bash("remove_runs runs")
                    who = "an Allrun" if ".stages" in lock else "a program"
                    self.assertEqual((code, errors), (1, f"bash: {who} works in {run}; nothing was removed\n"))
                    self.assertTrue((self.folder / "runs" / "whole").is_dir())
                self.assertEqual(self.bash("remove_runs runs"), (0, "", ""))
                self.assertFalse((self.folder / "runs").exists())

    def test_allclean_of_every_study_keeps_the_runs_in_which_a_program_works(self):
        shutil.copytree(SCRIPTS, self.folder / "scripts", ignore=shutil.ignore_patterns("millfoam", "__pycache__"))
        studies = {}
        for path in ROOT.glob("cases/studies/*/Allclean"):
            commands = re.sub("(?m)^#.*$", "", path.read_text())
            if folders := re.findall(r"\b(?:runs|quick|runs_quick)\b(?=[ \n])", commands):
                studies[path.parent.name] = folders
        self.assertGreaterEqual(set(studies), {"dem_12cm", "dem_matrix", "softening", "mill_drag_comparison"})
        environment = {name: value for name, value in os.environ.items() if name != "MILLFOAM_DIR"}
        for study, folders in studies.items():
            there = self.write(f"cases/studies/{study}/log.study", "").parent
            shutil.copy(ROOT / "cases" / "studies" / study / "Allclean", there)
            for folder in folders:
                with self.subTest(study=study, folder=folder):
                    lock = self.write(there / folder / "a" / "dem" / "lock", "")
                    self.write(there / "log.study", "")

                    def clean():
                        return subprocess.run([there / "Allclean"], text=True, capture_output=True, env=environment)
                    with open(lock, "w") as held:
                        fcntl.flock(held, fcntl.LOCK_EX)
                        done = clean()
                        self.assertEqual((done.returncode, done.stderr),
                                         (1, f"Allclean: a program works in {folder}/a; nothing was removed\n"))
                        self.assertTrue(lock.exists() and (there / "log.study").exists())
                    self.assertEqual(clean().returncode, 0)
                    self.assertEqual([path.name for path in there.iterdir()], ["Allclean"])


class HalfWritten(Stages):
    LIST = ("foamListTimes() { local last=no; [ $# -lt 3 ] || last=yes; cd \"$2\"; "
            "if [ $last = yes ]; then written_times | tail -n 1; else written_times; fi; }\n")

    def dropped(self):
        code, output, errors = self.bash(self.LIST + "drop_half_written")
        return code, output + errors, sorted(path.name for path in self.folder.iterdir())

    def test_a_whole_flow_is_kept_also_compressed(self):
        for time in ("0", "0.1", "0.2"):
            self.write(f"{time}/U", "U" + END)
            (self.folder / time / "p_rgh.gz").write_bytes(gzip.compress(f"p_rgh{END}".encode()))
        self.assertEqual(self.dropped(), (0, "", ["0", "0.1", "0.2"]))

    def test_a_time_that_was_killed_is_computed_again(self):
        for time in ("0", "0.1", "0.2"):
            self.write(f"{time}/U", "U" + (END if time != "0.2" else ""))
        self.assertEqual(self.dropped(), (0, "time 0.2 is not complete and is computed again\n", ["0", "0.1"]))

    def test_a_first_time_without_the_state_of_the_functions_is_computed_again(self):
        """There is no time before it that shows which files it should have; the state is written last."""
        self.write("system/controlDict", "functions\n{\n}\n")
        state = "uniform/functionObjects/functionObjectProperties"
        for time in ("0", "0.1"):
            self.write(f"{time}/U", "U" + END)
        self.assertEqual(self.dropped(), (0, "time 0.1 is not complete and is computed again\n", ["0", "system"]))
        for name in ("U", state):
            self.write(f"0.1/{name}", "U" + END)
        self.assertEqual(self.dropped(), (0, "", ["0", "0.1", "system"]))

    def test_files_of_another_form_do_not_cost_the_whole_flow(self):
        for time in ("0", "0.1", "0.2", "0.3", "0.4"):
            self.write(f"{time}/U", "U without an end")
        code, said, left = self.dropped()
        self.assertEqual((code, left), (1, ["0", "0.1", "0.2"]))
        self.assertIn("time 0.2 is not complete, nor are the two after it", said)


class HalfWrittenByRanks(Stages):
    """Times that ranks killed at different moments leave, as OpenFOAM's foamListTimes sees them."""

    def setUp(self):
        super().setUp()
        head = "FoamFile { version 2.0; format ascii; class dictionary; object controlDict; }\n"
        self.write("system/controlDict", head + "startTime 0; endTime 1; deltaT 0.05; writeInterval 0.05;\n")

    def write_time(self, rank, time, end=END, names=("U", "alpha.slurry")):
        for name in names:
            self.write(f"processor{rank}/{time}/{name}", "FoamFile\n{\n}\n" + (end if name == "U" else END))

    def left(self):
        """Times of each rank."""
        code, _, errors = self.bash("drop_half_written")
        self.assertEqual(code, 0, errors)
        return [sorted(path.name for path in (self.folder / f"processor{rank}").iterdir()) for rank in (0, 1)]

    def test_a_time_that_a_rank_wrote_half_goes_from_all_ranks(self):
        for rank in (0, 1):
            for time in ("0", "0.05", "0.1"):
                self.write_time(rank, time)
        self.write_time(0, "0.15")
        self.write_time(1, "0.15", end="")
        self.assertEqual(self.left(), [["0", "0.05", "0.1"]] * 2)

    def test_a_first_time_without_the_state_of_a_rank_s_functions_goes(self):
        with open(self.folder / "system" / "controlDict", "a") as file:
            file.write("functions\n{\n}\n")
        names = ("U", "uniform/functionObjects/functionObjectProperties")
        for second, left in ((names[:1], ["0"]), (names, ["0", "0.05"])):
            self.write_time(0, "0.05", names=names)
            self.write_time(1, "0.05", names=second)
            for rank in (0, 1):
                self.write_time(rank, "0")
            self.assertEqual(self.left(), [left] * 2)

    def test_a_time_without_all_fields_goes(self):
        for rank in (0, 1):
            self.write_time(rank, "0", names=("U",))
            self.write_time(rank, "0.05")
            self.write_time(rank, "0.1", names=("U",))
        self.assertEqual(self.left(), [["0", "0.05"]] * 2)

    def test_a_time_that_not_all_ranks_have_goes(self):
        for rank in (0, 1):
            self.write_time(rank, "0")
        self.write_time(1, "0.05")
        self.assertEqual(self.left(), [["0"]] * 2)

    def test_whole_times_stay(self):
        for rank in (0, 1):
            for time in ("0", "0.05"):
                self.write_time(rank, time)
        self.assertEqual(self.left(), [["0", "0.05"]] * 2)


class Starting(Stages):
    def test_a_start_that_cannot_be_copied_is_no_start(self):
        code, output, _ = self.bash("slurryStart() { echo started; }\nstart_flow || echo failed")
        self.assertEqual((code, output), (0, "failed\n"))
        self.write("0.orig/U", "U")
        self.assertEqual(self.bash("slurryStart() { echo started; }\nstart_flow")[:2], (0, "started\n"))

    def test_balls_at_the_same_time_have_windows_no_longer_than_the_flow(self):
        stubs = ("millMesh() { printf '%s\\n' \"$@\"; }\n"
                 "json_value() { case $2 in mill.flow.duration) echo 0.3 ;; mill.dem.record_interval) echo 0.01 ;;\n"
                 "    mill.flow.write_interval) echo 0.05 ;; mill.averages.window) echo \"$given\" ;; esac; }\n")
        for window, taken in (("0.05", "0.05"), ("0.4", "0.3"), ("whole", "whole")):
            code, output, errors = self.bash(f"{stubs}given={window}\ndirect_mill")
            self.assertEqual(code, 0, errors)
            self.assertIn(f"averages.window={taken}\n", output)
            self.assertIn("flow.write_interval=0.05", output)
        self.assertEqual(list(self.folder.iterdir()), [])


class Inputs(Stages):
    def test_a_value_that_cannot_be_read_is_no_input(self):
        usual = {"source": "mill", "mill.averages.live": "false", "fingerprint.averages": "123",
                 "mill.dem.dumps": "true", "mill.dem.contact_statistics": "false"}
        for values, inputs in ((usual, "ABC\n"), (usual | {"mill.averages.live": "true"}, "ABC with averages 123\n"),
                               (usual | {"mill.dem.dumps": "false"}, "ABC without dumps\n"),
                               (usual | {"mill.dem.contact_statistics": "true"}, "ABC with contact statistics\n")):
            self.assertEqual(self.charge_inputs(values), (0, inputs))
        for key in usual:
            known = {name: value for name, value in usual.items() if name != key}
            code, output = self.charge_inputs(known)
            self.assertNotEqual(code, 0, key)
            self.assertEqual(output, "")

    def charge_inputs(self, values):
        """Exit code and output of it where only these values can be read."""
        cases = " ".join(f"{key}) echo {value} ;;" for key, value in values.items())
        return self.bash(f"json_value() {{ local key; for key in \"${{@:2}}\"; do\n"
                         f"case $key in {cases} *) return 137 ;; esac; done; }}\n"
                         "inputs=$(charge_inputs ABC)\necho \"$inputs\"")[:2]

    def test_values_of_a_file_are_a_line_each_or_none(self):
        self.write("mill.json", '{"mill": {"live": true, "title": "two words", "window": 0.05}, "flow": null}')
        keys = "mill.live mill.title flow mill.window"
        self.assertEqual(self.bash(f"{PYTHON}json_value mill.json {keys}"), (0, "true\ntwo words\nNone\n0.05\n", ""))
        for more, named in (("mill.layers", "mill.layers"), ("flow.law", "flow.law"), ("mill.title.x", "mill.title.x")):
            code, output, errors = self.bash(f"{PYTHON}json_value mill.json {keys} {more} mill.live")
            self.assertEqual((code, output), (1, ""))
            self.assertIn(f"Allrun: mill.json: no '{named}'", errors)
        self.assertIn("Allrun: none.json: no 'a'", self.bash(f"{PYTHON}json_value none.json a b")[2])


class Ratio(Stages):
    """Of the slurry's viscosities, in a case whose files are older than the key."""

    def require(self, ratio, entry):
        self.write("constant/transportProperties", f"slurry {{ BinghamCoeffs {{ viscosityRatio {entry}; }} }}")
        return self.bash(f"json_value() {{ echo {ratio}; }}\nrequire_viscosity_ratio constant/transportProperties")

    def test_that_a_file_would_ignore_is_refused(self):
        for ratio, entry in (("1000.0", "1000"), ("1000.0", "$slurryViscosityRatio"),
                             ("5000.0", "$slurryViscosityRatio")):
            self.assertEqual(self.require(ratio, entry), (0, "", ""))
        code, _, errors = self.require("5000.0", "1000")
        self.assertEqual(code, 1)
        self.assertIn("constant/transportProperties does not take the mill's slurry.viscosity_ratio, 5000.0; expected "
                      "$slurryViscosityRatio there", errors)


class Waiting(Stages):
    """Two Allruns of a study that need the same dry run: the second waits."""
    HELD = ("(exec {held}> .stages/lock; flock -n $held; echo > held; until [ -e waits ]; do sleep 0.05; done; %s) &\n"
            "until [ -e held ]; do sleep 0.05; done\n"
            "flock() { [ \"$1\" = -n ] || echo > waits; command flock \"$@\"; }\n"
            "waiting=yes\nlock_case\ncat done\n")

    def test_takes_the_lock_after_the_end_of_the_other_one(self):
        self.write(".stages/lock", "")
        code, output, errors = self.bash(self.HELD % "echo made > done")
        self.assertEqual((code, errors), (0, ""))
        self.assertEqual(output.splitlines(), [f"Waiting for the end of another Allrun in {self.folder}", "made"])

    def test_ends_where_the_folder_was_removed(self):
        self.write(".stages/lock", "")
        code, _, errors = self.bash(self.HELD % "rm -r .stages")
        self.assertEqual(code, 1)
        self.assertIn("was removed while this Allrun waited", errors)


class Cleaning(Stages):
    def test_refuses_a_folder_in_which_an_allrun_works(self):
        self.write("dumps/dump.0.txt", "balls")
        self.write(".stages/lock", "")
        code, _, errors = self.bash("(exec {held}> .stages/lock; flock -n $held; clean_mill)")
        self.assertEqual(code, 1)
        self.assertIn("another Allrun is running in", errors)
        self.assertTrue((self.folder / "dumps").is_dir())
        self.assertEqual(self.bash("clean_mill")[0], 0)
        self.assertFalse((self.folder / "dumps").exists())


if __name__ == "__main__":
    unittest.main()
