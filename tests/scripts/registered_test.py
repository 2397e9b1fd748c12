#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""ctest knows every integration test: no file, no class and no call is left out without a word."""
import importlib
import re
import shlex
import sys
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
INTEGRATION = ROOT / "tests" / "integration"
LISTS = (INTEGRATION / "CMakeLists.txt").read_text()


def calls():
    """Arguments of each registered call of a Python test in tests/integration: file -> list of lists."""
    found = {}
    call = r"millfoam_add_integration_test\(\w+ \d+ \$\{CMAKE_CURRENT_SOURCE_DIR\}/(\w+_test\.py)([^)]*)\)"
    for name, words in re.findall(call, LISTS):
        # Programs of the build are no choice of tests
        found.setdefault(name, []).append([word for word in shlex.split(words) if not word.startswith("$<")])
    return found


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
        self.assertEqual(set(calls()), {path.name for path in INTEGRATION.glob("*_test.py")})

    def test_every_test_of_a_divided_file_is_run_once(self):
        sys.path.insert(0, str(INTEGRATION))
        self.addCleanup(sys.path.remove, str(INTEGRATION))
        divided = {name: parts for name, parts in calls().items() if parts != [[]]}
        self.assertLessEqual({"mills_test.py", "mill_run_test.py"}, set(divided))
        for name, parts in divided.items():
            with self.subTest(name):
                module = importlib.import_module(Path(name).stem)
                self.assertEqual(sorted(test for arguments in parts for test in chosen(module, arguments)),
                                 sorted(chosen(module, [])))

    def test_without_liggghts_tests_are_disabled_and_not_left_out(self):
        self.assertNotIn("if(MILLFOAM_LIGGGHTS)", LISTS)
        disabled = re.search(r"if\(NOT MILLFOAM_LIGGGHTS\)\n  #.*\n  set_tests_properties\(([^)]*)DISABLED ON\)", LISTS)
        self.assertEqual(len(re.findall(r"integration\.\w+", disabled[1])), 7)

    def test_no_call_of_ctest_passes_without_tests(self):
        lines = [line for line in (ROOT / "scripts" / "test").read_text().splitlines() if re.match(r" *ctest ", line)]
        self.assertEqual(len(lines), 3)
        for line in lines:
            self.assertIn("--no-tests=error", line)


if __name__ == "__main__":
    unittest.main()
