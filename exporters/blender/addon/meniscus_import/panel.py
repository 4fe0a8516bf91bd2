# SPDX-License-Identifier: GPL-3.0-or-later
"""The panel Meniscus in the sidebar of 3-D views, which makes objects with computed surfaces and edits their
settings."""

import os

import bpy
from bpy_extras.io_utils import ImportHelper

from . import bake_run, build, compat, computed, libraries, looks, mns_reader, molecular_nodes
from .computing import preparation
from .settings import DETAILS, OF_NUMBERS, OWN_COLORS


def new_object(context, name, source, **values):
    """Returns a new selected and active object without geometry. It is in the active collection, or in the collection
    of the scene if the active one is excluded from the view layer. values: settings of the object."""
    item = bpy.data.objects.new(name, bpy.data.meshes.new(name))
    for key, value in values.items():
        setattr(item.meniscus, key, value)
    item.meniscus.source = source  # set last, because it starts computing
    context.collection.objects.link(item)
    context.view_layer.update()  # adds the object to the view layer
    if item.name not in context.view_layer.objects:
        context.collection.objects.unlink(item)
        context.scene.collection.objects.link(item)
    compat.color_solid_views(context)
    for other in context.view_layer.objects:
        other.select_set(False)
    item.select_set(True)
    context.view_layer.objects.active = item
    return item


def start(operator, item):
    """Computes the surface of a new object, in the background if there is a window. Returns the result of the
    operator."""
    if not bpy.app.background and not operator.wait:
        computed.update_in_background(item, in_motion=True)  # shows a proxy first
        return {"FINISHED"}
    try:
        computed.compute_now(item)
    except (mns_reader.MnsError, OSError) as error:
        computed.fail(item, error)
        operator.report({"ERROR"}, str(error))
        return {"CANCELLED"}
    return {"FINISHED"}


class Waiting:
    wait: bpy.props.BoolProperty(name="Wait", description="End when the surface is there", default=False,
                                 options={"SKIP_SAVE"})


class Making(Waiting):
    """The properties of operators that make a surface."""

    detail: bpy.props.EnumProperty(name="Detail", default="AUTO", items=DETAILS)


class OBJECT_OT_meniscus_from_file(Making, bpy.types.Operator, ImportHelper):
    """Compute the surface of a molecule's file"""

    bl_idname = "object.meniscus_from_file"
    bl_label = "Surface of a file"
    bl_options = {"UNDO"}

    filepath: bpy.props.StringProperty(subtype="FILE_PATH", options={"SKIP_SAVE"})
    selection: bpy.props.StringProperty(name="Selection", description="chain A and not element H")
    trajectory: bpy.props.StringProperty(name="Trajectory", subtype="FILE_PATH")
    is_run: bpy.props.BoolProperty(name="Frames", description="Show frames of the trajectory, or the file's models")
    center: bpy.props.BoolProperty(name="Centre", default=True)

    def execute(self, context):
        name = os.path.basename(self.filepath).split(".")[0] or "surface"
        item = new_object(context, name + ".surface", "FILE", detail=self.detail,
                          file=build.remembered_path(self.filepath), selection=self.selection,
                          trajectory=self.trajectory and build.remembered_path(self.trajectory), is_run=self.is_run or
                          bool(self.trajectory), center=self.center)
        return start(self, item)


class OBJECT_OT_meniscus_from_atoms(Making, bpy.types.Operator):
    """Compute the surface of the active object's atoms, as Molecular Nodes has them"""

    bl_idname = "object.meniscus_from_atoms"
    bl_label = "Surface of atoms"
    bl_options = {"UNDO"}

    selection: bpy.props.StringProperty(name="Selection", description="Name of a boolean attribute")

    @classmethod
    def poll(cls, context):
        return molecular_nodes.is_molecule(context.active_object)

    @build.reports_errors
    def execute(self, context):
        atoms = context.active_object
        scale = molecular_nodes.scale_of(atoms)
        item = new_object(context, atoms.name + ".surface", "OBJECT", atoms=atoms, scale=scale,
                          selection=self.selection, detail=self.detail)
        item.parent = atoms  # without an inverse matrix, so that it has the place of its atoms
        computed.come_last()
        return start(self, item)


class OBJECT_OT_meniscus_update(Waiting, bpy.types.Operator):
    """Compute the active surface from what its object stores"""

    bl_idname = "object.meniscus_update"
    bl_label = "Update"
    bl_options = {"UNDO"}

    @classmethod
    def poll(cls, context):
        item = context.active_object
        return computed.is_computed(item) and item.mode == "OBJECT"

    @build.reports_errors
    def execute(self, context):
        item = context.active_object
        if not computed.working().describe_tools()["library"]:
            computed.search_tools_again()
        libraries.own_mesh(item, lambda _other: True)[computed.SHOWN] = ""
        return start(self, item)


class OBJECT_OT_meniscus_cancel(bpy.types.Operator):
    """Stop computing; the surface stays as it is"""

    bl_idname = "object.meniscus_cancel"
    bl_label = "Cancel"

    @classmethod
    def poll(cls, context):
        return computed.is_computed(context.active_object) and computed.progress_of(context.active_object) is not None

    def execute(self, context):
        computed.cancel(context.active_object)
        computed.redraw()
        return {"FINISHED"}


def _offered(_self, context):
    item = context.active_object if context else None
    offered = looks.offered(item.data) if is_surface(item) else looks.COLORINGS
    return [(name, label, "", number) for number, (name, label) in enumerate(looks.COLORINGS.items())
            if name in offered]


class OBJECT_OT_meniscus_look(bpy.types.Operator):
    """Give the active surface a material that colours by its attributes"""

    bl_idname = "object.meniscus_look"
    bl_label = "Apply look"
    bl_options = {"REGISTER", "UNDO"}

    look: bpy.props.EnumProperty(name="Look", default="PAINT",
                                 items=[(name, label, "") for name, label in looks.LOOKS.items()])
    coloring: bpy.props.EnumProperty(name="Colour", items=_offered)
    lines: bpy.props.BoolProperty(name="Outlines", description="Draw outlines by Line Art, as an object of their own",
                                  default=False)

    @classmethod
    def poll(cls, context):
        return is_surface(context.active_object) and context.active_object.data.library is None

    @build.reports_errors
    def execute(self, context):
        item = context.active_object
        name = looks.ATTRIBUTES[self.coloring]
        if name not in item.data.attributes:
            raise mns_reader.MnsError(f"{item.name} has no attribute {name}")
        looks.dress(item, self.look, self.coloring)
        if self.lines:
            looks.add_lines(context, item)
        return {"FINISHED"}


def is_surface(item):
    return item is not None and item.type == "MESH" and "ses_kind" in item.data.attributes


class InSidebar:
    """The place of all panels."""

    bl_category = "Meniscus"
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"


class BelowPanel(InSidebar):
    """The place of panels inside the first one."""

    bl_parent_id = "VIEW3D_PT_meniscus"


class VIEW3D_PT_meniscus(InSidebar, bpy.types.Panel):
    bl_idname = "VIEW3D_PT_meniscus"
    bl_label = "Meniscus"

    def draw(self, context):
        layout, item = self.layout, context.active_object
        column = layout.column(align=True)
        column.operator("object.meniscus_from_file", icon="FILE_FOLDER")
        column.operator("object.meniscus_from_atoms", icon="OUTLINER_OB_POINTCLOUD")
        column.operator("object.meniscus_from_scene", icon="SCENE_DATA")
        if item is not None and item.library is not None and is_surface(item):
            layout.label(text="Linked: stays as it was saved", icon="LINKED")
        if not computed.is_computed(item):
            self.draw_error(item)
            bake_run.draw(layout, context)
            return
        layout.use_property_split, layout.use_property_decorate = True, False
        self.draw_state(item)
        bake_run.draw(layout, context)
        self.draw_request(item)

    def draw_error(self, item):
        """Draws the last error of an object. Returns True if there is one."""
        error = item.get(libraries.ERROR) if item is not None else None
        for line in wrapped(error or "", 40):
            self.layout.label(text=line, icon="ERROR")
        return bool(error)

    def draw_state(self, item):
        layout, progress = self.layout, computed.progress_of(item)
        row = layout.row(align=True)
        row.operator("object.meniscus_update", icon="FILE_REFRESH")
        if progress is not None:
            row.operator("object.meniscus_cancel", text="", icon="CANCEL")
            layout.label(text="%s … %.1f s" % progress, icon="SORTTIME")
        if not self.draw_error(item) and "meniscus_area" in item:
            layout.label(text="%.2f Å², %.2f Å³" % (item["meniscus_area"], item["meniscus_volume"]))
            layout.label(text=f"{len(item.data.polygons):,} triangles")

    def draw_request(self, item):
        layout, settings = self.layout, item.meniscus
        if settings.source == "FILE":
            layout.prop(settings, "file")
            layout.prop(settings, "selection")
            layout.prop(settings, "color")
            if settings.color == OWN_COLORS:
                layout.prop(settings, "colors")
            if settings.color in (*OF_NUMBERS, OWN_COLORS):
                layout.prop(settings, "numbers")
        else:
            layout.prop(settings, "atoms")
            if settings.atoms is not None:
                layout.prop_search(settings, "selection", settings.atoms.data, "attributes")
        layout.prop(settings, "kind")
        row = layout.row()
        row.active = settings.kind != "VDW"
        row.prop(settings, "probe", slider=True)
        layout.prop(settings, "detail")
        if settings.detail != "FINE":
            layout.prop(settings, "density")
        if settings.detail != "PROXY":
            layout.prop(settings, "tolerance")
        layout.prop(settings, "cavities")
        layout.prop(settings, "crisp")
        layout.prop(settings, "scale")
        layout.prop(settings, "live")


class VIEW3D_PT_meniscus_molecule(BelowPanel, bpy.types.Panel):
    bl_idname = "VIEW3D_PT_meniscus_molecule"
    bl_label = "Molecule"

    @classmethod
    def poll(cls, context):
        return computed.is_computed(context.active_object) and context.active_object.meniscus.source == "FILE"

    def draw(self, context):
        draw_fields(self.layout, context.active_object.meniscus, preparation.OF_MOLECULE)


def draw_fields(layout, settings, rows):
    layout.use_property_split, layout.use_property_decorate = True, False
    for row in rows:
        layout.prop(settings, preparation.name_of(row))


class VIEW3D_PT_meniscus_time(BelowPanel, bpy.types.Panel):
    bl_idname = "VIEW3D_PT_meniscus_time"
    bl_label = "Time"

    @classmethod
    def poll(cls, context):
        return computed.is_computed(context.active_object)

    def draw(self, context):
        layout, item = self.layout, context.active_object
        settings = item.meniscus
        layout.use_property_split = True
        if settings.source == "FILE":
            layout.prop(settings, "is_run")
            if settings.is_run:
                layout.prop(settings, "trajectory")
                if settings.trajectory:
                    layout.prop(settings, "trajectory_atoms")
                layout.prop(settings, "frames")
                draw_fields(layout.column(), settings, preparation.OF_RUN)
        count = computed.frame_count(item)
        if not count:
            return
        layout.label(text=f"{count:,} frames")
        for name in ("start", "speed", "outside", "by_hand"):
            layout.prop(settings, name)
        row = layout.row()
        row.active = settings.by_hand
        row.prop(settings, "frame")


class VIEW3D_PT_meniscus_look(BelowPanel, bpy.types.Panel):
    bl_idname = "VIEW3D_PT_meniscus_look"
    bl_label = "Look"

    @classmethod
    def poll(cls, context):
        return is_surface(context.active_object)

    def draw(self, context):
        for look, label in looks.LOOKS.items():
            row = self.layout.operator_menu_enum("object.meniscus_look", "coloring", text=label)
            row.look, row.lines = look, look == "FLAT"


def wrapped(text, width):
    """Yields a text as lines of at most `width` characters, because panels do not wrap text."""
    line = ""
    for word in text.split():
        if line and len(line) + len(word) >= width:
            yield line
            line = ""
        line = f"{line} {word}".strip()
    if line:
        yield line


CLASSES = (OBJECT_OT_meniscus_from_file, OBJECT_OT_meniscus_from_atoms, OBJECT_OT_meniscus_update,
           OBJECT_OT_meniscus_cancel, OBJECT_OT_meniscus_look, VIEW3D_PT_meniscus, VIEW3D_PT_meniscus_molecule,
           VIEW3D_PT_meniscus_time, VIEW3D_PT_meniscus_look)


register, unregister = bpy.utils.register_classes_factory(CLASSES)
