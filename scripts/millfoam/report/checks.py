# SPDX-License-Identifier: GPL-3.0-or-later
"""Whether a run can be believed: what was found, and what to do where it fails."""
import re
from dataclasses import dataclass

import h5py
import numpy as np

from .. import foam
from .words import decimals

CONSERVED = 1e-6  # of the hold-up that may be missing
LEDGER = 0.01  # of the balls' volume that may lie outside or be clipped
OVERLAP = 0.15  # of the diameter: physics of softened balls (Brosh, Kalman & Levy)
CORRECTION = 2.0  # %, of the balls' volume on the flow's mesh
BALLS = 8  # in an averaging volume: the drag laws were derived on 8 to 64
NOISE = 0.05  # of a window's mean solidity by chance
OUT_OF_RANGE = 20.0  # % of the slurry in the bed
LIGHT, HEAVY = 0.2, 0.5  # of the balls' weight, force of the fluid: its mean, and what 95 % of the balls stay below
STEPS = 0.01  # of the time-steps that may go beyond 1.5 times a limit
DRIFT = 3.0  # standard errors between the two halves of the averages
WORDS = {"holdUp": "hold-up", "x": "centre's x", "y": "centre's y"}


@dataclass
class Check:
    """state: holds, look (doubtful), fails or unknown; advice: what to do, where it does not hold."""
    name: str
    state: str
    found: str
    advice: str = ""


def judged(name, value, limit, found, advice, *, doubtful=None):
    """A check that holds up to `limit`, is doubtful up to `doubtful`, and fails beyond."""
    if value <= limit:
        return Check(name, "holds", found)
    return Check(name, "look" if doubtful is not None and value <= doubtful else "fails", found, advice)


def all_checks(case):
    """The checks of a MillCase, those that its parts allow: first what fails."""
    checks = []
    if case.flow:
        checks += [conservation(case), flow_steadiness(case), courant(case), mesh(case)]
    if case.results:
        checks += [lost_balls(case), charge_steadiness(case), overlap(case)]
    if case.solids:
        checks += [ledger(case), averaging_volume(case), window_noise(case)]
    if case.flow and case.law:
        checks += [solids_on_mesh(case), drag_range(case), one_way(case)]
    checks += [Check("All files can be used", "fails", told, "Make it again, or remove it.") for told in case.unusable]
    order = ("fails", "look", "unknown", "holds")
    return sorted(checks, key=lambda check: order.index(check.state))


def conservation(case):
    name = "Slurry is conserved"
    told = case.balance
    if told is None:
        return Check(name, "unknown", "the flow ran without the function object slurryBalance",
                     "Add it to controlDict; see slurryBalance.H.")
    share = np.abs(told["missing"]).max() / np.abs(told["holdUp"]).max()
    return judged(name, share, CONSERVED, f"at most {share:.1e} of the hold-up is missing (limit {CONSERVED:.0e})",
                  "Look for cells in which alpha leaves [0, 1] in log.flow, and give the limiter more iterations (nLimiterIter).")


def halves(times, values, begin):
    """Difference of the means of two halves from `begin` on, and its standard error from ten batches of equal time.

    The error is of what the batches differ from a straight line by: a drift must not hide itself."""
    chosen = times >= begin
    edges = np.linspace(times[chosen][0], times[chosen][-1], 11)
    places = np.clip(np.searchsorted(edges, times[chosen], side="right") - 1, 0, 9)
    counts = np.bincount(places, minlength=10)
    if (counts == 0).any():
        return np.nan, np.nan
    batches = np.bincount(places, values[chosen], 10) / counts
    straight = np.polyval(np.polyfit(np.arange(10), batches, 1), np.arange(10))
    error = np.sqrt(np.sum((batches - straight) ** 2) / 8 * 2 / 5)
    return batches[5:].mean() - batches[:5].mean(), error


def difference_with_error(value, error):
    """As many digits as the error allows, three after the point at most."""
    digits = min(decimals(error), 3) if np.isfinite(error) and error > 0 else 3
    return f"{value:+.{digits}f} ± {error:.{digits}f}"


def flow_steadiness(case):
    name = "The flow is steady"
    told = case.balance
    if told is None or (told["Time"] >= case.begin).sum() < 20:
        return Check(name, "unknown", "the time series of slurryBalance is missing or too short",
                     "Add slurryBalance to controlDict, or run longer.")
    drifts, words = [], []
    for key, unit, scale in (("holdUp", "ml", 1e6), ("x", "mm", 1e3), ("y", "mm", 1e3)):
        difference, error = halves(told["Time"], told[key], case.begin)
        # What is less than 1 % of the hold-up or of the radius is no drift that matters
        floor = 0.01 * (told[key].mean() if key == "holdUp" else case.radius)
        drifts.append(abs(difference) / np.maximum(error * DRIFT, floor))
        words.append(f"{WORDS[key]} {difference_with_error(scale * difference, scale * error)} {unit}")
    return judged(name, np.max(drifts), 1, f"from {case.begin:g} s on, second half less the first: " + ", ".join(words)
                  + f" (limit {DRIFT:g} standard errors, or 1 % of the hold-up and of the radius)",
                  "Run longer, or begin the averages later (--begin).", doubtful=2)


def courant(case):
    name = "Time-steps keep to their limits"
    found = np.array(re.findall(r"^Courant number (\S+), at the surface (\S+), change of voidage (\S+)", case.log("flow"), re.M),
                     dtype=float)
    if len(found) < 2:
        return Check(name, "unknown", "log.flow does not tell Courant numbers", "Keep log.flow in the case.")
    found = found[1:]  # the first is before the first step
    limits = step_limits(case.folder / "system" / "controlDict")
    if not np.isfinite(limits).any():
        return Check(name, "unknown", "controlDict has no limits as numbers", "Set maxCo, maxAlphaCo and maxVoidageChange.")
    # Also a number that is none is beyond
    over = (~(found <= 1.5 * limits)).any(axis=1).mean()
    words = ", ".join(f"{what} {np.percentile(found[:, k], 95):.2g}" + (f" for {limits[k]:g}" if np.isfinite(limits[k]) else "")
                      for k, what in enumerate(("Courant number", "at the surface", "change of voidage")))
    return judged(name, over, STEPS, f"{100 * over:.1f} % of the steps are beyond 1.5 times what controlDict asks for (limit "
                  f"{100 * STEPS:g} %); 95 % of the steps stay below: {words}",
                  "Lower maxCo, maxAlphaCo or maxDeltaT in controlDict.", doubtful=0.05)


def step_limits(path):
    """Largest Courant number, that at the surface, and change of voidage by controlDict [3]; infinite where it has none."""
    told = foam.read_dictionary(path) if path.is_file() else {}
    words = [told.get(key, "").strip() for key in ("maxCo", "maxAlphaCo", "maxVoidageChange")]
    return np.array([float(word) if re.fullmatch(r"[\d.]+(e[+-]?\d+)?", word) else np.inf for word in words])


def mesh(case):
    name = "The mesh is sound"
    ok = "Mesh OK" in case.log("check")
    values = dict(re.findall(r"^(volume error|max non-orthogonality|max skewness|max volume ratio)\s+(\S+)", case.log("mesh"),
                             re.M))
    if not case.log("check"):
        return Check(name, "unknown", "checkMesh was not run (no log.check)", "Run checkMesh > log.check in the case.")
    words = ", ".join(f"{key.removeprefix('max ')} {value}" for key, value in values.items())
    if ok:
        return Check(name, "holds", words or "checkMesh found nothing")
    return Check(name, "fails", f"a check of checkMesh failed, see log.check; {words}",
                 "Refine the mesh or change the lifters' section.")


def lost_balls(case):
    lost = int(case.results["lost_balls"])
    return judged("No ball is lost", lost, 0, f"{lost} of {int(case.results['balls'])} lost",
                  "Shorten the time-step (dem.rayleigh_fraction) or look for holes in the walls (millMesh surface).")


def charge_steadiness(case):
    name = "The charge is steady where it is averaged"
    if case.results["steady"] != "yes":
        return Check(name, "fails", "the dry run's power did not become steady",
                     "Let it run longer (dem.duration, millDem --resume).")
    since = float(case.results["steady_from"])
    found = f"steady from {since:.2f} s on"
    if not case.solids:
        return Check(name, "holds", found)
    begin = case.charge_span[0]
    return judged(name, since - begin, 0, f"{found}; averages from {begin:.2f} s",
                  "Begin the averages later (--begin), or the flow at a later DEM time.", doubtful=0.5)


def overlap(case):
    smallest = case.results.get("smallest_diameter")
    diameter = float(smallest) if smallest else min(c["diameter"] for c in case.mill["charge"]["classes"])
    share = float(case.results["ball_overlap_largest"]) / diameter
    usual = float(case.results["ball_overlap_99"]) / diameter
    return judged("Balls are stiff enough", share, OVERLAP,
                  f"largest overlap {100 * share:.1f} % of the smallest diameter, 99 % of the contacts below {100 * usual:.2f} % "
                  f"(limit {100 * OVERLAP:.0f} %)", "Raise dem.youngs_modulus, or lower dem.largest_overlap.")


def ledger(case):
    with h5py.File(case.solids) as file:
        into, outside, clipped = (file[f"ledger/{key}"][:] for key in ("volume_in", "outside", "clipped"))
    share = ((outside + clipped) / into).max()
    return judged("Balls are in the averages", share, LEDGER,
                  f"at most {100 * share:.2g} % of their volume is outside or moved to neighbours in a window "
                  f"(limit {100 * LEDGER:.0f} %)", "Let the voxels cover the mill (--box), and give its walls (--inside).")


def averaging_volume(case):
    with h5py.File(case.solids) as file:
        balls = file["window/balls_per_cell"][:].mean()
    found = f"{balls:.1f} balls in an occupied cell (the drag laws were derived on {BALLS} to 64)"
    if balls > 64:
        return Check("Averaging volumes hold enough balls", "look", found, "Finer voxels would show more of the charge.")
    return judged("Averaging volumes hold enough balls", BALLS / balls, 1, found,
                  "Take larger voxels or --smooth; on smaller ones a law sees single balls.", doubtful=8)


def window_noise(case):
    name = "Windows are long enough for their mean"
    with h5py.File(case.solids) as file:
        count = len(file["window/begin"])
        noise, weight = 0.0, 0.0
        for window in np.unique(np.linspace(0, count - 1, 20).astype(int)):
            phi, spread = file["solidity"][window], file["solidity_deviation"][window]
            dense = phi > 0.3
            noise += (spread[dense] / phi[dense]).sum() / np.sqrt(file["window/records"][window])
            weight += dense.sum()
    if weight == 0:
        return Check(name, "unknown", "no voxel is denser than 0.3",
                     "Take smaller voxels, so that some are full of balls.")
    share = noise / weight
    return judged(name, share, NOISE, f"in the dense charge a window's mean solidity is uncertain by {100 * share:.1f} % if its "
                  f"records are independent (limit {100 * NOISE:.0f} %)",
                  "Take longer windows (--window) or record more often (dem.record_interval).", doubtful=2 * NOISE)


def solids_on_mesh(case):
    found = re.findall(r"volume corrected by \S+ %, at most (\S+) %", case.log("flow"))
    if not found:
        return Check("Balls on the flow's mesh keep their volume", "unknown", "log.flow does not tell the correction",
                     "Keep log.flow in the case.")
    share = max(abs(float(value)) for value in found)
    return judged("Balls on the flow's mesh keep their volume", share, CORRECTION,
                  f"corrected by at most {share:.2g} % (limit {CORRECTION:g} %)",
                  "Average with the mill's walls (--inside), or on the flow's own mesh (--mesh).")


def drag_range(case):
    name = "The drag law is within its range"
    found = re.findall(r"in the mean over \S+ s (\S+) %", case.log("flow"))
    if not found:
        return Check(name, "unknown", "log.flow has no summary: the flow was broken off or goes on",
                     "Let the flow run to its end.")
    share = float(found[-1])
    return judged(name, share, OUT_OF_RANGE, f"{share:.1f} % of the slurry in the bed is beyond {case.law}'s range "
                  f"(limit {OUT_OF_RANGE:g} %)", "Compare with a law of another range (millDrag --ranges).", doubtful=50)


def one_way(case):
    name = "The slurry would not move the balls"
    load = case.load
    if load is None:
        return Check(name, "unknown", "the flow did not tell the force on the balls",
                     "Give ballDensity in constant/bedProperties.")
    mean, high = load
    return judged(name, np.max([mean / LIGHT, high / HEAVY]), 1,
                  f"its force is {mean:.2f} of their weight in the mean (limit {LIGHT}), 95 % below {high:.2f} (limit {HEAVY})",
                  "The coupling is one-way: where the force nears the weight, read the charge's shape with care.",
                  doubtful=1 / HEAVY)
