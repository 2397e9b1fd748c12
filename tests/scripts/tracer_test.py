#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tracers on orbits whose residence times and velocities are known, and tracks of balls out of dumps."""
import tempfile
import unittest
from pathlib import Path
from types import SimpleNamespace
from unittest import mock

import numpy as np

from millfoam.files.tracks import Trajectory, read_tracks, read_trajectory
from millfoam.readings.compare import difference
from millfoam.readings.tracer import residence, tracer_map, velocities
from millfoam.report import measurements
from report_cases import write_json

UNIT = [np.linspace(0, 1, 5)] * 3  # 4 x 4 x 4 voxels of 0.25
SPEED = 2.0


def orbit(radius=1.0, turns=1.0, points=401, start=0.0):
    """A circle about the z axis at uniform speed, one turn in 2 pi / SPEED seconds, at uneven times."""
    share = np.linspace(0, 1, points)
    time = (share + 0.3 / points * np.sin(7 * np.arange(points))) * 2 * np.pi * turns / SPEED
    time[0], time[-1] = 0, 2 * np.pi * turns / SPEED
    angle = start + SPEED * time
    return Trajectory(time, np.stack([radius * np.cos(angle), radius * np.sin(angle), np.full(points, 0.5)], axis=1))


def times_of(track, edges, **options):
    return residence(track, edges, velocities(track), **options)


class Residence(unittest.TestCase):
    def test_of_a_diagonal_is_a_quarter_in_each_voxel_on_it(self):
        track = Trajectory([0, 3, 8], np.array([[0, 0, 0], [0.3, 0.3, 0.3], [1, 1, 1]]) * 0.999999999 + 1e-10)
        time, path, outside = times_of(track, UNIT)
        # The first part goes 0.3 in 3 s, the second 0.7 in 5 s
        expected = [2.5, 0.5 + 0.2 / 0.14, 0.25 / 0.14, 0.25 / 0.14]
        np.testing.assert_allclose([time[i, i, i] for i in range(4)], expected, rtol=1e-7)
        self.assertAlmostEqual(time.sum(), 8)
        self.assertEqual(outside, 0)

    def test_of_a_line_is_shared_by_the_voxels_as_their_lengths_whatever_the_direction(self):
        begin, end = np.array([0.9, 0.1, 0.6]), np.array([0.05, 0.7, 0.55])
        track = Trajectory([0, 1, 2], [begin, (begin + end) / 2, end])
        time, path, outside = times_of(track, UNIT)
        fine = begin + (np.arange(400000) + 0.5)[:, None] / 400000 * (end - begin)
        counted = np.zeros_like(time)
        index = np.floor(fine * 4).astype(int)
        np.add.at(counted, (index[:, 2], index[:, 1], index[:, 0]), 2 / 400000)
        np.testing.assert_allclose(time, counted, atol=1e-5)
        np.testing.assert_allclose(path[time > 0] / time[time > 0][:, None],
                                   np.tile((end - begin) / 2, (np.sum(time > 0), 1)))

    def test_of_a_tracer_that_speeds_up_is_weighted_with_its_velocity_in_each_voxel(self):
        track = Trajectory([0, 1], [[0, 0.5, 0.5], [0.5, 0.5, 0.5]])
        _, path, _ = residence(track, UNIT, np.array([[0, 0, 0], [2, 0, 0]]))
        np.testing.assert_allclose(path[2, 2, :3, 0], [0.25, 0.75, 0])

    def test_outside_the_voxels_is_counted(self):
        track = Trajectory([0, 1], [[-1, 0.5, 0.5], [3, 0.5, 0.5]])
        time, _, outside = residence(track, UNIT, np.zeros((2, 3)))
        self.assertAlmostEqual(outside, 0.75)
        np.testing.assert_allclose(time[2, 2], 0.25 / 4)

    def test_of_an_orbit_is_the_angle_that_each_voxel_has_of_it(self):
        edges = [np.array([-2, 0.5, 2]), np.array([-2, 0, 2]), np.array([0, 1])]
        track = orbit(points=20001)
        share = times_of(track, edges)[0][0] / track.time[-1]
        np.testing.assert_allclose(share, [[1 / 3, 1 / 6], [1 / 3, 1 / 6]], atol=1e-7)

    def test_along_a_periodic_axis_is_carried_to_the_other_side(self):
        track = Trajectory([0, 1], [[0.5, 0.5, -0.5], [0.5, 0.5, 3.0]])
        time, _, outside = residence(track, UNIT, np.zeros((2, 3)), periodic=True)
        self.assertEqual(outside, 0)
        np.testing.assert_allclose(time[:, 2, 2] * 3.5, [0.75, 0.75, 1, 1])


class Velocity(unittest.TestCase):
    def test_of_three_points_is_exact_for_a_parabola_and_of_five_for_a_quartic_at_uneven_times(self):
        time = np.array([0, 0.1, 0.35, 0.5, 0.9, 1.0, 1.6])
        for points, degree in ((3, 2), (5, 4)):
            curve = np.polynomial.Polynomial(np.arange(1, degree + 2))
            track = Trajectory(time, np.stack([curve(time), -curve(time), 0 * time], axis=1))
            found = velocities(track, points)
            np.testing.assert_allclose(found[:, 0], curve.deriv()(time), rtol=1e-11)
            np.testing.assert_allclose(found[:, 1], -curve.deriv()(time), rtol=1e-11)
            above = Trajectory(time, np.stack([time ** (degree + 1)] * 3, axis=1))
            self.assertGreater(np.abs(velocities(above, points)[:, 0] - (degree + 1) * time ** degree).max(), 1e-3)

    def test_on_an_orbit_converges_with_the_second_and_the_fourth_order(self):
        for points, order in ((3, 2), (5, 4)):
            errors = []
            for count in (81, 161, 321):
                track = orbit(points=count)
                exact = SPEED * np.stack([-track.position[:, 1], track.position[:, 0], 0 * track.time], axis=1)
                errors.append(np.sqrt(np.mean((velocities(track, points) - exact) ** 2)))
            slopes = np.log2(np.array(errors[:-1]) / errors[1:])
            np.testing.assert_allclose(slopes, order, atol=0.35)

    def test_of_an_even_function_is_nought_in_its_middle_because_the_points_lie_evenly_about_it(self):
        time = np.arange(-4.0, 5.0)
        for points in (3, 5):
            found = velocities(Trajectory(time, np.stack([time ** 6, time ** 2, time ** 8], axis=1)), points)
            np.testing.assert_allclose(found[4], 0, atol=1e-10)

    def test_of_too_few_points_is_refused(self):
        with self.assertRaisesRegex(ValueError, "5-point differentiation of 4 points"):
            velocities(Trajectory([0, 1, 2, 3], np.zeros((4, 3))), 5)


class Map(unittest.TestCase):
    def test_holds_the_charges_volume_and_the_orbits_speed(self):
        edges = [np.linspace(-1.5, 1.5, 13), np.linspace(-1.5, 1.5, 13), np.linspace(0, 1, 4)]
        found = tracer_map([orbit(), orbit(radius=0.6, start=1.0)], edges, charge_volume=2.0)
        self.assertAlmostEqual(found.solidity.sum() * 0.25 ** 2, 2.0)
        self.assertAlmostEqual(found.solidity_3d.sum() * 0.25 ** 2 / 3, 2.0)
        self.assertAlmostEqual(found.residence.sum(), 1)
        self.assertEqual((found.outside, found.tracers), (0, 2))
        spun = found.solidity[..., None] * np.nan_to_num(found.velocity)
        spun_3d = found.solidity_3d[..., None] * np.nan_to_num(found.velocity_3d)
        self.assertAlmostEqual(np.abs(spun).sum(), np.abs(spun_3d).sum() / 3)
        right = found.velocity[6, 9:11]  # y just above 0: upwards, as fast as the orbit
        self.assertAlmostEqual(np.nanmax(right[:, 1]), SPEED, delta=0.03)

    def test_of_voxels_partly_in_the_mill_is_divided_by_that_part(self):
        edges = [np.array([0, 1.0]), np.array([0, 1.0]), np.array([0, 1.0])]
        track = Trajectory([0, 1, 2], [[0.2, 0.2, 0.2], [0.5, 0.4, 0.2], [0.7, 0.8, 0.2]])
        found = tracer_map(track, edges, 0.3, inside=np.full((1, 1, 1), 0.5))
        self.assertAlmostEqual(found.solidity[0, 0], 0.6)
        self.assertAlmostEqual(found.inside[0, 0], 0.5)

    def test_of_many_tracers_nears_the_ensembles_as_the_root_of_their_number(self):
        # Balls that jump between places at random: what a voxel gets is a sum of independent times
        draw = np.random.default_rng(5)
        edges = [np.linspace(0, 1, 6)] * 2 + [np.array([0, 1.0])]
        tracks = []
        for _ in range(800):
            places = np.repeat(draw.random((20, 3)), 2, axis=0)
            tracks.append(Trajectory(np.arange(20)[:, None].repeat(2, 1).ravel() + np.tile([0, 0.999], 20), places))
        whole = tracer_map(tracks, edges, 0.5)
        whole.solidity = np.full((5, 5), 0.5)
        apart = [np.mean([difference(tracer_map(tracks[first:first + number], edges, 0.5), whole).solidity
                          for first in range(0, 800, max(number, 50))]) for number in (4, 16, 64)]
        np.testing.assert_allclose(np.array(apart[:-1]) / apart[1:], 2, rtol=0.25)


class File(unittest.TestCase):
    def read(self, text, **units):
        with tempfile.NamedTemporaryFile("w", suffix=".csv") as file:
            file.write(text)
            file.flush()
            return read_trajectory(file.name, **units)

    def test_with_names_commas_and_comments_or_with_blanks_alone_is_read(self):
        for text in ("t,x,y,z\n0,1,2,3\n# pause\n\n1,4,5,6\n", "0 1 2 3\n1 4 5 6\n"):
            track = self.read(text)
            np.testing.assert_allclose(track.time, [0, 1])
            np.testing.assert_allclose(track.position, [[1, 2, 3], [4, 5, 6]])

    def test_in_milliseconds_and_millimetres_comes_out_in_si_units(self):
        track = self.read("0 1 2 3\n5 4 5 6\n", time_unit=1e-3, length_unit=1e-3)
        self.assertAlmostEqual(track.time[1], 0.005)
        self.assertAlmostEqual(track.position[1, 2], 0.006)

    def test_that_cannot_be_used_is_refused_with_file_line_and_value(self):
        for text, message in (("0 1 2 3\n0 1 2 3\n", r":2: time 0 after 0"), ("0 1 2 3\n1 nan 2 3\n", r":2: 'nan'"),
                              ("0 1 2 3\n1 2 3\n", r":2: 3 columns"), ("t x y z\n0 1 2 3\n", r"1 points"),
                              ("0 1 2 3\n1 x 2 3\n", r":2: 'x'"), ("t,x,y,z\nt,x,y,z\n", r":2: 't'")):
            with self.assertRaisesRegex(RuntimeError, r"\.csv" + (message if message[0] == ":" else ".*" + message)):
                self.read(text)


class InTheReport(unittest.TestCase):
    EDGES = [np.linspace(-0.06, 0.06, 5)] * 2 + [np.array([0, 0.02])]

    def orbit(self, scale):
        track = orbit(0.05)
        return Trajectory(track.time, scale * (track.position + (0, 0, -0.49)))

    def test_a_track_in_millimetres_or_of_another_place_is_refused_with_both_extents(self):
        for periodic in (False, True):
            measurements.refuse_outside("a.csv", self.orbit(1), self.EDGES, periodic)
            with self.assertRaises(RuntimeError) as caught:
                measurements.refuse_outside("a.csv", self.orbit(1000), self.EDGES, periodic)
            for part in ("a.csv: 100 % of its time is outside",
                         "the track covers x = -50 to 50, y = -50 to 50, z = 10 to 10, the voxels "
                         "x = -0.06 to 0.06, y = -0.06 to 0.06, z = 0 to 0.02 m; expected t in s, x, y and z in m"):
                self.assertIn(part, str(caught.exception))

    def test_a_track_that_leaves_for_less_than_half_of_its_time_is_taken(self):
        for out, taken in ((0.45, True), (0.55, False)):
            track = Trajectory([0, 1 - out, 1 - out + 1e-9, 1], [[0, 0, 0.01]] * 2 + [[0, 0, 0.03]] * 2)
            if taken:
                measurements.refuse_outside("a.csv", track, self.EDGES, False)
            else:
                with self.assertRaisesRegex(RuntimeError, "a.csv: 55 % of its time"):
                    measurements.refuse_outside("a.csv", track, self.EDGES, False)

    def test_the_section_names_the_file_among_several(self):
        with tempfile.TemporaryDirectory() as folder:
            paths = [Path(folder) / name for name in ("good.csv", "far.csv")]
            for path, scale in zip(paths, (1, 1000)):
                track = self.orbit(scale)
                np.savetxt(path, np.column_stack([track.time, track.position]))
            case = SimpleNamespace(folder=folder, solids="solids.h5")
            voxels = self.EDGES, None, False, 1e-5
            with mock.patch.object(measurements, "charge_voxels", lambda _: voxels), \
                    self.assertRaisesRegex(RuntimeError, "far.csv: 100 % of its time is outside"):
                measurements.tracer_section(case, paths)


class Tracks(unittest.TestCase):
    def make_dumps(self, bounds="ff ff pp", lost=None):
        """Ten balls in eleven dumps; ball 3 goes along z at 2 m/s in a slice of length 1, the others rest."""
        folder = Path(self.enterContext(tempfile.TemporaryDirectory()))
        write_json(folder / "run.json", "dumps", timestep_s=0.01, interval=10, angular_velocity_rad_s=-2)
        for record in range(11):
            place = 0.05 + 0.2 * record
            lines = [f"{ball} 1 {ball} 0.5 {place % 1 if ball == 3 else 0.5} 0 0 0 0.1" for ball in (10, 3, 7, 1, 2)
                     if ball != lost]
            head = f"ITEM: TIMESTEP\n{10 * record}\nITEM: NUMBER OF ATOMS\n{len(lines)}\nITEM: BOX BOUNDS {bounds}\n" \
                   "-1 1\n-1 1\n0 1\nITEM: ATOMS id type x y z vx vy vz radius \n"
            (folder / f"dump.{10 * record}.txt").write_text(head + "\n".join(lines) + "\n")
        return folder

    def test_of_balls_are_read_by_id_and_go_on_across_a_periodic_end(self):
        tracks = read_tracks(self.make_dumps(), [10, 3])
        self.assertEqual(sorted(tracks), [3, 10])
        np.testing.assert_allclose(tracks[3].time, np.arange(11) / 10)
        np.testing.assert_allclose(tracks[3].position[:, 2], 0.05 + 0.2 * np.arange(11))
        np.testing.assert_allclose(tracks[10].position, np.tile([10, 0.5, 0.5], (11, 1)))
        np.testing.assert_allclose(velocities(tracks[3])[:, 2], 2)

    def test_between_two_times_have_the_dumps_of_these(self):
        np.testing.assert_allclose(read_tracks(self.make_dumps(), [1], 0.2, 0.5)[1].time, [0.2, 0.3, 0.4, 0.5])

    def test_between_walls_stay_as_they_are(self):
        track = read_tracks(self.make_dumps("ff ff ff"), [3])[3]
        self.assertLess(track.position[:, 2].max(), 1)

    def test_of_a_ball_that_a_dump_lacks_are_refused(self):
        with self.assertRaisesRegex(RuntimeError, "dump.0.txt: no ball 7"):
            read_tracks(self.make_dumps(lost=7), [3, 7])


if __name__ == "__main__":
    unittest.main()
