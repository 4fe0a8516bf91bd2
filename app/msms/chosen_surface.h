// SPDX-License-Identifier: BSD-3-Clause
// The surface that a command line selects: computed, with the selected components and their meshes.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "app/msms/arguments.h"
#include "app/msms/drop_in.h"
#include "core/mesh/triangle_mesh.h"
#include "core/surface/atom_areas.h"
#include "core/surface/reduced_components.h"
#include "exporters/msms/msms_files.h"

namespace meniscus::msms {

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
  /// Returns the areas of the atoms, for each selected component. Throws CapacityError for more than 2^26 numbers of
  /// each kind.
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
