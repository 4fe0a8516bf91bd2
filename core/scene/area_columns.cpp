// SPDX-License-Identifier: BSD-3-Clause
// Adds up the areas of atoms over objects, and columns over groups.
#include "core/scene/area_columns.h"

#include <numeric>

#include "core/surface/atom_areas.h"

namespace meniscus {

double AreaColumn::total_of(const AtomGroup& group) const {
  return std::accumulate(group.atoms.begin(), group.atoms.end(), 0.0,
                         [&](double sum, std::uint32_t a) { return sum + values[a]; });
}

std::vector<AreaColumn> area_totals(const std::vector<SurfaceObject>& objects, SurfaceKind kind) {
  AreaColumn surface{std::string(kind_word(kind)) + "_area", {}, 0.0}, accessible{"sas_area", {}, 0.0};
  for (const SurfaceObject& object : objects) {
    const auto copies = static_cast<double>(object.copies.size());
    surface.total += copies * object.surface.area;
    if (kind == SurfaceKind::ses) accessible.total += copies * accessible_area(object.surface);
  }
  if (kind == SurfaceKind::ses) return {surface, accessible};
  return {surface};
}

std::vector<AreaColumn> area_columns(const Structure& structure, const std::vector<SurfaceObject>& objects,
                                     SurfaceKind kind) {
  AreaColumn surface{std::string(kind_word(kind)) + "_area", std::vector<double>(structure.atoms.size(), 0.0), 0.0};
  AreaColumn accessible{"sas_area", surface.values, 0.0};
  for (const SurfaceObject& object : objects) {
    const AtomAreas areas = atom_areas(object.surface);
    const auto copies = static_cast<double>(object.copies.size());
    for (std::size_t n = 0; n < object.atom.size(); ++n) {
      surface.values[object.atom[n]] += areas.surface[n];
      accessible.values[object.atom[n]] += areas.accessible[n];
      surface.total += copies * areas.surface[n];
      accessible.total += copies * areas.accessible[n];
    }
  }
  if (kind == SurfaceKind::ses) return {surface, accessible};
  return {surface};
}

}  // namespace meniscus
