// SPDX-License-Identifier: BSD-3-Clause
// The output of `meniscus pockets`: tables, JSON, rows of pockets and of atoms, hints on what to try next, and a scene.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "app/reports/csv_tables.h"
#include "core/queries/cavity_tracks.h"
#include "core/scene/molecule_pockets.h"
#include "core/structure/structure.h"

namespace meniscus {

/// All numbers of a molecule's pockets.
struct PocketReport {
  const Structure& structure;
  const MoleculePockets& pockets;
  const std::string& device;
};

std::string pocket_table(const PocketReport& report);
/// Indented, ends with a line feed.
std::string pocket_json(const PocketReport& report);
/// The same object in one line that begins with "frame" and "time" (null if unknown).
std::string pocket_json_line(const PocketReport& report, const FrameNote& note);

/// rank,kind,volume,excess,area,wall_area,mouth_area,mouths,mouth_areas,depth,x,y,z,atoms,residues,left_out. `excess`:
/// Å³, by how much the volume may be too large; mouth_areas: with semicolons between; left_out: residues that were
/// taken out with at least half of their atoms here.
std::string pocket_csv_header();
std::string pocket_csv_rows(const PocketReport& report);

/// frame,time,pocket,event,other and the columns above, where a pocket keeps its number as cavities do
/// (cavity_tracks.h). One that is gone has one last row.
std::string pocket_series_header();
std::string pocket_series_rows(const PocketReport& report, const FrameNote& note, const std::vector<CavityStep>& steps);

/// A line of the table of a run, and the line above all of them.
std::string pocket_row_header();
std::string pocket_row(const PocketReport& report, const FrameNote& note);

/// Sentences that say what to try next; none where there is nothing to say.
std::vector<std::string> pocket_hints(const PocketReport& report);

/// scene: of the command that found the pockets (scene_text()). left_out: the expression by which atoms were taken out.
/// Atoms that line several pockets have the colour of the first; later than the 21st colours begin again.
std::string pocket_figure(const PocketReport& report, const std::string& scene, const std::string& left_out);

}  // namespace meniscus
