// SPDX-License-Identifier: BSD-3-Clause
// Turns atoms into columns.
#include "exporters/blender/atom_arrays.h"

#include <span>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace meniscus::blender {
namespace {

template <class T>
void add_known(MnsWriter& file, const std::string& name, const std::vector<T>& values) {
  if (!values.empty()) file.add(name, std::span(values));
}

}  // namespace

void add_atoms(MnsWriter& file, const SurfaceObject& object, const AtomAttributes& atoms) {
  std::vector<double> center, radius;
  std::vector<float> color;
  for (const Ball& ball : object.surface.atoms) {
    center.insert(center.end(), {ball.center.x, ball.center.y, ball.center.z});
    radius.push_back(ball.radius);
  }
  for (const glm::vec3& c : object.coloring.atom) color.insert(color.end(), {c.x, c.y, c.z});
  file.add("atom.center", std::span<const double>(center), 3);
  file.add("atom.radius", std::span<const double>(radius));
  file.add("atom.color", std::span<const float>(color), 3);
  file.add("atom.index", std::span(object.atom));
  add_known(file, "atom.file_index", atoms.file_index);
  if (object.coloring.is_translucent()) file.add("atom.opacity", std::span(object.coloring.opacity));
  add_known(file, "atom.b_factor", atoms.b_factor);
  add_known(file, "atom.charge", atoms.charge);
  add_known(file, "atom.hydrophobicity", atoms.hydrophobicity);
  add_known(file, "atom.atomic_number", atoms.atomic_number);
  add_known(file, "atom.res_id", atoms.residue_number);
  add_known(file, "atom.chain_id", atoms.chain);
  add_known(file, "atom.name_id", atoms.name);
  add_known(file, "atom.residue_name_id", atoms.residue_name);
  add_known(file, "atom.entity", atoms.entity);
  add_known(file, "atom.area", atoms.area);
  add_known(file, "atom.accessible_area", atoms.accessible_area);
  add_known(file, "atom.buried_area", atoms.buried_area);
}

void add_names(nlohmann::json& header, const AtomAttributes& atoms) {
  header["chain_names"] = atoms.chain_names;
  if (!atoms.name.empty()) header["atom_names"] = atoms.atom_names;
  if (!atoms.residue_name.empty()) header["residue_names"] = atoms.residue_names;
}

}  // namespace meniscus::blender
