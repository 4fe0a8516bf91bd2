# SPDX-License-Identifier: BSD-3-Clause
"""Blender's program, as far as our tests and the driver call it, played by the module bpy from PyPI.

It takes -b --factory-startup --disable-autoexec --addons NAMES --python-exit-code N --python FILE FILE.blend -o PATTERN -F FORMAT
-s FRAME -e FRAME -a in their order, and what stands behind -- is for the script.
"""

import atexit
import os
import runpy
import sys
import traceback

import bpy  # brings addon_utils
import addon_utils


def render_animation():
    bpy.ops.render.render(animation=True)


def main(arguments):
    own = arguments[:arguments.index("--")] if "--" in arguments else arguments
    exit_code, words = 1, iter(own)
    bpy.ops.wm.read_factory_settings()
    addon_utils.enable("cycles")
    for word in words:
        scene = bpy.context.scene
        if word in ("-b", "--factory-startup", "--disable-autoexec"):
            continue
        if word == "--addons":
            for name in next(words).split(","):
                if addon_utils.enable(name) is None:
                    sys.exit(1)
        elif word == "--python-exit-code":
            exit_code = int(next(words))
        elif word == "--python":
            script = next(words)
            try:
                runpy.run_path(script, run_name="__main__")
            except SystemExit:
                raise
            except BaseException:
                traceback.print_exc()
                sys.exit(exit_code)
        elif word == "-o":
            scene.render.filepath = next(words)
        elif word == "-F":
            scene.render.image_settings.file_format = next(words)
        elif word in ("-s", "-e"):
            setattr(scene, "frame_start" if word == "-s" else "frame_end", int(next(words)))
        elif word == "-a":
            render_animation()
        elif word.endswith(".blend"):
            bpy.ops.wm.open_mainfile(filepath=os.path.abspath(word))
        else:
            sys.exit(f"bpy_as_blender: unknown option {word}")


def ended():
    """Returns the exit status of main."""
    try:
        main(sys.argv[1:])
    except SystemExit as end:
        if isinstance(end.code, str):
            print(end.code, file=sys.stderr)
        return end.code if isinstance(end.code, int) else int(end.code is not None)
    except BaseException:
        traceback.print_exc()
        return 1
    return 0


# The process ends at once: in the interpreter's own end bpy 4.5 at times hangs in a condition that a thread waits for.
status = ended()
atexit._run_exitfuncs()
sys.stdout.flush()
sys.stderr.flush()
os._exit(status)
