// SPDX-License-Identifier: BSD-3-Clause
// Looks for residues outside of all pockets, and counts the residues of chains.
#include "app/reports/pocket_hints.h"

#include <algorithm>
#include <map>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "app/reports/series_csv.h"
#include "core/base/text.h"

namespace meniscus {
namespace {

std::string unplaced_ligands(const PocketReport& report) {
  std::vector<std::string> names;
  for (const LeftOutResidue& residue : report.pockets.left_out)
    if (std::ranges::none_of(residue.in_pocket, [&](std::size_t atoms) { return 2 * atoms >= residue.atoms; }))
      names.push_back(residues_of(report.structure, {residue.first_atom}));
  if (names.empty()) return {};
  constexpr std::size_t kNamed = 5;
  const std::size_t count = names.size();
  names.resize(std::min(count, kNamed));
  return fmt::format("less than half of {}{} lies in one pocket; a --large-probe above {} Å may reach shallower sites",
                     fmt::join(names, ", "),
                     count > kNamed ? fmt::format(" and {} more ligands", with_thousands(count - kNamed)) : "",
                     report.pockets.found.request.large_probe_radius);
}

/// Chains of at most 30 residues beside one at least three times as long, such as peptides that are bound to it, that
/// were not taken out; by name, in the order of the file.
std::vector<std::string> short_chains(const PocketReport& report) {
  constexpr std::size_t kShort = 30, kTimes = 3;
  std::set<std::uint32_t> taken;
  for (const LeftOutResidue& residue : report.pockets.left_out)
    taken.insert(report.structure.atoms[residue.first_atom].residue);
  std::vector<std::string> order;
  std::map<std::string, std::set<std::uint32_t>> residues;
  for (const Atom& atom : report.structure.atoms) {
    if (atom.kind != AtomClass::polymer || taken.contains(atom.residue)) continue;
    const auto [chain, added] = residues.try_emplace(atom.chain);
    if (added) order.push_back(atom.chain);
    chain->second.insert(atom.residue);
  }
  std::size_t longest = 0;
  for (const auto& [chain, members] : residues) longest = std::max(longest, members.size());
  std::erase_if(order, [&](const std::string& chain) {
    const std::size_t count = residues[chain].size();
    return count > kShort || kTimes * count > longest;
  });
  return order;
}

std::string filling_chains(const PocketReport& report) {
  const std::vector<std::string> chains = short_chains(report);
  if (chains.empty()) return {};
  std::string selection = "ligand";
  for (const std::string& chain : chains) selection += fmt::format(" or chain \"{}\"", chain);
  return fmt::format(
      "short chains stay in the molecule and fill the pockets they are bound in: {}; take them out by "
      "--ligand '{}'",
      fmt::join(chains, ", "), selection);
}

}  // namespace

std::vector<std::string> pocket_hints(const PocketReport& report) {
  std::vector<std::string> hints;
  for (std::string hint : {unplaced_ligands(report), filling_chains(report)})
    if (!hint.empty()) hints.push_back(std::move(hint));
  return hints;
}

}  // namespace meniscus
