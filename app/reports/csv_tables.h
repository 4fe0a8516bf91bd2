// SPDX-License-Identifier: BSD-3-Clause
// Comma-separated values: tables of atoms and residues, series over frames, and a table that grows with a run.
#pragma once

#include "core/base/output_file.h"
#include "core/queries/cavity_tracks.h"
#include "core/queries/surface_object.h"
#include "core/scene/molecule.h"
#include "core/structure/structure.h"

namespace meniscus {

/// The number of a frame in its trajectory, and its time in ps if it is known.
struct FrameNote {
  std::uint64_t frame = 0;
  std::optional<double> time;
};

/// Returns the header of a table with a row for each atom used, in file order:
/// index,model,chain,residue,number,icode,name,element,class,radius and the columns. `index` is the index in the file,
/// from 0; radius in Å, areas in Å². The format is RFC 4180 with plain line feeds: text with a comma or a quote is in
/// quotes; control characters are escaped. Each row begins with `prefix`.
std::string atom_csv_header(const std::vector<AreaColumn>& columns);
std::string atom_csv_rows(const Structure& structure, const std::vector<AreaColumn>& columns,
                          const std::string& prefix = "");

/// Returns the header of a table with a row for each residue: model,chain,residue,number,icode,class,atoms and the sums
/// of the columns. For accessible areas by a probe of kAccessibilityProbe there follow the areas relative to the
/// largest ones, empty where relative_accessibility() has none: relative_sas_area, ...
std::string residue_csv_header(const std::vector<AreaColumn>& columns, double probe_radius);
std::string residue_csv_rows(const Structure& structure, const std::vector<AreaColumn>& columns, double probe_radius,
                             const std::string& prefix = "");

/// Returns the header of a table with the atoms' rows and three columns per gradient: area_dx,area_dy,area_dz.
std::string gradient_csv_header(const std::vector<GradientColumn>& gradients);
std::string gradient_csv_rows(const Structure& structure, const std::vector<GradientColumn>& gradients,
                              const std::string& prefix = "");

/// Quotes a text for these tables.
std::string csv_cell(const std::string& text);

/// The first columns of a frame's rows: its number in the trajectory, and its time in ps or nothing.
inline constexpr const char* kFrameColumns = "frame,time";
std::string frame_cells(const FrameNote& note);

/// A number that belongs to a frame.
struct SeriesValue {
  std::string name;  ///< a word of this program
  const char* unit;  ///< "Å²" or "Å³"; empty for counts
  double value;
};

/// Returns the totals of the columns, the volume of the solid, the number of closed parts and of cavities, and the area
/// and the volume of the cavities, positive.
std::vector<SeriesValue> series_values(const Molecule& molecule, const std::vector<AreaColumn>& columns);

/// Returns frame,time and the names of the values; the next function returns the values.
std::string series_csv_header(const std::vector<SeriesValue>& values);
std::string series_csv_row(const std::vector<SeriesValue>& values, const FrameNote& note);

/// Returns the residues of these atoms of the structure, which come in any order: "A:LEU:12 A:PHE:30B", in the order of
/// the file; ":LEU:12" if it has no chain names.
std::string residues_of(const Structure& structure, std::vector<std::uint32_t> atoms);
/// Returns the residues with atoms that line a cavity of the object.
std::string lining_residues(const Structure& structure, const SurfaceObject& object, const Cavity& cavity);

/// Returns frame,time,cavity,event,other,volume,area,x,y,z,atoms,residues. `event`: born, kept, split (off `other`),
/// merged (into `other`), closed; a cavity that has vanished has one last row without a volume. x, y, z: the mean of
/// the positions of probes at rest in it.
std::string cavity_csv_header();
std::string cavity_csv_row(const FrameNote& note, const CavityStep& step, const Cavity* cavity,
                           const std::string& lining);

/// Prints the text on standard output at once. Throws OutputError.
void print_now(const std::string& text);

class GrowingTable {
 public:
  /// path: empty: no table is written; "-": standard output. Throws OutputError.
  GrowingTable(const std::string& path, Existing existing);

  bool is_wanted() const { return prints_ || file_; }
  /// Writes rows, with the header before the first rows.
  void write(const std::string& header, const std::string& rows);
  /// Gives the file its name, if anything was written.
  void commit();

 private:
  bool prints_, has_header_ = false;
  std::optional<OutputFile> file_;
};

}  // namespace meniscus
