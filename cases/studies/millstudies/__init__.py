# SPDX-License-Identifier: GPL-3.0-or-later
"""Code for several studies: runs of the mills, and readings that only studies need."""
