# SPDX-License-Identifier: GPL-3.0-or-later
"""Free surface of the charge, its logistic, and its ends at the shell, toe and shoulder: readings of a map of the
charge.

x to the right, y up, the mill's axis at x = y = 0. Angles are counted from straight down, in degrees, positive on the
side where the shell rises (by the map's sense; the left of a clockwise mill): the shoulder's is positive, the toe's
usually negative. Each reading raises RuntimeError if the map does not have it."""
from dataclasses import dataclass

import numpy as np
from contourpy import contour_generator
from numpy.typing import ArrayLike
from scipy.ndimage import gaussian_filter, map_coordinates
from scipy.optimize import least_squares

from ..files.solids_file import SolidsMap
from .shell_angles import shell_angle

# Standard deviation of the Gaussian that smooths the solidity before its edge is sought, of the mill's radius
SMOOTHING = 0.05
EDGE = 0.5  # solidity at the charge's edge, of the largest of the smoothed map
WALL = 0.008  # m from the shell; the space closer to it is between or at lifters
FEWEST = 0.05  # largest smoothed solidity of a map that has a charge
POINTS = 100  # along the free surface
ALL_ROUND = 0.95  # share of the shell that a centrifuging charge covers
LARGEST = 10.0  # |a| and |d| of a logistic, of the mill's radius
KNOWN = 0.5  # length of the free surface that must be known if a map lacks voxels, of the mill's radius


def smoothed(charge: SolidsMap, radius: float, smoothing: float = SMOOTHING) -> np.ndarray:
    """Solidity [ny, nx] of a SolidsMap, smoothed by a Gaussian of `smoothing` radii. Balls and space are smoothed
    separately, so that the mean is only over the mill's inside and the shell is no edge. RuntimeError if there is no
    charge."""
    widths = [smoothing * radius / np.diff(edges).mean() for edges in (charge.y, charge.x)]
    balls, room = (gaussian_filter(values, widths, mode="constant") for values in (
        charge.balls(), np.where(np.isfinite(charge.solidity), charge.inside, 0.0)))
    solidity = np.where(room > 1e-3, balls / np.maximum(room, 1e-3), 0.0)
    if solidity.max() < FEWEST:
        raise RuntimeError(f"no charge: the largest smoothed solidity is {solidity.max():.3g}, less than {FEWEST}")
    return solidity


def at_points(charge: SolidsMap, values: np.ndarray, points: np.ndarray) -> np.ndarray:
    """Values [ny, nx] on a map's voxels, interpolated bilinearly at points [n, 2] (m); constant beyond the outermost
    centres."""
    x, y = charge.centres()
    place = [(points[:, 1] - y[0]) / (y[1] - y[0]), (points[:, 0] - x[0]) / (x[1] - x[0])]
    return map_coordinates(values, place, order=1, mode="nearest")


def along_the_shell(charge: SolidsMap, radius: float, solidity: np.ndarray, wall: float = WALL) -> str:
    """In words, the share of the shell of a mill of `radius` (m) that the charge covers. A charge that covers all of it
    centrifuges.

    solidity [ny, nx], smoothed. A place is covered if the solidity within `wall` (m) of it reaches that of the charge's
    edge."""
    angle = np.radians(np.arange(0, 360, 2))
    depths = np.linspace(0, wall, 5)[:, None]
    points = np.stack([(radius - depths) * np.cos(angle), (radius - depths) * np.sin(angle)], axis=-1)
    phi = at_points(charge, solidity, points.reshape(-1, 2)).reshape(points.shape[:2])
    covered = np.mean(phi.max(axis=0) >= EDGE * solidity.max())
    if covered >= ALL_ROUND:
        return f"the charge covers {100 * covered:.0f} % of the shell: it centrifuges"
    return f"the charge covers {100 * covered:.0f} % of the shell: it is too thin, or too loose, for this reading"


def logistic(x: np.ndarray, a: float, b: float, c: float, d: float) -> np.ndarray:
    """The generalised logistic a/(1 + b exp(-c x)) + d."""
    return a / (1 + b * np.exp(-c * x)) + d


@dataclass
class FreeSurface:
    """Free surface of the bulk of the charge, from the shoulder to the toe.

    points [POINTS, 2]: x, y (m), equally spaced along it, NaN where a measured map does not know it; parameters: a (m),
    b, c (1/m), d (m) of the logistic y = a/(1 + b exp(-c x)) + d, c > 0; rmsd (m): root mean square of the points'
    differences from it in y; NaN if the known part of the surface has no logistic."""
    points: np.ndarray
    parameters: tuple[float, ...]
    rmsd: float

    def fitted(self, x: ArrayLike) -> np.ndarray:
        """The logistic at x (m), m."""
        return logistic(np.asarray(x, dtype=float), *self.parameters)

    def height(self, x: ArrayLike) -> np.ndarray:
        """The surface's own height y (m) at x (m), straight between points, the highest one if it overhangs; NaN
        outside its range and where it is not known."""
        x = np.atleast_1d(np.asarray(x, dtype=float))
        (x0, y0), (x1, y1) = self.points[:-1].T[..., None], self.points[1:].T[..., None]
        with np.errstate(invalid="ignore", divide="ignore"):
            part = (x - x0) / (x1 - x0)
            crossings = np.where((part >= 0) & (part <= 1), y0 + part * (y1 - y0), -np.inf)
        top = crossings.max(axis=0)
        return np.where(np.isfinite(top), top, np.nan)


def _to_circle(inner: np.ndarray, outer: np.ndarray, largest: float) -> np.ndarray:
    """Crossing of the circle of radius `largest` and the straight line from a point [2] inside it to one outside."""
    way = outer - inner
    square, offset = way @ way, inner @ way
    return inner + (np.sqrt(offset**2 + square * (largest**2 - inner @ inner)) - offset) / square * way


def pieces_within(line: np.ndarray, largest: float) -> list[np.ndarray]:
    """Pieces [n, 2] of a polyline [m, 2] within a circle of radius `largest`, each with both its ends on the circle."""
    within = np.hypot(*line.T) < largest
    if np.array_equal(line[0], line[-1]) and not within.all():
        # A loop begins where it is outside, so that no piece is cut in two
        line = np.roll(line[:-1], -np.argmin(within), axis=0)
        line = np.concatenate([line, line[:1]])
        within = np.hypot(*line.T) < largest
    enter = np.flatnonzero(~within[:-1] & within[1:])
    leave = np.flatnonzero(within[:-1] & ~within[1:])
    leave = leave[leave > enter[0]] if len(enter) else leave
    return [np.concatenate([_to_circle(line[i + 1], line[i], largest)[None], line[i + 1:j + 1],
                            _to_circle(line[j], line[j + 1], largest)[None]]) for i, j in zip(enter, leave)]


def _evenly(line: np.ndarray, count: int) -> np.ndarray:
    """`count` points [count, 2] equally far along a polyline [n, 2]."""
    way = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(line, axis=0), axis=1))])
    return np.column_stack([np.interp(np.linspace(0, way[-1], count), way, values) for values in line.T])


def is_known(charge: SolidsMap, points: np.ndarray, margin: float) -> np.ndarray:
    """Whether points [n, 2] (m) are farther than `margin` (m) from every voxel in the mill without a solidity [n]."""
    rows, columns = np.nonzero(~np.isfinite(charge.solidity) & (charge.inside > 0))
    apart = [np.maximum(np.maximum(edges[index] - place[:, None], place[:, None] - edges[index + 1]), 0.0)
             for edges, index, place in ((charge.x, columns, points[:, 0]), (charge.y, rows, points[:, 1]))]
    return np.all(np.hypot(*apart) > margin, axis=1)


def _length(line: np.ndarray) -> float:
    """Length of a polyline [n, 2] without its pieces from or to NaN."""
    return np.nansum(np.linalg.norm(np.diff(line, axis=0), axis=1))


def surface_points(charge: SolidsMap, radius: float, wall: float = WALL, smoothing: float = SMOOTHING) -> np.ndarray:
    """The free surface's points [POINTS, 2] (m) from shoulder to toe, NaN where it is not known, see free_surface."""
    solidity = smoothed(charge, radius, smoothing)
    lines = contour_generator(*charge.centres(), solidity).lines(EDGE * solidity.max())
    pieces = [piece for line in lines for piece in pieces_within(line, radius - wall)]
    if not pieces:
        missing = np.sum(~np.isfinite(charge.solidity) & (charge.inside > 0))
        what, why = (("free surface not known", f"{missing} voxels are missing") if missing else
                     ("no free surface", along_the_shell(charge, radius, solidity, wall)))
        raise RuntimeError(f"{what}: the charge's edge, solidity {EDGE * solidity.max():.3g}, does not meet the circle "
                           f"{1e3 * wall:g} mm from the shell; {why}")
    # Close to missing voxels, the contour is only the edge of the known part
    margin = max(np.diff(charge.x).max(), np.diff(charge.y).max(), smoothing * radius)
    lines = (_evenly(piece, POINTS) for piece in pieces)
    points = max((np.where(is_known(charge, line, margin)[:, None], line, np.nan) for line in lines), key=_length)
    if np.isnan(points).any() and _length(points) < KNOWN * radius:
        raise RuntimeError(f"free surface not known: {1e3 * _length(points):.0f} mm of it are farther than "
                           f"{1e3 * margin:.1f} mm from voxels that the map lacks; expected "
                           f"{1e3 * KNOWN * radius:.0f} mm or more")
    # From the shoulder to the toe, the charge is on the right side in a clockwise mill, on the left side in another
    along = np.gradient(points, axis=0)
    across = np.column_stack([along[:, 1], -along[:, 0]])
    inwards = -charge.sense * across / np.linalg.norm(along, axis=1, keepdims=True)
    step = SMOOTHING * radius / 2
    known = np.isfinite(inwards).all(axis=1)
    ahead, behind = (at_points(charge, solidity, (points + way * inwards)[known]) for way in (step, -step))
    return points if np.mean(ahead - behind) > 0 else points[::-1]


def free_surface(charge: SolidsMap, radius: float, wall: float = WALL, smoothing: float = SMOOTHING) -> FreeSurface:
    """FreeSurface of a SolidsMap's charge in a mill of `radius` (m).

    The map is smoothed by a Gaussian of `smoothing` radii. The surface is the contour at EDGE of the largest smoothed
    solidity, where it is farther than `wall` (m) from the shell. If there are several pieces from shell to shell, the
    longest one counts, which bounds the bulk. Balls in flight have a lower solidity and are outside; a dense cataract
    belongs to the bulk.

    If the map lacks voxels in the mill, the surface is read only where it is farther from them than a voxel's width
    and the smoothing's; RuntimeError "free surface not known" if less than KNOWN radii of it remain."""
    points = surface_points(charge, radius, wall, smoothing)
    known = np.isfinite(points[:, 0])
    try:
        parameters, rmsd = fit_logistic(points[known, 0], points[known, 1], radius)
    except RuntimeError:
        if known.all():
            raise
        parameters, rmsd = (np.nan,) * 4, np.nan  # a straight part of a surface determines no step
    return FreeSurface(points, parameters, rmsd)


def fit_logistic(x: np.ndarray, y: np.ndarray, scale: float) -> tuple[tuple[float, ...], float]:
    """Parameters (a, b, c, d) of the logistic through points x, y [n] (m), and its RMSD (m): the best of three
    least-squares fits, with the step within two `scale` (m) of the axis and at least `scale`/100 wide, |a| and |d| up
    to ten of them.

    For a place and a width of the step, a and d are linear least squares, so that only these two are sought. The fits
    begin at the best three of a table of both. RuntimeError if no fit converges."""
    x, y = x / scale, y / scale

    def linear(place: float, steepness: float) -> tuple[float, float, np.ndarray]:
        """Best a and d, within their bounds, of a step at `place` with c = exp(steepness); and the step [n]."""
        step = logistic(x, 1, np.exp(np.exp(steepness) * place), np.exp(steepness), 0)
        centred = step - step.mean()
        variance = centred @ centred
        a = np.clip(centred @ y / variance if variance > 1e-14 else 0.0, -LARGEST, LARGEST)
        d = y.mean() - a * step.mean()
        if abs(d) > LARGEST:
            d = np.clip(d, -LARGEST, LARGEST)
            a = np.clip(step @ (y - d) / (step @ step), -LARGEST, LARGEST)
        return a, d, step

    def apart(found: np.ndarray) -> np.ndarray:
        a, d, step = linear(*found)
        return a * step + d - y

    starts = [(place, np.log(c)) for place in np.linspace(x.min() - 0.3, x.max() + 0.3, 12).clip(-1.9, 1.9)
              for c in (1, 2, 4, 8, 16)]
    fits = []
    for start in sorted(starts, key=lambda start: np.mean(apart(np.array(start)) ** 2))[:3]:
        fit = least_squares(apart, start, bounds=([-2, np.log(0.01)], [2, np.log(100)]), max_nfev=200)
        if fit.success:
            fits.append((np.sqrt(np.mean(fit.fun ** 2)), *fit.x))
    if not fits:
        raise RuntimeError(f"no logistic was found through the {len(x)} points of the free surface")
    rmsd, place, steepness = min(fits)
    (a, d, _), c = linear(place, steepness), np.exp(steepness)
    return (float(a * scale), float(np.exp(c * place)), float(c / scale), float(d * scale)), float(rmsd * scale)


def toe_and_shoulder(charge: SolidsMap, radius: float, wall: float = WALL) -> tuple[float, ...]:
    """Angles of toe and shoulder (degrees from straight down, positive where the shell rises; in [-180, 180)). They are
    the points at which the free surface meets the circle `wall` (m) from the shell."""
    points = surface_points(charge, radius, wall)
    for end, name in ((-1, "toe"), (0, "shoulder")):
        if np.isnan(points[end]).any():
            raise RuntimeError(f"free surface not known at the {name}: voxels there are missing")
    return tuple(float(shell_angle(points[end, 0], points[end, 1], charge.sense)) for end in (-1, 0))
