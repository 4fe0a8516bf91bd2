# SPDX-License-Identifier: GPL-3.0-or-later
"""Objects whose mesh is computed from the request that they store: in the background, on the timeline, and again after
undo."""

import dataclasses
import time as clock

import bpy
from bpy.app.handlers import persistent

from . import compat, libraries, mns_reader, molecular_nodes, motion, showing
from .computing import process
from .showing import SHOWN, Shown, _kept, empty, frame_count, is_computed, keep, place_at, show

#: Seconds between two checks for finished results.
TICK = 0.005
#: Seconds between two updates of the displayed progress.
REDRAW_INTERVAL = 0.2
#: The number of frames that are computed ahead of the one that shows.
AHEAD = 4

_process = None
_last_redraw = 0.0  # time when sidebars were last redrawn
_ahead = {}  # key -> process.Job of a later frame


class SurfaceRequest:
    """The surface that an object requests at one time: its request, its atoms with their other attributes if they come
    from Blender, and the scale and colours of its mesh."""

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

    def submit(self, owner, urgency=process.NOW):
        """Returns a process.Job whose result becomes a Shown."""
        about = {
            "request": dataclasses.asdict(self.request), "atoms": self.atoms and vars(self.atoms), "scale": self.scale,
            "crisp": self.crisp, "others": [vars(each) for each in self.others]}
        job = working().submit(owner, self.key, "surface", about, urgency)
        job.make = lambda result: result and Shown(result, self)
        return job


def working():
    """Returns the process that computes, with the tools of the current preferences."""
    global _process
    found = bpy.context.preferences.addons.get(__package__)
    chosen = found.preferences if found else None
    package, program = (bpy.path.abspath(getattr(chosen, name, "")) for name in ("package", "program"))
    if _process is not None and (_process.package, _process.program) != (package, program):
        end()
    if _process is None:
        _process = process.Process(package, program, bpy.app.tempdir or None)
    return _process


def search_tools_again():
    """Searches for the tools again, because they may have been installed meanwhile. Returns the result of
    jobs.Tools.describe_tools()."""
    end()
    return working().describe_tools()


def tool_lines():
    """Yields lines for the user about the tools that were found."""
    try:
        found = working().describe_tools()
    except mns_reader.MnsError as error:
        yield str(error)
        return
    yield (f"libmeniscus {found['version']}: {found['library']}" if found["library"] else
           f"No libmeniscus: {found['missing']}")
    yield f"Program: {found['program']}" if found["program"] else "No program meniscus, which only trajectories need"


def end():
    """Ends the process that computes. It starts again when it is needed."""
    global _process
    if _process is not None:
        _process.end()
        _process = None
    _ahead.clear()


def changed(item):
    """Updates the surface in the background after a property of the object changed, if live updates are switched on."""
    if is_computed(item) and item.meniscus.live and not bpy.app.background:
        update_in_background(item, in_motion=True)


def update_in_background(item, in_motion=False):
    """Requests the surface of an object in the background. Waiting requests of the same object are dropped. in_motion:
    True to request a proxy first if the settings of the object say so; a fine mesh follows."""
    _wait_for_rest(item, in_motion)
    try:
        if needs_frames(item):
            _ask_for_frames(item)
        else:
            place = place_at(item, bpy.context.scene.frame_current_final)
            if place is None:
                empty(item)
                return
            wanted = SurfaceRequest(item, place)
            if in_motion and item.data.get(SHOWN) != wanted.key and wanted.key not in _kept:
                wanted = SurfaceRequest(item, place, True)
            if item.data.get(SHOWN) == wanted.key or wanted.key in _kept:
                working().drop(compat.identity(item))  # drops requests from before an undo
                _show_kept(item, wanted.key)
                return
            wanted.submit(compat.identity(item))
            showing.watch(item)
    except (mns_reader.MnsError, OSError) as error:
        fail(item, error)
        return
    _start_timer()


def _start_timer():
    if not bpy.app.timers.is_registered(_tick):
        bpy.app.timers.register(_tick, first_interval=TICK)


def _wait_for_rest(item, in_motion):
    if in_motion and item.meniscus.detail == "AUTO":
        motion.moves(compat.identity(item))
        _start_timer()
    else:
        motion.rests(compat.identity(item))


def _come_to_rest():
    """Requests the fine meshes that are due, as soon as their proxies are done."""
    for owner in motion.at_rest():
        item = compat.of_identity(owner)
        if not is_computed(item):
            motion.rests(owner)
        elif working().job_of(owner) is None:
            update_in_background(item)


def come_to_rest(item):
    """Computes and shows the fine mesh of an object, or reports the error."""
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
    """Requests the number of frames of an object's run, and returns the process.Job."""
    return working().submit(compat.identity(item), _run_key(item), "count",
                         {"request": dataclasses.asdict(item.meniscus.request(1))})


def _take_frames(item, job):
    item["meniscus_frames"], item["meniscus_frames_of"] = job.result, job.key


def count_frames(item):
    """Computes the number of frames of an object's run, if it is not known yet."""
    if needs_frames(item):
        _take_frames(item, _finished(_ask_for_frames(item)))


def compute_now(item, time=None, in_motion=False):
    """Computes and shows the surface of an object, and waits for it. Raises MnsError or OSError, and then leaves the
    mesh unchanged."""
    working().drop(compat.identity(item))
    count_frames(item)
    show_place(item, place_at(item, bpy.context.scene.frame_current_final if time is None else time), in_motion)


def show_place(item, place, in_motion=False):
    """Computes and shows the surface of an object at a place of its run, and waits for it. place: None shows
    nothing."""
    if place is None:
        empty(item)
        libraries.succeed(item)
        return
    wanted = SurfaceRequest(item, place, in_motion)
    if item.data.get(SHOWN) != wanted.key and wanted.key not in _kept:
        job = _finished(_ahead.pop(wanted.key, None) or wanted.submit(compat.identity(item)))
        keep(wanted.key, job.make(job.result))
    _show_kept(item, wanted.key)


def _show_kept(item, key):
    """Shows a kept surface, unless the object shows it already."""
    if item.data.get(SHOWN) == key:
        libraries.succeed(item)
    else:
        show(item, key, _kept[key])


def _finished(job):
    """Waits for a job and returns it. Raises the error of the job."""
    _deliver([other for other in working().wait(job) if other is not job])
    if job.error is not None:
        raise job.error
    return job


def fail(item, error):
    libraries.fail(item, error)
    redraw()


def redraw():
    """Redraws the sidebars, which show the progress. Views are not redrawn, because that takes longer; Blender does it
    when a mesh changes."""
    for window in getattr(bpy.context.window_manager, "windows", ()):
        for area in window.screen.areas:
            if area.type == "VIEW_3D":
                for region in area.regions:
                    if region.type == "UI":
                        region.tag_redraw()


def _tick():
    """Shows finished surfaces. It is a timer that runs while something is computed."""
    global _last_redraw
    done = working().take()
    _deliver(done)
    if done or clock.monotonic() - _last_redraw > REDRAW_INTERVAL:
        _last_redraw = clock.monotonic()
        redraw()
    _come_to_rest()
    return TICK if working().is_busy() or motion.any_moves() else None


def _deliver(done):
    """Shows the results of jobs that were requested in the background, and keeps those that were computed ahead."""
    for job in done:
        if job.make is not None and job.error is None:
            keep(job.key, job.make(job.result))
        if _ahead.get(job.key) is job:
            del _ahead[job.key]
            continue
        item = _item_of(job)
        if not is_computed(item):
            continue
        if job.error is not None:
            fail(item, job.error)
        elif job.make is None:
            _take_frames(item, job)
            update_in_background(item, motion.is_moving(compat.identity(item)))
        elif showing.was_changed(item):
            fail(item, "its mesh was changed while the surface was computed; Update shows it")
        else:
            before = item.data.get(SHOWN)
            copies = [
                other for other in bpy.data.objects
                if other != item and showing.requests_same_surface(item, other) and other.data.get(SHOWN) == before]
            for each in (item, *copies):
                try:
                    show(each, job.key, _kept[job.key])
                except Exception as error:  # a timer that raises is never called again
                    fail(each, error)


def progress_of(item):
    """Returns the stage and the elapsed seconds of an object's computation, or None."""
    job = _process and _process.job_of(compat.identity(item))
    return None if job is None else (job.stage, clock.monotonic() - job.began)


def cancel(item):
    """Stops the computation of an object immediately. Returns True if there was one."""
    if not working().stop(compat.identity(item)):
        return False
    _ahead.clear()
    for job in working().take():  # other jobs ended with the process
        other = _item_of(job)
        if is_computed(other):
            update_in_background(other)
    return True


def _item_of(job):
    return compat.of_identity(job.owner) if isinstance(job.owner, int) else None


def wait():
    """Waits until nothing is computed any more, and shows the results. For scripts and tests."""
    while working().is_busy():
        _deliver(working().take(1.0))


# ---- time

def compute_ahead(item, places, in_motion=False):
    """Requests frames of an object's run in advance, and drops earlier requests for other frames. It works for runs of
    files only, because later positions of atoms that come from Blender are not known."""
    wanted_keys = set()
    for place in filter(None, places):
        wanted = SurfaceRequest(item, place, in_motion)
        wanted_keys.add(wanted.key)
        if wanted.key not in _ahead and wanted.key not in _kept:
            _ahead[wanted.key] = wanted.submit((compat.identity(item), wanted.key), process.NEXT)
    for key, job in list(_ahead.items()):
        if job.owner[0] == compat.identity(item) and key not in wanted_keys:
            working().drop(job.owner)
            del _ahead[key]


def follow(scene):
    """Makes every computed object of a scene show the surface of its atoms and its request at the scene's time."""
    time, in_motion = scene.frame_current_final, motion.is_playing()
    for item in list(scene.objects):
        if item.type != "MESH" or item.meniscus.source == "NONE" or item.data.is_editmode:
            continue
        try:
            place = place_at(item, time)
            if place == 0 and item.meniscus.source == "FILE" or libraries.is_fixed(item):
                continue  # nothing moves
            gone = libraries.gone(item, *libraries.SETTINGS) if item.meniscus.source == "FILE" else None
            if gone:
                fail(item, gone)
                continue
            _wait_for_rest(item, in_motion)
            compute_now(item, time, in_motion)
            if frame_count(item) > 1:
                compute_ahead(item, [place_at(item, time + step) for step in range(1, AHEAD + 1)], in_motion)
        except Exception as error:  # Blender ignores exceptions of handlers, and would render a wrong picture
            empty(item)
            fail(item, error)


@persistent
def on_frame_change(scene, _depsgraph=None):
    follow(scene)


@persistent
def on_undo(*_arguments):
    """Updates objects after undo, which restores their requests but may restore meshes of other requests."""
    if bpy.app.background:
        catch_up()
    elif not bpy.app.timers.is_registered(catch_up):  # data must not change before undo is complete
        bpy.app.timers.register(catch_up, first_interval=0.0)


def catch_up():
    for item in bpy.data.objects:
        if is_computed(item) and (SHOWN in item.data or progress_of(item) is not None):
            update_in_background(item)


@persistent
def on_load(*_arguments):
    _ahead.clear()
    showing.forget()
    motion.forget()
    if _process is not None:
        _process.drop_all()
    come_last()


def come_last():
    """Moves the handler after handlers that move atoms. Handlers are called in the order in which they were added."""
    handlers = bpy.app.handlers.frame_change_pre
    if on_frame_change in handlers:
        handlers.remove(on_frame_change)
    handlers.append(on_frame_change)


@persistent
def on_render(scene, *_arguments):
    """Computes fine meshes before a render, which does not wait until objects are at rest."""
    motion.set_rendering(True)
    for item in [item for item in scene.objects if motion.is_moving(compat.identity(item)) and is_computed(item)]:
        motion.rests(compat.identity(item))
        come_to_rest(item)


@persistent
def on_rendered(*_arguments):
    motion.set_rendering(False)


HANDLERS = (("undo_post", on_undo), ("redo_post", on_undo), ("load_post", on_load), ("render_init", on_render),
            ("render_complete", on_rendered), ("render_cancel", on_rendered), *libraries.HANDLERS)


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
    showing.forget()
    motion.forget()
