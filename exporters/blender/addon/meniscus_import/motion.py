# SPDX-License-Identifier: GPL-3.0-or-later
"""Keeps track of the objects that show a proxy while a slider moves or the timeline plays, and of the times when their
fine meshes are due."""

import time as clock

import bpy

#: Seconds without a change after which a fine mesh replaces a proxy.
REST = 0.4

_due = {}  # identity of an object -> time when its fine mesh is due
_rendering = False


def moves(owner):
    _due[owner] = clock.monotonic() + REST


def rests(owner):
    _due.pop(owner, None)


def is_moving(owner):
    return owner in _due


def any_moves():
    return bool(_due)


def at_rest():
    """Returns the identities of objects whose fine meshes are due. There are none while the timeline plays."""
    if is_playing():
        return []
    return [owner for owner, due in _due.items() if due <= clock.monotonic()]


def is_playing():
    """Returns True if the timeline plays in a window. Renders and background jobs always use fine meshes."""
    windows = () if bpy.app.background or _rendering else getattr(bpy.context.window_manager, "windows", ())
    return any(window.screen.is_animation_playing for window in windows)


def is_rendering():
    return _rendering


def set_rendering(rendering):
    global _rendering
    _rendering = rendering


def forget():
    _due.clear()
