# SPDX-License-Identifier: GPL-3.0-or-later
"""Physical constants that do not depend on the mill."""
GRAVITY = 9.81  # m/s2, as `gravity_m_s2` of every resolved mill
