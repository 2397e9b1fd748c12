# SPDX-License-Identifier: GPL-3.0-or-later
"""The table of the pools at rest, and slurryFoam's limits."""
import math
from dataclasses import dataclass

from millfoam.files.data_files import write_csv
from millfoam.run import limit_table, write_table

AT = (0.25, 0.5, 0.75, 1.0)  # shares of the run at which the table shows it
REFERENCE, JUDGED = "interFoam", "slurryFoam"
REACHED = 1e-6  # s that a run may be short of the end
SHARE = 1 / 3  # of interFoam's rms speed on the same mesh
GROWTH = 1.1  # late over early rms speed: a pool at rest oscillates a little, without a trend
CONSERVED = 5e-13  # relative change of the slurry's volume
# Excess of the slurry's share over [0, 1], 1/s: twice that of the mill's first cell. The pressure's reference is there;
# it collects what the pressure's tolerance leaves of continuity in all cells.
BOUNDED = 2.5e-9


@dataclass(frozen=True)
class Limits:
    """Speeds of slurry, m/s, about twice what was found with any surface tension and bed, after 0.15 s to 1 s. On a
    mesh at rest they come from the surface tension, on a turning mesh from the polygon's corners."""
    rms: float  # of a pool at the end
    bed: float  # of a pool between balls, largest over time and place
    alone: float  # of slurry alone, largest over time and place


LIMITS = {
    # Since the curvature is smoothed along the surface (version abc937a) the bed's is 2e-8 and grows in time
    ("ogrid", False): Limits(6e-9, 5e-8, 1e-15),
    ("mill", False): Limits(5e-8, 3e-7, 1e-15),
    ("slice", False): Limits(3e-9, 8e-8, 1e-15),
    ("ogrid", True): Limits(2e-3, 0.016, 6e-4),
    ("drum", True): Limits(1.2e-3, 0.02, 2e-4),
}
# m/s2: a pool on a turning mesh has at most so much more rms speed in each second; about twice what was found
WAVES = 8e-3
AIM_SLURRY, AIM_AIR = 1e-3, 0.3  # m/s: aimed at, reported, not failed


def named(run, found):
    return [(f"{run.setting}: {text}", value, allowed) for text, value, allowed in found]


def checks(run, history, reference, end):
    """Limits for slurryFoam: list of (text, found, allowed)."""
    limits = LIMITS[run.mesh, run.turning]
    found = [
        ("time reached, s short of the end", end - history.time[-1], REACHED),
        ("slurry volume, relative change", history.volume_change, CONSERVED),
        ("slurry share outside [0, 1]", history.excess.max(), BOUNDED * max(end, 0.2)),
    ]
    if run.filled:
        # Turning, what the faces sweep is found to a hundredth
        found.append(("largest speed of slurry alone, m/s", history.slurry.max(), limits.alone))
        return named(run, found)
    most = min(limits.rms, WAVES * end) if run.turning else limits.rms
    found.append(("slurry rms at the end, m/s", history.slurry_rms[-1], most))
    if run.bed:
        found.append(("largest speed of slurry between the balls, m/s", history.bed.max(), limits.bed))
    if not run.turning:
        # Turning walls are polygons, which cause waves: those are reported
        found.append(("slurry rms, late over early", history.growth, GROWTH))
    if reference is not None:
        short = end - reference.time[-1]
        if not short <= REACHED:
            # Its last speeds are those of a flow that diverges: any other is slower
            found.append((f"{REFERENCE} ended early and is no reference, s short", short, REACHED))
            return named(run, found)
        found.append((f"slurry rms at the end over {REFERENCE}'s", history.slurry_rms[-1] / reference.slurry_rms[-1],
                      SHARE))
    return named(run, found)


def figures(run, history, end):
    """One line of the table: name -> value; NaN at times that a run did not reach."""
    line = {"mesh": run.mesh, "turning": int(run.turning), "sigma": run.tension, "solver": run.solver,
            "reached": float(history.time[-1]), "steps": int(history.steps[-1]),
            "bed": int(run.bed), "filled": int(run.filled), "in_bed": history.bed.max() if run.bed else math.nan,
            "volume_change": history.volume_change, "excess": history.excess.max(), "growth": history.growth}
    for share in AT:
        index = history.at(share * end)
        for name, values in (("air", history.air), ("slurry", history.slurry), ("rms", history.slurry_rms)):
            line[f"{name}_{share * end:g}"] = math.nan if index is None else float(values[index])
    return line


def table(histories, end):
    times = [f"{share * end:g}" for share in AT]
    half, full = times[1], times[3]
    text = [f"{'mesh, motion, sigma N/m':<35} {'solver':<13} {'air max m/s at':>17} {'slurry max m/s at':>19} "
            f"{'slurry rms, mm/s, at':>35} {'late/':>6} {'volume':>8} {'steps':>6}",
            f"{'':<49} {half + ' s':>8} {full + ' s':>8} {half + ' s':>10} {full + ' s':>8} "
            + " ".join(f"{time + ' s':>8}" for time in times) + f" {'early':>6} {'change':>8}"]
    for run, history in histories.items():
        line = figures(run, history, end)
        text.append(
            f"{run.setting:<35} {run.solver:<13} {line['air_' + half]:8.3g} {line['air_' + full]:8.3g} "
            f"{line['slurry_' + half]:10.2e} {line['slurry_' + full]:8.1e} "
            + " ".join(f"{1e3 * line['rms_' + time]:8.3g}" for time in times)
            + f" {line['growth']:6.2f} {line['volume_change']:8.1e} {line['steps']:6d}")
    return text


def judge(histories, end):
    """Lines about slurryFoam, and how many of them missed a limit."""
    limits, aims = [], []
    for run, history in histories.items():
        if run.solver != JUDGED:
            continue
        references = [other for other in histories if other.setting == run.setting and other.solver == REFERENCE]
        limits += checks(run, history, histories[references[0]] if references else None, end)
        if not run.filled:
            aims += [(f"{run.setting}: largest speed in the {what} at the end, m/s", found, aim)
                     for what, found, aim in (("slurry", history.slurry[-1], AIM_SLURRY),
                                              ("air", history.air[-1], AIM_AIR))]
    if not limits:
        return [], 0
    lines, missed = limit_table(limits)
    aimed = ["", f"{JUDGED}: aims", *limit_table(aims, "aim", "above the aim")[0]] if aims else []
    return [f"{JUDGED}: limits", *lines, *aimed], missed


def report(histories, end, out):
    """Prints the tables, writes them to pool.txt and the numbers to pool.csv in folder `out`; returns the
    number of values beyond their limit."""
    judged, missed = judge(histories, end)
    write_table([*table(histories, end), "", *judged], out / "pool.txt")
    write_csv(out / "pool.csv", [figures(run, history, end) for run, history in histories.items()])
    return missed
