// SPDX-License-Identifier: BSD-3-Clause
// Fills the cavities by forgetting the probes in them.
#include "core/pockets/hull.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "core/queries/part.h"

namespace meniscus {

Hull::Hull(Surface surface) : whole_(std::move(surface)), anywhere_(whole_) {
  const std::vector<bool> reached = reached_from_outside(whole_);
  for (std::size_t c = 0; c < reached.size(); ++c)
    if (reached[c]) volume_ += whole_.components[c].volume;
  if (std::ranges::find(reached, false) == reached.end()) return;
  part_ = part_of(whole_, reached).surface;
  outside_.emplace(*part_);
}

// From where a probe may be, the nearest place where it touches an atom is reached without leaving such places: if it
// is not one of the outside's, the point lies in a cavity.
double Hull::to_probe(const glm::dvec3& point) const {
  const bool in_sas = anywhere_.in_sas(point);
  if (!outside_) return in_sas ? anywhere_.to_probe(point) : 0.0;
  const double outside = outside_->to_probe(point);
  return in_sas || anywhere_.to_probe(point) < outside ? outside : 0.0;
}

}  // namespace meniscus
