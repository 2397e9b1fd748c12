#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Words of an Allrun that need no tool: --help of mills, --list and --read of studies. Nothing is set up for them. And
the number of processes of scripts/env."""
import os
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


class Allrun(unittest.TestCase):
    def setUp(self):
        """A clone whose setup leaves a mark and fails."""
        self.root = Path(self.enterContext(tempfile.TemporaryDirectory())) / "clone"
        shutil.copytree(ROOT / "scripts", self.root / "scripts", ignore=shutil.ignore_patterns("__pycache__"))
        setup = self.root / "scripts" / "setup"
        setup.write_text("#!/bin/sh\ntouch \"$(dirname \"$0\")/was_set_up\"\nexit 1\n")

    def copy(self, folder):
        shutil.copytree(ROOT / folder, self.root / folder,
                        ignore=shutil.ignore_patterns("runs", "quick", "*.png", "dumps", "processor*"))

    def run_words(self, folder, *words):
        environment = {key: value for key, value in os.environ.items() if not key.startswith("MILLFOAM_ON_PATH")}
        return subprocess.run([self.root / folder / "Allrun", *words], capture_output=True, text=True, check=False,
                              env=environment)

    def assert_not_set_up(self):
        self.assertFalse((self.root / "scripts" / "was_set_up").exists())

    def test_help_of_a_mill_has_its_options_and_stages(self):
        folder = self.root / "mine"
        folder.mkdir()
        (folder / "Allrun").write_text('#!/usr/bin/env bash\n# From mill.yaml to a report.\n'
                                       'cd "$(dirname "$0")" || exit\n'
                                       '. ../scripts/case_functions\n. ../scripts/mill_stages\n'
                                       'run_mill . mill.yaml "$@"\n')
        (folder / "Allrun").chmod(0o755)
        done = self.run_words("mine", "--until", "mesh", "--help")
        self.assertEqual(done.returncode, 0, done.stderr)
        for words in ("From mill.yaml to a report.", "--set PATH=VALUE", "--until STAGE", "--charge FOLDER", "--plan",
                      *("walls", "charge", "average", "mesh", "start", "flow")):
            self.assertIn(words, done.stdout)
        self.assert_not_set_up()

    def test_a_misspelt_option_is_guessed(self):
        script = f". {ROOT}/scripts/mill_stages; for word in --unitl --paln --sets --until_flow --other; do " \
                 "echo \"$word$(meant_option $word)\"; done"
        done = subprocess.run(["bash", "-c", script], capture_output=True, text=True, check=True)
        self.assertEqual(done.stdout.splitlines(),
                         ["--unitl: did you mean --until?", "--paln: did you mean --plan?",
                          "--sets: did you mean --set?", "--until_flow", "--other"])

    def test_a_list_shows_which_runs_are_complete(self):
        study = "cases/studies/mill_30cm_published"
        self.copy("cases/studies")
        for name, stage in (("fluid_75_20", "flow"), ("layers_66", "mesh"), ("dry_75", "average"),
                            ("direct_75_20", "flow"), ("direct_75_20/direct", "average"),
                            ("Beetstra_75_20", "average")):
            stamp = self.root / study / "runs" / name / ".stages" / stage
            stamp.parent.mkdir(parents=True)
            stamp.touch()
        done = self.run_words(study, "--list")
        self.assertEqual(done.returncode, 0, done.stderr)
        found = dict(line.split(" ", 1) for line in done.stdout.splitlines())
        self.assertGreater(len(found), 30)
        for name, state in (("fluid_75_20", "complete"), ("layers_66", "not finished"), ("dry_75", "complete"),
                            ("direct_75_20", "complete"), ("Beetstra_75_20", "not finished"), ("seed", "not begun")):
            self.assertEqual(found[name], state, name)
        done = self.run_words("cases/studies/stirred_shapes", "--list")
        self.assertEqual({line.split(" ", 1)[1] for line in done.stdout.splitlines()}, {"not begun"})
        self.assertIn("no run is complete", self.run_words(study, "--read", "--quick").stderr)
        self.assert_not_set_up()

    def test_another_table_is_looked_for_from_where_allrun_was_called(self):
        study = "cases/studies/mill_30cm_published"
        self.copy("cases/studies")
        self.assertIn("--against: expected the flows.csv", self.run_words(study, "--against").stderr)
        missing = f"against: error: {Path.cwd() / 'none' / 'flows.csv'}: No such file or directory"
        self.assertIn(missing, self.run_words(study, "--against", "none/flows.csv").stderr)
        other = self.root / "flows.csv"
        other.write_text("run,version,a,a ±,\"a, freedom\"\nseed,0.3.0,1,0.1,1\n")
        done = self.run_words(study, "--against", str(other))
        self.assertEqual(done.returncode, 1)
        self.assertIn("no run is complete", done.stdout + done.stderr)
        self.assert_not_set_up()


class Processes(unittest.TestCase):
    """MILLFOAM_NP of scripts/env on a machine with these programs lscpu and nproc."""

    def found(self, lscpu, threads, asked=""):
        """Words of MILLFOAM_NP where lscpu prints these lines (None: it fails) and nproc this number of threads."""
        folder = Path(self.enterContext(tempfile.TemporaryDirectory()))
        text = "exit 1" if lscpu is None else f"printf '%s\\n' '# Core,Socket' {lscpu}"
        for name, command in (("lscpu", text), ("nproc", f"echo {threads}")):
            (folder / name).write_text(f"#!/bin/sh\n{command}\n")
            (folder / name).chmod(0o755)
        environment = {**os.environ, "PATH": f"{folder}:{os.environ['PATH']}", "MILLFOAM_NP": asked}
        done = subprocess.run(["bash", "-c", f'set -eu -o pipefail; . {ROOT}/scripts/env; echo "$MILLFOAM_NP"'],
                              capture_output=True, text=True, check=True, env=environment)
        self.assertEqual(done.stderr, "")
        return done.stdout.strip()

    def test_are_two_or_one_on_a_single_core_whatever_its_threads(self):
        for lscpu, threads, expected in (("0,0 0,0", 2, "1"), ("0,0 0,0 1,0 1,0", 4, "2"), ("0,0 1,0", 2, "2"),
                                         ("0,0 0,1", 2, "2"), ("0,0 1,0 2,0 3,0", 4, "2"), ("0,0 1,0", 1, "1")):
            self.assertEqual(self.found(lscpu, threads), expected, lscpu)

    def test_are_those_of_threads_where_cores_are_not_known(self):
        for lscpu in (None, "", ", ,", "-,- -,-"):
            self.assertEqual((self.found(lscpu, 1), self.found(lscpu, 4)), ("1", "2"), lscpu)

    def test_are_what_was_asked_for(self):
        self.assertEqual(self.found("0,0 0,0", 2, asked="3"), "3")


if __name__ == "__main__":
    unittest.main()
