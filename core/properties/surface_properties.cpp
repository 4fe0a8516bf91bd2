// SPDX-License-Identifier: BSD-3-Clause
// Properties of the surface and of shapes drawn with it: kind, probe, device, colours, cuts, sticks, pockets; of
// meshes, and of the files that commands write.

#include <array>

#include "core/properties/properties.h"

namespace meniscus {
namespace {

constexpr unsigned kShared = in_scene | in_bundle;
constexpr unsigned kSeen = in_scene | in_bundle | needs_support;
constexpr std::string_view kSurface = "Surface", kColour = "Colour", kFigure = "Figure", kShapes = "Shapes",
                           kDevice = "Computing";

constexpr auto kTable = std::to_array<Property>({
    flag("surface.shown", "--hide-surface", "Hide the surface; draw only sticks, tubes and other shapes")
        .with<&Property::label>("Surface")
        .in(kFigure, kSeen | live | negated),
    text("surface.interface", "--interface", "A:B",
         "Open the contact of two groups like a book: A:B, A,C:B or EXPR:EXPR. Both sides face the viewer and are "
         "coloured by buried area")
        .in(kSurface, kSeen | in_short_help),
    word("surface.kind", "--surface", "KIND",
         "Kind of surface: ses, sas or vdw. ses: solvent-excluded; sas: solvent-accessible; vdw: van der Waals, "
         "without a probe")
        .one_of("ses|sas|vdw")
        .initially("ses")
        .in(kSurface, kSeen | live | of_surfaces),
    text("surface.probe", "--probe", "RADIUS", "Radius of the probe in Å; 0 gives the van der Waals surface")
        .from(0, 1000)
        .initially("1.4")
        .in(kSurface, kShared | live | of_surfaces | in_short_help),
    text("surface.show", "--show", "EXPR", "Show only the surface of these atoms. It is still computed with all atoms")
        .in(kSurface, kShared | live | of_surfaces | in_short_help),
    text("surface.patches", "--patches", "EXPR",
         "Contiguous areas of these atoms, as a table or outlined in pictures. For "
         "example 'hydrophobicity > 1.5' or 'charge < -0.3'")
        .in(kSurface, kSeen | live | in_short_help),
    number("surface.min_patch", "--min-patch", "Å²", "Smallest area of a patch that is listed or outlined")
        .from(0, 1e9)
        .initially("10")
        .with<&Property::label>("Smallest patch")
        .in(kSurface, kShared | live),
    text("surface.by", "--by", "WORD",
         "Split into objects: by chain, model, class, residue or component. chain, model, class (polymer, ligand, "
         "...), residue: each has a surface as if it were alone; component: each closed part of the one surface")
        .proposes("chain|model|class|residue|component")
        .in(kSurface, kSeen | in_short_help),
    word("surface.cavities", "--cavities", "WORD",
         "Cavities: keep, drop or only. drop: leave out what cannot be reached from outside; only: keep cavities and "
         "what lies in them")
        .one_of("keep|drop|only")
        .initially("keep")
        .in(kSurface, kSeen),
    text("surface.device", "--device", "DEVICE",
         "Device: auto, gpu, gpu:N, software or cpu. auto: a GPU if there is one, else cpu; N: a number, UUID or "
         "PCI address; software: OpenGL without a GPU")
        .proposes("auto|gpu|software|cpu")
        .initially("auto")
        .in(kDevice, in_short_help),
    flag("surface.require_gpu", "--require-gpu",
         "Fail with exit code 4 if there is no hardware GPU. Without it the CPU or software OpenGL is used")
        .in(kDevice),
    count("surface.threads", "--threads", "N", "Number of CPU threads").from(1, 4096).initially("all").in(kDevice),
    flag("surface.verify", "--verify", "Compute on GPU and CPU, and report every difference").in(kDevice, in_bundle),

    text("surface.color", "--color", "SCHEME",
         "Colour: a scheme, a colour (red, #rrggbb), or EXPR=COLOR. Schemes: auto (chain; along a "
         "single chain; element-cpk for small molecules), element, element-cpk (darker), chain, chain-element, "
         "chain-okabe-ito, copy (of an assembly), residue (type), secondary (helix, strand, coil), plddt (AlphaFold's "
         "confidence), snfg (sugars), "
         "bead (of Martini), kind (of patch), component; by a number: bfactor, "
         "occupancy, charge, hydrophobicity (Kyte & Doolittle 1982), lipophilicity (a potential), "
         "relative-accessibility, index, rainbow (along each chain), radial (for capsids). EXPR=COLOR colours some "
         "atoms, as in 'ligand=orange'; 'ligand=orange:ATP' names them in the legend. Repeatable; the last one "
         "counts. meniscus colors explains the schemes")
        .initially("auto")
        .in(kColour, kSeen | live | repeatable | of_objects | in_short_help),
    file("surface.color_by_file", "--color-by-file", "NUMBERS",
         "Colour by numbers from a file. One number per atom of FILE or per atom used; lines of chain, residue and "
         "number; or a table with a header, such as @csv-residues@ of meniscus surface writes, or resid,score for "
         "one chain. Commas, semicolons, tabs or blanks; nan, ? and - mean missing. Grades from 1 to 9: @color "
         "conservation@")
        .in(kColour, kSeen | in_short_help),
    text("surface.color_column", "--color-column", "NAME", "Column of the table of @color-by-file@")
        .in(kColour, kSeen)
        .needs("surface.color_by_file"),
    file("surface.color_map_file", "--color-map-file", "FILE",
         "Colour by a volume map, such as a potential from APBS. Formats: OpenDX (.dx), Gaussian cube, CCP4/MRC. "
         "Needs @color-range@; the default @map@ is red-white-blue")
        .in(kColour, kSeen | in_short_help)
        .excludes("surface.color_by_file"),
    number("surface.map_offset", "--map-offset", "Å",
           "Distance outside the surface at which the map is sampled, in Å. Centres of solvent molecules lie at 1.4")
        .from(-20, 20)
        .initially("0")
        .in(kColour, kSeen | rare)
        .needs("surface.color_map_file"),
    text("surface.map", "--map", "MAP",
         "Colour map for numbers, such as viridis or blue-white-red. Others: cividis, magma, red-white-blue "
         "(default for charge: negative is red), blues and ylorrd (light), consurf (grades 1 to 9), rainbow, pastel "
         "(rainbow in light tones), categorical (each number has its own colour). blue-white-red is the default for "
         "hydrophobicity")
        .initially("viridis")
        .with<&Property::label>("Colour map")
        .in(kColour, kSeen | live | of_objects | in_short_help),
    file("surface.map_file", "--map-file", "FILE",
         "File of a colour map: one colour per line, or a position and a colour. A JSON list of them is read, too")
        .in(kColour, kSeen),
    text("surface.color_range", "--color-range", "LO:HI",
         "Numbers at the ends of the colour map, or auto. auto: the smallest and the largest; for charge symmetric "
         "about 0, for hydrophobicity -4.5:4.5")
        .initially("auto")
        .in(kColour, kSeen | live | of_objects | in_short_help),
    text("surface.missing_color", "--missing-color", "COLOR",
         "Colour of atoms without a number and points outside the map")
        .initially("#808080; cividis #cc79a7; consurf #ffff96")
        .in(kColour, kSeen | live | of_objects),
    text("surface.color_title", "--color-title", "TEXT", "Title of the colour scale in the legend")
        .with<&Property::label>("Title of the scale")
        .in(kColour, kShared | live),
    text("surface.color_unit", "--color-unit", "TEXT", "Unit of the colour scale, such as kT/e")
        .with<&Property::label>("Unit of the scale")
        .in(kColour, kShared | live),
    text("surface.opacity", "--opacity", "EXPR=N",
         "Opacity from 0 (hidden) to 1: a number, or EXPR=0.4 for some atoms. Repeatable; the last one counts")
        .in(kFigure, kSeen | live | repeatable | of_objects | in_short_help),
    flag("surface.film_opacity", "--film-opacity",
         "Make transparent surfaces denser at grazing angles, like a thin film")
        .in(kFigure, kSeen | live | of_surfaces),
    text("surface.clip", "--clip", "PLANE",
         "Cut by a plane with exact caps: x<20, 1,1,0>35 or depth>0.5. The part where this holds is kept. depth "
         "runs along the line of sight from 0 (nearest) to 1 (farthest). 'through EXPR' goes through the middle of "
         "these atoms, 'before EXPR' cuts just deep enough to show them. Repeatable; all apply")
        .with<&Property::label>("Cuts")
        .in(kFigure, kSeen | live | repeatable | of_surfaces | in_short_help),
    flag("surface.clip_all", "--clip-all", "Cut sticks, balls, tubes and all other objects by @clip@, too")
        .in(kFigure, kSeen | live),
    text("surface.cap_color", "--cap-color", "COLOR",
         "Colour of caps: atom (the nearest atom's) or a colour (red, #rrggbb)")
        .initially("atom")
        .in(kFigure, kSeen | live | of_surfaces),
    number("surface.cap_hatching", "--cap-hatching", "Å", "Distance of dark lines on caps, in Å; 0: no lines")
        .from(0, 1000)
        .initially("0")
        .in(kFigure, kSeen | live | of_surfaces),

    text("figure.sticks", "--sticks", "EXPR", "Draw these atoms as sticks, also outside @select@. Repeatable")
        .in(kShapes, in_bundle | live | repeatable | in_short_help),
    text("figure.balls", "--balls", "EXPR", "Draw these atoms as balls and sticks")
        .in(kShapes, in_bundle | live | repeatable | in_short_help),
    text("figure.spheres", "--spheres", "EXPR", "Draw these atoms as spheres of their van der Waals radii")
        .in(kShapes, in_bundle | live | repeatable | in_short_help),
    text("figure.tube", "--tube", "EXPR",
         "Draw the backbone of these atoms as a cartoon: tubes, ribbons, arrows. Helices are ribbons, strands are "
         "arrows, nucleic acids are bands with filled bases")
        .in(kShapes, in_bundle | live | repeatable | in_short_help),
    text("figure.bases", "--bases", "EXPR",
         "Draw the bases of these nucleotides as filled rings. Rungs lead to the tube")
        .in(kShapes, in_bundle | live | repeatable),
    text("figure.glycans", "--glycans", "EXPR",
         "Draw these sugars as solid symbols (3D-SNFG): spheres, cubes, cones. Their colours: @color snfg@")
        .in(kShapes, in_bundle | live | repeatable),
    text("figure.hydrogen_bonds", "--hydrogen-bonds", "EXPR",
         "Draw hydrogen bonds of these atoms as dashed lines, with lengths. 'EXPR to EXPR': only bonds between two "
         "sets. Water counts if it is drawn or selected")
        .in(kShapes, in_bundle | repeatable | in_short_help),
    text("figure.distance", "--distance", "EXPR to EXPR", "Draw a dashed line between the closest atoms of two sets")
        .in(kShapes, in_bundle | repeatable | in_short_help),
    flag("shapes.bare", "--bare", "Do not draw ligands and ions by default. Those that other options name are drawn")
        .in(kFigure, kSeen | live),
    number("shapes.stick_radius", "--stick-radius", "Å", "Radius of sticks in Å, also in bases and between glycans")
        .from(0.001, 10)
        .initially("0.25; 0.15 between balls")
        .in(kShapes, kSeen | live),
    number("shapes.tube_radius", "--tube-radius", "Å", "Radius of tubes in Å. Ribbons and arrows scale with it")
        .from(0.001, 10)
        .initially("0.45")
        .in(kShapes, kSeen | live),
    text("figure.object", "--object", "JSON",
         "Draw one more object with its own look, as JSON of a scene file. Example: '{\"representation\": "
         "\"surface\", \"selection\": \"chain B\", \"color\": \"red\"}'. Repeatable")
        .in(kShapes, in_bundle | live | repeatable),

    // Beyond the largest probe every atom neighbours every other. The number of large probes in mouths grows with the
    // inverse of their tolerance.
    number("pockets.large_probe", "--large-probe", "Å",
           "Radius of the large probe that closes mouths, in Å. A larger one finds wider, shallower pockets")
        .from(1e-3, 100)
        .initially("4")
        .in(kSurface),
    number("pockets.trim", "--trim", "Å",
           "Depth below the large probe's surface at which pockets begin, in Å. A larger value separates pockets that "
           "meet there")
        .from(0, 100)
        .initially("1")
        .in(kSurface),
    number("pockets.min_volume", "--min-volume", "Å³", "Smallest volume of a pocket")
        .from(0, 1e9)
        .initially("30: one molecule of water")
        .in(kSurface, in_short_help),
    number("pockets.mouth_tolerance", "--mouth-tolerance", "Å",
           "Largest error of a mouth's position, in Å; less takes longer")
        .from(1e-3, 1)
        .initially("0.1")
        .in(kSurface),
    text("pockets.ligand", "--ligand", "EXPR", "Atoms to remove first; their places are reported. none: remove none")
        .initially("ligand")
        .in(kSurface, in_short_help),
});

constexpr std::string_view kMesh = "Mesh", kOutput = "Output", kScene = "Scene";

constexpr auto kMeshTable = std::to_array<Property>({
    number("mesh.tolerance", "--tolerance", "Å", "Largest distance between mesh and surface, in Å")
        .from(1e-5, 1)
        .in(kMesh, in_scene | in_bundle | in_short_help),
    number("mesh.tolerance_pixels", "--tolerance-pixels", "PIXELS",
           "Largest distance between mesh and surface, in pixels, such as 0.25")
        .from(1e-3, 100)
        .in(kMesh, in_scene | in_bundle)
        .excludes("mesh.tolerance"),
    number("mesh.density", "--density", "NUMBER",
           "Vertices per Å², instead of a tolerance. 0.02 gives about one triangle per atom; triangles are even")
        .from(0.005, 1000)
        .in(kMesh, in_scene | in_bundle | in_short_help)
        .excludes("mesh.tolerance|mesh.tolerance_pixels"),
    flag("mesh.even", "--even", "Make nearly equilateral triangles. They cross the borders of patches")
        .in(kMesh, in_scene | in_bundle),
    text("mesh.format", "--format", "WORD", "Format of the file, if its ending does not say")
        .in(kMesh, in_scene | in_short_help),
    text("mesh.attributes", "--attributes", "NAMES",
         "Numbers of vertices to write in PLY, VTP, GLB and USD, separated by commas")
        .initially("usual")
        .in(kMesh, in_scene | in_bundle),
    word("mesh.unit", "--unit", "UNIT", "Unit of the file: angstrom or nanometer")
        .one_of("angstrom|nanometer")
        .initially("angstrom")
        .in(kMesh, in_scene),
    number("mesh.scale", "--scale", "LENGTH",
           "Length of 1 Å in the file. 3MF is in millimetres, GLB and USD are in metres; other formats have no unit")
        .from(1e-12, 1e6)
        .initially("1")
        .in(kMesh, in_scene)
        .excludes("mesh.unit"),

    number("distances.voxel", "--voxel", "Å", "Edge of a voxel, in Å").from(0.01, 100).initially("0.5").in(kMesh),
    count("distances.band", "--band", "N", "Voxels on each side of the surface that get their distance")
        .from(1, 1000)
        .initially("3")
        .in(kMesh),

    number("pockets.tolerance", "--tolerance", "Å", "Largest distance between mesh and pocket, in Å")
        .from(1e-5, 1)
        .initially("0.02")
        .in(kOutput),

    new_file("output.file", "-o,--output", "PATH", "Output file or folder").in(kOutput, in_scene | in_short_help),
    flag("output.force", "--force", "Replace an output that already exists").in(kOutput, in_short_help),
    file("scene.read", "--scene", "FILE",
         "Take options from a scene file or from a picture that meniscus made. Options on the command line override "
         "those of the scene")
        .in(kScene, in_short_help),
    flag("scene.trust", "--trust-scene", "Let the scene read and write files anywhere. Use it only for your own scenes")
        .in(kScene),
    text("scene.set", "--set", "KEY=VALUE",
         "Set a value by its scene key, such as look.outer_lines=2. Repeatable; meniscus help scenes lists the keys")
        .in(kScene, repeatable),
    new_file("scene.save", "--save-scene", "FILE", "Save these options as a scene file").in(kScene, in_short_help),
});

}  // namespace

std::span<const Property> surface_properties() { return kTable; }

std::span<const Property> mesh_properties() { return kMeshTable; }

}  // namespace meniscus
