// SPDX-License-Identifier: BSD-3-Clause
// What changes from frame to frame as comma-separated values: areas, volumes, cavities.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "app/reports/surface_report.h"
#include "core/queries/cavity_tracks.h"
#include "core/queries/surface_object.h"
#include "core/scene/area_columns.h"
#include "core/scene/molecule.h"

namespace meniscus {

/// What rows of a frame begin with: its number in the trajectory, and its time in ps or nothing.
inline constexpr const char* kFrameColumns = "frame,time";
std::string frame_cells(const FrameNote& note);

/// A number of a frame.
struct SeriesValue {
  std::string name;  ///< a word of ours
  const char* unit;  ///< "Å²" or "Å³"; empty: it is a count
  double value;
};

/// The columns' totals, the volume of the solid, how many closed parts it has and how many of them are cavities, and
/// these cavities' area and volume, positive.
std::vector<SeriesValue> series_values(const Molecule& molecule, const std::vector<AreaColumn>& columns);

/// frame,time and the names of the values; the values.
std::string series_csv_header(const std::vector<SeriesValue>& values);
std::string series_csv_row(const std::vector<SeriesValue>& values, const FrameNote& note);

/// The residues of these atoms of the structure, in any order: "A:LEU:12 A:PHE:30B", in the order of the file;
/// ":LEU:12" where it names no chains.
std::string residues_of(const Structure& structure, std::vector<std::uint32_t> atoms);
/// Those whose atoms line a cavity of the object.
std::string lining_residues(const Structure& structure, const SurfaceObject& object, const Cavity& cavity);

/// frame,time,cavity,event,other,volume,area,x,y,z,atoms,residues. `event`: born, kept, split (off `other`), merged
/// (into `other`), closed; a cavity that is gone has one last row without a volume. x, y, z: the mean of the places
/// where probes rest in it.
std::string cavity_csv_header();
std::string cavity_csv_row(const FrameNote& note, const CavityStep& step, const Cavity* cavity,
                           const std::string& lining);

}  // namespace meniscus
