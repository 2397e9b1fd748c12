# SPDX-License-Identifier: GPL-3.0-or-later
"""Outline of a mill's cross-section: a circle, or a shell with lifters."""
import numpy as np


def circle(radius: float) -> np.ndarray:
    """Points [361, 2] of a circle about the axis, in the radius' unit."""
    turn = np.linspace(0, 2 * np.pi, 361)
    return radius * np.column_stack([np.cos(turn), np.sin(turn)])


def lifter_outline(radius: float, count: int, height: float, width: float, top_width: float,
                   angle: float) -> np.ndarray:
    """Closed outline [n, 2] (m) of a shell with `count` trapezoids, the first at `angle` (rad) from +x; height: from
    the shell to the middle of the flat top; width: of the foot, between its points on the shell."""
    if not count:
        return circle(radius)
    half, pitch = np.arcsin(width / 2 / radius), 2 * np.pi / count
    arc = radius * np.exp(1j * np.linspace(half, pitch - half, max(3, 360 // count)))
    lifter = [radius * np.exp(-1j * half), radius - height - 0.5j * top_width, radius - height + 0.5j * top_width]
    points = np.concatenate([np.exp(1j * (angle + number * pitch)) * np.concatenate([lifter, arc])
                             for number in range(count)])
    return np.column_stack([points.real, points.imag])[[*range(len(points)), 0]]
