#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""millLiggghts from 10^4 to 10^6 balls on one and two ranks: time of a step, of a record of averages, of the forces of
a flow and of a meeting with it, and memory.

    scale_benchmark.py [COPIES...]      slices of 10^4 balls in a row; 1 2 10 100 unless given

A periodic slice of the 30 cm mill with 10^4 balls settles and turns over twelve lifters, so that its walls are again
where they began. Its balls are then repeated along the axis of longer slices. The deck is millDem's own, but for the
insertion. A thread of this script is the flow: it speaks the messages of averaging/exchange and computes nothing."""
import json
import os
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import threading
from dataclasses import dataclass
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
MILL = ROOT / "cases" / "mills" / "mill_30cm" / "mill.yaml"
SLICE = 0.0558  # m, of 10^4 balls
COPIES = (1, 2, 10, 100)
RANKS = (1, 2)
LAYERS = 6  # voxels along a slice; 33 x 33 across
LIFTERS, RECORDS = 12, 312  # over which the slice turns before it is repeated, in so many records
WARM_UP = 20  # steps
WINDOW = 25  # records
# The extrapolation: balls, cores, and of their network bytes/s and s of a message
LARGE, CORES, BANDWIDTH, LATENCY = 1e7, 1000, 5e9, 2e-6
SUMS, FORCES = 8 * 8, 10 * 8  # bytes of a voxel that ranks add up (RecordSums) and that all get (BallFields)
RECORD = 54  # steps of the mill's own record interval
# Lines of millDem's deck
LEFT_OUT = r"run |fix fluid|fix averages|fix \w+Histogram|compute \w*[oO]verlap|print|create_box|reset_timestep|#"


class StandInFlow(threading.Thread):
    """The flow's side of the exchange in a folder: buoyancy and weak drag in all voxels, at first for `alone` steps of
    `step` s, then a meeting at every step, until the balls end."""
    HEADER = struct.Struct("=8s24sQQ")

    def __init__(self, folder, step, alone):
        super().__init__(daemon=True)
        self.folder, self.step, self.alone = folder, step, alone
        for name in ("to_balls", "to_flow"):
            os.mkfifo(folder / name)

    def run(self):
        version = subprocess.run(["millDem", "--version"], text=True, capture_output=True, check=True).stdout.split()[1]
        with open(self.folder / "to_balls", "wb") as out, open(self.folder / "to_flow", "rb") as back:
            self.send(out, b"flow", np.array([0.0, 0.0]), version.encode())
            forces = self.forces(self.receive(back))
            steps = self.alone + 1
            while self.receive(back) is not None:
                forces[0] = steps * self.step
                steps += 1
                try:
                    self.send(out, b"forces", forces)
                except BrokenPipeError:
                    return

    def send(self, out, kind, numbers, text=b""):
        out.write(self.HEADER.pack(b"millFoam", kind, len(text), len(numbers)) + text)
        out.write(memoryview(numbers).cast("B"))
        out.flush()

    def receive(self, back):
        """The numbers of the next message; None at the end."""
        header = back.read(self.HEADER.size)
        if len(header) < self.HEADER.size:
            return None
        _, _, text, numbers = self.HEADER.unpack(header)
        back.read(text)
        return np.frombuffer(back.read(8 * numbers))

    @staticmethod
    def forces(offer):
        """Time and fields of a message of forces, for the grid of the balls' offer: lower, upper, shape and periodic
        of each axis."""
        voxels = int(np.prod(offer[2:12:4]))
        inside, solidity = np.ones(voxels), np.full(voxels, 0.3)
        pressure = np.tile([0.0, 100.0, 0.0], voxels)  # N/m^3
        exchange, drag = np.full(voxels, 1e3), np.zeros(3 * voxels)  # kg/(m^3 s), N/m^3
        return np.concatenate([[0.0], inside, pressure, exchange, drag, solidity, np.full(voxels, 0.005)])


@dataclass
class Steps:
    """Of each part of a run."""
    dry: int
    windows: int
    forces: int
    meetings: int


@dataclass
class Result:
    """Of a run: wall times in s, of all balls and one step; memory in bytes, the peak of the first rank."""
    balls: int
    voxels: int
    ranks: int
    ghosts: float  # of a rank
    step: float  # of the dry run
    contacts: float  # part of it: pairs of balls
    lists: float  # of neighbours
    record: float  # of averages, with its share of writing a window of 25 records
    force: float  # of a flow, in a step
    meeting: float  # with the flow
    dry_memory: int
    memory: int  # with averages and meetings

    def core_time(self, wall):
        """Wall time of all ranks for each ball, µs."""
        return 1e6 * wall * self.ranks / self.balls


def run(folder, *command):
    log = folder / f"log.{command[0]}"
    with open(log, "w") as out:
        words = [str(word) for word in command]
        code = subprocess.run(words, cwd=folder, stdout=out, stderr=subprocess.STDOUT).returncode
    if code != 0:
        sys.exit(f"{command[0]} failed (exit code {code}); the last lines of {log}:\n" +
                 "\n".join(log.read_text().splitlines()[-10:]))


def settings(values):
    return [word for key, value in values.items() for word in ("--set", f"{key}={value}")]


def settle(folder):
    """The balls of a slice that turns: [n][x y z vx vy vz wx wy wz], in SI units, in order along the axis."""
    of_slice = {"geometry.slice": SLICE, "averages.start": 0}
    run(folder, "millMesh", MILL, "--case", ".", "--walls", *settings(of_slice))
    derived = json.loads((folder / "mill.json").read_text())["derived"]
    duration = LIFTERS * derived["speed"]["turn_s"] / derived["geometry"]["lifters"]["count"]
    turning = {"dem.settle_time": 0.2, "dem.duration": duration, "dem.record_interval": duration / RECORDS,
               "dem.contact_interval": duration, "averages.window": duration, "averages.live": "yes", "dem.dumps": "no"}
    run(folder, "millDem", MILL, "--case", ".", "-np", max(RANKS), *settings({**of_slice, **turning}))
    dumps = (folder / "contacts").glob("balls.*.txt")
    last = max(dumps, key=lambda path: int(path.name.split(".")[1]))
    # id type x y z vx vy vz omegax omegay omegaz radius
    balls = np.loadtxt(last, skiprows=9)[:, 2:11]
    balls[:, 2] %= SLICE
    return balls[np.argsort(balls[:, 2])]


def write_balls(path, balls, copies, mill):
    """A data file of LIGGGHTS with `copies` of the slice in a row."""
    count, half = len(balls), 1.04 * mill["geometry"]["radius_m"]
    size, density = mill["charge"]["largest_diameter_m"], mill["materials"]["ball"]["density_kg_m3"]
    across = f"{-half:.15g} {half:.15g}"
    with open(path, "w") as out:
        out.write(f"balls of {copies} slices\n\n{count * copies} atoms\n2 atom types\n\n{across} xlo xhi\n"
                  f"{across} ylo yhi\n0 {copies * SLICE:.15g} zlo zhi\n\nAtoms\n\n")
        for copy in range(copies):
            ids = np.arange(1, count + 1) + copy * count
            place = balls[:, :3] + [0, 0, copy * SLICE]
            np.savetxt(out, np.column_stack([ids, place]), f"%d 1 {size:.15g} {density:.15g} %.12g %.12g %.12g")
        out.write("\nVelocities\n\n")
        for copy in range(copies):
            ids = np.arange(1, count + 1) + copy * count
            np.savetxt(out, np.column_stack([ids, balls[:, 3:]]), "%d" + 6 * " %.9g")


def make_case(folder, balls, copies):
    """Walls and balls of a longer slice."""
    folder.mkdir()
    run(folder, "millMesh", MILL, "--case", ".", "--walls", *settings(sizes(copies)))
    (folder / "exchange").mkdir()
    write_balls(folder / "balls.data", balls, copies, json.loads((folder / "mill.json").read_text())["derived"])


def sizes(copies):
    """The mill's keys for a slice of this length, which must be shorter than the mill."""
    return {"geometry.length": max(0.305, 2 * copies * SLICE), "geometry.slice": copies * SLICE, "averages.start": 0,
            "averages.counts.along": LAYERS * copies, "averages.live": "yes", "dem.dumps": "no"}


def steps_of(balls):
    """So many that a part of a run takes seconds."""
    many = int(np.clip(2e5 / balls, 1, 8))
    return Steps(int(np.clip(5e7 / balls, 120, 1000)), many, 25 * many, 12 * many)


def scale_deck(text, steps):
    """millDem's deck with balls that are read instead of inserted, and the parts of the run instead of its end. The
    histograms of the overlaps are left out: they belong to every tenth record."""
    lines, inserting = [], False
    for line in text.splitlines():
        inserting = (inserting or line.startswith("variable balls")) and line != "reset_timestep 0"
        if inserting or re.match(LEFT_OUT, line):
            continue
        line = "read_data ../balls.data" if line.startswith("region box") else line.replace(" c_overlap", "")
        lines += [line] if line else []
    memory = 'shell "grep VmHWM /proc/$PPID/status >> memory.txt"'
    external = "all external pf/callback 1 1"
    lines += ["fix motion all nve/sphere", f"run {WARM_UP}", f"run {steps.dry}", memory,
              f"fix averages {external}", f"run {steps.windows * WINDOW}", memory, "unfix averages",
              f"fix fluid {external}", f"run {steps.forces}", f"run {steps.meetings}", memory]
    return "\n".join(lines) + "\n"


def set_orders(dem, balls, steps):
    """Lets the averages begin after the dry part, with a record at each step, and the meetings after the averages.
    Returns the time-step, s."""
    averages, fluid = (json.loads((dem / name).read_text()) for name in ("averages.json", "fluid.json"))
    begin, step = WARM_UP + steps.dry, averages["timestep_s"]
    averages.update(begin=begin, interval=1, balls=balls)
    averages["averages"][0].update(start_s=begin * step, windows_s=[WINDOW * step])
    fluid["exchange"]["begin"] = begin + steps.windows * WINDOW
    (dem / "averages.json").write_text(json.dumps(averages))
    (dem / "fluid.json").write_text(json.dumps(fluid))
    return step


def run_balls(case, balls, copies, ranks):
    """Runs all parts; returns their Result."""
    for name in ("dem", "exchange"):
        shutil.rmtree(case / name, ignore_errors=True)
    record = json.loads((case / "mill.json").read_text())["mill"]["dem"]["record_interval"]
    run(case, "millDem", MILL, "--case", ".", "--deck-only", "--with-flow", "exchange", "-np", ranks,
        *settings({**sizes(copies), "flow.write_interval": record}))
    dem, steps = case / "dem", steps_of(balls)
    (dem / "in.scale").write_text(scale_deck((dem / "in.mill").read_text(), steps))
    step = set_orders(dem, balls, steps)
    (case / "exchange").mkdir(exist_ok=True)
    StandInFlow(case / "exchange", step, steps.forces).start()
    launcher = ("mpirun", "--oversubscribe", "--bind-to", "none", "-np", ranks) if ranks > 1 else ()
    os.environ["OMPI_MCA_mpi_yield_when_idle"] = "1"  # as millDem does
    run(dem, *launcher, "millLiggghts", "-in", "in.scale", "-log", "log.liggghts")
    return read_result(dem, balls, copies * LAYERS * 33 * 33, ranks)


def read_result(dem, balls, voxels, ranks):
    """From LIGGGHTS' times of each part and the peaks of memory after them."""
    log, parts = (dem / "log.liggghts").read_text(), []
    for text in log.split("Loop time of ")[1:]:
        found = dict(re.findall(r"^(Pair|Neigh|Outpt)\s+time \(%\) = (\S+)", text, re.M))
        length = int(re.search(r"for (\d+) steps", text).group(1))
        loop, pair, lists, output = (float(word) / length for word in
                                     (text.split()[0], found["Pair"], found["Neigh"], found["Outpt"]))
        # Lists of neighbours are made at some steps only: a difference without them has less noise
        parts.append((loop, pair, lists, loop - pair - lists - output))
    _, dry, averages, forces, meetings = parts
    ghosts = float(re.findall(r"^Nghost:\s+(\S+) ave", log, re.M)[1])
    peaks = [1024 * int(number) for number in re.findall(r"VmHWM:\s+(\d+) kB", (dem / "memory.txt").read_text())]
    return Result(balls, voxels, ranks, ghosts, *dry[:3], averages[3] - dry[3], forces[3] - dry[3],
                  meetings[3] - forces[3], peaks[0], peaks[-1])


def table(results):
    """Times in µs of each ball and core; rate in million ball-steps per second and core; memory in MB."""
    head = ("balls", "ranks", "rate", "step", "contacts", "lists", "record", "force", "meeting", "ghosts", "MB dry",
            "MB all")
    lines = [f"| {' | '.join(head)} |", "|" + "---|" * len(head)]
    for r in results:
        times = (r.step, r.contacts, r.lists, r.record, r.force, r.meeting)
        cells = [r.balls, r.ranks, f"{1 / r.core_time(r.step):.2f}", *(f"{r.core_time(time):.3f}" for time in times),
                 f"{r.ghosts:.0f}", f"{r.dry_memory / 1e6:.0f}", f"{r.memory / 1e6:.0f}"]
        lines.append(f"| {' | '.join(str(cell) for cell in cells)} |")
    return lines


def at_large(one, two, part, message):
    """Wall times, s, of LARGE balls on CORES ranks: what ranks do for their own balls, what the first rank does for all
    voxels, and messages by a tree. `part` is a wall time of the same balls on one rank and on two, `message` the bytes
    of a voxel that pass each stage of the tree."""
    alone, both = getattr(one, part), getattr(two, part)
    own, first = 2 * (alone - both), 2 * both - alone
    scale = LARGE / one.balls
    return own * scale / CORES, first * scale, np.ceil(np.log2(CORES)) * message * one.voxels * scale / BANDWIDTH


def extrapolated(results):
    """A table for LARGE balls on CORES ranks. The rank of two that has about as many balls gives step and ghosts."""
    rank = LARGE / CORES
    near = min((r for r in results if r.ranks == 2), key=lambda r: abs(r.balls / 2 - rank))
    one, two = sorted((r for r in results if r.balls == max(r.balls for r in results)), key=lambda r: r.ranks)
    times = {"step": (near.step * rank / (near.balls / 2), 0, 2 * np.ceil(np.log2(CORES)) * LATENCY),
             "record": at_large(one, two, "record", SUMS), "meeting": at_large(one, two, "meeting", SUMS + FORCES)}
    lines = ["| ms of wall time | own balls | first rank | messages | together |", "|---|---|---|---|---|"]
    for name, parts in times.items():
        lines.append(f"| {name} | " + " | ".join(f"{1e3 * time:.3g}" for time in (*parts, sum(parts))) + " |")
    more = sum(times["record"]) / (RECORD * sum(times["step"]))
    memory = near.dry_memory + (two.memory - two.dry_memory) * LARGE / two.balls
    return [*lines, "", f"{LARGE * one.voxels / one.balls:.3g} voxels. A rank has {near.ghosts / (near.balls / 2):.2f} "
            f"ghosts for each ball. A record every {RECORD} steps takes {100 * more:.0f} % more time. Memory: "
            f"{near.dry_memory / 1e6:.0f} MB of each rank dry, {memory / 1e9:.1f} GB of the first one with averages."]


def scale_lines(copies=COPIES):
    """The table, a row for each number of balls and ranks, and the extrapolation."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "slice").mkdir()
        balls, results = settle(folder / "slice"), []
        for number in copies:
            case = folder / f"copies_{number}"
            make_case(case, balls, number)
            for ranks in RANKS:
                results.append(run_balls(case, len(balls) * number, number, ranks))
                print(results[-1], file=sys.stderr)
            shutil.rmtree(case)
    return [*table(results), "", *extrapolated(results)]


if __name__ == "__main__":
    print(*scale_lines(tuple(int(word) for word in sys.argv[1:]) or COPIES), sep="\n")
