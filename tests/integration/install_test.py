#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""An installed millFoam serves a program outside of its tree, and runs a mill without sources."""
import json
import math
import os
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
BUILD = Path(os.environ.get("MILLFOAM_BUILD", ROOT / "build" / "release"))


def run(*command, cwd=None, environment=None):
    """Output of a command that must succeed."""
    done = subprocess.run([str(word) for word in command], cwd=cwd, env=environment, text=True, capture_output=True)
    if done.returncode:
        raise AssertionError(f"{command}: exit {done.returncode}\n{done.stdout[-3000:]}\n{done.stderr[-3000:]}")
    return done.stdout


class Installed(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = Path(tempfile.mkdtemp(prefix="millfoam-install-"))
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        cls.prefix = cls.folder / "prefix"
        run("cmake", "--install", BUILD, "--prefix", cls.prefix)
        cls.mills = cls.prefix / "share" / "millfoam" / "mills"
        # A shell of somebody who has no source tree
        kept = ("HOME", "LANG", "USER", "OMPI_ALLOW_RUN_AS_ROOT", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM")
        cls.environment = {key: os.environ[key] for key in kept if key in os.environ}
        cls.environment["PATH"] = "/usr/local/bin:/usr/bin:/bin"

    def test_a_program_outside_finds_the_libraries(self):
        build = self.folder / "outside"
        run("cmake", "-S", ROOT / "tests" / "install", "-B", build, "-G", "Ninja",
            f"-DCMAKE_PREFIX_PATH={self.prefix}")
        run("cmake", "--build", build)
        words = run(build / "outside", self.mills / "mill_12cm" / "mill.yaml").split()
        version = run(self.prefix / "bin" / "millMesh", "--version", environment=self.environment).split()[-1]
        self.assertEqual(words[0], version)
        self.assertAlmostEqual(float(words[1]), math.pi / 6, delta=1e-14)
        self.assertGreater(float(words[2]), 0)
        self.assertEqual(float(words[3]), 0.06)

    def test_a_mill_begins_without_sources(self):
        case = self.folder / "my_mill"
        scripts = self.prefix / "share" / "millfoam" / "scripts"
        run(scripts / "new_mill", self.mills / "mill_12cm" / "mill.yaml", case, environment=self.environment)
        small = ["--set", "dem.duration=0.01", "--set", "dem.settle_time=0.01", "--set", "averages.start=0",
                 "--set", "averages.window=0.002"]
        run(case / "Allrun", *small, "--until", "walls", environment=self.environment)
        self.assertEqual(json.loads((case / "walls" / "walls.json").read_text())["format"], "millfoam-walls")
        run(case / "Allrun", *small, "--set", "flow.balls=no", "--until", "start", environment=self.environment)
        self.assertTrue((case / "0" / "alpha.slurry").is_file())
        self.assertFalse(list((self.prefix / "share").rglob("build")))


if __name__ == "__main__":
    unittest.main()
