// SPDX-License-Identifier: BSD-3-Clause
// Finds the exposed arcs of circles by contour build-up, leaving out balls that others cover.
#include "core/reduced_surface/contour/contour.h"

#include "core/math/quad_geometry.h"

namespace meniscus {
namespace {

constexpr std::size_t kMostCompared = 64;
/// Å: the allowed difference of radii from the radii of the weights: more than weights grow, and than rounding.
constexpr double kRadiusBlur = 1e-8;
/// Borders of smaller caps, and of those that leave less, are dominated by rounding.
constexpr double kLeastSine = 1e-3;

}  // namespace

const std::vector<std::uint8_t>& NestedCaps::find(const Blockers& blockers) {
  const double radius = std::sqrt(blockers.first_weight());
  caps_.clear();
  widest_.clear();
  nested_.assign(blockers.size(), 0);
  for (std::uint32_t n = 0; n < blockers.size(); ++n) {
    const Blockers::Ball ball = blockers[n];
    const double cosine = ball.half_power / (ball.distance * radius), sine = std::sqrt(1.0 - cosine * cosine);
    if (!(sine > kLeastSine)) continue;
    const double moved = kRadiusBlur * (radius + std::sqrt(ball.weight)) / ball.distance + kRadiusBlur;
    caps_.push_back({n, ball.center / ball.distance, cosine, sine, moved / (radius * sine)});
  }
  std::ranges::sort(caps_, {}, &Cap::cosine);
  for (const Cap& cap : caps_) {
    const bool is_nested = std::ranges::any_of(widest_, [&](const Cap& wide) {
      const double blur = cap.blur + wide.blur;
      const double sine = wide.sine * cap.cosine - wide.cosine * cap.sine;  // sine of the difference of their angles
      const double cosine = wide.cosine * cap.cosine + wide.sine * cap.sine;
      return sine > blur && glm::dot(wide.axis, cap.axis) > cosine + blur * (sine + blur);
    });
    nested_[cap.ball] = is_nested;
    if (!is_nested && widest_.size() < kMostCompared) widest_.push_back(cap);
  }
  return nested_;
}

namespace quad_geometry {

// The part of one circle that balls leave, in quadruple precision.
struct Remainder {
  std::vector<ExposedArc> exposed_arcs;
  const ExposedArc& get_arc(uint n) const { return exposed_arcs[n]; }
  bool set_arc(uint n, const ExposedArc& arc) {
    if (exposed_arcs.size() <= n) exposed_arcs.resize(n + 1);
    exposed_arcs[n] = arc;
    return true;
  }
#include "gpu_shaders/geometry/contour.glsl"
};

}  // namespace quad_geometry

namespace {

quad_geometry::real3 quad(const glm::dvec3& a) { return {a.x, a.y, a.z}; }

}  // namespace

void Contour::expose(const glm::dvec3& d, double w1, const Blockers& blockers, std::size_t skip,
                     std::span<const BlockedHalf> halves) {
  if (expose_surely(d, w1, blockers, skip, halves)) return;
  ++doubtful_count_;
  expose_in_quad(d, w1, blockers, skip, halves);
}

// Begins with the whole circle. False if the remainder is known already, or in doubt: sure_ is true if it is known.
bool Contour::begin_surely(const glm::dvec3& d, double w0, double w1) {
  left_.begin_contour(geometry::circle_of_two_spheres(d, w0, w1), w0, unit_);
  const double barely = 1024 * unit_ * w0;
  const bool apart = circle().radius_squared < -barely;
  if (apart) left_.cover_everything();
  // Where the spheres barely meet, the sign itself needs higher precision.
  sure_ = apart || circle().radius_squared > barely;
  return sure_ && !apart;
}

bool Contour::expose_surely(const glm::dvec3& d, double w1, const Blockers& blockers, std::size_t skip,
                            std::span<const BlockedHalf> halves) {
  if (!begin_surely(d, blockers.first_weight(), w1)) return sure_;
  for (std::size_t n = 0; n < halves.size() && !left_.contour_ended(); ++n)
    left_.cover(halves[n].half_plane, halves[n].label);
  if (!left_.contour_ended()) {
    meetings_.find(circle(), unit_, blockers, skip);
    cover_in_turn(blockers);
  }
  return conclude();
}

bool Contour::conclude() { return sure_ = !left_.exposed_doubtful; }

bool Contour::expose_at_once(const glm::dvec3& d, double w1, const Blockers& blockers, std::size_t skip) {
  if (!begin_surely(d, blockers.first_weight(), w1)) return sure_;
  meetings_.find(circle(), unit_, blockers, skip);
  const CircleSweep::Outcome outcome = sweep_.find(meetings_, blockers);
  if (outcome == CircleSweep::Outcome::unknown) {
    cover_in_turn(blockers);
    return conclude();
  }
  if (outcome != CircleSweep::Outcome::whole) left_.cover_everything();
  if (outcome == CircleSweep::Outcome::one_arc) left_.expose_arc(sweep_.arc());
  return true;
}

void Contour::cover_in_turn(const Blockers& blockers) {
  if (meetings_.covered()) return left_.cover_everything();
  for (std::size_t n = 0; n < meetings_.count() && !left_.contour_ended(); ++n) {
    if (!meetings_.meets(n)) continue;
    if (meetings_.doubtful(n)) left_.exposed_doubtful = true;
    left_.cover_arc(meetings_.arc(n), blockers.label(meetings_.blocker(n)));
  }
}

void Contour::expose_further(const glm::dvec3& d, double w1, const Blockers& blockers, std::size_t skip) {
  if (!sure_) return expose(d, w1, blockers, skip);
  const Blockers::Ball ball = blockers[blockers.size() - 1];
  if (!left_.contour_ended()) left_.block(ball, ball.label);
  if (left_.exposed_doubtful) expose(d, w1, blockers, skip);
}

void Contour::expose_in_quad(const glm::dvec3& d, double w1, const Blockers& blockers, std::size_t skip,
                             std::span<const BlockedHalf> halves) {
  namespace q = quad_geometry;
  left_.cover_everything();
  const double w0 = blockers.first_weight();
  const q::Circle circle = q::circle_of_two_spheres(quad(d), w0, w1);
  if (!(circle.radius_squared > 0)) return;
  q::Remainder left;
  left.begin_contour(circle, w0, q::kUnitRoundoff);
  // The frame equals the one in double up to rounding, so that the half-planes given by the caller mean the same.
  for (std::size_t n = 0; n < halves.size() && !left.contour_is_covered(); ++n) {
    const geometry::HalfPlane& h = halves[n].half_plane;
    left.cover(q::HalfPlane{{h.normal.x, h.normal.y}, h.offset, h.length_squared, h.length_bound, 0}, halves[n].label);
  }
  // Doubt that remains here is decided by the weights: the first decision stays (reduced_surface.h).
  for (std::size_t n = 0; n < blockers.size() && !left.contour_is_covered(); ++n)
    if (n != skip) left.block(q::blocking_ball(quad(blockers[n].center), blockers[n].weight, w0), blockers[n].label);
  left_.exposed_whole = left.exposed_whole;
  left_.contour_circle.radius = static_cast<double>(circle.radius);
  left_.contour_circle.radius_squared = left_.contour_circle.radius * left_.contour_circle.radius;
  for (std::size_t n = 0; n < left.exposed_count; ++n) {
    const q::ExposedArc& a = left.exposed_arcs[n];
    left_.expose_arc({static_cast<double>(a.begin), static_cast<double>(a.end), a.begin_by, a.end_by});
  }
}

}  // namespace meniscus
