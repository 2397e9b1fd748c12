#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the benchmarks of averaging, meshing, the flow and the balls and writes what they say as a table
(results/benchmarks.md) and a plot (results/location.png) in the folder above the benchmark programs. Figures are
medians over repetitions; flow and scale run once.

    run_benchmarks.py [PART...]

Parts are overlap mesh assembly dumps location cores memory flow scale; all unless given.
"""
import json
import os
import shutil
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import matplotlib
import matplotlib.pyplot as plt
import numpy as np

from flow_benchmark import flow_lines
from scale_benchmark import scale_lines

matplotlib.use("Agg")

ROOT = Path(__file__).resolve().parents[2]
MILL = ROOT / "cases" / "mills" / "mill_12cm" / "mill.yaml"
TEMPLATE = ROOT / "scripts" / "mill_case"
REPETITIONS = 5


def run_google(program, results):
    """{name: [items or bytes per second, one for each repetition]} of a Google Benchmark program."""
    out = results / f"{program}.json"
    subprocess.run([program, f"--benchmark_out={out}", f"--benchmark_repetitions={REPETITIONS}",
                    "--benchmark_enable_random_interleaving=true"], check=True)
    rates = {}
    for row in json.loads(out.read_text())["benchmarks"]:
        if row["run_type"] == "iteration":
            # What counts no items is one item a time.
            once = 1 / (row["real_time"] * {"ns": 1e-9, "us": 1e-6, "ms": 1e-3, "s": 1}[row["time_unit"]])
            rate = row.get("items_per_second", row.get("bytes_per_second", once))
            rates.setdefault(row["run_name"], []).append((rate, row))
    return rates


def google_table(rates, unit):
    lines = [f"| benchmark | {unit} | range |", "|---|---|---|"]
    for name, rows in sorted(rates.items()):
        values = [rate for rate, _ in rows]
        lines.append(f"| {name} | {statistics.median(values):.3g} | {min(values):.3g} to {max(values):.3g} |")
    return lines


def plot_location(rates, path):
    """Cost of a point against the number of cells."""
    figure, axes = plt.subplots(figsize=(6.4, 4.2))
    for series, label, mark in (("rigid_coherent_points", "rigid mesh, coherent points", "o-"),
                                ("rigid_random_points", "rigid mesh, random points", "o--"),
                                ("deforming_coherent_points", "deforming mesh, coherent points, tree included", "s-"),
                                ("deforming_random_points", "deforming mesh, random points, tree included", "s--")):
        points = sorted((rows[0][1]["cells"], 1e9 / statistics.median(rate for rate, _ in rows))
                        for name, rows in rates.items() if name.startswith(series + "/"))
        axes.loglog(*zip(*points), mark, label=label)
    axes.set_xlabel("cells of the mesh")
    axes.set_ylabel("time per point, ns")
    axes.set_title("Finding the cell of a point, one core")
    axes.grid(True, which="both", alpha=0.3)
    axes.set_ylim(10, 3e4)
    axes.legend(loc="upper left", fontsize="small")
    figure.tight_layout()
    figure.savefig(path, dpi=110)


def location(results):
    """OpenFOAM's and, where it was built, VTK's point location on the mill's own mesh."""
    lines = []
    with tempfile.TemporaryDirectory() as folder:
        case = Path(folder)
        for part in ("system", "constant"):
            shutil.copytree(TEMPLATE / part, case / part)
        subprocess.run(["millMesh", MILL, "--case", case], check=True, stdout=subprocess.DEVNULL)
        subprocess.run(["foamMeshToH5", "-case", case], check=True, stdout=subprocess.DEVNULL)
        programs = [["openfoam_location_benchmark", "-case", case]]
        if shutil.which("vtk_location_benchmark"):
            programs.append(["vtk_location_benchmark", case / "mesh.h5"])
        for program in programs:
            text = subprocess.run(program, check=True, text=True, capture_output=True).stdout
            lines += ["```", *text[text.find("CellLocator"):].splitlines(), "```"]
    return lines


def write_dumps(folder, records, balls):
    """A turning charge: `balls` in a half full drum of 60 mm x 24 mm, at 1 kHz."""
    random = np.random.default_rng(1)
    radius, angle = 0.056 * np.sqrt(random.uniform(0, 1, balls)), random.uniform(np.pi, 2 * np.pi, balls)
    z, size = random.uniform(0, 0.024, balls), random.uniform(0.001, 0.004, balls)
    for record in range(records):
        turned = angle - 6.4e-3 * record
        x, y = radius * np.cos(turned), radius * np.sin(turned)
        rows = np.column_stack([x, y, z, 6.4 * y, -6.4 * x, 0 * x, size])
        with open(folder / f"dump.{100 * record}.txt", "w") as out:
            out.write(f"ITEM: TIMESTEP\n{100 * record}\nITEM: NUMBER OF ATOMS\n{balls}\nITEM: BOX BOUNDS ff ff pp\n"
                      "-0.06 0.06\n-0.06 0.06\n0 0.024\nITEM: ATOMS id type x y z vx vy vz radius \n")
            for number, row in enumerate(rows):
                out.write(f"{number + 1} 1 " + " ".join(f"{value:.6g}" for value in row) + " \n")
    (folder / "run.json").write_text('{"timestep_s": 1e-5, "interval": 100, "angular_velocity_rad_s": -6.4}')


def repeat_dumps(folder, there, wanted):
    """The same records again at later time-steps."""
    for record in range(there, wanted):
        text = (folder / f"dump.{100 * (record % there)}.txt").read_text()
        begin = text.index("\n") + 1
        later = f"{text[:begin]}{100 * record}{text[text.index(chr(10), begin):]}"
        (folder / f"dump.{100 * record}.txt").write_text(later)


def timed(command, folder):
    """Wall time, s, and peak resident memory, kB, of a command."""
    begin = time.monotonic()
    process = subprocess.Popen([str(word) for word in command], cwd=folder, stdout=subprocess.DEVNULL,
                               stderr=subprocess.DEVNULL)
    _, status, usage = os.wait4(process.pid, 0)
    if status != 0:
        raise RuntimeError(f"{command} failed")
    return time.monotonic() - begin, usage.ru_maxrss


def average(folder, *options, dumps="dump.*.txt"):
    return ["millAverage", "--dumps", f"{folder}/{dumps}", "--box", "-0.066", "-0.066", "0", "0.066", "0.066", "0.024",
            "--shape", "33", "33", "8", "--periodic", "z", "--window", "0.02", "-o", "out.h5", *options]


def cores(results):
    """One and two threads, one and two ranks: interleaved runs, medians, and whether the files agree."""
    mpirun = ("mpirun", "--oversubscribe", "--bind-to", "none", "-np")
    variants = {"1 thread": ((), "1"), "2 threads": ((), "2"), "1 rank": ((*mpirun, "1"), "1"),
                "2 ranks": ((*mpirun, "2"), "1")}
    times, files = {name: [] for name in variants}, set()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        write_dumps(folder, 100, 20000)
        repeat_dumps(folder, 100, 600)
        for _ in range(3):
            for variant, (launcher, threads) in variants.items():
                times[variant].append(timed([*launcher, *average(folder, "--threads", threads)], folder)[0])
                files.add((folder / "out.h5").read_bytes())
    median = {variant: statistics.median(values) for variant, values in times.items()}
    lines = ["| 600 dumps of 20 000 balls, 33 x 33 x 8 voxels | time, s | times faster |", "|---|---|---|"]
    for variant, values in times.items():
        base = median["1 rank" if "rank" in variant else "1 thread"]
        lines.append(f"| {variant} | {median[variant]:.2f} ({min(values):.2f} to {max(values):.2f}) | "
                     f"{base / median[variant]:.2f} |")
    return [*lines, "", f"{len(files)} different file(s) written."]


def memory(results):
    """Peak memory for 100 and for 1000 dumps."""
    lines = ["| dumps of 20 000 balls, 33 x 33 x 8 voxels, 2 threads | peak, MB |", "|---|---|"]
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        write_dumps(folder, 100, 20000)
        lines.append(f"| 100 | {timed(average(folder, '--threads', '2'), folder)[1] / 1024:.1f} |")
        repeat_dumps(folder, 100, 1000)
        lines.append(f"| 1000 | {timed(average(folder, '--threads', '2'), folder)[1] / 1024:.1f} |")
    return lines


def overlap(results):
    return google_table(run_google("overlap_benchmark", results), "spheres or points/s")


def mesh(results):
    rates = run_google("mesh_benchmark", results)
    plot_location(rates, results / "location.png")
    return google_table(rates, "points or spheres/s")


def assembly(results):
    return google_table(run_google("assembly_benchmark", results), "faces or meshes/s")


def dumps(results):
    return google_table(run_google("dump_benchmark", results), "bytes/s")


def flow(results):
    return flow_lines()


def scale(results):
    return scale_lines()


PARTS = {part.__name__: part for part in (overlap, mesh, assembly, dumps, location, cores, memory, flow, scale)}


def main(names):
    unknown = [name for name in names if name not in PARTS]
    if unknown:
        sys.exit(f"run_benchmarks: '{unknown[0]}' is not a part; expected some of {', '.join(PARTS)}")
    program = shutil.which("overlap_benchmark") or sys.exit("run_benchmarks: no benchmark programs on the PATH")
    results = Path(program).parents[1] / "results"
    results.mkdir(exist_ok=True)
    for name in names or PARTS:
        lines = PARTS[name](results)
        (results / f"{name}.md").write_text("\n".join(lines) + "\n")
        print(f"\n## {name}\n", *lines, sep="\n")
    together = "\n".join(f"## {name}\n\n{(results / f'{name}.md').read_text()}"
                         for name in PARTS if (results / f"{name}.md").exists())
    (results / "benchmarks.md").write_text(together)
    print(f"\n{results / 'benchmarks.md'}")


if __name__ == "__main__":
    main(sys.argv[1:])
