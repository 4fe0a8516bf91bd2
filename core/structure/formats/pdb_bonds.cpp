// SPDX-License-Identifier: BSD-3-Clause
// Looks the serial numbers of CONECT records up.
#include "core/structure/formats/pdb_bonds.h"

#include <algorithm>
#include <optional>
#include <unordered_map>

#include "core/text/text_lines.h"

namespace meniscus {
namespace {

constexpr std::size_t kFirstColumn = 6, kWidth = 5, kMostPartners = 4;
constexpr std::uint32_t kSeveral = 0xffffffff;

std::string_view serial_at(std::string_view line, std::size_t field) {
  return trimmed(line.substr(std::min(line.size(), kFirstColumn + field * kWidth), kWidth));
}

}  // namespace

void PdbBonds::add_atom(std::string_view line) { serials_.push_back(serial_at(line, 0)); }

std::vector<Bond> PdbBonds::bonds() const {
  std::vector<Bond> bonds;
  if (records_.empty()) return bonds;
  std::unordered_map<std::string_view, std::uint32_t> atom_of;
  for (std::size_t n = 0; n < serials_.size(); ++n) {
    const auto [found, added] = atom_of.try_emplace(serials_[n], static_cast<std::uint32_t>(n));
    if (!added) found->second = kSeveral;
  }
  const auto find = [&](std::string_view serial) -> std::optional<std::uint32_t> {
    const auto found = atom_of.find(serial);
    if (serial.empty() || found == atom_of.end() || found->second == kSeveral) return std::nullopt;
    return found->second;
  };
  for (const std::string_view record : records_) {
    const auto first = find(serial_at(record, 0));
    for (std::size_t field = 1; first && field <= kMostPartners; ++field) {
      const auto partner = find(serial_at(record, field));
      if (partner && *partner != *first) bonds.push_back({std::min(*first, *partner), std::max(*first, *partner)});
    }
  }
  std::sort(bonds.begin(), bonds.end());
  bonds.erase(std::unique(bonds.begin(), bonds.end()), bonds.end());
  return bonds;
}

}  // namespace meniscus
