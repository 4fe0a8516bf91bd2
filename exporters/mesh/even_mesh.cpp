// SPDX-License-Identifier: BSD-3-Clause
// Even meshes: a base mesh, rounds of remeshing, then shorter edges wherever the result is not as promised.
#include "exporters/mesh/even_mesh.h"

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
#include "core/queries/distance.h"
#include "exporters/mesh/coarse_mesh.h"
#include "exporters/mesh/creases.h"
#include "exporters/mesh/evener.h"
#include "exporters/mesh/mesh_crossings.h"
#include "exporters/mesh/mesh_distance.h"
#include "exporters/mesh/mesh_objects.h"
#include "exporters/mesh/tessellate.h"

namespace meniscus {
namespace {

/// Of edges of wanted length h: vertices per Å², times h². Equilateral triangles have 2 / sqrt(3) = 1.155; splitting
/// and collapsing leave edges a little shorter.
constexpr double kVerticesPerSquare = 1.34;
/// The share of the tolerance that the middle of an equilateral triangle with the edges wanted may take up: edges up to
/// 4/3 of that length stay.
constexpr double kShareOfTolerance = 0.62;
/// What is measured at places is less than what is between them.
constexpr double kMargin = 0.97;
/// The base is a scaffold: its tolerance follows that of the result between these (Å).
constexpr double kFinestBase = 1e-4, kCoarsestBase = 0.4, kShareOfKept = 0.9;
constexpr int kBases = 4;
/// Edges (Å) from which on the base has the fewest triangles that there are, and how long its edges are.
constexpr double kLongEdge = 1.1, kCoarseEdge = 0.9;
/// What is done about triangles that cross: rounds of refinement in which they may part, and the trouble from which on
/// a face stays as it is. The fewest triangles become more before they stay; patch-aligned ones are as they should be.
struct Patience {
  int rounds, frozen;
};
constexpr Patience kWithCoarse{1, 3}, kWithPatches{0, 1};
constexpr int kAttempts = 8;
constexpr int kRounds = 6, kRefinedRounds = 3, kRefinements = 12;
/// How often a refinement is done again with triangles held that would cross.
constexpr int kTakenBack = 3;
/// Refinements in a row that help nowhere are the last ones.
constexpr int kIdle = 5;
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

/// Do long edges begin with the fewest triangles?
bool begins_coarse(const Surface& surface, const EvenMeshOptions& options) {
  return surface.probe_radius > 0.0 && edge_of_density(options.density) >= kLongEdge;
}

class EvenMeshing {
 public:
  EvenMeshing(const Surface& surface, const EvenMeshOptions& options, bool follow_creases, bool from_patches)
      : surface_(surface),
        options_(options),
        ball_radius_(smallest_radius(surface)),
        edge_of_density_(edge_of_density(options.density)),
        follow_creases_(follow_creases),
        from_patches_(from_patches),
        walk_(surface),
        trouble_(surface.faces.size(), 0) {
    find_base();
  }

  EvenMesh run() {
    for (int attempt = 0;; ++attempt) {
      start();
      const std::vector<std::uint32_t> crossing = even_out();
      if (!crossing.empty()) {
        if (attempt == kAttempts)
          throw OpenSurfaceError(fmt::format(
              "no even mesh was found: {} triangles stay in others' way; ask for a finer one", crossing.size()));
        if (std::none_of(trouble_.begin(), trouble_.end(), [](std::uint8_t t) { return t > 0; })) find_kept_base();
        note_trouble(crossing);
        continue;
      }
      mend_kept();
      EvenMesh even = result();
      const std::vector<std::uint32_t> wrong = wrong_components(even.mesh);
      if (wrong.empty()) return even;
      if (attempt == kAttempts)
        throw OpenSurfaceError(
            fmt::format("component {} has {:.6g} Å³, its even mesh another volume; ask for a finer one", wrong.front(),
                        surface_.components[wrong.front()].volume));
      for (std::size_t f = 0; f < trouble_.size(); ++f)
        if (std::find(wrong.begin(), wrong.end(), surface_.faces[f].component) != wrong.end()) worsen(f);
    }
  }

 private:
  void start() {
    std::vector<bool> frozen(trouble_.size());
    for (std::size_t f = 0; f < frozen.size(); ++f) frozen[f] = trouble_[f] >= patience_.frozen;
    walk_.bar(std::vector<bool>(surface_.borders.size(), false));
    evener_.emplace(surface_, walk_, base_, creases(), frozen, [this](const SurfacePoint& at) {
      const double edge = edge_at(at.position, radius(at.face));
      return std::max(std::ldexp(edge, -trouble_[at.face]), std::min(edge, least_edge_));
    });
  }

  /// Returns triangles that pass through others and would not part, or that would not come near enough, or none.
  std::vector<std::uint32_t> even_out() {
    if (options_.density > 0.0) evener_->approach();
    for (int round = 0; round < kRounds; ++round) {
      evener_->even_out(1);
      evener_->compact();
    }
    evener_->mend();
    evener_->compact();
    const std::uint32_t most = kMostGrowth * evener_->links().triangle_count() + kGrowthAllowed;
    return options_.density > 0.0 ? part(most) : come_near(most);
  }

  std::vector<std::uint32_t> part(std::uint32_t most) {
    for (int round = 0;; ++round) {
      std::vector<std::uint32_t> bad = crossing();
      if (bad.empty() || round == patience_.rounds || evener_->links().triangle_count() > most) return bad;
      refine(bad);
    }
  }

  /// Makes triangles smaller where they are too far away. Where that lets some cross, it is done again without what is
  /// around those.
  std::vector<std::uint32_t> come_near(std::uint32_t most) {
    if (std::vector<std::uint32_t> bad = crossing(); !bad.empty()) return bad;
    std::vector<std::uint32_t> far = too_far();
    std::size_t fewest = far.size();
    for (int round = 0, idle = 0; round < kRefinements && idle < kIdle && !far.empty(); ++round) {
      if (evener_->links().triangle_count() > most)
        throw OpenSurfaceError(
            fmt::format("no even mesh was found: {} triangles stay too far away; ask for a finer one", far.size()));
      const Evener before = *evener_;
      std::vector<Ball> held;
      for (int n = 0;; ++n) {
        refine(far);
        std::vector<std::uint32_t> bad = crossing();
        if (bad.empty()) break;
        if (n == kTakenBack) return bad;
        for (const std::uint32_t t : bad) held.push_back(around(t));
        evener_.emplace(before);
        evener_->hold(held);
      }
      far = too_far();
      idle = far.size() < fewest ? 0 : idle + 1;
      fewest = std::min(fewest, far.size());
    }
    return far;
  }

  /// What was kept for fear of crossings has the slivers of the base: it is mended as far as nothing gets wrong by
  /// that.
  void mend_kept() {
    const Evener before = *evener_;
    std::vector<Ball> held;
    for (int n = 0; n <= kTakenBack; ++n) {
      evener_->release();
      evener_->hold(held);
      evener_->mend();
      evener_->compact();
      std::vector<std::uint32_t> bad = crossing();
      if (options_.density == 0.0) {
        const std::vector<std::uint32_t> far = too_far();
        bad.insert(bad.end(), far.begin(), far.end());
      }
      if (bad.empty()) return;
      for (const std::uint32_t t : bad) held.push_back(around(t));
      evener_.emplace(before);
    }
  }

  void refine(const std::vector<std::uint32_t>& triangles) {
    evener_->refine(triangles, kFiner);
    evener_->even_out(kRefinedRounds);
    evener_->mend();
    evener_->compact();
  }

  /// The triangle and what is as near as its longest edge is long.
  Ball around(std::uint32_t triangle) const {
    const auto v = evener_->links().corners(triangle);
    const auto& x = evener_->positions();
    const glm::dvec3 middle = (x[v[0]] + x[v[1]] + x[v[2]]) / 3.0;
    double reach = 0.0, longest = 0.0;
    for (int k = 0; k < 3; ++k) {
      reach = std::max(reach, glm::distance(middle, x[v[k]]));
      longest = std::max(longest, glm::distance(x[v[k]], x[v[(k + 1) % 3]]));
    }
    return {middle, reach + longest};
  }

  /// Edges on the faces under these triangles are half as long in the next attempt, and keep to the base, which hardly
  /// has crossings, in the end; those on faces beside them come a step behind.
  void note_trouble(const std::vector<std::uint32_t>& triangles) {
    std::vector<std::uint8_t> here(trouble_.size(), 0);
    for (const std::uint32_t t : triangles) {
      const auto v = evener_->links().corners(t);
      const auto& x = evener_->positions();
      for (const std::uint32_t k : v) here[evener_->point(k).face] = 1;
      if (const auto at = below((x[v[0]] + x[v[1]] + x[v[2]]) / 3.0, v)) here[at->face] = 1;
    }
    for (std::size_t f = 0; f < here.size(); ++f)
      if (here[f]) worsen(f);
    std::vector<std::uint8_t> beside = trouble_;
    for (const Border& border : surface_.borders)
      for (int side = 0; side < 2; ++side) {
        const int from = trouble_[border.face[side]];
        std::uint8_t& to = beside[border.face[1 - side]];
        to = static_cast<std::uint8_t>(std::max<int>(to, from - 1));
      }
    trouble_ = std::move(beside);
  }

  void worsen(std::size_t face) {
    trouble_[face] = static_cast<std::uint8_t>(std::min(trouble_[face] + 1, patience_.frozen));
  }

  std::vector<bool> creases() const {
    if (!follow_creases_) return std::vector<bool>(surface_.borders.size(), false);
    std::vector<bool> keep = creases_to_keep(surface_, [this](const glm::dvec3& x) { return edge_at(x, probe()); });
    for (std::size_t b = 0; b < keep.size(); ++b)
      for (const std::uint32_t f : surface_.borders[b].face)
        if (trouble_[f]) keep[b] = false;
    return keep;
  }
  double probe() const { return surface_.probe_radius > 0.0 ? surface_.probe_radius : ball_radius_; }
  double radius(std::uint32_t face) const {
    const Face& f = surface_.faces[face];
    return f.kind == PatchKind::convex ? surface_.atoms[surface_.convex[f.patch].atom].radius : probe();
  }
  double tolerance_at(const glm::dvec3& x) const {
    return options_.tolerance_at ? std::max(options_.tolerance_at(x), options_.tolerance) : options_.tolerance;
  }
  double edge_at(const glm::dvec3& x, double radius) const {
    return edge_of_density_ > 0.0 ? edge_of_density_ : std::sqrt(6.0 * kShareOfTolerance * tolerance_at(x) * radius);
  }

  /// Long edges begin with the fewest triangles, others, and surfaces that have no such mesh, with patch-aligned ones;
  /// of these some have none at a coarse tolerance.
  void find_base() {
    if (!from_patches_) {
      try {
        base_ = coarse_mesh(surface_, walk_);
        least_edge_ = kCoarseEdge;
        patience_ = kWithCoarse;
        return;
      } catch (const OpenSurfaceError&) {
      }
    }
    const double tolerance =
        options_.density > 0.0 ? edge_of_density_ * edge_of_density_ / (6.0 * probe()) : options_.tolerance;
    take_patches(2.0 * tolerance);
  }

  /// By tolerance faces in trouble stay as they are in the base, which has to be as near as promised then.
  void find_kept_base() {
    if (options_.density == 0.0) take_patches(kShareOfKept * options_.tolerance);
  }

  void take_patches(double tolerance) {
    tolerance = std::clamp(tolerance, kFinestBase, kCoarsestBase);
    for (int n = 1;; ++n, tolerance *= 0.25) {
      try {
        base_ = tessellate(surface_, {tolerance, false});
        least_edge_ = std::sqrt(5.0 * tolerance * probe());
        patience_ = kWithPatches;
        return;
      } catch (const OpenSurfaceError&) {
        if (n == kBases) throw;
      }
    }
  }

  /// The point of the surface under one of a triangle, as its corners lead there.
  std::optional<SurfacePoint> below(const glm::dvec3& x, const std::array<std::uint32_t, 3>& corners) const {
    for (const bool smooth : {true, false})  // a vertex of a crease is on both sides of it
      for (const std::uint32_t v : corners) {
        if (evener_->on_crease(v) == smooth) continue;
        if (const auto at = walk_.below(x, evener_->point(v).face)) return at;
      }
    return std::nullopt;
  }

  bool is_too_far(std::uint32_t triangle) const {
    const auto v = evener_->links().corners(triangle);
    const auto& x = evener_->positions();
    return std::any_of(kPlaces.begin(), kPlaces.end(), [&](const auto& w) {
      const glm::dvec3 place = w[0] * x[v[0]] + w[1] * x[v[1]] + w[2] * x[v[2]];
      const double limit = kMargin * tolerance_at(place);
      const auto foot = below(place, v);
      if (foot && glm::distance(foot->position, place) <= limit) return false;
      return std::abs(distance()(place).distance) > limit;
    });
  }
  const SurfaceDistance& distance() const {
    std::call_once(distance_made_, [&] { distance_.emplace(surface_); });
    return *distance_;
  }

  /// Triangles that are too far from the surface, and those nearest to places of creases that are too far from the
  /// mesh: away from creases neither is without the other.
  std::vector<std::uint32_t> too_far() const {
    const std::vector<std::array<std::uint32_t, 3>> all = triangles();
    std::vector<std::uint8_t> bad(all.size(), 0);
    tbb::parallel_for(std::uint32_t{0}, evener_->links().triangle_count(),
                      [&](std::uint32_t t) { bad[t] = is_too_far(t); });
    const MeshDistance from_mesh(evener_->positions(), all);
    std::vector<std::uint32_t> bridging(base_.positions.size(), kNone);
    tbb::parallel_for(std::size_t{0}, bridging.size(), [&](std::size_t v) {
      const double limit = kMargin * tolerance_at(base_.positions[v]);
      const NearestTriangle nearest = from_mesh(base_.positions[v], std::numeric_limits<double>::infinity());
      if (nearest.distance > limit) bridging[v] = nearest.triangle;
    });
    for (const std::uint32_t t : bridging)
      if (t != kNone) bad[t] = 1;
    return numbers_of(bad);
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
    const LinkedTriangles& links = evener_->links();
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
  bool follow_creases_, from_patches_;
  SurfaceWalk walk_;
  TriangleMesh base_;
  double least_edge_ = 0.0;  ///< Å; faces in trouble are not asked for shorter ones
  Patience patience_{};
  std::vector<std::uint8_t> trouble_;  ///< per face: how often triangles were found to cross there
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
  const bool coarse = begins_coarse(surface, options);
  for (const bool patches : {false, true}) {
    if (!patches && !coarse) continue;
    try {
      return EvenMeshing(surface, options, true, patches).run();
    } catch (const OpenSurfaceError&) {
    }
  }
  return EvenMeshing(surface, options, false, true).run();
}

}  // namespace meniscus
