// SPDX-License-Identifier: BSD-3-Clause
// Properties of the surface and of what is drawn with it: kind, probe, device, colours, cuts, sticks, pockets.
#include <array>

#include "core/properties/tables.h"

namespace meniscus {
namespace {

constexpr unsigned kShared = in_scene | in_bundle;
constexpr unsigned kSeen = in_scene | in_bundle | needs_support;
constexpr unsigned kForParts = for_surface | for_render | kForExports | for_mesh;
constexpr unsigned kForColours = kForFigures | for_mesh | for_atoms;
constexpr std::string_view kSurface = "Surface", kColour = "Colour", kFigure = "Figure", kBeside = "Beside the surface",
                           kDevice = "Computing";

constexpr auto kTable = of_commands(
    kForFigures,
    std::to_array<Property>({
        flag("surface.shown", "--hide-surface", "Draw only what is shown beside the surface")
            .in(kFigure, kSeen | live | negated),
        text(
            "surface.interface", "--interface", "A:B",
            "Open the contact of two groups like a book, both sides facing the viewer, coloured by buried area: chains "
            "(A:B, A,C:B) or EXPR:EXPR")
            .in(kSurface, kSeen)
            .in_short_help()
            .of((kForFigures & ~for_preview) | for_mesh),
        word("surface.kind", "--surface", "KIND",
             "ses: solvent-excluded; sas: solvent-accessible; vdw: van der Waals, without a probe")
            .one_of("ses|sas|vdw")
            .initially("ses")
            .in(kSurface, kSeen | live | of_surfaces)
            .of((kForRuns & ~for_pockets) | for_bench),
        text("surface.probe", "--probe", "RADIUS", "Radius of the probe in Å; 0 gives the van der Waals surface")
            .from(0, 1000)
            .initially("1.4")
            .in(kSurface, kShared | live | of_surfaces)
            .in_short_help()
            .of(kForRuns | for_bench),
        text("surface.show", "--show", "EXPR",
             "Compute the surface of all atoms used, but draw and export only the part of these")
            .in(kSurface, kShared | live | of_surfaces)
            .in_short_help()
            .of(kForFigures | for_mesh | for_pockets),
        text("surface.by", "--by", "WORD",
             "Several objects: chain, model, class (polymer, ligand, ...) or residue: each a surface of its own, as if "
             "it were alone; component: each closed part of the one surface")
            .proposes("chain|model|class|residue|component")
            .in(kSurface, kSeen)
            .in_short_help()
            .of(kForParts),
        word("surface.cavities", "--cavities", "WORD",
             "keep them; drop: only what can be reached from outside; only: cavities and what lies in them")
            .one_of("keep|drop|only")
            .initially("keep")
            .in(kSurface, kSeen)
            .of(kForParts),
        text("surface.device", "--device", "DEVICE",
             "auto (a GPU if there is one, else cpu), gpu, gpu:N (or UUID, PCI address), software (OpenGL without a "
             "GPU), or cpu")
            .proposes("auto|gpu|software|cpu")
            .initially("auto")
            .in(kDevice)
            .in_short_help()
            .of(kForRuns | for_bench),
        flag("surface.require_gpu", "--require-gpu",
             "Fail (exit code 4) where there is no hardware GPU, instead of using the CPU or software OpenGL")
            .in(kDevice)
            .of(kForRuns | for_bench),
        count("surface.threads", "--threads", "N", "Number of CPU threads")
            .from(1, 4096)
            .initially("all")
            .in(kDevice)
            .of((kForRuns & ~for_preview) | for_bench),
        flag("surface.verify", "--verify", "Compute on GPU and CPU, mesh, and report every difference")
            .in(kDevice, in_bundle)
            .of(for_surface | for_render | kForExports | for_mesh | for_atoms | for_bench),

        text("surface.color", "--color", "SCHEME",
             "Colour scheme: element, element-cpk (darker), chain, copy (of an assembly), residue (type), kind (of "
             "patch), component, a colour (red, #rrggbb); or by a number: bfactor, occupancy, charge, hydrophobicity "
             "(Kyte & Doolittle 1982), index, radial (for capsids); meniscus colors explains them. EXPR=COLOR colours "
             "some atoms, as in 'ligand=orange'. Repeatable; the last counts")
            .initially("element")
            .in(kColour, kSeen | live | repeatable | of_objects)
            .in_short_help()
            .of(kForColours),
        file("surface.color_by_file", "--color-by-file", "NUMBERS",
             "Colour by numbers from a file: one for each atom of FILE or each atom used; lines of chain, residue and "
             "number; or a CSV table, such as meniscus surface --csv-residues writes. nan, ? or - mean missing")
            .in(kColour, kSeen | live)
            .in_short_help()
            .of(kForColours),
        text("surface.color_column", "--color-column", "NAME", "Column of that table")
            .in(kColour, kSeen | live)
            .of(kForColours)
            .needs("surface.color_by_file"),
        file("surface.color_map_file", "--color-map-file", "FILE",
             "Colour each point of the surface by a volume map, such as a potential from APBS: OpenDX (.dx), Gaussian "
             "cube, CCP4/MRC; needs --color-range. Its --map is red-white-blue unless you choose another")
            .in(kColour, kSeen)
            .in_short_help()
            .of(kForColours)
            .excludes("surface.color_by_file"),
        number("surface.map_offset", "--map-offset", "Å",
               "Sample the volume map this far outside the surface, along its normal; centres of solvent lie at 1.4")
            .from(-20, 20)
            .initially("0")
            .in(kColour, kSeen | rare)
            .of(kForColours)
            .needs("surface.color_map_file"),
        text("surface.map", "--map", "MAP",
             "Colour map of numbers: viridis, cividis, magma, blue-white-red (default for hydrophobicity), "
             "red-white-blue (default for charge: negative is red), blues and ylorrd (light), consurf (grades 1 to 9), "
             "categorical (each number has its own colour)")
            .initially("viridis")
            .in(kColour, kSeen | live | of_objects)
            .in_short_help()
            .of(kForColours),
        file("surface.map_file", "--map-file", "FILE",
             "A colour map of your own: lines with a colour, or a position and a colour; or a JSON list of them")
            .in(kColour, kSeen | live)
            .of(kForColours),
        text("surface.color_range", "--color-range", "LO:HI",
             "Numbers at the ends of the colour map, or auto: the smallest and the largest (charge is symmetric about "
             "0, hydrophobicity has -4.5:4.5)")
            .initially("auto")
            .in(kColour, kSeen | live | of_objects)
            .in_short_help()
            .of(kForColours),
        text("surface.missing_color", "--missing-color", "COLOR",
             "Colour of atoms without a number, and of points outside the volume map")
            .initially("#808080; cividis #cc79a7; consurf #ffff96")
            .in(kColour, kSeen | live | of_objects)
            .of(kForColours),
        text("surface.color_title", "--color-title", "TEXT", "Title of the colour scale in the legend")
            .in(kColour, kShared)
            .of(kForColours),
        text("surface.color_unit", "--color-unit", "TEXT", "Unit of the colour scale, such as kT/e")
            .in(kColour, kShared)
            .of(kForColours),
        text("surface.opacity", "--opacity", "EXPR=N",
             "Opacity from 0 (hidden) to 1: EXPR=0.4 for some atoms, or a number alone for all. Repeatable; the last "
             "counts")
            .in(kFigure, kSeen | live | repeatable | of_objects)
            .in_short_help(),
        flag("surface.film_opacity", "--film-opacity",
             "Make transparent surfaces denser where the line of sight grazes them, like a thin film")
            .in(kFigure, kSeen | live | of_surfaces),
        text("surface.clip", "--clip", "PLANE",
             "Keep the part of the surface where this holds, with exact caps: x<20, 1,1,0>35 (a direction), or "
             "depth>0.5 along the line of sight (0 nearest, 1 farthest). Repeatable; all apply")
            .in(kFigure, kSeen | live | repeatable | of_surfaces)
            .in_short_help(),
        text("surface.cap_color", "--cap-color", "COLOR",
             "Colour of caps: atom (that of the nearest atom) or a colour (red, #rrggbb)")
            .initially("atom")
            .in(kFigure, kSeen | live | of_surfaces),
        number("surface.cap_hatching", "--cap-hatching", "Å", "Distance in Å between dark lines on caps; 0: no lines")
            .from(0, 1000)
            .initially("0")
            .in(kFigure, kSeen | live | of_surfaces),

        text("figure.sticks", "--sticks", "EXPR",
             "Draw the bonds of these atoms as sticks. Repeatable; may name atoms outside --select")
            .in(kBeside, in_bundle | live | repeatable)
            .in_short_help()
            .of(kForFigures | for_mesh),
        text("figure.balls", "--balls", "EXPR", "Draw these atoms as balls and sticks")
            .in(kBeside, in_bundle | live | repeatable)
            .in_short_help()
            .of(kForFigures | for_mesh),
        text("figure.spheres", "--spheres", "EXPR", "Draw these atoms as spheres of their van der Waals radii")
            .in(kBeside, in_bundle | live | repeatable)
            .in_short_help()
            .of(kForFigures | for_mesh),
        text("figure.tube", "--tube", "EXPR",
             "Draw the backbone of these atoms as a tube, helices as ribbons, strands as arrows")
            .in(kBeside, in_bundle | live | repeatable)
            .in_short_help()
            .of(kForFigures | for_mesh),
        number("shapes.stick_radius", "--stick-radius", "Å", "Radius of sticks in Å")
            .from(0.001, 10)
            .initially("0.25; 0.15 between balls")
            .in(kBeside, kSeen | live)
            .of(kForFigures | for_mesh),
        number("shapes.tube_radius", "--tube-radius", "Å", "Radius of tubes in Å; ribbons and arrows scale with it")
            .from(0.001, 10)
            .initially("0.3")
            .in(kBeside, kSeen | live)
            .of(kForFigures | for_mesh),
        text("figure.object", "--object", "JSON",
             "Draw one more object with its own colour, opacity, material and cuts, as in a scene file: "
             "'{\"representation\": \"surface\", \"selection\": \"chain B\", \"color\": \"red\"}'. Repeatable")
            .in(kBeside, in_bundle | live | repeatable),

        // Beyond the largest probe every atom neighbours every other; large probes in mouths become more with the
        // inverse of their tolerance.
        number("pockets.large_probe", "--large-probe", "Å",
               "Radius of the probe that rolls over the mouths, in Å; a larger one finds wider, shallower pockets")
            .from(1e-3, 100)
            .initially("4")
            .in(kSurface)
            .of(for_pockets),
        number(
            "pockets.trim", "--trim", "Å",
            "Depth below the large probe's surface at which pockets begin, in Å; more separates neighbours that meet "
            "there")
            .from(0, 100)
            .initially("1")
            .in(kSurface)
            .of(for_pockets),
        number("pockets.min_volume", "--min-volume", "Å³", "Leave out smaller pockets")
            .from(0, 1e9)
            .initially("30: a molecule of water")
            .in(kSurface)
            .in_short_help()
            .of(for_pockets),
        number("pockets.mouth_tolerance", "--mouth-tolerance", "Å",
               "Farthest that a mouth may lie outside its place, in Å; less takes longer")
            .from(1e-3, 1)
            .initially("0.1")
            .in(kSurface)
            .of(for_pockets),
        text("pockets.ligand", "--ligand", "EXPR",
             "Atoms that are taken out first, and whose places are reported; none: leave them in")
            .initially("ligand")
            .in(kSurface)
            .in_short_help()
            .of(for_pockets),
    }));

}  // namespace

std::span<const Property> surface_properties() { return kTable; }

}  // namespace meniscus
