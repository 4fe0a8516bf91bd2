# SPDX-License-Identifier: GPL-3.0-or-later
"""Which objects show a proxy for now, as a slider moves or the timeline plays, and when their fine meshes are due."""

import time as clock

import bpy
from bpy.app.handlers import persistent

#: Seconds without a change after which a fine mesh follows a proxy.
REST = 0.4

_due = {}  # identity of an object -> when
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
    """Identities of objects that have not moved for a while; none as long as the timeline plays."""
    if is_playing():
        return []
    return [owner for owner, due in _due.items() if due <= clock.monotonic()]


def is_playing():
    """Whether a user watches the timeline as it runs; pictures and files are made of fine meshes."""
    windows = () if bpy.app.background or _rendering else getattr(bpy.context.window_manager, "windows", ())
    return any(window.screen.is_animation_playing for window in windows)


def is_rendering():
    return _rendering


def forget():
    _due.clear()


@persistent
def on_render(scene, *_arguments):
    """Pictures do not wait for rest."""
    global _rendering
    from . import compat, computed  # which needs this

    _rendering = True
    for item in [item for item in scene.objects if is_moving(compat.identity(item)) and computed.is_computed(item)]:
        rests(compat.identity(item))
        computed.come_to_rest(item)


@persistent
def on_rendered(*_arguments):
    global _rendering
    _rendering = False


HANDLERS = (("render_init", on_render), ("render_complete", on_rendered), ("render_cancel", on_rendered))
