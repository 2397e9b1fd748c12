#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Profiles of a run of the 30 cm mill along its axis: axial.csv, axial.png (height of the slurry's centre of mass with
two and three Gaussians, hold-up, head), z_velocity.png, frames and an animation in CASE/pictures, and the numbers in a
table."""
import argparse
from pathlib import Path

import matplotlib
import matplotlib.pyplot as plt
import numpy as np

from millfoam.files import foam
from millfoam.files.mill import read_mill
from millfoam.files.mill_case import MillCase
from millfoam.files.written_times import MillFlow
from millfoam.plots import mill_plots
from millfoam.readings.axial import (Humps, axial_profile, discharge, fit_gaussians, humps_at_ends, slice_thickness,
                                     slurry_volumes)
from millfoam.readings.slurry_on_maps import axial_flow, axial_velocity, slurry_ends
from millfoam.readings.slurry_over_time import RING, ring_depth

matplotlib.use("Agg")


def fit_profile(profile):
    """Humps of an AxialProfile by their number, two or three, or the text of why there are none."""
    fits = {}
    for count in (2, 3):
        try:
            fits[count] = fit_gaussians(profile.z, profile.height, count)
        except RuntimeError as error:
            fits[count] = str(error)
    return fits


def plot_profile(profile, fits, path):
    figure, axes = plt.subplots(3, 1, figsize=(6.4, 7.6), sharex=True, constrained_layout=True)
    z = 1e3 * profile.z
    axes[0].fill_between(z, 1e3 * (profile.height - profile.height_spread),
                         1e3 * (profile.height + profile.height_spread),
                         alpha=0.2, label="standard deviation over time")
    axes[0].plot(z, 1e3 * profile.height, "o-", ms=3, label="mean")
    along = np.linspace(profile.z[0], profile.z[-1], 200)
    for (count, humps), style in zip(fits.items(), ("--", ":")):
        if not isinstance(humps, Humps):
            continue
        axes[0].plot(1e3 * along, 1e3 * humps.fitted(along), color="0.3", ls=style, lw=1.2,
                     label=f"{count} Gaussians, RMSD {1e3 * humps.rmsd:.2g} mm"
                           + (" (at the profile's end)" if humps_at_ends(humps, profile.z) else ""))
    axes[0].set_ylabel("height of the slurry's\ncentre of mass, mm")
    axes[0].legend(fontsize=8)
    axes[1].plot(z, 1e3 * profile.holdup / slice_thickness(profile.z), "o-", ms=3)
    axes[1].set_ylabel("hold-up, ml per mm")
    axes[2].plot(z, profile.pressure, "o-", ms=3)
    axes[2].set(ylabel="p_rgh in the slurry, Pa", xlabel="z from the feed end, mm")
    for axis in axes:
        axis.grid(alpha=0.3)
    figure.savefig(path, dpi=110)
    plt.close(figure)


def plot_z_velocity(flow, slurry, path):
    velocity = axial_velocity(slurry)
    limit = np.nanpercentile(np.abs(velocity), 99) if np.isfinite(velocity).any() else 1
    figure, axis = plt.subplots(figsize=(6.2, 5.2), constrained_layout=True)
    image = axis.pcolormesh(1e3 * slurry.x, 1e3 * slurry.y, 1e3 * velocity, cmap="RdBu_r", vmin=-1e3 * limit,
                            vmax=1e3 * limit)
    figure.colorbar(image, ax=axis, label="slurry's velocity along the axis, mm/s (red: to the discharge)")
    mill_plots.draw_mill(axis, flow, flow.frames[-1][0])
    figure.savefig(path, dpi=110)
    plt.close(figure)


def millimetres(lengths, digits):
    return ", ".join(f"{1e3 * length:.{digits}f}" for length in lengths)


def print_profile(profile, fits):
    """Prints the heights and pressures of an AxialProfile, of the slices that hold slurry, and its fits."""
    wet = np.isfinite(profile.height)
    if not wet.any():
        print("height of the slurry's centre of mass: not known: no slice holds slurry")
        return
    z, height, pressure = profile.z[wet], profile.height[wet], profile.pressure[wet]
    print(f"height of the slurry's centre of mass: mean {1e3 * np.average(height, weights=profile.holdup[wet]):.2f} "
          f"mm, {1e3 * height.min():.2f} to {1e3 * height.max():.2f} mm along the axis"
          + ("" if wet.all() else f"; {np.sum(~wet)} of {len(wet)} slices hold no slurry"))
    for count, humps in fits.items():
        if isinstance(humps, Humps):
            words = (f"humps at {millimetres(humps.places, 0)} mm, {millimetres(humps.heights, 2)} mm high, "
                     f"{millimetres(humps.distances, 0)} mm apart, RMSD {1e3 * humps.rmsd:.2g} mm"
                     + (", at the profile's end" if humps_at_ends(humps, profile.z) else ""))
        else:
            words = f"not known: {humps}"
        print(f"{count} Gaussians: {words}")
    print(f"p_rgh in the slurry: {pressure[0]:.1f} Pa at z = {1e3 * z[0]:.0f} mm, {pressure[-1]:.1f} Pa at z = "
          f"{1e3 * z[-1]:.0f} mm, drop {pressure[0] - pressure[-1]:.1f} Pa")


def print_axial_flow(flow, slurry):
    """Prints the ends of the slurry, and its motion along the axis at the toe and at the shoulder."""
    height = float(foam.read_dictionary(flow.case / "constant" / "millProperties")["lifterHeight"])
    toe, shoulder = slurry_ends(slurry, flow.radius, ring_depth(height))
    print(f"slurry from {toe:.0f} (toe) to {shoulder:.0f} degrees (shoulder) from straight down, {RING:g} lifters' "
          "heights from the shell")
    if np.isfinite([toe, shoulder]).all():
        along = axial_flow(slurry, toe, shoulder)
        for name, half in (("toe", along.toe), ("shoulder", along.shoulder)):
            print(f"velocity along the axis on the half of the {name}: mean {1e3 * half.mean:+.1f} mm/s, 90 % within "
                  f"{1e3 * half.lowest:+.1f} to {1e3 * half.highest:+.1f} mm/s (+: to the discharge)")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("case", type=Path)
    parser.add_argument("--begin", type=float,
                        help="flow time from which averages are taken, s [that of the mill's averages]")
    options = parser.parse_args()
    flow = MillFlow(options.case)
    last = flow.frames[-1][0]
    begin = MillCase(options.case).begin if options.begin is None else options.begin
    folder = options.case / "pictures"
    folder.mkdir(exist_ok=True)

    profile = axial_profile(flow, begin)
    if len(profile.z) < 2:
        parser.error(f"{options.case}: one layer of cells along the axis; expected two or more")
    fits = fit_profile(profile)
    np.savetxt(folder / "axial.csv", np.column_stack([profile.z, profile.height, profile.height_spread, profile.holdup,
                                                      profile.pressure]), delimiter=",", comments="", fmt="%.8g",
               header="z_m,height_m,height_spread_m,holdup_m3,p_rgh_Pa")
    plot_profile(profile, fits, folder / "axial.png")
    slurry = mill_plots.mean_flow(flow, begin)
    plot_z_velocity(flow, slurry, folder / "z_velocity.png")
    mill_plots.plot_strip(flow, folder / "slurry_frames.png")
    mill_plots.animate(flow, folder / "slurry.gif")

    feed = read_mill(options.case).flow("feed_m3_s", 0.0)
    times, volumes = slurry_volumes(options.case)
    out = discharge(times, volumes, feed, begin)
    print(f"averages from {begin:g} to {last:g} s")
    print(f"slurry: {1e3 * volumes[0]:.3f} l at the start, {1e3 * volumes[-1]:.3f} l at the end")
    print(f"feed {1e6 * feed:.1f} ml/s, discharge {1e6 * out:.1f} ml/s, net {1e6 * (feed - out):+.1f} ml/s")
    print_profile(profile, fits)
    print_axial_flow(flow, slurry)


if __name__ == "__main__":
    main()
