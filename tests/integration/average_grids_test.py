#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""millAverage over its options: boxes, cylinders and meshes, walls, motions, smoothing, caps, kinds of dumps."""
import gzip
import json
import subprocess
import tempfile
import unittest
from pathlib import Path

import h5py
import numpy as np

import mesh
from average_test import MPIRUN

DT, INTERVAL, OMEGA = 1e-3, 100, 2.0  # s, steps, rad/s
LOWER, UPPER = np.array([-1.0, -1, 0]), np.array([1.0, 1, 1])
DRUM = (6, 6, 4)
BOX = ("--box", "-1", "-1", "0", "1", "1", "1", "--shape", "5", "6", "4")
CYLINDER = ("--cylinder", "0", "1", "0", "1", "--shape", "3", "8", "4")
MESH = ("--mesh", "drum.h5")
GRIDS = {BOX: ("--periodic", "z"), CYLINDER: ("--periodic", "z"), MESH: ("--period", "1")}
EDGES = np.linspace(0, 1, 5)  # of the layers along z that all of them have


def sphere(radius):
    return 4 / 3 * np.pi * radius**3


def below(z, centre, radius):
    """Volume of a ball below a height."""
    s = np.clip(z - centre, -radius, radius)
    return np.pi * (radius**2 * s - s**3 / 3 + 2 / 3 * radius**3)


def turned(points, angle):
    c, s = np.cos(angle), np.sin(angle)
    return points @ np.array([[c, s, 0], [-s, c, 0], [0, 0, 1]])


def charge(count=60):
    """Places, velocities and radii of balls within the drum; some reach over its ends."""
    random = np.random.default_rng(7)
    r, angle = random.uniform(0, 0.85, count), random.uniform(0, 2 * np.pi, count)
    places = np.column_stack([r * np.cos(angle), r * np.sin(angle), random.uniform(0, 1, count)])
    return places, random.uniform(-3, 5, (count, 3)), random.uniform(0.03, 0.12, count)


class AverageTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        mesh.write(self.folder / "drum.h5", mesh.drum(DRUM))

    def dump(self, step, columns, folder="dumps", packed=False):
        """Columns: the dump's own names, with a value for each ball."""
        (self.folder / folder).mkdir(exist_ok=True)
        (self.folder / folder / "run.json").write_text(
            json.dumps({"timestep_s": DT, "interval": INTERVAL, "angular_velocity_rad_s": OMEGA}))
        rows = "".join(f"{i} " + " ".join(map(repr, row)) + "\n"
                       for i, row in enumerate(np.column_stack(list(columns.values())).tolist(), 1))
        bounds = "".join(f"{low} {high}\n" for low, high in zip(LOWER, UPPER))
        text = (f"ITEM: TIMESTEP\n{step}\nITEM: NUMBER OF ATOMS\n{rows.count(chr(10))}\nITEM: BOX BOUNDS ff ff pp\n"
                f"{bounds}ITEM: ATOMS id {' '.join(columns)}\n{rows}")
        name = f"dump.{step}.txt" + (".gz" if packed else "")
        (self.folder / folder / name).write_bytes(gzip.compress(text.encode()) if packed else text.encode())

    def balls(self, places, radii, *, velocities=(0, 0, 0), step=0, names=("x", "y", "z"), **options):
        places = np.atleast_2d(places)
        values = (*places.T, *np.broadcast_to(velocities, places.shape).T, np.broadcast_to(radii, len(places)))
        self.dump(step, dict(zip((*names, "vx", "vy", "vz", "radius"), values)), **options)

    def turning_charge(self, records=6, scaled=False, **options):
        places, velocities, radii = charge()
        for record in range(records):
            now = turned(places, OMEGA * DT * INTERVAL * record)
            if scaled:
                options["names"], now = ("xs", "ys", "zs"), (now - LOWER) / (UPPER - LOWER)
            self.balls(now, radii, velocities=velocities, step=INTERVAL * record, **options)

    def run_program(self, options, launcher=()):
        return subprocess.run([*launcher, "millAverage", *options], cwd=self.folder, text=True, capture_output=True,
                              timeout=60, check=False)

    def average(self, *options, dumps="dumps", window="whole", output="solids.h5", launcher=()):
        """The file's data sets by name; besides `volume`, of each cell, and `smoothing`, its width."""
        done = self.run_program(["--dumps", f"{dumps}/dump.*", "--window", window, "-o", output, *options], launcher)
        self.assertEqual(done.returncode, 0, done.stderr)
        sets = {}
        with h5py.File(self.folder / output) as file:
            file.visititems(lambda name, item: sets.update({name: item[()]} if isinstance(item, h5py.Dataset) else {}))
            grid, sets["smoothing"] = dict(file["grid"].attrs), file.attrs["smoothing"]
        if "upper" in grid:
            sets["volume"] = np.prod((grid["upper"] - grid["lower"]) / grid["shape"])
        elif "radii" in grid:
            rings, sectors, heights = grid["shape"]
            edges = np.linspace(*grid["radii"], rings + 1)
            sets["volume"] = np.pi * np.diff(edges**2) / sectors * np.diff(grid["ends"]) / heights
        else:
            sets["volume"] = sets["grid/volume"]
        return sets

    def refused(self, options, *words):
        done = self.run_program(["--dumps", "dumps/dump.*", "--window", "whole", "-o", "refused.h5", *options])
        self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
        for word in words:
            self.assertIn(word, done.stderr)
        self.assertFalse((self.folder / "refused.h5").exists())

    def bytes(self, name):
        return (self.folder / name).read_bytes()


def layers(solids):
    """Volume of balls in each of the layers along z of one of the GRIDS, in the first window."""
    volume = solids["solidity"][0] * solids["volume"]
    return volume.reshape(*DRUM).sum(axis=(0, 1)) if volume.ndim == 1 else volume.sum(axis=(1, 2))


class Grids(AverageTest):
    def test_all_hold_the_same_volume_of_balls_in_each_layer(self):
        self.turning_charge()
        places, _, radii = charge()
        for periodic in (False, True):
            shifts = (-1, 0, 1) if periodic else (0,)
            heights, sizes = np.add.outer(shifts, places[:, 2]).ravel(), np.tile(radii, len(shifts))
            parts = np.diff([below(z, heights, sizes) for z in EDGES], axis=0)
            cut = (parts > 0) & (parts < sphere(sizes) * (1 - 1e-12))
            wrong = 3 / (4 * 12) * (cut * sphere(sizes)).sum(axis=1)  # of 12 points along a diameter
            for method, least, most in (("exact", 0, 1e-12), ("sample", 1e-6, wrong)):
                for grid, repeats in GRIDS.items():
                    with self.subTest(grid=grid[0], method=method, periodic=periodic):
                        solids = self.average(*grid, *(repeats if periodic else ()), "--method", method)
                        error = np.abs(layers(solids) - parts.sum(axis=1))
                        self.assertTrue(error.max() >= least and np.all(error <= most), error)
                        beyond = sphere(radii).sum() - layers(solids).sum()
                        self.assertAlmostEqual(solids["ledger/outside"][0], beyond, delta=1e-12)

    def test_hexahedra_that_are_a_boxs_voxels_hold_the_same_fields(self):
        self.turning_charge()
        mesh.write(self.folder / "box.h5", mesh.box(LOWER, UPPER, (5, 6, 4)))
        for method in ("exact", "sample"):
            voxels = self.average(*BOX, "--method", method)
            cells = self.average("--mesh", "box.h5", "--motion", "none", "--method", method)
            for name in ("solidity", "velocity", "diameter", "number", "solidity_deviation", "granular_temperature"):
                expected = voxels[name][0].swapaxes(0, 2)
                np.testing.assert_allclose(cells[name][0].reshape(expected.shape), expected, rtol=1e-9, atol=1e-12)

    def test_a_ball_over_the_end_comes_in_on_the_other_side_with_its_other_half(self):
        self.balls((0.3, 0.2, 1), 0.1)
        for grid, repeats in GRIDS.items():
            half = sphere(0.1) / 2
            np.testing.assert_allclose(layers(self.average(*grid, *repeats)), [half, 0, 0, half], atol=1e-15)
            np.testing.assert_allclose(layers(self.average(*grid)), [0, 0, 0, half], atol=1e-15)

    def test_the_cap_is_the_largest_solidity_and_what_is_above_moves(self):
        self.balls((0.1, 0.1, 0.5), 0.45)
        for grid in GRIDS:
            free, capped = self.average(*grid), self.average(*grid, "--cap", "0.4")
            with self.subTest(grid=grid[0]):
                self.assertAlmostEqual(capped["solidity"].max(), 0.4, delta=1e-12)
                self.assertAlmostEqual(layers(capped).sum(), sphere(0.45), delta=1e-12)
                above = (np.maximum(free["solidity"][0] - 0.4, 0) * free["volume"]).sum()
                self.assertGreater(above, 0.1 * sphere(0.45))
                self.assertAlmostEqual(capped["ledger/clipped"][0], above, delta=1e-12)

    def test_walls_out_of_stl_files_and_a_mesh_leave_the_same_room(self):
        self.turning_charge()
        points = mesh.drum(DRUM)
        mesh.write_walls(self.folder / "walls.stl", points)
        mesh.write(self.folder / "later.h5", turned(points, OMEGA * 0.3), time0=0.2, times=(0.1,))
        for grid in (("--box", "-1.2", "-1.1", "0", "1.1", "1.2", "1", "--shape", "7", "9", "4"),
                     ("--cylinder", "0", "1.1", "0", "1", "--shape", "8", "9", "4")):
            rooms = {walls: self.average(*grid, "--periodic", "z", "--inside", walls)
                     for walls in ("walls.stl", "drum.h5", "later.h5")}
            for walls, solids in rooms.items():
                with self.subTest(grid=grid[0], walls=walls):
                    inside = solids["grid/insideFraction"][0]
                    np.testing.assert_allclose(inside, rooms["walls.stl"]["grid/insideFraction"][0], atol=1e-12)
                    self.assertAlmostEqual((inside * solids["volume"]).sum(), mesh.volumes(points).sum(), delta=1e-12)
                    deposited = (inside * solids["volume"] * solids["solidity"][0]).sum()
                    self.assertAlmostEqual(deposited, sphere(charge()[2]).sum(), delta=1e-12)


class Dumps(AverageTest):
    def test_packed_ones_give_the_same_file_to_the_last_bit(self):
        self.turning_charge()
        self.turning_charge(folder="packed", packed=True)
        for grid in GRIDS:
            self.average(*grid, window="0.2", output="plain.h5")
            self.average(*grid, window="0.2", output="packed.h5", dumps="packed")
            self.assertEqual(self.bytes("plain.h5"), self.bytes("packed.h5"))

    def test_scaled_places_give_the_same_fields(self):
        self.turning_charge()
        self.turning_charge(folder="scaled", scaled=True)
        for grid in GRIDS:
            plain, scaled = self.average(*grid), self.average(*grid, dumps="scaled")
            for name in ("solidity", "solidity_deviation", "number", "ledger/outside"):
                np.testing.assert_allclose(scaled[name], plain[name], rtol=0, atol=1e-12, err_msg=name)

    def test_an_ellipsoid_lies_in_layers_as_the_sphere_of_its_height(self):
        """Its long half-axis, along x in its own frame, is turned onto z: a sphere stretched across z."""
        a, b, c = 0.45, 0.2, 0.1
        quarter = np.sqrt(0.5)
        values = (0.1, 0.2, 0.52, 1, 2, 3, a, b, c, quarter, 0, quarter, 0)
        names = "x y z vx vy vz shapex shapey shapez quat1 quat2 quat3 quat4".split()
        self.dump(0, {name: [value] for name, value in zip(names, values)})
        expected = np.diff(below(EDGES, 0.52, a)) * b * c / a**2
        for grid in GRIDS:
            solids = self.average(*grid, "--template", "40")
            with self.subTest(grid=grid[0]):
                self.assertAlmostEqual(solids["ledger/deposited"][0], 4 / 3 * np.pi * a * b * c, delta=1e-14)
                error = np.abs(layers(solids) - expected).max() / expected.sum()
                self.assertLess(error, 3 / (4 * 40))


class Smoothing(AverageTest):
    def test_keeps_the_total_and_the_range_and_spreads_the_charge(self):
        self.turning_charge()
        _, velocities, radii = charge()
        plain, smooth = (self.average(*MESH, "--period", "1", *o) for o in ((), ("--smooth", "0.4")))
        self.assertAlmostEqual(layers(smooth).sum(), layers(plain).sum(), delta=1e-12)
        self.assertLess(smooth["solidity"].max(), plain["solidity"].max())
        self.assertLess(np.count_nonzero(plain["solidity"]), np.count_nonzero(smooth["solidity"]))
        self.assertGreater(smooth["solidity"].min(), 0)
        for found, given in ((smooth["velocity"][0], velocities), (smooth["diameter"][0], 2 * radii)):
            self.assertTrue(np.all(found >= given.min(axis=0) - 1e-12))
            self.assertTrue(np.all(found <= given.max(axis=0) + 1e-12))

    def test_has_the_variance_of_its_kernel_along_a_duct(self):
        mesh.write(self.folder / "duct.h5", mesh.box((0, 0, 0), (4, 0.3, 0.2), (40, 3, 2)))
        self.balls((2.05, 0.15, 0.05), 0.04)
        solids = self.average("--mesh", "duct.h5", "--motion", "none", "--smooth", "0.3")
        share = (solids["solidity"][0] * solids["volume"]).reshape(40, 3, 2).sum(axis=(1, 2)) / sphere(0.04)
        place = np.arange(40) * 0.1 + 0.05
        self.assertAlmostEqual(share @ place, 2.05, delta=1e-12)
        self.assertAlmostEqual(share @ (place - 2.05)**2, 0.3**2 / 2, delta=1e-9)

    def test_goes_through_the_ends_of_a_mesh_that_repeats(self):
        self.balls((0.1, 0.1, 0.125), 0.1)
        first, above, far, below_it = layers(self.average(*MESH, "--period", "1", "--smooth", "0.2"))
        self.assertTrue(first > above > far > 0)
        self.assertAlmostEqual(above, below_it, delta=1e-15)

    def test_is_two_and_a_half_diameters_unless_given(self):
        self.balls((0.1, 0.1, 0.5), 0.1)
        usual, given = self.average(*MESH, "--smooth"), self.average(*MESH, "--smooth", "0.5")
        self.assertAlmostEqual(usual["smoothing"], 2.5 * 0.2, delta=1e-12)
        np.testing.assert_allclose(usual["solidity"], given["solidity"], rtol=0, atol=1e-12)

    def test_of_no_width_is_refused(self):
        self.balls((0.1, 0.1, 0.5), 0.1)
        for width in ("0", "-0.1", "nan", "inf", "wide"):
            self.refused([*MESH, "--smooth", width], "--smooth", f"'{width}'", "above 0")


class Motions(AverageTest):
    def test_a_ball_that_moves_with_the_mesh_stays_in_its_cell(self):
        time0 = 0.2  # s, when the mesh's points hold
        start = mesh.drum(DRUM)[3:5, 4:6, 1:3].mean(axis=(0, 1, 2))
        mesh.write(self.folder / "later.h5", mesh.drum(DRUM), time0=time0)
        (self.folder / "speed.txt").write_text("# a mill that speeds up\n0 0\n1 10\n")
        (self.folder / "path.txt").write_text("0 0 0 0\n0.1 1 0 0\n1 1 0 9\n")
        velocity = np.array([3, -4, 0.5])

        def turned_then_moved(t):
            in_first_place = turned(start - velocity * time0, -3 * time0)
            return turned(in_first_place, 3 * t) + velocity * t

        def path(t):
            return np.array([min(t / 0.1, 1), 0, max(t - 0.1, 0) * 10])

        motions = {
            (): lambda t: turned(start, OMEGA * (t - time0)),
            ("rotation speed -7",): lambda t: turned(start, -7 * (t - time0)),
            ("rotation table speed.txt",): lambda t: turned(start, 5 * (t**2 - time0**2)),
            ("rotation speed 3 axis 0 0 2 origin 0.5 1 0",):
                lambda t: turned(start - (0.5, 1, 0), 3 * (t - time0)) + (0.5, 1, 0),
            ("translation velocity 3 -4 0.5",): lambda t: start + velocity * (t - time0),
            ("translation table path.txt",): lambda t: start + path(t) - path(time0),
            ("rotation speed 3", "translation velocity 3 -4 0.5"): turned_then_moved,
            ("none",): lambda t: start}
        expected = np.zeros(DRUM)
        expected[3, 4, 1] = sphere(0.05) / mesh.volumes(mesh.drum(DRUM))[3, 4, 1]
        for words, place in motions.items():
            for record in range(6):
                self.balls(place(record * DT * INTERVAL), 0.05, step=record * INTERVAL)
            solids = self.average("--mesh", "later.h5", *(("--motion", *words) if words else ()), window="0.2")
            with self.subTest(motion=words):
                self.assertEqual(len(solids["solidity"]), 3)
                for window in solids["solidity"]:
                    np.testing.assert_allclose(window.reshape(DRUM), expected, rtol=0, atol=1e-12)
                np.testing.assert_allclose(solids["solidity_deviation"], 0, atol=1e-12)

    def test_unknown_ones_are_refused_by_name(self):
        self.balls((0.1, 0.1, 0.5), 0.1)
        (self.folder / "short.txt").write_text("0 1\n0.1 fast\n")
        for text, named in (("wobble 3", "'wobble'"), ("rotation sped 3", "'sped'"), ("rotation speed fast", "'fast'"),
                            ("translation velocity 1 2", "ends"), ("rotation table no.txt", "no.txt"),
                            ("rotation table short.txt", "short.txt:2")):
            self.refused([*MESH, "--motion", text], named)


class DeformingMesh(AverageTest):
    """A box of 4 cells along x that stretches from 1 m to 2 m in half a second."""

    def setUp(self):
        super().setUp()
        ends = [mesh.box((0, 0, 0), (length, 0.5, 0.25), (4, 1, 1)) for length in (1, 2)]
        mesh.write(self.folder / "stretched.h5", *ends, times=(0, 0.5), time0=0.1)
        self.options = ("--mesh", "stretched.h5", "--start", "0.1")
        self.lengths = 1 + np.arange(6) / 5

    def record(self, places):
        for number, place in enumerate(places, 1):
            self.balls(place, 0.1, step=number * INTERVAL)

    def test_a_ball_has_its_volume_over_the_mean_of_its_cells(self):
        volume = self.lengths.mean() / 4 * 0.5 * 0.25
        for cell, places in ((0, [(0.12, 0.2, 0.12)] * 6), (2, [(2.5 / 4 * s, 0.2, 0.12) for s in self.lengths])):
            self.record(places)
            expected = np.zeros(4)
            expected[cell] = sphere(0.1) / volume
            np.testing.assert_allclose(self.average(*self.options)["solidity"][0], expected, rtol=1e-12, atol=1e-15)

    def test_a_ball_that_rests_is_passed_by_cells(self):
        """At 0.9 m, wherever the cells' faces are just then: the closed form of a ball cut by planes."""
        self.record([(0.9, 0.2, 0.12)] * 6)
        faces = np.outer(self.lengths, np.arange(5) / 4)
        parts = np.diff([below(faces[:, i], 0.9, 0.1) for i in range(5)], axis=0).sum(axis=1)
        solidity = self.average(*self.options)["solidity"][0]
        np.testing.assert_allclose(solidity, parts / (self.lengths.sum() / 4 * 0.5 * 0.25), rtol=0, atol=1e-12)

    def test_what_does_not_go_with_it_is_refused(self):
        self.record([(0.12, 0.2, 0.12)] * 7)
        self.refused(self.options, "stretched.h5", "0.7 s", "0.1 to 0.6 s")
        self.refused([*self.options, "--motion", "none"], "--motion", "stretched.h5")
        self.refused([*self.options, "--smooth", "0.2"], "--smooth", "stretched.h5")


class Parallel(AverageTest):
    def test_ranks_and_threads_give_the_same_file_to_the_last_bit(self):
        self.turning_charge(records=9)
        mesh.write_walls(self.folder / "walls.stl", mesh.drum(DRUM))
        for options in ((*MESH, "--period", "1", "--smooth", "0.3"),
                        (*BOX, "--periodic", "z", "--inside", "walls.stl")):
            self.average(*options, "--threads", "1", window="0.2", output="one.h5")
            for ranks, threads in ((1, 2), (2, 1), (2, 2)):
                launcher = (*MPIRUN, str(ranks)) if ranks > 1 else ()
                self.average(*options, "--threads", str(threads), window="0.2", output="many.h5", launcher=launcher)
                self.assertEqual(self.bytes("many.h5"), self.bytes("one.h5"), (options, ranks, threads))


if __name__ == "__main__":
    unittest.main()
