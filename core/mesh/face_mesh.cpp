// SPDX-License-Identifier: BSD-3-Clause
// Meshes one face: maps it to the plane by stereographic or toroidal conformal coordinates, and refines a constrained
// Delaunay triangulation until it is within the tolerance.
#include "core/mesh/face_mesh.h"

#include <map>
#include <set>

#include "core/base/error.h"
#include "core/mesh/planar_triangulation.h"
#include "core/mesh/remesh_tuning.h"
#include "core/surface/walks.h"

namespace meniscus {
namespace {

/// Segments shorter than this (Å) are not halved further to untangle a rim.
constexpr double kShortestSegment = 1e-6;
constexpr int kRefinementRounds = 12;
constexpr int kPartingRounds = 32;  // greatest number of rounds that split doubled edges; one or two are usual
constexpr int kManyRimPoints = 200;
constexpr int kBoxCorners = 4;

/// The plane of a face, laid on the integer grid.
class Grid {
 public:
  explicit Grid(const std::vector<glm::dvec2>& rim) {
    low_ = high_ = rim.front();
    for (const glm::dvec2& p : rim) {
      low_ = glm::min(low_, p);
      high_ = glm::max(high_, p);
    }
    const glm::dvec2 extent = high_ - low_;
    scale_ = (double(kGridLimit) - 16.0) / std::max(0.5 * std::max(extent.x, extent.y), 1e-300);
  }
  bool covers(const glm::dvec2& p) const { return p.x > low_.x && p.y > low_.y && p.x < high_.x && p.y < high_.y; }
  /// True if the integer grid extends to the point, which may lie beyond the rim.
  bool reaches(const glm::dvec2& p) const {
    const glm::dvec2 q = glm::abs(p - 0.5 * (low_ + high_)) * scale_;
    return std::max(q.x, q.y) < double(kGridLimit);
  }
  GridPoint at(const glm::dvec2& p) const {
    const glm::dvec2 q = (p - 0.5 * (low_ + high_)) * scale_;
    return {std::llround(q.x), std::llround(q.y)};
  }

 private:
  glm::dvec2 low_{0.0}, high_{0.0};
  double scale_ = 1.0;
};

/// Triangulates a face by a constrained Delaunay triangulation of its plane.
class FaceFiller {
 public:
  FaceFiller(FaceOutline outline, double tolerance) : outline_(std::move(outline)), tolerance_(tolerance) {}

  FaceMesh run() {
    std::vector<glm::dvec2> flat;
    for (const FacePoint& p : outline_.points) flat.push_back(outline_.domain->flat(p));
    const Grid grid(flat);
    if (insert_rim(grid, flat)) {
      for (const FacePoint& p : outline_.interior) {
        const glm::dvec2 q = outline_.domain->flat(p);
        if (grid.covers(q)) insert(grid.at(q), p);
      }
      if (fill()) {
        refine(grid);
        if (too_coarse_.empty()) return extract();
      } else {
        // The chords of a rim with few points may enclose the wrong side.
        for (int e = 0; e < rim_count() && rim_count() < kManyRimPoints; ++e) request_split(e);
      }
    }
    FaceMesh failed;
    failed.too_coarse = std::move(too_coarse_);
    return failed;
  }

 private:
  int rim_count() const { return static_cast<int>(outline_.points.size()); }

  /// Inserts the rim. Rim points that fall on one grid point are set apart by a few grid steps, some 1e-8 of the face.
  /// Returns false if edges of the rim cross or meet.
  bool insert_rim(const Grid& grid, const std::vector<glm::dvec2>& flat) {
    for (int i = 0; i < rim_count(); ++i) {
      const GridPoint at = grid.at(flat[i]);
      std::optional<int> vertex;
      for (int nudge = 0; nudge < 9 && (!vertex || *vertex < kBoxCorners + i); ++nudge) {
        vertex = plane_.insert({at.x + (nudge % 3), at.y + nudge / 3});
      }
      if (*vertex < kBoxCorners + i) return false;
    }
    for (int e = 0; e < static_cast<int>(outline_.edges.size()); ++e) {
      const auto [a, b] = outline_.edges[e];
      const auto conflict = plane_.constrain(kBoxCorners + a, kBoxCorners + b, e);
      if (!conflict) continue;
      const int other = conflict->segment >= 0 && length(conflict->segment) > length(e) ? conflict->segment : e;
      request_split(other);
      is_blocked_ = true;
    }
    return !is_blocked_;
  }
  double length(int edge) const {
    return glm::distance(outline_.points[outline_.edges[edge][0]].position,
                         outline_.points[outline_.edges[edge][1]].position);
  }
  /// Requests that the border segment of a rim edge is split, unless it is too short.
  void request_split(int edge) {
    const Segment& s = outline_.segments[edge];
    if (s.border != kNone && length(edge) > kShortestSegment) too_coarse_.push_back(s);
  }

  void insert(GridPoint at, const FacePoint& point) {
    const auto vertex = plane_.insert(at);
    if (vertex && *vertex == kBoxCorners + static_cast<int>(outline_.points.size() + inner_.size())) {
      inner_.push_back(point);
    }
  }

  bool fill() {
    std::vector<std::array<int, 2>> edges;
    for (const auto& [a, b] : outline_.edges) edges.push_back({kBoxCorners + a, kBoxCorners + b});
    return plane_.fill(edges);
  }

  const FacePoint& point(int vertex) const {
    const int i = vertex - kBoxCorners;
    return i < rim_count() ? outline_.points[i] : inner_[i - rim_count()];
  }

  /// Splits the longest edge of each triangle that is too far from the surface or, if that is on the rim, the
  /// triangle's middle. Where the new point lies beyond the chord of a rim, as on spindles with contact circles that
  /// bulge in the plane, the rim is split instead.
  void refine(const Grid& grid) {
    for (int round = 0; round < kRefinementRounds; ++round) {
      std::vector<FacePoint> wanted;
      for (const auto& t : plane_.triangles()) {
        if (!t.inside) continue;
        const std::array<const FacePoint*, 3> corner{&point(t.vertex[0]), &point(t.vertex[1]), &point(t.vertex[2])};
        if (outline_.domain->deviation(*corner[0], *corner[1], *corner[2]) <= 0.95 * tolerance_) continue;
        int longest = 0;
        std::array<double, 3> size{};
        for (int k = 0; k < 3; ++k) {
          size[k] = glm::distance(corner[(k + 1) % 3]->position, corner[(k + 2) % 3]->position);
          if (size[k] > size[longest]) longest = k;
        }
        std::array<double, 3> weight{1.0 / 3, 1.0 / 3, 1.0 / 3};
        if (t.segment[longest] < 0) {
          weight = {0.5, 0.5, 0.5};
          weight[longest] = 0.0;
        }
        const FacePoint middle = outline_.domain->between(corner, weight);
        if (!outline_.domain->contains(middle)) continue;
        if (grid.reaches(outline_.domain->flat(middle)))
          wanted.push_back(middle);
        else
          for (const int edge : t.segment)
            if (edge >= 0) request_split(edge);
      }
      if (wanted.empty()) return;
      for (const FacePoint& p : wanted) insert(grid.at(outline_.domain->flat(p)), p);
    }
  }

  FaceMesh extract() {
    FaceMesh mesh;
    mesh.rim = std::move(outline_.names);
    mesh.rim_edges = std::move(outline_.edges);
    std::vector<std::uint32_t> index(outline_.points.size() + inner_.size(), kNone);
    mesh.points.reserve(index.size());
    mesh.points = outline_.points;
    mesh.triangles.reserve(
        static_cast<std::size_t>(std::ranges::count(plane_.triangles(), true, &PlanarTriangulation::Triangle::inside)));
    for (int i = 0; i < rim_count(); ++i) index[i] = i;
    auto numbered = [&](int vertex) {
      std::uint32_t& i = index[vertex - kBoxCorners];
      if (i == kNone) {
        i = static_cast<std::uint32_t>(mesh.points.size());
        mesh.points.push_back(point(vertex));
      }
      return i;
    };
    const std::uint32_t rim = static_cast<std::uint32_t>(rim_count());
    for (const auto& t : plane_.triangles()) {
      if (!t.inside) continue;
      const std::array<std::uint32_t, 3> v{numbered(t.vertex[0]), numbered(t.vertex[1]), numbered(t.vertex[2])};
      mesh.triangles.push_back(v);
      for (int k = 0; k < 3; ++k) {
        const auto a = v[(k + 1) % 3], b = v[(k + 2) % 3];
        if (t.segment[k] < 0 && a < b && b < rim) mesh.bridges.push_back({a, b});
      }
    }
    mesh.domain = std::move(outline_.domain);
    return mesh;
  }

  FaceOutline outline_;
  double tolerance_;
  PlanarTriangulation plane_;
  std::vector<FacePoint> inner_;
  std::vector<Segment> too_coarse_;
  bool is_blocked_ = false;
};

}  // namespace

FaceMesh fill_outline(FaceOutline outline, double tolerance) { return FaceFiller(std::move(outline), tolerance).run(); }

FaceMesh fan_outline(FaceOutline outline) {
  FaceMesh mesh;
  mesh.rim = std::move(outline.names);
  mesh.rim_edges = outline.edges;
  mesh.points = std::move(outline.points);
  const auto middle = static_cast<std::uint32_t>(mesh.points.size());
  const FacePoint* a = &mesh.points[0];
  const FacePoint* b = &mesh.points[mesh.points.size() / 3];
  const FacePoint* c = &mesh.points[2 * mesh.points.size() / 3];
  mesh.points.push_back(outline.domain->between({a, b, c}, {1.0 / 3, 1.0 / 3, 1.0 / 3}));
  for (const auto& [from, to] : outline.edges)
    mesh.triangles.push_back({std::uint32_t(from), std::uint32_t(to), middle});
  mesh.domain = std::move(outline.domain);
  return mesh;
}

void split_doubled_edges(FaceMesh& mesh) {
  std::vector<BorderPoint> names = mesh.rim;
  std::ranges::sort(names);
  if (std::ranges::adjacent_find(names) == names.end()) return;
  std::map<BorderPoint, std::uint32_t> first;
  std::vector<std::uint32_t> same(mesh.rim.size());
  for (std::uint32_t i = 0; i < same.size(); ++i) same[i] = first.try_emplace(mesh.rim[i], i).first->second;
  using Edge = std::pair<std::uint32_t, std::uint32_t>;
  auto ordered = [](std::uint32_t a, std::uint32_t b) { return Edge(std::min(a, b), std::max(a, b)); };
  auto named = [&](std::uint32_t v) { return v < same.size() ? same[v] : v; };
  std::set<Edge> rim;
  for (const auto& [a, b] : mesh.rim_edges) rim.insert(ordered(a, b));
  int round = 0;
  for (bool again = true; again; ++round) {
    if (round == kPartingRounds) throw OpenSurfaceError("edges of the mesh coincide; give another tolerance");
    std::map<Edge, Edge> seen;  // key: names of its ends; value: the first edge found
    for (const auto& [a, b] : rim) seen.try_emplace(ordered(named(a), named(b)), Edge(a, b));
    std::set<Edge> doubled;
    for (const auto& t : mesh.triangles) {
      for (int k = 0; k < 3; ++k) {
        const Edge edge = ordered(t[k], t[(k + 1) % 3]);
        if (rim.contains(edge)) continue;
        const auto [at, fresh] = seen.try_emplace(ordered(named(edge.first), named(edge.second)), edge);
        if (at->first.first == at->first.second || (!fresh && at->second != edge)) doubled.insert(edge);
      }
    }
    for (const auto& [a, b] : doubled) split_edge(mesh, a, b);
    again = !doubled.empty();
  }
}

void split_edge(FaceMesh& mesh, std::uint32_t a, std::uint32_t b) {
  const bool present = std::any_of(mesh.triangles.begin(), mesh.triangles.end(), [&](const auto& t) {
    return std::count(t.begin(), t.end(), a) == 1 && std::count(t.begin(), t.end(), b) == 1;
  });
  if (!present) return;
  const auto middle = static_cast<std::uint32_t>(mesh.points.size());
  mesh.points.push_back(mesh.domain->between({&mesh.points[a], &mesh.points[b], &mesh.points[b]}, {0.5, 0.5, 0.0}));
  const std::size_t count = mesh.triangles.size();
  for (std::size_t i = 0; i < count; ++i) {
    for (int k = 0; k < 3; ++k) {
      auto& t = mesh.triangles[i];
      const std::uint32_t u = t[k], w = t[(k + 1) % 3], apex = t[(k + 2) % 3];
      if (!((u == a && w == b) || (u == b && w == a))) continue;
      t = {u, middle, apex};
      mesh.triangles.push_back({middle, w, apex});
      break;
    }
  }
}

namespace {

/// The range of the share of a full turn that a spindle's half occupies in the plane. The share is that of the unrolled
/// cone at its tip, but not so large that the sides of a full turn meet, nor zero where the tube just touches the axis.
constexpr double kNarrowestOpening = 0.1;
constexpr double kWidestOpening = 0.9;
/// Keeps the radial coordinate of tubes that just touch their axis from becoming constant.
constexpr double kSmallestTip = 0.05;

/// Returns any unit vector perpendicular to a unit vector.
glm::dvec3 perpendicular(const glm::dvec3& v) {
  const glm::dvec3 other = std::abs(v.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  return glm::normalize(glm::cross(v, other));
}

}  // namespace

SphereDomain::SphereDomain(const glm::dvec3& center, double radius, std::span<const Plane> planes,
                           const glm::dvec3& pole, bool inwards)
    : center_(center), pole_(pole), right_(perpendicular(pole)), planes_(planes), radius_(radius), inwards_(inwards) {
  // Opposite the pole the outward normal is -pole; (right, up, normal) must be right-handed.
  up_ = inwards ? glm::cross(pole, right_) : glm::cross(right_, pole);
}

glm::dvec2 SphereDomain::flat(const FacePoint& point) const {
  const glm::dvec3 u = (point.position - center_) / radius_;
  const double below = 1.0 - glm::dot(u, pole_);
  return {glm::dot(u, right_) / below, glm::dot(u, up_) / below};
}

bool SphereDomain::contains(const FacePoint& point) const {
  return std::all_of(planes_.begin(), planes_.end(),
                     [&](const Plane& plane) { return glm::dot(plane.normal, point.position) <= plane.offset; });
}

FacePoint SphereDomain::between(const std::array<const FacePoint*, 3>& points,
                                const std::array<double, 3>& weights) const {
  glm::dvec3 sum(0.0);
  for (int k = 0; k < 3; ++k) sum += weights[k] * (points[k]->position - center_);
  return at(glm::normalize(sum));
}

double SphereDomain::deviation(const FacePoint& a, const FacePoint& b, const FacePoint& c) const {
  // The point of the triangle nearest to the centre is the foot of the perpendicular, the triangle's circumcentre,
  // or, if that lies outside, the middle of the longest edge.
  std::array<double, 3> edge{glm::distance(a.position, b.position), glm::distance(b.position, c.position),
                             glm::distance(c.position, a.position)};
  std::sort(edge.begin(), edge.end());
  const auto [s0, s1, s2] = edge;
  double half = 0.5 * s2;
  if (s0 * s0 + s1 * s1 > s2 * s2) {
    const double twice_area = glm::length(glm::cross(b.position - a.position, c.position - a.position));
    half = s0 * s1 * s2 / (2.0 * twice_area);
  }
  return half >= radius_ ? radius_ : half * half / (radius_ + std::sqrt(radius_ * radius_ - half * half));
}

glm::dvec3 SphereDomain::normal(const FacePoint& point) const {
  const glm::dvec3 u = glm::normalize(point.position - center_);
  return inwards_ ? -u : u;
}

TorusDomain::TorusDomain(const ToroidalPatch& patch, double tube_radius, int piece)
    : patch_(patch),
      tube_radius_(tube_radius),
      piece_(piece),
      is_spindle_(patch.face_count == 2 || !patch.has_piece[0] || !patch.has_piece[1]) {
  if (patch.radius <= tube_radius) {
    tip_ = std::acos(patch.radius / tube_radius);
    tan_tip_ = std::sqrt((tube_radius - patch.radius) / (tube_radius + patch.radius));
  }
}

double TorusDomain::axis_distance(double tube) const { return patch_.radius - tube_radius_ * std::cos(tube); }

FacePoint TorusDomain::at(double theta, double tube) const {
  const glm::dvec3 radial = arc_direction(patch_, theta);
  return {patch_.center + axis_distance(tube) * radial + tube_radius_ * std::sin(tube) * patch_.axis, {theta, tube}};
}

glm::dvec2 TorusDomain::flat(const FacePoint& point) const {
  const double theta = point.angles.x, half_tan = std::tan(0.5 * point.angles.y);
  if (tube_radius_ == 0.0) return point.angles;  // a saddle without width: any map will do
  // d(height) = p d(tube) / (distance from the axis), integrated in closed form.
  if (!is_spindle_ && tip_ > 0.0) {
    const double t = std::abs(half_tan), height = std::log((t - tan_tip_) / (t + tan_tip_)) / std::sin(tip_);
    return {theta, half_tan < 0.0 ? -height : height};
  }
  if (!is_spindle_) {
    const double ratio = std::max(patch_.radius / tube_radius_, 1.0 + 1e-9);
    const double root = std::sqrt((ratio - 1.0) * (ratio + 1.0));
    return {theta, 2.0 / root * std::atan(std::sqrt((ratio + 1.0) / (ratio - 1.0)) * half_tan)};
  }
  const double t = std::max(std::abs(half_tan), tan_tip_);
  const double r = (t - tan_tip_) / (t + std::max(tan_tip_, kSmallestTip));
  const double opening = std::clamp(std::sin(tip_), kNarrowestOpening, kWidestOpening);
  const double angle = (piece_ == 0 ? opening : -opening) * (theta - 0.5 * patch_.sweep);
  return {r * std::cos(angle), r * std::sin(angle)};
}

FacePoint TorusDomain::between(const std::array<const FacePoint*, 3>& points,
                               const std::array<double, 3>& weights) const {
  // The tip of a spindle has every theta, so only the other points determine it.
  double theta = 0.0, tube = 0.0, share = 0.0;
  for (int k = 0; k < 3; ++k) {
    tube += weights[k] * points[k]->angles.y;
    if (weights[k] == 0.0 || (is_spindle_ && points[k]->angles.y == tip_angle())) continue;
    theta += weights[k] * points[k]->angles.x;
    share += weights[k];
  }
  return at(share > 0.0 ? theta / share : 0.0, tube);
}

double TorusDomain::deviation(const FacePoint& a, const FacePoint& b, const FacePoint& c) const {
  double worst = 0.0;
  for (const auto& w : RemeshTuning::sample_weights) {
    const glm::dvec3 x = w[0] * a.position + w[1] * b.position + w[2] * c.position - patch_.center;
    const double height = glm::dot(x, patch_.axis);
    const double out = glm::length(x - height * patch_.axis) - patch_.radius;
    worst = std::max(worst, std::abs(std::sqrt(out * out + height * height) - tube_radius_));
  }
  return worst;
}

glm::dvec3 TorusDomain::normal(const FacePoint& point) const {
  const double theta = point.angles.x, tube = point.angles.y;
  const glm::dvec3 radial = arc_direction(patch_, theta);
  return glm::normalize(std::cos(tube) * radial - std::sin(tube) * patch_.axis);
}

glm::dvec3 TorusDomain::corner_normal(const FacePoint& point, const FacePoint& next, const FacePoint& last) const {
  if (!is_spindle_ || point.angles.y != tip_angle()) return normal(point);
  return normal({point.position, {0.5 * (next.angles.x + last.angles.x), point.angles.y}});
}

namespace {

std::array<glm::dvec3, 12> icosahedron() {
  const double g = (1.0 + std::sqrt(5.0)) / 2.0;
  std::array<glm::dvec3, 12> v{{{-1, g, 0},
                                {1, g, 0},
                                {-1, -g, 0},
                                {1, -g, 0},
                                {0, -1, g},
                                {0, 1, g},
                                {0, -1, -g},
                                {0, 1, -g},
                                {g, 0, -1},
                                {g, 0, 1},
                                {-g, 0, -1},
                                {-g, 0, 1}}};
  for (auto& p : v) p = glm::normalize(p);
  return v;
}

constexpr std::array<std::array<int, 3>, 20> kSides{{{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                                                     {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                                                     {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                                                     {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}}};

}  // namespace

int lattice_frequency(double angle) {
  // The longest of n equal parts of a flat edge, seen from the centre, lies in the middle of a side: its half chord is
  // half the edge / n at the inradius of the icosahedron.
  const double edge = 2.0 / std::sqrt(std::pow((1.0 + std::sqrt(5.0)) / 2.0, 2) + 1.0);
  const double inradius = 0.7946544722917661;
  const double half = std::tan(std::min(angle, 1.2) / 2.0) * inradius;
  return std::max(1, static_cast<int>(std::ceil(edge / (2.0 * half))));
}

SphereLattice sphere_lattice(int frequency) {
  const auto corner = icosahedron();
  SphereLattice lattice;
  // A lattice point is identified by its barycentric weights at the named corners, so that sides share their rims.
  std::map<std::array<int, 6>, std::uint32_t> known;
  auto point = [&](const std::array<int, 3>& side, int a, int b, int c) {
    std::array<std::array<int, 2>, 3> part{{{side[0], a}, {side[1], b}, {side[2], c}}};
    for (auto& w : part) {
      if (w[1] == 0) w[0] = -1;
    }
    std::sort(part.begin(), part.end());
    const std::array<int, 6> name{part[0][0], part[0][1], part[1][0], part[1][1], part[2][0], part[2][1]};
    const auto [at, fresh] = known.try_emplace(name, static_cast<std::uint32_t>(lattice.directions.size()));
    if (fresh) {
      glm::dvec3 sum(0.0);
      for (const auto& w : part) sum += w[1] ? double(w[1]) * corner[w[0]] : glm::dvec3(0.0);
      lattice.directions.push_back(glm::normalize(sum));
    }
    return at->second;
  };
  const int n = frequency;
  for (const auto& side : kSides) {
    for (int i = 0; i < n; ++i) {
      for (int j = 0; i + j < n; ++j) {
        const int k = n - i - j;
        lattice.triangles.push_back({point(side, k, i, j), point(side, k - 1, i + 1, j), point(side, k - 1, i, j + 1)});
        if (k >= 2) {
          lattice.triangles.push_back(
              {point(side, k - 1, i + 1, j), point(side, k - 2, i + 1, j + 1), point(side, k - 1, i, j + 1)});
        }
      }
    }
  }
  return lattice;
}

}  // namespace meniscus
