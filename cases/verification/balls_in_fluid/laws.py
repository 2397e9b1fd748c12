# SPDX-License-Identifier: GPL-3.0-or-later
"""Closed forms: drag laws as published, the balance of a ball's weight with them, minimum fluidisation."""
import numpy as np
from scipy.optimize import brentq

from column import BALL, VISCOSITY, WATER
from millfoam.files.constants import GRAVITY

BUOYANT = (BALL - WATER) * GRAVITY  # N/m3, of balls in water


def ergun_gradient(solidity, diameter, superficial):
    """Loss of pressure in a bed at rest, Pa/m (Ergun 1952), as he printed it."""
    voidage = 1 - solidity
    return (150 * VISCOSITY * solidity**2 / (voidage**3 * diameter**2) * superficial
            + 1.75 * WATER * solidity / (voidage**3 * diameter) * superficial**2)


def minimum_fluidisation(solidity, diameter):
    """Superficial velocity at which Ergun's loss carries the buoyant weight of the bed, m/s."""
    return brentq(lambda u: ergun_gradient(solidity, diameter, u) - solidity * BUOYANT, 0, 10)


def di_felice_force(solidity, diameter, slip):
    """Force on all balls of a volume in a bed at rest, N/m3: their drag after Di Felice 1994 and their share of the
    pressure that it loses, which together are the loss. slip: of the fluid in the pores, m/s.

    One ball alone has 0.5 C_D rho (pi d2/4) U|U|, C_D = (0.63 + 4.8/sqrt(Re))2 with the superficial velocity U; among
    others e^-chi as much, and its share of the pressure makes 1/e of that."""
    voidage = 1 - solidity
    superficial = voidage * slip
    reynolds = WATER * abs(superficial) * diameter / VISCOSITY
    coefficient = (0.63 + 4.8 / np.sqrt(reynolds))**2
    exponent = 3.7 - 0.65 * np.exp(-(1.5 - np.log10(reynolds))**2 / 2)
    one = coefficient * WATER / 2 * np.pi / 4 * diameter**2 * superficial * abs(superficial)
    return one * voidage**-exponent * solidity / (np.pi / 6 * diameter**3) / voidage


def wen_yu_force(solidity, diameter, slip):
    """The same after Wen & Yu 1966, who give drag only: beta/e slip, beta = 3/4 C_D rho phi e |slip|/d e^-2.65 with
    C_D = 24/Re (1 + 0.15 Re^0.687) up to Re 1000, 0.44 beyond, and the superficial Re."""
    voidage = 1 - solidity
    reynolds = WATER * voidage * abs(slip) * diameter / VISCOSITY
    coefficient = 24 / reynolds * (1 + 0.15 * reynolds**0.687) if reynolds < 1000 else 0.44
    beta = 0.75 * coefficient * WATER * solidity * voidage * abs(slip) / diameter * voidage**-2.65
    return beta * slip / voidage


FORCES = {"DiFelice": di_felice_force, "WenYu": wen_yu_force}


def terminal_slip(law, solidity, diameter):
    """Slip at which the force carries the buoyant weight of the balls, m/s: (rho_b - rho_f) g phi = beta u/e."""
    return brentq(lambda slip: FORCES[law](solidity, diameter, slip) - solidity * BUOYANT, 1e-6, 10)
