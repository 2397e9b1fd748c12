# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws pictures of a mill's case in CASE/pictures: maps.png, slurry_frames.png, slurry.gif, and force_on_balls.png if
the flow wrote the force on the balls. Prints a table of the centroids."""
import argparse
import sys
from pathlib import Path

import matplotlib

from ..files import solids_file
from ..files.mill_case import MillCase
from ..files.solids_file import SolidsMap
from ..files.written_times import MillFlow
from . import mill_plots


def main() -> None:
    matplotlib.use("Agg")
    parser = argparse.ArgumentParser(prog="plot_mill", description=__doc__)
    parser.add_argument("case", type=Path)
    parser.add_argument("--begin", type=float,
                        help="flow time at which the averages begin, s [at the mill's flow.averages.start, or at half "
                             "of the flow's time where at most half of the planned averaged time was computed]")
    options = parser.parse_args()
    flow = MillFlow(options.case)
    last = flow.frames[-1][0]
    begin = usual_begin(options.case, last) if options.begin is None else options.begin
    if not 0 <= begin < last:
        raise RuntimeError(f"--begin {begin:g}: expected 0 or more and less than the flow's last written time, "
                           f"{last:g} s")
    charge = read_charge(options.case / "solids.h5", flow, begin)
    folder = options.case / "pictures"
    folder.mkdir(exist_ok=True)
    names = ["slurry_frames.png", "slurry.gif"]
    if charge:
        mill_plots.plot_maps(flow, charge, begin, folder / "maps.png")
        names.insert(0, "maps.png")
    mill_plots.plot_strip(flow, folder / "slurry_frames.png")
    mill_plots.animate(flow, folder / "slurry.gif")
    load = flow.load(begin)
    if load:
        mill_plots.save(mill_plots.load_figure(flow, begin), folder / "force_on_balls.png")
        names.append("force_on_balls.png")
    summary(flow, charge, begin)
    if load:
        print(f"force of the fluid on the balls over their weight: mean {load[0]:.3g}, 95 % below {load[1]:.3g}")
    for name in names:
        print(folder / name)


def usual_begin(case: Path, last: float) -> float:
    """Flow time (s) at which the averages begin: that of MillCase, or half of a flow without a mill."""
    return MillCase(case).begin if (case / "mill.json").is_file() else last / 2


def read_charge(path: Path, flow: MillFlow, begin: float) -> SolidsMap | None:
    """SolidsMap of the charge for the averaged time of the flow; None, with a message, if there is no solids.h5."""
    if not path.is_file():
        print(f"{path}: no such file; no maps.png, and no charge in the table. millAverage writes it.")
        return None
    if not solids_file.has_voxels(path):
        print(f"{path}: its cells are not a box's voxels; no maps.png, and no charge in the table")
        return None
    span = solids_file.span_of_flow(*solids_file.recorded_span(path), flow.time0 + begin,
                                    flow.time0 + flow.frames[-1][0])
    return solids_file.read_map(path, *span)


def summary(flow: MillFlow, charge: SolidsMap | None, begin: float) -> None:
    """Prints the sense of rotation, the centroids, and the slurry's volume at begin and end."""
    print("the mill turns " + ("clockwise: its rising side is x < 0" if flow.omega < 0 else
                               "anticlockwise: its rising side is x > 0"))
    if charge:
        x, y = charge.centroid()
        print(f"charge centroid, averaged:  x {1e3 * x:7.2f} mm, y {1e3 * y:7.2f} mm")
    late = [flow.slurry_centroid(*frame) for frame in flow.frames_with_slurry(begin)]
    print(f"slurry centroid, averaged:  x {1e3 * sum(c[0] for c in late) / len(late):7.2f} mm, "
          f"y {1e3 * sum(c[1] for c in late) / len(late):7.2f} mm")
    first, last = flow.slurry_volumes()
    print(f"slurry volume: {first:.6g} m3 at the start, changed by {100 * (last / first - 1):.4f} % at the end")


if __name__ == "__main__":
    try:
        main()
    except (RuntimeError, OSError) as error:
        sys.exit(f"plot_mill: error: {error}")
