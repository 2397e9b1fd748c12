# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks of a flow: its slurry, its time-steps, its mesh, and the balls in it."""
import numpy as np

from ..files.data_files import number
from ..files.mill_case import MillCase
from ..files.slurry_file import uncovered_share
from ..files.stirred_case import StirredCase
from ..readings.slurry_conservation import AS_ASKED, CONSERVED, feed_error, missing_share
from ..readings.stirred_flow import read_flow_torques
from .verdict import Check, judged

GAP = 1e-3  # of the averages' time that may be missing: names of times are rounded
CORRECTION = 2.0  # %, of the balls' volume on the flow's mesh
OUT_OF_RANGE = 20.0  # % of the slurry in the bed
TORQUES = 0.05  # of the impeller's torque on balls and slurry that the slurry's balance may miss
SLOWEST_YIELD = 1.0  # 1/s, down to which a slurry has its yield stress: below a mill's own rate of 2 to 10
APPARENT = 1.5  # times the plastic viscosity, that the slurry may have in the pores
CONTINUITY = 15.0  # % of the slip, of the flow that the balls' averages drive by not being continuous
LIGHT, HEAVY = 0.2, 0.5  # of the balls' weight, force of the fluid: its mean, and what 95 % of the balls stay below
# Share of the time-steps that may go beyond a multiple of a limit, and above which the check fails. A step follows from
# the one before, so that a limit is what it aims at; the 12 cm mill has the same numbers with limits of 1.25 and 1.5
STEPS, FAILING_STEPS, BEYOND = 0.01, 0.05, 2.0
# Columns of steps.csv, their limits in flow.json and what they are
LIMITS = (("courant", "maxCo", "Courant number"), ("courant_surface", "maxAlphaCo", "at the surface"),
          ("courant_air", "maxAirCo", "in air"), ("voidage_change", "maxVoidageChange", "change of voidage"))
QUALITY = (("volume_error", "volume error"), ("non_orthogonality_deg", "non-orthogonality in degrees"),
           ("skewness", "skewness"), ("volume_ratio", "volume ratio"))
NO_STEPS = "slurryFoam writes postProcessing/flow/START/steps.csv: run the flow with it."


def conservation(case: MillCase) -> Check:
    """Whether no slurry is missing."""
    name = "Slurry is conserved"
    columns = case.balance
    if columns is None:
        return Check(name, "unknown", "the flow ran without the function object slurryBalance",
                     "Add it to controlDict; see slurryBalance.H.")
    share = missing_share(columns)
    return judged(name, share, CONSERVED, f"at most {share:.1e} of the hold-up is missing (limit {CONSERVED:.0e})",
                  "Look in steps.csv for steps in which alpha is outside [0, 1] (alpha_min, alpha_max_minus_1), and "
                  "give the limiter more iterations (nLimiterIter).")


def averaged_time(case: MillCase) -> Check:
    """Whether samples cover all of the time of a MillCase's slurry.h5."""
    name = "The slurry's averages have no gap"
    missing = uncovered_share(case.slurry)
    if missing is None:
        return Check(name, "unknown", "slurry.h5 does not say which share of its time is missing",
                     "Run the flow with this version, beyond the start of its averages.")
    return judged(name, missing, GAP, f"{100 * missing:.2f} % of their time is missing (limit {100 * GAP:g} %)",
                  "Remove the flow and run it again: files of postProcessing/voxelAverages/segments were lost.",
                  meaning="Maps of the slurry and the force on balls are means of a part of the time")


def fed_as_asked(case: MillCase) -> Check:
    """Whether the inlet of a mill with a feed takes in what is asked."""
    name, asked = "Fed as asked", case.mill.flow("feed_m3_s")
    columns = case.balance
    if columns is None:
        return Check(name, "unknown", "the flow ran without the function object slurryBalance",
                     "Add it to controlDict; see slurryBalance.H.")
    error = feed_error(columns, asked)
    return judged(name, error, AS_ASKED, f"by the inlet's flux, what was fed differs by at most {error:.1e} from "
                  f"{1e6 * asked:.3g} ml/s (limit {AS_ASKED:.0e})",
                  "Look at the inlet's velocity (U in the times' folders): its flux times the patch's share of slurry "
                  "must be the feed of mill.yaml (flow.feed).")


def slurry_torques(case: MillCase) -> Check:
    """Whether walls and balls of a stirred mill give what changes the slurry's angular momentum."""
    assert isinstance(case, StirredCase)
    found = read_flow_torques(case)
    assert found.unbalanced is not None
    share = abs(found.unbalanced.value / found.impeller)
    return judged("The slurry's torques are balanced", share, TORQUES,
                  f"walls and balls give {1e3 * abs(found.unbalanced.value):.3g} mN m "
                  f"{'less' if found.unbalanced.value * case.mill.omega > 0 else 'more'} than the slurry takes: "
                  f"{100 * share:.2g} % of the impeller's torque on balls and slurry (limit {100 * TORQUES:.0f} %)",
                  "Take smaller cells (resolution.cell_size) and time-steps (flow.max_time_step).",
                  meaning="Torque and power of the impeller on the slurry have at least this error")


def column(case: MillCase, name: str) -> np.ndarray | None:
    """A column of steps.csv [steps]; None if it is missing or has no finite value."""
    steps = case.record.steps
    found = steps.get(name) if steps else None
    return found if found is not None and np.isfinite(found).any() else None


def courant(case: MillCase) -> Check:
    """Whether time-steps keep near the flow's limits, which they aim at."""
    name = "Time-steps keep near their aims"
    steps = case.record.steps
    if steps is None or len(steps["time_s"]) == 0:
        return Check(name, "unknown", "the flow has no steps.csv", NO_STEPS)
    # Flows of 0.2.0 and before have no column of the air, and no limit of it
    found = np.column_stack([steps.get(key, 0 * steps["time_s"]) for key, _, _ in LIMITS])
    limits = step_limits(case)
    if not np.isfinite(limits).any():
        return Check(name, "unknown", "flow.json has no limits of the time-step",
                     "Give maxCo, maxAlphaCo, maxAirCo and maxVoidageChange in controlDict (adjustTimeStep yes).")
    # NaN counts as beyond
    over = (~(found <= BEYOND * limits)).any(axis=1).mean()
    words = ", ".join(f"{what} {np.percentile(found[:, k], 95):.2g}"
                      + (f" (aim {limits[k]:g})" if np.isfinite(limits[k]) else "")
                      for k, (_, _, what) in enumerate(LIMITS))
    return judged(name, over, STEPS, f"{100 * over:.1f} % of the steps are beyond {BEYOND:g} times their aim (holds up "
                  f"to {100 * STEPS:g} %, fails above {100 * FAILING_STEPS:g} %); 95 % of the steps are below: {words}",
                  "Lower the aim that is passed (flow.max_courant, flow.max_voidage_change …) or flow.max_time_step.",
                  doubtful=FAILING_STEPS)


def step_limits(case: MillCase) -> np.ndarray:
    """Limits of the quantities of LIMITS [4] in flow.json's last start; infinite if there is none."""
    limits = case.record.last.get("limits") or {}
    return np.array([limits.get(key) or np.inf for _, key, _ in LIMITS], dtype=float)


def mesh(case: MillCase) -> Check:
    """Whether checkMesh finds no fault, with the mesh's quality."""
    name = "The mesh is sound"
    content = case.json(case.folder / "mesh.json", "mesh")
    quality = (content or {}).get("quality") or {}
    words = ", ".join(f"{what} {number(quality, 'mesh.json', key, 'value'):.3g} (limit "
                      f"{number(quality, 'mesh.json', key, 'limit'):.3g})" for key, what in QUALITY if key in quality)
    checked = case.json(case.folder / "check.json", "check")
    if checked is None:
        return Check(name, "unknown", f"checkMesh was not run (no check.json); {words}".rstrip("; "),
                     "Run Allrun's step check_mesh, which writes check.json.")
    if checked.get("ok") is True:
        return Check(name, "holds", words or "checkMesh found no fault")
    return Check(name, "fails", f"checkMesh found a fault, see log.check; {words}".rstrip("; "),
                 "Refine the mesh or change the lifters' section.")


def solids_on_mesh(case: MillCase) -> Check:
    """Whether the balls keep their volume on the flow's mesh."""
    name = "Balls on the flow's mesh keep their volume"
    found = column(case, "volume_correction")
    if found is None:
        return Check(name, "unknown", "steps.csv has no correction of the volume", NO_STEPS)
    share = 100 * np.nanmax(np.abs(found))
    return judged(name, share, CORRECTION, f"corrected by at most {share:.2g} % (limit {CORRECTION:g} %)",
                  "Average with the mill's walls (--inside), or on the flow's own mesh (--mesh).", doubtful=5)


def beyond_law(case: MillCase) -> tuple[float, float] | None:
    """Share of the slurry in the bed that is beyond the drag law's range: mean over the flow's time, and largest; None
    if steps.csv does not have it."""
    found = column(case, "beyond_law")
    if found is None:
        return None
    known = np.isfinite(found)
    return float(np.average(found[known], weights=case.record.steps["deltaT_s"][known])), float(found[known].max())


def drag_range(case: MillCase) -> Check:
    """Share of the slurry in the bed that is beyond the range of the drag law."""
    name = "The drag law is within its range"
    found = beyond_law(case)
    if found is None:
        return Check(name, "unknown", "steps.csv has no share of the slurry beyond the law's range",
                     NO_STEPS)
    share = 100 * found[0]
    return judged(name, share, OUT_OF_RANGE, f"{share:.1f} % of the slurry in the bed is beyond {case.law}'s range "
                  f"(limit {OUT_OF_RANGE:g} %)", "Compare with a law of another range (millDrag --ranges, flow.law).",
                  doubtful=50,
                  meaning="beyond the range the drag is extrapolated; another law shows how much that matters")


def yield_stress(case: MillCase) -> Check:
    """Whether slurry that hardly moves keeps its yield stress, although its viscosity has a largest value."""
    name, slurry = "Slow slurry keeps its yield stress", case.mill.slurry
    if slurry("yield_stress_Pa") == 0:
        return Check(name, "holds", "it has none")
    below = slurry("yield_stress_Pa") / ((case.mill.viscosity_ratio - 1) * slurry("plastic_viscosity_Pa_s"))
    return judged(name, below, SLOWEST_YIELD,
                  f"below a shear rate of {below:.2g} 1/s (limit {SLOWEST_YIELD:g} 1/s) it is a liquid of "
                  f"{case.mill.viscosity_ratio * slurry('plastic_viscosity_Pa_s'):.2g} Pa s",
                  "Raise slurry.viscosity_ratio; the flow may need more time.", doubtful=10 * SLOWEST_YIELD,
                  meaning="where slurry is sheared more slowly, it flows although it should not")


def drag_viscosity(case: MillCase) -> Check:
    """Whether drag by the plastic viscosity is near that by the apparent viscosity of the slurry in the pores.

    The pores shear at 12 phi v/((1 - phi) d), with the root mean square v of the slip and a solidity phi of 0.5.
    """
    name = "The drag has the slurry's viscosity"
    if case.mill.slurry("yield_stress_Pa") == 0:
        return Check(name, "holds", "the slurry has no yield stress, so its viscosity is the plastic one")
    if case.mill.flow("viscosity") == "pore":
        return Check(name, "holds", "the drag takes that in the pores (flow.viscosity)")
    slip = column(case, "slip_m_per_s")
    if slip is None or not np.nanmax(slip) > 0:
        return Check(name, "unknown", "steps.csv has no slip between slurry and balls", NO_STEPS)
    speed = float(np.sqrt(np.nanmean(slip ** 2)))
    rate = 12 * speed / case.mill.sauter_diameter
    yields = case.mill.slurry("yield_stress_Pa") / case.mill.slurry("plastic_viscosity_Pa_s")
    apparent = 1 + min(yields / rate, case.mill.viscosity_ratio - 1)
    return judged(name, apparent, APPARENT, "the drag takes the plastic viscosity; with a slip of "
                  f"{speed:.2g} m/s (rms) the pores shear at {rate:.3g} 1/s, where the slurry has {apparent:.3g} times "
                  f"as much (limit {APPARENT:g})", "Compare with flow.viscosity: pore.", doubtful=3,
                  meaning="slurry passes slowly between the balls more easily than it should")


def continuity(case: MillCase) -> Check:
    """Whether the balls' averaged solidity and velocity agree, so that they drive no flow of their own."""
    name = "The balls' averages are continuous"
    speed, slip = column(case, "continuity_speed_m_per_s"), column(case, "slip_m_per_s")
    if speed is None or slip is None:
        return Check(name, "unknown", "steps.csv has no residual of the solids' continuity", NO_STEPS)
    share = 100 * np.nanmean(speed) / np.nanmean(slip)
    return judged(name, share, CONTINUITY, f"what is missing drives the slurry at {share:.1f} % of its slip (limit "
                  f"{CONTINUITY:g} %)", "Take shorter windows (averages.window), or voxels nearer to the flow's cells.",
                  doubtful=40,
                  meaning="averages on voxels and windows do not conserve the balls at every time; the slurry makes "
                          "room for balls that are not there")


def one_way(case: MillCase) -> Check:
    """Whether the slurry would not move the balls, as one-way coupling assumes."""
    name = "The slurry would not move the balls"
    load = case.load
    if load is None:
        return Check(name, "unknown", "the flow did not write the force on the balls",
                     "Give ballDensity in constant/bedProperties.")
    mean, high = load
    return judged(name, np.max([mean / LIGHT, high / HEAVY]), 1,
                  f"its force over their weight has the mean {mean:.2f} (limit {LIGHT}) and is below {high:.2f} for "
                  f"95 % of the balls (limit {HEAVY})",
                  "The coupling is one-way: where the force is close to the weight, do not trust the charge's shape.",
                  doubtful=1 / HEAVY,
                  meaning="the numbers hold for a charge that the slurry does not move; where it would, charge and "
                          "slurry have other shapes")
