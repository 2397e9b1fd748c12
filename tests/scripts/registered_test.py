#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""ctest knows every test in Python and every verification case: no file, no class and no call is left out without a
word."""
import functools
import importlib
import json
import os
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
INTEGRATION = ROOT / "tests" / "integration"
BUILD = Path(os.environ.get("MILLFOAM_BUILD") or ROOT / "build" / "release").resolve()
LONG = {"repose", "rotating_drum"}  # verification cases that are no tests


@functools.cache
def known_to_ctest():
    """Arguments of each call of a Python file that ctest knows in the build: the file's last two folders and name ->
    list of lists."""
    with tempfile.TemporaryDirectory(prefix="registered-") as folder:
        # In the build's own folder, ctest would replace the log of the tests that run now
        (Path(folder) / "CTestTestfile.cmake").write_text(f'subdirs("{BUILD}")\n')
        listed = subprocess.run(["ctest", "--show-only=json-v1"], cwd=folder, check=True, capture_output=True).stdout
    found = {}
    for test in json.loads(listed)["tests"]:
        for place, word in enumerate(words := test.get("command", [])):
            if word.endswith(".py"):
                *_, group, room, name = Path(word).parts
                # Programs of the build are no choice of tests
                arguments = [one for one in words[place + 1:] if not one.startswith("/")]
                found.setdefault(f"{group}/{room}/{name}", []).append(arguments)
                break
    return found


def calls(room):
    """The same of the tests in a folder of tests/: name of the file -> list of lists."""
    return {Path(file).name: parts for file, parts in known_to_ctest().items()
            if file.startswith(f"tests/{room}/")}


def chosen(module, arguments):
    """Names of the tests of a module that it runs with these arguments."""
    found = []

    class Runner:
        def run(self, suite):
            tests = [suite]
            while tests:
                one = tests.pop()
                if isinstance(one, unittest.TestSuite):
                    tests += one
                else:
                    found.append(one.id())
            return unittest.TestResult()

    unittest.main(module, argv=["test", *arguments], testRunner=Runner(),
                  testLoader=unittest.TestLoader(), exit=False)
    return found


class Registered(unittest.TestCase):
    def test_every_file_is_run(self):
        for room in ("integration", "scripts"):
            self.assertEqual(set(calls(room)), {path.name for path in (ROOT / "tests" / room).glob("*_test.py")})

    def test_every_verification_case_is_run_but_the_long_ones(self):
        cases = {path.parent.name for path in (ROOT / "cases" / "verification").glob("*/compare.py")}
        self.assertLessEqual(LONG, cases)
        self.assertEqual({file.split("/")[1] for file in known_to_ctest() if file.startswith("verification/")},
                         cases - LONG)

    def test_every_test_of_a_divided_file_is_run_once(self):
        sys.path.insert(0, str(INTEGRATION))
        self.addCleanup(sys.path.remove, str(INTEGRATION))
        divided = {name: parts for name, parts in calls("integration").items() if parts != [[]]}
        self.assertLessEqual({"mills_test.py", "mill_run_test.py"}, set(divided))
        for name, parts in divided.items():
            with self.subTest(name):
                module = importlib.import_module(Path(name).stem)
                self.assertEqual(sorted(test for arguments in parts for test in chosen(module, arguments)),
                                 sorted(chosen(module, [])))

    def test_without_liggghts_tests_are_disabled_and_not_left_out(self):
        # This build may have LIGGGHTS: its tests do not show what others do
        lists = (INTEGRATION / "CMakeLists.txt").read_text()
        self.assertNotIn("if(MILLFOAM_LIGGGHTS)", lists)
        disabled = re.search(r"if\(NOT MILLFOAM_LIGGGHTS\)\n  #.*\n  set_tests_properties\(([^)]*)DISABLED ON\)", lists)
        self.assertEqual(len(re.findall(r"integration\.\w+", disabled[1])), 7)

    def test_no_call_of_ctest_passes_without_tests(self):
        lines = [line for line in (ROOT / "scripts" / "test").read_text().splitlines() if re.match(r" *ctest ", line)]
        self.assertEqual(len(lines), 3)
        for line in lines:
            self.assertIn("--no-tests=error", line)


if __name__ == "__main__":
    unittest.main()
