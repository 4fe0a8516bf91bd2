# SPDX-License-Identifier: GPL-3.0-or-later
"""Objects whose mesh is computed from the request they store: in the background, on the timeline, and again after undo."""

import concurrent.futures
import sys
import time as clock

import bpy
import mathutils
from bpy.app.handlers import persistent

from . import attributes, build, compat, mns_reader, molecular_nodes
from .computing import engines, jobs

#: Of a mesh: the key of the request that it shows; of an object: what the last computation said.
SHOWN, ERROR = "meniscus_shown", "meniscus_error"
#: Seconds between two looks at whether something is done.
TICK = 0.01
#: Surfaces that are kept, for undo and for frames that come again; bytes.
KEPT_BYTES = 1 << 28
#: Frames that are computed ahead of the one that shows.
AHEAD = 4

_worker = jobs.Worker()
_tools = None
_kept = {}  # key -> surface, the oldest first
_ahead = None  # frames to come
_awaited = {}  # key -> future


class Wanted:
    """One look at an object, on Blender's thread: the request, the atoms if they come from Blender, with their other
    attributes."""

    def __init__(self, item, place):
        settings = item.meniscus
        self.name, self.place = item.name, place
        self.request = settings.request(place if settings.source == "FILE" else 0)
        self.atoms, self.others = None, []
        if settings.source == "OBJECT":
            if settings.atoms is None:
                raise mns_reader.MnsError("there is no object with atoms")
            self.atoms, self.others = molecular_nodes.read(settings.atoms, settings.scale, settings.selection, place)
        self.key = self.request.key(self.atoms)
        self.tools, self.folder = tools(), bpy.app.tempdir or None

    def compute(self, task):
        """On any thread."""
        return engines.compute(self.tools, self.request, self.atoms, self.folder, task)


def tools():
    """What there is to compute with; looked for once."""
    global _tools
    if _tools is None:
        found = bpy.context.preferences.addons.get(__package__)
        chosen = found.preferences if found else None
        _tools = engines.find_tools(bpy.path.abspath(chosen.package) if chosen and chosen.package else "",
                                    bpy.path.abspath(chosen.program) if chosen and chosen.program else "")
    return _tools


def look_for_tools():
    """Anew: they may have been installed, or named in the preferences."""
    global _tools
    _tools = None
    return tools()


def told_tools():
    """Lines for people."""
    found = tools()
    yield f"libmeniscus {found.library.version()}: {found.library.library_path()}" if found.library else f"No libmeniscus: {found.missing}"
    yield f"Program: {found.program}" if found.program else "No program meniscus"


def is_computed(item):
    return item is not None and item.type == "MESH" and item.meniscus.source != "NONE"


def place_at(item, time):
    """Which frame of its run an object shows at a moment of the scene; 0: it has no run. None: nothing shows."""
    settings = item.meniscus
    count = frame_count(item)
    if count == 0:
        return 0
    if settings.by_hand:
        return settings.timing().within(compat.value_at(item, "meniscus.frame", time), count)
    return settings.timing().place(time, count)


def frame_count(item):
    """Of its run; 0: it has none, or has not been read."""
    settings = item.meniscus
    if settings.source == "OBJECT":
        return len(molecular_nodes.frames_of(settings.atoms)) if settings.atoms is not None else 0
    return int(item.get("meniscus_frames", 0)) if settings.is_run else 0


def changed(item):
    """A property changed: the surface follows, in the background, if it shall."""
    if is_computed(item) and item.meniscus.live and not bpy.app.background:
        ask(item)


def ask(item):
    """Has the surface computed in the background; what waits for the same object falls away."""
    try:
        if needs_frames(item):
            _worker.ask(jobs.Task(item.name, "", _count_frames(item)))
        else:
            place = place_at(item, bpy.context.scene.frame_current_final)
            if place is None:
                empty(item)
                return
            wanted = Wanted(item, place)
            if item.data.get(SHOWN) == wanted.key:
                return
            if wanted.key in _kept:
                _worker.cancel(item.name)
                show(item, wanted, _kept[wanted.key])
                return
            _worker.ask(jobs.Task(item.name, wanted.key, lambda task: (wanted, wanted.compute(task))))
    except (mns_reader.MnsError, OSError) as error:
        fail(item, error)
        return
    if not bpy.app.timers.is_registered(_tick):
        bpy.app.timers.register(_tick, first_interval=TICK)


def needs_frames(item):
    settings = item.meniscus
    return settings.source == "FILE" and settings.is_run and item.get("meniscus_frames_of") != _run_key(item)


def _run_key(item):
    return item.meniscus.request(1).atoms_key()


def _count_frames(item):
    """Reads the run, to know how many frames it has."""
    found, request, key, folder = tools(), item.meniscus.request(1), _run_key(item), bpy.app.tempdir or None

    def work(task):
        return key, len(engines.read_atoms(found.needed_program("reading a run"), request, folder, task).numbers)

    return work


def _take_frames(item, result):
    key, count = result
    item["meniscus_frames"], item["meniscus_frames_of"] = count, key


def compute_now(item, time=None):
    """The same on this thread. Raises MnsError or OSError, and leaves the mesh as it was."""
    _worker.cancel(item.name)
    if needs_frames(item):
        task = jobs.Task(item.name, "", _count_frames(item))
        task.run()
        if task.error:
            raise task.error
        _take_frames(item, task.result)
    place = place_at(item, bpy.context.scene.frame_current_final if time is None else time)
    if place is None:
        empty(item)
        return
    wanted = Wanted(item, place)
    if item.data.get(SHOWN) == wanted.key:
        return
    surface = _kept.get(wanted.key) or _from_ahead(wanted)
    if surface is None:
        task = jobs.Task(item.name, wanted.key, wanted.compute)
        task.run()
        if task.error:
            raise task.error
        surface = task.result
    show(item, wanted, surface)


def empty(item):
    item.data.clear_geometry()
    item.data[SHOWN] = ""
    item.data.update()


def show(item, wanted, surface):
    """Puts a surface into the mesh of an object; materials, modifiers and attributes of the user remain. While the mesh is
    edited it stays as it is."""
    mesh, settings = item.data, item.meniscus
    if mesh.is_editmode:
        return
    keep(wanted.key, surface)
    theirs = {each.name for each in wanted.others}
    kept = attributes.keep(mesh, build.OURS | theirs)
    mesh.clear_geometry()
    chains = sorted(str(name) for name in surface.header.get("chain_names", []))
    if not mesh.materials:
        build.add_materials(mesh, surface, [])
    build.fill_mesh(mesh, surface, settings.scale, settings.crisp, build.fps_of(bpy.context.scene), chains,
                    trusted=surface.known_closed)
    attributes.give_back(mesh, [*kept, *wanted.others])
    place(item, surface)
    build.set_provenance(item, surface, build.Options(settings.scale, settings.crisp), chains)
    mesh[SHOWN] = wanted.key
    item[ERROR] = ""
    mesh.update()


def place(item, surface):
    """Where the object stands when it first shows something; if its scale changes the molecule's middle stays where it is."""
    settings = item.meniscus
    if settings.source == "FILE" and settings.center and "meniscus_origin" not in item:
        centers = surface["atom.center"]
        origin = build.scene_origin(bpy.context.scene, lambda: 0.5 * (centers.min(axis=0) + centers.max(axis=0)))
        item["meniscus_origin"] = [float(value) for value in origin]
        item.location = mathutils.Vector(origin) * -settings.scale
    elif "meniscus_origin" in item and item.get("meniscus_scale", settings.scale) != settings.scale:
        origin = mathutils.Vector(item["meniscus_origin"][:])
        item.location += origin * (item["meniscus_scale"] - settings.scale)


def keep(key, surface):
    _kept.pop(key, None)
    _kept[key] = surface
    total = sum(_bytes_of(each) for each in _kept.values())
    while total > KEPT_BYTES and len(_kept) > 1:
        total -= _bytes_of(_kept.pop(next(iter(_kept))))


def _bytes_of(surface):
    return sum(array.nbytes for array in surface.arrays.values())


def fail(item, error):
    item[ERROR] = str(error) or type(error).__name__
    redraw()


def redraw():
    for window in getattr(bpy.context.window_manager, "windows", ()):
        for area in window.screen.areas:
            if area.type == "VIEW_3D":
                area.tag_redraw()


def _tick():
    """On Blender's thread, while something is computed."""
    for task in _worker.take():
        item = bpy.data.objects.get(task.owner)
        if not is_computed(item):
            continue
        if task.error is not None:
            fail(item, task.error)
        elif task.key == "":
            _take_frames(item, task.result)
            ask(item)
        else:
            wanted, surface = task.result
            try:
                show(item, wanted, surface)
            except Exception as error:  # a timer that raises is never called again
                fail(item, error)
    redraw()
    return TICK if _worker.is_busy() else None


def progress_of(item):
    """Stage and seconds of what is computed for an object, or None."""
    task = _worker.task_of(item.name)
    return None if task is None else (task.stage, clock.monotonic() - task.began)


def cancel(item):
    return _worker.cancel(item.name)


def wait():
    """Until nothing is computed any more, and shows it: for scripts and tests."""
    while _worker.is_busy():
        _tick()
        clock.sleep(0.002)
    _tick()


# ---- time

def _from_ahead(wanted):
    future = _awaited.pop(wanted.key, None)
    if future is None:
        return None
    try:
        return future.result()
    except concurrent.futures.CancelledError:
        return None


def _compute_ahead(item, time):
    """Has the next frames computed. Of atoms that come from Blender nobody knows where they will be, but of its own frames."""
    global _ahead
    wanted_keys = []
    for step in range(1, AHEAD + 1):
        place = place_at(item, time + step)
        if not place:
            continue
        wanted = Wanted(item, place)
        wanted_keys.append(wanted.key)
        if wanted.key in _awaited or wanted.key in _kept:
            continue
        if _ahead is None:
            _ahead = concurrent.futures.ThreadPoolExecutor(1, "meniscus-ahead")
        task = jobs.Task(item.name, wanted.key, None)
        _awaited[wanted.key] = _ahead.submit(wanted.compute, task)
    for key in [key for key in _awaited if key not in wanted_keys][:-AHEAD or None]:
        _awaited.pop(key).cancel()


def follow(scene):
    """Every computed object shows what its atoms and its request are at the scene's time."""
    time = scene.frame_current_final
    for item in list(scene.objects):
        if not is_computed(item) or item.data.is_editmode:
            continue
        try:
            place = place_at(item, time)
            if place == 0 and item.meniscus.source == "FILE":
                continue  # nothing moves
            compute_now(item, time)
            if frame_count(item) > 1:
                _compute_ahead(item, time)
        except Exception as error:  # a handler that raises changes nothing: Blender goes on and renders
            empty(item)
            fail(item, error)
            sys.stderr.write(f"meniscus: error: {item.name}: {item[ERROR]}\n")


@persistent
def on_frame_change(scene, _depsgraph=None):
    follow(scene)


@persistent
def on_undo(*_arguments):
    """The request of before is there again, the mesh perhaps of another."""
    if bpy.app.background:
        catch_up()
    elif not bpy.app.timers.is_registered(catch_up):  # nothing may be changed before undo is done
        bpy.app.timers.register(catch_up, first_interval=0.0)


def catch_up():
    for item in bpy.data.objects:
        if is_computed(item) and SHOWN in item.data:
            ask(item)


@persistent
def on_load(*_arguments):
    _kept.clear()
    come_last()


def come_last():
    """Behind handlers that move atoms; they are called in the order in which they came."""
    handlers = bpy.app.handlers.frame_change_pre
    if on_frame_change in handlers:
        handlers.remove(on_frame_change)
    handlers.append(on_frame_change)


HANDLERS = (("undo_post", on_undo), ("redo_post", on_undo), ("load_post", on_load))


def register():
    come_last()
    for name, handler in HANDLERS:
        getattr(bpy.app.handlers, name).append(handler)


def unregister():
    global _tools, _ahead
    for timer in (_tick, catch_up):
        if bpy.app.timers.is_registered(timer):
            bpy.app.timers.unregister(timer)
    for name, handler in (*HANDLERS, ("frame_change_pre", on_frame_change)):
        handlers = getattr(bpy.app.handlers, name)
        if handler in handlers:
            handlers.remove(handler)
    _worker.forget()
    if _ahead is not None:
        for future in _awaited.values():
            future.cancel()
        _ahead.shutdown(wait=True)
        _ahead = None
    _awaited.clear()
    _kept.clear()
    engines.forget()
    _tools = None
