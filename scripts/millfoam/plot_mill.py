# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures of a mill case: maps.png, slurry_frames.png, slurry.gif and, where the flow told the force on the balls,
force_on_balls.png in CASE/pictures; and the centroids in a table."""
import argparse
import sys
from pathlib import Path

from . import mill_plots, solids
from .mill_flow import MillFlow


def main():
    parser = argparse.ArgumentParser(prog="plot_mill", description=__doc__)
    parser.add_argument("case", type=Path)
    parser.add_argument("--begin", type=float, help="flow time from which averages are taken, s [half of the run]")
    options = parser.parse_args()
    flow = MillFlow(options.case)
    begin = flow.frames[-1][0] / 2 if options.begin is None else options.begin
    charge = solids.read_map(options.case / "solids.h5", flow.time0 + begin, flow.time0 + flow.frames[-1][0])
    folder = options.case / "pictures"
    folder.mkdir(exist_ok=True)
    mill_plots.plot_maps(flow, charge, begin, folder / "maps.png")
    mill_plots.plot_strip(flow, folder / "slurry_frames.png")
    mill_plots.animate(flow, folder / "slurry.gif")
    names = ["maps.png", "slurry_frames.png", "slurry.gif"]
    load = flow.load(begin)
    if load:
        mill_plots.save(mill_plots.load_figure(flow, begin), folder / "force_on_balls.png")
        names.append("force_on_balls.png")
    summary(flow, charge, begin)
    if load:
        print(f"force of the fluid on the balls over their weight: mean {load[0]:.3g}, 95 % below {load[1]:.3g}")
    for name in names:
        print(folder / name)


def summary(flow, charge, begin):
    """Centroids (of a clockwise mill the rising side is x < 0) and the slurry's volume at begin and end."""
    x, y = charge.centroid()
    print(f"charge centroid, averaged:  x {1e3 * x:7.2f} mm, y {1e3 * y:7.2f} mm")
    late = [flow.slurry_centroid(*frame) for frame in flow.frames if frame[0] >= begin - 1e-9]
    print(f"slurry centroid, averaged:  x {1e3 * sum(c[0] for c in late) / len(late):7.2f} mm, "
          f"y {1e3 * sum(c[1] for c in late) / len(late):7.2f} mm")
    first, last = flow.slurry_volumes()
    print(f"slurry volume: {first:.6g} m3 at the start, changed by {100 * (last / first - 1):.4f} % at the end")


if __name__ == "__main__":
    try:
        main()
    except RuntimeError as error:
        sys.exit(f"plot_mill: error: {error}")
