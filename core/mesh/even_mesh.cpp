// SPDX-License-Identifier: BSD-3-Clause
// Makes even meshes: remeshes a base mesh in rounds, then shortens edges wherever the result is not as promised.
#include "core/mesh/even_mesh.h"

#include <set>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "core/base/error.h"
#include "core/mesh/base_mesh.h"
#include "core/mesh/mesh_change.h"
#include "core/mesh/mesh_crossings.h"
#include "core/mesh/mesh_mender.h"
#include "core/mesh/mesh_nearness.h"
#include "core/mesh/mesh_on_surface.h"

namespace meniscus {

namespace {

/// Returns the kinds of base meshes that may be suitable, the fastest first.
std::vector<BaseMeshKind> suitable_kinds(const Surface& surface, const EvenMeshOptions& options) {
  std::vector<BaseMeshKind> all;
  const double edge = edge_of_density(options.density);
  if (surface.probe_radius > 0.0 && edge >= RemeshTuning::long_contracted) all.push_back(BaseMeshKind::contracted);
  if (surface.probe_radius > 0.0 && edge >= RemeshTuning::long_edge) all.push_back(BaseMeshKind::coarse);
  all.push_back(BaseMeshKind::patches);
  return all;
}

/// Returns the triangles at vertices that changed since crossings were last searched for.
std::vector<std::uint32_t> unchecked_triangles(const MeshOnSurface& mesh,
                                               std::span<const std::array<std::uint32_t, 3>> all) {
  std::vector<std::uint32_t> unchecked;
  for (std::uint32_t t = 0; t < all.size(); ++t)
    if (std::ranges::any_of(all[t], [&](std::uint32_t v) { return mesh.vertex(v).unchecked; })) unchecked.push_back(t);
  return unchecked;
}

/// The triangles of a mesh that pass through others.
struct CrossingTriangles {
  std::vector<std::uint32_t> triangles;  ///< ascending
  bool has_too_many = false;             ///< true if there are so many crossings that single changes lead nowhere
};

/// Finds the triangles that pass through others. Pairs that did not cross at the last search and have not changed are
/// known not to cross.
CrossingTriangles find_crossings(MeshOnSurface& mesh) {
  const auto all = all_triangles(mesh.links());
  const std::vector<std::uint32_t> unchecked = unchecked_triangles(mesh, all);
  const bool few = unchecked.size() < all.size() / RemeshTuning::few_unchecked;
  const auto pairs = few ? crossings_of(unchecked, mesh.positions(), all)
                         : crossing_triangles(mesh.positions(), all, flat_fans(mesh.links(), mesh.positions()));
  std::vector<std::uint8_t> bad(all.size(), 0);
  for (const auto& [a, b] : pairs) bad[a] = bad[b] = 1;
  for (std::uint32_t v = 0; v < mesh.links().vertex_count(); ++v) mesh.vertex(v).unchecked = false;
  CrossingTriangles found{{}, pairs.size() > RemeshTuning::most_crossings * all.size()};
  for (std::uint32_t t = 0; t < bad.size(); ++t) {
    if (!bad[t]) continue;
    found.triangles.push_back(t);
    for (const std::uint32_t v : all[t]) mesh.vertex(v).unchecked = true;
  }
  return found;
}

/// Returns, ascending, the triangles that pass through others once their vertices are rounded to single precision, as
/// files hold them.
std::vector<std::uint32_t> crossing_in_single_precision(const MeshOnSurface& mesh) {
  std::vector<glm::dvec3> rounded;
  rounded.reserve(mesh.positions().size());
  for (const glm::dvec3& position : mesh.positions()) rounded.emplace_back(glm::vec3(position));
  std::set<std::uint32_t> bad;
  for (const auto& [a, b] : crossing_triangles(rounded, all_triangles(mesh.links()), flat_fans(mesh.links(), rounded)))
    bad.insert({a, b});
  return {bad.begin(), bad.end()};
}

std::vector<std::uint32_t> triangles_of(const std::vector<PointAtTriangle>& points) {
  std::vector<std::uint32_t> triangles;
  triangles.reserve(points.size());
  for (const PointAtTriangle& point : points) triangles.push_back(point.triangle);
  return triangles;
}

/// Returns a ball that contains a triangle and all points that are nearer to it than its longest edge is long.
Ball ball_around(const PlacedTriangle& t) {
  const glm::dvec3 middle = (t.at[0] + t.at[1] + t.at[2]) / 3.0;
  double reach = 0.0, longest = 0.0;
  for (int k = 0; k < 3; ++k) {
    reach = std::max(reach, glm::distance(middle, t.at[k]));
    longest = std::max(longest, glm::distance(t.at[k], t.at[(k + 1) % 3]));
  }
  return {middle, reach + longest};
}

void add_vertices(const MeshOnSurface& from, FineMesh& even) {
  const std::size_t count = from.positions().size();
  even.mesh.positions = from.positions();
  even.mesh.normals.resize(count);
  even.vertex_face.resize(count);
  even.vertex_atom.resize(count);
  tbb::parallel_for(std::size_t{0}, count, [&](std::size_t v) {
    const SurfacePoint at = from.point(static_cast<std::uint32_t>(v));
    even.mesh.normals[v] = from.walk().normal(at);
    even.vertex_face[v] = at.face;
    even.vertex_atom[v] = from.walk().nearest_atom(at);
  });
}

/// Adds the triangles; each belongs to the face below its centroid.
void add_triangles(const MeshOnSurface& from, TriangleMesh& mesh) {
  mesh.triangles = all_triangles(from.links());
  const std::size_t count = mesh.triangles.size();
  mesh.face.resize(count);
  mesh.kind.resize(count);
  mesh.patch.resize(count);
  mesh.component.resize(count);
  mesh.atom.resize(count);
  tbb::parallel_for(std::size_t{0}, count, [&](std::size_t t) {
    const auto& v = mesh.triangles[t];
    const glm::dvec3 middle = (mesh.positions[v[0]] + mesh.positions[v[1]] + mesh.positions[v[2]]) / 3.0;
    const SurfacePoint at = below(from, middle, v).value_or(from.point(v[0]));
    const Face& face = from.surface().faces[at.face];
    mesh.face[t] = at.face;
    mesh.kind[t] = face.kind;
    mesh.patch[t] = face.patch;
    mesh.component[t] = face.component;
    mesh.atom[t] = from.walk().nearest_atom(at);
  });
}

/// Adds the creases. At vertices on creases each triangle has the normal of the face that it lies nearest to.
void add_creases(const MeshOnSurface& from, TriangleMesh& mesh) {
  const HalfEdges& links = from.links();
  const Surface& surface = from.surface();
  std::vector<glm::dvec3> sum(mesh.positions.size(), glm::dvec3(0.0));
  for (std::uint32_t half = 0; half < links.half_edge_count(); ++half) {
    if (links.crease(half) != kNone && half < links.twin(half))
      mesh.sharp_edges.push_back({links.from(half), links.to(half)});
    const std::uint32_t v = links.from(half);
    if (!from.vertex(v).on_crease()) continue;
    const auto& [a, b, c] = mesh.triangles[half / 3];
    const glm::dvec3 flat = glm::cross(mesh.positions[b] - mesh.positions[a], mesh.positions[c] - mesh.positions[a]);
    glm::dvec3 best = mesh.normals[v];
    links.for_each_leaving(v, [&](std::uint32_t edge) {
      if (links.crease(edge) == kNone) return;
      for (const glm::dvec3& n : crease_normals(surface, surface.borders[links.crease(edge)], mesh.positions[v]))
        if (glm::dot(n, flat) > glm::dot(best, flat)) best = n;
    });
    mesh.sharp_corners.push_back(half);
    mesh.sharp_corner_normals.push_back(best);
    sum[v] += best;
  }
  for (std::size_t v = 0; v < sum.size(); ++v)
    if (const double size = glm::length(sum[v]); size > 1e-6) mesh.normals[v] = sum[v] / size;
}

/// Returns the tables of a finished mesh.
FineMesh to_fine_mesh(const MeshOnSurface& mesh, double tolerance) {
  FineMesh even;
  add_vertices(mesh, even);
  add_triangles(mesh, even.mesh);
  add_creases(mesh, even.mesh);
  even.mesh.tolerance = tolerance;
  return even;
}

/// Remeshes a surface from one kind of base mesh, in several attempts.
class EvenMeshing {
 public:
  /// `attempts` counts the attempts of all kinds of base meshes.
  EvenMeshing(const Surface& surface, const EvenMeshOptions& options, bool follow_creases, BaseMeshKind kind,
              std::uint32_t& attempts)
      : surface_(surface),
        options_(options),
        sizes_(surface, options),
        follow_creases_(follow_creases),
        contracted_(kind == BaseMeshKind::contracted),
        attempts_(attempts),
        creased_(surface.components.size(), false),
        walk_(surface),
        base_(base_mesh(surface, walk_, kind, RemeshTuning::coarser_base * sizes_.tolerance())),
        nearness_(surface, walk_, sizes_) {}

  FineMesh run() {
    std::vector<Ball> guarded;
    for (int attempt = 1;; ++attempt) {
      if (attempt == RemeshTuning::first_frozen && !sizes_.by_density())
        base_ = base_mesh(surface_, walk_, BaseMeshKind::patches, RemeshTuning::kept_base * options_.tolerance);
      ++attempts_;
      start_attempt(guarded);
      if (attempt >= RemeshTuning::first_frozen && !contracted_) freeze_guarded();
      std::vector<std::uint32_t> bad = even_out(attempt >= RemeshTuning::first_unmended);
      if (bad.empty()) bad = triangles_of_wrong_volume();
      if (bad.empty()) bad = find_all_crossings();
      if (bad.empty()) break;
      if (attempt == (contracted_ ? RemeshTuning::contracted_attempts : RemeshTuning::most_attempts))
        throw OpenSurfaceError(
            "no even mesh was found: {} triangles still cross others, lie too far from the surface or "
            "enclose another volume; choose a finer mesh",
            bad.size());
      for (Ball& place : guarded) place.radius *= RemeshTuning::place_growth;
      for (const std::uint32_t t : bad) guarded.push_back(ball_around(mesh_->placed(t)));
    }
    FineMesh even = to_fine_mesh(*mesh_, sizes_.by_density() ? 0.0 : options_.tolerance);
    even.attempts = attempts_;
    return even;
  }

 private:
  /// Begins an attempt with the base mesh; crossings are checked in the guarded balls.
  void start_attempt(const std::vector<Ball>& guarded) {
    if (!sizes_.by_density()) nearness_.set_targets(base_);
    walk_.bar(std::vector<bool>(surface_.borders.size(), false));
    mesh_.emplace(surface_, walk_, base_.mesh, base_.vertex_face, creases_to_follow(),
                  [this](const SurfacePoint& at) { return sizes_.edge_at(at); });
    mesh_->guard().guard_balls(guarded);
  }
  /// Returns true for each border that edges follow.
  std::vector<bool> creases_to_follow() const {
    // By tolerance, creases of bare balls cost minutes, and triangles come near enough without them.
    const bool of_bare_balls = surface_.probe_radius == 0.0 && !sizes_.by_density();
    if (!follow_creases_ || of_bare_balls) return std::vector<bool>(surface_.borders.size(), false);
    std::vector<bool> keep =
        creases_to_keep(surface_, [this](const glm::dvec3& x) { return sizes_.crease_edge_at(x); });
    for (std::uint32_t b = 0; b < keep.size(); ++b) {
      const Border& border = surface_.borders[b];
      if (creased_[surface_.faces[border.face[0]].component] && crease_angle(surface_, border) > 0.0) keep[b] = true;
    }
    return keep;
  }
  /// Keeps the base mesh where the guard is active.
  void freeze_guarded() {
    for (std::uint32_t v = 0; v < mesh_->links().vertex_count(); ++v)
      mesh_->vertex(v).frozen = mesh_->guard().is_guarded(v);
  }

  /// Remeshes in rounds. Returns triangles that pass through others and could not be separated, or that could not be
  /// brought near enough, or none. If `slivers_may_stay`, no slivers are mended in a mesh that already is as promised.
  std::vector<std::uint32_t> even_out(bool slivers_may_stay) {
    Remesher remesher(*mesh_);
    if (sizes_.by_density()) remesher.approach();
    for (int round = 0; round < RemeshTuning::rounds; ++round) {
      const std::uint32_t before = mesh_->links().triangle_count();
      remesher.even_out(1);
      mesh_->compact();
      if (sizes_.by_density() && mesh_->links().triangle_count() > RemeshTuning::fastest_growth * before) break;
    }
    const std::uint32_t most =
        RemeshTuning::most_growth * mesh_->links().triangle_count() + RemeshTuning::growth_allowed;
    for (int n = 1;; ++n) {
      if (!sizes_.by_density())
        if (std::vector<std::uint32_t> far = refine_far(most); !far.empty()) return far;
      const CrossingTriangles now = find_crossings(*mesh_);
      if (now.has_too_many) return now.triangles;
      if (slivers_may_stay && !sizes_.by_density() && now.triangles.empty() && nearness_.reaches_fine_vertices(*mesh_))
        return {};
      mend(now.triangles);
      std::vector<std::uint32_t> bad = find_crossings(*mesh_).triangles;
      if (sizes_.by_density()) bad = separate_crossings(std::move(bad));
      if (!bad.empty() || sizes_.by_density()) return bad;
      bad = triangles_of(nearness_.find_far_triangles(*mesh_));
      if (bad.empty() && nearness_.reaches_fine_vertices(*mesh_)) return bad;
      if (n == RemeshTuning::mendings) return bad;
    }
  }

  /// Searches all triangles for crossings, as a last check that does not rely on which have changed: at their
  /// positions, and at those rounded to the single precision of files.
  std::vector<std::uint32_t> find_all_crossings() {
    for (std::uint32_t v = 0; v < mesh_->links().vertex_count(); ++v) mesh_->vertex(v).unchecked = true;
    std::vector<std::uint32_t> bad = find_crossings(*mesh_).triangles;
    return bad.empty() ? crossing_in_single_precision(*mesh_) : bad;
  }

  MeshMender mender() {
    const auto allowed = [this](const PlacedTriangle& t) { return !nearness_.find_far_place(*mesh_, t); };
    if (!sizes_.by_density()) return {*mesh_, allowed};
    return {*mesh_, [](const PlacedTriangle&) { return true; },
            RemeshTuning::least_work + RemeshTuning::most_work_each * mesh_->links().triangle_count()};
  }
  void mend(const std::vector<std::uint32_t>& triangles) {
    mender().mend(triangles);
    mesh_->compact();
  }

  /// Refines triangles that pass through others, if they are few and as long as that helps; returns those that still
  /// do. If they are very few, new triangles must not cross others at first. If that achieves nothing, because halves
  /// of crossing triangles cross, too, they may.
  std::vector<std::uint32_t> separate_crossings(std::vector<std::uint32_t> bad) {
    const std::size_t most = std::max(
        RemeshTuning::few_far, std::size_t{mesh_->links().triangle_count()} / RemeshTuning::triangles_per_crossing);
    std::size_t fewest = bad.size();
    bool is_guarded = bad.size() <= RemeshTuning::few_far;
    for (int n = 0, futile = 0; n < RemeshTuning::crossing_refinements && futile < RemeshTuning::futile_refinements &&
                                !bad.empty() && bad.size() <= most;
         ++n) {
      if (is_guarded) mesh_->guard().guard_around(bad);
      const std::size_t most_triangles = mesh_->links().triangle_count() + RemeshTuning::most_growth_each * bad.size();
      refine(bad);
      if (mesh_->links().triangle_count() > most_triangles) return find_all_crossings();
      mender().mend_only(unchecked_triangles(*mesh_, all_triangles(mesh_->links())));
      mesh_->compact();
      bad = find_crossings(*mesh_).triangles;
      const bool helped = bad.size() < fewest;
      futile = helped ? 0 : futile + 1;
      if (!helped) is_guarded = !is_guarded;
      fewest = std::min(fewest, bad.size());
    }
    return bad;
  }

  /// Refines triangles that are too far away; returns those that remain so.
  std::vector<std::uint32_t> refine_far(std::uint32_t most) {
    std::vector<PointAtTriangle> far = nearness_.find_far_triangles(*mesh_);
    std::size_t fewest = far.size();
    for (int round = 0, futile = 0;
         round < RemeshTuning::refinements && futile < RemeshTuning::futile_refinements && !far.empty(); ++round) {
      if (mesh_->links().triangle_count() > most) break;
      if (far.size() > RemeshTuning::few_far) {
        refine(triangles_of(far));
        far = nearness_.find_far_triangles(*mesh_);
      } else {
        mender().insert_points(far);
      }
      if (far.size() <= mesh_->links().triangle_count() / RemeshTuning::most_mended) mend(triangles_of(far));
      far = nearness_.find_far_triangles(*mesh_);
      futile = far.size() < fewest ? 0 : futile + 1;
      fewest = std::min(fewest, far.size());
    }
    return triangles_of(far);
  }
  void refine(const std::vector<std::uint32_t>& triangles) {
    Remesher remesher(*mesh_);
    remesher.refine(triangles, RemeshTuning::refinement_factor);
    remesher.even_out(RemeshTuning::refined_rounds);
    mesh_->compact();
  }

  /// Returns the triangles of components with a volume other than the surface's. Splits, collapses and flips keep the
  /// topology, but only the volumes show whether triangles face outward. From now on the triangles of these components
  /// end at all their creases, however short these are.
  std::vector<std::uint32_t> triangles_of_wrong_volume() {
    TriangleMesh mesh;
    mesh.positions = mesh_->positions();
    mesh.triangles = all_triangles(mesh_->links());
    mesh.component.reserve(mesh.triangles.size());
    for (const auto& v : mesh.triangles) mesh.component.push_back(surface_.faces[mesh_->vertex(v[0]).face].component);
    const std::vector<MeshSums> sums = component_sums(mesh, surface_.components.size());
    const auto is_other = [&](std::uint32_t c) {
      const Component& component = surface_.components[c];
      if ((sums[c].volume > 0.0) != (component.volume > 0.0)) return true;
      if (sizes_.by_density() || options_.tolerance_at) return false;
      return std::abs(sums[c].volume - component.volume) > options_.tolerance * component.area + 1e-9;
    };
    std::vector<std::uint32_t> bad;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      if (!is_other(mesh.component[t])) continue;
      bad.push_back(t);
      creased_[mesh.component[t]] = true;
    }
    return bad;
  }

  const Surface& surface_;
  const EvenMeshOptions& options_;
  EvenSizes sizes_;
  bool follow_creases_, contracted_;
  std::uint32_t& attempts_;
  std::vector<bool> creased_;  ///< per component: true if edges follow all its creases
  SurfaceWalk walk_;
  BaseMesh base_;
  MeshNearness nearness_;
  std::optional<MeshOnSurface> mesh_;
};

}  // namespace

FineMesh even_mesh(const Surface& surface, const EvenMeshOptions& options) {
  if (options.density != 0.0 && !(options.density >= kSmallestDensity && options.density <= kLargestDensity))
    throw Error("mesh density: {} vertices per Å²; give {} to {}", options.density, kSmallestDensity, kLargestDensity);
  if (options.density == 0.0 && !(options.tolerance > 0.0 && std::isfinite(options.tolerance)))
    throw Error("mesh tolerance: {} Å; give a number above 0", options.tolerance);
  // Where creases crowd, triangles that have to end at them may find no place. The last try ignores creases, and
  // triangles become smaller there.
  std::uint32_t attempts = 0;
  for (const BaseMeshKind kind : suitable_kinds(surface, options)) {
    try {
      return EvenMeshing(surface, options, true, kind, attempts).run();
    } catch (const OpenSurfaceError&) {
    }
  }
  return EvenMeshing(surface, options, false, BaseMeshKind::patches, attempts).run();
}

}  // namespace meniscus
