# SPDX-License-Identifier: GPL-3.0-or-later
"""Pressure gradients of the drag laws in the form of their publications, written here from these and not from
millFoam's own: what millDrag and the solvers are compared with.

`phi` is the bed's solidity, `speed` the superficial speed of the fluid relative to the balls (m/s): the interstitial
slip times the voidage. Laws of packed beds give the gradient itself; the others the force on a ball over Stokes's 3 pi
mu d times that speed: all of it, or (`drag_alone`) without the ball's share of the pressure gradient."""
import numpy as np


def ergun(phi, speed, d, mu, rho, viscous=150, inertial=1.75):
    e = 1 - phi
    return viscous * mu * phi**2 / (e**3 * d**2) * speed + inertial * rho * phi / (e**3 * d) * speed**2


def fand(phi, speed, d, mu, rho):
    """Regimes of Re = rho speed d/mu; between them the gradient over the speed goes with ln Re."""
    re = rho * speed * d / mu
    regimes = ((2.3, 192, 0), (5, 182, 1.92), (80, 182, 1.92), (120, 225, 1.61))

    def at(number):
        limit, *constants = regimes[number]
        speed_there = limit * mu / (rho * d)
        return ergun(phi, speed_there, d, mu, rho, *constants) / speed_there

    for low, high in ((0, 1), (2, 3)):
        if regimes[low][0] < re < regimes[high][0]:
            share = np.log(re / regimes[low][0]) / np.log(regimes[high][0] / regimes[low][0])
            return speed * (at(low) + share * (at(high) - at(low)))
    return ergun(phi, speed, d, mu, rho, *regimes[0 if re <= 2.3 else 1 if re <= 80 else 3][1:])


def kozeny_carman(phi, speed, d, mu, rho):
    """With the specific surface 6/d and the constant 5."""
    return 5 * mu * (6 / d) ** 2 * phi**2 / (1 - phi) ** 3 * speed


def darcy(phi, speed, d, mu, rho):
    return ergun(phi, speed, d, mu, rho, inertial=0)


def darcy_diameter(drag, phi, viscosity):
    """Diameter (m) of balls whose drag beta/(epsilon rho) by `darcy` is this (1/s), at a kinematic viscosity (m2/s)."""
    return np.sqrt(150 * viscosity / drag) * phi / (1 - phi)


def from_force(force, drag_alone):
    """The gradient of a law of the force: that on all balls of a volume, which the voids' pressure alone carries where
    the law is of the drag alone."""
    def gradient(phi, speed, d, mu, rho):
        balls = phi / (np.pi * d**3 / 6)
        total = balls * 3 * np.pi * mu * d * speed * force(phi, rho * speed * d / mu)
        return total / (1 - phi) if drag_alone else total
    return gradient


def wen_yu(phi, re):
    """Of the gradient 3/4 C_D rho v^2/d phi e^-2.65 with the interstitial slip v and C_D of one sphere at Re."""
    coefficient = 24 / re * (1 + 0.15 * re**0.687) if re <= 1000 else 0.44
    return coefficient * re / 24 * (1 - phi) ** -4.65


def hill(phi, re):
    """Of the radius's Reynolds number: F0 + F1 Re^2 up to F3/F1, then F0 + F3 Re."""
    r = re / 2
    f0 = (1 + 3 * (phi / 2) ** 0.5 + 135 / 64 * phi * np.log(phi) + 17.14 * phi) / (
        1 + 0.681 * phi - 8.48 * phi**2 + 8.16 * phi**3) if phi < 0.4 else 10 * phi / (1 - phi) ** 3
    f1 = 0.11 + 0.00051 * np.exp(11.6 * phi)
    f3 = 0.0673 + 0.212 * phi + 0.0232 / (1 - phi) ** 5
    return f0 + f1 * r**2 if r <= f3 / f1 else f0 + f3 * r


def benyahia(phi, re):
    r = re / 2
    w = np.exp(-10 * (0.4 - phi) / phi)
    dense = 10 * phi / (1 - phi) ** 3
    f0 = f2 = dense
    if phi < 0.4:
        top = 1 + 3 * (phi / 2) ** 0.5 + 135 / 64 * phi * np.log(phi)
        f0 = (1 - w) * (top + 17.14 * phi) / (1 + 0.681 * phi - 8.48 * phi**2 + 8.16 * phi**3) + w * dense
        f2 = (1 - w) * (top + 17.89 * phi) / (1 + 0.681 * phi - 11.03 * phi**2 + 15.41 * phi**3) + w * dense
    f1 = 0.11 + 0.00051 * np.exp(11.6 * phi)
    f3 = 0.0673 + 0.212 * phi + 0.0232 / (1 - phi) ** 5
    switch = (f3 + (f3**2 - 4 * f1 * (f0 - f2)) ** 0.5) / (2 * f1)
    return f0 + f1 * r**2 if r <= switch else f2 + f3 * r


def beetstra(phi, re):
    e = 1 - phi
    return 10 * phi / e**2 + e**2 * (1 + 1.5 * phi**0.5) + 0.413 * re / (24 * e**2) * (
        1 / e + 3 * e * phi + 8.4 * re**-0.343) / (1 + 10 ** (3 * phi) * re ** (-(1 + 4 * phi) / 2))


def sphere_of_dallavalle(re):
    return (0.63 + 4.8 / re**0.5) ** 2 * re / 24


def di_felice(phi, re):
    chi = 3.7 - 0.65 * np.exp(-((1.5 - np.log10(re)) ** 2) / 2)
    return sphere_of_dallavalle(re) * (1 - phi) ** -chi


def rong(phi, re):
    e = 1 - phi
    chi = 2.65 * (e + 1) - (5.3 - 3.5 * e) * e**2 * np.exp(-((1.5 - np.log10(re)) ** 2) / 2)
    return sphere_of_dallavalle(re) * e**-chi


def tang(phi, re):
    e = 1 - phi
    return 10 * phi / e**2 + e**2 * (1 + 1.5 * phi**0.5) + (
        0.11 * phi * (1 + phi) - 0.00456 / e**4 + (0.169 * e + 0.0644 / e**4) * re**-0.343) * re


def tenneti(phi, re):
    e = 1 - phi
    return (1 + 0.15 * re**0.687) / e**3 + 5.81 * phi / e**3 + 0.48 * phi ** (1 / 3) / e**4 + phi**3 * re * (
        0.95 + 0.61 * phi**3 / e**2)


GRADIENTS = {
    "Ergun": ergun, "Fand": fand, "KozenyCarman": kozeny_carman, "Darcy": darcy,
    "WenYu": from_force(wen_yu, False), "ErgunWenYu": lambda phi, *rest: (
        ergun if phi > 0.2 else from_force(wen_yu, False))(phi, *rest),
    "Hill": from_force(hill, False), "Benyahia": from_force(benyahia, False),
    "Beetstra": from_force(beetstra, True), "DiFelice": from_force(di_felice, True), "Rong": from_force(rong, True),
    "Tang": from_force(tang, True), "Tenneti": from_force(tenneti, False),
}
