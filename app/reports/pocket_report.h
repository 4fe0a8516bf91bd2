// SPDX-License-Identifier: BSD-3-Clause
// The pockets of a molecule with the ligands that they contain, and the output of `meniscus pockets`: tables, JSON,
// rows of pockets and of atoms, hints on what to try next, and a scene.
#pragma once

#include "app/reports/csv_tables.h"
#include "core/pockets/pockets.h"
#include "core/queries/cavity_tracks.h"
#include "core/scene/surface_computer.h"
#include "core/structure/structure.h"

namespace meniscus {

/// A residue that was taken out, such as a ligand.
struct LeftOutResidue {
  std::uint32_t first_atom = 0;        ///< place in Structure::atoms
  std::size_t atoms = 0;               ///< number of the residue's atoms
  std::vector<std::size_t> in_pocket;  ///< per pocket: number of the residue's atoms with their centre in it
};

/// The pockets of a structure.
struct MoleculePockets {
  Pockets found;  ///< atoms of cavities and surfaces are places in Structure::atoms
  std::vector<LeftOutResidue> left_out;
  std::size_t atom_count = 0;  ///< number of atoms that the pockets are between
};

/// Finds the pockets of one structure after another on one device.
class PocketComputer {
 public:
  /// computing: the device and threads; the surface is always solvent-excluded, with the probe of `request`.
  PocketComputer(SurfaceRequest computing, const PocketRequest& request);

  /// Returns the pockets of a structure. left_out: one truth value per atom of the structure, true for atoms that are
  /// taken out; empty: none. Throws RequestError if all atoms are left out or the request is invalid (find_pockets),
  /// and OpenSurfaceError, CapacityError or GpuError if a surface cannot be computed.
  MoleculePockets compute(const Structure& structure, const std::vector<bool>& left_out);

  bool is_on_cpu() const { return small_.is_on_cpu(); }
  const std::string& device() const { return small_.device(); }

 private:
  PocketRequest request_;
  SurfaceComputer small_, large_;
};

/// All numbers of a molecule's pockets.
struct PocketReport {
  const Structure& structure;
  const MoleculePockets& pockets;
  const std::string& device;
};

std::string pocket_table(const PocketReport& report);
/// Returns indented JSON that ends with a line feed.
std::string pocket_json(const PocketReport& report);
/// Returns the same object in one line that begins with "frame" and "time" (null if unknown).
std::string pocket_json_line(const PocketReport& report, const FrameNote& note);

/// Returns rank,kind,volume,excess,area,wall_area,mouth_area,mouths,mouth_areas,depth,x,y,z,atoms,residues,left_out.
/// `excess`: Å³, the largest possible error of the volume, which is never too small; mouth_areas: separated by
/// semicolons; left_out: residues that were left out with at least half of their atoms in the pocket.
std::string pocket_csv_header();
std::string pocket_csv_rows(const PocketReport& report);

/// Returns frame,time,pocket,event,other and the columns above. A pocket keeps its number as cavities do
/// (cavity_tracks.h); one that has vanished has one last row.
std::string pocket_series_header();
std::string pocket_series_rows(const PocketReport& report, const FrameNote& note, const std::vector<CavityStep>& steps);

/// Returns the header of the table of a run; the next function returns a row.
std::string pocket_row_header();
std::string pocket_row(const PocketReport& report, const FrameNote& note);

/// Returns sentences with hints on what to try next, possibly none.
std::vector<std::string> pocket_hints(const PocketReport& report);

/// Returns a scene that shows the pockets. scene: that of the command that found the pockets (scene_text()). left_out:
/// the expression for the atoms that were left out. Atoms that line several pockets have the colour of the first one;
/// after the 21st pocket colours repeat.
std::string pocket_figure(const PocketReport& report, const std::string& scene, const std::string& left_out);

}  // namespace meniscus
