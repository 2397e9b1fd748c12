# SPDX-License-Identifier: GPL-3.0-or-later
"""Text of a small stirred mill's mill.yaml."""

UPPER_PINS = "      - {height: 0.025, length: 0.050, thickness: 0.006, angle: 90}\n"
MILL = """title: small stirred mill
machine: stirred
geometry:
  diameter: 0.06
  height: 0.09
  impeller:
    shaft: {diameter: 0.012, end: 0.008}
    pins:
      - {height: 0.013, length: 0.050, thickness: 0.006}
""" + UPPER_PINS + """speed: {tip_speed: 0.8}
charge: {level: 0.035, share: 0.5, diameter: 0.0045}
materials:
  ball: {density: 2700, youngs_modulus: 1.0e9, poisson_ratio: 0.3}
  wall: {density: 7850, youngs_modulus: 1.0e9, poisson_ratio: 0.3}
  ball_ball: {restitution: 0.6, friction: 0.4, rolling_friction: 0}
  ball_wall: {restitution: 0.5, friction: 0.3, rolling_friction: 0}
"""


def small_mill(more: str, *changes: tuple[str, str]) -> str:
    """The mill's text with more of its sections; changes: (text that must be there, its replacement)."""
    text = MILL
    for old, new in changes:
        if old not in text:
            raise AssertionError(f"the mill has no '{old}'")
        text = text.replace(old, new)
    return text + more
