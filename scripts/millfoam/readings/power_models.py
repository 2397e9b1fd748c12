# SPDX-License-Identifier: GPL-3.0-or-later
"""Classical models of the power of a tumbling mill, each as published, in SI units."""
from dataclasses import dataclass

import numpy as np

from ..files.constants import GRAVITY

FOOT = 0.3048
TONNE = 1000.0
OVERFLOW_TOE = 3.395  # rad, of a pool's surface in an overflow mill (Morrell 1996)
TOE = 2.5307, 1.2796, 19.42  # of its angle: 2.5307 (1.2796 - J) and the steepness in speed (Morrell 1996)
REPOSE = 35.0  # deg, usual angle of a charge's lift in Hogg & Fuerstenau's model


@dataclass(frozen=True)
class MillRange:
    """Range of the mills with whose measured power a model was compared: least and largest diameter inside the liners,
    m, speed over the critical speed, and filling. None: an end, or both, that the sources at hand do not give."""
    diameter: tuple[float | None, float | None]
    speed: tuple[float, float] | None
    filling: tuple[float, float] | None

    def outside(self, diameter: float, speed: float, filling: float) -> list[str]:
        """What of a mill lies outside of it, in words, as "diameter 0.3 m, range 3.2 to 12.2 m"."""
        words = []
        for name, value, ends, unit in (("diameter", diameter, self.diameter, " m"), ("speed", speed, self.speed, ""),
                                        ("filling", filling, self.filling, "")):
            least, most = ends or (None, None)
            if (least is not None and value < least) or (most is not None and value > most):
                span = f"up to {most:g}" if least is None else f"{least:g} to {most:g}"
                words.append(f"{name} {value:.3g}{unit}, range {span}{unit}")
        return words


# A. G. Doll, An updated data set for SAG mill power model calibration, XXVIII Int. Mineral Processing Congress (2016),
# paper 123, table 1: 19 surveys of semi-autogenous and autogenous mills, read in a transcription
SURVEYS = {"speed": (0.645, 0.889), "filling": (0.179, 0.425)}
# By model. Morrell's also with 14 dry ball mills of 3.2 to 4.8 m: O. Erdem, S. L. Ergun & H. Benzer, Physicochem.
# Probl. Miner. Process. 38 (2004) 221. Rowland & Kjos add power above 3.3 m, which `bond` leaves out
RANGES = {"Hogg & Fuerstenau": MillRange((4.71, 12.2), **SURVEYS),
          "Morrell": MillRange((3.2, 12.2), **SURVEYS),
          "Bond": MillRange((None, 3.3), None, None)}


@dataclass(frozen=True)
class MorrellPower:
    """Power of Morrell's C-model, W: potential and kinetic, which the charge takes, and that of the empty mill; angles
    of toe and shoulder from the horizontal on the rising side, against the turn, rad; inner: radius of the charge's
    inner surface, m."""
    potential: float
    kinetic: float
    no_load: float
    toe: float
    shoulder: float
    inner: float

    @property
    def net(self) -> float:
        """Power that the charge takes, W, without the losses that the model adds to it."""
        return self.potential + self.kinetic


def require_share(name: str, value: float, most: float) -> None:
    """ValueError unless a share is above 0 and at most `most`."""
    if not 0 < value <= most:
        raise ValueError(f"{name} is {value:g}; expected a share above 0 and at most {most:g}")


def filling_of(mass: float, density: float, solidity: float, diameter: float, length: float) -> float:
    """Share of a mill that the bulk of its balls fills, as the models take it: of the whole cylinder inside the liners,
    lifters not subtracted. mass: of the balls, kg; density: of the balls, kg/m3; solidity: of the bulk; m."""
    return mass / density / solidity / (np.pi / 4 * diameter**2 * length)


def hogg_fuerstenau(diameter: float, length: float, speed: float, filling: float, density: float,
                    angle: float = REPOSE) -> float:
    """Net power, W, of the model of R. Hogg & D. W. Fuerstenau, Trans. SME-AIME 252 (1972) 418: the charge is a
    segment that is tilted by an angle, and each layer falls back along its chord.

    diameter, length: inside the liners, m; speed: over the critical speed; filling: share of the mill that the bulk of
    the charge fills; density: of the bulk with what is in its pores, kg/m3; angle: of lift, deg, usually 30 to 45. In
    the units of its authors: 0.238 D^3.5 (L/D) N (J - 1.065 J^2) rho sin(angle) kW with feet and t/m3. Compared with
    the mills of RANGES: it has the power of eleven of them with angles of 34 to 48, in the mean 41. No example of its
    authors is at hand.

    ValueError for a filling that is not above 0 and at most 0.6, or a speed that is not above 0 and at most 1."""
    require_share("filling", filling, 0.6)
    require_share("speed", speed, 1.0)
    return 1e3 * (0.238 * (diameter / FOOT)**3.5 * length / diameter * speed * (filling - 1.065 * filling**2)
                  * density / TONNE * np.sin(np.radians(angle)))


def bond(diameter: float, speed: float, filling: float, mass: float) -> float:
    """Power at the pinion, W, of the equation of F. C. Bond, Br. Chem. Eng. 6 (1961) 378 and 543, with the constants
    in kW and t of C. A. Rowland & D. M. Kjos in Mineral Processing Plant Design (1978), for wet overflow ball mills:
    4.879 D^0.3 (3.2 - 3 J) N (1 - 0.1/2^(9 - 10 N)) for each tonne of balls. Their addition for balls in mills of more
    than 3.3 m is left out, which ends its range. Below, no range and no example of a mill are at hand: the test
    compares it with the constant in feet and short tons.

    diameter: inside the liners, m; speed: over the critical speed; filling: share of the mill that the bulk of the
    balls fills; mass: of the balls, kg. ValueError as hogg_fuerstenau."""
    require_share("filling", filling, 0.6)
    require_share("speed", speed, 1.0)
    return 1e3 * (4.879 * diameter**0.3 * (3.2 - 3 * filling) * speed * (1 - 0.1 / 2**(9 - 10 * speed)) * mass / TONNE)


def morrell(diameter: float, length: float, speed: float, filling: float, density: float, pool: float = 0.0,
            overflow: bool = False) -> MorrellPower:
    """MorrellPower of a cylindrical mill: S. Morrell, Trans. IMM C 105 (1996) C43 and C54, the C-model. Compared with
    the mills of RANGES, whose motors take no_load + 1.26 net. Of its pool no example with numbers is at hand.

    diameter, length: inside the liners, m; speed: over the critical speed; filling: share of the mill that the bulk of
    the charge fills; density: of the bulk with what is in its pores, kg/m3; pool: density of the slurry, kg/m3, which
    counts only with overflow: there a pool reaches to an angle of 3.395 rad on the falling side. ValueError for a
    filling that is not above 0 and at most 0.6, or a speed that is not above 0 and at most 1, or a
    filling that does not fit between the model's toe and shoulder."""
    require_share("filling", filling, 0.6)
    require_share("speed", speed, 1.0)
    radius = diameter / 2
    turns = speed * np.sqrt(GRAVITY / radius) / (2 * np.pi)  # 1/s
    of_filling, full, steep = TOE
    centrifuged = max(speed, 0.35 * (3.364 - filling))
    toe = of_filling * (full - filling) * (1 - np.exp(-steep * (centrifuged - speed))) + np.pi / 2
    shoulder = np.pi / 2 - (toe - np.pi / 2) * (0.3386 + 0.1041 * speed + (1.54 - 2.5673 * speed) * filling)
    arc = 2 * np.pi + shoulder - toe
    if not 2 * np.pi * filling < arc:
        raise ValueError(f"filling is {filling:g} at a speed of {speed:g}; expected at most {arc / (2 * np.pi):.2g}, "
                         "the share between the model's toe and shoulder")
    lift = np.sin(shoulder) - np.sin(toe)
    # Part of the charge that is in contact: its time in the charge over that of a whole way with its free fall
    middle = radius / 2 * (1 + np.sqrt(1 - 2 * np.pi * filling / arc))
    in_charge, falling = arc / (np.pi * turns), np.sqrt(2 * middle * lift / GRAVITY)
    inner = radius * np.sqrt(1 - 2 * np.pi * filling / arc * in_charge / (in_charge + falling))
    z = (1 - filling)**0.4532
    depth = radius - z * inner
    of_layers = (np.pi * GRAVITY * length * turns * radius / (3 * depth)
                 * (2 * radius**3 - 3 * z * radius**2 * inner + inner**3 * (3 * z - 2)))
    of_pool = pool * (np.sin(toe) - np.sin(OVERFLOW_TOE)) if overflow else 0.0
    kinetic = length * density * (np.pi * turns * radius / depth)**3 * (depth**4 - inner**4 * (z - 1)**4)
    no_load = 1680 * diameter**2.05 * (speed * length)**0.82
    return MorrellPower(float(of_layers * (density * lift + of_pool)), float(kinetic), float(no_load), float(toe),
                        float(shoulder), float(inner))


def pores_filled(slurry: float, pores: float) -> float:
    """Share of the pores of the resting charge that slurry of this volume fills, at most 1; volumes in m3."""
    return min(1.0, slurry / pores)


def bulk_density(ball: float, solidity: float, slurry: float = 0.0, filled: float = 0.0) -> float:
    """Density, kg/m3, of the bulk of balls of a density at a solidity, whose pores are filled with slurry of a density
    to this share."""
    return ball * solidity + slurry * (1 - solidity) * filled
