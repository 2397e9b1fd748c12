# SPDX-License-Identifier: GPL-3.0-or-later
"""What is read off fields, maps and tables: numbers with their definitions and errors."""
