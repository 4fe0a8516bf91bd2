# SPDX-License-Identifier: GPL-3.0-or-later
"""The settings of a computed surface, which its object stores, and the paths of the tools that compute."""

import zlib

import bpy

from . import libraries, sequence_reader
from .computing import preparation, preparation_table, request

#: The first colours, whose order must not change because files of 0.2.0 store their places.
_FIRST_COLORS = (("element", "Element", "Chemical element, in pale colours"), ("element-cpk", "Element (CPK)",
                                                                               "In the colours of models"),
                 ("chain", "Chain", "Chains in order of appearance"), ("residue", "Residue", "Residue type"),
                 ("bfactor", "B-factor", "B-factor; viridis, smallest to largest"),
                 ("occupancy", "Occupancy", "Occupancy; viridis"), ("hydrophobicity", "Hydrophobicity",
                                                                    "Hydropathy of the amino acid"),
                 ("charge", "Charge", "Partial charge, of PQR files"), ("radial", "Radial", "Distance from the middle"),
                 ("kind", "Patch", "Kind of patch: convex, toroidal, concave"))
#: The choice of colours that the user writes as text.
OWN_COLORS = "own"
#: All choices of colours. The numbers of the others are checksums of their names, because the list may grow.
COLORS = (*((*row, "", place) for place, row in enumerate(_FIRST_COLORS)),
          *((word, word.replace("-", " ").capitalize(), "The program meniscus computes it" if of_more else "", "",
             1000 + zlib.crc32(word.encode()) % 10**6)
            for word, of_more in preparation_table.SCHEMES if word not in {row[0] for row in _FIRST_COLORS}),
          (OWN_COLORS, "As written", "The colours below", "", 999))
#: Schemes that need a file with numbers.
OF_NUMBERS = ("file", "conservation")

#: The choices of the fineness of a mesh. Their numbers must not change because files of 0.2.0 store them.
DETAILS = (("AUTO", "Fine at rest", "A proxy while sliders move and while the timeline plays, else a fine mesh", "", 2),
           ("PROXY", "Proxy", "Even triangles, by vertices per Å²", "", 0),
           ("FINE", "Fine", "Within a tolerance of the exact surface, for pictures", "", 1))
#: Settings without effect on the surface. A keyed frame is evaluated when it is shown.
APART = ("frame", "live", "center")


def on_change(settings, _context):
    """Updates the object after a property that affects the surface has changed."""
    from . import computed  # imported late, because it needs the settings

    libraries.note(settings.id_data)
    computed.changed(settings.id_data)


def _is_atoms(settings, item):
    return item.type == "MESH" and item != settings.id_data and "vdw_radii" in item.data.attributes


def _field(row):
    """Returns the property for a row of preparation_table.py."""
    common = {"name": preparation.label_of(row), "description": preparation.help_of(row), "update": on_change,
              "default": preparation.default_of(row)}
    if row.type == "flag":
        return bpy.props.BoolProperty(**common)
    if row.type == "count":
        return bpy.props.IntProperty(min=int(row.lowest), max=int(row.highest), **common)
    if row.type == "word":
        return bpy.props.EnumProperty(items=[(word, word.capitalize(), "") for word in row.words], **common)
    if row.words:
        common["search"] = lambda _settings, _context, typed: [word for word in row.words if typed in word]
        common["search_options"] = {"SUGGESTION"}
    return bpy.props.StringProperty(**common)


def timing_fields(outside):
    """Returns the properties of a sequence_reader.Timing by name. outside: the default for times outside of the run."""
    return {
        "start": bpy.props.FloatProperty(
            name="Start", description="The frame of the scene that shows the first of the run", default=1.0),
        "speed": bpy.props.FloatProperty(name="Speed", description="Frames of the run in a frame of the scene",
                                         default=1.0, min=1e-4, soft_max=10.0),
        "outside": bpy.props.EnumProperty(
            name="Outside", default=outside, description="What shows before and behind the run",
            items=(("EMPTY", "Nothing", "Nothing shows"), ("HOLD", "Hold", "The first and the last frame stay"),
                   ("LOOP", "Loop", "The run begins anew"), ("PINGPONG", "To and fro", "The run goes back and forth")))}


class MeniscusSettings(bpy.types.PropertyGroup):
    """The settings of an object that shows a computed surface. All of them except the timing are its stored request."""

    source: bpy.props.EnumProperty(
        name="Source", default="NONE",
        items=(("NONE", "None", "The object shows no computed surface"), ("FILE", "File", "A molecule's file"),
               ("OBJECT", "Object", "The atoms of an object, as Molecular Nodes has them")))
    file: bpy.props.StringProperty(name="File", description="A molecule: PDB, mmCIF, SDF, MOL2, ...",
                                   subtype="FILE_PATH", update=on_change)
    trajectory: bpy.props.StringProperty(
        name="Trajectory",
        description="XTC, TRR, DCD, ..., which the program meniscus reads; without one the file's models are the "
        "frames, if a run is shown", subtype="FILE_PATH", update=on_change)
    is_run: bpy.props.BoolProperty(
        name="Frames", description="Show frames of the trajectory, or the models of the file, on the "
        "timeline", default=False, update=on_change)
    frames: bpy.props.StringProperty(name="Frames", description='Which: "all", "0-999:10"', default="all",
                                     update=on_change)
    trajectory_atoms: bpy.props.StringProperty(
        name="Trajectory's atoms", description="Which atoms of the file the trajectory has (not water), if not all",
        update=on_change)
    atoms: bpy.props.PointerProperty(name="Atoms",
                                     description="An object whose vertices are atoms with an attribute vdw_radii",
                                     type=bpy.types.Object, poll=_is_atoms, update=on_change)
    selection: bpy.props.StringProperty(
        name="Selection",
        description="Of a file an expression (chain A and not element H); of an object the name of a boolean "
        "attribute. Empty: all that a surface takes", update=on_change)
    kind: bpy.props.EnumProperty(
        name="Surface", default="SES", update=on_change,
        items=(("SES", "Solvent-excluded", "What the probe cannot reach"),
               ("SAS", "Solvent-accessible", "Where its centre can be"), ("VDW", "Van der Waals",
                                                                          "The balls themselves")))
    probe: bpy.props.FloatProperty(name="Probe", description="Radius of the probe in Å; 1.4 is water", default=1.4,
                                   min=0.0, max=100.0, soft_min=0.5, soft_max=5.0, step=5, precision=2,
                                   update=on_change)
    color: bpy.props.EnumProperty(name="Colour", default="element", items=COLORS, update=on_change)
    colors: bpy.props.StringProperty(
        name="Colours",
        description="Schemes, colours (red, #rrggbb) and EXPR=COLOR with semicolons between them, such as "
        "chain; resid 25=red. The last one counts", update=on_change)
    numbers: bpy.props.StringProperty(
        name="Numbers", description="A file with a number for each residue or atom: CSV, ConSurf, JSON, ...",
        subtype="FILE_PATH", update=on_change)
    detail: bpy.props.EnumProperty(name="Detail", default="AUTO", items=DETAILS, update=on_change)
    density: bpy.props.FloatProperty(
        name="Density", description="Vertices per Å² of a proxy; 1 shows atoms, 0.1 makes about a triangle an atom",
        default=1.0, min=0.005, max=1000.0, soft_min=0.05, soft_max=5.0, precision=3, update=on_change)
    tolerance: bpy.props.FloatProperty(name="Tolerance", description="Å that the mesh is from the surface at most",
                                       default=0.05, min=1e-5, max=1.0, precision=3, update=on_change)
    cavities: bpy.props.EnumProperty(
        name="Cavities", default="KEEP", update=on_change,
        items=(("KEEP", "Keep", "They show, with the second material"),
               ("DROP", "Leave out", "Only what is outside shows"), ("ONLY", "Alone", "Nothing else shows")))
    live: bpy.props.BoolProperty(name="Live", description="Compute anew while sliders move", default=True,
                                 update=on_change)
    scale: bpy.props.FloatProperty(name="Scale", description="Blender units per Å", default=0.1, min=1e-6, soft_max=1.0,
                                   precision=4, update=on_change)
    center: bpy.props.BoolProperty(
        name="Centre", description="The middle of the molecule comes to the origin, or where an earlier "
        "import put it", default=True)
    crisp: bpy.props.BoolProperty(name="Crisp colours", description="Colours change at edges; otherwise they blend",
                                  default=False, update=on_change)
    by_hand: bpy.props.BoolProperty(name="By hand", description="Show the frame below, which can be keyed",
                                    default=False)
    frame: bpy.props.FloatProperty(name="Frame", description="Place in the run, from 1", default=1.0)

    def preparation(self):
        """Returns the preparation of the file that differs from the program's defaults, as pairs of name and value."""
        if self.source != "FILE":
            return ()
        rows = [*preparation.OF_MOLECULE, *(preparation.OF_RUN if self.is_run else ())]
        if self.is_run and not self.trajectory:  # the frames are the models of the file
            rows = [row for row in rows if preparation.name_of(row) != "model"]
        return preparation.changed_fields(rows, lambda name: getattr(self, name))

    def surface_values(self):
        """Returns all values that determine the shown surfaces and their times. Equal lists mean equal surfaces."""
        return [getattr(self, name) for name in type(self).__annotations__ if name not in APART]

    def written_color(self):
        return self.colors if self.color == OWN_COLORS else self.color

    def timing(self):
        return sequence_reader.Timing(self.start, self.speed, self.outside)

    def has_proxy(self, in_motion):
        """Returns True if a proxy is shown. in_motion: True if a slider moves or the timeline plays."""
        return self.detail == "PROXY" or (self.detail == "AUTO" and in_motion)

    def request(self, place=0, in_motion=False):
        """Returns the request.Request of these settings. place: the place of the frame in the run, from 1, or 0."""
        of_file = self.source == "FILE"
        return request.Request(
            file=libraries.path_of(self.id_data, "file") if of_file else "",
            trajectory=libraries.path_of(self.id_data, "trajectory") if of_file and self.is_run else "",
            frames=self.frames if of_file and self.is_run else "",
            trajectory_atoms=self.trajectory_atoms if of_file and self.is_run else "", preparation=self.preparation(),
            selection=self.selection, color=self.written_color() if of_file else "",
            numbers=(libraries.path_of(self.id_data, "numbers")
                     if of_file and self.color in (*OF_NUMBERS, OWN_COLORS) else ""), place=place,
            kind=self.kind, probe=short(self.probe), tolerance=short(self.tolerance),
            density=short(self.density) if self.has_proxy(in_motion) else 0.0, cavities=self.cavities)


MeniscusSettings.__annotations__.update(timing_fields("HOLD"))
MeniscusSettings.__annotations__.update({preparation.name_of(row): _field(row) for row in preparation.ROWS})
for each in MeniscusSettings.__annotations__.values():
    each.keywords["override"] = {"LIBRARY_OVERRIDABLE"}
if bpy.app.version >= (4, 5, 0):
    for each in libraries.SETTINGS:
        MeniscusSettings.__annotations__[each].keywords["options"] = {"ANIMATABLE", "PATH_SUPPORTS_BLEND_RELATIVE"}


def short(value):
    """Returns the number that the user typed, which a property stores in single precision."""
    return float(f"{value:.6g}")


class MeniscusPreferences(bpy.types.AddonPreferences):
    """The paths of the tools that compute, if Python and the shell do not find them."""

    bl_idname = __package__

    package: bpy.props.StringProperty(
        name="Python package",
        description="The folder named meniscus of the Python package with libmeniscus; empty: as Python finds it",
        subtype="DIR_PATH")
    program: bpy.props.StringProperty(name="Program", description="The program meniscus; empty: as the shell finds it",
                                      subtype="FILE_PATH")

    def draw(self, _context):
        from . import computed

        self.layout.prop(self, "package")
        self.layout.prop(self, "program")
        for line in computed.tool_lines():
            self.layout.label(text=line)


_register, _unregister = bpy.utils.register_classes_factory((MeniscusSettings, MeniscusPreferences))


def register():
    _register()
    bpy.types.Object.meniscus = bpy.props.PointerProperty(type=MeniscusSettings, override={"LIBRARY_OVERRIDABLE"})


def unregister():
    del bpy.types.Object.meniscus
    _unregister()
