// SPDX-License-Identifier: BSD-3-Clause
// Comma-separated values: of atoms and residues, of what changes from frame to frame, and a table that grows with a
// run.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/base/output_file.h"
#include "core/queries/cavity_tracks.h"
#include "core/queries/surface_object.h"
#include "core/scene/area_columns.h"
#include "core/scene/gradient_columns.h"
#include "core/scene/molecule.h"
#include "core/structure/structure.h"

namespace meniscus {

/// Which frame of a trajectory it is, and its time in ps if that is known.
struct FrameNote {
  std::uint64_t frame = 0;
  std::optional<double> time;
};

/// A row for each atom used, in file order: index,model,chain,residue,number,icode,name,element,class,radius and the
/// columns. `index` is the place in the file, from 0; radius in Å, areas in Å². RFC 4180 with plain line feeds: text
/// with a comma or a quote is in quotes; control characters are escaped. Each row begins with `prefix`.
std::string atom_csv_header(const std::vector<AreaColumn>& columns);
std::string atom_csv_rows(const Structure& structure, const std::vector<AreaColumn>& columns,
                          const std::string& prefix = "");

/// A row for each residue: model,chain,residue,number,icode,class,atoms and the columns, added up; behind them, for
/// accessible areas by a probe of kAccessibilityProbe, these over the greatest, empty where relative_accessibility()
/// has none: relative_sas_area, ...
std::string residue_csv_header(const std::vector<AreaColumn>& columns, double probe_radius);
std::string residue_csv_rows(const Structure& structure, const std::vector<AreaColumn>& columns, double probe_radius,
                             const std::string& prefix = "");

/// A row for each atom as above, with three columns for each gradient: area_dx,area_dy,area_dz.
std::string gradient_csv_header(const std::vector<GradientColumn>& gradients);
std::string gradient_csv_rows(const Structure& structure, const std::vector<GradientColumn>& gradients,
                              const std::string& prefix = "");

/// A text as such tables have it.
std::string csv_cell(const std::string& text);

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

/// On standard output, at once. Throws OutputError.
void print_now(const std::string& text);

class GrowingTable {
 public:
  /// path: empty: it is not wanted; "-": standard output. Throws OutputError.
  GrowingTable(const std::string& path, Existing existing);

  bool is_wanted() const { return prints_ || file_; }
  /// The header goes before the first rows.
  void write(const std::string& header, const std::string& rows);
  /// Names the file, if anything was written.
  void commit();

 private:
  bool prints_, has_header_ = false;
  std::optional<OutputFile> file_;
};

}  // namespace meniscus
