// SPDX-License-Identifier: BSD-3-Clause
// Measures a surface at its vertices, patches and atoms, for .mns files.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "exporters/blender/surface_file.h"

namespace meniscus::blender {

/// The requested numbers of a file, in addition to the numbers of atoms that it always has.
struct SurfaceNumbers {
  std::vector<std::string> names;  ///< names of vertex_number_kinds()
  /// True if the user named each number. Numbers that are not available are then an error; otherwise they are left out.
  bool by_name = false;
};

/// The names that "usual" means.
inline constexpr std::string_view kUsualSurfaceNumbers =
    "mean_curvature,gaussian_curvature,atom_area,accessible_area,patch_area";

/// Returns the numbers that a text names, separated by commas as for parse_vertex_numbers(); "usual" means
/// kUsualSurfaceNumbers. Throws RequestError with the word that is no such name.
SurfaceNumbers parse_surface_numbers(std::string_view text);

/// Adds the numbers to an object that has its mesh and its atoms. buried: the buried area of each atom of the structure
/// in Å², or empty. Returns a sentence about numbers that were left out and the reason, or an empty text. If the
/// numbers were named by the user, it throws RequestError for smoothed curvature of a surface that is shown in part,
/// and what atom_areas() throws.
std::string add_surface_numbers(MeshedObject& object, const SurfaceNumbers& requested, std::span<const double> buried);

}  // namespace meniscus::blender
