#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Words of the commands in scripts/ that need no build, and scripts/setup on machines that lack something: its other
programs are replaced by ones that do nothing."""
import os
import re
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


class Clone(unittest.TestCase):
    def setUp(self):
        """A clone with the commands alone."""
        self.root = Path(self.enterContext(tempfile.TemporaryDirectory(prefix="commands-"))) / "clone"
        (self.root / "scripts").mkdir(parents=True)
        for path in (ROOT / "scripts").iterdir():
            if path.is_file():
                shutil.copy(path, self.root / "scripts")
        (self.root / "CMakeLists.txt").touch()

    def files(self):
        return sorted(str(path.relative_to(self.root)) for path in self.root.rglob("*"))

    def call(self, *words, **changes):
        """A finished command of the clone, without a sourced OpenFOAM; changes: of the environment."""
        environment = {name: value for name, value in os.environ.items()
                       if not name.startswith(("MILLFOAM_", "WM_PROJECT"))}
        return subprocess.run([self.root / "scripts" / words[0], *words[1:]], text=True, capture_output=True,
                              cwd=self.root, env={**environment, **changes})


class Words(Clone):
    COMMANDS = ("setup", "bench", "fuzz", "new_mill", "release", "test", "tidy")

    def replace_setup(self):
        (self.root / "scripts" / "setup").write_text("#!/bin/sh\necho built\nexit 3\n")

    def test_help_prints_the_head_of_the_command_and_does_nothing_else(self):
        before = self.files()
        for command in self.COMMANDS:
            head = re.match(r"#!.*\n((?:#.*\n)+)", (self.root / "scripts" / command).read_text())[1]
            for word in ("-h", "--help"):
                with self.subTest(command=command, word=word):
                    done = self.call(command, word)
                    self.assertEqual((done.returncode, done.stderr), (0, ""))
                    self.assertEqual(done.stdout, re.sub("(?m)^# ?", "", head))
                    self.assertIn(f"scripts/{command}", done.stdout)
                    self.assertEqual(self.files(), before)
            self.replace_setup()

    def test_bench_knows_its_parts_before_it_builds(self):
        self.replace_setup()
        source = (ROOT / "tests" / "benchmarks" / "run_benchmarks.py").read_text()
        parts = re.search(r"for part in \(([\w, ]+)\)\}", source)[1].replace(",", "")
        for words in (("flows",), ("flow", "--quick"), ("",)):
            done = self.call("bench", *words)
            self.assertEqual((done.returncode, done.stdout, done.stderr),
                             (1, "", f"bench: '{words[-1]}' is not a part; expected some of {parts}\n"))
        for words in ((), parts.split()):
            done = self.call("bench", *words)
            self.assertEqual((done.returncode, done.stdout), (3, "built\n"))


class Setup(Clone):
    """scripts/setup with a PATH of its own."""
    NEEDED = ("basename", "bash", "cat", "dirname", "env", "flock", "grep", "mkdir", "rm", "sed", "sha256sum", "tail")

    def setUp(self):
        super().setUp()
        self.programs = self.root / "programs"
        self.programs.mkdir()
        for name in self.NEEDED:
            (self.programs / name).symlink_to(shutil.which(name))
        self.program("id", "echo 0")
        self.program("cmake", 'echo "$*" >> cmake.calls')
        (self.root / "build" / "release").mkdir(parents=True)

    def program(self, name, commands):
        path = self.programs / name
        path.write_text(f"#!{shutil.which('bash')}\n{commands}\n")
        path.chmod(0o755)

    def with_headers(self):
        """OpenFOAM's headers are there."""
        (self.root / "build" / "openfoam").mkdir()
        (self.root / "build" / "openfoam" / ".complete").touch()

    def setup(self, *words):
        return self.call("setup", *words, PATH=str(self.programs))

    def built(self):
        return (self.root / "cmake.calls").exists()

    def test_without_apt_ends_where_openfoam_is_missing(self):
        done = self.setup("--mill")
        self.assertEqual(done.returncode, 1)
        self.assertIn("install these packages yourself (Debian 12 names): g++ cmake", done.stdout)
        self.assertEqual(done.stderr, "setup: there is no apt-get to fetch the headers of Debian's OpenFOAM; expected "
                         "openfoam.com's OpenFOAM, v1912 or later: source it, then call scripts/setup again\n")
        self.assertFalse(self.built())

    def test_without_apt_ends_where_superquadrics_are_missing(self):
        self.with_headers()
        (self.root / "dem_driver" / "superquadrics").mkdir(parents=True)
        (self.root / "dem_driver" / "superquadrics" / "CMakeLists.txt").touch()
        earlier = self.root / "build" / "liggghts-superquadric"
        done = self.setup("--superquadrics")
        self.assertEqual(done.returncode, 1)
        self.assertIn("setup: there is no apt-get to fetch Debian's sources of LIGGGHTS", done.stderr)
        self.assertIn(f"call scripts/setup without --superquadrics, and remove {earlier} if it is there", done.stderr)
        self.assertFalse(self.built())
        # Of another version
        earlier.mkdir()
        self.assertEqual(self.setup().stderr, done.stderr)
        self.assertTrue(earlier.is_dir())

    def test_without_apt_builds_with_what_is_there(self):
        self.with_headers()
        done = self.setup()
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertTrue(self.built())

    def test_a_source_of_packages_that_fails_is_named_and_does_not_end_it(self):
        self.with_headers()
        self.program("dpkg-query", "exit 1")
        self.program("apt-get", '[ "$1" != update ] || { echo "E: no such source"; exit 100; }')
        done = self.setup()
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertIn("setup: apt-get update had errors (log: build/logs/apt-update.log); continuing with", done.stdout)
        self.assertNotIn("failed", done.stdout)
        self.assertEqual((self.root / "build" / "logs" / "apt-update.log").read_text(), "E: no such source\n")
        self.assertTrue(self.built())

    def test_packages_that_cannot_be_installed_end_it(self):
        self.with_headers()
        self.program("dpkg-query", "exit 1")
        self.program("apt-get", '[ "$1" != update ] || exit 0; echo "E: unable to locate"; exit 100')
        done = self.setup()
        self.assertEqual(done.returncode, 1)
        self.assertNotIn("had errors", done.stdout)
        self.assertIn("E: unable to locate", done.stderr)
        self.assertFalse(self.built())


if __name__ == "__main__":
    unittest.main()
