#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Dependencies between the rooms point one way, in C++ and in Python, without cycles; only .H and .C files know
OpenFOAM."""
import tempfile
import unittest
from pathlib import Path

from borders import python_graph, violations
from import_graph import SOURCES

ROOT = Path(__file__).resolve().parents[2]


class ThisRepository(unittest.TestCase):
    def test_keeps_its_borders(self):
        self.assertEqual(violations(ROOT), [])

    def test_is_really_looked_at(self):
        for room in ("meshing", "dem_driver", "averaging", "openfoam_module/drag", "openfoam_module/foam"):
            self.assertTrue([file for file in (ROOT / room).rglob("*") if file.suffix in SOURCES], room)
        imports = python_graph(ROOT)
        for file, other in (("scripts/millfoam/report/build.py", "scripts/millfoam/files/mill_case.py"),
                            ("cases/studies/softening/softening.py", "cases/studies/millstudies/dry_runs.py"),
                            ("tests/scripts/report_cases.py", "tests/integration/mesh.py")):
            self.assertIn(Path(other), imports[Path(file)])


class Tree(unittest.TestCase):
    """Each test writes a small tree."""

    def setUp(self):
        self.root = Path(self.enterContext(tempfile.TemporaryDirectory()))

    def write(self, name, text):
        path = self.root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)

    def assert_one(self, *words):
        found = violations(self.root)
        self.assertEqual(len(found), 1, found)
        for word in words:
            self.assertIn(word, found[0])


class MadeUpTree(Tree):
    """The rooms' headers that can be included are there already."""

    def setUp(self):
        super().setUp()
        for header in ("meshing/mill/mill.hpp", "averaging/box_grid.hpp", "openfoam_module/drag/drag_laws.hpp",
                       "dem_driver/deck.hpp", "openfoam_module/foam/solids.H"):
            self.write(header, "#pragma once\n")

    def assert_refused(self, name, include, *words):
        self.write(name, f"#include {include}\n")
        found = violations(self.root)
        self.assertEqual(len(found), 1, found)
        for word in (name, *words):
            self.assertIn(word, found[0])

    def assert_allowed(self, name, include):
        self.write(name, f"#include {include}\n")
        self.assertEqual(violations(self.root), [])

    def test_averaging_must_not_include_meshing(self):
        self.assert_refused("averaging/a.cpp", '"meshing/mill/mill.hpp"', "averaging must not know meshing")

    def test_averaging_must_not_include_dem_driver(self):
        self.assert_refused("averaging/tools/a.cpp", '"dem_driver/deck.hpp"',
                            "averaging/tools must not know dem_driver")

    def test_averaging_must_not_include_drag(self):
        self.assert_refused("averaging/a.hpp", '"openfoam_module/drag/drag_laws.hpp"', "openfoam_module/drag")

    def test_a_relative_path_does_not_hide_the_room(self):
        self.assert_refused("averaging/a.cpp", '"../meshing/mill/mill.hpp"', "averaging must not know meshing")

    def test_angle_brackets_do_not_hide_the_room(self):
        self.assert_refused("averaging/a.cpp", "<meshing/mill/mill.hpp>", "averaging must not know meshing")

    def test_a_header_that_is_not_there_still_counts(self):
        self.assert_refused("averaging/a.cpp", '"meshing/gone.hpp"', "averaging must not know meshing")

    def test_meshing_includes_no_other_room(self):
        self.assert_refused("meshing/a.cpp", '"averaging/box_grid.hpp"', "meshing must not know averaging")

    def test_surfaces_know_no_other_part_of_meshing(self):
        self.assert_refused("meshing/surface/a.cpp", '"meshing/mill/mill.hpp"', "meshing/surface must not know meshing")

    def test_files_know_nothing_else(self):
        self.assert_refused("meshing/files/a.cpp", '"meshing/surface/pi.hpp"',
                            "meshing/files must not know meshing/surface")

    def test_dem_driver_may_include_averaging_but_not_its_tool(self):
        self.assert_allowed("dem_driver/a.cpp", '"averaging/box_grid.hpp"')
        self.assert_refused("dem_driver/a.cpp", '"averaging/tools/options.hpp"',
                            "dem_driver must not know averaging/tools")

    def test_openfoam_module_must_not_include_meshing(self):
        self.assert_refused("openfoam_module/foam/a.C", '"meshing/mill/mill.hpp"',
                            "openfoam_module must not know meshing")

    def test_drag_knows_only_the_standard_library(self):
        self.assert_refused("openfoam_module/drag/a.cpp", "<hdf5.h>", "standard library only")

    def test_drag_does_not_know_the_rest_of_its_module(self):
        self.assert_refused("openfoam_module/drag/a.cpp", '"openfoam_module/foam/part.hpp"',
                            "openfoam_module/drag must not know openfoam_module")

    def test_a_cpp_must_not_include_openfoam(self):
        self.assert_refused("averaging/a.cpp", '"volFields.H"', "OpenFOAM")

    def test_a_hpp_of_the_tests_must_not_include_openfoam(self):
        self.assert_refused("tests/averaging/a.hpp", '"fvCFD.H"', "OpenFOAM")

    def test_a_cpp_must_not_name_openfoam_classes(self):
        self.write("meshing/a.cpp", "Foam::vector v;\n")
        self.assertEqual(violations(self.root), ["meshing/a.cpp: names Foam::, which only .H and .C may know"])

    def test_the_ways_that_are_open(self):
        self.assert_allowed("dem_driver/a.cpp", '"meshing/mill/mill.hpp"')
        self.assert_allowed("openfoam_module/foam/a.C", '"averaging/box_grid.hpp"')
        self.assert_allowed("openfoam_module/foam/b.C", '"openfoam_module/drag/drag_laws.hpp"')
        self.assert_allowed("openfoam_module/foam/c.H", '"volFields.H"')
        self.assert_allowed("openfoam_module/drag/a.cpp", "<cmath>")
        self.assert_allowed("openfoam_module/drag/tools/a.cpp", "<CLI/CLI.hpp>")
        self.assert_allowed("averaging/b.cpp", "<hdf5.h>")
        self.assert_allowed("averaging/c.cpp", '"meshing/surface/stl_file.hpp"')
        self.assert_allowed("tests/meshing/a.cpp", '"meshing/mill/mill.hpp"')

    def test_folders_of_a_room_must_not_include_each_other(self):
        self.write("averaging/a/one.hpp", '#include "averaging/b/one.hpp"\n')
        self.write("averaging/b/one.hpp", "#pragma once\n")
        self.assertEqual(violations(self.root), [])
        self.write("averaging/b/other.hpp", '#include "../c/one.hpp"\n')
        self.write("averaging/c/one.hpp", '#include "averaging/a/one.hpp"\n')
        self.assert_one("averaging/a, averaging/b, averaging/c: folders use each other",
                        "averaging/b/other.hpp uses averaging/c/one.hpp")

    def test_folders_of_foam_find_headers_by_their_names(self):
        self.write("openfoam_module/foam/a/one.C", '#include "two.H"\n#include "volFields.H"\n')
        self.write("openfoam_module/foam/b/two.H", "")
        self.assertEqual(violations(self.root), [])
        self.write("openfoam_module/foam/b/two.C", '#include "three.H"\n')
        self.write("openfoam_module/foam/a/three.H", "")
        self.assert_one("openfoam_module/foam/a, openfoam_module/foam/b: folders use each other")


class MadeUpPackage(Tree):
    """A Python package with a module in every part."""

    def setUp(self):
        super().setUp()
        for part in ("files", "readings", "plots", "report"):
            for name in ("__init__", "one", "two"):
                self.write(f"scripts/millfoam/{part}/{name}.py", "")
        for name in ("__init__", "run"):
            self.write(f"scripts/millfoam/{name}.py", "")
        for name in ("__init__", "runs"):
            self.write(f"cases/studies/millstudies/{name}.py", "")

    def assert_imports(self, file, line, *words):
        """That a file with such a line is refused with these words, or allowed without any."""
        self.write(file, line + "\n")
        found = violations(self.root)
        self.assertEqual(len(found), 1 if words else 0, found)
        for word in words:
            self.assertIn(word, found[0])
        (self.root / file).write_text("")

    def test_parts_know_only_what_lies_below(self):
        readings, package = "scripts/millfoam/readings/one.py", "scripts/millfoam"
        for line in ("from ..plots import one", "from ..plots.one import draw", "import millfoam.plots.one",
                     "from millfoam.plots import one", "def late():\n    from ..plots import one"):
            self.assert_imports(readings, line, f"imports {package}/plots/one.py: {package}/readings must not know")
        self.assert_imports(readings, "from ..files.one import read")
        self.assert_imports(f"{package}/files/one.py", "from .. import run", "files must not know scripts/millfoam")
        self.assert_imports(f"{package}/run.py", "from .files import one", f"{package} must not know {package}/files")

    def test_scripts_know_no_cases_and_no_tests(self):
        self.write("tests/scripts/made_up_cases.py", "")
        for line, room in (("from millstudies.runs import run", "cases/studies"),
                           ("import made_up_cases", "tests/scripts")):
            self.assert_imports("scripts/millfoam/report/one.py", line, f"must not know {room}")

    def test_cases_know_the_package_and_their_own_kind(self):
        self.write("cases/studies/of_all/other.py", "")
        for line in ("from millfoam.report import one", "from millstudies import runs", "import other"):
            self.assert_imports("cases/studies/of_all/study.py", line)
        self.assert_imports("cases/verification/a_box/compare.py", "from millstudies.runs import run",
                            "cases/verification must not know cases/studies")

    def test_modules_must_not_import_each_other(self):
        self.write("scripts/millfoam/readings/one.py", "from .two import of_two\n")
        self.write("scripts/millfoam/readings/two.py", "def of_two():\n    from . import one\n")
        self.assert_one("scripts/millfoam/readings/one.py, scripts/millfoam/readings/two.py: modules import each other")

    def test_folders_must_not_import_each_other(self):
        self.write("tests/scripts/one.py", "import helper\n")
        self.write("tests/integration/helper.py", "")
        self.assertEqual(violations(self.root), [])
        self.write("tests/integration/a_test.py", "from cases_of_scripts import one\n")
        self.write("tests/scripts/cases_of_scripts.py", "")
        self.assert_one("tests/integration, tests/scripts: folders use each other")

    def test_scripts_must_not_name_a_case(self):
        (self.root / "cases" / "studies" / "of_all").mkdir(parents=True)
        for text in ("make of_all\n", "cd cases/studies/something\n"):
            self.write("scripts/tool", text)
            self.assert_one("scripts/tool: names", "scripts must not know cases")
        self.write("scripts/tool", "for case in cases/*/*; do of_allmost; done\n")
        self.write("scripts/README.md", "make of_all\n")
        self.assertEqual(violations(self.root), [])


if __name__ == "__main__":
    unittest.main()
