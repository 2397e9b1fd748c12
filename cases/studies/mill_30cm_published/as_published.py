# SPDX-License-Identifier: GPL-3.0-or-later
"""Whether a flow of the study may be judged as the published one: it begins with as much slurry, and balls that feel it
get the force that the flow has for them."""
from millfoam.report.coupling_section import coupling_of, has_settled, momentum_balances

from flow_numbers import Flow
from runs import ITERATED, is_published

# Share by which slurry at first may differ from that of the published flows. Those lose up to as much in 5 s: their own
# numbers are means over such a change
OTHER = 0.1


def other_slurry(flow: Flow, flows: dict[str, Flow]) -> str:
    """Why a flow with balls that is not published begins with another volume of slurry than the published ones with
    balls at its speed, which begin at the published level between balls at rest; or an empty text."""
    if is_published(flow.run):
        return ""
    published = [one for one in flows.values()
                 if is_published(one.run) and one.run.law and one.run.speed == flow.run.speed]
    if not published:
        return f"no published flow with balls at {flow.run.speed} % is complete, whose slurry at first it should have"
    own, theirs = (1e3 * one.holdup[0] for one in (flow, published[0]))
    if abs(own - theirs) <= OTHER * theirs:
        return ""
    return f"it begins with {own:.2f} l of slurry, {published[0].run.name} with {theirs:.2f}"


def other_force(flow: Flow) -> str:
    """Why balls that feel the slurry of a flow do not get the force that its own balance of momentum has for them, or
    passes of balls and slurry in turn still change, by the report's checks; or an empty text, also where balls do not
    feel it."""
    if not flow.run.feels_slurry:
        return ""
    if flow.case.coupled is None:
        return "its balls' forces are not known: there is no coupling.json of it"
    if ITERATED in flow.run.changes:
        check = has_settled(flow.case)
        return "" if check.state == "holds" else check.found
    if coupling_of(flow.case).get("force_unbalanced") is None:
        return ("its balls' forces are not known: its slurryBalance has no force_balance_x_N, which flows have since "
                "version 4ab5dae1; before, the force of the pressure on balls was up to 10 % too large")
    check = momentum_balances(flow.case)
    return "" if check.state == "holds" else check.found


def why_withheld(flow: Flow, flows: dict[str, Flow]) -> str:
    """Why no published statement is decided by a flow with balls: other_slurry among the flows of the study by name,
    other_force; or an empty text."""
    return "; ".join(filter(None, (other_slurry(flow, flows), other_force(flow))))
