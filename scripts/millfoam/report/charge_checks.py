# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks of a dry run and of its averages."""
import h5py
import numpy as np

from ..files.data_files import entry
from ..files.mill_case import MillCase
from ..readings.charge import shell_following
from .verdict import Check, judged

LEDGER = 0.01  # of the balls' volume that may lie outside or be clipped
FOLLOWS, SLIDES = 0.8, 0.5  # speed of the balls at the shell over its own: a charge that follows it, one that slides
CONTACTS, CONTACTS_DOUBTFUL = 0.01, 0.05  # of the drive's power that may be missing in the contacts
TORQUES, TORQUES_DOUBTFUL = 0.03, 0.1  # of the impeller's torque that may be missing on the walls at rest
EARLY, TOO_EARLY = 0.01, 0.5  # of the averaged time that may lie before the charge is steady; not even doubtful
NOISE = 0.05  # of a window's mean solidity by chance


def known_result(case: MillCase, key: str, above: float = -np.inf) -> float:
    """A number of results.json; RuntimeError if it is null, or not above a limit."""
    value = case.result(key)
    if not value > above:
        shown = "null" if np.isnan(value) else f"{value:g}"
        raise RuntimeError(f"{case.dry}/results.json: {key} = {shown}; expected a number"
                           + (f" above {above:g}" if np.isfinite(above) else ""))
    return value


def lost_balls(case: MillCase) -> Check:
    """Whether all balls stayed in the mill."""
    lost, balls = (known_result(case, key) for key in ("lost_balls", "balls"))
    return judged("No ball is lost", lost, 0, f"{lost:.0f} of {balls:.0f} lost",
                  "Shorten the time-step (dem.rayleigh_fraction) or look for holes in the walls (millMesh surface).")


def charge_steadiness(case: MillCase) -> Check:
    """Whether the dry run is steady before its averages begin."""
    name = "The charge is steady where it is averaged"
    if not case.results.get("steady"):
        return Check(name, "fails", "power or energies of the balls did not become steady",
                     "Let it run longer (dem.duration, millDem --resume).")
    since = case.result("steady_from_s")
    found = f"steady from {since:.2f} s on"
    if not case.solids:
        return Check(name, "holds", found)
    begin, end = case.charge_span
    return judged(name, (since - begin) / (end - begin), EARLY, f"{found}; averages from {begin:.2f} s (limit "
                  f"{100 * EARLY:.0f} % of their time)",
                  "Begin the averages later (--begin), or the flow at a later DEM time.", doubtful=TOO_EARLY)


def follows_shell(case: MillCase) -> Check:
    """Whether the charge turns with the shell, or slides on it."""
    name = "The charge follows the shell"
    try:
        share = shell_following(case.charge, case.radius, case.omega)
    except RuntimeError as error:
        return Check(name, "unknown", str(error))
    return judged(name, FOLLOWS / max(share, 1e-9), 1,
                  f"balls at the shell have {100 * share:.0f} % of its speed (limit {100 * FOLLOWS:.0f} %)",
                  "The charge slides on the shell. Check friction and, in a smooth drum, rolling friction of balls and "
                  "wall (materials.ball_wall).", doubtful=FOLLOWS / SLIDES)


def overlap(case: MillCase) -> Check:
    """Whether balls overlap so little that their softness does not matter."""
    diameter = known_result(case, "smallest_diameter_m", above=0)
    share = case.result("ball_overlap_largest_m") / diameter
    usual = case.result("ball_overlap_99_m") / diameter
    allowed = case.result("allowed_overlap")
    return judged("Balls are stiff enough", share, allowed,
                  f"largest overlap {100 * share:.1f} % of the smallest diameter (limit {100 * allowed:.0f} %), 99 % "
                  f"of the contacts below {100 * usual:.2f} %",
                  "Raise dem.youngs_modulus, or lower dem.largest_overlap.")


def contact_balance(case: MillCase) -> Check:
    """Whether the contacts dissipate the drive's power minus the charge's gain of energy."""
    ratio = case.result("contacts", "dissipated_over_drive")
    return judged("Contacts dissipate what the drive gives", abs(ratio - 1), CONTACTS,
                  f"{ratio:.4f} of the drive's power minus the gain of the charge's energy (limit "
                  f"{100 * CONTACTS:.0f} %)",
                  "Shorten the time-step (dem.rayleigh_fraction), or let the steady part be longer (dem.duration).",
                  doubtful=CONTACTS_DOUBTFUL)


def torque_balance(case: MillCase) -> Check:
    """Whether the walls at rest of a stirred mill take the torque of its impeller."""
    torques = {part: case.result("part_torques_Nm", part) for part in case.results["part_torques_Nm"]}
    at_rest = sum(torque for part, torque in torques.items() if part != "impeller")
    ratio = -at_rest / torques["impeller"]
    return judged("Walls at rest take the impeller's torque", abs(ratio - 1), TORQUES,
                  f"their torque is {ratio:.4f} of the impeller's (limit {100 * TORQUES:.0f} %)",
                  "Let the run be longer (dem.duration): the balls still gain or lose angular momentum.",
                  doubtful=TORQUES_DOUBTFUL)


def ledger(case: MillCase) -> Check:
    """Whether the balls' volume lies in the averages."""
    with h5py.File(case.solids) as file:
        into, outside, clipped = (file[f"ledger/{key}"][:] for key in ("volume_in", "outside", "clipped"))
    share = ((outside + clipped) / into).max()
    return judged("Balls are in the averages", share, LEDGER,
                  f"in a window, at most {100 * share:.2g} % of their volume is outside or moved to neighbours "
                  f"(limit {100 * LEDGER:.0f} %)",
                  "Take voxels that cover the mill (--box), and give its walls (--inside).")


def averaging_volume(case: MillCase) -> Check:
    """Whether a voxel holds as many balls as the volumes from which the drag laws were derived."""
    name = "Averaging volumes hold enough balls"
    if case.averages is None:
        return Check(name, "unknown", f"no summary next to {case.solids.name}",
                     "Average the dumps again (millAverage).")
    balls = entry(case.averages, case.solids, "balls_per_cell")
    fewest, most = entry(case.averages, case.solids, "balls_of_laws")
    found = f"{balls:.1f} balls in an occupied cell (the drag laws were derived from {fewest:g} to {most:g})"
    if balls > most:
        return Check(name, "look", found, "Finer voxels would show more of the charge.")
    return judged(name, fewest / balls, 1, found,
                  "Take larger voxels or --smooth; in small voxels a law sees single balls.", doubtful=8)


def window_noise(case: MillCase) -> Check:
    """Random error of the mean solidity of a window."""
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
    return judged(name, share, NOISE, f"in the dense charge a window's mean solidity has a random error of "
                  f"{100 * share:.1f} % if its records are independent (limit {100 * NOISE:.0f} %)",
                  "Take longer windows (--window) or record more often (dem.record_interval).", doubtful=2 * NOISE)
