// SPDX-License-Identifier: BSD-3-Clause
// Contour build-up of one circle: double with an error bound first, quadruple precision where that leaves doubt.
#include "core/surface/contour.h"

#include "core/surface/quad_geometry.h"

namespace meniscus {
namespace {

// Cuts what is left of a circle by one covering half-plane that is known to cut or cover it. Returns false when the
// rounding error bounds cannot exclude another outcome. Works for both precisions: the functions are found by the
// namespace of their arguments.
template <typename HalfPlane, typename Arc>
bool cover(bool& whole, std::vector<Arc>& arcs, std::vector<Arc>& next, const HalfPlane& h, std::uint32_t label) {
  const auto covered = covered_arc(h);
  if (whole) {
    whole = false;
    arcs.push_back({covered.end, covered.begin, label, label, covered.error, covered.error});
    return true;
  }
  next.clear();
  bool sure = true;
  for (Arc arc : arcs) {
    auto margin = covered.error;
    const int change = clip_arc(arc.begin, arc.begin_error, arc.end, arc.end_error, h, covered, margin);
    sure = sure && margin > 0;
    const Arc before{arc.begin, covered.begin, arc.begin_by, label, arc.begin_error, covered.error};
    const Arc after{covered.end, arc.end, label, arc.end_by, covered.error, arc.end_error};
    switch (change) {
      case geometry::kKeep: next.push_back(arc); break;
      case geometry::kCutBegin: next.push_back(after); break;
      case geometry::kCutEnd: next.push_back(before); break;
      case geometry::kSplit: next.push_back(before); next.push_back(after); break;
      case geometry::kComplement:
        next.push_back({covered.end, covered.begin, label, label, covered.error, covered.error});
        break;
      default: break;  // kRemove
    }
  }
  arcs.swap(next);
  return sure;
}

struct QuadArc {
  quad_geometry::real2 begin;
  quad_geometry::real2 end;
  std::uint32_t begin_by;
  std::uint32_t end_by;
  quad_geometry::real begin_error;
  quad_geometry::real end_error;
};

quad_geometry::real3 quad(const glm::dvec3& a) { return {a.x, a.y, a.z}; }

}  // namespace

void Contour::expose(const glm::dvec3& d, double w0, double w1, std::span<const Blocker> blockers, std::size_t skip,
                     std::span<const BlockedHalf> halves) {
  circle_ = geometry::circle_of_two_spheres(d, w0, w1);
  whole_ = false;
  arcs_.clear();
  const double barely = 1024 * geometry::kUnitRoundoff * w0;
  if (circle_.radius_squared < -barely) return;
  // Where the spheres barely meet, if they do, the sign itself needs the better arithmetic.
  if (circle_.radius_squared <= barely || !expose_in_double(w0, blockers, skip, halves)) {
    ++doubtful_count_;
    expose_in_quad(d, w0, w1, blockers, skip, halves);
  }
}

bool Contour::expose_in_double(double w0, std::span<const Blocker> blockers, std::size_t skip,
                               std::span<const BlockedHalf> halves) {
  whole_ = true;
  for (const BlockedHalf& half : halves) {
    cover(whole_, arcs_, next_, half.half_plane, half.label);
    if (!whole_ && arcs_.empty()) return true;
  }
  const double inverse_radius = 1.0 / circle_.radius;
  for (std::size_t n = 0; n < blockers.size(); ++n) {
    if (n == skip) continue;
    const Blocker& b = blockers[n];
    // Most balls miss the circle or cover all of it; one product decides that without the half-plane.
    const double qq = glm::dot(b.center, b.center);
    const double along = glm::dot(circle_.axis, b.center);
    const double offset = ((w0 + qq - b.weight) * 0.5 - circle_.height * along) * inverse_radius;
    const double clear = (qq - along * along) * (1.0 + 1e-9) + 1e-9;
    if (offset * offset > clear) {
      if (offset > 0) continue;
      whole_ = false;
      arcs_.clear();
      return true;
    }
    const geometry::HalfPlane h =
        geometry::covered_half_plane(circle_, w0, b.center, b.weight, geometry::kUnitRoundoff);
    double margin = 0;
    const int meeting = geometry::meet_circle(h, margin);
    if (margin <= 0) return false;
    if (meeting == geometry::kMisses) continue;
    if (meeting == geometry::kCovers) {
      whole_ = false;
      arcs_.clear();
      return true;
    }
    if (!cover(whole_, arcs_, next_, h, b.label)) return false;
    if (arcs_.empty()) return true;
  }
  return true;
}

void Contour::expose_in_quad(const glm::dvec3& d, double w0, double w1, std::span<const Blocker> blockers,
                             std::size_t skip, std::span<const BlockedHalf> halves) {
  namespace q = quad_geometry;
  const q::real epsilon = 0x1p-113;
  whole_ = false;
  arcs_.clear();
  // The same frame as in double, so that the half-planes given by the caller mean the same.
  q::Circle circle = q::circle_of_two_spheres(quad(d), w0, w1);
  if (!(circle.radius_squared > 0)) return;
  std::vector<QuadArc> arcs, next;
  bool whole = true;
  for (const BlockedHalf& half : halves) {
    const geometry::HalfPlane& h = half.half_plane;
    const q::HalfPlane exact{{h.normal.x, h.normal.y}, h.offset, h.length_squared, 0};
    cover(whole, arcs, next, exact, half.label);
  }
  for (std::size_t n = 0; n < blockers.size() && (whole || !arcs.empty()); ++n) {
    if (n == skip) continue;
    const q::HalfPlane h = q::covered_half_plane(circle, w0, quad(blockers[n].center), blockers[n].weight, epsilon);
    q::real margin = 0;
    const int meeting = q::meet_circle(h, margin);
    if (meeting == q::kMisses) continue;
    if (meeting == q::kCovers) return;
    cover(whole, arcs, next, h, blockers[n].label);
  }
  whole_ = whole;
  const double radius = static_cast<double>(circle.radius);
  circle_.radius = radius;
  circle_.radius_squared = radius * radius;
  for (const QuadArc& a : arcs)
    arcs_.push_back({{static_cast<double>(a.begin.x), static_cast<double>(a.begin.y)},
                     {static_cast<double>(a.end.x), static_cast<double>(a.end.y)}, a.begin_by, a.end_by, 0.0, 0.0});
}

}  // namespace meniscus
