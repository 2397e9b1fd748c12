# SPDX-License-Identifier: GPL-3.0-or-later
"""Models to compare with a simulated mill: the charge's free surface, and the slurry's hold-up."""
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike
from scipy.integrate import solve_ivp
from scipy.optimize import brentq, least_squares

from ..files.constants import GRAVITY

POOR = 0.03  # of the radius that a fit may leave and still describe a surface


@dataclass
class FreeSurface:
    """Free surface of a charge, lengths in units of the mill's radius, x to the right and y up.

    internal, wall: coefficients mu_i and mu_w; number: Lambda; height: y at x = 0; filling: share of the circle's
    area below the surface; x, y [n]: points from shell to shell."""
    internal: float
    wall: float
    number: float
    height: float
    filling: float
    x: np.ndarray
    y: np.ndarray


def surface_number(angular_velocity: float, diameter: float, radius: float, length: float) -> float:
    """Lambda = (Omega^2 d / g)^(1/4) R / L: thickness of the flowing layer over the distance of the ends, at the axis.
    SI."""
    return (angular_velocity ** 2 * diameter / GRAVITY) ** 0.25 * radius / length


def free_surface(internal: float, wall: float, number: float, filling: float | None = None, height: float | None = None,
                 clockwise: bool = True, points: int = 201) -> FreeSurface:
    """FreeSurface of Taberlet, Richard & Hinch, Phys. Rev. E 73 (2006) 050301: dy/dx = mu_i + mu_w Lambda sqrt(1 - x^2
    - y^2) where the mill lifts its charge on the right (anticlockwise); for a clockwise mill it is mirrored.

    Give either the filling, above 0 and below 1, from which the height follows, or the height at x = 0 in (-1, 1). The
    ends' friction is a term that grows with the flowing layer. The thickness of this layer follows from its flow, Omega
    (R^2 - r^2) / 2, at a shear rate sqrt(g/d). ValueError for other values, or for a surface that does not reach from
    shell to shell."""
    if (filling is None) == (height is None):
        raise ValueError("filling and height: expected one of them")
    if filling is not None and not 0 < filling < 1 or height is not None and not -1 < height < 1:
        raise ValueError(f"filling {filling}, height {height}; expected a filling in (0, 1) or a height in (-1, 1)")
    if filling is not None:
        asked = filling
        height = brentq(lambda trial: _branches(internal, wall, number, trial)[2] - asked, -1 + 1e-9, 1 - 1e-9,
                        xtol=1e-12)
    assert height is not None
    left, right, share = _branches(internal, wall, number, height)
    x = np.linspace(left.t[-1], right.t[-1], points)
    y = np.where(x < 0, left.sol(np.minimum(x, 0))[0], right.sol(np.maximum(x, 0))[0])
    if clockwise:
        x, y = -x[::-1], y[::-1]
    return FreeSurface(internal, wall, number, float(height), float(share), x, y)


def _branches(internal: float, wall: float, number: float, height: float) -> tuple[Any, Any, float]:
    """The surface from (0, height) to the shell on the left and on the right, as solutions of solve_ivp, and the
    filling."""
    def slope(x: float, state: np.ndarray) -> list[float]:
        steep = internal + wall * number * np.sqrt(max(0.0, 1 - x ** 2 - state[0] ** 2))
        # The second is the area that the ray from the axis sweeps
        return [steep, (x * steep - state[0]) / 2]

    def shell(x: float, state: np.ndarray) -> float:
        return 1 - x ** 2 - state[0] ** 2

    shell.terminal = True  # type: ignore[attr-defined]
    ends = [solve_ivp(slope, (0, side), [height, 0.0], events=shell, dense_output=True, rtol=1e-10, atol=1e-12)
            for side in (-1.0, 1.0)]
    for branch in ends:
        if branch.status != 1 and abs(shell(branch.t[-1], branch.y[:, -1])) > 1e-6:
            raise ValueError(f"mu_i {internal}, mu_w {wall}: the surface through y = {height} does not reach the shell")
    angles = [np.arctan2(branch.y[0, -1], branch.t[-1]) for branch in ends]
    swept = ends[1].y[1, -1] - ends[0].y[1, -1]
    return ends[0], ends[1], (((angles[1] - angles[0]) % (2 * np.pi)) / 2 - swept) / np.pi


def fit_free_surface(x: ArrayLike, y: ArrayLike, number: float, filling: float | None = None,
                     clockwise: bool = True) -> tuple[FreeSurface, float]:
    """FreeSurface whose mu_i and mu_w are fitted to points x, y [n] (units of the radius) of a free surface, n > 2, and
    the root mean square of the residuals in y: (FreeSurface, float). The height follows from the filling; without a
    filling it is fitted. Friction is 0 where the fit would make it negative."""
    x, y = np.asarray(x, dtype=float), np.asarray(y, dtype=float)
    if x.shape != y.shape or len(x) < 3 or not np.all(x ** 2 + y ** 2 < 1):
        raise ValueError(f"points x {x.shape}, y {y.shape}; expected 3 or more within the mill")
    along = -x if clockwise else x
    slope, height = np.polyfit(along, y, 1)

    def surface(unknowns: np.ndarray) -> FreeSurface:
        closing = {"height": np.clip(unknowns[2], -0.999, 0.999)} if filling is None else {"filling": filling}
        return free_surface(unknowns[0], unknowns[1], number, clockwise=False, **closing)

    def misfit(unknowns: np.ndarray) -> np.ndarray:
        found = surface(unknowns)
        # Points beyond the model's ends at the shell are compared with a straight line of the slope at these ends
        beyond = np.where(along < found.x[0], along - found.x[0],
                          np.where(along > found.x[-1], along - found.x[-1], 0.0))
        return np.interp(along, found.x, found.y) + found.internal * beyond - y

    start = [max(slope, 0.05), 0.05] + ([np.clip(height, -0.99, 0.99)] if filling is None else [])
    lower = [0.0, 0.0, -np.inf][:len(start)]
    fit = least_squares(misfit, start, x_scale="jac", bounds=(lower, np.inf))
    best = surface(fit.x)
    if clockwise:
        best = free_surface(best.internal, best.wall, number, height=best.height)
    return best, float(np.sqrt(np.mean(fit.fun ** 2)))


def describes(surface: FreeSurface, rmsd: float) -> bool:
    """Whether a fitted FreeSurface describes its points: friction above its bound of zero, and small residuals."""
    return min(surface.internal, surface.wall) > 1e-3 and rmsd <= POOR


@dataclass
class Charge:
    """The porous charge that slurry flows through along the axis (SI): radius and length of the mill; porosity e;
    diameter of the balls d (Sauter mean of a mixture); tortuosity factor C_T, 5 as a rule."""
    radius: float
    length: float
    porosity: float
    diameter: float
    tortuosity: float = 5.0

    def permeability(self) -> float:
        """K = e^3 d^2 / (36 C_T (1 - e)^2) of Kozeny and Carman, m^2."""
        return self.porosity ** 3 * self.diameter ** 2 / (36 * self.tortuosity * (1 - self.porosity) ** 2)

    def resistance(self, viscosity: float, density: float) -> float:
        """B = 2 mu / (pi sqrt(R) rho g K) of a slurry, s/m^1.5: dh/dz = -B Q / h^1.5."""
        return 2 * viscosity / (np.pi * np.sqrt(self.radius) * density * GRAVITY * self.permeability())

    def cross_section(self, depth: ArrayLike) -> np.ndarray:
        """A(h) = (pi/2) sqrt(R) h^1.5, m^2, of a pool of depth h (m): exact at h = R; the segment of a shallow pool is
        (4 sqrt(2)/3) sqrt(R) h^1.5, a fifth more."""
        return np.pi / 2 * np.sqrt(self.radius) * np.asarray(depth) ** 1.5


def slurry_depth(charge: Charge, z: ArrayLike, flow: float, discharge_depth: float, viscosity: float,
                 density: float) -> np.ndarray:
    """Depth h (m) of slurry at z (m, 0 at the feed end) in Moys' model: h^2.5 = h_L^2.5 + 2.5 B Q (L - z), that is
    Darcy's law Q = -A(h) (rho g K / mu) dh/dz. flow Q (m^3/s); discharge_depth h_L (m) at z = L. ValueError for
    negative ones."""
    _check(flow, discharge_depth)
    drop = 2.5 * charge.resistance(viscosity, density) * flow * (charge.length - np.asarray(z, dtype=float))
    return (discharge_depth ** 2.5 + drop) ** 0.4


def slurry_hold_up(charge: Charge, flow: float, discharge_depth: float, viscosity: float, density: float) -> float:
    """Volume (m^3) of slurry in the charge's pores in Moys' model, the integral of e A(h) over the mill's length: e pi
    sqrt(R) [(h_L^2.5 + 2.5 B Q L)^1.6 - h_L^4] / (8 B Q), evaluated without cancellation down to Q = 0, where it is e
    A(h_L) L. Arguments as of `slurry_depth`."""
    _check(flow, discharge_depth)
    drop = 2.5 * charge.resistance(viscosity, density) * flow * charge.length
    least = discharge_depth ** 2.5
    # ((least + drop)^1.6 - least^1.6) / drop, without cancellation of the smaller one
    if drop == 0:
        mean = 1.6 * least ** 0.6
    elif drop < least:
        mean = least ** 0.6 * np.expm1(1.6 * np.log1p(drop / least)) / (drop / least)
    else:
        mean = ((least + drop) ** 1.6 - least ** 1.6) / drop
    return charge.porosity * np.pi * np.sqrt(charge.radius) * 2.5 * charge.length / 8 * mean


def mean_grate_radius(inner: float, outer: float) -> float:
    """Mean distance (m) from the axis of the holes of a ring of grates from `inner` to `outer` (m)."""
    return 2 / 3 * (outer ** 3 - inner ** 3) / (outer ** 2 - inner ** 2)


def grate_hold_up(flow: float, diameter: float, grate_radius: float, open_area: float, critical_share: float,
                  most: float = 1.0) -> float:
    """Slurry in a mill with grates over the mill's volume, by Morrell & Stephenson, Int. J. Miner. Process. 46 (1996)
    53-72: flow (m3/s), diameter of the mill (m), mean radius of the holes (m), their whole area (m2), speed over the
    critical one; most: share of the mill's volume that the pores of the charge hold.

    Q = 6100 J^2 g^2.5 A p^-1.38 sqrt(D) through the charge, up to J = most; what is beyond flows as a pool of the
    share J', Q' = 935 J' g^2 A sqrt(D). Q: flow in m3/h; J: share of slurry; g: mean radius of the holes over the
    mill's; A: their area in m2; p: speed over the critical one; D: diameter in m. Pulp lifters are not in it. The mills
    that it was fitted to, and an example with numbers, are not at hand: the tests compare coefficients and powers.
    ValueError for values below 0, or a radius beyond the mill's."""
    share = 2 * grate_radius / diameter
    if not (flow >= 0 and diameter > 0 and 0 < share <= 1 and open_area > 0 and critical_share > 0 and most > 0):
        raise ValueError(f"flow {flow} m3/s, diameter {diameter} m, grates at {grate_radius} m, {open_area} m2, speed "
                         f"{critical_share}, pores {most}; expected a flow of 0 or more, grates inside the mill, and "
                         "other values above 0")
    hourly = 3600 * flow
    through_charge = 6100 * share ** 2.5 * open_area * critical_share ** -1.38 * np.sqrt(diameter)
    within = np.sqrt(hourly / through_charge)
    if within <= most:
        return float(within)
    return float(most + (hourly - through_charge * most ** 2) / (935 * share ** 2 * open_area * np.sqrt(diameter)))


def plate_loss(open_share: float) -> float:
    """Loss coefficient K of a thin plate with sharp-edged holes, by the velocity in front of it: I. E. Idelchik,
    Handbook of Hydraulic Resistance, diagram 8-1. open_share: of the plate's area, above 0 and at most 1."""
    return float(((0.707 * np.sqrt(1 - open_share) + 1 - open_share) / open_share)**2)


def orifice_coefficients(open_share: float) -> tuple[float, float]:
    """Least and largest discharge coefficient of the sharp-edged holes of a plate of this open share. The least is that
    of a round hole: 0.603 to 0.620, measured at heads of 1 to 20 ft (Encyclopaedia Britannica, 11th edition, vol. 14,
    "Hydraulics"); squares and slits have more. The largest is that of slits, whose jets contract to pi/(pi + 2)
    (Kirchhoff), if the jets join behind the plate with Borda & Carnot's loss, which gives back a part of their head."""
    slit = np.pi / (np.pi + 2)
    return 0.603, float(slit / (1 - slit * open_share))


def _check(flow: float, discharge_depth: float) -> None:
    if not (flow >= 0 and discharge_depth >= 0):
        raise ValueError(f"flow {flow} m3/s, depth at the discharge {discharge_depth} m; expected 0 or more")
