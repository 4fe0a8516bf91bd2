// SPDX-License-Identifier: BSD-3-Clause
// Outlines faces on spheres and tori in the plane where they are meshed.

#include <map>
#include <numbers>

#include "core/mesh/face_mesh.h"
#include "core/mesh/mesh_colors.h"
#include "core/surface/walks.h"

namespace meniscus {
namespace {

struct Sphere {
  glm::dvec3 center;
  double radius;
  std::span<const Plane> planes;
};

Sphere sphere_of(const Surface& surface, const Face& face) {
  if (face.kind == PatchKind::convex) {
    const ConvexPatch& patch = surface.convex[face.patch];
    const Ball& ball = surface.atoms[patch.atom];
    return {ball.center, ball.radius, {surface.planes.data() + patch.first_plane, patch.plane_count}};
  }
  const ConcavePatch& patch = surface.concave[face.patch];
  return {patch.center, surface.probe_radius, {surface.planes.data() + patch.first_plane, patch.plane_count()}};
}

/// Returns the direction outside the patch that is farthest from the rim: the middle of a cap that a plane cuts off, or
/// the direction opposite to the rim.
glm::dvec3 projection_pole(const Sphere& sphere, const std::vector<FacePoint>& rim) {
  std::vector<glm::dvec3> candidates;
  for (const Plane& plane : sphere.planes) candidates.push_back(plane.normal);
  glm::dvec3 middle(0.0);
  for (const FacePoint& p : rim) middle += p.position - sphere.center;
  if (glm::length(middle) > 1e-9) candidates.push_back(-glm::normalize(middle));
  glm::dvec3 best = candidates.front();
  double best_cosine = 2.0;
  for (const glm::dvec3& u : candidates) {
    const glm::dvec3 x = sphere.center + sphere.radius * u;
    const bool outside = std::any_of(sphere.planes.begin(), sphere.planes.end(),
                                     [&](const Plane& plane) { return glm::dot(plane.normal, x) > plane.offset; });
    if (!outside) continue;
    double cosine = -1.0;
    for (const FacePoint& p : rim) cosine = std::max(cosine, glm::dot(u, p.position - sphere.center) / sphere.radius);
    if (cosine < best_cosine) {
      best_cosine = cosine;
      best = u;
    }
  }
  return best;
}

/// Returns the lattice directions inside all planes, at least `margin` radian from their circles.
std::vector<glm::dvec3> directions_inside(const Sphere& sphere, const SphereLattice& lattice, double margin) {
  std::vector<double> limit;
  for (const Plane& plane : sphere.planes) {
    const double cosine = (plane.offset - glm::dot(plane.normal, sphere.center)) / sphere.radius;
    const double angle = std::acos(std::clamp(cosine, -1.0, 1.0)) + margin;
    limit.push_back(angle >= 3.14159 ? -2.0 : std::cos(angle));
  }
  std::vector<glm::dvec3> inside;
  for (const glm::dvec3& u : lattice.directions) {
    bool in = true;
    for (std::size_t i = 0; in && i < limit.size(); ++i) in = glm::dot(sphere.planes[i].normal, u) <= limit[i];
    if (in) inside.push_back(u);
  }
  return inside;
}

}  // namespace

FaceOutline sphere_outline(const Surface& surface, const Face& face, const BorderSamples& samples,
                           const SphereLattice& lattice, double edge) {
  FaceOutline outline;
  std::map<BorderPoint, int> known;
  auto rim_point = [&](std::uint32_t border, std::uint32_t k) {
    const BorderPoint name = samples.point(border, k);
    const auto [at, fresh] = known.try_emplace(name, static_cast<int>(outline.points.size()));
    if (fresh) {
      outline.points.push_back({samples.position(name), {}});
      outline.names.push_back(name);
    }
    return at->second;
  };
  for (const Loop& loop : loops_of(surface, face)) {
    const std::size_t before = outline.edges.size();
    for (const HalfBorder half : half_borders_of(surface, loop)) {
      const std::uint32_t border = border_of(half), n = samples.segment_count(border);
      for (std::uint32_t k = 0; k < n; ++k) {
        const std::uint32_t from = is_backwards(half) ? n - k : k, to = is_backwards(half) ? n - k - 1 : k + 1;
        outline.edges.push_back({rim_point(border, from), rim_point(border, to)});
        outline.segments.push_back({border, std::min(from, to)});
      }
    }
    outline.loop_count += outline.edges.size() > before;
  }
  const Sphere sphere = sphere_of(surface, face);
  auto domain =
      std::make_unique<SphereDomain>(sphere.center, sphere.radius, sphere.planes,
                                     projection_pole(sphere, outline.points), face.kind == PatchKind::concave);
  for (const glm::dvec3& u : directions_inside(sphere, lattice, 0.55 * edge / sphere.radius)) {
    outline.interior.push_back(domain->at(u));
  }
  outline.domain = std::move(domain);
  return outline;
}

FaceMesh whole_sphere(const Surface& surface, const Face& face, const SphereLattice& lattice) {
  const Sphere sphere = sphere_of(surface, face);
  const bool inwards = face.kind == PatchKind::concave;
  auto domain =
      std::make_unique<SphereDomain>(sphere.center, sphere.radius, sphere.planes, glm::dvec3(0, 0, 1), inwards);
  FaceMesh mesh;
  for (const glm::dvec3& u : lattice.directions) mesh.points.push_back(domain->at(u));
  mesh.triangles = lattice.triangles;
  if (inwards) {
    for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
  }
  mesh.domain = std::move(domain);
  return mesh;
}

namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

// Rounds up to whole parts. A row on the axis has no length, and the quotient of that and its step is not a number: it
// has no parts.
int whole_parts(double parts) { return parts < 1e6 ? static_cast<int>(std::ceil(parts)) : 0; }

/// Collects the rim of a torus face in walking order; each visit of a point adds a point.
class TorusRim {
 public:
  TorusRim(const Surface& surface, const Face& face, const BorderSamples& samples, const EdgeRule& rule)
      : surface_(surface),
        face_(face),
        patch_(surface.toroidal[face.patch]),
        samples_(samples),
        rule_(rule),
        angles_(contact_angles(surface, patch_)),
        piece_(patch_.piece(static_cast<std::uint32_t>(&face - &surface.faces[patch_.first_face]))),
        domain_(std::make_unique<TorusDomain>(patch_, surface.probe_radius, piece_)) {}

  FaceOutline build() {
    if (!patch_.free()) {
      walk_strip();
    } else if (domain_->is_spindle()) {
      walk_drop();
    } else {
      walk_ring();
    }
    add_interior();
    outline_.loop_count = 1;
    outline_.domain = std::move(domain_);
    return std::move(outline_);
  }

 private:
  /// A border and the direction in which the rim traverses it.
  struct Half {
    std::uint32_t border;
    bool backwards;
  };
  std::vector<Half> loop(std::uint32_t l) const {
    std::vector<Half> halves;
    for (const HalfBorder half : half_borders_of(surface_, loops_of(surface_, face_)[l]))
      halves.push_back({border_of(half), is_backwards(half)});
    return halves;
  }

  void add(const BorderPoint& name, const FacePoint& point, Segment segment) {
    outline_.names.push_back(name);
    outline_.points.push_back(point);
    outline_.segments.push_back(segment);
  }
  void close() {
    const int n = static_cast<int>(outline_.points.size());
    for (int i = 0; i < n; ++i) outline_.edges.push_back({i, (i + 1) % n});
  }

  bool is_contact(const Half& half) const { return surface_.borders[half.border].kind == BorderKind::contact; }
  bool runs_with_axis(std::uint32_t border) const { return glm::dot(surface_.borders[border].axis, patch_.axis) > 0.0; }
  /// Returns the tube angle of a contact circle: that of the nearer atom's contact.
  double contact_tube(std::uint32_t border) const {
    const double tube = tube_angle(patch_, arc_point(surface_.borders[border], 0.0));
    return std::abs(tube - angles_[0]) < std::abs(tube - angles_[1]) ? angles_[0] : angles_[1];
  }
  /// Returns theta along a contact arc of a strip, which spans the whole sweep.
  double strip_theta(std::uint32_t border, double t) const {
    const double share = t / surface_.borders[border].sweep;
    return patch_.sweep * (runs_with_axis(border) ? share : 1.0 - share);
  }
  /// Returns theta at the start or the end of a contact arc of a strip.
  double end_theta(const Half& half, bool at_end) const {
    const bool far = half.backwards != at_end;
    return strip_theta(half.border, far ? surface_.borders[half.border].sweep : 0.0);
  }

  /// Collects the rim of a patch between two fixed probes, or of a part of it.
  void walk_strip() {
    const auto halves = loop(0);
    const std::size_t count = halves.size();
    double theta = 0.0;
    for (std::size_t h = 0; h < count; ++h) {
      const Half& half = halves[h];
      const Half& before = halves[(h + count - 1) % count];
      const Half& after = halves[(h + 1) % count];
      const std::uint32_t n = samples_.segment_count(half.border);
      if (!is_contact(half)) {
        if (is_contact(before)) {
          theta = end_theta(before, true);
        } else if (is_contact(after)) {
          theta = end_theta(after, false);
        }
      }
      for (std::uint32_t k = 0; k < n; ++k) {
        const std::uint32_t from = half.backwards ? n - k : k, to = half.backwards ? n - k - 1 : k + 1;
        const BorderPoint name = samples_.point(half.border, from);
        FacePoint point{samples_.position(name), {}};
        if (is_contact(half)) {
          point.angles = {strip_theta(half.border, samples_.parameter(half.border, from)), contact_tube(half.border)};
        } else {
          point.angles = {theta, tube_angle(patch_, point.position)};
          if (k == 0 && is_contact(before)) point.angles.y = contact_tube(before.border);
          if (k == 0 && !is_contact(before) && domain_->is_spindle()) point.angles.y = domain_->tip_angle();
        }
        add(name, point, {half.border, std::min(from, to)});
      }
    }
    close();
    for (const FacePoint& p : outline_.points) widen(p.angles.y);
    seam_ = {glm::dvec2(0.0, low_), glm::dvec2(0.0, high_)};
  }
  void widen(double tube) {
    low_ = std::min(low_, tube);
    high_ = std::max(high_, tube);
  }

  /// A sample on a contact circle.
  struct Sample {
    BorderPoint name;
    FacePoint point;
    Segment segment;  ///< the segment between this and the next sample, in walking order
  };
  /// Returns a full contact circle in walking order, from the sample nearest to `near_theta`, with falling or rising
  /// theta; the first point is repeated at the end.
  std::vector<Sample> circle(const Half& half, double near_theta) const {
    const Border& border = surface_.borders[half.border];
    const std::uint32_t n = samples_.segment_count(half.border);
    const bool rising = runs_with_axis(half.border) != half.backwards;
    const double tube = contact_tube(half.border);
    const glm::dvec3 side = glm::cross(patch_.axis, patch_.start);
    const double start = std::atan2(glm::dot(border.start, side), glm::dot(border.start, patch_.start));
    auto theta = [&](std::uint32_t k) {
      const double t = samples_.parameter(half.border, k);
      return start + (runs_with_axis(half.border) ? t : -t);
    };
    auto apart = [&](std::uint32_t k) { return std::remainder(theta(k) - near_theta, kTurn); };
    std::uint32_t first = 0;
    for (std::uint32_t k = 1; k < n; ++k) {
      if (std::abs(apart(k)) < std::abs(apart(first))) first = k;
    }
    const double low = near_theta + apart(first);
    std::vector<Sample> samples;
    for (std::uint32_t i = 0; i <= n; ++i) {
      const std::uint32_t k = half.backwards ? (first + n - i % n) % n : (first + i) % n;
      double angle = low + std::remainder(theta(k) - low, kTurn);
      if (angle < low - 1e-9) angle += kTurn;
      if (i == 0) angle = rising ? low : low + kTurn;
      if (i == n) angle = rising ? low + kTurn : low;
      const BorderPoint name = samples_.point(half.border, k);
      samples.push_back(
          {name, {samples_.position(name), {angle, tube}}, {half.border, half.backwards ? (k + n - 1) % n : k}});
    }
    return samples;
  }
  /// Adds the inner points of the seam from a to b at the given shares of the way; a seam's sides have the same names.
  void add_seam(glm::dvec2 a, glm::dvec2 b, const std::vector<double>& shares) {
    for (std::uint32_t i = 0; i < shares.size(); ++i) {
      const glm::dvec2 angles = a + (b - a) * shares[i];
      add({kSeam, i}, domain_->at(angles.x, angles.y), {});
    }
  }
  /// Adds the same points on the way back.
  void add_seam_back(glm::dvec2 a, glm::dvec2 b, const std::vector<double>& shares) {
    for (auto i = static_cast<std::uint32_t>(shares.size()); i-- > 0;) {
      const glm::dvec2 angles = a + (b - a) * shares[i];
      add({kSeam, i}, domain_->at(angles.x, angles.y), {});
    }
  }
  /// Returns the shares of a seam's inner points: at most an edge apart, and one where the nearest contact changes.
  std::vector<double> seam_shares(double from, double to) const {
    const double step = rule_.edge(surface_.probe_radius);
    const double change = (0.5 * (angles_[0] + angles_[1]) - from) / (to - from);
    std::vector<double> stops{0.0};
    if (change > 0.01 && change < 0.99) stops.push_back(change);
    stops.push_back(1.0);
    std::vector<double> shares;
    for (std::size_t s = 0; s + 1 < stops.size(); ++s) {
      const double span = stops[s + 1] - stops[s];
      const int parts =
          std::max(2, static_cast<int>(std::ceil(surface_.probe_radius * std::abs(to - from) * span / step)));
      for (int k = s == 0 ? 1 : 0; k < parts; ++k) shares.push_back(stops[s] + span * k / parts);
    }
    return shares;
  }

  /// Collects the rim of a ring, which is cut open along a seam.
  void walk_ring() {
    Half bottom = loop(0).front(), top = loop(1).front();
    if (contact_tube(bottom.border) > contact_tube(top.border)) std::swap(bottom, top);
    const auto below = circle(bottom, 0.0);
    const auto above = circle(top, below.front().point.angles.x);
    const glm::dvec2 low = below.front().point.angles, high = above.back().point.angles, turn(kTurn, 0.0);
    const auto shares = seam_shares(low.y, high.y);
    for (std::size_t i = 0; i < below.size(); ++i) {
      add(below[i].name, below[i].point, i + 1 < below.size() ? below[i].segment : Segment{});
    }
    add_seam(low + turn, high + turn, shares);
    for (std::size_t i = 0; i < above.size(); ++i) {
      add(above[i].name, above[i].point, i + 1 < above.size() ? above[i].segment : Segment{});
    }
    add_seam_back(low, high, shares);
    close();
    low_ = low.y;
    high_ = high.y;
    rows_ = shares;
    seam_ = {low, high};
  }

  /// Collects the rim of half a free spindle: a drop around its tip, cut open along a seam.
  void walk_drop() {
    const auto rim = circle(loop(0).front(), 0.0);
    const double tip = domain_->tip_angle();
    const glm::dvec2 first = rim.front().point.angles, last = rim.back().point.angles;
    const auto shares = seam_shares(first.y, tip);
    for (std::size_t i = 0; i < rim.size(); ++i) {
      add(rim[i].name, rim[i].point, i + 1 < rim.size() ? rim[i].segment : Segment{});
    }
    add_seam(last, {last.x, tip}, shares);
    add({kNone, samples_.representative(face_.tip)}, {surface_.vertices[face_.tip], {0.5 * (first.x + last.x), tip}},
        {});
    add_seam_back(first, {first.x, tip}, shares);
    close();
    low_ = std::min(first.y, tip);
    high_ = std::max(first.y, tip);
    const double theta = std::min(first.x, last.x);
    for (const double share : shares) rows_.push_back(first.y < tip ? share : 1.0 - share);
    seam_ = {glm::dvec2(theta, low_), glm::dvec2(theta, high_)};
  }

  /// Adds interior points in rows along the tube.
  void add_interior() {
    const double p = surface_.probe_radius, edge = rule_.edge(p);
    if (!patch_.free()) {
      const int rows = whole_parts(p * (high_ - low_) / edge);
      for (int i = 1; i < rows; ++i) rows_.push_back(double(i) / rows);
    }
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      const double share = rows_[i], tube = low_ + (high_ - low_) * share;
      const double distance = domain_->axis_distance(tube);
      const double along = rule_.edge(distance / std::max(std::cos(tube), 1e-3));
      const double across = rule_.is_strip(p) ? along : std::min(edge, along);
      const double start = seam_[0].x + (seam_[1].x - seam_[0].x) * share;
      const int columns = whole_parts(std::max(patch_.sweep * distance / across, patch_.sweep / rule_.largest_angle()));
      if (columns < 2) continue;
      const double shift = i % 2 ? 0.5 : 0.0;  // rows are staggered
      for (int k = 0; k < columns; ++k) {
        if (k + shift == 0.0) continue;
        outline_.interior.push_back(domain_->at(start + patch_.sweep * (k + shift) / columns, tube));
      }
    }
  }

  const Surface& surface_;
  const Face& face_;
  const ToroidalPatch& patch_;
  const BorderSamples& samples_;
  EdgeRule rule_;
  std::array<double, 2> angles_;
  int piece_;
  std::unique_ptr<TorusDomain> domain_;
  FaceOutline outline_;
  double low_ = 10.0, high_ = -10.0;  ///< range of the tube angle
  /// The places of rows of inner points, as shares of that range. The rows of a face with a seam go through the seam's
  /// points, so that no edge can join the two sides of the seam.
  std::vector<double> rows_;
  std::array<glm::dvec2, 2> seam_{};  ///< the left side of the seam, from low to high tube angle
};

}  // namespace

FaceOutline torus_outline(const Surface& surface, const Face& face, const BorderSamples& samples,
                          const EdgeRule& rule) {
  return TorusRim(surface, face, samples, rule).build();
}

}  // namespace meniscus
