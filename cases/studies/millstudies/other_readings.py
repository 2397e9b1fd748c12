# SPDX-License-Identifier: GPL-3.0-or-later
"""Other ways to read the tangential velocity and the free surface off a map: each changes one choice of readings.charge
or readings.free_surface, so that a published number with an unknown reading can be compared with all of them.

Each reading is a function (SolidsMap, radius in m) -> root mean square deviation, m/s or m, and raises RuntimeError
where the map does not have it. Names: VELOCITY and SURFACE."""
import numpy as np

from millfoam.readings.charge import circulation_centre, tangential_profile
from millfoam.readings.free_surface import WALL, fit_logistic, free_surface, surface_points

FIRST_BALLS = 0.01  # solidity, of the largest voxel's, from which a voxel counts when the thinnest flight does
TURN = 15.0  # of the line through the centre of circulation, degrees
WIDTHS = np.geomspace(0.3, 100, 80)  # c of a logistic with fewer parameters, over the radius
PLACES = np.linspace(-2, 2, 81)  # of its step, radii


def rms(values, parameters=0):
    """Root mean square [n] of residuals; over n minus the number of fitted parameters where that is given."""
    return float(np.sqrt(np.sum(np.square(values)) / (len(values) - parameters)))


def cubic_deviation(distance, velocity, parameters=0):
    """RMSD of a velocity [n] (m/s) from its cubic in the distance [n] (m). RuntimeError for fewer than six points."""
    if len(distance) < 6:
        raise RuntimeError(f"{len(distance)} voxels on the line; expected 6 or more, to judge a cubic")
    # In units of the line's length: the cubic's powers of small lengths are ill-conditioned
    scaled = (distance - distance.mean()) / np.ptp(distance)
    return rms(np.polyval(np.polyfit(scaled, velocity, 3), scaled) - velocity, parameters)


def turned_line(charge, radius, degrees):
    """Unit vector from the mill's centre through the centre of circulation, turned anticlockwise by so many degrees
    [2]."""
    x, y = circulation_centre(charge, radius)
    angle = np.arctan2(y, x) + np.radians(degrees)
    return np.array([np.cos(angle), np.sin(angle)])


def voxels_on_line(charge, outwards, largest):
    """Voxels that a line from the mill's centre passes within `largest` (m): rows [n], columns [n] and the distance [n]
    (m) of their centres from the mill's centre along it, outwards."""
    x, y = charge.centres()
    steps = np.arange(0, largest, (x[1] - x[0]) / 50)
    cells = np.column_stack([np.floor((steps * outwards[k] - edges[0]) / (edges[1] - edges[0])).astype(int)
                             for k, edges in ((1, charge.y), (0, charge.x))])
    within = np.all((cells >= 0) & (cells < charge.solidity.shape), axis=1)
    rows, columns = np.unique(cells[within], axis=0).T
    distance = x[columns] * outwards[0] + y[rows] * outwards[1]
    order = np.argsort(distance, kind="stable")
    order = order[(distance[order] >= 0) & (distance[order] <= largest)]
    return rows[order], columns[order], distance[order]


def by_voxel(charge, radius, *, begin=None, wall=WALL, degrees=0.0, parameters=0):
    """RMSD (m/s) of the cubic through the velocities of the voxels on the line, one point each, from the free surface
    (or where the solidity reaches FIRST_BALLS of the largest, for `begin` 0) to `wall` (m) from the shell."""
    outwards = turned_line(charge, radius, degrees)
    rows, columns, distance = voxels_on_line(charge, outwards, radius - wall)
    solidity = np.nan_to_num(charge.solidity)
    begin = tangential_profile(charge, radius).distance[0] if begin is None else begin
    known = (distance >= begin) & (solidity[rows, columns] > FIRST_BALLS * solidity.max())
    velocity = np.nan_to_num(charge.velocity[rows, columns])
    tangential = velocity[:, 0] * outwards[1] - velocity[:, 1] * outwards[0]
    return cubic_deviation(distance[known], tangential[known], parameters)


def column_tops(charge, radius, share, wall=WALL):
    """Points [n, 2] (m): in each column of voxels the highest one, farther than `wall` (m) from the shell, with a
    solidity above `share` of the largest, not smoothed."""
    x, y = charge.centres()
    solidity = np.nan_to_num(charge.solidity)
    charged = (solidity > share * solidity.max()) & (np.hypot(*np.meshgrid(x, y)) < radius - wall)
    columns = np.flatnonzero(charged.any(axis=0))
    tops = len(y) - 1 - np.argmax(charged[::-1, columns], axis=0)
    return np.column_stack([x[columns], y[tops]])


def points_deviation(points, radius):
    """RMSD (m) of points' y from a logistic with four parameters."""
    return fit_logistic(*points.T, radius)[1]


def shorter_logistic(points, radius, places, offset=True):
    """RMSD (m) of points' y [n, 2] from the best logistic with a step at one of the places [m] (radii), with or without
    d: of each width and place, a and d are linear least squares."""
    x, y = points.T / radius
    step = 1 / (1 + np.exp(np.clip(-WIDTHS[:, None, None] * (x - np.asarray(places)[:, None]), -500, 500)))
    if offset:
        # A constant that is fitted is the same as means taken off
        step, y = step - step.mean(axis=-1, keepdims=True), y - y.mean()
    square = np.maximum((step**2).sum(axis=-1, keepdims=True), 1e-30)
    left = y - (step * y).sum(axis=-1, keepdims=True) / square * step
    return float(np.sqrt((left**2).mean(axis=-1).min())) * radius


def straight_line(points):
    """RMSD (m) of points' y [n, 2] from a straight line."""
    x, y = points.T
    return rms(np.polyval(np.polyfit(x, y, 1), x) - y)


def _largest_deviation(charge, radius):
    surface = free_surface(charge, radius)
    return float(np.abs(surface.fitted(surface.points[:, 0]) - surface.points[:, 1]).max())


VELOCITY = {
    "as the library reads it": lambda charge, radius: tangential_profile(charge, radius).rmsd,
    "voxel by voxel": by_voxel,
    "voxel by voxel, over the degrees of freedom": lambda charge, radius: by_voxel(charge, radius, parameters=4),
    "voxel by voxel, to the shell": lambda charge, radius: by_voxel(charge, radius, wall=0),
    "voxel by voxel, from the first balls": lambda charge, radius: by_voxel(charge, radius, begin=0),
    "voxel by voxel, from the first balls to the shell": lambda charge, radius: by_voxel(
        charge, radius, begin=0, wall=0),
    f"the same, line {TURN:g} degrees anticlockwise": lambda charge, radius: by_voxel(
        charge, radius, begin=0, wall=0, degrees=TURN),
    f"the same, line {TURN:g} degrees clockwise": lambda charge, radius: by_voxel(
        charge, radius, begin=0, wall=0, degrees=-TURN),
}
SURFACE = {
    "as the library reads it": lambda charge, radius: free_surface(charge, radius).rmsd,
    "not smoothed": lambda charge, radius: free_surface(charge, radius, smoothing=0).rmsd,
    "with the wall part": lambda charge, radius: free_surface(charge, radius, wall=0).rmsd,
    "highest voxel of each column": lambda charge, radius: points_deviation(column_tops(charge, radius, 0.5), radius),
    "the same, with the wall part": lambda charge, radius: points_deviation(
        column_tops(charge, radius, 0.5, wall=0), radius),
    "highest voxel of each column that has balls": lambda charge, radius: points_deviation(
        column_tops(charge, radius, FIRST_BALLS), radius),
    "logistic with its step at the mill's centre (b = 1)": lambda charge, radius: shorter_logistic(
        surface_points(charge, radius), radius, [0.0]),
    "logistic that ends at the mill's centre (d = 0)": lambda charge, radius: shorter_logistic(
        surface_points(charge, radius), radius, PLACES, offset=False),
    "straight line": lambda charge, radius: straight_line(surface_points(charge, radius)),
    "largest deviation instead of the RMSD": _largest_deviation,
}


def mean_of_windows(reading, maps, radius, most=10):
    """Mean of a reading of single SolidsMap, at most so many evenly among them: the reading of an average over
    one window. NaN where none of them has it."""
    chosen = np.unique(np.linspace(0, len(maps) - 1, most).round().astype(int))
    found = []
    for index in chosen:
        try:
            found.append(reading(maps[index], radius))
        except RuntimeError:
            continue
    return float(np.mean(found)) if found else np.nan
