# SPDX-License-Identifier: GPL-3.0-or-later
"""OpenFOAM's own checkMesh finds nothing wrong with the meshes of millMesh."""
import re
import shutil
import tempfile
import unittest
from pathlib import Path

from millfoam.run import run

ROOT = Path(__file__).resolve().parents[2]
MILL = ROOT / "cases" / "mills" / "mill_12cm"


class Mesh(unittest.TestCase):
    def check(self, *changes, turned_to=0):
        """Meshes the slice's mill.yaml after the changes [(pattern, new)] and returns what checkMesh says."""
        case = Path(tempfile.mkdtemp(prefix="mesh-"))
        self.addCleanup(shutil.rmtree, case)
        shutil.copytree(MILL / "system", case / "system")
        text = (MILL / "mill.yaml").read_text()
        for pattern, new in changes:
            text, count = re.subn(pattern, new, text)
            self.assertEqual(count, 1, pattern)
        (case / "mill.yaml").write_text(text)
        run(case, "millMesh", "mill.yaml", "--case", ".", "--at-time", turned_to)
        report = run(case, "checkMesh", "-constant", "-allTopology", "-allGeometry")
        self.assertIn("\nMesh OK.\n", report, report[-2000:])
        self.assertLessEqual(float(re.search(r"non-orthogonality Max: (\S+)", report).group(1)), 50)
        self.assertLessEqual(float(re.search(r"Max skewness = (\S+)", report).group(1)), 1.5)

    def test_periodic_slice(self):
        self.check()

    def test_periodic_slice_turned(self):
        self.check(turned_to=1.0)

    def test_plain_ends(self):
        self.check((r"ends: periodic", "ends: plain"), (r"layers: \d+", "layers: 12"), (r"  start_length: \S+\n", ""))

    def test_smooth_drum(self):
        self.check((r"count: 12", "count: 0"), (r"  height: 0.008\n", ""), (r"    width: 0.006\n", ""))

    def test_fine_and_coarse_cells(self):
        for size in (0.002, 0.006):
            with self.subTest(size=size):
                self.check((r"cell_size: \S+", f"cell_size: {size}"))


if __name__ == "__main__":
    unittest.main(verbosity=2)
