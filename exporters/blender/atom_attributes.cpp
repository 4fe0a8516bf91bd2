// SPDX-License-Identifier: BSD-3-Clause
// Collects the attributes of atoms; missing B-factors are 0.
#include "exporters/blender/atom_attributes.h"

#include <cmath>
#include <map>
#include <string>

#include "core/structure/hydropathy.h"

namespace meniscus::blender {
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
