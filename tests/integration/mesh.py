# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes of hexahedra, and mesh.h5 as averaging's README describes it, independently of averaging's own writer.

A mesh is an array of points [nx + 1][ny + 1][nz + 1][3], m; its cells are numbered in the same order, so that a field
of cells takes the shape [nx][ny][nz]. All cells are upright prisms."""
import h5py
import numpy as np


def box(lower, upper, shape):
    axes = [np.linspace(low, high, n + 1) for low, high, n in zip(lower, upper, shape)]
    return np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1)


def drum(shape):
    """About z, with the radius 1 m and between z = 0 and 1 m; its side is a polygon whose corners lie on the circle."""
    x, y, z = np.moveaxis(box((-1, -1, 0), (1, 1, 1), shape), -1, 0)
    return np.stack([x * np.sqrt(1 - y**2 / 2), y * np.sqrt(1 - x**2 / 2), z], axis=-1)


def volumes(points):
    """Of the cells, m3, [nx][ny][nz]."""
    x, y = np.moveaxis(_quads(points[..., :2], 2), -1, 0)
    area = np.sum(x * np.roll(y, -1, axis=-1) - np.roll(x, -1, axis=-1) * y, axis=-1)[0] / 2
    return area[:, :, None] * np.diff(points[0, 0, :, 2])


def write(path, *points, times=(0.0,), time0=0.0):
    """The points of one mesh at one or several flow times."""
    shape = np.array(points[0].shape[:3]) - 1
    nodes = np.arange(np.prod(shape + 1)).reshape(shape + 1)
    cells = np.arange(np.prod(shape)).reshape(shape)
    inner, sides = [], []
    for axis in range(3):
        quads, layers = _quads(nodes[..., None], axis)[..., 0], cells.transpose(_cyclic(axis))
        inner.append(np.column_stack([layers[:-1].ravel(), layers[1:].ravel(), quads[1:-1].reshape(-1, 4)]))
        sides.append(np.column_stack([layers[0].ravel(), quads[0, ..., ::-1].reshape(-1, 4)]))
        sides.append(np.column_stack([layers[-1].ravel(), quads[-1].reshape(-1, 4)]))
    inner, outer = np.vstack(inner), np.vstack(sides)
    inner = inner[np.lexsort((inner[:, 1], inner[:, 0]))]
    faces = np.vstack([inner[:, 2:], outer[:, 1:]])
    sizes = [len(side) for side in sides]
    with h5py.File(path, "w") as file:
        file.attrs.update(format="millfoam-mesh", version=np.int32(1), complete=np.int32(1),
                          cells=np.int32(cells.size), time0=float(time0))
        file["times"] = np.array(times, dtype=float)
        file["points"] = np.array(points, dtype=float).reshape(len(points), -1, 3)
        file["face_begin"], file["face_points"] = 4 * np.arange(len(faces) + 1), faces.ravel()
        file["owner"] = np.concatenate([inner[:, 0], outer[:, 0]])
        file["neighbour"] = inner[:, 1]
        file["patch/name"] = np.array(["west", "east", "south", "north", "bottom", "top"], dtype="S")
        file["patch/first"], file["patch/faces"] = len(inner) + np.cumsum([0, *sizes[:-1]]), np.array(sizes)


def write_walls(path, points):
    """The sides of the mesh without its ends, as ASCII STL."""
    west, east = _quads(points, 0)[[0, -1]]
    south, north = _quads(points, 1)[[0, -1]]
    quads = np.concatenate([side.reshape(-1, 4, 3) for side in (west[..., ::-1, :], east, south[..., ::-1, :], north)])
    facets = quads[:, [[0, 1, 2], [0, 2, 3]]].reshape(-1, 3, 3)
    path.write_text("solid walls\n" + "".join(
        "facet normal 0 0 0\nouter loop\n" + "".join("vertex {!r} {!r} {!r}\n".format(*p) for p in facet) +
        "endloop\nendfacet\n" for facet in facets.tolist()) + "endsolid walls\n")


def _cyclic(axis):
    return axis, (axis + 1) % 3, (axis + 2) % 3


def _quads(values, axis):
    """The values at the four corners of the faces across an axis, whose normals point along it:
    [layer][row][column][4][components]."""
    v = values.transpose(*_cyclic(axis), 3)
    return np.stack([v[:, :-1, :-1], v[:, 1:, :-1], v[:, 1:, 1:], v[:, :-1, 1:]], axis=3)
