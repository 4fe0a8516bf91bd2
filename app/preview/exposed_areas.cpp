// SPDX-License-Identifier: BSD-3-Clause
// One background computation, and the areas that earlier ones found.
#include "app/preview/exposed_areas.h"

#include <chrono>

#include "core/base/error.h"
#include "core/reduced_surface/cpu/exhaustive.h"
#include "core/surface/atom_areas.h"
#include "core/surface/compute_surface.h"

namespace meniscus {
namespace {

constexpr std::size_t kKept = 16;  // frames and probes

std::future<std::vector<double>> begin_areas(const AtomsInView& atoms) {
  if (atoms.surface)
    return std::async(std::launch::async, [surface = atoms.surface] { return atom_areas(*surface).surface; });
  return std::async(std::launch::async, [balls = atoms.balls, radius = rolling_probe(atoms.kind, atoms.probe_radius)] {
    return atom_areas(compute_surface_cpu(balls, radius)).surface;
  });
}

}  // namespace

std::optional<double> ExposedAreas::of(const AtomsInView& atoms, std::size_t atom, bool wait) {
  const Key key{atoms.frame, atoms.group, atoms.kind, atoms.probe_radius};
  if (pending_.valid() && (wait || pending_.wait_for(std::chrono::seconds(0)) == std::future_status::ready)) {
    try {
      keep();
    } catch (const Error&) {
      if (pending_key_ == key) throw;  // else nobody asks for this surface any more
    }
  }
  if (!known_.contains(key) && !pending_.valid()) {
    pending_key_ = key;
    pending_ = begin_areas(atoms);
    if (wait) keep();
  }
  const auto found = known_.find(key);
  if (found == known_.end()) return {};
  return found->second[atom];
}

std::optional<double> ExposedAreas::if_cheap(const AtomsInView& atoms, std::size_t atom) {
  const Key key{atoms.frame, atoms.group, atoms.kind, atoms.probe_radius};
  const bool begun = pending_.valid() && pending_key_ == key;
  if (!atoms.surface && !begun && !known_.contains(key)) return {};
  return of(atoms, atom, false);
}

void ExposedAreas::keep() {
  known_.insert_or_assign(pending_key_, pending_.get());
  order_.push_back(pending_key_);
  if (order_.size() <= kKept) return;
  known_.erase(order_.front());
  order_.erase(order_.begin());
}

}  // namespace meniscus
