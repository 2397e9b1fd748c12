#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The study power_filling: the models' curves, the table, and runs that are not complete."""
import importlib.util
import tempfile
import unittest
from pathlib import Path
from types import SimpleNamespace

import h5py
import numpy as np

from millfoam.files.data_files import read_csv, write_csv
from millfoam.files.mill import Mill
from millfoam.readings import power_models
from millfoam.readings.means import Mean
from millstudies.mill_runs import resolved
from millstudies.published_mills import MILLS, charge_setting
from report_cases import change_json, write_dry, write_flow

ROOT = Path(__file__).resolve().parents[2]
PLACE = ROOT / "cases" / "studies" / "power_filling" / "power_filling.py"
SPEC = importlib.util.spec_from_file_location("power_filling", PLACE)
study = importlib.util.module_from_spec(SPEC)
SPEC.loader.exec_module(study)


def mill():
    """What the models read of a mill of 3 m."""
    derived = {"resting_solidity": 0.6, "mass_kg": 0.35 * 7800 * 0.6 * np.pi * 1.5**2 * 4}
    found = SimpleNamespace(radius=1.5, length=4.0, critical_share=0.7, ball_density=7800.0,
                            derived=lambda section, key: derived[key], slurry=lambda key: 1600.0)
    assert set(vars(found)) - {"derived", "slurry"} <= set(dir(Mill))
    return found


class Models(unittest.TestCase):
    def test_pores_fill_up_and_then_there_is_a_pool(self):
        found = study.models(mill())
        for name in ("Hogg & Fuerstenau, 35°", "Morrell, C-model"):
            dry, half, full, over = map(found[name], (0.0, 0.5, 1.0, 1.5))
            self.assertAlmostEqual(half, (dry + full) / 2, delta=1e-9 * full)
            self.assertGreater(full, dry)
            self.assertEqual(over, full)
        pooled = found["Morrell, with its pool"]
        self.assertTrue(np.isnan(pooled(0.99)))
        self.assertLess(pooled(1.0), found["Morrell, C-model"](1.0))

    def test_bond_does_not_know_the_filling(self):
        bond = study.models(mill())["Bond, wet"]
        self.assertEqual(bond(0.0), bond(1.5))
        mass = 0.35 * 7800 * 0.6 * np.pi * 1.5**2 * 4
        self.assertAlmostEqual(bond(1.0), power_models.bond(3.0, 0.7, 0.35, mass), delta=1e-9 * bond(1.0))


class Table(unittest.TestCase):
    def rows(self):
        quantities = {key: Mean(0.2, 0.001) for key in (*study.POWERS, *study.READINGS)}
        quantities["drive_power"] = Mean(np.nan, np.nan)
        runs = [study.Run(way, fill, None, SimpleNamespace(quantities=quantities, load=0.4), None, 0.1, "",
                          Mean(0.04, 0.003 if fill == 1 else np.nan) if way == "direct" else None)
                for way in study.WAYS for fill in (0.5, 1.0)]
        return list(study.rows_of(study.Study("12cm_50", None, Mean(0.21, 0.002), runs, [])))

    def test_has_a_row_for_each_run_and_the_dry_charge(self):
        lines = list(study.lines_of(self.rows()))
        self.assertEqual([line.split()[0] for line in lines if line],
                         ["12cm_50", "dry", "one", "one", "direct", "direct"])
        self.assertIn("0.2100 ± 0.0020", lines[1])
        self.assertEqual([line.partition("0.10")[2].strip() for line in lines[3:6]], ["–", "+4.0%", "+4.0% ± 0.3%"])
        # A drive that is not known leaves its place
        places = {line.rindex("0.2000 ± 0.0010") for line in lines[2:] if line}
        self.assertEqual(len(places), 1)

    def test_columns_have_units_and_are_read_by_the_projects_reader(self):
        rows = self.rows()
        path = Path(self.enterContext(tempfile.TemporaryDirectory())) / "power_filling.csv"
        write_csv(path, rows)
        head = path.read_text().splitlines()[0].split(",")
        for name in ("drive_power_W", "drive_power_error_W", "toe_deg", "slurry_x_error_m", "slurry_in_pool"):
            self.assertIn(name, head)
        numbers = path.with_name("numbers.csv")
        chosen = [head.index(name) for name in ("filling", "charge_power_W")]
        numbers.write_text("".join(",".join(line.split(",")[k] for k in chosen) + "\n"
                                   for line in path.read_text().splitlines()))
        self.assertEqual(list(read_csv(numbers)["filling"]), [0, 0.5, 1, 0.5, 1])


class Relative(unittest.TestCase):
    def mill(self, name, *runs):
        made = [study.Run(way, fill, None, SimpleNamespace(quantities={"drive_power": power}), None, 0.0, "", np.nan)
                for way, fill, power in runs]
        box = {"lower_m": [-0.06, -0.06, 0], "upper_m": [0.06, 0.06, 0.024], "shape": [20, 20, 4]}
        return study.Study(name, SimpleNamespace(content={"derived": {"averages": box}}), Mean(0.2, 0.006), made, [])

    def test_has_the_direct_runs_with_the_errors_of_both(self):
        (fill, ratio), = study.relative_power(self.mill(
            "12cm_50", ("one_way", 0.5, Mean(9.0, 9.0)), ("direct", 0.5, Mean(0.25, 0.01)),
            ("direct", 1.0, Mean(np.nan, np.nan))))
        self.assertEqual(fill, 0.5)
        self.assertAlmostEqual(ratio.value, 1.25)
        self.assertAlmostEqual(ratio.error, 1.25 * 0.05)  # 4 % and 3 %

    def test_picture_has_all_mills_that_have_direct_runs(self):
        mills = [self.mill(f"mill{k}", ("direct", 0.5, Mean(0.25, 0.01))) for k in range(10)]
        axis, = study.draw_relative([*mills, self.mill("none")]).axes
        self.assertEqual(axis.get_legend_handles_labels()[1],
                         ["dry", *(f"mill{k}, voxels of 6 mm" for k in range(10))])


class Loads(unittest.TestCase):
    def test_a_published_load_is_that_of_the_mill(self):
        for load in ("25", "50"):
            found = resolved(MILLS["12cm"], [charge_setting(load)])
            self.assertAlmostEqual(found.load, float(load) / 100, delta=0.005)

    def test_another_load_is_refused_with_the_known_ones(self):
        with self.assertRaisesRegex(ValueError, "loads.csv: no load 30 %; expected one of 12.5, 25, 37.5, 50"):
            charge_setting("30")


class Steady(unittest.TestCase):
    def test_a_dry_run_that_is_not_steady_is_named(self):
        folder = Path(self.enterContext(tempfile.TemporaryDirectory()))
        write_dry(folder / "dry")
        for steady, words in ((True, ""), (False, "charge")):
            change_json(folder / "dry" / "dumps" / "results.json", "steady", to=steady)
            dry, = study.rows_of(study.read_study(folder))
            self.assertEqual(dry["not_steady"], words)
            self.assertEqual(list(study.lines_of([dry]))[1].endswith("charge"), not steady)


class Missing(unittest.TestCase):
    def setUp(self):
        self.folder = Path(self.enterContext(tempfile.TemporaryDirectory()))

    def run_of(self, name, fill=0.5):
        """A run that is complete but for what read_pass needs."""
        write_flow(self.folder / name)
        change_json(self.folder / name / "mill.json", "mill", "flow", to={"start": {"fill": fill}})

    def test_a_mill_without_a_dry_run_is_named(self):
        with self.assertRaisesRegex(RuntimeError, "dry"):
            study.read_study(self.folder)

    def test_folders_that_are_not_runs_are_not_read(self):
        write_dry(self.folder / "dry")
        for name in ("one_way_1_copy2", "one_way_1.5.part", "direct_", "notes"):
            (self.folder / name).mkdir()
        found = study.read_study(self.folder)
        self.assertEqual((found.runs, found.missing), ([], []))

    def test_a_run_with_another_filling_than_its_name_says_is_missing(self):
        write_dry(self.folder / "dry")
        self.run_of("one_way_1.5")
        (missing,) = study.read_study(self.folder).missing
        self.assertRegex(missing, "^one_way_1.5: .*flow.start.fill is 0.5; expected 1.5, as the folder is named")

    def test_a_run_with_another_charge_than_the_dry_run_is_missing(self):
        write_dry(self.folder / "dry")
        self.run_of("one_way_0.5")
        for file, keys in (("mill.json", ("fingerprint", "charge")), ("dumps/results.json", ("mill", "charge")),
                           ("dumps/run.json", ("mill", "charge")), ("solids.json", ("mill", "charge"))):
            change_json(self.folder / "dry" / file, *keys, to="f" * 16)
        with h5py.File(self.folder / "dry" / "solids.h5", "a") as file:
            file.attrs["mill_charge"] = "f" * 16
        (missing,) = study.read_study(self.folder).missing
        self.assertRegex(missing, "^one_way_0.5: .*not that of the dry run: .*0000000000000002, expected ffff")

    def test_a_mixed_dry_run_is_refused(self):
        write_dry(self.folder / "dry")
        change_json(self.folder / "dry" / "dumps" / "results.json", "mill", "charge", to="f" * 16)
        with self.assertRaisesRegex(RuntimeError, "results.json has the fingerprint charge ffff"):
            study.read_study(self.folder)


if __name__ == "__main__":
    unittest.main()
