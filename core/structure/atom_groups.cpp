// SPDX-License-Identifier: BSD-3-Clause
// Sorts atoms into groups by a key, keeping the order of the file.
#include "core/structure/atom_groups.h"
#include "core/structure/structure.h"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

#include <fmt/format.h>

namespace meniscus {
namespace {

// What atoms of one group have in common: a number, a second one, a text.
using Key = std::tuple<std::int64_t, std::string>;

Key key_of(const Atom& atom, Grouping by) {
  switch (by) {
    case Grouping::chain:
      return {atom.model, atom.chain};
    case Grouping::model:
      return {atom.model, {}};
    case Grouping::atom_class:
      return {static_cast<std::int64_t>(atom.kind), {}};
    case Grouping::residue:
      return {atom.residue, {}};
  }
  return {};
}

std::string chain_name(const Atom& atom, bool several_models) {
  return (atom.chain.empty() || atom.chain == " " ? std::string("unnamed chain") : "chain " + atom.chain) +
         (several_models ? fmt::format(" of model {}", atom.model) : "");
}

std::string residue_name(const Atom& atom, bool several_models) {
  const std::string code = atom.insertion_code == ' ' ? "" : std::string(1, atom.insertion_code);
  return fmt::format("{} {}{} {}", chain_name(atom, several_models), atom.residue_number, code, atom.residue_name);
}

std::string name_of(const Atom& atom, Grouping by, bool several_models) {
  switch (by) {
    case Grouping::chain:
      return chain_name(atom, several_models);
    case Grouping::model:
      return fmt::format("model {}", atom.model);
    case Grouping::atom_class:
      return class_name(atom.kind);
    case Grouping::residue:
      return residue_name(atom, several_models);
  }
  return {};
}

}  // namespace

std::vector<AtomGroup> group_atoms(const Structure& structure, Grouping by) {
  const auto& atoms = structure.atoms;
  const bool several_models =
      std::any_of(atoms.begin(), atoms.end(), [&](const Atom& atom) { return atom.model != atoms.front().model; });
  std::vector<AtomGroup> groups;
  std::map<Key, std::size_t> known;
  for (std::uint32_t a = 0; a < atoms.size(); ++a) {
    const auto [at, fresh] = known.try_emplace(key_of(atoms[a], by), groups.size());
    if (fresh) groups.push_back({name_of(atoms[a], by, several_models), {}});
    groups[at->second].atoms.push_back(a);
  }
  return groups;
}

std::string atom_place(const Atom& atom) {
  if (atom.name.empty()) return fmt::format("atom {}", atom.index + 1);
  return fmt::format("{} {}", residue_name(atom, atom.model != 1), atom.name);
}

}  // namespace meniscus
