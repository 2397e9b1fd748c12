#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Spectra and the load of the liner from files of a run that followed its contacts, written by hand."""
import tempfile
import unittest
from pathlib import Path

import numpy as np

from millfoam.files.data_files import DataError
from millfoam.files.mill_case import MillCase
from millfoam.files.wall_forces import WallForces, read_wall_forces
from millfoam.readings.contact_statistics import read_statistics, section_means
from millfoam.report.checks import all_checks
from millfoam.report.contact_cards import contact_section
from millfoam.report.contact_statistics_cards import LOADS, sector_outline
from report_cases import write_dry

HEAD = ("first_m,second_m,wall,energy_from_J,energy_to_J,touches_per_s,collisions_per_s,normal_W,tangential_W,"
        "rolling_W\n")
VTP = """<?xml version="1.0"?>
<!-- parts: shell lifters; DEM time 0.5 to 1.5 s -->
<VTKFile type="PolyData" version="1.0" byte_order="LittleEndian">
<PolyData>
<Piece NumberOfPoints="3" NumberOfPolys="1">
<Points>
<DataArray type="Float64" Name="Points" NumberOfComponents="3" format="ascii">
0 0 0
2 0 0
0 0 3
</DataArray>
</Points>
<Polys>
<DataArray type="Int64" Name="connectivity" NumberOfComponents="1" format="ascii">
0 1 2
</DataArray>
<DataArray type="Int64" Name="offsets" NumberOfComponents="1" format="ascii">
3
</DataArray>
</Polys>
<CellData>
<DataArray type="Float64" Name="normal_force_N" NumberOfComponents="1" format="ascii">
7
</DataArray>
</CellData>
</Piece>
</PolyData>
</VTKFile>
"""


class Spectra(unittest.TestCase):
    def read(self, *rows):
        folder = Path(self.enterContext(tempfile.TemporaryDirectory()))
        (folder / "contact_spectra.csv").write_text(HEAD + "".join(row + "\n" for row in rows))
        return read_statistics(folder, 1.0, 3.0)

    def test_each_row_is_in_the_bin_of_its_energies(self):
        found = self.read("0.004,0.003,-1,1e-06,1.584893e-06,5,4,0.1,0.2,0.01", "0.004,0,1,-inf,1e-15,2,1,0.5,0,0",
                          "0.004,0,0,1000,inf,1,0,0.25,0,0")
        np.testing.assert_allclose(found.classes, [0, 0.003, 0.004])
        bin_number = np.searchsorted(found.edges, 1.2e-6, side="right")
        self.assertEqual(found.collisions[1, 2, bin_number], 5)
        self.assertEqual(found.collisions[0, 2, 0], 2)
        self.assertEqual(found.collisions[0, 2, -1], 1)
        self.assertAlmostEqual(found.dissipation()[1, 2].sum(), 0.31)
        self.assertAlmostEqual(found.total_power(), 1.06)

    def test_other_bins_are_refused(self):
        with self.assertRaisesRegex(DataError, "energies beyond the bins"):
            self.read("0.004,0,0,1e4,1e5,1,0,0.25,0,0")


class Liner(unittest.TestCase):
    def test_the_file_of_wall_forces_is_read(self):
        path = Path(self.enterContext(tempfile.TemporaryDirectory())) / "wall_forces.vtp"
        path.write_text(VTP)
        walls = read_wall_forces(path)
        self.assertEqual((walls.parts, walls.begin, walls.end), (["shell", "lifters"], 0.5, 1.5))
        np.testing.assert_allclose(walls.areas(), [3])
        np.testing.assert_allclose(np.abs(walls.normals()), [[0, 1, 0]])
        np.testing.assert_array_equal(walls.fields["normal_force_N"], [7])
        path.write_text("<VTKFile/>")
        with self.assertRaisesRegex(RuntimeError, "expected the wall forces that millDem writes"):
            read_wall_forces(path)

    def test_the_outline_of_a_sector_is_continuous_and_has_its_lifter_in_the_middle(self):
        for count in (1, 6, 12, 60):
            outline = sector_outline(0.1, (count, 0.008, 0.004, 0.002))
            np.testing.assert_allclose(outline[0], outline[-1] * [1, -1], atol=1e-12)
            self.assertAlmostEqual(outline[-1] @ outline[-1], 0.01, places=9)
            self.assertAlmostEqual(outline[:, 0].max() if count == 1 else outline[:, 0].min(),
                                   outline[:, 0].max() if count == 1 else min(0.092, 0.1 * np.cos(np.pi / count)))
            angle = np.arctan2(outline[:, 1], outline[:, 0])
            arc = angle[np.abs(np.hypot(*outline.T) - 0.1) < 1e-9]
            self.assertTrue(np.all(np.diff(arc) > 0))

    def test_cells_of_all_sectors_and_places_on_the_axis_are_averaged_by_area(self):
        # A prism of four sides; each side has two halves, at the sides of its middle, with the values 1 and 5
        corners, values = [], []
        for side in range(4):
            turn = np.array([[np.cos(side * np.pi / 2), -np.sin(side * np.pi / 2), 0],
                             [np.sin(side * np.pi / 2), np.cos(side * np.pi / 2), 0], [0, 0, 1]])
            for low, high, value in ((-1, 0, 1.0), (0, 1, 5.0)):
                square = np.array([[1, low, 0], [1, high, 0], [1, high, 2], [1, low, 2]]) @ turn.T
                corners += [square[[0, 1, 2]], square[[0, 2, 3]]]
                # The means of a half are those of its triangles
                values += [value - 0.5, value + 0.5]
        corners += [np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]])]  # of an end
        values += [1e9]
        walls = WallForces(np.array(corners), {"load": np.array(values)}, ["shell"], 0, 1)
        outline = np.array([[1, -1], [1, 1]])
        pieces, means = section_means(walls, outline, 4, ("load",), 1.0)
        self.assertEqual(len(pieces), 2)
        np.testing.assert_allclose(means["load"], [1, 5])


class Cards(unittest.TestCase):
    def test_a_run_with_statistics_shows_them_and_one_with_a_damaged_file_says_so(self):
        folder = Path(self.enterContext(tempfile.TemporaryDirectory()))
        powers = {"normal_W": 1.0, "tangential_W": 2.0, "rolling_W": 0.1}
        write_dry(folder, contacts={"begin_s": 1.0, "end_s": 2.0, "collisions_per_s": 5e4, "dissipated_W": 6.2,
                                    "drive_W": 6.0, "gain_W": -0.25, "dissipated_over_drive": 0.992,
                                    "power": {"shell": powers, "balls": powers}})
        (folder / "dumps" / "contact_spectra.csv").write_text(HEAD + "0.004,0,0,1e-06,1.584893e-06,5,4,0.1,0.2,0.01\n")
        fields = "".join(f'<DataArray type="Float64" Name="{name}" NumberOfComponents="1" format="ascii">\n3\n'
                         "</DataArray>\n" for name in LOADS)
        (folder / "dumps" / "wall_forces.vtp").write_text(VTP.replace("<CellData>", "<CellData>" + fields))
        case = MillCase(folder)
        cards = "".join(contact_section(case, None))
        for title in ("Spectra of energy", "Power that contacts dissipate", "Where the drive", "at the wall shell"):
            self.assertIn(title, cards)
        self.assertEqual("Load of the liner" in cards, case.mill.lifters[0] > 0)
        checked = {check.name: check.state for check in all_checks(case)}
        self.assertEqual(checked["Contacts dissipate what the drive gives"], "holds")
        (folder / "dumps" / "contact_spectra.csv").write_text(HEAD + "0.004,0,0\n")
        self.assertIn("Contacts cannot be shown", contact_section(MillCase(folder), None)[0])


if __name__ == "__main__":
    unittest.main()
