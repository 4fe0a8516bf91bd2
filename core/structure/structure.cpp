// SPDX-License-Identifier: BSD-3-Clause
// Describes what happened to the atoms of a file, and groups atoms.
#include "core/structure/structure.h"

#include <functional>
#include <set>
#include <tuple>

#include "core/base/text.h"
#include "core/math/ball.h"

namespace meniscus {
namespace {

struct ReasonWords {
  const char* reason;
  const char* words;
  const char* plural = "";
};

constexpr ReasonWords kReasonWords[] = {
    {kExcludedModel, "in other models"},
    {kExcludedTrajectory, "not in the trajectory"},
    {kExcludedAltloc, "in other alternate locations"},
    {kExcludedVirtual, "virtual site", "s"},
    {kExcludedSelection, "not selected"},
    {kExcludedElement, "of unknown element"},
    {kExcludedRadius, "of radius zero"},
    {kExcludedHydrogen, "hydrogen", "s"},
    {kExcludedWater, "water atom", "s"},
    {kExcludedIon, "free ion", "s"},
    {kExcludedLigand, "ligand atom", "s"},
    {kExcludedLipid, "lipid atom", "s"},
    {kExcludedAssembly, "outside the assembly"},
};

}  // namespace

const char* class_name(AtomClass kind) {
  constexpr const char* kNames[] = {"polymer", "ligand", "water", "ion", "unclassified"};
  return kNames[static_cast<std::size_t>(kind)];
}

std::string label_of(const Atom& atom) {
  if (atom.residue_name.empty()) return fmt::format("{} (atom {})", in_quotes(atom.name), atom.index + 1);
  return fmt::format("{} in {} {}{}{}", in_quotes(atom.name), atom.residue_name, atom.chain, atom.residue_number,
                     atom.insertion_code == ' ' ? "" : std::string(1, atom.insertion_code));
}

namespace {

/// Returns " (2 HEM, NAP)": the residues of one reason, the most frequent first.
std::string residues_text(const std::map<std::string, std::size_t>& residues) {
  constexpr std::size_t kNamed = 4;
  std::vector<std::pair<std::string, std::size_t>> by_count(residues.begin(), residues.end());
  std::ranges::stable_sort(by_count, std::greater(), &std::pair<std::string, std::size_t>::second);
  std::size_t named = 0;
  std::string names;
  for (const auto& [name, times] : by_count) {
    if (named++ >= kNamed) continue;
    names += names.empty() ? "" : ", ";
    names += (times > 1 ? with_thousands(times) + " " : "") + escaped(name);
  }
  if (named > kNamed) names += fmt::format(" and {} more", named - kNamed);
  return fmt::format(" ({})", names);
}

}  // namespace

std::string reasons_text(const std::map<std::string, std::size_t>& excluded,
                         const std::map<std::string, std::map<std::string, std::size_t>>& residues) {
  std::string text;
  for (const auto& [reason, words, plural] : kReasonWords) {
    const auto found = excluded.find(reason);
    if (found == excluded.end()) continue;
    const auto named = residues.find(reason);
    text += fmt::format("{}{} {}{}{}", text.empty() ? "" : ", ", with_thousands(found->second), words,
                        found->second == 1 ? "" : plural, named == residues.end() ? "" : residues_text(named->second));
  }
  return text;
}

std::string ReadReport::sentence() const {
  const std::string left_out = reasons_text(excluded, residues);
  return fmt::format("{} {} read; {} left out; {} used{}{}{}", with_thousands(read), read == 1 ? "atom" : "atoms",
                     left_out.empty() ? "none" : left_out, with_thousands(used),
                     excluded.contains(kExcludedLigand)  ? message(" (@select all@ adds ligands)")
                     : excluded.contains(kExcludedLipid) ? message(" (@select all@ adds lipids)")
                                                         : "",
                     assembled.empty() ? "" : "; ", assembled);
}

std::string AddedFile::sentence() const {
  std::string text = fmt::format("{} is model {}", file, model);
  if (fit)
    text += fmt::format(", superposed on the first file by {} atoms with an RMSD of {:.3f} Å",
                        with_thousands(fit->atoms), fit->rmsd);
  return text;
}

std::string chain_of_file(const Atom& atom) {
  const std::string suffix = "-" + std::to_string(atom.copy + 1);
  if (atom.copy == 0 || !atom.chain.ends_with(suffix)) return atom.chain;
  return atom.chain.substr(0, atom.chain.size() - suffix.size());
}

std::vector<std::string> chains_of(std::span<const Atom> atoms) {
  std::vector<std::string> chains;
  std::set<std::string> seen;
  for (const Atom& atom : atoms) {
    std::string chain = chain_of_file(atom);
    if (seen.insert(chain).second) chains.push_back(std::move(chain));
  }
  return chains;
}

std::vector<Ball> balls_of(const Structure& structure) {
  std::vector<Ball> balls;
  balls.reserve(structure.atoms.size());
  for (const Atom& atom : structure.atoms) balls.push_back({atom.position, atom.radius});
  return balls;
}

namespace {

// The numbers and texts that all atoms of one group have in common.
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
