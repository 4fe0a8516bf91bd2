// SPDX-License-Identifier: BSD-3-Clause
// Looks radii up by name, from the exact one to the general.
#include "core/structure/radii/radii_file.h"

#include <cctype>
#include <utility>

#include "core/structure/residue_names.h"
#include "core/structure/structure.h"

namespace meniscus {
namespace {

std::string key(const std::string& residue, const std::string& atom) { return residue + ' ' + atom; }

bool is_hydrogen_name(const std::string& name) {
  const std::size_t letter = name.find_first_not_of("0123456789");
  return letter != std::string::npos && name[letter] == 'H';
}

}  // namespace

void RadiiTable::add(const std::string& residue, const std::string& atom, const Entry& entry) {
  names_[key(residue, atom)] = entry;
  const std::string canonical = canonical_residue(residue);
  names_.try_emplace(key(canonical, canonical_atom(canonical, atom)), entry);
  has_hydrogens_ = has_hydrogens_ || is_hydrogen_name(atom);
}

void RadiiTable::add(NamePattern residue, NamePattern atom, const Entry& entry) {
  has_hydrogens_ = has_hydrogens_ || atom.matches_hydrogen();
  patterns_.push_back({std::move(residue), std::move(atom), entry});
}

const RadiiTable::Entry* RadiiTable::find_named(const std::string& residue, const std::string& atom) const {
  const std::string canonical = canonical_residue(residue);
  const std::string canonical_name = canonical_atom(canonical, atom);
  // AMBER names the residues at the ends of a chain NALA and CALA.
  for (const std::string& name : {key(residue, atom), key(canonical, canonical_name), key("*", atom),
                                  key("*", canonical_name), key('N' + canonical, atom), key('C' + canonical, atom)}) {
    const auto found = names_.find(name);
    if (found != names_.end()) return &found->second;
  }
  return nullptr;
}

std::optional<FoundRadius> RadiiTable::find(const Atom& atom, bool hydrogens_used) const {
  const Entry* entry = find_named(atom.residue_name, atom.name);
  if (!entry && is_hydrogen_name(atom.name) && std::isdigit(static_cast<unsigned char>(atom.name.back()))) {
    std::string other = atom.name;
    for (const char digit : {'1', '2', '3'}) {
      other.back() = digit;
      if (!entry) entry = find_named(atom.residue_name, other);
    }
  }
  for (const Rule& rule : patterns_) {
    if (entry) break;
    if (rule.residue.matches(atom.residue_name) && rule.atom.matches(atom.name)) entry = &rule.entry;
  }
  if (!entry) return std::nullopt;
  return FoundRadius{hydrogens_used ? entry->with_hydrogens : entry->united, entry->label, source_};
}

}  // namespace meniscus
