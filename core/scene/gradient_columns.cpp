// SPDX-License-Identifier: BSD-3-Clause
// Adds up gradients over objects.
#include "core/scene/gradient_columns.h"

#include <utility>

#include "core/base/error.h"
#include "core/base/message.h"

namespace meniscus {

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
