# SPDX-License-Identifier: GPL-3.0-or-later
"""Shear rate of a Bingham slurry at a given shear stress, and of its two regularisations."""
import numpy as np
from scipy.optimize import brentq


def bingham(stress, yield_stress, viscosity):
    """Shear rate, 1/s, at these stresses, Pa; plastic viscosity in Pa s."""
    return np.maximum(np.asarray(stress) - yield_stress, 0) / viscosity


def biviscosity(stress, yield_stress, viscosity, ratio):
    """The same with the apparent viscosity tau0/rate + mu capped at ratio*mu."""
    stress = np.asarray(stress)
    return np.maximum(stress / (ratio * viscosity), bingham(stress, yield_stress, viscosity))


def papanastasiou(stress, yield_stress, viscosity, m):
    """The same with stress = mu rate + tau0 (1 - exp(-m rate)); m in s."""
    def lack(rate, s):
        return viscosity * rate + yield_stress * -np.expm1(-m * rate) - s
    rates = [brentq(lack, 0, s / viscosity, args=(s,), xtol=1e-14) if s > 0 else 0.0 for s in np.ravel(stress)]
    return np.reshape(rates, np.shape(stress))


def regularised(stress, regularisation, yield_stress, viscosity, ratio, m):
    """Shear rate by the regularisation of this name."""
    if regularisation == "biviscosity":
        return biviscosity(stress, yield_stress, viscosity, ratio)
    return papanastasiou(stress, yield_stress, viscosity, m)
