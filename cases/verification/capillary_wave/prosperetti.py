# SPDX-License-Identifier: GPL-3.0-or-later
"""Small waves on the surface between two viscous fluids of infinite depth.

A. Prosperetti, Motion of two superposed viscous fluids, Phys. Fluids 24 (1981) 1217. The initial-value problem has a
closed form if the kinematic viscosities are equal."""
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.special import wofz

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Wave:
    """Two fluids without gravity whose surface starts at rest as a cosine."""
    wave_number: float  # 1/m
    surface_tension: float  # N/m
    lower_density: float  # kg/m3
    upper_density: float
    kinematic_viscosity: float  # m2/s, of both

    @property
    def omega(self) -> float:
        """Angular frequency without viscosity, rad/s."""
        return float(np.sqrt(self.surface_tension * self.wave_number**3 / (self.lower_density + self.upper_density)))

    @property
    def period(self) -> float:
        """Without viscosity, s."""
        return 2 * np.pi / self.omega

    def amplitude(self, time: Array) -> Array:
        """Amplitude over that at the start at times in s."""
        rate = self.kinematic_viscosity * self.wave_number**2  # nu k2
        beta = self.lower_density * self.upper_density / (self.lower_density + self.upper_density) ** 2
        square = self.omega**2
        roots = np.roots([1, -4 * beta * rate**0.5, 2 * (1 - 6 * beta) * rate, 4 * (1 - 3 * beta) * rate**1.5,
                          (1 - 4 * beta) * rate**2 + square])
        steady = 4 * (1 - 4 * beta) * rate**2
        root_of_time = np.sqrt(time)
        # exp(z2 t) erfc(z sqrt(t)) = w(i z sqrt(t)), with Faddeeva's function w
        result = steady / (2 * steady + square) * np.exp(-rate * time) * wofz(1j * np.sqrt(rate * time))
        for z in roots:
            others = np.prod([other - z for other in roots if other != z])
            result = result + (z / others * square / (z**2 - rate) * np.exp(-rate * time) *
                               wofz(1j * z * root_of_time))
        return result.real
