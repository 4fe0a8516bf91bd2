// SPDX-License-Identifier: BSD-3-Clause
// What a configuration file of NanoShaper asks for, as far as it concerns the mesh of a solvent-excluded surface.
#pragma once

#include <string>
#include <vector>

namespace meniscus::msms {

struct ShaperSettings {
  std::string spheres;            ///< XYZR_FileName
  double probe_radius = 1.4;      ///< Probe_Radius, Å
  double grid_scale = 2.0;        ///< Grid_scale: points of its grid per Å
  bool fill_cavities = false;     ///< Cavity_Detection_Filling: small cavities are left out
  double smallest_cavity = 11.4;  ///< Conditional_Volume_Filling_Value, Å³: of those that stay
  std::string root;               ///< Root_FileName: what names of files begin with
  bool msms_files = true;         ///< .vert and .face: unless Save_Mesh_MSMS_Format is false
  bool off_file = true;           ///< .off: unless Save_Mesh_MSMS_Format is true
  std::vector<std::string> unknown_keys;
};

/// Vertices per Å² of a mesh that meets each line of a cubic grid once: such lines of one direction cross a surface at
/// scale² |n| points per Å², n the normal's component along them, whose mean over the sphere is 1/2; three directions.
constexpr double shaper_density(double grid_scale) { return 1.5 * grid_scale * grid_scale; }

/// Lines "key = value"; blank lines and lines that begin with # or % are passed over. Each key of NanoShaper is read,
/// refused where its value would change the mesh or its files in a way that there is not here, or known to change
/// neither; others are listed. Throws InputError, with file and line: no such form, a value that is none or refused, no
/// XYZR_FileName.
ShaperSettings read_shaper_settings(const std::string& path);

}  // namespace meniscus::msms
