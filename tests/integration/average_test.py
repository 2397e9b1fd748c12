#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""millAverage as a program: ranks and threads, a run that is killed, a disk that is full, options that users get
wrong."""
import json
import resource
import signal
import subprocess
import tempfile
import time
import unittest
from pathlib import Path

import h5py
import numpy as np

RECORDS, BALLS = 60, 400
LAMMPS = Path(__file__).resolve().parents[1] / "averaging" / "dumps" / "data" / "lammps"
# Open MPI leaves memory behind in libraries that it has unloaded by then, for which a build with sanitizers would fail.
MPIRUN = ("mpirun", "--oversubscribe", "-x", "ASAN_OPTIONS=detect_leaks=0", "-np")
RUN = {"format": "millfoam-dumps", "mill": {"charge": "00c0ffee00c0ffee"}, "timestep_s": 1e-4, "interval": 100,
       "angular_velocity_rad_s": 2, "fines_mass_kg": 1, "charge_mass_kg": 3}
BOX = ["--box", "-1", "-1", "0", "1", "1", "1", "--shape", "9", "8", "3", "--periodic", "z"]


def write_dumps(folder):
    """Balls that turn about the z axis at 2 rad/s: every 100 steps of 1e-4 s."""
    random = np.random.default_rng(1)
    radius, angle = random.uniform(0, 0.85, BALLS), random.uniform(0, 2 * np.pi, BALLS)
    z, size = random.uniform(0, 1, BALLS), random.uniform(0.03, 0.12, BALLS)
    for record in range(RECORDS):
        turned = angle + 2 * 0.01 * record
        x, y = radius * np.cos(turned), radius * np.sin(turned)
        rows = np.column_stack([np.arange(1, BALLS + 1), x, y, z, -2 * y, 2 * x, 0 * x, size])
        text = "\n".join(f"{int(r[0])} 1 " + " ".join(repr(float(v)) for v in r[1:]) for r in rows)
        (folder / f"dump.{100 * record}.txt").write_text(
            f"ITEM: TIMESTEP\n{100 * record}\nITEM: NUMBER OF ATOMS\n{BALLS}\nITEM: BOX BOUNDS ff ff pp\n"
            f"-1 1\n-1 1\n0 1\nITEM: ATOMS id type x y z vx vy vz radius\n{text}\n")
    (folder / "run.json").write_text(json.dumps(RUN))


def fnv1a(data):
    """64 bits, as 16 hex digits."""
    value = 0xcbf29ce484222325
    for byte in data:
        value = (value ^ byte) * 0x100000001b3 % 2**64
    return f"{value:016x}"


class MillAverage(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.dumps = tempfile.TemporaryDirectory()
        write_dumps(Path(cls.dumps.name))

    @classmethod
    def tearDownClass(cls):
        cls.dumps.cleanup()

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def command(self, *options, output="solids.h5", window=("0.1",), grid=BOX):
        return ["millAverage", "--dumps", f"{self.dumps.name}/dump.*.txt", *grid, "--window", *window, "-o", output,
                *options]

    def run_in_folder(self, command, **arguments):
        return subprocess.run(command, cwd=self.folder, text=True, capture_output=True, timeout=120, **arguments)

    def average(self, *options, launcher=(), **arguments):
        result = self.run_in_folder([*launcher, *self.command(*options, **arguments)])
        self.assertEqual(result.returncode, 0, result.stderr)
        return result

    def refused(self, command, *words):
        result = self.run_in_folder(command)
        self.assertEqual(result.returncode, 1, result.stdout + result.stderr)
        for word in words:
            self.assertIn(word, result.stderr)

    def bytes(self, name):
        return (self.folder / name).read_bytes()

    def test_ranks_and_threads_give_the_same_file_to_the_last_bit(self):
        self.average("--threads", "1", output="one.h5", window=("0.1", "whole"))
        for ranks, threads in ((1, 2), (2, 1), (3, 2)):
            launcher = (*MPIRUN, str(ranks))
            self.average("--threads", str(threads), output="many.h5", window=("0.1", "whole"), launcher=launcher)
            for window in ("0.1", "whole"):
                self.assertEqual(self.bytes(f"many_{window}.h5"), self.bytes(f"one_{window}.h5"), (ranks, threads))

    def test_an_error_on_one_rank_ends_all(self):
        broken = self.folder / "dumps"
        broken.mkdir()
        for dump in Path(self.dumps.name).iterdir():
            (broken / dump.name).write_bytes(dump.read_bytes())
        (broken / "dump.3500.txt").write_text((broken / "dump.3500.txt").read_text()[:2000])
        command = ["millAverage", "--dumps", "dumps/dump.*.txt", *BOX, "--window", "0.1", "-o", "solids.h5"]
        result = self.run_in_folder([*MPIRUN, "2", *command])
        self.assertNotEqual(result.returncode, 0)
        self.assertIn("dump.3500.txt", result.stderr)
        self.assertFalse((self.folder / "solids.h5").exists())

    def test_killed_at_any_moment_the_next_run_gives_the_same_file(self):
        self.average(output="whole_run.h5")
        note, sizes = self.folder / "solids.h5.resume", []
        for _ in range(3):
            process = subprocess.Popen(self.command("--checkpoint", "0", "--threads", "1"), cwd=self.folder,
                                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            seen = note.stat().st_mtime_ns if note.exists() else 0
            while process.poll() is None and (not note.exists() or note.stat().st_mtime_ns == seen):
                time.sleep(0.001)
            process.send_signal(signal.SIGKILL)
            self.assertEqual(process.wait(), -signal.SIGKILL, "the run ended before it was killed")
            self.assertFalse((self.folder / "solids.h5").exists())
            sizes.append((self.folder / "solids.h5.journal").stat().st_size)
        self.assertEqual(sizes, sorted(sizes), "a later run resumes where the one before was killed")
        last = self.average("--checkpoint", "0")
        self.assertIn("resuming an unfinished run", last.stderr)
        self.assertEqual(self.bytes("solids.h5"), self.bytes("whole_run.h5"))
        self.assertEqual(sorted(p.name for p in self.folder.iterdir()),
                         [name + end for name in ("solids", "whole_run") for end in (".h5", ".json", ".xdmf")])

    def test_a_full_disk_is_reported_and_leaves_nothing_that_looks_whole(self):
        self.average(output="whole_run.h5")
        size = (self.folder / "whole_run.h5").stat().st_size

        def limit(kilobytes):
            def apply():
                signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
                resource.setrlimit(resource.RLIMIT_FSIZE, (kilobytes * 1024, kilobytes * 1024))
            return apply

        for part in (0.01, 0.3, 0.9):
            result = self.run_in_folder(self.command(), preexec_fn=limit(int(part * size / 1024)))
            self.assertEqual(result.returncode, 1, result.stderr)
            self.assertIn("solids.h5", result.stderr)
            self.assertFalse((self.folder / "solids.h5").exists())
        self.average()
        self.assertEqual(self.bytes("solids.h5"), self.bytes("whole_run.h5"))

    def test_report_fails_above_the_tolerance_only(self):
        grid = ["--box", "-0.5", "-1", "0", "1", "1", "1", "--shape", "6", "8", "3", "--periodic", "z"]
        self.average(grid=grid)
        with h5py.File(self.folder / "solids.h5") as solids:
            ledger = solids["ledger"]
            share = np.max(ledger["outside"][:] / ledger["volume_in"][:])
        self.assertGreater(share, 0.05)
        self.refused(["millAverage", "--report", "solids.h5"], "outside the grid", "window 0")
        above = self.run_in_folder(["millAverage", "--report", "solids.h5", "--tolerance", str(share * 1.01)])
        self.assertEqual(above.returncode, 0, above.stderr)
        self.assertIn("outside, %", above.stdout)
        self.refused(self.command("--tolerance", str(share * 0.99), grid=grid), "outside the grid")

    def test_a_report_that_cannot_be_printed_or_written_fails(self):
        self.average()
        self.refused(["sh", "-c", "millAverage --report solids.h5 > /dev/full"], "standard output: cannot be written")
        self.refused(["millAverage", "--report", "solids.h5", "--json", "."],
                     "--json .: is a folder, expected the name of a file")

    def test_the_summary_has_the_numbers_of_the_file_and_of_the_dry_run(self):
        version = self.run_in_folder(["millAverage", "--version"])
        self.assertEqual(version.returncode, 0, version.stderr)
        self.assertRegex(version.stdout, r"^millAverage \d+\.\d+\.\d+\S*\n$")
        self.average("--start", "-0.05", window=("0.25",))
        summary = json.loads(self.bytes("solids.json"))
        self.assertEqual(list(summary)[:3], ["format", "program", "mill"])
        with h5py.File(self.folder / "solids.h5") as solids:
            for key, data_set in (("begin_s", "window/begin"), ("end_s", "window/end"), ("records", "window/records"),
                                  ("starts_late", "window/starts_late"), ("ends_short", "window/ends_short"),
                                  ("volume_in_m3", "ledger/volume_in"), ("deposited_m3", "ledger/deposited"),
                                  ("outside_m3", "ledger/outside"), ("clipped_m3", "ledger/clipped"),
                                  ("balls_per_cell", "window/balls_per_cell")):
                self.assertEqual(summary["per_window"][key], list(solids[data_set]), key)
            self.assertEqual(summary["largest_solidity"], solids["solidity"][:].max())
            attributes = {key: solids.attrs[key].decode() for key in ("program", "mill_charge", "run_id")}
            self.assertEqual((summary["fines_share"], solids.attrs["fines_share"]), (0.25, 0.25))
        self.assertEqual(attributes["program"], version.stdout.strip())
        self.assertEqual(summary["program"], version.stdout.strip())
        self.assertEqual(attributes["mill_charge"], RUN["mill"]["charge"])
        self.assertEqual(summary["mill"], RUN["mill"])
        self.assertEqual(attributes["run_id"], fnv1a((Path(self.dumps.name) / "run.json").read_bytes()))
        self.assertEqual(summary["run_id"], attributes["run_id"])
        self.assertEqual((summary["time0_s"], summary["windows"], summary["records"]), (-0.05, 3, RECORDS))
        self.assertEqual((summary["grid"], summary["shape"]), ("box", [9, 8, 3]))
        reported = self.run_in_folder(["millAverage", "--report", "solids.h5", "--json", "reported.json"])
        self.assertEqual(reported.returncode, 0, reported.stderr)
        self.assertEqual(self.bytes("reported.json"), self.bytes("solids.json"))
        for sentence in summary["advice"]:
            self.assertIn(f"advice: {sentence}\n", reported.stdout)

    def test_several_windows_need_the_extension_that_their_summaries_replace(self):
        self.refused(self.command(output="solids", window=("0.1", "0.05")), "-o: 'solids': with several windows",
                     "ends in .h5")

    def test_only_solids_files_are_overwritten(self):
        mill = "geometry: {diameter: 2}\n"
        (self.folder / "mill.yaml").write_text(mill)
        self.refused(self.command(output="mill.yaml"), "mill.yaml", "exists and is not a millfoam-solids file")
        self.refused([*MPIRUN, "2", *self.command(output="mill.yaml")], "exists and is not a millfoam-solids file")
        self.average()
        self.refused(["millAverage", "--report", "solids.h5", "--json", "mill.yaml"], "mill.yaml",
                     "exists and is not a millfoam-averages file")
        self.assertEqual((self.folder / "mill.yaml").read_text(), mill)
        self.assertEqual(sorted(p.name for p in self.folder.iterdir()),
                         ["mill.yaml", "solids.h5", "solids.json", "solids.xdmf"])
        self.average()

    def test_a_second_run_into_the_same_file_is_refused(self):
        process = subprocess.Popen(self.command("--checkpoint", "0", "--threads", "1"), cwd=self.folder,
                                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        while process.poll() is None and not (self.folder / "solids.h5.resume").exists():
            time.sleep(0.001)
        process.send_signal(signal.SIGSTOP)
        self.assertFalse((self.folder / "solids.h5").exists(), "the first run ended before the second began")
        self.refused(self.command(), "solids.h5: another millAverage is writing this file")
        self.average(output="other.h5")
        process.send_signal(signal.SIGCONT)
        self.assertEqual(process.wait(), 0)
        self.assertEqual(self.bytes("solids.h5"), self.bytes("other.h5"))

    def test_a_grid_that_is_not_where_the_balls_are_is_refused(self):
        millimetres = ["--box", "-1000", "-1000", "0", "1000", "1000", "1000", "--shape", "9", "8", "3"]
        self.refused(self.command(grid=millimetres), "far too large", "x -1000 to 1000", "expected metres")
        shifted = ["--box", "2", "-1", "0", "3", "1", "1", "--shape", "9", "8", "3"]
        self.refused(self.command(grid=shifted), "100 % of the balls' volume lies outside", "x 2 to 3",
                     "expected metres")
        self.assertEqual(list(self.folder.iterdir()), [])
        part = ["--box", "0.3", "-1", "0", "1", "1", "1", "--shape", "9", "8", "3"]
        self.refused(self.command(grid=part), "outside", "--tolerance")
        self.average("--tolerance", "0.9", grid=part)

    def test_windows_that_the_dumps_do_not_fill_are_marked(self):
        self.average("--start", "-0.05", window=("0.25",))
        with h5py.File(self.folder / "solids.h5") as solids:
            self.assertEqual(list(solids["window/starts_late"]), [1, 0, 0])
            self.assertEqual(list(solids["window/ends_short"]), [0, 0, 1])

    def test_walls_turn_with_the_mill(self):
        """A square mill of 1 x 1 m^2 that turns by 45 degrees within the window."""
        corners = np.array([[0.5, 0.5], [-0.5, 0.5], [-0.5, -0.5], [0.5, -0.5]])
        facets = []
        for a, b in zip(corners, np.roll(corners, -1, axis=0)):
            low, high = (*a, 0), (*b, 0)
            facets += [(low, high, (*b, 1)), (low, (*b, 1), (*a, 1))]
        text = "solid walls\n" + "".join(
            "facet normal 0 0 0\nouter loop\n" + "".join(f"vertex {x} {y} {z}\n" for x, y, z in facet) +
            "endloop\nendfacet\n" for facet in facets) + "endsolid walls\n"
        (self.folder / "walls.stl").write_text(text)
        grid = ["--box", "-0.8", "-0.8", "0", "0.8", "0.8", "1", "--shape", "16", "16", "1"]
        self.average("--inside", "walls.stl", grid=grid, window=("whole",))
        with h5py.File(self.folder / "solids.h5") as solids:
            inside = solids["grid/insideFraction"][0, 0]
        self.assertAlmostEqual(inside.sum() * 0.01, 1.0, places=9)
        self.assertTrue(0 < inside[8, 14] < 1, "a corner of the mill passes x = 0.65 m")
        self.assertEqual(inside[8, 10], 1)

    def test_options_that_do_not_go_together_are_refused_by_name(self):
        self.refused(["millAverage", "--dumps", "x", "--window", "0.1", "-o", "a.h5"], "none of --box")
        self.refused(self.command("--cylinder", "0", "1", "0", "1"), "more than one of --box")
        self.refused(self.command(window=("0.1", "0.1")), "--window has '0.1' twice")
        self.refused(self.command(window=("soon",)), "--window is 'soon'", "whole")
        self.refused(self.command("--cap", "1.5"), "--cap is 1.5", "between 0 and 1")
        self.refused(self.command("--smooth", "0.1"), "--smooth", "--mesh")
        self.refused(self.command("--json", "solids.json"), "--json", "--report")
        self.refused(self.command("--tolerance", "nan"), "--tolerance is nan", "between 0 and 1")
        self.refused(self.command("--template", "1", "--method", "sample"), "--template is 1", "2 to 200")
        (self.folder / "folder").mkdir()
        self.refused(self.command(output="folder"), "'folder' is a folder")
        self.refused(self.command("--speed", "3"), "--speed is 3 rad/s", "run.json", "2 rad/s")
        self.refused(self.command("--inside", "no*.stl"), "--inside 'no*.stl' matches no file")
        self.refused(self.command(grid=["--mesh", "mesh.h5", "--shape", "1", "1", "1"]), "--shape",
                     "a mesh has its own")
        self.refused(self.command(grid=["--cylinder", "0.5", "0.2", "0", "1", "--shape", "3", "8", "1"]), "0.5", "0.2")
        self.refused(self.command(grid=BOX[:7]), "--shape is missing", "nx ny nz")

    def average_of_lammps(self, dumps, *periodic):
        """The ledger of averages of dumps that LAMMPS wrote: {name: m^3}."""
        self.run_in_folder(["millAverage", "--dumps", LAMMPS / dumps, "--dt", "2e-6", "--box", "-0.05", "-0.05", "0",
                            "0.05", "0.05", "0.04", "--shape", "5", "5", "2", *periodic, "--window", "whole",
                            "-o", "solids.h5"], check=True)
        with h5py.File(self.folder / "solids.h5") as solids:
            volume = solids["solidity"][0].sum() * 0.02**3
            self.assertAlmostEqual(volume / solids["ledger/deposited"][0], 1, places=12)
            return {name: values[0] for name, values in solids["ledger"].items()}

    def test_dumps_of_lammps_keep_all_their_volume(self):
        """41 balls of 10 mm and 22 of 6 mm, of which some lie across the periodic ends."""
        volume = np.pi / 6 * (41 * 0.010**3 + 22 * 0.006**3)
        for dumps in ("drum.*.txt", "sorted.*.gz", "scaled.*.txt", "unwrapped.*.txt"):
            ledger = self.average_of_lammps(dumps, "--periodic", "z")
            self.assertAlmostEqual(ledger["volume_in"] / volume, 1, places=12, msg=dumps)
            self.assertAlmostEqual(ledger["deposited"] / volume, 1, places=12, msg=dumps)
        closed = self.average_of_lammps("drum.*.txt")
        self.assertGreater(closed["outside"], 0.01 * volume)


if __name__ == "__main__":
    unittest.main()
