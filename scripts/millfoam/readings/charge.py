# SPDX-License-Identifier: GPL-3.0-or-later
"""Readings of a map of the charge: centre of circulation, toe and shoulder, free surface (free_surface), tangential
velocity.

x to the right, y up, the mill's axis at x = y = 0; the mill turns by the map's sense.

Angles are counted from straight down, in degrees, positive on the side where the shell rises: the shoulder's is
positive, the toe's usually negative. Lengths are in m. Each reading raises RuntimeError if the map does not have it."""
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike
from scipy.fft import dstn, idstn

from ..files.solids_file import SolidsMap
from .free_surface import (EDGE, SMOOTHING, WALL, FreeSurface, along_the_shell, at_points, free_surface, smoothed,
                           toe_and_shoulder)
from .means import Reading, with_error
from .shell_angles import shell_angle

TURNING = 0.3  # least share of circulation in the charge's motion about its centre
POINTS = 100  # along the line through the centre of circulation


def stream_function(charge: SolidsMap) -> np.ndarray:
    """Stream function psi [ny, nx] (m2/s) of the charge's volume flux F = phi u, lowest where the charge turns
    clockwise round a point.

    F = (d psi/dy, -d psi/dx) in the sense of least squares, psi = 0 beyond the map. If the charge is steady and uniform
    along the axis, div F = 0 and psi is exact. Noise and unsteadiness are averaged out, because psi solves Laplace psi
    = dFx/dy - dFy/dx (by sine transforms). Source: the Helmholtz decomposition, H. Bhatia et al., The Helmholtz-Hodge
    decomposition: a survey, IEEE Trans. Vis. Comput. Graph. 19 (2013) 1386."""
    dy, dx = (np.diff(edges).mean() for edges in (charge.y, charge.x))
    flux = np.pad(charge.flux()[..., :2], ((1, 1), (1, 1), (0, 0)))
    curl = np.gradient(flux[..., 0], dy, axis=0) - np.gradient(flux[..., 1], dx, axis=1)
    waves = [(2 - 2 * np.cos(np.pi * np.arange(1, n + 1) / (n + 1))) / step**2 for n, step in zip(curl.shape, (dy, dx))]
    transformed = dstn(curl, type=1) / -(waves[0][:, None] + waves[1][None, :])
    return idstn(transformed, type=1)[1:-1, 1:-1]


def _moving(charge: SolidsMap) -> np.ndarray:
    """Share of each column's volume that balls of known velocity fill [ny, nx]."""
    return np.where(np.isfinite(charge.velocity[..., 0]), charge.balls(), 0.0)


def _stagnation_point(charge: SolidsMap, guess: np.ndarray, width: float) -> np.ndarray:
    """Point of zero velocity near a guess [2]: of u = u0 + G (x - guess), fitted with the balls' volume and a Gaussian
    of `width` (m) as weights, repeatedly round the point found until it does not move."""
    xx, yy = np.meshgrid(*charge.centres())
    velocity, point = np.nan_to_num(charge.velocity[..., :2]).reshape(-1, 2), np.asarray(guess, dtype=float)
    for _ in range(50):
        away = np.column_stack([xx.ravel() - point[0], yy.ravel() - point[1]])
        weight = np.sqrt(_moving(charge).ravel() * np.exp(-(away**2).sum(axis=1) / (2 * width**2)))
        near = weight > 1e-4
        terms = np.column_stack([np.ones(near.sum()), away[near] / width])
        fit = np.linalg.lstsq(weight[near, None] * terms, weight[near, None] * velocity[near], rcond=None)[0]
        gradient = fit[1:].T / width
        if np.linalg.det(gradient) <= 0 or charge.sense * (gradient[1, 0] - gradient[0, 1]) <= 0:
            break
        step = np.linalg.solve(gradient, -fit[0])
        # Not beyond the range of the fit
        length = float(np.linalg.norm(step))
        point = point + step * min(1, 2 * width / max(length, 1e-300))
        if length < 1e-5 * width:
            return point
    raise RuntimeError(f"no centre of circulation: the velocity does not turn round a point near x = "
                       f"{1e3 * guess[0]:.1f} mm, "
                       f"y = {1e3 * guess[1]:.1f} mm")


def circulation_centre(charge: SolidsMap, radius: float) -> tuple[float, float]:
    """Centre of circulation (x, y) of a SolidsMap's charge (m): the point of zero mean velocity between the rising and
    the falling stream.

    The stream function's lowest value (in a clockwise mill; its largest in another) finds the voxel. It sums the flux
    of the whole map, so that noise of single voxels has little effect. The place within the voxel is the zero of a
    linear fit to the velocities around it (Gaussian weight, a standard deviation of one voxel or 0.05 radii, whichever
    is more). RuntimeError if the charge does not turn like the mill round a point inside the charge: if it is at rest,
    turns the other way, is thin or centrifuges."""
    solidity, psi = smoothed(charge, radius), stream_function(charge)
    x, y = charge.centres()
    row, column = np.unravel_index(np.argmax(charge.sense * psi), psi.shape)
    guess = np.array([x[column], y[row]])
    arms = np.stack(np.meshgrid(x, y), axis=-1) - guess
    flux = charge.flux()[..., :2]
    moment = charge.sense * (arms[..., 0] * flux[..., 1] - arms[..., 1] * flux[..., 0]).sum()
    total = (np.linalg.norm(arms, axis=-1) * np.linalg.norm(flux, axis=-1)).sum()
    if not moment > TURNING * total:
        raise RuntimeError(f"no centre of circulation: {moment:.3g} of {total:.3g} m3/s of the charge's motion turns "
                           f"with the mill, less than {TURNING:.0%}")
    _stay_inside(charge, radius, solidity, guess)
    centre = _stagnation_point(charge, guess, max(SMOOTHING * radius, x[1] - x[0], y[1] - y[0]))
    _stay_inside(charge, radius, solidity, centre)
    return float(centre[0]), float(centre[1])


def _stay_inside(charge: SolidsMap, radius: float, solidity: np.ndarray, place: np.ndarray) -> None:
    """RuntimeError if a place (x, y) (m) is outside the charge, by the smoothed solidity [ny, nx] in a mill of `radius`
    (m)."""
    phi, edge = at_points(charge, solidity, place[None])[0], EDGE * solidity.max()
    if phi < edge:
        raise RuntimeError(f"no centre of circulation inside the charge: it turns round x = {1e3 * place[0]:.1f} mm, "
                           f"y = {1e3 * place[1]:.1f} mm, where the solidity is {phi:.3g} (charge's edge: {edge:.3g}); "
                           f"{along_the_shell(charge, radius, solidity)}")


@dataclass
class TangentialProfile:
    """Tangential velocity along the line from the mill's centre through the centre of circulation.

    angle: the line's, degrees from straight down, positive where the shell rises; distance [POINTS] from the mill's
    centre (m), from the free surface to `wall` from the shell; velocity [POINTS] across the line, positive as the
    mill turns (m/s); coefficients [4] of the cubic in the distance, highest power first (m/s, m); rmsd of the
    velocity from it (m/s); shear_rate [POINTS] (1/s).

    shear_rate is the cubic's derivative du/dr. It is the shear rate of the flowing layer, whose streamlines are
    straight where they cross the line. For circles round the mill's axis it would be r d(u/r)/dr = du/dr - u/r, which
    has no limit near that axis. Where the charge turns rigidly with the shell, du/dr is the mill's angular speed."""
    angle: float
    distance: np.ndarray
    velocity: np.ndarray
    coefficients: np.ndarray
    rmsd: float
    shear_rate: np.ndarray

    def fitted(self, distance: ArrayLike) -> np.ndarray:
        """The cubic at a distance (m) from the mill's centre, m/s."""
        return np.polyval(self.coefficients, np.asarray(distance, dtype=float))


def tangential_profile(charge: SolidsMap, radius: float, wall: float = WALL) -> TangentialProfile:
    """TangentialProfile of a SolidsMap's charge in a mill of `radius` (m). If the charge covers the mill's centre, the
    line begins there. Velocities between voxels are flux over solidity, both interpolated bilinearly."""
    centre = np.array(circulation_centre(charge, radius))
    away = np.linalg.norm(centre)
    if away < 0.01 * radius:
        raise RuntimeError(f"no line through the centre of circulation: it is only {1e3 * away:.2g} mm from the mill's "
                           "centre")
    outwards = centre / away
    solidity = smoothed(charge, radius)
    inwards = np.linspace(away, 0, 500)
    phi = at_points(charge, solidity, inwards[:, None] * outwards) - EDGE * solidity.max()
    beyond = np.flatnonzero(phi < 0)
    begin = 0.0 if len(beyond) == 0 else inwards[beyond[0]] + (inwards[0] - inwards[1]) * phi[beyond[0]] / (
        phi[beyond[0]] - phi[beyond[0] - 1])
    distance = np.linspace(begin, radius - wall, POINTS)
    points = distance[:, None] * outwards
    flux = [at_points(charge, charge.flux()[..., axis], points) for axis in (0, 1)]
    balls = at_points(charge, _moving(charge), points)
    if balls.min() <= 0:
        raise RuntimeError(f"no velocity {1e3 * distance[np.argmin(balls)]:.1f} mm from the mill's centre: there are "
                           "no balls")
    velocity = charge.sense * (flux[1] * outwards[0] - flux[0] * outwards[1]) / balls
    coefficients = np.polyfit(distance, velocity, 3)
    rmsd = float(np.sqrt(np.mean((np.polyval(coefficients, distance) - velocity) ** 2)))
    shear = np.polyval(np.polyder(coefficients), distance)
    angle = float(shell_angle(centre[0], centre[1], charge.sense))
    return TangentialProfile(angle, distance, velocity, coefficients, rmsd, shear)


def shell_following(charge: SolidsMap, radius: float, omega: float) -> float:
    """Mean speed of the balls at the shell along it, over the shell's own there: 1 for a charge that turns with the
    shell, 0 for one that slides.

    It is read in the densest charge (half of the largest solidity or more) in the voxels whose centre is within a
    voxel's side of the shell, weighted by the balls' volume. radius: of the mill, m; omega: its angular speed about
    z, right-handed, rad/s. RuntimeError if the mill is at rest, or has no dense charge at its shell."""
    if omega == 0:
        raise RuntimeError("the mill is at rest: its charge cannot follow it")
    x, y = charge.centres()
    xx, yy = np.meshgrid(x, y)
    distance = np.hypot(xx, yy)
    solidity = np.nan_to_num(charge.solidity)
    dense = (solidity >= solidity.max() / 2) & np.isfinite(charge.velocity[..., 0])
    near = dense & (distance > radius - max(x[1] - x[0], y[1] - y[0])) & (distance < radius)
    if not near.any():
        raise RuntimeError("no dense charge at the shell")
    along = (xx * charge.velocity[..., 1] - yy * charge.velocity[..., 0])[near] / distance[near]
    return float(np.average(along / (omega * distance[near]), weights=charge.balls()[near]))


@dataclass
class Charge:
    """All readings of a map: centre (x, y) of circulation (m), toe and shoulder (degrees), free surface, profile."""
    centre: tuple[float, float]
    toe: float
    shoulder: float
    surface: FreeSurface
    tangential: TangentialProfile


def read_charge(charge: SolidsMap, radius: float, wall: float = WALL) -> Charge:
    """Charge of a SolidsMap in a mill of `radius` (m), at least `wall` (m) from the shell."""
    centre = circulation_centre(charge, radius)
    toe, shoulder = toe_and_shoulder(charge, radius, wall)
    return Charge(centre, toe, shoulder, free_surface(charge, radius, wall), tangential_profile(charge, radius, wall))


def charge_with_errors(maps: Sequence[SolidsMap], radius: float, wall: float = WALL,
                       blocks: int = 8) -> dict[str, Reading]:
    """Readings with standard errors over time (means.with_error), of SolidsMap of successive windows: name ->
    Reading of centre (x, y), ends (toe, shoulder), surface_rmsd and tangential_rmsd."""
    readings: dict[str, Callable[[SolidsMap], ArrayLike]] = {
        "centre": lambda one: circulation_centre(one, radius),
        "ends": lambda one: toe_and_shoulder(one, radius, wall),
        "surface_rmsd": lambda one: free_surface(one, radius, wall).rmsd,
        "tangential_rmsd": lambda one: tangential_profile(one, radius, wall).rmsd}
    return {name: with_error(reading, maps, blocks) for name, reading in readings.items()}
