# SPDX-License-Identifier: GPL-3.0-or-later
"""Computes surfaces of atoms off the UI thread, by libmeniscus or by the program. It does not use Blender."""
