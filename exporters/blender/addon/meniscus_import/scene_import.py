# SPDX-License-Identifier: GPL-3.0-or-later
"""Imports scene files of Meniscus. A scene becomes a surface of the panel if the panel has fields for all of its
values. Otherwise the program exports it, and the export is imported."""

import os
import subprocess
import tempfile

import bpy
from bpy_extras.io_utils import ImportHelper

from . import build, computed, mns_reader, panel, scene_reader, sequence


class OBJECT_OT_meniscus_from_scene(panel.Waiting, bpy.types.Operator, ImportHelper):
    """Show what a scene file of Meniscus shows; parts that the panel has no fields for come as the program meniscus
    exports them"""

    bl_idname = "object.meniscus_from_scene"
    bl_label = "Surface of a scene"
    bl_options = {"UNDO"}

    filename_ext = ".json"
    filter_glob: bpy.props.StringProperty(default="*.json", options={"HIDDEN"})
    filepath: bpy.props.StringProperty(subtype="FILE_PATH", options={"SKIP_SAVE"})

    @build.reports_errors
    def execute(self, context):
        scene = scene_reader.read(self.filepath)
        if scene.others:
            self.import_exported(context, scene)
            return {"FINISHED"}
        item = self.make(context, scene)
        if scene.unseen:
            self.report({"INFO"}, f"Left out: {', '.join(scene.unseen)}")
        return panel.start(self, item)

    def make(self, context, scene):
        """Returns an object of the panel. It computes nothing before all of its fields are set."""
        fields = dict(scene.fields)
        for name in set(fields) & set(scene_reader.FILES):
            fields[name] = build.remembered_path(fields[name])
        detail = "PROXY" if "density" in fields else "FINE" if "tolerance" in fields else "AUTO"
        return panel.new_object(context, build.stem_of(self.filepath) + ".surface", "FILE", detail=detail, **fields)

    def import_exported(self, context, scene):
        program = computed.working().describe_tools()["program"]
        if not program:
            raise mns_reader.MnsError(
                f"{self.filepath}: the panel has no fields for {', '.join(scene.others)}; the program meniscus, which "
                "exports "
                "them, is not found; name it in the add-on's preferences")
        is_run = any(key.startswith("frames.") for key in scene.others) or scene.fields["is_run"]
        with tempfile.TemporaryDirectory(prefix="meniscus_") as folder:
            target = os.path.join(folder, build.stem_of(self.filepath) + ("" if is_run else ".mns"))
            done = subprocess.run([program, "export", "blender", "--scene", self.filepath, "-o", target],
                                  stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
                                  check=False)
            lines = [line.removeprefix("meniscus: ") for line in done.stderr.decode("utf-8", "replace").splitlines()]
            if done.returncode:
                errors = (line.removeprefix("error: ") for line in lines if line.startswith("error: "))
                raise mns_reader.MnsError(next(errors, f"{program} ended with {done.returncode}"))
            for line in lines:
                if line.startswith(("note: ", "warning: ")):
                    self.report({"INFO"}, line)
            if is_run:
                sequence.bake(os.path.join(target, "surface_sequence.json"), context)
                return
            for item in build.import_file(target, context).surfaces:
                del item["meniscus_file"]  # the file is temporary


register, unregister = bpy.utils.register_classes_factory([OBJECT_OT_meniscus_from_scene])
