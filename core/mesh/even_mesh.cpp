// SPDX-License-Identifier: BSD-3-Clause
// Even meshes: a base mesh, rounds of remeshing, then shorter edges wherever the result is not as promised.
#include "core/mesh/even_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <mutex>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <tbb/parallel_for.h>

#include "core/base/error.h"
#include "core/mesh/base_mesh.h"
#include "core/mesh/creases.h"
#include "core/mesh/evener.h"
#include "core/mesh/mesh_crossings.h"
#include "core/mesh/mesh_distance.h"
#include "core/mesh/mesh_objects.h"
#include "core/mesh/tessellate.h"
#include "core/queries/distance.h"
#include "core/surface/walks.h"

namespace meniscus {
namespace {

/// Of edges of wanted length h: vertices per Å², times h². Equilateral triangles have 2 / sqrt(3) = 1.155; splitting
/// and collapsing leave edges a little shorter.
constexpr double kVerticesPerSquare = 1.34;
/// The share of the tolerance that the middle of an equilateral triangle with the edges wanted may take up: edges up to
/// 4/3 of that length stay.
constexpr double kShareOfTolerance = 0.62;
/// Tolerances between places along creases that the mesh has to be near.
constexpr double kCreaseStep = 0.4;
/// What is measured at places is less than what is between them.
constexpr double kMargin = 0.97;
/// Edges (Å) from which on the base has the fewest triangles that there are.
constexpr double kLongEdge = 1.1;
/// Edges (Å) from which on contact faces begin as points: as long as those between such points.
constexpr double kLongContracted = 2.5;
/// How often all begins again, with an eye on the places where triangles crossed, and from which attempt on these keep
/// to the base, which is as near as promised then; contact faces that are points are no base to keep to.
constexpr int kAttempts = 6, kFirstHeld = 2, kContractedAttempts = 2;
constexpr double kCoarserBase = 2.0, kShareOfKept = 0.9;
/// Of the tolerance, that of the mesh whose vertices are looked at in the end.
constexpr double kShareOfFine = 0.3;
/// How these places grow with each attempt.
constexpr double kWider = 1.7;
/// How often triangles are mended and, where that leaves them too far away, made smaller.
constexpr int kMendings = 5;
/// Rounds of remeshing.
constexpr int kRounds = 6, kRefinedRounds = 3, kRefinements = 12;
/// Refinements in a row that help nowhere are the last ones.
constexpr int kIdle = 2;
/// So few triangles that are too far away are mended one by one.
constexpr std::size_t kFewFar = 100;
constexpr double kFiner = 0.7;
/// Refinements that make more triangles than these lead nowhere.
constexpr std::uint32_t kMostGrowth = 2, kGrowthAllowed = 500;

/// Places in a triangle at which its distance is measured.
constexpr std::array<std::array<double, 3>, 7> kPlaces{{{1.0 / 3, 1.0 / 3, 1.0 / 3},
                                                        {0.5, 0.5, 0.0},
                                                        {0.0, 0.5, 0.5},
                                                        {0.5, 0.0, 0.5},
                                                        {0.6, 0.2, 0.2},
                                                        {0.2, 0.6, 0.2},
                                                        {0.2, 0.2, 0.6}}};

double smallest_radius(const Surface& surface) {
  double radius = std::numeric_limits<double>::infinity();
  for (const Ball& atom : surface.atoms) radius = std::min(radius, atom.radius);
  return radius;
}

double edge_of_density(double density) { return density > 0.0 ? std::sqrt(kVerticesPerSquare / density) : 0.0; }

/// Those that may do, the fastest first.
std::vector<Beginning> beginnings(const Surface& surface, const EvenMeshOptions& options) {
  std::vector<Beginning> all;
  const double edge = edge_of_density(options.density);
  if (surface.probe_radius > 0.0 && edge >= kLongContracted) all.push_back(Beginning::contracted);
  if (surface.probe_radius > 0.0 && edge >= kLongEdge) all.push_back(Beginning::coarse);
  all.push_back(Beginning::patches);
  return all;
}

class EvenMeshing {
 public:
  EvenMeshing(const Surface& surface, const EvenMeshOptions& options, bool follow_creases, Beginning beginning)
      : surface_(surface),
        options_(options),
        ball_radius_(smallest_radius(surface)),
        edge_of_density_(edge_of_density(options.density)),
        follow_creases_(follow_creases),
        contracted_(beginning == Beginning::contracted),
        walk_(surface),
        base_(base_mesh(surface, walk_, beginning, kCoarserBase * tolerance())) {}

  EvenMesh run() {
    std::vector<Ball> watched;
    for (int attempt = 1;; ++attempt) {
      if (attempt == kFirstHeld && options_.density == 0.0)
        base_ = base_mesh(surface_, walk_, Beginning::patches, kShareOfKept * options_.tolerance);
      start(watched);
      if (attempt >= kFirstHeld && !contracted_) evener_->hold_watched();
      const std::vector<std::uint32_t> bad = even_out();
      if (bad.empty()) break;
      if (attempt == (contracted_ ? kContractedAttempts : kAttempts))
        throw OpenSurfaceError(
            fmt::format("no even mesh was found: {} triangles stay in others' way or too far away; ask for a finer one",
                        bad.size()));
      for (Ball& place : watched) place.radius *= kWider;
      for (const std::uint32_t t : bad) watched.push_back(around(t));
    }
    EvenMesh even = result();
    if (const std::vector<std::uint32_t> wrong = wrong_components(even.mesh); !wrong.empty())
      throw OpenSurfaceError(
          fmt::format("component {} has {:.6g} Å³, its even mesh another volume; ask for a finer one", wrong.front(),
                      surface_.components[wrong.front()].volume));
    return even;
  }

 private:
  void start(const std::vector<Ball>& watched) {
    if (options_.density == 0.0) list_places_to_reach();
    walk_.bar(std::vector<bool>(surface_.borders.size(), false));
    evener_.emplace(surface_, walk_, base_.mesh, base_.vertex_face, creases(),
                    [this](const SurfacePoint& at) { return edge_at(at.position, radius(at.face)); });
    evener_->watch(watched);
  }

  /// The vertices and the middles of the base, and places along creases, which coarser meshes bridge.
  void list_places_to_reach() {
    const TriangleMesh& base = base_.mesh;
    to_reach_.clear();
    for (std::size_t v = 0; v < base.positions.size(); ++v)
      to_reach_.push_back({base.positions[v], base_.vertex_face[v]});
    for (std::size_t t = 0; t < base.triangles.size(); ++t) {
      const auto& [a, b, c] = base.triangles[t];
      const glm::dvec3 middle = (base.positions[a] + base.positions[b] + base.positions[c]) / 3.0;
      if (const auto at = walk_.below(middle, base.face[t])) to_reach_.push_back(*at);
    }
    for (const Border& border : surface_.borders) {
      if (crease_angle(surface_, border) == 0.0) continue;
      const double step = kCreaseStep * tolerance_at(arc_point(border, 0.5 * border.sweep));
      const auto count = static_cast<std::uint32_t>(std::ceil(border.radius * border.sweep / step));
      for (std::uint32_t k = 1; k < count; ++k)
        to_reach_.push_back({arc_point(border, border.sweep * k / count), border.face[0]});
    }
  }

  /// Is the mesh near the vertices of a fine one as well? Others have to be reached from now on.
  bool reaches_all() {
    const TriangleMesh fine = tessellate(surface_, {kShareOfFine * options_.tolerance, false});
    std::vector<std::uint32_t> face(fine.positions.size());
    for (std::size_t t = 0; t < fine.triangles.size(); ++t)
      for (const std::uint32_t v : fine.triangles[t]) face[v] = fine.face[t];
    const std::vector<std::array<std::uint32_t, 3>> all = triangles();
    const MeshDistance from_mesh(evener_->positions(), all);
    std::vector<std::uint8_t> far(face.size());
    tbb::parallel_for(std::size_t{0}, far.size(), [&](std::size_t v) {
      const double limit = tolerance_at(fine.positions[v]);
      far[v] = from_mesh(fine.positions[v], limit).distance >= limit;
    });
    for (const std::uint32_t v : numbers_of(far)) to_reach_.push_back({fine.positions[v], face[v]});
    return std::none_of(far.begin(), far.end(), [](std::uint8_t f) { return f > 0; });
  }

  /// Returns triangles that pass through others and would not part, or that would not come near enough, or none.
  std::vector<std::uint32_t> even_out() {
    if (options_.density > 0.0) evener_->approach();
    for (int round = 0; round < kRounds; ++round) {
      evener_->even_out(1);
      evener_->compact();
    }
    const std::uint32_t most = kMostGrowth * evener_->links().triangle_count() + kGrowthAllowed;
    for (int n = 1;; ++n) {
      if (options_.density == 0.0)
        if (std::vector<std::uint32_t> far = come_near(most); !far.empty()) return far;
      mend(crossing());
      std::vector<std::uint32_t> bad = crossing();
      if (!bad.empty() || options_.density > 0.0) return bad;
      bad = triangles_of(too_far());
      if (bad.empty() && reaches_all()) return bad;
      if (n == kMendings) return bad;
    }
  }

  void mend(const std::vector<std::uint32_t>& triangles) {
    evener_->mend(triangles, nearness());
    evener_->compact();
  }
  Allowed nearness() const {
    return [this](const PlacedTriangle& t) { return options_.density > 0.0 || !far_place(t); };
  }

  /// Makes triangles smaller where they are too far away; returns those that stay.
  std::vector<std::uint32_t> come_near(std::uint32_t most) {
    std::vector<Evener::Place> far = too_far();
    std::size_t fewest = far.size();
    for (int round = 0, idle = 0; round < kRefinements && idle < kIdle && !far.empty(); ++round) {
      if (evener_->links().triangle_count() > most) break;
      if (far.size() > kFewFar) {
        refine(triangles_of(far));
        far = too_far();
      } else {
        evener_->reach(far, nearness());
      }
      mend(triangles_of(far));
      far = too_far();
      idle = far.size() < fewest ? 0 : idle + 1;
      fewest = std::min(fewest, far.size());
    }
    return triangles_of(far);
  }

  /// The triangle and what is as near as its longest edge is long.
  Ball around(std::uint32_t triangle) const {
    const PlacedTriangle t = placed(triangle);
    const glm::dvec3 middle = (t.at[0] + t.at[1] + t.at[2]) / 3.0;
    double reach = 0.0, longest = 0.0;
    for (int k = 0; k < 3; ++k) {
      reach = std::max(reach, glm::distance(middle, t.at[k]));
      longest = std::max(longest, glm::distance(t.at[k], t.at[(k + 1) % 3]));
    }
    return {middle, reach + longest};
  }
  PlacedTriangle placed(std::uint32_t triangle) const {
    const auto v = evener_->links().corners(triangle);
    const auto& x = evener_->positions();
    return {v, {x[v[0]], x[v[1]], x[v[2]]}};
  }

  void refine(const std::vector<std::uint32_t>& triangles) {
    evener_->refine(triangles, kFiner);
    evener_->even_out(kRefinedRounds);
    evener_->compact();
  }

  std::vector<bool> creases() const {
    if (!follow_creases_) return std::vector<bool>(surface_.borders.size(), false);
    return creases_to_keep(surface_, [this](const glm::dvec3& x) { return edge_at(x, probe()); });
  }
  double probe() const { return surface_.probe_radius > 0.0 ? surface_.probe_radius : ball_radius_; }
  double radius(std::uint32_t face) const {
    const Face& f = surface_.faces[face];
    return f.kind == PatchKind::convex ? surface_.atoms[surface_.convex[f.patch].atom].radius : probe();
  }
  /// Å; with a density about that of equilateral triangles.
  double tolerance() const {
    const double edge = edge_of_density_;
    return edge > 0.0 ? edge * edge / (6.0 * probe()) : options_.tolerance;
  }
  double tolerance_at(const glm::dvec3& x) const {
    return options_.tolerance_at ? std::max(options_.tolerance_at(x), options_.tolerance) : options_.tolerance;
  }
  double edge_at(const glm::dvec3& x, double radius) const {
    return edge_of_density_ > 0.0 ? edge_of_density_ : std::sqrt(6.0 * kShareOfTolerance * tolerance_at(x) * radius);
  }

  /// The point of the surface under one of a triangle, as its corners lead there.
  std::optional<SurfacePoint> below(const glm::dvec3& x, const std::array<std::uint32_t, 3>& corners) const {
    for (const bool smooth : {true, false})  // a vertex of a crease is on both sides of it
      for (const std::uint32_t v : corners) {
        if (v >= evener_->positions().size() || evener_->on_crease(v) == smooth) continue;
        if (const auto at = walk_.below(x, evener_->point(v).face)) return at;
      }
    return std::nullopt;
  }

  /// That, or where there is none, as creases stand between, the nearest point of these.
  SurfacePoint near(const glm::dvec3& x, const std::array<std::uint32_t, 3>& corners) const {
    if (const auto at = below(x, corners)) return *at;
    SurfacePoint nearest;
    for (const std::uint32_t v : corners)
      if (const auto at = walk_.on_near_cusp(x, evener_->point(v).face))
        if (nearest.face == kNone || glm::distance(at->position, x) < glm::distance(nearest.position, x)) nearest = *at;
    return nearest;
  }

  /// A place of a triangle that is too far away.
  std::optional<glm::dvec3> far_place(const PlacedTriangle& t) const {
    for (const auto& w : kPlaces) {
      const glm::dvec3 place = w[0] * t.at[0] + w[1] * t.at[1] + w[2] * t.at[2];
      const double limit = kMargin * tolerance_at(place);
      const auto foot = below(place, t.vertex);
      if (foot && glm::distance(foot->position, place) <= limit) continue;
      if (std::abs(distance()(place).distance) > limit) return place;
    }
    return std::nullopt;
  }
  const SurfaceDistance& distance() const {
    std::call_once(distance_made_, [&] { distance_.emplace(surface_); });
    return *distance_;
  }

  /// Triangles that are too far from the surface, and those nearest to places of creases that are too far from the
  /// mesh: away from creases neither is without the other. With the place, as far as it is known; ascending.
  std::vector<Evener::Place> too_far() {
    const std::vector<std::array<std::uint32_t, 3>> all = triangles();
    std::vector<Evener::Place> place(all.size());
    tbb::parallel_for(std::uint32_t{0}, evener_->links().triangle_count(), [&](std::uint32_t t) {
      if (!evener_->changed(t)) return;
      const auto far = far_place(placed(t));
      if (far) place[t] = {t, near(*far, all[t])};
    });
    add_bridges(all, place);
    std::erase_if(place, [](const Evener::Place& p) { return p.triangle == kNone; });
    evener_->forget_changes(place);
    return place;
  }
  void add_bridges(const std::vector<std::array<std::uint32_t, 3>>& all, std::vector<Evener::Place>& place) const {
    const MeshDistance from_mesh(evener_->positions(), all);
    std::vector<NearestTriangle> bridging(to_reach_.size(), {kNone, 0.0});
    tbb::parallel_for(std::size_t{0}, bridging.size(), [&](std::size_t v) {
      const glm::dvec3& x = to_reach_[v].position;
      const double limit = kMargin * tolerance_at(x);
      if (from_mesh(x, limit).distance >= limit) bridging[v] = from_mesh(x, std::numeric_limits<double>::infinity());
    });
    std::vector<double> farthest(all.size(), 0.0);
    for (std::size_t v = 0; v < bridging.size(); ++v) {
      const auto& [t, distance] = bridging[v];
      if (t == kNone || distance <= farthest[t]) continue;
      farthest[t] = distance;
      place[t] = {t, to_reach_[v]};
    }
  }
  static std::vector<std::uint32_t> triangles_of(const std::vector<Evener::Place>& places) {
    std::vector<std::uint32_t> triangles;
    triangles.reserve(places.size());
    for (const Evener::Place& place : places) triangles.push_back(place.triangle);
    return triangles;
  }
  std::vector<std::uint32_t> crossing() const {
    std::vector<std::uint8_t> bad(evener_->links().triangle_count(), 0);
    for (const auto& [a, b] : crossing_triangles(evener_->positions(), triangles())) bad[a] = bad[b] = 1;
    return numbers_of(bad);
  }
  static std::vector<std::uint32_t> numbers_of(const std::vector<std::uint8_t>& marked) {
    std::vector<std::uint32_t> found;
    for (std::uint32_t t = 0; t < marked.size(); ++t)
      if (marked[t]) found.push_back(t);
    return found;
  }
  std::vector<std::array<std::uint32_t, 3>> triangles() const {
    std::vector<std::array<std::uint32_t, 3>> all(evener_->links().triangle_count());
    for (std::uint32_t t = 0; t < all.size(); ++t) all[t] = evener_->links().corners(t);
    return all;
  }

  EvenMesh result() const {
    EvenMesh even;
    TriangleMesh& mesh = even.mesh;
    mesh.positions = evener_->positions();
    mesh.triangles = triangles();
    mesh.tolerance = options_.density > 0.0 ? 0.0 : options_.tolerance;
    const std::size_t vertices = mesh.positions.size(), count = mesh.triangles.size();
    mesh.normals.resize(vertices);
    even.vertex_face.resize(vertices);
    even.vertex_atom.resize(vertices);
    tbb::parallel_for(std::size_t{0}, vertices, [&](std::size_t v) {
      const SurfacePoint at = evener_->point(static_cast<std::uint32_t>(v));
      mesh.normals[v] = walk_.normal(at);
      even.vertex_face[v] = at.face;
      even.vertex_atom[v] = walk_.nearest_atom(at);
    });
    mesh.face.resize(count);
    mesh.kind.resize(count);
    mesh.patch.resize(count);
    mesh.component.resize(count);
    mesh.atom.resize(count);
    tbb::parallel_for(std::size_t{0}, count, [&](std::size_t t) {
      const auto& v = mesh.triangles[t];
      const glm::dvec3 middle = (mesh.positions[v[0]] + mesh.positions[v[1]] + mesh.positions[v[2]]) / 3.0;
      const SurfacePoint at = below(middle, v).value_or(evener_->point(v[0]));
      const Face& face = surface_.faces[at.face];
      mesh.face[t] = at.face;
      mesh.kind[t] = face.kind;
      mesh.patch[t] = face.patch;
      mesh.component[t] = face.component;
      mesh.atom[t] = walk_.nearest_atom(at);
    });
    add_creases(mesh);
    return even;
  }

  /// At vertices on creases each triangle has the normal of the face that it lies nearest to.
  void add_creases(TriangleMesh& mesh) const {
    const HalfEdges& links = evener_->links();
    std::vector<glm::dvec3> sum(mesh.positions.size(), glm::dvec3(0.0));
    for (std::uint32_t half = 0; half < links.half_edge_count(); ++half) {
      if (links.crease(half) != kNone && half < links.twin(half))
        mesh.sharp_edges.push_back({links.from(half), links.to(half)});
      const std::uint32_t v = links.from(half);
      if (!evener_->on_crease(v)) continue;
      const auto& [a, b, c] = mesh.triangles[half / 3];
      const glm::dvec3 flat = glm::cross(mesh.positions[b] - mesh.positions[a], mesh.positions[c] - mesh.positions[a]);
      glm::dvec3 best = mesh.normals[v];
      links.around(v, [&](std::uint32_t edge) {
        if (links.crease(edge) == kNone) return;
        for (const glm::dvec3& n : crease_normals(surface_, surface_.borders[links.crease(edge)], mesh.positions[v]))
          if (glm::dot(n, flat) > glm::dot(best, flat)) best = n;
      });
      mesh.sharp_corners.push_back(half);
      mesh.sharp_corner_normals.push_back(best);
      sum[v] += best;
    }
    for (std::size_t v = 0; v < sum.size(); ++v)
      if (const double size = glm::length(sum[v]); size > 1e-6) mesh.normals[v] = sum[v] / size;
  }

  /// Splits, collapses and flips keep the topology; that triangles look outwards is seen from the volumes.
  std::vector<std::uint32_t> wrong_components(const TriangleMesh& mesh) const {
    std::vector<std::uint32_t> wrong;
    const std::vector<MeshSums> sums = component_sums(mesh, surface_.components.size());
    for (std::uint32_t c = 0; c < sums.size(); ++c) {
      const Component& component = surface_.components[c];
      const bool same = (sums[c].volume > 0.0) == (component.volume > 0.0);
      const double off = std::abs(sums[c].volume - component.volume);
      if (!same || (mesh.tolerance > 0.0 && !options_.tolerance_at && off > mesh.tolerance * component.area + 1e-9))
        wrong.push_back(c);
    }
    return wrong;
  }

  const Surface& surface_;
  const EvenMeshOptions& options_;
  double ball_radius_;  ///< Å, the smallest: of curvature where the probe has none
  double edge_of_density_;
  bool follow_creases_, contracted_;
  SurfaceWalk walk_;
  BaseMesh base_;
  std::vector<SurfacePoint> to_reach_;  ///< the mesh has to come near these
  std::optional<Evener> evener_;
  mutable std::once_flag distance_made_;
  mutable std::optional<SurfaceDistance> distance_;
};

}  // namespace

EvenMesh even_mesh(const Surface& surface, const EvenMeshOptions& options) {
  if (options.density != 0.0 && !(options.density >= kSmallestDensity && options.density <= kLargestDensity))
    throw Error(fmt::format("mesh density: {} vertices per Å², give {} to {}", options.density, kSmallestDensity,
                            kLargestDensity));
  if (options.density == 0.0 && !(options.tolerance > 0.0 && std::isfinite(options.tolerance)))
    throw Error(fmt::format("mesh tolerance: {} Å, give a number above 0", options.tolerance));
  // Where creases crowd, triangles that have to end at them may find no place; without that they are smaller there.
  for (const Beginning beginning : beginnings(surface, options)) {
    try {
      return EvenMeshing(surface, options, true, beginning).run();
    } catch (const OpenSurfaceError&) {
    }
  }
  return EvenMeshing(surface, options, false, Beginning::patches).run();
}

}  // namespace meniscus
