# SPDX-License-Identifier: GPL-3.0-or-later
"""Renders a .mns file, or frames of a sequence of them, in Blender without a window, and returns an exit code.

  blender -b --factory-startup --python-exit-code 3 --python render_mns.py -- FILE.mns --output picture.png
  ... -- FILE.mns --passes passes.exr      depth, normals, unlit colours through pixel centres; 32-bit, not anti-aliased
  ... -- SEQUENCE.json --frames 0-99:10,250 --output DIR/frame_#####

--camera FILE replaces the camera of the file by one of --save-camera; for a sequence it applies to all frames.
For a sequence, --frames names frames of the trajectory (default: all of the run), and --scene-frames names frames of
the scene, from 1. A run of # in a path stands for the frame number of the trajectory. --motion-blur 0.5 blurs half a
frame. --mode driver, the default, keeps one frame in memory; bake puts all frames into the scene; stream lets the
handler of the add-on read them. With the last two, --blend saves the scene. One unit is one Å unless --scale says
otherwise. --look selects a look of the add-on. All of them except flat need light (--style film, their default); flat
may have outlines (--lines). --engine eevee draws by OpenGL, also without a screen.

Errors and warnings of Blender and Cycles go to standard error, with --verbose everything they print. Standard output
contains, after Blender's name, one JSON line per frame. For a sequence it is
  {"frame": 42, "scene_frame": 5, "state": "done", "files": ["DIR/frame_00042.png"], "triangles": 6120, "ms": 812.4}
  {"frame": 43, "scene_frame": 6, "state": "failed", "exit": 3, "error": "surface_00043.mns: missing"}
Pictures are written whole or not at all. If a frame fails, the others are still rendered.
Exit codes: 0 done, 2 wrong usage, 3 bad input or failed import, 6 output not written. The first frame that failed
determines the code.
"""

import argparse
import ctypes
import json
import math
import os
import re
import sys
import tempfile
import time

import bpy
import mathutils

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from meniscus_import import (build, compat, looks, materials, mns_reader, sequence,  # noqa: E402
                             sequence_reader)

#: The lights of the studio style: the direction towards the light in the camera's axes (right, up, back), and the
#: radiance of a white matt surface that faces the light. They agree with the POV-Ray scenes of Meniscus.
STUDIO = (
    ((-0.45, 0.65, 0.75), (0.74, 0.72, 0.68)),
    ((0.85, -0.05, 0.45), (0.15, 0.17, 0.20)),
    ((0.0, 1.0, 0.0), (0.05, 0.06, 0.07)),
    ((0.0, 0.0, 1.0), (0.13, 0.13, 0.14)))
#: The lights of the film style, which have soft shadows: direction, radiance, and angular diameter in degrees.
FILM = (
    ((-0.55, 0.65, 0.75), (0.90, 0.87, 0.82), 12.0),
    ((0.8, 0.1, 0.5), (0.13, 0.15, 0.18), 30.0))
#: Looks that transmit light. Light has many paths there, so sampling is adaptive, and pictures are denoised.
THROUGH = ("wax", "glass")
NOISE = 0.02
GLASS_BOUNCES = 32
LIGHTS = {"studio": STUDIO, "film": FILM, "flat": ()}
#: The surroundings of glass: pairs of a position, from 0 behind the molecule to 1 behind the camera (half the cosine
#: plus 0.5), and a brightness. A bright wall in a dark room makes edges visible, which is how photographers light
#: glass.
BRIGHT_FIELD = ((0.0, 1.0), (0.02, 1.0), (0.06, 0.45), (0.15, 0.12), (0.5, 0.05), (0.8, 0.3), (1.0, 0.8))
#: The angular diameter in degrees of the lamp that lights glass. Bumps of atoms would reflect a smaller lamp as white
#: dots.
GLASS_LAMP = 60.0


class Parser(argparse.ArgumentParser):
    def error(self, message):
        sys.stderr.write(f"render_mns: error: {message}\n")
        sys.exit(2)


def parse(arguments):
    parser = Parser(prog="render_mns", description="Render .mns files with Cycles.")
    parser.add_argument("file", help=".mns file, or the manifest of a sequence (.json)")
    parser.add_argument("--frames", help="of the trajectory: 0-99:10,250 or all")
    parser.add_argument("--scene-frames", help="the same by place in the run, from 1")
    parser.add_argument("--mode", choices=("driver", "bake", "stream"), help="how a sequence comes into the scene")
    parser.add_argument("--motion-blur", type=float, metavar="SHUTTER", help="share of a frame the shutter is open")
    parser.add_argument("--output", help="picture, PNG")
    parser.add_argument("--passes", help="depth, normals and colours, multi-layer EXR")
    parser.add_argument("--camera", metavar="FILE", help="as --save-camera writes it, instead of that of the file")
    parser.add_argument("--size", help="WIDTHxHEIGHT in pixels; default: that of the file")
    parser.add_argument("--scale", type=float, default=1.0, help="Blender units per Å")
    parser.add_argument(
        "--samples", type=int,
        help="of a pixel, at most where a look has light go through; default: 32, 128 for Cycles' wax and glass")
    parser.add_argument("--style", choices=tuple(LIGHTS),
                        help="studio: matt, no shadows, as the POV-Ray scenes; film: soft shadows and sky light; "
                        "flat: colours as they are, no light; default: studio, film with --look")
    parser.add_argument("--look", choices=[name.lower() for name in looks.LOOKS], help="a material of the add-on's")
    parser.add_argument("--lines", action="store_true", help="outlines by Line Art")
    parser.add_argument("--engine", choices=("cycles", "eevee"), default="cycles",
                        help="of --output; --passes are by Cycles")
    parser.add_argument("--blend", help="save the scene here, too")
    parser.add_argument("--transparent", action="store_true", help="no background")
    parser.add_argument("--verbose", action="store_true", help="what Blender and Cycles print, too")
    options = parser.parse_args(arguments)
    options.is_sequence = options.file.endswith(".json")
    options.samples = options.samples or (128 if options.engine == "cycles" and options.look in THROUGH else 32)
    options.style = options.style or ("film" if options.look and options.look != "flat" else "studio")
    check_together(parser, options)
    if options.size:
        try:
            options.size = tuple(int(side) for side in options.size.split("x"))
            assert len(options.size) == 2 and min(options.size) > 0
        except (ValueError, AssertionError):
            parser.error(f"--size {options.size} is not WIDTHxHEIGHT")
    return options


def check_together(parser, options):
    if not (options.output or options.passes or options.blend):
        parser.error("nothing to do: give --output, --passes or --blend")
    if not (math.isfinite(options.scale) and options.scale > 0):
        parser.error("--scale is not a positive number")
    if options.motion_blur is not None and not 0 < options.motion_blur <= 2:
        parser.error("--motion-blur is not between 0 and 2 frames")
    if options.style == "flat" and options.look not in (None, "flat"):
        parser.error(f"--style flat has no light, which --look {options.look} needs")
    if options.engine == "eevee" and options.motion_blur:
        parser.error("Eevee does not blur by velocities; --motion-blur is for --engine cycles")
    if not options.is_sequence:
        if options.frames or options.scene_frames or options.mode:
            parser.error("--frames, --scene-frames and --mode are for the manifest of a sequence (.json)")
        return
    if options.frames and options.scene_frames:
        parser.error("--frames or --scene-frames, not both")
    if options.blend and options.mode in (None, "driver"):
        parser.error("--blend with a sequence needs --mode bake or stream")
    if options.lines and options.mode == "bake":
        parser.error("--lines draws one mesh; a baked run has one for each frame")


def empty_scene():
    for store in (bpy.data.objects, bpy.data.meshes, bpy.data.lights, bpy.data.cameras):
        for item in list(store):
            store.remove(item)


def lamps_of(camera, style, look):
    """Returns the lamps of a style. The key light is split so that its shadows have the darkness and softness that the
    file requests."""
    lamps = LIGHTS[style]
    share, angle = camera.get("meniscus_shadows", 0.0), 2.0 * camera.get("meniscus_shadow_softness", 0.0)
    if look in ("glass", "flat") or style == "flat":
        if share > 0.0:
            sys.stderr.write("render_mns: note: the scene's shadows are left out: " +
                             ("glass has a light of its own\n" if look == "glass" else "flat has no light\n"))
        return ((*lamps[0][:2], GLASS_LAMP),) if look == "glass" else lamps
    if share == 0.0:
        return lamps
    direction, color = lamps[0][:2]
    cast, even = (tuple(strength * part for part in color) for strength in (share, 1.0 - share))
    return ((direction, cast, angle), (direction, even), *lamps[1:])


def add_lights(scene, camera, style, look):
    for index, (direction, color, *angle) in enumerate(lamps_of(camera, style, look)):
        light = bpy.data.lights.new(f"Meniscus light {index + 1}", "SUN")
        light.color, light.energy = color, math.pi
        light.angle = math.radians(angle[0]) if angle else 0.0
        compat.cast_shadows(light, bool(angle))
        item = bpy.data.objects.new(light.name, light)
        item.parent = camera
        item.visible_transmission = look != "glass"  # lamps seen through glass make grain, so they make highlights only
        item.rotation_euler = mathutils.Vector(direction).to_track_quat("Z", "Y").to_euler()
        scene.collection.objects.link(item)
    world = bpy.data.worlds.new("Meniscus world")
    tree = compat.node_tree(world)
    background = compat.find_or_add(tree, "BACKGROUND", "ShaderNodeBackground")
    tree.links.new(background.outputs[0],
                   compat.find_or_add(tree, "OUTPUT_WORLD", "ShaderNodeOutputWorld").inputs["Surface"])
    background.inputs["Color"].default_value = (0.85, 0.92, 1.0, 1.0)
    background.inputs["Strength"].default_value = 0.35 if style == "film" else 0.0
    if look == "glass":
        background.inputs["Strength"].default_value = 1.0
        seen = tree.nodes.new("ShaderNodeLightPath").outputs["Is Camera Ray"]
        tree.links.new(compat.mix_colors(tree, seen, bright_field(tree, camera), (1.0, 1.0, 1.0, 1.0)),
                       background.inputs["Color"])
    elif look == "flat":  # it emits, so it needs no light
        background.inputs["Color"].default_value, background.inputs["Strength"].default_value = (1.0, 1.0, 1.0,
                                                                                                 1.0), 1.0
    scene.world = world


def bright_field(tree, camera):
    """Returns the output with the colour of BRIGHT_FIELD in the direction of a ray."""
    generated = tree.nodes.new("ShaderNodeTexCoord").outputs["Generated"]
    toward = compat.add_node(tree, "ShaderNodeVectorMath", generated, camera.matrix_world.col[2].xyz,
                             operation="DOT_PRODUCT")
    half = compat.math_node(tree, "MULTIPLY_ADD", toward.outputs["Value"], 0.5, 0.5)
    ramp = tree.nodes.new("ShaderNodeValToRGB")
    ramp.color_ramp.elements.remove(ramp.color_ramp.elements[-1])
    for place, light in BRIGHT_FIELD:
        ramp.color_ramp.elements.new(place).color = (light, light, light, 1.0)
    ramp.color_ramp.elements.remove(ramp.color_ramp.elements[0])
    tree.links.new(half, ramp.inputs["Fac"])
    return ramp.outputs["Color"]


def our_materials():
    return [material for material in bpy.data.materials if materials.MARK in material]


def apply_style(style):
    """Adapts the materials of imports to a style: diffuse colour only for studio, as in the other renderers, and unlit
    colours for flat."""
    for material in our_materials() if style != "film" else ():
        shader = materials.shader_of(material)
        specular = compat.principled_input(shader, "Specular IOR Level", "Specular")
        specular.default_value = (0.0 if style == "flat" or "specular" not in material[materials.MARK] else
                                  specular.default_value)
        if style == "flat":
            colors = {
                link.to_socket.name: link.from_socket for link in material.node_tree.links if link.to_node == shader}
            color = colors.get("Emission Color") or colors.get("Emission") or colors["Base Color"]
            for link in list(shader.inputs["Base Color"].links):
                material.node_tree.links.remove(link)
            shader.inputs["Base Color"].default_value = (0.0, 0.0, 0.0, 1.0)
            material.node_tree.links.new(color, compat.principled_input(shader, "Emission Color", "Emission"))
            shader.inputs["Emission Strength"].default_value = 1.0


def set_up_cycles(scene, samples):
    scene.render.engine = "CYCLES"
    scene.cycles.device = "CPU"
    scene.cycles.samples = samples
    scene.cycles.use_adaptive_sampling = False
    scene.cycles.use_denoising = False
    scene.cycles.seed = 1
    scene.cycles.transparent_max_bounces = build.MOST_LAYERS
    scene.view_settings.view_transform = "Standard"
    scene.render.use_overwrite = True


def apply_look(options):
    for mesh in bpy.data.meshes if options.look else ():
        if "ses_kind" in mesh.attributes:
            looks.dress_mesh(mesh, options.look.upper(), "COLOR", options.scale)


def set_up_look(scene, look):
    """Sets the number of bounces and the sampling that a look needs."""
    if look == "glass":
        scene.cycles.max_bounces = scene.cycles.transmission_bounces = scene.cycles.glossy_bounces = GLASS_BOUNCES
    if look in THROUGH:
        scene.cycles.use_adaptive_sampling, scene.cycles.adaptive_threshold = True, NOISE
        compat.denoise(scene)


def render_to(scene, path, file_format, depth):
    settings = scene.render.image_settings
    compat.set_format(settings, file_format)
    settings.color_depth = depth
    if file_format == "PNG":
        settings.color_mode = "RGBA" if scene.render.film_transparent else "RGB"
    root, extension = os.path.splitext(os.path.abspath(path))
    temporary = f"{root}.unfinished-{os.getpid()}{extension}"
    scene.render.filepath = temporary
    bpy.ops.render.render(write_still=True)
    if not os.path.exists(temporary) or os.path.getsize(temporary) == 0:
        raise OSError(f"{path}: the picture was not written")
    os.replace(temporary, path)


def render_picture(scene, options, path):
    apply_style(options.style)  # the first frame of a sequence adds its materials
    apply_look(options)
    set_up_cycles(scene, options.samples)
    set_up_look(scene, options.look)
    if options.engine == "eevee":
        scene.render.engine = compat.eevee()
        compat.set_up_eevee(scene, options.samples)
    if options.style == "flat":  # the colour of a pixel is the mean over its area, as in the ray caster
        scene.cycles.pixel_filter_type, scene.cycles.filter_width = "BOX", 1.0
    else:
        scene.cycles.pixel_filter_type, scene.cycles.filter_width = "BLACKMAN_HARRIS", 1.5
    scene.render.film_transparent = options.transparent
    scene.render.use_motion_blur = bool(options.motion_blur)
    scene.render.motion_blur_shutter = options.motion_blur or 0.5
    use_passes(scene, False)
    render_to(scene, path, "PNG", "8")


def render_passes(scene, path):
    set_up_cycles(scene, 1)
    scene.cycles.pixel_filter_type = "BOX"
    scene.cycles.filter_width = 0.01  # sends a ray through the centre of each pixel
    scene.render.film_transparent = True
    scene.render.use_motion_blur = False
    use_passes(scene, True)
    render_to(scene, path, "OPEN_EXR_MULTILAYER", "32")


def use_passes(scene, wanted):
    layer = scene.view_layers[0]
    layer.use_pass_z = layer.use_pass_normal = layer.use_pass_diffuse_color = wanted


def dress(scene, camera, options, items):
    """Sets lights, picture size, style and look, and saves the scene if --blend is given. Raises MnsError without a
    camera."""
    if camera is None:
        raise mns_reader.MnsError(f"{options.file}: the file holds no camera")
    if options.size:
        scene.render.resolution_x, scene.render.resolution_y = options.size
    add_lights(scene, camera, options.style, options.look)
    apply_style(options.style)
    if options.style != "film":
        scene.cycles.max_bounces = 0
    apply_look(options)
    for item in items if options.lines else ():
        looks.add_lines(bpy.context, item)
    if options.motion_blur:
        scene.render.use_motion_blur = True
        scene.render.motion_blur_shutter = options.motion_blur
    if options.blend:
        set_up_cycles(scene, options.samples)
        set_up_look(scene, options.look)
        bpy.ops.wm.save_as_mainfile(filepath=os.path.abspath(options.blend), compress=True)


def run_file(options):
    started = time.time()
    empty_scene()
    made = build.import_file(options.file, bpy.context, scale=options.scale, camera=options.shot)
    loaded = time.time()
    scene = bpy.context.scene
    dress(scene, made.camera, options, made.surfaces)
    if options.output:
        render_picture(scene, options, options.output)
    if options.passes:
        render_passes(scene, options.passes)
    print_result({"file": options.file, "triangles": sum(len(item.data.polygons) for item in made.surfaces),
         "load_s": round(loaded - started, 3), "total_s": round(time.time() - started, 3)})
    return 0


class Stage:
    """A sequence in the scene in one of the three modes."""

    def __init__(self, options, frames):
        self.frames = frames
        self.mode = options.mode or "driver"
        scene, context = bpy.context.scene, bpy.context
        if self.mode == "bake":
            self.item = sequence.bake(options.file, context, scale=options.scale, camera=options.shot)
        elif self.mode == "stream":
            sequence.register()
            self.item = sequence.stream(options.file, context, scale=options.scale, camera=options.shot)
        else:
            self.placement = sequence.Placement(frames, options.scale)
            self.item = bpy.data.objects.new(frames.stem, bpy.data.meshes.new(frames.stem))
            scene.collection.objects.link(self.item)
            camera = sequence.add_camera(scene.collection, self.placement)
            sequence.set_up_scene(scene, frames, self.placement.timing)
            if camera is not None:
                sequence.use_camera(scene, camera, frames)
        self.camera = scene.camera

    def show(self, scene_frame):
        """Shows one frame and returns its number of triangles. Raises MnsError or OSError."""
        scene = bpy.context.scene
        if self.mode == "driver":
            prepared = self.placement.refill(self.item.data, scene_frame)
            self.item.data.update()
            scene.frame_set(scene_frame)
            build.reach_all(self.camera, prepared.points, self.placement.scale, self.placement.origin)
        else:
            scene.frame_set(scene_frame)
        if self.item.get("meniscus_error"):
            raise mns_reader.MnsError(self.item["meniscus_error"])
        graph = bpy.context.evaluated_depsgraph_get()
        evaluated = self.item.evaluated_get(graph)
        # The evaluated object of a bake has a mesh of its own or an instance.
        shown = [
            evaluated.data,
            *(each.object.data for each in graph.object_instances if each.is_instance and each.parent == evaluated)]
        return sum(len(mesh.polygons) for mesh in shown)


def numbered(pattern, number):
    """Returns a path in which each run of # is replaced by the number, padded to the length of the run."""
    return re.sub("#+", lambda run: str(number).zfill(len(run.group())), pattern)


def chosen_frames(options, frames):
    """Returns pairs of a scene frame and its frame number in the trajectory. Exits with code 2 for an invalid
    choice."""
    try:
        if options.scene_frames:
            places = sequence_reader.parse_frames(options.scene_frames, range(1, len(frames.frames) + 1))
            for place in places:
                if not 1 <= place <= len(frames.frames):
                    raise ValueError(f"scene frame {place} is not one of 1 to {len(frames.frames)}")
            return [(place, frames.frames[place - 1].number) for place in places]
        numbers = sequence_reader.parse_frames(options.frames or "all", [frame.number for frame in frames.frames])
        for number in numbers:
            if frames.scene_frame(number) is None:
                raise ValueError(f"frame {number} is not in the run of {options.file}")
        return [(frames.scene_frame(number), number) for number in numbers]
    except ValueError as error:
        fail(2, error)


def render_frame(stage, options, scene_frame, number):
    """Renders one frame of a sequence, and returns its files and its number of triangles."""
    triangles = stage.show(scene_frame)
    if triangles == 0:
        raise mns_reader.MnsError(f"frame {number}: there is nothing to show")
    files = []
    if options.output:
        files.append(numbered(options.output if options.output.endswith(".png") else options.output + ".png", number))
        render_picture(bpy.context.scene, options, files[-1])
    if options.passes:
        files.append(numbered(options.passes, number))
        render_passes(bpy.context.scene, files[-1])
    if stage.item.get("meniscus_error"):
        raise mns_reader.MnsError(stage.item["meniscus_error"])
    return files, triangles


def run_sequence(options):
    empty_scene()
    frames = sequence_reader.read(options.file)
    if options.shot:
        frames.set_camera(options.shot)
    chosen = chosen_frames(options, frames)
    for path in (options.output, options.passes):
        if path and "#" not in path and len(chosen) > 1:
            fail(2, f"{path}: {len(chosen)} frames need # in the path for their numbers")
    stage = Stage(options, frames)
    dress(bpy.context.scene, stage.camera, options, [stage.item])
    code = 0
    for scene_frame, number in chosen if options.output or options.passes else ():
        started = time.time()
        line = {"frame": number, "scene_frame": scene_frame}
        try:
            files, triangles = render_frame(stage, options, scene_frame, number)
            print_result({**line, "state": "done", "files": files, "triangles": triangles,
                 "ms": round(1e3 * (time.time() - started), 1)})
        except (mns_reader.MnsError, OSError, RuntimeError) as error:
            failure = exit_code(error)
            code = code or failure
            print_result({**line, "state": "failed", "exit": failure, "error": str(error)})
            sys.stderr.write(f"render_mns: error: {error}\n")
    return code


def exit_code(error):
    return 3 if isinstance(error, (mns_reader.MnsError, FileNotFoundError, PermissionError)) else 6


def fail(code, message):
    sys.stderr.write(f"render_mns: error: {message}\n")
    sys.exit(code)


def print_result(line):
    RESULTS.write(json.dumps(line) + "\n")
    RESULTS.flush()


def main():
    arguments = sys.argv[sys.argv.index("--") + 1:] if "--" in sys.argv else []
    options = parse(arguments)
    try:
        options.shot = sequence_reader.read_camera(options.camera) if options.camera else None
        code = run_sequence(options) if options.is_sequence else run_file(options)
    except (mns_reader.MnsError, OSError, RuntimeError) as error:
        fail(exit_code(error), error)
    finally:
        sequence.unregister()
        if CHATTER:
            copy_faults()
    sys.exit(code)


def copy_faults():
    """Copies errors and warnings that Blender has printed to standard error."""
    sys.stdout.flush()
    ctypes.CDLL(None).fflush(None)  # the C library buffers lines
    output = os.pread(CHATTER.fileno(), 1 << 24, 0)
    faults = [
        line for line in output.decode("utf-8", "replace").splitlines(True)
        if re.search(r"\b(error|warning|failed)\b", line, re.IGNORECASE)]
    sys.stderr.write("".join(faults))


RESULTS = os.fdopen(os.dup(1), "w", encoding="utf-8")
# Output of Blender goes to a file, because a thread that reads a pipe would crash Blender 3.4. Windows has no pread.
CHATTER = tempfile.TemporaryFile("a+b") if hasattr(os, "pread") and "--verbose" not in sys.argv else None
os.dup2(CHATTER.fileno() if CHATTER else 2, 1)
main()
