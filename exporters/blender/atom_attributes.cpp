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

}  // namespace

AtomAttributes atom_attributes(const Structure& structure, const std::vector<std::uint32_t>& atoms) {
  AtomAttributes attributes;
  std::map<std::string, std::int32_t> chains;
  bool charges = false, hydropathies = false;
  for (const std::uint32_t index : atoms) {
    const Atom& atom = structure.atoms[index];
    attributes.file_index.push_back(atom.index);
    attributes.b_factor.push_back(std::isfinite(atom.b_factor) ? atom.b_factor : 0.0f);
    push_known(attributes.charge, atom.charge, charges);
    push_known(attributes.hydrophobicity, hydropathy(atom.residue_name), hydropathies);
    attributes.atomic_number.push_back(atom.element);
    attributes.residue_number.push_back(atom.residue_number);
    const auto [at, fresh] = chains.try_emplace(atom.chain, static_cast<std::int32_t>(chains.size()));
    if (fresh) attributes.chain_names.push_back(atom.chain);
    attributes.chain.push_back(at->second);
  }
  if (!charges) attributes.charge.clear();
  if (!hydropathies) attributes.hydrophobicity.clear();
  return attributes;
}

}  // namespace meniscus::blender
