// SPDX-License-Identifier: BSD-3-Clause
// Properties of reports: tables, JSON, curves; and options that belong to a single command.
#include <array>

#include "core/properties/properties.h"

namespace meniscus {
namespace {

constexpr std::string_view kOutput = "Output", kSession = "Session", kPanels = "Picture", kStoryboard = "Film";

constexpr auto kTable = std::to_array<Property>({
    flag("report.json", "--json", "Print JSON instead of a table").in(kOutput, in_short_help),
    new_file("report.csv_atoms", "--csv", "FILE", "Write areas, one row per atom. -: to standard output")
        .in(kOutput, in_short_help),
    flag("report.open_sky", "--open-sky",
         "Add the share of the sky that each atom sees to @csv@, 0 to 1. It is 1 minus ambient occlusion")
        .in(kOutput),
    new_file("report.csv_residues", "--csv-residues", "FILE",
             "Write areas, one row per residue, with its relative accessibility. -: to standard output")
        .in(kOutput, in_short_help),
    new_file("report.csv_series", "--csv-series", "FILE",
             "Write areas, volume and cavities of a run, one row per frame. -: to standard output")
        .in(kOutput, in_short_help),
    new_file("report.csv_cavities", "--csv-cavities", "FILE",
             "Write the cavities of a run, one row per cavity and frame. Columns: number, birth and end, volume, area, "
             "place, residues around; -: to standard output")
        .in(kOutput),
    new_file("report.plot", "--plot", "FILE", "Draw areas and volumes of a run as curves (SVG)").in(kOutput),
    new_file("report.gradients", "--gradients", "FILE",
             "Write derivatives of areas and volumes, one row per atom. They are exact, with respect to the atom's "
             "position; -: to standard output")
        .in(kOutput),
    new_file("report.csv_patches", "--csv-patches", "FILE",
             "Write one row per patch of @patches@. -: to standard output")
        .in(kOutput),
    new_file(
        "report.csv_summary", "--csv-summary", "FILE",
        "Write numbers of many molecules, one row per file. All files given are then molecules. A file that cannot be "
        "computed has a row that says why")
        .in(kOutput),
    flag("report.resume", "--resume",
         "Continue a @csv-summary@ that was stopped. Files that failed or have changed are computed again")
        .in(kOutput),
    text("report.context", "--context", "EXPR", "Report the area of @select@ that these atoms bury").in(kOutput),
    new_file("report.csv_pockets", "--csv", "FILE", "Write one row per pocket. -: to standard output")
        .in(kOutput, in_short_help),
    new_file("report.pocket_mesh", "--mesh", "FILE",
             "Write the pockets as closed meshes, each in its colour. Endings: .ply, .obj, .glb, .3mf, .stl, .off, "
             ".vtp; for frames with # for the number")
        .in(kOutput, in_short_help),
    new_file("report.pocket_figure", "--figure", "FILE",
             "Write a scene that colours the atoms around pockets. For render, export and preview; ligands are sticks")
        .in(kOutput),

    text("preview.serve", "--serve", "[PORT]",
         "Serve the page on this port of 127.0.0.1, and open no browser. PORT: by default any free one; ADDRESS:PORT "
         "listens at another address of this machine, as the port of a container needs")
        .in(kSession, value_optional | in_short_help),
    flag("preview.no_open", "--no-open", "Print the address of the page, and open no browser")
        .in(kSession, in_short_help),
    text("preview.trusted_hosts", "--trust-host", "HOST",
         "Serve the page through the proxy at this host, too. HOST: such as localhost:8888 for JupyterLab; the page "
         "is refused under all other names")
        .in(kSession, repeatable),
    file("preview.token_file", "--token-file", "FILE",
         "Take the token of the page's address from this file. The address then stays; the token has 16 to 128 letters "
         "and digits. Without this option the variable MENISCUS_TOKEN is read")
        .initially("a random one")
        .in(kSession),
    file("preview.commands", "--commands", "FILE", "Run commands from this file first, one JSON object per line")
        .in(kSession),
    new_file("preview.record", "--record", "FILE", "Record all commands in this file, for @commands@").in(kSession),
    new_file("preview.output_folder", "--output-dir", "FOLDER", "Folder for exports").initially(".").in(kSession),

    file("panels.scenes", "PANEL", "", "Pictures of meniscus render, which carry their scenes, or scene files")
        .in(kPanels),
    count("panels.columns", "--columns", "N", "Number of panels in a row")
        .from(1, 100)
        .initially("up to three in one row, else a square")
        .in(kPanels, in_short_help),
    text("panels.gap", "--gap", "LENGTH", "Space between panels: pixels, 3mm or 8pt")
        .from(0, 10000)
        .initially("a fiftieth of the width of a panel")
        .in(kPanels),
    word("panels.letters", "--letters", "WORD", "Letters of panels whose scenes have none: upper, lower or none")
        .one_of("upper|lower|none")
        .initially("upper")
        .in(kPanels, in_short_help),
    flag("panels.one_camera", "--one-camera",
         "Show all panels with the camera of the first. Unless its scene names a camera, nothing of any panel is cut "
         "off")
        .in(kPanels, in_short_help),
    flag("panels.one_scale", "--one-scale", "Colour all panels by one range, from the smallest to the largest number")
        .in(kPanels, in_short_help),

    file(
        "storyboard.scenes", "SCENE", "",
        "Scene files, or pictures of meniscus render, in their order. Or a storyboard file that meniscus preview saved")
        .in(kStoryboard),
    text("storyboard.hold", "--hold", "SECONDS",
         "Time that each scene is shown. One number, or one for each scene, with commas between. A scene with a run of "
         "frames shows each of them once instead")
        .initially("2")
        .in(kStoryboard, in_short_help),
    text("storyboard.transition", "--transition", "SECONDS",
         "Time from each scene to the next. One number, or one for each transition; 0 is a cut")
        .initially("2")
        .in(kStoryboard, in_short_help),
    word("storyboard.to", "--to", "WORD",
         "Output. pictures: a film, or numbered pictures; povray: a folder with a scene for POV-Ray that renders the "
         "film; blender: a folder that Blender imports as scenes and keys")
        .one_of("pictures|povray|blender")
        .initially("pictures")
        .in(kStoryboard, in_short_help),
    word("storyboard.ease", "--ease", "WORD", "Pace of transitions. smooth: starts and ends slowly; even: steady")
        .one_of("smooth|even")
        .initially("smooth")
        .in(kStoryboard, in_short_help),

    file("morph.files", "MOLECULE", "", "Structures of one molecule, or of similar ones, in the order of the path")
        .in("Path"),
    count("morph.steps", "--steps", "N", "Number of steps from each structure to the next")
        .from(1, 100000)
        .initially("50")
        .in("Path", in_short_help),

    count("bench.runs", "--runs", "N", "Number of timed runs; the median is shown")
        .from(1, 1e6)
        .initially("5")
        .in("Options"),
    flag("bench.numbers", "--numbers",
         "Time only what areas and volumes need. Clip planes of pictures and exports are left out")
        .in("Options"),
    flag("bench.baseline", "--baseline", "Also time Sanner's rolling probe (reduced surface, one thread)")
        .in("Options"),
    flag("bench.paper", "--paper", "Time whole frames with ray casting, as in table 1 of the paper").in("Options"),
    new_file("help.man", "--man", "FOLDER", "Write all pages as man pages into this folder").in("Options"),
    flag("help.scene_schema", "--scene-schema", "Print the JSON schema of scene files").in("Options"),
});

}  // namespace

std::span<const Property> report_properties() { return kTable; }

}  // namespace meniscus
