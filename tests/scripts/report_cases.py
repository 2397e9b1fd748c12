# SPDX-License-Identifier: GPL-3.0-or-later
"""Folders of small mill cases for tests of the report: a dry run, and a flow through its charge, written by hand."""
import json
import sys
from pathlib import Path

import h5py
import numpy as np

from charge_test import RADIUS, below, charge_map, turning
from millfoam.files.mill import fnv1a

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "integration"))
import mesh as hexahedra  # noqa: E402

LENGTH, OMEGA, DIAMETER = 0.06, -6.0, 0.005
TIME0, WINDOW, WINDOWS = 1.0, 0.1, 10
DURATION = 0.8
PRINTS = {"walls": "0" * 15 + "1", "charge": "0" * 15 + "2", "averages": "0" * 15 + "3", "flow": "0" * 15 + "4"}
MILL = """title: {title}
geometry: {{diameter: 0.3, length: 0.06, ends: plain, lifters: {{count: 8, height: 0.01}}}}
"""
RESULTS = {"balls": 1000, "lost_balls": 0, "steady": True, "steady_from_s": 1.0, "power_from_s": 0.4,
           "power_W": 3.21,
           "power_error_W": 0.0123,
           "ball_overlap_largest_m": 2e-4, "ball_overlap_99_m": 5e-5, "allowed_overlap": 0.15,
           "smallest_diameter_m": 0.005, "wall_time_s": 60.0, "liggghts": "Version 3.8"}
LIMITS = {"maxCo": 0.5, "maxAlphaCo": 0.5, "maxAirCo": 3, "maxVoidageChange": 0.1, "maxDeltaT_s": 0.01}
STEPS = ("time_s", "deltaT_s", "courant", "courant_surface", "courant_air", "voidage_change", "slurry_m3",
         "volume_correction", "beyond_law")
BALANCE = ("Time_s", "holdUp_m3", "feed_m3/s", "discharge_m3/s", "fed_m3", "discharged_m3", "missing_m3", "x_m",
           "y_m", "z_m",
           "torque_shell_Nm", "torque_lifters_Nm", "torque_all_Nm", "power_shell_W", "power_lifters_W", "power_W",
           "Re_mean",
           "Re_95", "slip_max_m/s")
HEAD = "FoamFile {{ version 2.0; format ascii; class {}; object {}; }}\n"


def write_json(path, kind, parts=(), **values):
    """A result millfoam-`kind` that names the fingerprints of these parts of the mill."""
    head = {"format": f"millfoam-{kind}", "program": f"{kind}Tool 1.2.3",
            "mill": {part: PRINTS[part] for part in parts}}
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(json.dumps({**head, **values}, indent=2) + "\n")


def write_mill(folder, title="A mill", diameter=2 * RADIUS, **derived):
    """mill.yaml and the resolved mill.json of 8 lifters and balls of one size; derived: sections to change entries
    of."""
    folder.mkdir(parents=True, exist_ok=True)
    text = MILL.format(title=title)
    (folder / "mill.yaml").write_text(text)
    numbers = {
        "geometry": {"radius_m": diameter / 2, "length_m": LENGTH, "whole_length_m": LENGTH, "is_slice": False,
                     "ends": "plain",
                     "lifters": {"count": 8, "height_m": 0.01, "width_m": 0.01, "top_width_m": 0.01}, "inlet": None,
                     "grates": None, "pulp_lifters": None},
        "speed": {"angular_velocity_rad_s": OMEGA, "sense": "clockwise", "critical_speed_rad_s": 8.09,
                  "fraction_of_critical": -OMEGA / 8.09, "turn_s": -2 * np.pi / OMEGA},
        "charge": {"balls": 1000, "mass_kg": 2.0, "volume_m3": 8e-4, "load": 0.3, "load_asked": 0.3,
                   "resting_solidity": 0.6, "pore_volume_m3": 8e-4 * 0.4 / 0.6, "fines_mass_kg": 0.0,
                   "fines_share": 0.0, "sauter_diameter_m": DIAMETER, "smallest_diameter_m": DIAMETER,
                   "largest_diameter_m": DIAMETER,
                   "classes": [{"diameter_m": DIAMETER, "count": 1000, "mass_asked_kg": 2.0, "mass_kg": 2.0,
                                "simulated": True}]},
        "materials": {"ball": {"density_kg_m3": 2500.0}},
        "slurry": {"density_kg_m3": 1500.0, "plastic_viscosity_Pa_s": 0.01, "yield_stress_Pa": 1.0},
        "flow": {"duration_s": DURATION, "law": "Beetstra", "averages_start_s": DURATION / 2, "feed_m3_s": 0.0}}
    for section, entries in derived.items():
        numbers[section] |= entries
    mill = {"title": title, "geometry": {"diameter": diameter, "length": LENGTH, "ends": "plain"},
            "speed": {"angular_velocity": abs(OMEGA)}, "charge": {"fill": 0.3, "diameter": DIAMETER},
            "slurry": {"density": 1500}}
    content = {"format": "millfoam-mill", "version": 1, "program": "millMesh 1.2.3", "file": "mill.yaml",
               "file_fingerprint": fnv1a(text.encode()), "set": ["flow.law=Beetstra"], "fingerprint": PRINTS,
               "mill": mill,
               "derived": numbers}
    (folder / "mill.json").write_text(json.dumps(content, indent=2) + "\n")


def change_json(path, *keys, to):
    """Changes the entry [key][key]… of a JSON file."""
    content = json.loads(path.read_text())
    inner = content
    for key in keys[:-1]:
        inner = inner[key]
    inner[keys[-1]] = to
    path.write_text(json.dumps(content))


def write_dry(folder, title="A dry mill", **changed):
    """A dry run that was averaged: mill.json, dumps/, solids.h5; changed: values of results.json."""
    write_mill(folder, title)
    write_json(folder / "dumps" / "results.json", "charge", ("charge",), **{**RESULTS, **changed})
    write_json(folder / "dumps" / "run.json", "dumps", ("charge",), timestep_s=1e-5, interval=200,
               angular_velocity_rad_s=OMEGA)
    time = np.arange(1, 501) * 0.004
    power = 3.2 + np.sin(40 * time)
    rows = np.column_stack([time, power / OMEGA, power, 0.1 + 0 * time, 0.01 * time])
    np.savetxt(folder / "dumps" / "energy.csv", rows, "%.6g", ",", comments="",
               header="time_s,torque_Nm,power_W,kinetic_J,potential_J")
    overlap = np.arange(40) * 5e-6 + 2.5e-6
    counts = np.column_stack([overlap, 1e6 * np.exp(-overlap / 2e-5), 1e5 + 0 * overlap])
    np.savetxt(folder / "dumps" / "overlaps.csv", counts, "%.6g", ",", comments="",
               header="overlap_m,ball_contacts,wall_contacts")
    write_solids(folder / "solids.h5")
    return folder


def write_solids(path, complete=1):
    """Windows of a charge under a slope, with noise, of which the first one begins at TIME0."""
    mean = charge_map(below(lambda x: -0.02 - 0.5 * x), turning(5, (-0.03, -0.06)), voxels=33)
    noise = np.random.default_rng(1).normal(1, 0.02, (WINDOWS, 2, *mean.solidity.shape))
    with h5py.File(path, "w") as file:
        file.attrs.update(complete=complete, timestep=1e-5, time0=TIME0, angular_velocity=OMEGA,
                          program="millAverage 1.2.3",
                          mill_charge=PRINTS["charge"], mill_averages=PRINTS["averages"])
        file.create_group("grid").attrs.update(lower=[-RADIUS, -RADIUS, 0], upper=[RADIUS, RADIUS, LENGTH],
                                               shape=[33, 33, 2],
                                               periodic=[0, 0, 0], kind="box")
        file["grid/insideFraction"] = np.broadcast_to(mean.inside, noise.shape)
        begins = TIME0 + WINDOW * np.arange(WINDOWS)
        for name, values in (("begin", begins), ("end", begins + WINDOW), ("records", np.full(WINDOWS, 50)),
                             ("balls_per_cell", np.full(WINDOWS, 12.0))):
            file[f"window/{name}"] = values
        file["solidity"], file["solidity_deviation"] = mean.solidity * noise, 0.1 * mean.solidity * noise
        file["velocity"] = np.broadcast_to(np.nan_to_num(mean.velocity), (*noise.shape, 3)) * noise[..., None]
        voxel = (2 * RADIUS / 33) ** 2 * LENGTH / 2
        volume = np.sum(mean.balls() * noise * voxel, axis=(1, 2, 3))
        for name, values in (("volume_in", volume), ("deposited", volume), ("outside", 0 * volume),
                             ("clipped", 1e-4 * volume)):
            file[f"ledger/{name}"] = values
    write_json(path.with_suffix(".json"), "averages", ("charge", "averages"), balls_per_cell=12.0,
               balls_of_laws=[8, 64])


def write_flow(folder, title="A mill", tables=True, voxels=True):
    """A dry run and a flow of slurry at rest through it, of which tables and slurry.h5 were written if requested."""
    write_dry(folder, title)
    points = hexahedra.drum((10, 10, 4)) * (RADIUS, RADIUS, LENGTH)
    write_mesh(folder / "constant" / "polyMesh", points)
    properties = f"radius {RADIUS};\nlength {LENGTH};\nomega {OMEGA};\ntime0 {TIME0};\n"
    (folder / "constant" / "millProperties").write_text(HEAD.format("dictionary", "millProperties") + properties)
    (folder / "constant" / "bedProperties").write_text(HEAD.format("dictionary", "bedProperties"))
    middles = points[:-1, :-1, :-1] / 2 + points[1:, 1:, 1:] / 2
    for time in (0, 0.2, 0.4, 0.6, 0.8):
        write_time(folder, time, middles.reshape(-1, 3))
    write_steps(folder, 0, np.linspace(0.008, DURATION, 100))
    write_json(folder / "check.json", "check", ok=True)
    write_json(folder / "mesh.json", "mesh", ("flow",), cells=400, volume_m3=0.004, quality={
        "volume_error": {"value": 1e-4, "limit": 5e-3}, "non_orthogonality_deg": {"value": 25.3, "limit": 45.0}})
    if tables:
        write_tables(folder)
    if voxels:
        write_slurry(folder / "slurry.h5")
    return folder


def write_fluid_only(folder, **asked):
    """A flow as of write_flow, without balls."""
    write_flow(folder, **asked)
    for path in (folder / "solids.h5", folder / "constant" / "bedProperties", *(folder / "dumps").iterdir()):
        path.unlink()
    write_steps(folder, 0, np.linspace(0.008, DURATION, 100), law=None)
    return folder


def make_slice(folder):
    """Of a mill's case that was written one of a periodic slice."""
    change_json(folder / "mill.json", "derived", "geometry", "is_slice", to=True)
    return folder


def write_mesh(folder, points):
    """constant/polyMesh of a mesh of hexahedra (tests/integration/mesh.py), whose lower end is the feed's."""
    folder.mkdir(parents=True)
    hexahedra.write(folder / "mesh.h5", points)
    with h5py.File(folder / "mesh.h5") as file:
        corners, faces = file["points"][0], file["face_points"][:].reshape(-1, 4)
        owner, neighbour = file["owner"][:], file["neighbour"][:]
        first, sizes = file["patch/first"][:], file["patch/faces"][:]
    (folder / "mesh.h5").unlink()
    lists = {"points": [f"({x!r} {y!r} {z!r})" for x, y, z in corners.tolist()],
             "faces": ["4(" + " ".join(map(str, face)) + ")" for face in faces.tolist()],
             "owner": owner, "neighbour": neighbour}
    for name, rows in lists.items():
        text = "\n".join(map(str, rows))
        (folder / name).write_text(HEAD.format("list", name) + f"{len(rows)}\n(\n{text}\n)\n")
    names = ("west", "east", "south", "north", "feedEnd", "dischargeEnd")
    patches = "".join(f"{name} {{ type wall; nFaces {size}; startFace {start}; }}\n"
                      for name, start, size in zip(names, first, sizes))
    (folder / "boundary").write_text(HEAD.format("list", "boundary") + f"{len(names)}\n(\n{patches})\n")


def write_time(folder, time, places):
    """Fields of cells at places [cells, 3] of the mesh at flow time 0 (m): slurry below y = -0.05 m, however the mill
    has turned."""
    sine, cosine = np.sin(OMEGA * time), np.cos(OMEGA * time)
    x, y = cosine * places[:, 0] - sine * places[:, 1], sine * places[:, 0] + cosine * places[:, 1]
    wet = (y < -0.05).astype(float)
    fields = {"alpha.slurry": wet, "solidity": 0.5 * (y < -0.02 - 0.5 * x), "p_rgh": 100 - 1000 * places[:, 2],
              "forceOverWeight": 0.1 + 0 * wet, "U": np.column_stack([0.1 * wet, 0 * wet, np.where(x > 0, 0.02,
                                                                                                   -0.01) * wet])}
    if time == 0:  # written before the flow knows its balls
        del fields["solidity"], fields["forceOverWeight"]
    for name, values in fields.items():
        write_field(folder / f"{time:g}" / name, values)


def write_field(path, values):
    """A field of cells, [cells] or [cells, 3], in OpenFOAM's text."""
    kind = "vector" if values.ndim > 1 else "scalar"
    rows = "\n".join(f"({' '.join(f'{v:.9g}' for v in row)})" if values.ndim > 1 else f"{row:.9g}" for row in values)
    path.parent.mkdir(exist_ok=True)
    path.write_text(HEAD.format("volField", path.name) + f"internalField nonuniform List<{kind}>\n{len(values)}\n"
                    f"(\n{rows}\n)\n;\nboundaryField {{}}\n")


def write_tables(folder):
    """Tables of slurryBalance and axialProfiles of a steady flow."""
    time = np.linspace(0.01, 0.8, 80)
    noise = np.random.default_rng(2).normal(0, 1, time.shape)
    one = np.ones_like(time)
    columns = (time, 8e-4 + 1e-6 * noise, 2e-5 * one, 2e-5 + 1e-7 * noise, 0 * one, 0 * one, 1e-14 * one, 0.01
               + 1e-5 * noise,
               -0.09 + 1e-5 * noise, 0.03 * one, -0.01 * one, -0.07 * one, -0.08 * one, 0.06 * one, 0.42 * one,
               0.5 + 0.01 * noise, 40 * one, 90 * one, np.where(time > 0.6, 1.25, 0.5))
    write_table(folder, "slurryBalance", "slurryBalance", BALANCE, np.column_stack(columns))
    z = LENGTH * (np.arange(8) + 0.5) / 8
    for name, values in (("holdUp", 1e-4 + 0 * z), ("height", -0.09 + 0.02 * z), ("p_rgh", 100 - 1000 * z)):
        write_table(folder, "axialProfiles", name, ["Time_s, then slices at z_m", *map(str, z)],
                    np.column_stack([time, np.broadcast_to(values, (len(time), len(z)))]))


def write_steps(folder, start, times, law="Beetstra", **summary):
    """steps.csv and flow.json of a flow that began at `start` (s), with steps that end at these times (s)."""
    place = folder / "postProcessing" / "flow" / f"{start:g}"
    balls = {"solids": {"repeated": 0, "held_s": 0.0, "mill": {part: PRINTS[part] for part in ("charge", "averages")}},
             "drag": {"law": law, "reference": "a paper", "solidity_range": [0.0, 0.6], "reynolds_range": [0.2, None]},
             "beyond_law": {"mean": 0.1, "largest": 0.12, "solidity_above": 0.1}} if law else {"solids": None,
                                                                                               "drag": None}
    content = {"complete": True, "begin_s": start, "end_s": float(times[-1]), "limits": LIMITS,
               "openfoam": {"version": "v1912", "build": "abc-1"}, **balls, **summary}
    write_json(place / "flow.json", "flow", ("charge", "averages", "flow"), **content)
    one = np.ones(len(times))
    known = one if law else np.nan * one
    rows = np.column_stack([times, np.diff(times, prepend=start), 0.2 * one, 0.1 * one, 0.3 * one, 0.01 * one,
                            8e-4 * one, -1e-3 * known, 0.1 * known])
    np.savetxt(place / "steps.csv", rows, "%.9g", ",", header=",".join(STEPS), comments="")


def write_table(folder, name, file, head, rows):
    place = folder / "postProcessing" / name / "0"
    place.mkdir(parents=True, exist_ok=True)
    np.savetxt(place / f"{file}.dat", rows, "%.9g", "\t", header="\t".join(head), comments="# ")


def write_slurry(path, complete=1):
    """Windows of slurry below y = -0.05 m on voxels, at rest but for the axis."""
    edges = np.linspace(-RADIUS, RADIUS, 31)
    middles = (edges[1:] + edges[:-1]) / 2
    x, y = np.meshgrid(middles, middles)
    inside = np.broadcast_to((np.hypot(x, y) < RADIUS).astype(float), (8, 3, 30, 30))
    slurry = inside * (y < -0.05)
    with h5py.File(path, "w") as file:
        file.attrs.update(complete=complete, window=WINDOW, time0=TIME0, program="slurryFoam 1.2.3",
                          mill_flow=PRINTS["flow"])
        file.create_group("grid").attrs.update(lower=[-RADIUS, -RADIUS, 0], upper=[RADIUS, RADIUS, LENGTH],
                                               shape=[30, 30, 3])
        file["grid/insideFraction"], file["slurry"] = inside, slurry
        file["voidage"], file["pressure"] = inside, 100 * slurry
        file["velocity"] = slurry[..., None] * np.stack([0.1 + 0 * x, 0 * x, 0.02 * np.sign(x)], axis=-1)
        begins = TIME0 + WINDOW * np.arange(8)
        file["window/begin"], file["window/end"] = begins, begins + WINDOW
        file["ledger/volume_in"], file["ledger/outside"] = np.full(8, 8e-4), np.full(8, 1e-7)
