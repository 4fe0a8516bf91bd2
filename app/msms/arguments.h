// SPDX-License-Identifier: BSD-3-Clause
// The command line of MSMS, and the surface that it selects.
#pragma once

#include <optional>

#include "app/msms/drop_in.h"
#include "core/mesh/triangle_mesh.h"
#include "core/surface/measure.h"
#include "core/surface/reduced_components.h"
#include "exporters/msms/msms_files.h"

namespace meniscus::msms {

/// The values of the options. Options without an effect here are accepted and ignored (help_text() lists them).
struct Arguments {
  bool help = false;
  std::string spheres;        ///< -if; empty: none
  std::string mesh_files;     ///< -of: .vert and .face are appended; empty: none
  std::string area_file;      ///< -af: .area is appended unless it is there; empty: none
  double probe_radius = 1.5;  ///< Å
  double density = 1.0;       ///< vertices per Å²
  double hdensity = 3.0;      ///< printed, but not used: a face has one density
  bool area = true;           ///< true if the analytic table is requested
  bool mesh = true;           ///< -surface tses; false: ases
  bool header = true;         ///< true for three lines above the rows of .vert and .face
  bool hydrogens = true;      ///< false: spheres of radius 1.2 are left out
  bool all_components = false;
  std::vector<std::uint32_t> cavity_atoms;  ///< -one_cavity: one to three sphere numbers from 0; empty: not set
  std::optional<std::uint16_t> port;        ///< -socketPort
};

/// Returns true for radii within the limits of -probe_radius; the next function does so for -density. NaN is rejected.
bool is_probe_radius(double radius);
bool is_density(double density);

/// Parses the words after the program's name. Blanks around a word are ignored. Throws UsageError for an unknown
/// option, a missing value, a value that is not a number in its range, and a word that belongs to no option.
Arguments parse_arguments(std::span<const char* const> words);

/// Returns the text that -h prints.
std::string help_text();

class ChosenSurface {
 public:
  /// Computes the surface on the CPU. Throws OpenSurfaceError, CapacityError, and InputError if no component touches
  /// the spheres that -one_cavity names.
  ChosenSurface(const Arguments& arguments, const Spheres& spheres);

  ChosenSurface(const ChosenSurface&) = delete;
  ChosenSurface& operator=(const ChosenSurface&) = delete;

  std::size_t component_count() const { return chosen_.size(); }
  /// Returns the size of each selected component.
  std::vector<ReducedComponentSize> sizes() const;
  /// Returns the areas of atoms for each selected component. Throws CapacityError for more than 2^26 numbers.
  std::vector<AtomAreas> areas() const;
  /// Triangulates the components; must be called before mesh(). Throws OpenSurfaceError.
  void triangulate();
  /// Returns the mesh of the n-th selected component.
  MsmsMesh mesh(std::size_t n);

 private:
  std::uint32_t component_touching(const std::vector<std::uint32_t>& numbers, const Spheres& spheres) const;

  double density_;
  ComponentSurface computed_;
  std::vector<std::uint32_t> chosen_;
  TriangleMesh mesh_;
  std::optional<MsmsMeshes> numbered_;
};

}  // namespace meniscus::msms
