// SPDX-License-Identifier: BSD-3-Clause
// Turns atoms into columns.
#include "exporters/blender/atom_arrays.h"

#include <span>
#include <vector>

namespace meniscus::blender {

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
  if (!atoms.file_index.empty()) file.add("atom.file_index", std::span(atoms.file_index));
  if (object.coloring.is_translucent()) file.add("atom.opacity", std::span(object.coloring.opacity));
  if (!atoms.b_factor.empty()) file.add("atom.b_factor", std::span(atoms.b_factor));
  if (!atoms.charge.empty()) file.add("atom.charge", std::span(atoms.charge));
  if (!atoms.hydrophobicity.empty()) file.add("atom.hydrophobicity", std::span(atoms.hydrophobicity));
  if (!atoms.atomic_number.empty()) file.add("atom.atomic_number", std::span(atoms.atomic_number));
  if (!atoms.residue_number.empty()) file.add("atom.res_id", std::span(atoms.residue_number));
  if (!atoms.chain.empty()) file.add("atom.chain_id", std::span(atoms.chain));
}

}  // namespace meniscus::blender
