# SPDX-License-Identifier: GPL-3.0-or-later
"""Readings of a case's maps and tables, once for all sections, and the key numbers."""
from collections.abc import Callable
from typing import Any

import numpy as np

from ..files.mill import Mill
from ..files.mill_case import MillCase
from ..files.slurry_file import SlurryMap
from ..readings import axial, charge
from ..readings.axial import humps_at_ends
from ..readings.batches import mean_over_turns, whole_turns
from ..readings.means import CORRELATED, Mean, Reading, time_mean
from ..readings.mill_power import UNKNOWN, charge_power, feels_slurry, lies_in_pool
from ..readings.slurry_over_time import Way, mean_slurry, read_series, slurry_blocks, slurry_way
from .words import millilitres, reach_words, uncertain

Rows = list[tuple[str, str]]  # of a table: name and text
# Of charge.charge_with_errors, in words
READINGS = {"centre": "the centre of circulation", "ends": "toe and shoulder", "surface_rmsd": "the free surface",
            "tangential_rmsd": "the tangential velocity"}
FRAME = ("Distances x are positive to the side where the shell falls, which is the right side of a clockwise mill, so "
         "that both senses give the same numbers. Maps show the mill as it turns, with x to the right.")


def to_falling_side(case: MillCase, x: float) -> float:
    """A distance x (m) in the frame of the rotation: positive to the side where the shell falls."""
    return -np.sign(case.omega) * x


class Readings:
    """Readings of a case's maps, once for all sections and comparisons; a failed reading is its error's text."""

    def __init__(self, case: MillCase) -> None:
        self.case = case
        self.charge = self.attempt(lambda: charge.read_charge(case.charge, case.radius)) if case.solids else None
        self.errors = self.attempt(self._errors) if isinstance(self.charge, charge.Charge) else None
        # Blocks are read once for the mean and for its errors
        self.blocks = self.attempt(lambda: list(slurry_blocks(case))) if case.flow else None
        self.slurry = self.attempt(lambda: mean_slurry(case, self.blocks)) if isinstance(self.blocks,
                                                                                         list) else self.blocks
        self.way = self.attempt(self._way) if isinstance(self.slurry, SlurryMap) else None
        self.series = self.attempt(self._series) if case.flow else None
        self.profile = self.attempt(lambda: axial.mean_profile(self.series)) if isinstance(
            self.series, axial.AxialSeries) else self.series
        self.humps = {}
        if isinstance(self.profile, axial.AxialProfile):
            for count in (2, 3):
                if len(self.profile.z) >= 3 * count + 3:
                    self.humps[count] = self.attempt(lambda: axial.fit_gaussians(self.profile.z, self.profile.height,
                                                                                 count))

    @staticmethod
    def attempt(read: Callable[[], Any]) -> Any:
        """The result of read(), or the text of the error that it raises."""
        try:
            return read()
        except (RuntimeError, ValueError) as error:
            return str(error)

    def error(self, name: str, k: int = 0) -> float:
        """Standard error of a reading of the charge over time; NaN if it is not known."""
        return np.atleast_1d(self.errors[name].error)[k] if isinstance(self.errors, dict) else np.nan

    def short_blocks(self, slurry: bool = True) -> str:
        """In words, that errors of the charge (and, if requested, of the slurry) are lower bounds, because their
        blocks of time are shorter than a turn of the mill, and blocks of the charge without a reading; otherwise
        empty."""
        case, lengths, failed = self.case, {}, ""
        if isinstance(self.errors, dict):
            centre = self.errors["centre"]
            lengths["the charge's"] = np.ptp(case.charge_span) / (centre.blocks + centre.failed)
            failed = "".join(f" {one.failed} of {one.blocks + one.failed} blocks have no reading of {READINGS[name]}."
                             for name, one in self.errors.items() if one.failed)
        if slurry and isinstance(self.blocks, list):
            lengths["the slurry's"] = (case.last - case.begin) / len(self.blocks)
        short = [f"{name} of {length:.2g} s" for name, length in lengths.items() if length < 0.99 * case.turn]
        return (f" Blocks shorter than a turn of the mill ({case.turn:.2g} s) give lower bounds of errors: "
                f"{', '.join(short)}."
                if short else "") + failed

    def _errors(self) -> dict[str, Reading] | None:
        maps = self.case.charge_windows
        return charge.charge_with_errors(maps, self.case.radius) if len(maps) >= 4 else None

    def _way(self) -> Way:
        """slurry_over_time.Way by blocks of time, or of the mean if a block has no reading."""
        try:
            return slurry_way(self.blocks, self.case.radius, self.case.lifter_height)
        except RuntimeError:
            return slurry_way([self.slurry], self.case.radius, self.case.lifter_height)

    def _series(self) -> axial.AxialSeries:
        """AxialSeries from the function object's tables, or otherwise from the written times."""
        series = read_series(self.case)
        if len(series.times) == 0:
            raise RuntimeError(f"axialProfiles has no time from {self.case.begin:g} s on")
        return series


def key_numbers(case: MillCase, readings: Readings) -> Rows:
    """Rows (name, text) of the key numbers."""
    rows = []
    if case.results:
        power = charge_power(case)
        rows.append((power_name(case), uncertain(power.value, power.error, "W")))
    if case.has_balls:
        rows += load_numbers(case.mill)
    if isinstance(readings.charge, charge.Charge):
        rows += charge_numbers(readings)
    if case.balance is not None:
        rows += balance_numbers(case)
    if isinstance(readings.profile, axial.AxialProfile) and len(readings.profile.z) > 2 and not case.is_slice:
        of_turns = axial.drop_over_turns(readings.series, case.begin, case.turn) or UNKNOWN
        rows.append(("drop of p_rgh in the slurry along the axis (straight line)", flow_number(
            case, Mean(axial.drop(readings.profile), of_turns.error, of_turns.freedom), "Pa")))
    for count, fit in readings.humps.items():
        if isinstance(fit, axial.Humps):
            rows.append((f"axial profile, {count} Gaussians", humps_words(fit, readings.profile.z)))
    return rows


def power_name(case: MillCase) -> str:
    """Name of the power of a case's charge: what its balls felt, and whether they are in its flow."""
    kind = ("charge in the slurry" if feels_slurry(case) else "charge in a pool at rest" if lies_in_pool(case)
            else "dry charge")
    return f"power of the {kind}" + ("" if case.has_balls else ", which is not in this flow")


def slurry_turns(case: MillCase) -> int:
    """Whole turns of the flow from which the slurry's means have their errors."""
    return whole_turns(case.last - case.begin, case.turn)


def flow_mean(case: MillCase, times: np.ndarray, values: np.ndarray) -> Mean:
    """Mean of a flow's values [n] at times [n] (s) over the averaged time, with the error of its whole turns, which is
    NaN if fewer than two fit."""
    of_turns = mean_over_turns(times, values, case.begin, case.turn) or UNKNOWN
    return Mean(time_mean(times, values, case.begin), of_turns.error, of_turns.freedom)


def flow_number(case: MillCase, mean: Mean, unit: str, scale: float = 1.0, form: str = ".3g") -> str:
    """A flow_mean times `scale` in words, with flow_reach."""
    return uncertain(scale * mean.value, abs(scale) * mean.error, unit, form) + flow_reach(case, mean, unit, scale)


def flow_reach(case: MillCase, mean: Mean, unit: str, scale: float = 1.0) -> str:
    """reach_words of a flow_mean over CORRELATED turns or more. Empty for fewer: the note about the errors of the flow
    has one factor for all of them."""
    return reach_words(mean, unit, scale) if slurry_turns(case) >= CORRELATED else ""


def humps_words(fit: axial.Humps, z: np.ndarray) -> str:
    """Distances and RMSD of axial.Humps on slices z (m), and whether they are at the profile's end."""
    apart = ", ".join(f"{1e3 * d:.0f}" for d in fit.distances)
    ended = humps_at_ends(fit, z)
    at_end = f"; {ended} of {len(fit.places)} at the profile's end: their distance is only the profile's span"
    words = at_end if ended else ""
    return f"{apart} mm apart, RMSD {1e3 * fit.rmsd:.2g} mm{words}"


def load_numbers(mill: Mill) -> Rows:
    """Rows of the mill's load: as simulated, and as requested if that is more."""
    rows = [("load of balls", f"{100 * mill.load:.3g} %")]
    if mill.fines_share > 0:
        rows = [("load of balls, as simulated", f"{100 * mill.load:.3g} %"),
                ("load of balls, as requested", f"{100 * mill.load_asked:.3g} %"),
                (f"left out: balls of {1e3 * mill.largest_fines:.3g} mm and less",
                 f"{100 * mill.fines_share:.3g} % of the mass")]
    return rows


def charge_numbers(readings: Readings) -> Rows:
    """Rows of the charge's readings, with standard errors over time."""
    found, error, x = readings.charge, readings.error, to_falling_side(readings.case, readings.charge.centre[0])
    return [("centre of circulation, x to the falling side", uncertain(1e3 * x, 1e3 * error("centre", 0), "mm")),
            ("centre of circulation, y", uncertain(1e3 * found.centre[1], 1e3 * error("centre", 1), "mm")),
            ("shoulder of the charge", uncertain(found.shoulder, error("ends", 1), "°")),
            ("toe of the charge", uncertain(found.toe, error("ends", 0), "°")),
            ("free surface, RMSD of the logistic", uncertain(1e3 * found.surface.rmsd, 1e3 * error("surface_rmsd"),
                                                             "mm")),
            ("tangential velocity, RMSD of the cubic", uncertain(found.tangential.rmsd, error("tangential_rmsd"),
                                                                 "m/s"))]


def balance_numbers(case: MillCase) -> Rows:
    """Rows of slurryBalance's means over the averaged time; none before it begins."""
    columns, late = case.balance, case.balance["Time"] >= case.begin
    if not late.any():
        return []

    def number(values: np.ndarray, unit: str, scale: float = 1.0, form: str = ".3g") -> str:
        return flow_number(case, flow_mean(case, columns["Time"], values), unit, scale, form)
    held = flow_mean(case, columns["Time"], columns["holdUp"])
    rows = [("hold-up of slurry", millilitres(held.value, 4, held.error) + flow_reach(case, held, "ml", 1e6)),
            ("centre of the slurry, x to the falling side", number(columns["x"], "mm", to_falling_side(case, 1e3))),
            ("centre of the slurry, y", number(columns["y"], "mm", 1e3)),
            ("power for the slurry", number(columns["power"], "W"))]
    if case.is_open and not case.is_slice:
        rows += [(name, number(values, "ml/s", 1e6, ".1f")) for name, values in (
            ("feed", columns["feed"]), ("discharge", columns["discharge"]),
            ("feed minus discharge", columns["feed"] - columns["discharge"]))]
    if case.met_balls:
        rows += [(name, number(columns[key], "", form=".0f")) for name, key in (
            ("particle Reynolds number in slurry, mean", "Re_mean"),
            ("particle Reynolds number, 95 % of the balls below", "Re_95"))]
    return rows
