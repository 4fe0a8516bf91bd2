// SPDX-License-Identifier: BSD-3-Clause
// Properties of reports: tables, JSON, curves; and options that belong to a single command.
#include <array>

#include "core/properties/tables.h"

namespace meniscus {
namespace {

constexpr std::string_view kOutput = "Output", kSession = "Session";

constexpr auto kTable = std::to_array<Property>({
    flag("report.json", "--json", "Print one JSON object instead of a table").in(kOutput).in_short_help(),
    new_file("report.csv_atoms", "--csv", "FILE",
             "Write areas of atoms, a row each; -: to standard output, and nothing else there")
        .in(kOutput)
        .in_short_help(),
    new_file("report.csv_residues", "--csv-residues", "FILE", "Write areas of residues, a row each; - as above")
        .in(kOutput)
        .in_short_help(),
    new_file("report.csv_series", "--csv-series", "FILE",
             "Write areas, volume and cavities of a run, a row a frame; - as above")
        .in(kOutput)
        .in_short_help(),
    new_file("report.csv_cavities", "--csv-cavities", "FILE",
             "Write the cavities of each frame of a run, a row each: number, birth and end, volume, area, place, "
             "residues around; - as above")
        .in(kOutput),
    new_file("report.plot", "--plot", "FILE", "Draw areas and volumes of a run as curves over time, as SVG")
        .in(kOutput),
    new_file("report.gradients", "--gradients", "FILE",
             "Write the exact derivatives of areas and volumes with respect to positions of atoms, a row each; - as "
             "above")
        .in(kOutput),
    text("report.context", "--context", "EXPR",
         "Also report the areas of --select in the presence of these atoms, and the difference: what is buried")
        .in(kOutput),
    new_file("report.csv_pockets", "--csv", "FILE",
             "Write pockets, a row each; -: to standard output, and nothing else there")
        .in(kOutput)
        .in_short_help(),
    new_file("report.pocket_mesh", "--mesh", "FILE",
             "Write the pockets as closed meshes, each in its colour: PLY, OBJ, GLB, 3MF, STL, OFF or VTP by the "
             "file's ending; of a run with # for the number")
        .in(kOutput)
        .in_short_help(),
    new_file(
        "report.pocket_figure", "--figure", "FILE",
        "Write a scene for render, export and preview: atoms around pockets in colours, ligands as sticks; likewise")
        .in(kOutput),

    text("preview.serve", "--serve", "[PORT]",
         "Open no window; serve a page for browsers on 127.0.0.1, at this port or at any free one")
        .in(kSession, live | value_optional)
        .in_short_help(),
    file("preview.commands", "--commands", "FILE", "Run these commands first, one JSON object a line")
        .in(kSession, live),
    new_file("preview.record", "--record", "FILE", "Write every command to this file, for --commands")
        .in(kSession, live),
    new_file("preview.output_folder", "--output-dir", "FOLDER", "Folder of exports").initially(".").in(kSession, live),

    count("bench.runs", "--runs", "N", "Timed runs of each; the median is shown")
        .from(1, 1e6)
        .initially("5")
        .in("Options"),
    flag("bench.numbers", "--numbers",
         "Compute only what areas and volumes need, without the clip planes of pictures and exports")
        .in("Options"),
    flag("bench.baseline", "--baseline",
         "Also time Sanner's sequential rolling probe (reduced surface alone, one thread)")
        .in("Options"),
    flag("bench.paper", "--paper",
         "Time whole frames instead, ray casting included, as in table 1 of the paper: complete and visible")
        .in("Options"),
    new_file("help.man", "--man", "FOLDER", "Write all pages as manual pages into this folder").in("Options"),
    flag("help.scene_schema", "--scene-schema", "Print the JSON schema of scene files").in("Options"),
});

}  // namespace

std::span<const Property> report_properties() { return kTable; }

}  // namespace meniscus
