# SPDX-License-Identifier: GPL-3.0-or-later
"""Section of the report about the mill's power: net, specific, and among the classical models."""
from collections.abc import Callable

import numpy as np

from ..files.mill_case import MillCase
from ..readings import power_models
from ..readings.batches import whole_turns
from ..readings.means import Mean, time_mean
from ..readings.mill_power import (charge_power, drive_power, feels_slurry, known_balance, lies_in_pool,
                                   slurry_power)
from . import page
from .case_readings import Readings
from .coupling_section import coupling_of
from .words import reach_words, uncertain

FEWEST = 2  # whole turns of the flow with powers of slurry and drive


def power_section(case: MillCase, _readings: Readings) -> list[str]:
    """Cards of the net power and of the models; none without a dry run's results."""
    if not case.results:
        return []
    found = powers(case)
    return [page.table(["", "power", "for each metre of the mill", "for each kilogram of balls"],
                       [specific(case, name, power) for name, power in found.items()], title="Net power",
                       note=net_note(case)), models_table(case, found)]


def powers(case: MillCase) -> dict[str, Mean]:
    """Name -> Mean (W) of the charge's power, and with a flow of FEWEST turns or more the slurry's and, if it is known,
    the drive's."""
    of_flow = {"slurry": slurry_power(case, FEWEST), "drive": drive_power(case, FEWEST)}
    return {"charge": charge_power(case)} | {name: power for name, power in of_flow.items()
                                             if np.isfinite(power.value)}


def specific(case: MillCase, name: str, power: Mean) -> tuple[str, ...]:
    """Row of a power: name, W, W/m and W/kg with their errors, W also with reach_words: the degrees of freedom differ
    from row to row."""
    mass = case.mill.derived("charge", "mass_kg")
    watts, *others = (uncertain(power.value / over, power.error / over, unit)
                      for over, unit in ((1.0, "W"), (case.length, "W/m"), (mass, "W/kg")))
    return name, watts + reach_words(power, "W"), *others


def net_note(case: MillCase) -> str:
    """What the powers are."""
    words = charge_words(case)
    if case.flow:
        turns = (whole_turns(min(case.balance["Time"][-1], case.last) - case.begin, case.turn)
                 if case.balance is not None else 0)
        sources = "walls and balls" if case.has_balls else "the walls"
        words += f" Slurry: the torque of {sources} on it, times the mill's speed. Drive: {drive_words(case)}"
        means, of = (("The slurry's is a mean", "the slurry") if case.has_balls and lies_in_pool(case) else
                     ("Both are means", "slurry and drive"))
        words += (f" {means} over {turns} whole turns of the flow." if turns >= FEWEST else
                  f" The power of {of} needs two whole turns; this flow has {turns}.")
    return f"{words} ±: standard errors over time.{torque_words(case)}"


def charge_words(case: MillCase) -> str:
    """What the charge's power is."""
    if not case.has_balls:
        run = "a run in a pool at rest" if lies_in_pool(case) else "the dry run"
        return f"Charge: what the walls give to the balls of {run}, which are not in this flow."
    if lies_in_pool(case):
        return "Charge: what the walls give to the balls, which feel the buoyancy of a pool at rest."
    return "Charge: what the walls give to the balls."


def drive_words(case: MillCase) -> str:
    """What the drive's power is, of a case with a flow."""
    if not case.has_balls:
        return "what the walls give to the slurry."
    if lies_in_pool(case):
        return "not known, because what moves the pool at rest is not known."
    if feels_slurry(case):
        return "what the walls give to balls and slurry; the balls pass a part of theirs on to the slurry."
    return "both together; the balls do not feel the slurry, and keep what they give to it."


def torque_words(case: MillCase) -> str:
    """The error of the drive's power, in words, from the torques of balls and slurry on each other, which should
    balance; empty if these are not known."""
    content = coupling_of(case) if case.coupled is not None else {}
    found = [f"{uncertain(100 * abs(content[key]), 100 * (content.get(f'{key}_error') or 0.0), '%', '.1f')} of {whole}"
             for key, whole in (("torque_disagreement", "the drive's torque on the balls (flow and balls)"),
                                ("torque_unbalanced", "the drive's torque (balls and the slurry's own balance)"))
             if content.get(key) is not None]
    return (f" Not in ±: the torque between balls and slurry does not balance, by {' and '.join(found)}; the drive's "
            "power has an error of this size." if found else "")


def models_table(case: MillCase, found: dict[str, Mean]) -> str:
    """Card of the models: the dry charge and, with a flow through it, the charge with the slurry that is in its pores,
    and with the pool of what does not fit into them."""
    mill = case.mill
    solidity, pores = (mill.derived("charge", key) for key in ("resting_solidity", "pore_volume_m3"))
    kinds = [] if feels_slurry(case) or lies_in_pool(case) else [
        (", dry", found["charge"], power_models.bulk_density(mill.ball_density, solidity))]
    held = 0.0
    if "drive" in found and case.has_balls:
        columns = known_balance(case, FEWEST)
        assert columns is not None
        held = time_mean(columns["Time"], columns["holdUp"], case.begin)
        filled = power_models.pores_filled(held, pores)
        kinds.append((f", pores filled to {100 * filled:.0f} %", found["drive"], power_models.bulk_density(
            mill.ball_density, solidity, mill.slurry("density_kg_m3"), filled)))
    mass, diameter = mill.derived("charge", "mass_kg"), 2 * case.radius
    filling = power_models.filling_of(mass, mill.ball_density, solidity, diameter, case.length)
    size = diameter, case.length, mill.critical_share, filling
    rows = []
    for words, simulated, density in kinds:
        rows += [(f"Hogg & Fuerstenau, {power_models.REPOSE:g}°{words}",
                  *against(lambda: power_models.hogg_fuerstenau(*size, density), simulated)),
                 (f"Morrell, C-model{words}",
                  *against(lambda: power_models.morrell(*size, density).net, simulated))]
    if not kinds:
        return page.paragraph("The power is not compared with models: " + (
            "the balls lie in a pool at rest, and what moves it is not known." if lies_in_pool(case) else
            "the balls feel the slurry, and the flow was averaged over fewer than two turns."))
    if held > pores:
        rows.append((f"Morrell, C-model{kinds[-1][0]}, with its pool", *against(
            lambda: power_models.morrell(*size, kinds[-1][2], mill.slurry("density_kg_m3"), overflow=True).net,
            kinds[-1][1])))
    rows.append(("Bond", *against(lambda: power_models.bond(diameter, *size[2:], mass),
                                  kinds[-1][1])))
    return page.table(["", "power by the model", "simulated over it"], rows, title="Power among the models",
                      note="The models were fitted to mills of metres with steel balls and their lifters. For a "
                           "laboratory mill they give the order of size. Morrell's is without the losses that he adds "
                           "(26 %); Bond's is at the pinion of a wet mill. Filled pores: the slurry in the mill over "
                           "the pores of the resting charge (by charge.packing), at most 100 %. With its pool: what "
                           "does not fit into the pores is the pool of Morrell's overflow mill, whatever its volume. "
                           "The filling is the charge's bulk over the volume of the shell, without regard to lifters."
                           + outside(size))


def outside(size: tuple[float, float, float, float]) -> str:
    """Models out of whose range a mill of a size (diameter, length, m, speed, filling) is, in words."""
    diameter, _, speed, filling = size
    found = {name: mills.outside(diameter, speed, filling) for name, mills in power_models.RANGES.items()}
    return "".join(f" Outside of the range of {name}: {'; '.join(words)}."
                   for name, words in found.items() if words)


def against(model: Callable[[], float], simulated: Mean) -> tuple[str, str]:
    """A model's power in words, and the simulated power over it; why, if the model cannot have this mill."""
    try:
        power = model()
    except ValueError as error:
        return str(error), "–"
    return f"{power:.3g} W", f"{simulated.value / power:.2f}"
