# SPDX-License-Identifier: GPL-3.0-or-later
"""Whether a run is reliable: what the checks found, and what to do if they fail."""
from ..files.mill_case import MillCase
from ..readings.residence import tracer_names
from .charge_checks import (averaging_volume, charge_steadiness, contact_balance, follows_shell, ledger, lost_balls,
                            overlap, torque_balance, window_noise)
from .coupling_section import coupling_checks
from .flow_checks import (averaged_time, conservation, continuity, courant, drag_range, drag_viscosity, fed_as_asked,
                          mesh, one_way, slurry_torques, solids_on_mesh, yield_stress)
from .stages import same_mill
from .steadiness import flow_steadiness
from .tracer_checks import mean_time, tracer_bounds
from .verdict import Check

ORDER = ("fails", "look", "unknown", "holds")


def all_checks(case: MillCase) -> list[Check]:
    """The checks that a MillCase's parts allow; failed ones are first."""
    functions = [same_mill]
    if case.flow:
        functions += [conservation, flow_steadiness, courant, mesh, yield_stress]
        functions += [averaged_time] if case.slurry else []
        functions += [fed_as_asked] if case.mill.flow("feed_m3_s", 0.0) else []
        functions += [tracer_bounds, mean_time] if tracer_names(case.folder) else []
        functions += [slurry_torques] if "torque_balls" in (case.balance or {}) else []
    if case.results:
        functions += [lost_balls, charge_steadiness, overlap]
        # Slurry that the balls feel takes a part of the torque
        dry = case.results.get("part_torques_Nm") and not case.results.get("fluid")
        functions += [torque_balance] if dry else []
        functions += [contact_balance] if case.results.get("contacts") else []
    if case.solids:
        functions += [follows_shell, ledger, averaging_volume, window_noise]
    if case.flow and case.law:
        functions += [solids_on_mesh, continuity, drag_range, drag_viscosity]
        functions += coupling_checks(case) if case.coupled else [one_way]
    checks, unusable = [], []
    for function in functions:
        try:
            checks.append(function(case))
        except (RuntimeError, OSError, KeyError) as error:
            unusable.append(str(error))
    checks += [Check("All files can be used", "fails", reason, "Make the file again, or remove it.")
               for reason in dict.fromkeys([*case.unusable, *unusable])]
    return sorted(checks, key=lambda check: ORDER.index(check.state))
