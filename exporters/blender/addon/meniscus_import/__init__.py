# SPDX-License-Identifier: GPL-3.0-or-later
"""Blender add-on that imports surfaces and sequences of them, and computes surfaces. It consists of Python with numpy
only, and runs in Blender 3.4 and later."""

bl_info = {
    "name": "Meniscus", "author": "The Meniscus developers", "version": (0, 3, 0), "blender": (3, 4, 0),
    "location": "File > Import > Meniscus surface (.mns); 3D View > Sidebar > Meniscus",
    "description": "Exact solvent-excluded molecular surfaces: import, compute, animate", "category": "Import-Export"}

import os

import bpy
from bpy_extras.io_utils import ImportHelper

from . import (bake_run, build, compat, computed, mns_reader, panel, scene_import, sequence, sequence_reader, settings,
               storyboard)


class Importing(ImportHelper):
    """The properties that all imports share."""

    bl_options = {"UNDO", "PRESET"}

    filepath: bpy.props.StringProperty(subtype="FILE_PATH", options={"SKIP_SAVE"})
    crisp_colors: bpy.props.BoolProperty(
        name="Crisp colours", description="Colours change at edges; otherwise they blend between vertices",
        default=True)
    own_materials: bpy.props.BoolProperty(
        name="Own materials", description="New materials for this import; otherwise those that all imports share",
        default=False)
    center: bpy.props.BoolProperty(
        name="Centre",
        description="Puts the middle of the molecule to the origin, or where an earlier import put it, so that a "
        "surface and its trajectory overlay; otherwise coordinates are those of the molecule's file", default=False)
    import_camera: bpy.props.BoolProperty(name="Camera", description="Import the camera of the file", default=True)
    use_camera: bpy.props.BoolProperty(name="Use camera",
                                       description="Make it the camera of the scene, and take the size of its picture",
                                       default=True)
    standard_view: bpy.props.BoolProperty(name="Standard view transform",
                                          description="Show colours as they are; Filmic and AgX make them paler",
                                          default=False)

    def shared_values(self, *names):
        """Returns the values of the shared properties and of others by their names."""
        return {name: getattr(self, name) for name in ("crisp_colors", "own_materials", "center", "import_camera",
                                                       "use_camera", *names)}

    def report_view_transform(self, context):
        """Shows colours in solid views, and reports a view transform that changes them."""
        compat.color_solid_views(context)
        view = context.scene.view_settings
        if self.standard_view:
            view.view_transform = "Standard"
        elif view.view_transform not in ("Standard", "Raw"):
            self.report({"INFO"},
                        f"The view transform {view.view_transform} changes colours; Standard shows them as they are")


class ImportingRun(Importing):
    """The properties of imports of several frames."""

    filename_ext = ".json"
    filter_glob: bpy.props.StringProperty(default="*.json", options={"HIDDEN"})
    scale: bpy.props.FloatProperty(name="Scale", description="Blender units per ångström; 0 takes that of the file",
                                   default=0.0, min=0.0, soft_max=1.0, precision=4)
    set_time: bpy.props.BoolProperty(
        name="Set frame range and rate", description="The scene gets the range and the rate of the run, and a marker "
        "for each scene of a storyboard", default=True)


class IMPORT_SCENE_OT_meniscus(Importing, bpy.types.Operator):
    """Import solvent-excluded surfaces that Meniscus exported"""

    bl_idname = "import_scene.meniscus"
    bl_label = "Import Meniscus surface"
    filename_ext = ".mns"
    filter_glob: bpy.props.StringProperty(default="*.mns", options={"HIDDEN"})
    directory: bpy.props.StringProperty(subtype="DIR_PATH", options={"SKIP_SAVE", "HIDDEN"})
    files: bpy.props.CollectionProperty(type=bpy.types.OperatorFileListElement, options={"SKIP_SAVE", "HIDDEN"})
    scale: bpy.props.FloatProperty(
        name="Scale", description="Blender units per ångström; 0.1 makes a nanometre one unit", default=0.1,
        min=1e-6, soft_min=0.01, soft_max=1.0, precision=4)
    parts: bpy.props.BoolProperty(
        name="Cavities apart",
        description="One object for the outer surface and one for the cavities, whose faces look into "
        "them: Recalculate Outside would turn these", default=False)

    def invoke(self, context, event):
        if self.filepath and hasattr(self, "invoke_popup"):  # a file was dropped into the window
            return self.invoke_popup(context)
        return ImportHelper.invoke(self, context, event)

    def execute(self, context):
        paths = [os.path.join(self.directory, file.name) for file in self.files if file.name] or [self.filepath]
        imported = 0
        for path in paths:
            try:
                build.import_file(path, context, **self.shared_values("scale", "parts"))
                imported += 1
            except (mns_reader.MnsError, OSError) as error:
                self.report({"ERROR"}, str(error))
        if not imported:
            return {"CANCELLED"}
        self.report_view_transform(context)
        return {"FINISHED"}


class IMPORT_SCENE_OT_meniscus_sequence(ImportingRun, bpy.types.Operator):
    """Import a sequence of surfaces, one a frame, that Meniscus exported"""

    bl_idname = "import_scene.meniscus_sequence"
    bl_label = "Import Meniscus sequence"
    mode: bpy.props.EnumProperty(
        name="Frames", default="BAKE",
        items=(("BAKE", "In this file",
                "All frames become part of the .blend file, which then renders anywhere without add-on"),
               ("STREAM", "Read when shown",
                "One frame in memory; the file needs this add-on and the exported folder")))

    @build.reports_errors
    def execute(self, context):
        options = self.shared_values("set_time")
        window = context.window_manager
        window.progress_begin(0, 1)
        try:
            options["timing"] = sequence_reader.Timing(self.start, self.speed, self.outside)
            options["scale"] = self.scale or None
            if self.mode == "BAKE":
                sequence.bake(self.filepath, context, lambda done, all_of_it: window.progress_update(done / all_of_it),
                              **options)
            else:
                sequence.stream(self.filepath, context, **options)
        finally:
            window.progress_end()
        self.report_view_transform(context)
        return {"FINISHED"}


IMPORT_SCENE_OT_meniscus_sequence.__annotations__.update(settings.timing_fields("EMPTY"))


class IMPORT_SCENE_OT_meniscus_storyboard(ImportingRun, bpy.types.Operator):
    """Import a storyboard that meniscus film --to blender wrote: scenes, and key frames from each to the next"""

    bl_idname = "import_scene.meniscus_storyboard"
    bl_label = "Import Meniscus storyboard"
    set_background: bpy.props.BoolProperty(
        name="Background",
        description="The camera sees the colours of the film where there is no object; what lights the scene stays",
        default=True)

    @build.reports_errors
    def execute(self, context):
        storyboard.import_file(self.filepath, context, scale=self.scale or None,
                               **self.shared_values("set_time", "set_background"))
        self.report_view_transform(context)
        return {"FINISHED"}


class OBJECT_OT_meniscus_reload(bpy.types.Operator):
    """Read the file of the active Meniscus surface again; its materials, modifiers and place remain"""

    bl_idname = "object.meniscus_reload"
    bl_label = "Reload Meniscus surface"
    bl_options = {"UNDO"}

    @classmethod
    def poll(cls, context):
        item = context.active_object
        return item is not None and item.mode == "OBJECT" and "meniscus_file" in item and item.data.library is None

    @build.reports_errors
    def execute(self, context):
        build.reload(context.active_object, context)
        return {"FINISHED"}


def menu_entry(self, _context):
    self.layout.operator(IMPORT_SCENE_OT_meniscus.bl_idname, text="Meniscus surface (.mns)")
    self.layout.operator(IMPORT_SCENE_OT_meniscus_sequence.bl_idname, text="Meniscus sequence (.json)")
    self.layout.operator(IMPORT_SCENE_OT_meniscus_storyboard.bl_idname, text="Meniscus storyboard (.json)")
    self.layout.operator("object.meniscus_from_scene", text="Meniscus scene (.json)")


def object_menu_entry(self, context):
    if OBJECT_OT_meniscus_reload.poll(context):
        self.layout.operator(OBJECT_OT_meniscus_reload.bl_idname)


CLASSES = [
    IMPORT_SCENE_OT_meniscus, IMPORT_SCENE_OT_meniscus_sequence, IMPORT_SCENE_OT_meniscus_storyboard,
    OBJECT_OT_meniscus_reload]

if compat.can_drop_files():

    class IMPORT_SCENE_FH_meniscus(bpy.types.FileHandler):
        bl_idname = "IMPORT_SCENE_FH_meniscus"
        bl_label = "Meniscus surface"
        bl_import_operator = "import_scene.meniscus"
        bl_file_extensions = ".mns"

        @classmethod
        def poll_drop(cls, context):
            return context.area is not None and context.area.type == "VIEW_3D"

    CLASSES.append(IMPORT_SCENE_FH_meniscus)


_register, _unregister = bpy.utils.register_classes_factory(CLASSES)


def register():
    _register()
    bpy.types.TOPBAR_MT_file_import.append(menu_entry)
    bpy.types.VIEW3D_MT_object.append(object_menu_entry)
    sequence.register()
    for module in (settings, computed, bake_run, scene_import, panel):
        module.register()


def unregister():
    for module in (panel, scene_import, bake_run, computed, settings):
        module.unregister()
    sequence.unregister()
    bpy.types.VIEW3D_MT_object.remove(object_menu_entry)
    bpy.types.TOPBAR_MT_file_import.remove(menu_entry)
    _unregister()
