# SPDX-License-Identifier: GPL-3.0-or-later
"""Renders one .mns file in Blender without a window, with true exit codes.

  blender -b --factory-startup --python-exit-code 3 --python render_mns.py -- FILE.mns --output picture.png
  ... -- FILE.mns --passes passes.exr       depth, normals and unlit colours through pixel centres, 32-bit, no anti-aliasing

Prints one JSON line. Exit codes: 0 done, 2 wrong usage, 3 bad input or failed import, 6 output not written.
"""

import argparse
import json
import math
import os
import sys
import time

import bpy
import mathutils

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from meniscus_import import build, mns_reader  # noqa: E402

#: Direction towards the light in the camera's axes (right, up, back), its colour; strengths are what a white, matt
#: surface that faces the light sends to the camera. As in the POV-Ray scenes of Meniscus.
STUDIO = (
    ((-0.45, 0.65, 0.75), (0.74, 0.72, 0.68)),
    ((0.85, -0.05, 0.45), (0.15, 0.17, 0.20)),
    ((0.0, 1.0, 0.0), (0.05, 0.06, 0.07)),
    ((0.0, 0.0, 1.0), (0.13, 0.13, 0.14)),
)
#: The same for the film style, with soft shadows: and how wide the lamp is, in degrees.
FILM = (
    ((-0.55, 0.65, 0.75), (0.90, 0.87, 0.82), 12.0),
    ((0.8, 0.1, 0.5), (0.13, 0.15, 0.18), 30.0),
)


class Parser(argparse.ArgumentParser):
    def error(self, message):
        sys.stderr.write(f"render_mns: error: {message}\n")
        sys.exit(2)


def parse(arguments):
    parser = Parser(prog="render_mns", description="Render a .mns file with Cycles.")
    parser.add_argument("file")
    parser.add_argument("--output", help="picture, PNG")
    parser.add_argument("--passes", help="depth, normals and colours, multi-layer EXR; one unit is one Å")
    parser.add_argument("--size", help="WIDTHxHEIGHT in pixels; default: that of the file")
    parser.add_argument("--samples", type=int, default=32)
    parser.add_argument("--style", choices=("studio", "film"), default="studio",
                        help="studio: matt, no shadows, as the POV-Ray scenes; film: soft shadows and sky light")
    parser.add_argument("--blend", help="save the scene here, too")
    parser.add_argument("--transparent", action="store_true", help="no background")
    options = parser.parse_args(arguments)
    if not (options.output or options.passes or options.blend):
        parser.error("nothing to do: give --output, --passes or --blend")
    if options.size:
        try:
            options.size = tuple(int(side) for side in options.size.split("x"))
            assert len(options.size) == 2 and min(options.size) > 0
        except (ValueError, AssertionError):
            parser.error(f"--size {options.size} is not WIDTHxHEIGHT")
    return options


def empty_scene():
    for store in (bpy.data.objects, bpy.data.meshes, bpy.data.lights, bpy.data.cameras):
        for item in list(store):
            store.remove(item)


def add_lights(scene, camera, style):
    axes = camera.matrix_world.to_3x3()
    for index, (direction, color, *angle) in enumerate(FILM if style == "film" else STUDIO):
        light = bpy.data.lights.new(f"Meniscus light {index + 1}", "SUN")
        light.color, light.energy = color, math.pi
        light.angle = math.radians(angle[0]) if angle else 0.0
        light.cycles.cast_shadow = bool(angle)
        item = bpy.data.objects.new(light.name, light)
        item.rotation_euler = (axes @ mathutils.Vector(direction)).to_track_quat("Z", "Y").to_euler()
        scene.collection.objects.link(item)
    world = bpy.data.worlds.new("Meniscus world")
    world.use_nodes = True
    background = world.node_tree.nodes["Background"]
    background.inputs["Color"].default_value = (0.85, 0.92, 1.0, 1.0)
    background.inputs["Strength"].default_value = 0.35 if style == "film" else 0.0
    scene.world = world


def make_matt(surfaces):
    """Nothing but diffuse colour, as in the studio style of the other renderers."""
    for material in {material for item in surfaces for material in item.data.materials}:
        shader = next(node for node in material.node_tree.nodes if node.type == "BSDF_PRINCIPLED")
        for name in ("Specular", "Specular IOR Level"):
            if name in shader.inputs:
                shader.inputs[name].default_value = 0.0


def set_up_cycles(scene, samples):
    scene.render.engine = "CYCLES"
    scene.cycles.device = "CPU"
    scene.cycles.samples = samples
    scene.cycles.use_adaptive_sampling = False
    scene.cycles.use_denoising = False
    scene.cycles.seed = 1
    scene.view_settings.view_transform = "Standard"
    scene.render.use_overwrite = True


def render_to(scene, path, file_format, depth):
    settings = scene.render.image_settings
    settings.file_format = file_format
    settings.color_depth = depth
    if file_format == "PNG":
        settings.color_mode = "RGBA" if scene.render.film_transparent else "RGB"
    root, extension = os.path.splitext(os.path.abspath(path))
    beside = f"{root}.unfinished-{os.getpid()}{extension}"
    scene.render.filepath = beside
    bpy.ops.render.render(write_still=True)
    if not os.path.exists(beside) or os.path.getsize(beside) == 0:
        raise OSError(f"{path}: the picture was not written")
    os.replace(beside, path)


def render_picture(scene, options):
    set_up_cycles(scene, options.samples)
    scene.render.film_transparent = options.transparent
    render_to(scene, options.output, "PNG", "8")


def render_passes(scene, options):
    set_up_cycles(scene, 1)
    scene.cycles.pixel_filter_type = "BOX"
    scene.cycles.filter_width = 0.01  # a ray through each pixel's centre
    layer = scene.view_layers[0]
    layer.use_pass_z = layer.use_pass_normal = layer.use_pass_diffuse_color = True
    scene.render.film_transparent = True
    render_to(scene, options.passes, "OPEN_EXR_MULTILAYER", "32")


def run(options):
    started = time.time()
    empty_scene()
    made = build.import_file(options.file, bpy.context, scale=1.0)
    if made.camera is None:
        raise mns_reader.MnsError(f"{options.file}: the file holds no camera")
    loaded = time.time()
    scene = bpy.context.scene
    if options.size:
        scene.render.resolution_x, scene.render.resolution_y = options.size
    add_lights(scene, made.camera, options.style)
    if options.style == "studio":
        make_matt(made.surfaces)
        scene.cycles.max_bounces = 0
    if options.blend:
        bpy.ops.wm.save_as_mainfile(filepath=os.path.abspath(options.blend), compress=True)
    if options.output:
        render_picture(scene, options)
    if options.passes:
        render_passes(scene, options)
    print(json.dumps({"file": options.file, "triangles": sum(len(item.data.polygons) for item in made.surfaces),
                      "load_s": round(loaded - started, 3), "total_s": round(time.time() - started, 3)}), flush=True)


def main():
    arguments = sys.argv[sys.argv.index("--") + 1:] if "--" in sys.argv else []
    options = parse(arguments)
    try:
        run(options)
    except (mns_reader.MnsError, FileNotFoundError, PermissionError) as error:
        sys.stderr.write(f"render_mns: error: {error}\n")
        sys.exit(3)
    except (OSError, RuntimeError) as error:
        sys.stderr.write(f"render_mns: error: {error}\n")
        sys.exit(6)


main()
