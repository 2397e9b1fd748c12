# SPDX-License-Identifier: GPL-3.0-or-later
"""What several studies share: runs of the mills, and readings of them that only studies ask for."""
