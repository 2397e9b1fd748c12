#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Compares one-way, buoyant, iterated and direct coupling of mills: a table on the screen,
mill_coupling.txt, mill_coupling.csv and mill_coupling.png."""
import argparse
from pathlib import Path

import matplotlib
import numpy as np

from millfoam.coupling.passes import QUANTITIES, Pass, change, read_pass
from millfoam.files.data_files import read_json, write_csv
from millfoam.files.mill_case import MillCase
from millfoam.plots.mill_plots import draw_outline
from millfoam.readings.slurry_over_time import mean_slurry, slurry_blocks
from millstudies.mean_columns import mean_columns, mean_text

HERE = Path(__file__).parent.resolve()
EDGE = 0.3  # solidity of the charge's outline in the picture
HALF = 0.5  # share of the slurry's outline


def title(mill):
    return "30 cm mill" if mill == "30cm" else mill.replace("_", " % of critical speed, ")


def passes_of(mill):
    """Name -> Pass of a mill's four ways; the iterated one is the last pass."""
    folder = HERE / "runs" / mill
    coupling = read_json(folder / "coupling.json", "coupling")
    last = coupling["folders"][-1]
    return {"one way": read_pass(1, folder), "buoyancy": read_pass(1, HERE / "runs" / f"{mill}_buoyancy"),
            f"iterated ({coupling['passes']})": read_pass(coupling["passes"], folder / last),
            "direct": read_pass(2, HERE / "runs" / f"{mill}_direct" / "direct")}


def rows_of(mill, ways):
    """Rows of the table: column -> text or number."""
    dry = ways["one way"]
    for name, one in ways.items():
        row = {"mill": mill, "coupling": name}
        for key, (quantity, unit, scale) in QUANTITIES.items():
            row |= mean_columns(f"{quantity}, {unit}", one.quantities[key], scale)
        row["solidity from one way"] = 0.0 if one is dry else change(dry, one).solidity
        row["its noise"] = np.hypot(dry.noise, one.noise) / np.sqrt(2)
        row["force over weight"] = one.load
        yield row


def lines_of(rows):
    """The table as text, a block for each mill."""
    for mill in dict.fromkeys(row["mill"] for row in rows):
        found = [row for row in rows if row["mill"] == mill]
        yield mill.ljust(32) + "".join(row["coupling"].rjust(18) for row in found)
        for name in (column for column in found[0] if f"{column} ±" in found[0]):
            digits = 4 if name.endswith(" W") else 2
            yield name.ljust(32) + "".join(mean_text(row, name, digits).rjust(18) for row in found)
        for name in ("solidity from one way", "its noise", "force over weight"):
            yield name.ljust(32) + "".join(f"{row[name]:18.3f}" for row in found)
        yield ""


def draw(mills):
    """Figure of a row per mill and a panel per way: solidity, outline of the slurry, and the dry charge's outline."""
    import matplotlib.pyplot as plt
    figure, axes = plt.subplots(len(mills), 4, figsize=(13, 3.3 * len(mills)), squeeze=False, layout="constrained")
    for line, (mill, ways) in zip(axes, mills.items()):
        dry: Pass = ways["one way"]
        for axis, (name, one) in zip(line, ways.items()):
            case = MillCase(one.folder)
            charge = one.charge
            x, y = (1e3 * at for at in charge.centres())
            mesh = axis.pcolormesh(1e3 * charge.x, 1e3 * charge.y, np.where(charge.inside > 0, charge.solidity, np.nan),
                                   vmin=0, vmax=0.65, cmap="YlOrBr")
            axis.contour(x, y, np.nan_to_num(dry.charge.solidity), [EDGE], colors="0.4", linestyles="dashed")
            slurry = mean_slurry(case, list(slurry_blocks(case)))
            sx, sy = (1e3 * at for at in slurry.centres())
            axis.contour(sx, sy, np.nan_to_num(slurry.share), [HALF], colors="#0072B2")
            draw_outline(axis, case.outline, case.radius, case.omega)
            axis.set(title=f"{title(mill)}: {name}", aspect="equal", xlabel="x, mm",
                     ylabel="y, mm")
            axis.title.set_fontsize(9)
        figure.colorbar(mesh, ax=line, label="solidity, –")
    figure.suptitle("Solidity; blue: half slurry; dashed: edge of the charge without the slurry's force", fontsize=10)
    return figure


def main():
    matplotlib.use("Agg")
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("mills", nargs="+", metavar="MILL")
    mills = {mill: passes_of(mill) for mill in parser.parse_args().mills}
    rows = [row for mill, ways in mills.items() for row in rows_of(mill, ways)]
    write_csv(HERE / "mill_coupling.csv", rows)
    text = "\n".join(lines_of(rows))
    (HERE / "mill_coupling.txt").write_text(text + "\n")
    print(text)
    draw(mills).savefig(HERE / "mill_coupling.png", dpi=150)


if __name__ == "__main__":
    main()
