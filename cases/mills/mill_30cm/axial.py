#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What a run of the 30 cm mill shows along its axis: axial.csv, axial.png (height of the slurry's centre of mass with two
Gaussians, hold-up, head), z_velocity.png, frames and an animation in CASE/pictures, and the numbers in a table."""
import argparse
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

from millfoam import foam, mill_plots
from millfoam.axial import axial_profile, discharge, find_humps, slurry_volumes
from millfoam.mill_flow import MillFlow


def z_velocity(flow, begin):
    """Mean of the slurry's velocity along the axis over axis and time, where its share is above 0.5: x, y, [ny, nx] (m/s)."""
    x = y = (np.arange(mill_plots.PIXELS) + 0.5) / mill_plots.PIXELS * 2 * flow.radius - flow.radius
    share, flux, seen = 0.0, 0.0, 0.0
    for time, path in flow.frames:
        if time < max(begin, 1e-9) - 1e-9:
            continue
        alpha = np.clip(flow.field("alpha.slurry", path), 0, 1)
        frame = flow.on_grid(flow.over_axis(alpha), time, x, y)
        inside = np.isfinite(frame)
        seen = seen + inside
        share = share + np.where(inside, frame, 0)
        flux = flux + np.where(inside, flow.on_grid(flow.over_axis(alpha * flow.field("U", path)[:, 2]), time, x, y), 0)
    with np.errstate(invalid="ignore", divide="ignore"):
        return x, y, np.where(share / seen > 0.5, flux / share, np.nan)


def plot_profile(profile, humps, path):
    figure, axes = plt.subplots(3, 1, figsize=(6.4, 7.6), sharex=True, constrained_layout=True)
    z = 1e3 * profile.z
    axes[0].fill_between(z, 1e3 * (profile.height - profile.height_spread), 1e3 * (profile.height + profile.height_spread),
                         alpha=0.2, label="standard deviation over time")
    axes[0].plot(z, 1e3 * profile.height, "o-", ms=3, label="mean")
    if humps:
        for place in humps.places:
            axes[0].axvline(1e3 * place, color="0.4", ls="--", lw=1)
        axes[0].set_title(f"humps of two Gaussians {1e3 * humps.distance:.0f} mm apart (RMSD {1e3 * humps.rmsd:.2g} mm)", fontsize=10)
    axes[0].set_ylabel("height of the slurry's\ncentre of mass, mm")
    axes[0].legend(fontsize=8)
    axes[1].plot(z, 1e6 * profile.holdup / np.gradient(1e3 * profile.z), "o-", ms=3)
    axes[1].set_ylabel("hold-up, ml per mm")
    axes[2].plot(z, profile.pressure, "o-", ms=3)
    axes[2].set(ylabel="p_rgh in the slurry, Pa", xlabel="z from the feed end, mm")
    for axis in axes:
        axis.grid(alpha=0.3)
    figure.savefig(path, dpi=110)
    plt.close(figure)


def plot_z_velocity(flow, begin, path):
    x, y, velocity = z_velocity(flow, begin)
    limit = np.nanpercentile(np.abs(velocity), 99) if np.isfinite(velocity).any() else 1
    figure, axis = plt.subplots(figsize=(6.2, 5.2), constrained_layout=True)
    image = axis.pcolormesh(1e3 * x, 1e3 * y, 1e3 * velocity, cmap="RdBu_r", vmin=-1e3 * limit, vmax=1e3 * limit)
    figure.colorbar(image, ax=axis, label="slurry's velocity along the axis, mm/s (red: to the discharge)")
    mill_plots.draw_mill(axis, flow, flow.frames[-1][0])
    figure.savefig(path, dpi=110)
    plt.close(figure)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("case", type=Path)
    parser.add_argument("--begin", type=float, help="flow time from which averages are taken, s [2, or half of a shorter run]")
    options = parser.parse_args()
    flow = MillFlow(options.case)
    last = flow.frames[-1][0]
    begin = (2.0 if last > 3 else last / 2) if options.begin is None else options.begin
    folder = options.case / "pictures"
    folder.mkdir(exist_ok=True)

    profile = axial_profile(flow, begin)
    humps = find_humps(profile.z, profile.height) if len(profile.z) >= 9 else None
    np.savetxt(folder / "axial.csv", np.column_stack([profile.z, profile.height, profile.height_spread, profile.holdup,
                                                      profile.pressure]), delimiter=",", comments="", fmt="%.8g",
               header="z_m,height_m,height_spread_m,holdup_m3,p_rgh_Pa")
    plot_profile(profile, humps, folder / "axial.png")
    plot_z_velocity(flow, begin, folder / "z_velocity.png")
    mill_plots.plot_strip(flow, folder / "slurry_frames.png")
    mill_plots.animate(flow, folder / "slurry.gif")

    feed = float(foam.read_dictionary(options.case / "constant" / "operation")["feedRate"])
    logs = [options.case / name for name in ("log.flow.before", "log.flow")]
    times, volumes = slurry_volumes("".join(log.read_text() for log in logs if log.is_file()))
    out = discharge(times, volumes, feed, begin)
    print(f"averages from {begin:g} to {last:g} s")
    print(f"slurry: {1e3 * volumes[0]:.3f} l at the start, {1e3 * volumes[-1]:.3f} l at the end")
    print(f"feed {1e6 * feed:.1f} ml/s, discharge {1e6 * out:.1f} ml/s, net {1e6 * (feed - out):+.1f} ml/s")
    print(f"height of the slurry's centre of mass: mean {1e3 * np.average(profile.height, weights=profile.holdup):.2f} mm, "
          f"{1e3 * profile.height.min():.2f} to {1e3 * profile.height.max():.2f} mm along the axis")
    if humps:
        print(f"two Gaussians: humps at {1e3 * humps.places[0]:.0f} and {1e3 * humps.places[1]:.0f} mm, "
              f"{1e3 * humps.heights[0]:.2f} and {1e3 * humps.heights[1]:.2f} mm high, {1e3 * humps.distance:.0f} mm apart, "
              f"RMSD {1e3 * humps.rmsd:.2g} mm")
    print(f"p_rgh in the slurry: {profile.pressure[0]:.1f} Pa at the feed end, {profile.pressure[-1]:.1f} Pa at the discharge end, "
          f"drop {profile.pressure[0] - profile.pressure[-1]:.1f} Pa")


if __name__ == "__main__":
    main()
