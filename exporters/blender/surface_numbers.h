// SPDX-License-Identifier: BSD-3-Clause
// Numbers of a surface at its vertices, patches and atoms, for files for Blender.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "exporters/blender/surface_file.h"

namespace meniscus::blender {

/// Which numbers a file should have beside those of atoms that it always has.
struct SurfaceNumbers {
  std::vector<std::string> names;  ///< of vertex_number_kinds()
  /// Each was asked for by its name: what is not available is refused. Otherwise it is left out.
  bool by_name = false;
};

/// The names that "usual" stands for.
inline constexpr std::string_view kUsualSurfaceNumbers =
    "mean_curvature,gaussian_curvature,atom_area,accessible_area,patch_area";

/// Names between commas as parse_vertex_numbers() takes them, "usual" being kUsualSurfaceNumbers. Throws RequestError
/// naming the word that is not one of them.
SurfaceNumbers parse_surface_numbers(std::string_view text);

/// Adds them to an object whose mesh and atoms are there. buried: Å² of each atom of the structure, or empty. Returns
/// what had to be left out and why, as one sentence; empty: nothing. Throws RequestError where curvature is to be
/// averaged over a surface that is there in part, and what atom_areas() throws, if they were asked for by name.
std::string add_surface_numbers(MeshedObject& object, const SurfaceNumbers& wanted, std::span<const double> buried);

}  // namespace meniscus::blender
