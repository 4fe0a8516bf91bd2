// SPDX-License-Identifier: BSD-3-Clause
// Finds the nearest point of a surface among feet of perpendiculars, and the blocks of voxels near the surface.
#include "core/queries/distance.h"

#include <bit>
#include <numbers>

#include <tbb/parallel_for.h>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/math/ball.h"
#include "core/math/box.h"
#include "core/surface/measure.h"
#include "core/surface/primitives.h"

namespace meniscus {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();

/// The nearest foot so far.
struct Foot {
  double distance = kFar;
  glm::dvec3 point{0.0};

  void take(double other, const glm::dvec3& at) {
    if (other < distance) *this = {other, at};
  }
};

Box box_of_ball(const glm::dvec3& center, double radius) { return {center - radius, center + radius}; }

/// Returns the box of a circle and of all that is within `margin` of it.
Box box_of_circle(const glm::dvec3& center, const glm::dvec3& axis, double radius, double margin) {
  const glm::dvec3 half = radius * glm::sqrt(glm::max(1.0 - axis * axis, glm::dvec3(0.0))) + margin;
  return {center - half, center + half};
}

/// A point in the cylindrical coordinates of a circle (Å): along its axis, and away from it.
struct CylindricalPoint {
  double along, away;
  glm::dvec3 outward;  ///< unit, across the axis; on the axis itself any direction does, and it is `start`
};

/// Returns the cylindrical coordinates of x. Close to the axis, the part of x across it is a difference of nearly equal
/// numbers, with a rounding error that points anywhere, along the axis, too. It is therefore projected across the axis
/// once more. If that leaves less than half of it, it was rounding error alone.
CylindricalPoint cylindrical_point(const glm::dvec3& x, const glm::dvec3& center, const glm::dvec3& axis,
                                   const glm::dvec3& start) {
  const glm::dvec3 from_center = x - center;
  const double along = glm::dot(from_center, axis);
  const glm::dvec3 across = from_center - along * axis;
  const double away = glm::length(across);
  if (away > 1e-3 * std::abs(along)) return {along, away, across / away};
  const glm::dvec3 again = across - glm::dot(across, axis) * axis;
  const double left = glm::length(again);
  if (!(left > 0.5 * away)) return {along, 0.0, start};
  return {along, left, again / left};
}

/// True if the arc that begins at `start` and turns counter-clockwise by `sweep` passes the direction.
bool passes(const glm::dvec3& direction, const glm::dvec3& axis, const glm::dvec3& start, double sweep) {
  const double angle = std::atan2(glm::dot(direction, glm::cross(axis, start)), glm::dot(direction, start));
  return (angle < 0.0 ? angle + 2 * std::numbers::pi : angle) <= sweep;
}

/// True if x is inside of these planes.
bool inside(const Surface& s, const glm::dvec3& x, std::uint32_t first, std::uint32_t count) {
  return std::all_of(s.planes.begin() + first, s.planes.begin() + first + count,
                     [&](const Plane& plane) { return glm::dot(plane.normal, x) <= plane.offset; });
}

/// Returns the foot of x on the sphere of this radius about a convex patch's atom, if it is nearer than `limit` and on
/// the patch. The radius is that of the atom or its SAS radius; seen from the atom both show the same part.
Foot foot_on(const Surface& s, const ConvexPatch& patch, double radius, const glm::dvec3& x, double limit) {
  const Ball& atom = s.atoms[patch.atom];
  const glm::dvec3 out = x - atom.center;
  const double length = glm::length(out), distance = std::abs(length - radius);
  if (!(distance < limit)) return {};
  // From the centre all directions are as good; if this one is covered, the borders are as near.
  const glm::dvec3 direction = length > 0.0 ? out / length : glm::dvec3(0.0, 0.0, 1.0);
  if (!inside(s, atom.center + atom.radius * direction, patch.first_plane, patch.plane_count)) return {};
  return {distance, atom.center + radius * direction};
}

/// Returns the foot of x on a concave patch. There is none from the probe's centre: borders are as near.
Foot foot_on(const Surface& s, const ConcavePatch& patch, const glm::dvec3& x, double limit) {
  const glm::dvec3 out = x - patch.center;
  const double length = glm::length(out), distance = std::abs(length - s.probe_radius);
  if (!(distance < limit) || !(length > 0.0)) return {};
  const glm::dvec3 foot = patch.center + out * (s.probe_radius / length);
  return inside(s, foot, patch.first_plane, patch.plane_count()) ? Foot{distance, foot} : Foot{};
}

/// Returns the foot of x on a toroidal patch, in the half-plane of x on its side of the torus' circle. The rest of the
/// tube does not cross the axis, so along either circle through the foot other points are farther. From a place of the
/// probe's centre all of the tube is equally far, and its borders are as near.
Foot foot_on(const Surface& s, const ToroidalPatch& t, const glm::dvec3& x, double limit) {
  const CylindricalPoint at = cylindrical_point(x, t.center, t.axis, t.start);
  const double across = at.away - t.radius, length = std::sqrt(across * across + at.along * at.along);
  const double distance = std::abs(length - s.probe_radius);
  if (!(distance < limit) || !(length > 0.0) || (!t.free() && !passes(at.outward, t.axis, t.start, t.sweep))) return {};
  const double angle = std::atan2(at.along, -across);
  for (std::uint32_t n = 0; n < t.face_count; ++n) {
    const auto [low, high] = tube_range(s, t, n);
    if (!(angle >= low && angle <= high)) continue;
    return {distance,
            t.center + t.radius * at.outward + (s.probe_radius / length) * (across * at.outward + at.along * t.axis)};
  }
  return {};
}

/// Returns the foot of x on an arc without its ends, or on a `whole` circle. `turning` is a Border, or the path of a
/// rolling probe.
template <typename Turning>
Foot foot_on_arc(const Turning& turning, bool whole, const glm::dvec3& x, double limit) {
  const CylindricalPoint at = cylindrical_point(x, turning.center, turning.axis, turning.start);
  const double across = at.away - turning.radius, distance = std::sqrt(across * across + at.along * at.along);
  if (!(distance < limit)) return {};
  if (!whole && !passes(at.outward, turning.axis, turning.start, turning.sweep)) return {};
  return {distance, turning.center + turning.radius * at.outward};
}

Foot at_point(const glm::dvec3& point, const glm::dvec3& x) { return {glm::distance(x, point), point}; }

/// Boxes around the rows of several tables, table by table.
template <std::size_t kTables>
struct Tables {
  std::array<std::uint32_t, kTables + 1> first{};
  std::vector<Box> boxes;

  void end(std::size_t table) { first[table + 1] = static_cast<std::uint32_t>(boxes.size()); }
};

/// The extent of a search for feet. The nearest foot within `limit` is searched for; `wanted` returns, for the nearest
/// foot so far, how near another one has to be to count.
template <typename Wanted>
struct Search {
  double limit;
  Wanted wanted;
};
template <typename Wanted>
Search(double, Wanted) -> Search<Wanted>;

/// Searches for the nearest foot of all.
struct Nearest {
  double operator()(const Foot& nearest) const { return nearest.distance; }
};

/// Returns the nearest foot of x on the objects in a tree's boxes, as far as the search extends. `foot_of` has one
/// function for each table, of an index into the table and of the distance beyond which no foot is wanted.
template <typename Wanted, typename... FootOf>
Foot nearest_foot(const glm::dvec3& x, const Search<Wanted>& search, const BoxTree& tree,
                  const Tables<sizeof...(FootOf)>& tables, const FootOf&... foot_of) {
  Foot nearest;
  tree.nearest(x, search.limit, [&](std::uint32_t n, double limit) {
    std::size_t table = 0;
    const auto visit = [&](const auto& foot_of_table) {
      if (n >= tables.first[table] && n < tables.first[table + 1]) {
        const Foot foot = foot_of_table(n - tables.first[table], limit);
        nearest.take(foot.distance, foot.point);
      }
      ++table;
    };
    (visit(foot_of), ...);
    return std::min(limit, search.wanted(nearest));
  });
  return nearest;
}

}  // namespace

struct SurfaceDistance::Index {
  explicit Index(const Surface& surface)
      : s(surface),
        reach(find_reach()),
        balls(s.atoms, reach),
        accessible(list_accessible()),
        accessible_tree(accessible.boxes),
        parts(list_parts()),
        part_tree(parts.boxes) {}

  /// Returns the largest SAS radius, except for a few that are far larger than all others; `large` lists their atoms.
  double find_reach() {
    constexpr std::size_t kFew = 64;
    constexpr double kFarLarger = 4.0;
    std::vector<double> radii;
    for (const Ball& atom : s.atoms) radii.push_back(atom.radius + s.probe_radius);
    if (radii.empty()) return s.probe_radius;
    std::ranges::sort(radii);
    const double next = radii.size() > kFew ? radii[radii.size() - 1 - kFew] : radii.back();
    if (radii.back() <= kFarLarger * next) return radii.back();
    for (std::uint32_t a = 0; a < s.atoms.size(); ++a)
      if (s.atoms[a].radius + s.probe_radius > next) large.push_back(a);
    return next;
  }

  // Returns the boxes of the places of a probe that touches one atom, two, or three.
  Tables<3> list_accessible() const {
    Tables<3> t;
    for (const ConvexPatch& patch : s.convex)
      t.boxes.push_back(box_of_ball(s.atoms[patch.atom].center, s.atoms[patch.atom].radius + s.probe_radius));
    t.end(0);
    for (const ToroidalPatch& patch : s.toroidal)
      t.boxes.push_back(box_of_circle(patch.center, patch.axis, patch.radius, 0.0));
    t.end(1);
    for (const ConcavePatch& patch : s.concave) t.boxes.push_back({patch.center, patch.center});
    t.end(2);
    return t;
  }

  /// Returns the boxes of the patches, borders and vertices of the surface.
  Tables<5> list_parts() const {
    Tables<5> t;
    for (const ConvexPatch& patch : s.convex)
      t.boxes.push_back(box_of_ball(s.atoms[patch.atom].center, s.atoms[patch.atom].radius));
    t.end(0);
    for (const ToroidalPatch& patch : s.toroidal)
      t.boxes.push_back(box_of_circle(patch.center, patch.axis, patch.radius, s.probe_radius));
    t.end(1);
    for (const ConcavePatch& patch : s.concave) t.boxes.push_back(box_of_ball(patch.center, s.probe_radius));
    t.end(2);
    for (const Border& border : s.borders)
      t.boxes.push_back(box_of_circle(border.center, border.axis, border.radius, 0.0));
    t.end(3);
    for (const glm::dvec3& vertex : s.vertices) t.boxes.push_back({vertex, vertex});
    t.end(4);
    return t;
  }

  /// True if a SAS ball covers x.
  bool in_sas_ball(const glm::dvec3& x) const {
    const auto covers = [&](std::uint32_t a) {
      return glm::distance(x, s.atoms[a].center) < s.atoms[a].radius + s.probe_radius;
    };
    if (std::ranges::any_of(large, covers)) return true;
    bool covered = false;
    balls.for_each_near(x, reach, [&](std::uint32_t a) { covered = covered || covers(a); });
    return covered;
  }

  /// Returns the nearest place of a probe that touches an atom.
  template <typename Wanted = Nearest>
  Foot nearest_accessible(const glm::dvec3& x, const Search<Wanted>& search = {kFar, {}}) const {
    return nearest_foot(
        x, search, accessible_tree, accessible,
        [&](std::uint32_t n, double limit) {
          return foot_on(s, s.convex[n], s.atoms[s.convex[n].atom].radius + s.probe_radius, x, limit);
        },
        [&](std::uint32_t n, double limit) { return foot_on_arc(s.toroidal[n], s.toroidal[n].free(), x, limit); },
        [&](std::uint32_t n, double) { return at_point(s.concave[n].center, x); });
  }

  /// Returns the nearest foot on the surface.
  template <typename Wanted = Nearest>
  Foot nearest_part(const glm::dvec3& x, const Search<Wanted>& search = {kFar, {}}) const {
    return nearest_foot(
        x, search, part_tree, parts,
        [&](std::uint32_t n, double limit) {
          return foot_on(s, s.convex[n], s.atoms[s.convex[n].atom].radius, x, limit);
        },
        [&](std::uint32_t n, double limit) { return foot_on(s, s.toroidal[n], x, limit); },
        [&](std::uint32_t n, double limit) {
          return s.concave[n].face_count > 0 ? foot_on(s, s.concave[n], x, limit) : Foot{};
        },
        [&](std::uint32_t n, double limit) {
          return foot_on_arc(s.borders[n], s.borders[n].vertex[0] == kNone, x, limit);
        },
        [&](std::uint32_t n, double) { return at_point(s.vertices[n], x); });
  }

  const Surface& s;
  std::vector<std::uint32_t> large;  // atoms with a SAS radius above `reach`
  double reach;                      // Å, the largest SAS radius of all other atoms
  BallGrid balls;
  Tables<3> accessible;
  BoxTree accessible_tree;
  Tables<5> parts;
  BoxTree part_tree;
};

SurfaceDistance::SurfaceDistance(const Surface& surface) : index_(std::make_unique<const Index>(surface)) {}
SurfaceDistance::~SurfaceDistance() = default;
SurfaceDistance::SurfaceDistance(SurfaceDistance&&) noexcept = default;
SurfaceDistance& SurfaceDistance::operator=(SurfaceDistance&&) noexcept = default;

double SurfaceDistance::to_probe(const glm::dvec3& x) const { return index_->nearest_accessible(x).distance; }

bool SurfaceDistance::in_sas(const glm::dvec3& x) const { return index_->in_sas_ball(x); }

NearestPoint SurfaceDistance::operator()(const glm::dvec3& x) const {
  const double probe_radius = index_->s.probe_radius;
  if (index_->in_sas_ball(x)) {
    const Foot place = index_->nearest_accessible(x);
    if (place.distance == 0.0 && probe_radius == 0.0) return {0.0, place.point};
    if (place.distance >= probe_radius)
      return {probe_radius - place.distance, place.point + (x - place.point) * (probe_radius / place.distance)};
  }
  const Foot foot = index_->nearest_part(x);
  return {foot.distance, foot.point};
}

bool SurfaceDistance::is_within(const glm::dvec3& x, double limit) const {
  constexpr double kLonger = 1 + 1e-9;  // the tree leaves out boxes by rounded distances
  const double probe_radius = index_->s.probe_radius;
  if (index_->in_sas_ball(x)) {
    // Once a place of the probe is near enough, another one counts only if the point is within the probe there.
    const auto wanted = [&](const Foot& place) {
      if (place.distance < probe_radius) return 0.0;
      return std::abs(probe_radius - place.distance) <= limit ? probe_radius : place.distance;
    };
    const Foot place = index_->nearest_accessible(x, Search{(probe_radius + limit) * kLonger, wanted});
    if (place.distance >= probe_radius) return std::abs(probe_radius - place.distance) <= limit;
  }
  const auto wanted = [&](const Foot& foot) { return foot.distance <= limit ? 0.0 : foot.distance; };
  return index_->nearest_part(x, Search{limit * kLonger, wanted}).distance <= limit;
}

namespace {

constexpr int kEdge = DistanceBand::kEdge;
constexpr double kMostVoxels = 1 << 28;  // greatest distance from the origin along an axis

/// Finds the blocks and cubes of a band.
class BandFinder {
 public:
  BandFinder(const Surface& surface, double voxel, double reach) : distance_(surface), voxel_(voxel), reach_(reach) {
    for (const Ball& ball : surface.atoms) {
      box_.include(ball.center - ball.radius - reach);
      box_.include(ball.center + ball.radius + reach);
    }
  }

  DistanceBand find() const {
    DistanceBand band{voxel_, static_cast<float>(reach_), {}, {}};
    int size = largest_cube();
    std::vector<glm::ivec3> cubes;
    cubes.reserve(8);
    for (int n = 0; n < 8; ++n) cubes.push_back(size * (corner(n) - 1));
    for (;; size /= 2) {
      std::vector<glm::ivec3> near = near_cubes(cubes, size, band.inside);
      check_count(near.size(), size);
      if (size == kEdge) {
        cubes = std::move(near);
        break;
      }
      cubes.clear();
      for (const glm::ivec3& origin : near)
        for (int n = 0; n < 8; ++n) cubes.push_back(origin + size / 2 * corner(n));
    }
    band.blocks.resize(cubes.size());
    tbb::parallel_for(std::size_t{0}, cubes.size(), [&](std::size_t n) { band.blocks[n] = block_at(cubes[n]); });
    return band;
  }

 private:
  enum class Place : std::uint8_t { near, outside, inside };

  static glm::ivec3 corner(int n) { return {n & 1, n >> 1 & 1, n >> 2}; }

  [[noreturn]] void refuse() const {
    throw CapacityError(message("voxels of {:g} Å would be more than {} million; choose a larger @voxel@", voxel_,
                                kMostBandBlocks * kEdge * kEdge * kEdge / 1'000'000));
  }

  /// Returns the edge, in voxels, of the largest cubes: eight of them around the origin hold all of the band.
  int largest_cube() const {
    const glm::dvec3 far = glm::max(glm::abs(box_.low), glm::abs(box_.high)) / voxel_;
    const double half = std::max({far.x, far.y, far.z});
    if (half > kMostVoxels) refuse();
    return std::max(kEdge, static_cast<int>(std::bit_ceil(static_cast<unsigned>(half) + 2U)));
  }

  /// Throws CapacityError if there will be too many blocks. Halving cubes makes at least four times as many along a
  /// surface, so this is known before they exist.
  void check_count(std::size_t count, int size) const {
    const glm::dvec3 extent = box_.high - box_.low;
    if (size > kEdge && 4.0 * size * voxel_ > std::max({extent.x, extent.y, extent.z})) return;
    const double halvings = static_cast<double>(size) / kEdge;
    if (static_cast<double>(count) * halvings * halvings > (size > kEdge ? 2.0 : 1.0) * kMostBandBlocks) refuse();
  }

  /// Returns the place of a cube with respect to the band, by the distance of its middle.
  Place place_of(const glm::ivec3& origin, int size) const {
    const glm::dvec3 middle = voxel_ * (glm::dvec3(origin) + 0.5 * (size - 1));
    const double to_corner = 0.5 * (size - 1) * voxel_ * std::numbers::sqrt3;
    if (box_.squared_distance(middle) > to_corner * to_corner) return Place::outside;
    const double distance = distance_(middle).distance;
    if (std::abs(distance) < reach_ + to_corner) return Place::near;
    return distance < 0.0 ? Place::inside : Place::outside;
  }

  /// Returns the cubes that the band may reach, and adds those in the solid to `inside`.
  std::vector<glm::ivec3> near_cubes(const std::vector<glm::ivec3>& cubes, int size,
                                     std::vector<DistanceBand::Inside>& inside) const {
    std::vector<Place> places(cubes.size());
    tbb::parallel_for(std::size_t{0}, cubes.size(), [&](std::size_t n) { places[n] = place_of(cubes[n], size); });
    std::vector<glm::ivec3> near;
    for (std::size_t n = 0; n < cubes.size(); ++n) {
      if (places[n] == Place::near) near.push_back(cubes[n]);
      if (places[n] == Place::inside) inside.push_back({cubes[n], size});
    }
    return near;
  }

  DistanceBand::Block block_at(const glm::ivec3& origin) const {
    DistanceBand::Block block{origin, {}};
    const auto limit = static_cast<float>(reach_);
    for (int n = 0; n < kEdge * kEdge * kEdge; ++n) {
      const glm::dvec3 place(origin + glm::ivec3(n / (kEdge * kEdge), n / kEdge % kEdge, n % kEdge));
      block.distances[n] = std::clamp(static_cast<float>(distance_(voxel_ * place).distance), -limit, limit);
    }
    return block;
  }

  SurfaceDistance distance_;
  double voxel_, reach_;
  Box box_;
};

}  // namespace

DistanceBand distance_band(const Surface& surface, double voxel, int reach) {
  return BandFinder(surface, voxel, reach * voxel).find();
}

}  // namespace meniscus
