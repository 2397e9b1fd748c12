# SPDX-License-Identifier: GPL-3.0-or-later
"""Observed order, limit and error bar of a number computed at several sizes (mesh, time-step, …)."""
from dataclasses import dataclass

import numpy as np

# Beyond these an observed order says more about noise than about the method (Eça & Hoekstra 2014, J Comput Phys
# 262:104)
ORDERS = (0.5, 2.0)
SAFETY = 1.25  # Roache's for three sizes
SCATTERED = 3.0  # the same where the scatter about the fit is as large as the differences (Eça & Hoekstra)


@dataclass
class Convergence:
    """order: NaN where the numbers are not monotone, or scatter; limit: at size 0; bar: of the number at the requested
    size."""
    order: float
    limit: float
    bar: float


def observed_order(sizes, values):
    """p of f = f0 + c h^p through three pairs, finest first; NaN where they are not monotone or p is not in (0.01,
    10)."""
    (h1, h2, h3), (f1, f2, f3) = sizes, values
    if (f2 - f1) * (f3 - f2) <= 0:
        return np.nan

    def excess(p):
        return (h3**p - h2**p) / (h2**p - h1**p) - (f3 - f2) / (f2 - f1)

    low, high = 0.01, 10.0
    if excess(low) > 0 or excess(high) < 0:
        return np.nan
    while high - low > 1e-9:
        middle = (low + high) / 2
        low, high = (middle, high) if excess(middle) < 0 else (low, middle)
    return low


def fitted(sizes, values, asked):
    """Convergence of four values or more, by the least squares of Eça & Hoekstra: f = f0 + c h^p with p within ORDERS.

    With the standard deviation s about the fit, and D, the values' range over the number of steps between them, the bar
    is SAFETY |f - f0| + s + |f - fit|. Where s is larger than D, it is SCATTERED s/D (|f - f0| + s + |f - fit|)."""
    def fit(order):
        terms = np.column_stack([np.ones(len(sizes)), sizes**order])
        found = np.linalg.lstsq(terms, values, rcond=None)[0]
        return np.sum((terms @ found - values)**2), order, found

    left, order, (limit, slope) = min((fit(order) for order in np.linspace(*ORDERS, 151)), key=lambda one: one[0])
    scatter = np.sqrt(left / (len(sizes) - 3))
    step = np.ptp(values) / (len(sizes) - 1)
    value = values[sizes == asked][0]
    away, off = abs(value - limit), abs(limit + slope * asked**order - value)
    if scatter < step:
        return Convergence(float(order), float(limit), float(SAFETY * away + scatter + off))
    bar = SCATTERED * scatter / step * (away + scatter + off) if step > 0 else 0.0
    return Convergence(np.nan, np.nan, float(bar))


def judge(sizes, values, asked):
    """Convergence of `values` at `sizes`, and the bar of the value at size `asked`.

    Three sizes, monotone: the limit by Richardson's extrapolation from the two finest with the observed order, kept
    within ORDERS, and the bar SAFETY times the distance to it. Not monotone: no limit, and the bar is the largest
    difference between two of the values. Two sizes: the same as three with order 1. Four or more: see fitted."""
    order_of = np.argsort(sizes)
    h, f = np.asarray(sizes, float)[order_of], np.asarray(values, float)[order_of]
    if len(h) > 3:
        return fitted(h, f, asked)
    order = observed_order(h, f) if len(h) == 3 else 1.0
    if not np.isfinite(order):
        return Convergence(np.nan, np.nan, float(np.ptp(f)))
    used = np.clip(order, *ORDERS)
    limit = f[0] - (f[1] - f[0]) * h[0]**used / (h[1]**used - h[0]**used)
    return Convergence(float(order), float(limit), float(SAFETY * abs(f[h == asked][0] - limit)))
