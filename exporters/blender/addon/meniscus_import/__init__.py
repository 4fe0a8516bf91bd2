# SPDX-License-Identifier: GPL-3.0-or-later
"""Blender add-on: File > Import > Meniscus surface (.mns), and sequences of them. Pure Python and numpy, Blender 3.4 on."""

bl_info = {
    "name": "Meniscus surface import",
    "author": "The Meniscus developers",
    "version": (0, 1, 0),
    "blender": (3, 4, 0),
    "location": "File > Import > Meniscus surface (.mns)",
    "description": "Import exact solvent-excluded molecular surfaces and trajectories of them",
    "category": "Import-Export",
}

import os

import bpy
from bpy_extras.io_utils import ImportHelper

from . import build, compat, mns_reader, sequence


class IMPORT_SCENE_OT_meniscus(bpy.types.Operator, ImportHelper):
    """Import solvent-excluded surfaces that Meniscus exported"""

    bl_idname = "import_scene.meniscus"
    bl_label = "Import Meniscus surface"
    bl_options = {"UNDO", "PRESET"}

    filename_ext = ".mns"
    filter_glob: bpy.props.StringProperty(default="*.mns", options={"HIDDEN"})
    filepath: bpy.props.StringProperty(subtype="FILE_PATH", options={"SKIP_SAVE"})
    directory: bpy.props.StringProperty(subtype="DIR_PATH", options={"SKIP_SAVE", "HIDDEN"})
    files: bpy.props.CollectionProperty(type=bpy.types.OperatorFileListElement, options={"SKIP_SAVE", "HIDDEN"})
    scale: bpy.props.FloatProperty(
        name="Scale", description="Blender units per ångström; 0.1 makes a nanometre one unit", default=0.1,
        min=1e-6, soft_min=0.01, soft_max=1.0, precision=4)
    crisp_colors: bpy.props.BoolProperty(
        name="Crisp colours", description="Colours change at edges; otherwise they blend between vertices",
        default=True)
    import_camera: bpy.props.BoolProperty(
        name="Camera", description="Import the camera and the picture size of the file", default=True)

    def execute(self, context):
        paths = [os.path.join(self.directory, file.name) for file in self.files if file.name] or [self.filepath]
        imported = 0
        for path in paths:
            try:
                build.import_file(path, context, self.scale, self.crisp_colors, self.import_camera)
                imported += 1
            except (mns_reader.MnsError, OSError) as error:
                self.report({"ERROR"}, str(error))
        return {"FINISHED"} if imported else {"CANCELLED"}


class IMPORT_SCENE_OT_meniscus_sequence(bpy.types.Operator, ImportHelper):
    """Import a sequence of surfaces, one a frame, that Meniscus exported"""

    bl_idname = "import_scene.meniscus_sequence"
    bl_label = "Import Meniscus sequence"
    bl_options = {"UNDO", "PRESET"}

    filename_ext = ".json"
    filter_glob: bpy.props.StringProperty(default="*.json", options={"HIDDEN"})
    filepath: bpy.props.StringProperty(subtype="FILE_PATH", options={"SKIP_SAVE"})
    mode: bpy.props.EnumProperty(
        name="Frames", default="BAKE",
        items=(("BAKE", "In this file", "All frames become part of the .blend file, which then renders anywhere without add-on"),
               ("STREAM", "Read when shown", "One frame in memory; the file needs this add-on and the exported folder")))
    scale: bpy.props.FloatProperty(
        name="Scale", description="Blender units per ångström; 0 takes that of the sequence", default=0.0, min=0.0,
        soft_max=1.0, precision=4)
    center: bpy.props.BoolProperty(
        name="Centre", description="Puts the middle of the run, the same for all frames, to the origin; otherwise "
        "coordinates are those of the trajectory", default=True)
    crisp_colors: bpy.props.BoolProperty(
        name="Crisp colours", description="Colours change at edges; otherwise they blend between vertices",
        default=True)

    def execute(self, context):
        options = {"scale": self.scale or None, "center": self.center, "crisp_colors": self.crisp_colors}
        window = context.window_manager
        window.progress_begin(0, 1)
        try:
            if self.mode == "BAKE":
                sequence.bake(self.filepath, context, lambda done, all_of_it: window.progress_update(done / all_of_it),
                              **options)
            else:
                sequence.stream(self.filepath, context, **options)
        except (mns_reader.MnsError, OSError) as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        finally:
            window.progress_end()
        return {"FINISHED"}


def menu_entry(self, _context):
    self.layout.operator(IMPORT_SCENE_OT_meniscus.bl_idname, text="Meniscus surface (.mns)")
    self.layout.operator(IMPORT_SCENE_OT_meniscus_sequence.bl_idname, text="Meniscus sequence (.json)")


CLASSES = [IMPORT_SCENE_OT_meniscus, IMPORT_SCENE_OT_meniscus_sequence]

if compat.can_drop_files(bpy):

    class IMPORT_SCENE_FH_meniscus(bpy.types.FileHandler):
        bl_idname = "IMPORT_SCENE_FH_meniscus"
        bl_label = "Meniscus surface"
        bl_import_operator = "import_scene.meniscus"
        bl_file_extensions = ".mns"

        @classmethod
        def poll_drop(cls, context):
            return context.area is not None and context.area.type == "VIEW_3D"

    CLASSES.append(IMPORT_SCENE_FH_meniscus)


def register():
    for item in CLASSES:
        bpy.utils.register_class(item)
    bpy.types.TOPBAR_MT_file_import.append(menu_entry)
    sequence.register()


def unregister():
    sequence.unregister()
    bpy.types.TOPBAR_MT_file_import.remove(menu_entry)
    for item in reversed(CLASSES):
        bpy.utils.unregister_class(item)
