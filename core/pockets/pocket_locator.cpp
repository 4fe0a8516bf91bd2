// SPDX-License-Identifier: BSD-3-Clause
// Asks whose probe is the nearest.
#include "core/pockets/pocket_locator.h"

namespace meniscus {

PocketLocator::PocketLocator(const Pockets& pockets) : probe_radius_(pockets.request.probe_radius) {
  if (pockets.pockets.empty()) return;
  anywhere_.emplace(pockets.surface);
  for (const Pocket& pocket : pockets.pockets) each_.emplace_back(pocket.surface);
}

// Where a probe may be, the nearest place where it touches something is one of its own pocket; elsewhere the point lies
// in the pockets whose probes are near enough. Distances to places of a pocket are those to places of all pockets to
// the last digit, as they come from the same numbers.
std::optional<std::size_t> PocketLocator::operator()(const glm::dvec3& point) const {
  if (!anywhere_) return std::nullopt;
  const bool in_sas = anywhere_->in_sas(point);
  const double nearest = anywhere_->to_probe(point);
  if (in_sas && nearest >= probe_radius_) return std::nullopt;
  for (std::size_t n = 0; n < each_.size(); ++n)
    if (const double distance = each_[n].to_probe(point); in_sas ? distance < probe_radius_ : distance <= nearest)
      return n;
  return std::nullopt;
}

}  // namespace meniscus
