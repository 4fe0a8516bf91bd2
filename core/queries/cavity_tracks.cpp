// SPDX-License-Identifier: BSD-3-Clause
// Matches cavities by the probes at rest in them.
#include "core/queries/cavity_tracks.h"

#include <iterator>
#include <numeric>
#include <tuple>

namespace meniscus {
namespace {

/// Returns the smallest distance (Å) between a point of each list.
double smallest_distance(const std::vector<glm::dvec3>& a, const std::vector<glm::dvec3>& b) {
  double least = std::numeric_limits<double>::infinity();
  for (const glm::dvec3& x : a)
    for (const glm::dvec3& y : b) least = std::min(least, glm::dot(x - y, x - y));
  return std::sqrt(least);
}

/// Returns the number of lining atoms that two cavities have in common.
std::size_t shared_atoms(const Cavity& a, const Cavity& b) {
  std::vector<std::uint32_t> shared;
  std::ranges::set_intersection(a.atoms, b.atoms, std::back_inserter(shared));
  return shared.size();
}

}  // namespace

glm::dvec3 Cavity::middle() const {
  return std::accumulate(probes.begin(), probes.end(), glm::dvec3(0.0)) / static_cast<double>(probes.size());
}

std::vector<Cavity> cavities_of(const Surface& surface) {
  std::vector<Cavity> cavities;
  std::vector<std::size_t> place(surface.components.size(), kNone);
  for (std::size_t c = 0; c < surface.components.size(); ++c) {
    const Component& component = surface.components[c];
    if (component.kind != ComponentKind::cavity) continue;
    place[c] = cavities.size();
    cavities.push_back({component.area, -component.volume, {}, {}});
  }
  if (cavities.empty()) return cavities;
  for (const ConvexPatch& patch : surface.convex)
    for (std::uint32_t f = patch.first_face; f < patch.first_face + patch.face_count; ++f)
      if (const std::size_t n = place[surface.faces[f].component]; n != kNone)
        if (cavities[n].atoms.empty() || cavities[n].atoms.back() != patch.atom)
          cavities[n].atoms.push_back(patch.atom);
  for (const ConcavePatch& patch : surface.concave)
    for (std::uint32_t f = patch.first_face; f < patch.first_face + patch.face_count; ++f)
      if (const std::size_t n = place[surface.faces[f].component]; n != kNone) {
        cavities[n].probes.push_back(patch.center);
        break;
      }
  return cavities;
}

const char* event_word(CavityEvent event) {
  constexpr std::array<const char*, 5> kWords{"born", "kept", "split", "merged", "closed"};
  return kWords[static_cast<std::size_t>(event)];
}

/// Returns the pairs of overlapping cavities of the last frame and this one, the best first.
std::vector<CavityTracks::Pair> CavityTracks::overlapping(const std::vector<Cavity>& cavities) const {
  std::vector<Pair> pairs;
  for (std::size_t before = 0; before < known_.size(); ++before)
    for (std::size_t now = 0; now < cavities.size(); ++now) {
      const Cavity &a = known_[before].cavity, &b = cavities[now];
      const double distance = smallest_distance(a.probes, b.probes);
      if (distance < 2 * probe_radius_) pairs.push_back({before, now, shared_atoms(a, b), distance});
    }
  std::ranges::sort(pairs, [](const Pair& a, const Pair& b) {
    return std::tuple(b.shared, a.distance, a.before, a.now) < std::tuple(a.shared, b.distance, b.before, b.now);
  });
  return pairs;
}

std::vector<CavityStep> CavityTracks::follow(const std::vector<Cavity>& cavities) {
  std::vector<CavityStep> steps(cavities.size());
  std::vector<std::size_t> successor(known_.size(), kNone);
  for (std::size_t n = 0; n < cavities.size(); ++n) steps[n].cavity = n;
  const std::vector<Pair> pairs = overlapping(cavities);
  for (const Pair& pair : pairs) {
    if (steps[pair.now].id != 0 || successor[pair.before] != kNone) continue;
    successor[pair.before] = pair.now;
    steps[pair.now].id = known_[pair.before].id;
    steps[pair.now].event = CavityEvent::kept;
  }
  std::vector<CavityStep> gone;
  for (std::size_t before = 0; before < known_.size(); ++before)
    if (successor[before] == kNone) gone.push_back({known_[before].id, CavityEvent::closed, std::nullopt, kNone});
  for (CavityStep& step : steps) {
    if (step.id != 0) continue;
    step.id = next_id_++;
    const auto parent = std::ranges::find(pairs, step.cavity, &Pair::now);  // the best one comes first
    if (parent == pairs.end()) continue;
    step.event = CavityEvent::split;
    step.other = known_[parent->before].id;
  }
  for (CavityStep& step : gone) {
    const auto heir = std::ranges::find_if(pairs, [&](const Pair& pair) { return known_[pair.before].id == step.id; });
    if (heir == pairs.end()) continue;
    step.event = CavityEvent::merged;
    step.other = steps[heir->now].id;
  }
  known_.clear();
  for (std::size_t n = 0; n < cavities.size(); ++n) known_.push_back({steps[n].id, cavities[n]});
  steps.insert(steps.end(), gone.begin(), gone.end());
  std::ranges::sort(steps, {}, &CavityStep::id);
  return steps;
}

}  // namespace meniscus
