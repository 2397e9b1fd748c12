# SPDX-License-Identifier: GPL-3.0-or-later
"""Sections of the report that compare a simulated charge with a measurement: a map of a CSV, or tracks of tracers."""
from collections.abc import Sequence
from pathlib import Path

import h5py
import numpy as np

from ..files.measured_map import read_measured
from ..files.mill_case import MillCase
from ..files.solids_file import SolidsMap
from ..files.tracks import Trajectory, read_trajectory
from ..readings import compare, tracer
from ..readings.free_surface import free_surface
from . import maps, page
from .page import Section

MOST_OUTSIDE = 0.5  # of a track's time outside the voxels; above this it has other units or another origin
ABOUT = ("Solidity: mean |difference| over 0.634. Velocities: mean |difference|, weighted by the solidity, over the "
         "mean of both largest speeds.")


def measured_section(case: MillCase, path: Path) -> Section:
    """(id, heading, cards) of a case's charge compared with the measured map of a CSV; RuntimeError names what is
    wrong in it."""
    if not case.solids:
        raise RuntimeError(f"{case.folder}: no solids.h5 to compare {path} with")
    try:
        measured = read_measured(path, case.charge)
    except ValueError as error:  # also of a binary file
        words = str(error)
        raise RuntimeError(words if words.startswith(str(path)) else f"{path}: {words}") from None
    return "measured", "Comparison with the measurement", cards(case, measured, f"Measured: {path.name}", "measurement")


def tracer_section(case: MillCase, paths: Sequence[Path]) -> Section:
    """(id, heading, cards) of a case's charge compared with that of tracers' tracks; RuntimeError names what is wrong
    in them."""
    if not case.solids:
        raise RuntimeError(f"{case.folder}: no solids.h5 to compare {paths[0]} with")
    tracks = [read_track(path) for path in paths]
    edges, inside, periodic, volume = charge_voxels(case)
    for path, track in zip(paths, tracks):
        refuse_outside(path, track, edges, periodic)
    found = tracer.tracer_map(tracks, edges, volume, inside, periodic=periodic, sense=case.charge.sense)
    length = sum(track.time[-1] - track.time[0] for track in tracks)
    names = ", ".join(path.name for path in paths)
    rows = [("tracks", f"{len(tracks)}, {length:.4g} s in total"),
            ("share of their time outside the voxels", f"{100 * found.outside:.2g} %"),
            ("volume of the charge", f"{1e6 * volume:.4g} ml")]
    return "tracers", "Comparison with tracers", cards(case, found, f"Tracers: {names}", "tracers") + [
        page.table(None, rows, title="Tracks",
                   note="Solidity of a voxel: the share of the tracers' time in it, times the charge's volume by the "
                        "ledger, over the voxel's volume. This holds if the charge is steady and mixes.")]


def read_track(path: Path) -> Trajectory:
    """A track with enough points for a velocity; RuntimeError names file, line and value."""
    try:
        track = read_trajectory(path)
    except UnicodeDecodeError:
        raise RuntimeError(f"{path}: not a text file; expected lines of t, x, y, z") from None
    if len(track.time) < 3:
        raise RuntimeError(f"{path}: {len(track.time)} points, expected 3 or more")
    return track


def refuse_outside(path: Path | str, track: Trajectory, edges: Sequence[np.ndarray], periodic: bool) -> None:
    """RuntimeError if more than half of a track's time is outside the voxels; it names the file and both extents."""
    _, _, outside = tracer.residence(track, edges, np.zeros_like(track.position), periodic)
    share = outside / (track.time[-1] - track.time[0])
    if share > MOST_OUTSIDE:
        voxels = np.array([(planes[0], planes[-1]) for planes in edges])
        raise RuntimeError(f"{path}: {100 * share:.0f} % of its time is outside the voxels: the track covers "
                           f"{extent(np.transpose([track.position.min(axis=0), track.position.max(axis=0)]))}, the "
                           f"voxels {extent(voxels)} m; expected t in s, x, y and z in m, x and y from the mill's axis")


def extent(ends: np.ndarray) -> str:
    """Range of x, y and z in words, of [3, 2]."""
    return ", ".join(f"{axis} = {low:.3g} to {high:.3g}" for axis, (low, high) in zip("xyz", ends))


def charge_voxels(case: MillCase) -> tuple[list[np.ndarray], np.ndarray | None, bool, float]:
    """Voxels of solids.h5: their edges x, y, z (m), their share within the mill [nz, ny, nx] in the mean over time,
    whether they repeat along z, and the balls' volume by the ledger (m3)."""
    with h5py.File(case.solids) as file:
        grid = file["grid"]
        lower, upper, shape = (np.asarray(grid.attrs[name]) for name in ("lower", "upper", "shape"))
        begin, end = case.charge_span
        chosen = np.flatnonzero((file["window/end"][:] > begin) & (file["window/begin"][:] < end))
        inside = sum(grid["insideFraction"][window]
                     for window in chosen) / len(chosen) if "insideFraction" in grid else None
        volume = float(file["ledger/volume_in"][chosen].mean())
        periodic = bool(np.asarray(grid.attrs.get("periodic", (0, 0, 0)))[2])
    return [np.linspace(lower[k], upper[k], int(shape[k]) + 1) for k in range(3)], inside, periodic, volume


def cards(case: MillCase, other: SolidsMap, title: str, name: str) -> list[str]:
    """Maps of both, their differences, the histogram and the numbers."""
    apart = compare.difference_maps(case.charge, other)
    return [page.picture(maps.solidity_figure(case, case.charge), "Solidity averaged over axis and time.",
                         title="Simulated"),
            page.picture(maps.solidity_figure(case, other), "Solidity on the simulation's voxels; white: not known.",
                         title=title),
            page.picture(maps.difference_figure(case, apart.x, apart.y, apart.solidity, "difference of solidity, –",
                                                0.05),
                         f"Simulation minus {name}. Red: the simulation is denser.", title="Difference of solidity"),
            page.picture(maps.histogram_figure(apart.shares, apart.edges),
                         f"Share of the mill's inside by its difference, simulation minus {name}.",
                         title="Histogram"),
            *velocity_cards(case, apart, name),
            page.table(None, difference_rows(case, other, apart), title="Numbers", note=ABOUT)]


def velocity_cards(case: MillCase, apart: compare.DifferenceMaps, name: str) -> list[str]:
    """Differences of velocity, if the other map has any."""
    return [page.picture(maps.difference_figure(case, apart.x, apart.y, values, f"difference of the velocity's {axis}, "
                                                                                f"m/s"),
                         f"Simulation minus {name}, where both have balls.", title=f"Difference of velocity, {axis}")
            for axis, values in (("x", apart.velocity_x), ("y", apart.velocity_y)) if np.isfinite(values).any()]


def difference_rows(case: MillCase, other: SolidsMap, apart: compare.DifferenceMaps) -> list[tuple[str, str]]:
    """Rows (name, text) of compare's numbers; "not known" for what the other map does not have."""
    found = compare.difference(case.charge, other)
    known = np.isfinite(found.velocity_x)
    rows = [("solidity", f"{100 * found.solidity:.3g} %")]
    rows += [(f"velocity, {axis}", f"{100 * value:.3g} %" if known else "not known")
             for axis, value in (("x", found.velocity_x), ("y", found.velocity_y))]
    far = np.abs((apart.edges[1:] + apart.edges[:-1]) / 2) > 0.1
    rows += [("share of the inside with a difference of solidity over 0.1", f"{100 * apart.shares[far].sum():.3g} %"),
             ("voxels in the mill that are not known", str(found.missing))]
    try:
        ours, theirs = (free_surface(one, case.radius) for one in (case.charge, other))
        surface = compare.surface_difference(ours, theirs)
        return rows + [("height of the free surface, simulation minus the other",
                        f"{1e3 * surface.mean:+.2g} mm, standard deviation {1e3 * surface.deviation:.2g} mm")]
    except (RuntimeError, ValueError) as error:
        return rows + [("free surface", str(error))]
