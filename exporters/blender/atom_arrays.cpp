// SPDX-License-Identifier: BSD-3-Clause
// Collects the balls, colours and attributes of atoms as arrays.
#include "exporters/blender/atom_arrays.h"

#include <cmath>
#include <map>
#include <span>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/structure/element_tables.h"

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

namespace {

/// Blender has no number for one that is missing.
void push_known(std::vector<float>& numbers, double number, bool& any) {
  any = any || std::isfinite(number);
  numbers.push_back(std::isfinite(number) ? static_cast<float>(number) : 0.0f);
}

/// Numbers names in the order in which they come, so that each is stored once.
class Names {
 public:
  explicit Names(std::vector<std::string>& names) : names_(names) {}

  std::int32_t number(const std::string& name) {
    const auto [at, fresh] = numbers_.try_emplace(name, static_cast<std::int32_t>(names_.size()));
    if (fresh) names_.push_back(name);
    return at->second;
  }
  /// Whether any is more than the one of formats that know none.
  bool are_known() const { return names_.size() > 1 || (names_.size() == 1 && !names_.front().empty()); }

 private:
  std::vector<std::string>& names_;
  std::map<std::string, std::int32_t> numbers_;
};

}  // namespace

AtomAttributes atom_attributes(const Structure& structure, const std::vector<std::uint32_t>& atoms) {
  AtomAttributes attributes;
  Names chains(attributes.chain_names), names(attributes.atom_names), residues(attributes.residue_names);
  bool charges = false, hydropathies = false, entities = false;
  for (const std::uint32_t index : atoms) {
    const Atom& atom = structure.atoms[index];
    attributes.file_index.push_back(atom.index);
    attributes.b_factor.push_back(std::isfinite(atom.b_factor) ? atom.b_factor : 0.0f);
    push_known(attributes.charge, atom.charge, charges);
    push_known(attributes.hydrophobicity, hydropathy(atom.residue_name), hydropathies);
    attributes.atomic_number.push_back(atom.element);
    attributes.residue_number.push_back(atom.residue_number);
    entities = entities || atom.kind != AtomClass::unclassified;
    attributes.entity.push_back(static_cast<std::int32_t>(atom.kind));
    attributes.chain.push_back(chains.number(atom.chain));
    attributes.name.push_back(names.number(atom.name));
    attributes.residue_name.push_back(residues.number(atom.residue_name));
  }
  if (!charges) attributes.charge.clear();
  if (!hydropathies) attributes.hydrophobicity.clear();
  if (!entities) attributes.entity.clear();
  if (!names.are_known()) attributes.name.clear();
  if (!residues.are_known()) attributes.residue_name.clear();
  return attributes;
}

}  // namespace meniscus::blender
