// SPDX-License-Identifier: BSD-3-Clause
// Sums areas and gradients by the atoms of a file.
#include "core/scene/area_columns.h"

#include <numeric>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/surface/measure.h"

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

std::vector<AreaColumn> area_sums(const Structure& structure, const std::vector<SurfaceObject>& objects,
                                  SurfaceKind kind, std::span<const AtomGroup> groups) {
  const std::vector<double> none(groups.size(), 0.0);
  AreaColumn surface{std::string(kind_word(kind)) + "_area", {}, 0.0, none}, accessible{"sas_area", {}, 0.0, none};
  std::vector<std::uint32_t> group_of(structure.atoms.size(), 0);
  for (std::uint32_t g = 0; g < groups.size(); ++g)
    for (const std::uint32_t atom : groups[g].atoms) group_of[atom] = g;
  for (const SurfaceObject& object : objects) {
    std::vector<std::uint32_t> groups_here(object.atom.size());
    std::ranges::transform(object.atom, groups_here.begin(), [&](std::uint32_t atom) { return group_of[atom]; });
    const AtomAreas areas = group_areas(object.surface, groups_here, static_cast<std::uint32_t>(groups.size()));
    const auto copies = static_cast<double>(object.copies.size());
    surface.total += copies * object.surface.area;
    for (std::size_t g = 0; g < groups.size(); ++g) {
      surface.sums[g] += areas.surface[g];
      accessible.sums[g] += areas.accessible[g];
      accessible.total += copies * areas.accessible[g];
    }
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

namespace {

void refuse_ties(const Structure& structure, const std::vector<SurfaceObject>& objects) {
  for (const SurfaceObject& object : objects) {
    std::string names;
    for (const std::uint32_t a : tied_atoms(object.surface))
      names += (names.empty() ? "" : ", ") + label_of(structure.atoms[object.atom[a]]);
    if (names.empty()) continue;
    throw InputError(structure.file, 0,
                     message("one probe touches more than three atoms at once ({}), so the surface has no derivatives "
                             "there; move one atom slightly, or choose @surface sas@",
                             names));
  }
}

}  // namespace

std::vector<GradientColumn> gradient_columns(const Structure& structure, const std::vector<SurfaceObject>& objects,
                                             SurfaceKind kind) {
  std::vector<GradientColumn> columns;
  const auto add = [&](std::string name, auto&& gradient_of) {
    GradientColumn column{std::move(name), Gradient(structure.atoms.size(), glm::dvec3(0.0))};
    for (const SurfaceObject& object : objects) {
      const Gradient gradient = gradient_of(object.surface);
      for (std::size_t a = 0; a < gradient.size(); ++a) column.values[object.atom[a]] += gradient[a];
    }
    columns.push_back(std::move(column));
  };
  if (kind == SurfaceKind::ses) refuse_ties(structure, objects);
  const std::string word = kind_word(kind);
  add(word + "_area", area_gradient);
  add(word + "_volume", volume_gradient);
  if (kind != SurfaceKind::ses) return columns;
  add("sas_area", [](const Surface& surface) { return accessible_area_gradient(surface); });
  add("sas_volume", accessible_volume_gradient);
  return columns;
}

}  // namespace meniscus
