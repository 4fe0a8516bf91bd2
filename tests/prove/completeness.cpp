// SPDX-License-Identifier: BSD-3-Clause
// Tests each point of each atom against every ball near enough to cover it.
#include "tests/prove/completeness.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "core/reduced_surface/reduced_surface.h"
#include "tests/support/patch_samples.h"

namespace meniscus::testing {
namespace {

constexpr double kDecisionGrowth = 1.5e-9;  // Å, the most that decision_weights() adds to a radius
constexpr double kMerged = 1e-6;            // Å: nearer spheres, and nearer fixed probes, are one

class Questions {
 public:
  Questions(const Surface& surface, const Balls& balls, int directions, std::uint32_t seed)
      : s_(surface), balls_(balls), directions_(directions), random_(seed), swallowed_(swallowed_atoms(surface.atoms)) {
    double far = 0;
    for (const Ball& b : balls)
      far = std::max({far, std::abs(b.center.x), std::abs(b.center.y), std::abs(b.center.z), extended(b)});
    doubt_ = 2 * allowed_growth(surface) + 1e-13 * (1 + far);
  }

  Completeness answers() {
    std::uint32_t patch = 0;  // patches are sorted by their atoms
    for (std::uint32_t a = 0; a < balls_.size() && found_.lost.empty() && found_.wrong.empty(); ++a) {
      while (patch < s_.convex.size() && s_.convex[patch].atom < a) ++patch;
      ask(a, patch < s_.convex.size() && s_.convex[patch].atom == a ? patch : kNone);
    }
    return found_;
  }

 private:
  double extended(const Ball& b) const { return b.radius + s_.probe_radius; }

  glm::dvec3 random_direction() {
    const double z = 2 * unit() - 1, turn = 6.283185307179586 * unit(), across = std::sqrt(1 - z * z);
    return {across * std::cos(turn), across * std::sin(turn), z};
  }
  double unit() { return random_() * 0x1p-32; }

  void list_neighbors(std::uint32_t a) {
    near_.clear();
    for (std::uint32_t b = 0; b < balls_.size(); ++b) {
      const double reach = extended(balls_[a]) + extended(balls_[b]) + 2 * doubt_;
      const glm::dvec3 between = balls_[b].center - balls_[a].center;
      if (b != a && !swallowed_[b] && glm::dot(between, between) < reach * reach) near_.push_back(b);
    }
  }

  void ask(std::uint32_t a, std::uint32_t patch) {
    list_neighbors(a);
    const double R = extended(balls_[a]), doubt = swallowed_[a] ? doubt_ + kMerged : doubt_;
    int exposed = 0, skipped = 0;
    for (int n = 0; n < directions_; ++n) {
      const glm::dvec3 direction = random_direction(), x = balls_[a].center + R * direction;
      double clear = std::numeric_limits<double>::max(), nearest = clear;
      for (const std::uint32_t b : near_) {
        const double outside = glm::distance(x, balls_[b].center) - extended(balls_[b]);
        clear = std::min(clear, outside);
        nearest = std::min(nearest, std::abs(outside));
      }
      ++found_.asked;
      if (nearest <= doubt) {
        ++skipped;
        continue;
      }
      const bool is_exposed = clear > 0;
      exposed += is_exposed;
      const bool shown = patch != kNone && inside_planes(s_, PatchKind::convex, patch,
                                                         s_.atoms[a].center + s_.atoms[a].radius * direction);
      if (is_exposed && !shown && found_.lost.empty())
        found_.lost = fmt::format("atom {} {} though {} Å outside of every other ball", a,
                                  patch == kNone ? "has no patch" : "lacks a point of its patch", clear);
      // Merged probes may leave a hair between the planes of their arcs.
      if (!is_exposed && shown && clear < -kMerged - doubt && found_.wrong.empty())
        found_.wrong = fmt::format("the patch of atom {} has a point {} Å inside of another ball", a, -clear);
    }
    found_.skipped += static_cast<std::size_t>(skipped);
    compare_area(a, patch, exposed, skipped);
  }

  void compare_area(std::uint32_t a, std::uint32_t patch, int exposed, int skipped) {
    const double whole = patch == kNone ? 0.0 : whole_area(s_, PatchKind::convex, patch);
    const double share = whole > 0 ? face_area(s_, PatchKind::convex, patch) / whole : 0.0;
    const double noise = 6 * std::sqrt(directions_ * share * std::abs(1 - share)) + 6;
    if (share * directions_ >= exposed - noise && share * directions_ <= exposed + skipped + noise) return;
    std::string& found = share * directions_ < exposed ? found_.lost : found_.wrong;
    if (found.empty())
      found =
          fmt::format("atom {} shows {} of its sphere, {} of {} points are exposed", a, share, exposed, directions_);
  }

  const Surface& s_;
  const Balls& balls_;
  int directions_;
  std::mt19937 random_;
  std::vector<bool> swallowed_;
  std::vector<std::uint32_t> near_;
  double doubt_ = 0;
  Completeness found_;
};

}  // namespace

double allowed_growth(const Surface& surface) { return surface.certificate.grown_by + kDecisionGrowth; }

Completeness check_completeness(const Surface& surface, const Balls& balls, int directions, std::uint32_t seed) {
  return Questions(surface, balls, directions, seed).answers();
}

}  // namespace meniscus::testing
