#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""A release has one number in all places."""
import os
import re
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PLACES = {"CMakeLists.txt": r"project\(millFoam VERSION ([\d.]+)", "CITATION.cff": r"(?m)^version: (.*)$",
          "scripts/pyproject.toml": r'(?m)^version = "([^"]*)"'}


def versions(root):
    """The version in each place."""
    return {place: re.search(pattern, (root / place).read_text()).group(1) for place, pattern in PLACES.items()}


class Release(unittest.TestCase):
    def setUp(self):
        self.tree = Path(tempfile.mkdtemp(prefix="release-test-"))
        self.addCleanup(shutil.rmtree, self.tree)
        for place in (*PLACES, "CHANGELOG.md", "scripts/release"):
            (self.tree / place).parent.mkdir(exist_ok=True)
            shutil.copy(ROOT / place, self.tree / place)
        (self.tree / "CHANGELOG.md").write_text("# Changes\n\n## Unreleased (7.8.9)\n\n- all\n\n## 0.1.0\n")
        self.git("init", "-q")
        self.git("add", "-A")
        self.git("commit", "-qm", "All")

    def git(self, *words):
        names = {f"GIT_{who}_{what}": "nobody@example" for who in ("AUTHOR", "COMMITTER") for what in ("NAME", "EMAIL")}
        return subprocess.run(["git", *words], cwd=self.tree, check=True, text=True, capture_output=True,
                              env={**os.environ, **names}).stdout

    def release(self, version):
        names = {f"GIT_{who}_{what}": "nobody@example" for who in ("AUTHOR", "COMMITTER") for what in ("NAME", "EMAIL")}
        return subprocess.run([self.tree / "scripts" / "release", version], text=True, capture_output=True,
                              env={**os.environ, **names})

    def test_the_places_agree(self):
        self.assertEqual(len(set(versions(ROOT).values())), 1, versions(ROOT))

    def test_is_written_committed_and_tagged(self):
        done = self.release("7.8.9")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual(set(versions(self.tree).values()), {"7.8.9"})
        self.assertIn("\n## 7.8.9\n", (self.tree / "CHANGELOG.md").read_text())
        self.assertEqual(self.git("status", "--porcelain"), "")
        self.assertEqual(self.git("tag").strip(), "v7.8.9")
        self.refused("7.8.9", "the tag v7.8.9 exists already")

    def refused(self, version, words):
        before = self.git("log", "--oneline")
        done = self.release(version)
        self.assertEqual((done.returncode, done.stdout), (1, ""))
        self.assertIn(words, done.stderr)
        self.assertEqual(self.git("log", "--oneline"), before)

    def test_what_cannot_be_released_is_refused(self):
        self.refused("next", "'next': expected a version such as 0.2.0")
        self.refused("0.3.0", "CHANGELOG.md: no heading '## 0.3.0'")
        (self.tree / "CITATION.cff").write_text("changed\n")
        self.refused("7.8.9", "not committed")


if __name__ == "__main__":
    unittest.main()
