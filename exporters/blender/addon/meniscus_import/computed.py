# SPDX-License-Identifier: GPL-3.0-or-later
"""Objects whose mesh is computed from the request they store: in the background, on the timeline, and again after undo."""

import dataclasses
import sys
import time as clock

import bpy
import mathutils
import numpy as np
from bpy.app.handlers import persistent

from . import attributes, build, compat, mesh_arrays, mns_reader, molecular_nodes, motion
from .computing import process

#: Of a mesh: the key of the request that it shows; of an object: what the last computation said.
SHOWN, ERROR = "meniscus_shown", "meniscus_error"
#: Seconds between two looks at whether something is done.
TICK = 0.005
#: Seconds between two looks at how far it is.
TELL = 0.2
#: Surfaces that are kept, for undo and for frames that come again; bytes.
KEPT_BYTES = 1 << 28
#: Frames that are computed ahead of the one that shows.
AHEAD = 4

_process = None
_told = 0.0  # when sidebars were last drawn anew
_kept = {}  # key -> Shown or None, the oldest first
_awaited = {}  # key -> process.Job of a frame to come
_of_user = {}  # name of a mesh -> (whose atoms, attributes of the user by atom)


class Wanted:
    """One look at an object: the request, the atoms if they come from Blender, with their other attributes, and how they come
    into a mesh."""

    def __init__(self, item, place, in_motion=False):
        settings = item.meniscus
        self.request = settings.request(place if settings.source == "FILE" else 0, in_motion)
        self.scale, self.crisp = settings.scale, settings.crisp
        self.atoms, self.others = None, []
        if settings.source == "OBJECT":
            if settings.atoms is None:
                raise mns_reader.MnsError("there is no object with atoms")
            self.atoms, self.others = molecular_nodes.read(settings.atoms, settings.scale, settings.selection, place)
        shape = self.request.key(self.atoms, [each.values for each in self.others])
        self.key = f"{shape} {self.scale:.6g} {int(self.crisp)} " + ",".join(each.name for each in self.others)

    def ask(self, owner, urgency=process.NOW):
        """A process.Job whose result is for Shown."""
        about = {"request": dataclasses.asdict(self.request), "atoms": self.atoms and vars(self.atoms), "scale": self.scale,
                 "crisp": self.crisp, "others": [vars(each) for each in self.others]}
        job = working().ask(owner, self.key, "surface", about, urgency)
        job.make = lambda result: result and Shown(result, self)
        return job


class Shown:
    """What a mesh shows: header of the surface, middle of its atoms in Å, how many they are, and the arrays that fill the mesh,
    whose positions lie about `base`, Å."""

    def __init__(self, result, wanted):
        self.surface = mns_reader.Surface("a computed surface", result["header"], {})
        self.middle, self.base, self.atoms = result["middle"], result["base"], result["atoms"]
        self.arrays = mesh_arrays.MeshArrays(**result["arrays"])
        self.scale, self.crisp = wanted.scale, wanted.crisp
        self.names = mesh_arrays.names_of(self.surface)
        self.others = {each.name for each in wanted.others}


def working():
    """The process that computes, as the preferences want it now."""
    global _process
    found = bpy.context.preferences.addons.get(__package__)
    chosen = found.preferences if found else None
    package, program = (bpy.path.abspath(getattr(chosen, name, "")) for name in ("package", "program"))
    if _process is not None and (_process.package, _process.program) != (package, program):
        end()
    if _process is None:
        _process = process.Process(package, program, bpy.app.tempdir or None)
    return _process


def look_for_tools():
    """Looks again, because they may have been installed since. Returns what was found, as works.Tools.told does."""
    end()
    return working().told()


def told_tools():
    """Lines for people."""
    try:
        found = working().told()
    except mns_reader.MnsError as error:
        yield str(error)
        return
    yield f"libmeniscus {found['version']}: {found['library']}" if found["library"] else f"No libmeniscus: {found['missing']}"
    yield f"Program: {found['program']}" if found["program"] else "No program meniscus, which only trajectories need"


def end():
    """Ends what computes; it starts again when it is needed."""
    global _process
    if _process is not None:
        _process.end()
        _process = None
    _awaited.clear()


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
    """A property changed: the surface follows in the background, if that is switched on."""
    if is_computed(item) and item.meniscus.live and not bpy.app.background:
        ask(item, in_motion=True)


def ask(item, in_motion=False):
    """Has the surface computed in the background; what waits for the same object falls away. in_motion: a proxy, where the object
    wants that, which a fine mesh follows."""
    _wait_for_rest(item, in_motion)
    try:
        if needs_frames(item):
            _ask_for_frames(item)
        else:
            place = place_at(item, bpy.context.scene.frame_current_final)
            if place is None:
                empty(item)
                return
            wanted = Wanted(item, place)
            if in_motion and item.data.get(SHOWN) != wanted.key and wanted.key not in _kept:
                wanted = Wanted(item, place, True)
            if item.data.get(SHOWN) == wanted.key:
                return
            if wanted.key in _kept:
                working().drop(item.name)
                show(item, wanted.key, _kept[wanted.key])
                return
            wanted.ask(item.name)
    except (mns_reader.MnsError, OSError) as error:
        fail(item, error)
        return
    _go_on_ticking()


def _go_on_ticking():
    if not bpy.app.timers.is_registered(_tick):
        bpy.app.timers.register(_tick, first_interval=TICK)


def _wait_for_rest(item, in_motion):
    if in_motion and item.meniscus.detail == "AUTO":
        motion.moves(item.name)
        _go_on_ticking()
    else:
        motion.rests(item.name)


def _come_to_rest():
    """Asks for the fine meshes that are due, once their proxies are there."""
    for name in motion.at_rest():
        item = bpy.data.objects.get(name)
        if not is_computed(item):
            motion.rests(name)
        elif working().job_of(name) is None:
            ask(item)


def come_to_rest(item):
    """Shows its fine mesh now, or says what went wrong."""
    try:
        compute_now(item)
    except (mns_reader.MnsError, OSError) as error:
        fail(item, error)


def needs_frames(item):
    settings = item.meniscus
    return settings.source == "FILE" and settings.is_run and item.get("meniscus_frames_of") != _run_key(item)


def _run_key(item):
    return item.meniscus.request(1).atoms_key()


def _ask_for_frames(item):
    """How many the run has."""
    return working().ask(item.name, _run_key(item), "count", {"request": dataclasses.asdict(item.meniscus.request(1))})


def _take_frames(item, job):
    item["meniscus_frames"], item["meniscus_frames_of"] = job.result, job.key


def compute_now(item, time=None, in_motion=False):
    """The same, and waits for it. Raises MnsError or OSError, and leaves the mesh as it was."""
    working().drop(item.name)
    if needs_frames(item):
        _take_frames(item, _finished(_ask_for_frames(item)))
    place = place_at(item, bpy.context.scene.frame_current_final if time is None else time)
    if place is None:
        empty(item)
        return
    wanted = Wanted(item, place, in_motion)
    if item.data.get(SHOWN) == wanted.key:
        return
    if wanted.key not in _kept:
        job = _finished(_awaited.pop(wanted.key, None) or wanted.ask(item.name))
        keep(wanted.key, job.make(job.result))
    show(item, wanted.key, _kept[wanted.key])


def _finished(job):
    """Waits; raises what went wrong."""
    _deliver([other for other in working().wait(job) if other is not job])
    if job.error is not None:
        raise job.error
    return job


def empty(item):
    shown = _kept.get(item.data.get(SHOWN))
    if shown is not None:
        _keep_of_user(item, shown)
    build.clear_geometry(item.data)
    item.data[SHOWN] = ""
    item.data.update()


def show(item, key, shown):
    """Puts what was computed into the mesh of an object; materials, modifiers and attributes of the user remain. While the mesh
    is edited it stays as it is."""
    mesh = item.data
    if mesh.is_editmode:
        return
    if shown is None:
        empty(item)
        mesh[SHOWN] = key
        return
    kept = _keep_of_user(item, shown)
    build.clear_geometry(mesh)
    if not mesh.materials:
        build.add_materials(mesh, shown.surface, [])
    place(item, shown)
    build.fill_mesh(mesh, arrays_about(item, shown), build.fps_of(bpy.context.scene), trusted=True)
    attributes.give_back(mesh, kept, shown.arrays)
    build.set_provenance(item, shown.surface, build.Options(shown.scale, shown.crisp), shown.names)
    mesh[SHOWN] = key
    item[ERROR] = ""
    if frame_count(item) or item.meniscus.source == "OBJECT":
        build.let_exporters_follow(mesh)
    mesh.update()


def _keep_of_user(item, shown):
    """Attributes that the user gave to the mesh, also those of atoms that it does not show now."""
    mesh, settings = item.data, item.meniscus
    source = settings.file if settings.source == "FILE" else settings.atoms and settings.atoms.name
    of, older = _of_user.get(mesh.name, (None, ()))
    kept = attributes.keep(mesh, build.OURS | shown.others, older if of == source else ())
    _of_user[mesh.name] = source, kept
    return kept


def place(item, shown):
    """The place of the object when it first shows something of a file: its origin in the middle of the molecule, about which it
    turns. If its scale changes the middle stays where it is, or where the file has it. Objects of 0.1.0 have the file's origin."""
    before = item.get("meniscus_scale", shown.scale)
    if item.meniscus.source == "FILE" and "meniscus_generator" not in item:
        origin = np.zeros(3)
        if item.meniscus.center:
            source = build.source_of(shown.surface.header)
            origin = build.scene_origin(bpy.context.scene, lambda: shown.middle, source, shown.atoms)
            item["meniscus_origin"] = [float(value) for value in origin]
        item["meniscus_middle"] = [float(value) for value in shown.middle]
        item["meniscus_atoms"] = shown.atoms
        item.location += mathutils.Vector((shown.middle - origin) * shown.scale)
    elif before != shown.scale and ("meniscus_middle" in item) != ("meniscus_origin" in item):
        place = mathutils.Vector(item["meniscus_middle" if "meniscus_middle" in item else "meniscus_origin"][:])
        item.location += place * ((shown.scale - before) * (1.0 if "meniscus_middle" in item else -1.0))


def arrays_about(item, shown):
    """The arrays of what is shown, with positions about the object's origin."""
    shift = shown.base - np.array(item.get("meniscus_middle", (0.0, 0.0, 0.0))[:])
    if item.meniscus.source != "FILE" or not shift.any():
        return shown.arrays
    return dataclasses.replace(shown.arrays, positions=(shown.arrays.positions + shift * shown.scale).astype(np.float32))


def keep(key, shown):
    """For as long as there is room; the oldest go."""
    _kept.pop(key, None)
    _kept[key] = shown
    sizes = {each: 0 if kept is None else kept.arrays.nbytes for each, kept in _kept.items()}
    total = sum(sizes.values())
    while total > KEPT_BYTES and len(_kept) > 1:
        oldest = next(iter(_kept))
        total -= sizes[oldest]
        del _kept[oldest]


def fail(item, error):
    item[ERROR] = str(error) or type(error).__name__
    redraw()


def redraw():
    """Redraws the sidebars, which show the progress; views are drawn again when a mesh has changed, which takes longer."""
    for window in getattr(bpy.context.window_manager, "windows", ()):
        for area in window.screen.areas:
            if area.type == "VIEW_3D":
                for region in area.regions:
                    if region.type == "UI":
                        region.tag_redraw()


def _tick():
    """While something is computed."""
    global _told
    done = working().take()
    _deliver(done)
    if done or clock.monotonic() - _told > TELL:
        _told = clock.monotonic()
        redraw()
    _come_to_rest()
    return TICK if working().is_busy() or motion.any_moves() else None


def _deliver(done):
    """Shows what was asked for in the background, and keeps what was computed ahead."""
    for job in done:
        if job.make is not None and job.error is None:
            keep(job.key, job.make(job.result))
        if _awaited.get(job.key) is job:
            del _awaited[job.key]
            continue
        item = _item_of(job)
        if not is_computed(item):
            continue
        if job.error is not None:
            fail(item, job.error)
        elif job.make is None:
            _take_frames(item, job)
            ask(item, motion.is_moving(item.name))
        else:
            try:
                show(item, job.key, _kept[job.key])
            except Exception as error:  # a timer that raises is never called again
                fail(item, error)


def progress_of(item):
    """Stage and seconds of what is computed for an object, or None."""
    job = _process and _process.job_of(item.name)
    return None if job is None else (job.stage, clock.monotonic() - job.began)


def cancel(item):
    """At once, whatever is done for it. True if there was something."""
    if not working().stop(item.name):
        return False
    _awaited.clear()
    for job in working().take():  # they ended with it
        other = _item_of(job)
        if is_computed(other):
            ask(other)
    return True


def _item_of(job):
    return bpy.data.objects.get(job.owner) if isinstance(job.owner, str) else None


def wait():
    """Until nothing is computed any more, and shows it: for scripts and tests."""
    while working().is_busy():
        _deliver(working().take(1.0))


# ---- time

def _compute_ahead(item, time, in_motion):
    """Has the next frames computed. Only for its own frames: where atoms that come from Blender will be is not known."""
    wanted_keys = set()
    for step in range(1, AHEAD + 1):
        place = place_at(item, time + step)
        if not place:
            continue
        wanted = Wanted(item, place, in_motion)
        wanted_keys.add(wanted.key)
        if wanted.key not in _awaited and wanted.key not in _kept:
            _awaited[wanted.key] = wanted.ask((item.name, wanted.key), process.NEXT)
    for key, job in list(_awaited.items()):
        if job.owner[0] == item.name and key not in wanted_keys:
            working().drop(job.owner)
            del _awaited[key]


def follow(scene):
    """Every computed object shows what its atoms and its request are at the scene's time."""
    time, in_motion = scene.frame_current_final, motion.is_playing()
    for item in list(scene.objects):
        if not is_computed(item) or item.data.is_editmode:
            continue
        try:
            place = place_at(item, time)
            if place == 0 and item.meniscus.source == "FILE":
                continue  # nothing moves
            _wait_for_rest(item, in_motion)
            compute_now(item, time, in_motion)
            if frame_count(item) > 1:
                _compute_ahead(item, time, in_motion)
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
    for memory in (_kept, _awaited, _of_user):
        memory.clear()
    motion.forget()
    if _process is not None:
        _process.drop_all()
    come_last()


def come_last():
    """Behind handlers that move atoms; they are called in the order in which they came."""
    handlers = bpy.app.handlers.frame_change_pre
    if on_frame_change in handlers:
        handlers.remove(on_frame_change)
    handlers.append(on_frame_change)


HANDLERS = (("undo_post", on_undo), ("redo_post", on_undo), ("load_post", on_load), *motion.HANDLERS)


def register():
    come_last()
    for name, handler in HANDLERS:
        getattr(bpy.app.handlers, name).append(handler)


def unregister():
    for timer in (_tick, catch_up):
        if bpy.app.timers.is_registered(timer):
            bpy.app.timers.unregister(timer)
    for name, handler in (*HANDLERS, ("frame_change_pre", on_frame_change)):
        handlers = getattr(bpy.app.handlers, name)
        if handler in handlers:
            handlers.remove(handler)
    end()
    _kept.clear()
    _of_user.clear()
    motion.forget()
