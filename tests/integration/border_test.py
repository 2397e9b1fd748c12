#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Dependencies between the rooms point one way, and only .H and .C files know OpenFOAM."""
import tempfile
import unittest
from pathlib import Path

from borders import SOURCES, violations

ROOT = Path(__file__).resolve().parents[2]


class ThisRepository(unittest.TestCase):
    def test_keeps_its_borders(self):
        self.assertEqual(violations(ROOT), [])

    def test_is_really_looked_at(self):
        for room in ("meshing", "dem_driver", "averaging", "openfoam_module/drag", "openfoam_module/foam"):
            self.assertTrue([file for file in (ROOT / room).rglob("*") if file.suffix in SOURCES], room)


class MadeUpTree(unittest.TestCase):
    """Each test writes a small tree; the rooms' headers that can be included are there already."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = Path(folder.name)
        for header in ("meshing/mill/mill.hpp", "averaging/box_grid.hpp", "openfoam_module/drag/drag_laws.hpp",
                       "dem_driver/deck.hpp", "openfoam_module/foam/solids.H"):
            self.write(header, "#pragma once\n")

    def write(self, name, text):
        path = self.root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)

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
        self.assert_refused("averaging/tools/a.cpp", '"dem_driver/deck.hpp"', "averaging/tools must not know dem_driver")

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
        self.assert_refused("meshing/files/a.cpp", '"meshing/surface/pi.hpp"', "meshing/files must not know meshing/surface")

    def test_dem_driver_must_not_include_averaging(self):
        self.assert_refused("dem_driver/a.cpp", '"averaging/box_grid.hpp"', "dem_driver must not know averaging")

    def test_openfoam_module_must_not_include_meshing(self):
        self.assert_refused("openfoam_module/foam/a.C", '"meshing/mill/mill.hpp"', "openfoam_module must not know meshing")

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


if __name__ == "__main__":
    unittest.main()
