// SPDX-License-Identifier: BSD-3-Clause
// Makes the checks, cheapest first; the first that fails gives the message.
#include "tests/prove/surface_check.h"

#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "core/base/error.h"
#include "core/mesh/tessellate.h"
#include "core/reduced_surface/reduced_surface.h"
#include "core/surface/compute_surface.h"
#include "core/surface/measure.h"
#include "tests/prove/completeness.h"
#include "tests/prove/turning.h"
#include "tests/support/patch_samples.h"
#include "tests/support/sampled_volume.h"
#include "tests/support/sphere_tracer.h"

namespace meniscus::testing {
namespace {

constexpr double kPi = std::numbers::pi;
// Å; more than the oracle's balls are grown by, as decisions see them, and circles and fixed probes move by more.
// Spheres of atoms 1e-6 Å apart are told from each other.
constexpr double kOnSphere = 5e-9, kOn = 1e-7;

const char* name_of(PatchKind kind) {
  return kind == PatchKind::convex ? "convex" : kind == PatchKind::toroidal ? "toroidal" : "concave";
}

class Check {
 public:
  Check(const Surface& surface, const Balls& balls, std::uint32_t seed, int effort)
      : s_(surface), balls_(balls), random_(seed), effort_(effort) {}

  void run(SurfaceVerdict& verdict) {
    for (const auto check : {&Check::faces, &Check::all_there, &Check::atoms, &Check::patches, &Check::mesh,
                             &Check::points, &Check::volume}) {
      verdict.complaint = (this->*check)();
      verdict.lost = lost_;
      if (!verdict.complaint.empty()) return;
      if (check == &Check::patches && effort_ == 0) return;  // meshes and the oracle cost more than all the rest
    }
  }

 private:
  std::string faces() {
    for (const Face& face : s_.faces) {
      const double whole = whole_area(s_, face.kind, face.patch);
      if (!(face.area >= 0 && face.area <= whole * (1 + 1e-12)))
        return fmt::format("{} face of area {} of {}", name_of(face.kind), face.area, whole);
    }
    return {};
  }

  std::string all_there() {
    const Completeness found = check_completeness(s_, balls_, effort_ == 0 ? 40 : 200 * effort_, random_());
    lost_ = !found.lost.empty();
    return lost_ ? found.lost : found.wrong;
  }

  std::string atoms() {
    const AtomAreas areas = atom_areas(s_);
    double sum = 0;
    for (std::size_t a = 0; a < balls_.size(); ++a) {
      sum += areas.surface[a];
      const double R = s_.atoms[a].radius + s_.probe_radius;
      const double noise = 1e-8 * (1 + R * R);
      if (!(areas.surface[a] >= -noise)) return fmt::format("SES area {} of atom {}", areas.surface[a], a);
      if (!(areas.accessible[a] >= -noise && areas.accessible[a] <= 4 * kPi * R * R + noise))
        return fmt::format("SAS area {} of atom {}", areas.accessible[a], a);
    }
    // Planes and borders of a patch whose corners a tie blurs agree as well as the certificate asks, others to
    // rounding.
    const double blur = s_.certificate.exact_within > 0 ? 1e-8 : 1e-10;
    const double p = s_.probe_radius, by_patch = blur * 4 * kPi * p * p * static_cast<double>(s_.concave.size());
    if (!(std::abs(sum - s_.area) <= 2e-8 * (1 + s_.area) + by_patch))
      return fmt::format("atoms' areas {} of {}", sum, s_.area);
    return {};
  }

  // An area that is off by a sphere is off by a share of 1, which a few points show.
  std::string patches() {
    for (const PatchKind kind : {PatchKind::convex, PatchKind::concave}) {
      if (kind == PatchKind::concave && s_.probe_radius == 0) continue;
      for (std::uint32_t patch = 0; patch < patch_count(s_, kind); ++patch) {
        const int samples = effort_ == 0 ? 40 : 300 * effort_;
        int inside = 0;
        for (int n = 0; n < samples; ++n) inside += sample_patch(s_, kind, patch, random_).inside;
        const double share = face_area(s_, kind, patch) / whole_area(s_, kind, patch);
        const double off = std::abs(inside - share * samples);
        if (off > 6 * std::sqrt(samples * share * std::abs(1 - share)) + 6)
          return fmt::format("{} patch {} has {} of its sphere, its planes leave {}", name_of(kind), patch, share,
                             double(inside) / samples);
      }
    }
    return {};
  }

  // A mesh of these areas and volumes, face by face (tessellate() compares), or a refusal: faces thinner than their
  // borders bend have none. What counts here is that it comes to an end.
  std::string mesh() {
    if (s_.probe_radius > 20) return {};  // a mesh within a tenth of an Ångström would be huge
    try {
      tessellate(s_, {0.1, false});
    } catch (const OpenSurfaceError&) {
    }
    return {};
  }

  // Whose radii the oracle gets: those in which decisions are taken, or all so much smaller or larger that no decision
  // at a tie can be explained by its growth.
  enum Radii : std::size_t { kDecided, kSmaller, kLarger, kRadiiCount };

  SphereTracer& oracle(Radii radii) {
    if (oracles_[radii]) return *oracles_[radii];
    Balls asked;
    const std::vector<bool> swallowed = swallowed_atoms(s_.atoms);
    const double more = radii == kDecided ? 0.0 : (radii == kSmaller ? -3 : 3) * allowed_growth(s_);
    asked_.clear();
    for (std::uint32_t a = 0; a < s_.atoms.size(); ++a) {
      if (swallowed[a]) continue;
      const double extended = std::sqrt(decision_weight(s_.atoms[a].radius + s_.probe_radius, a));
      asked.push_back({s_.atoms[a].center, extended - s_.probe_radius + more});
      asked_.push_back(a);
    }
    return oracles_[radii].emplace(asked, s_.probe_radius, 0.01);
  }

  // Two probes that are next to each other are as far from a point but for the square of the way between them. So a
  // point that is on the surface belongs to a patch only if the probe at it touches that patch's atoms.
  bool is_of(const NearestProbe& probe, PatchKind kind, std::uint32_t patch) const {
    if (s_.probe_radius == 0) return true;
    if (probe.kind != kind) return false;
    if (kind == PatchKind::toroidal)
      return asked_[probe.atom[0]] == s_.toroidal[patch].atom[0] && asked_[probe.atom[1]] == s_.toroidal[patch].atom[1];
    if (kind == PatchKind::concave) return glm::distance(probe.center, s_.concave[patch].center) < kOn;
    return asked_[probe.atom[0]] == s_.convex[patch].atom;
  }

  // Probes closer than 1e-6 Å count as one: any of them may have the point.
  bool another_has(const NearestProbe& probe, PatchKind kind, const glm::dvec3& point) const {
    if (kind != PatchKind::concave) return false;
    for (std::uint32_t patch = 0; patch < s_.concave.size(); ++patch)
      if (glm::distance(probe.center, s_.concave[patch].center) < 1e-6 && inside_planes(s_, kind, patch, point))
        return true;
    return false;
  }

  std::string points() {
    for (const PatchKind kind : {PatchKind::convex, PatchKind::toroidal, PatchKind::concave}) {
      const std::size_t count = patch_count(s_, kind);
      if (count == 0 || (kind != PatchKind::convex && s_.probe_radius == 0)) continue;
      for (int n = 0; n < 40 * std::max(effort_, 1); ++n) {
        const auto patch = static_cast<std::uint32_t>(random_() % count);
        const PatchSample sample =
            kind == PatchKind::toroidal ? sample_circle(s_, patch, random_) : sample_patch(s_, kind, patch, random_);
        std::string text = complaint_about(sample, kind, patch, kDecided);
        if (!text.empty() && !complaint_about(sample, kind, patch, kSmaller).empty() &&
            !complaint_about(sample, kind, patch, kLarger).empty())
          return text;
      }
    }
    return {};
  }

  // A probe close to a fixed one is as far from the point as that one but for the square of the way between them: so
  // the point is missed here only if nothing of another kind explains it.
  std::string complaint_about(const PatchSample& sample, PatchKind kind, std::uint32_t patch, Radii radii) {
    NearestProbe probe{0, {}, kind, {}};
    if (s_.probe_radius > 0) probe = oracle(radii).nearest(sample.point);
    const double off = s_.probe_radius > 0 ? probe.distance - s_.probe_radius : oracle(radii).outside(sample.point);
    // Where spheres touch, growth moves a probe by its square root.
    if (sample.inside && std::abs(off) > 2e-3 * (1 + s_.probe_radius))
      return fmt::format("a point of {} patch {} is {} off the surface", name_of(kind), patch, off);
    if (!sample.inside && sample.clearance > 0.05 && std::abs(off) < (kind == PatchKind::convex ? kOnSphere : kOn) &&
        is_of(probe, kind, patch) && !another_has(probe, kind, sample.point))
      return fmt::format("{} patch {} lacks a point of the surface", name_of(kind), patch);
    return {};
  }

  // A few points that all miss a thin solid know nothing of their error: what seems wrong is sampled ever more finely,
  // and is wrong if the finest says so, and if it is not between the volumes of smaller and larger radii.
  std::string volume() {
    std::string text;
    for (int cells = effort_ > 1 ? 16 : 9; cells <= 64; cells *= 2) {
      const VolumeEstimate v = sampled_volume(balls_, s_.probe_radius, oracle(kDecided), cells, random_);
      if (std::abs(s_.volume - v.value) <= noise_of(v)) return {};
      text = fmt::format("volume {}, sampled {} +- {}", s_.volume, v.value, v.error);
    }
    const VolumeEstimate least = sampled_volume(balls_, s_.probe_radius, oracle(kSmaller), 36, random_);
    const VolumeEstimate most = sampled_volume(balls_, s_.probe_radius, oracle(kLarger), 36, random_);
    const bool between = s_.volume >= least.value - noise_of(least) && s_.volume <= most.value + noise_of(most) &&
                         most.value > least.value;
    return between ? std::string() : text;
  }

  static double noise_of(const VolumeEstimate& v) { return 5.5 * v.error + 1.5 * v.cell + 1e-9; }

  const Surface& s_;
  const Balls& balls_;
  std::mt19937 random_;
  int effort_;
  bool lost_ = false;
  std::array<std::optional<SphereTracer>, kRadiiCount> oracles_;
  std::vector<std::uint32_t> asked_;  // the atoms that the oracle knows, by its indices
};

}  // namespace

SurfaceVerdict check_surface(const Balls& balls, double probe_radius, std::uint32_t seed, int effort, Turned turned) {
  SurfaceVerdict verdict;
  try {
    verdict.surface = compute_surface_cpu(balls, probe_radius);
    Check(*verdict.surface, balls, seed, effort).run(verdict);
  } catch (const OpenSurfaceError&) {
    verdict.refused = true;
  }
  if (turned == Turned::no || verdict.refused || !verdict.complaint.empty()) return verdict;
  const Turning turning = check_turning(*verdict.surface, balls, seed);
  verdict.refused = turning.refused;
  verdict.lost = turning.lost;
  verdict.tied = turning.tied;
  verdict.complaint = turning.complaint;
  return verdict;
}

}  // namespace meniscus::testing
