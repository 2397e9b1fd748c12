# SPDX-License-Identifier: GPL-3.0-or-later
"""Small standing waves between two inviscid fluids under gravity, by linear potential flow.

A mode with surface shape f(x) has, in a fluid on either side of the surface, a potential with phi_n = f there and phi =
f/lambda: lambda is the sloshing eigenvalue of that fluid's room. With densities rho, both accelerations and a drag per
mass gamma u (Darcy's) in each, the pressures at the surface eta = q(t) f(x) balance when

    (rho_s/lambda_s + rho_a/lambda_a) q'' + (gamma_s rho_s/lambda_s + gamma_a rho_a/lambda_a) q'
    + (rho_s - rho_a) g q = 0

(Lamb, Hydrodynamics, articles 231 and 257 to 259; Ibrahim 2005, Liquid Sloshing Dynamics, chapter 1.)"""
from dataclasses import dataclass

import numpy as np
from scipy.linalg import eigh


@dataclass
class Fluid:
    """Density, kg/m3; eigenvalue of its room, 1/m; drag per mass and velocity, 1/s."""
    density: float
    eigenvalue: float
    drag: float = 0.0


@dataclass
class Wave:
    """q'' + damping q' + omega^2 q = 0; damping in 1/s, omega in rad/s."""
    damping: float
    omega: float

    @property
    def slow_rate(self):
        """The smaller of the two rates of decay of an overdamped wave, 1/s."""
        half = self.damping / 2
        return half - np.sqrt(half**2 - self.omega**2)

    def from_rest(self, time):
        """q(t)/q(0) of an overdamped wave that starts at rest."""
        slow = self.slow_rate
        fast = self.damping - slow
        return (fast * np.exp(-slow * time) - slow * np.exp(-fast * time)) / (fast - slow)


def wave(slurry, air, gravity):
    """The Wave that these two Fluids make."""
    inertia = [fluid.density / fluid.eigenvalue for fluid in (slurry, air)]
    friction = sum(fluid.drag * share for fluid, share in zip((slurry, air), inertia))
    stiffness = (slurry.density - air.density) * gravity
    return Wave(friction / sum(inertia), np.sqrt(stiffness / sum(inertia)))


def box_eigenvalue(width, depth):
    """Eigenvalue, 1/m, of the first mode cos(k x), k = pi/width, of a box filled to this depth."""
    k = np.pi / width
    return k * np.tanh(k * depth)


def half_circle_mode(radius, terms=16):
    """First mode of a circular section that is half full: eigenvalue in 1/m and surface shape f(x), 1 at x = radius.

    Ritz's method with the harmonics r^n sin(n theta), theta from the lowest point: the eigenvalue is the minimum of
    integral |grad phi|^2 over the fluid by integral phi^2 over the surface. It converges from above to 1.35573/radius,
    the value of Budiansky 1960 (J. Aerospace Sci. 27:161) and of McIver 1989 (J. Fluid Mech. 201:243)."""
    n = np.arange(1, terms + 1)
    plus, minus = n[:, None] + n, n[:, None] - n
    # Integral of cos((n - m) theta) over the half circle; sinc(x) is sin(pi x)/(pi x)
    energy = np.outer(n, n) / plus * np.pi * np.sinc(minus / 2)
    at_surface = np.sin(n * np.pi / 2)
    surface = 2 * np.outer(at_surface, at_surface) / (plus + 1)
    # The even harmonics vanish on the surface, so surface is singular and must be on the left
    values, vectors = eigh(surface, energy)
    weights = at_surface * vectors[:, -1]

    def shape(x):
        s = np.clip(np.asarray(x) / radius, -1, 1)
        return np.sign(s) * (np.abs(s)[..., None] ** n @ weights) / weights.sum()

    return 1 / (values[-1] * radius), shape
