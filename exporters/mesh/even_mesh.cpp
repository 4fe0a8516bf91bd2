// SPDX-License-Identifier: BSD-3-Clause
// Even meshes: a base mesh, rounds of remeshing, then shorter edges wherever the result is not as promised.
#include "exporters/mesh/even_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <mutex>
#include <optional>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <tbb/parallel_for.h>

#include "core/base/error.h"
#include "core/queries/distance.h"
#include "exporters/mesh/creases.h"
#include "exporters/mesh/evener.h"
#include "exporters/mesh/mesh_crossings.h"
#include "exporters/mesh/tessellate.h"

namespace meniscus {
namespace {

/// Vertices per Å² of even meshes.
constexpr double kSmallestDensity = 0.005, kLargestDensity = 1000.0;
/// Of edges of wanted length h: vertices per Å², times h². Equilateral triangles have 2 / sqrt(3) = 1.155; splitting
/// and collapsing leave edges a little shorter.
constexpr double kVerticesPerSquare = 1.34;
/// The share of the tolerance that the middle of an equilateral triangle with the edges wanted may take up: edges up to
/// 4/3 of that length stay.
constexpr double kShareOfTolerance = 0.62;
/// What is measured at places is less than what is between them.
constexpr double kMargin = 0.97;
/// The base is a scaffold: its tolerance follows that of the result between these (Å).
constexpr double kFinestBase = 1e-4, kCoarsestBase = 0.4;
constexpr int kBases = 4;
constexpr int kRounds = 6, kRefinedRounds = 3, kRefinements = 12;
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

class EvenMeshing {
 public:
  EvenMeshing(const Surface& surface, const EvenMeshOptions& options, bool follow_creases)
      : surface_(surface),
        options_(options),
        ball_radius_(smallest_radius(surface)),
        edge_of_density_(options.density > 0.0 ? std::sqrt(kVerticesPerSquare / options.density) : 0.0),
        evener_(surface, base(), follow_creases ? creases() : std::vector<bool>(surface.borders.size(), false),
                [this](const SurfacePoint& at) { return edge_at(at.position, radius(at.face)); }) {}

  EvenMesh run() {
    for (int round = 0; round < kRounds; ++round) {
      evener_.even_out(1);
      evener_.compact();
    }
    evener_.mend();
    const std::uint32_t most = kMostGrowth * evener_.links().triangle_count() + kGrowthAllowed;
    for (int round = 0;; ++round) {
      evener_.compact();
      const std::vector<std::uint32_t> bad = to_refine();
      if (bad.empty()) break;
      if (round == kRefinements || evener_.links().triangle_count() > most)
        throw OpenSurfaceError(
            fmt::format("no even mesh was found: {} triangles stay too far away or in others' way; ask for a finer one",
                        bad.size()));
      evener_.refine(bad, kFiner);
      evener_.even_out(kRefinedRounds);
      evener_.mend();
    }
    return result();
  }

 private:
  std::vector<bool> creases() const {
    return creases_to_keep(surface_, [this](const glm::dvec3& x) { return edge_at(x, probe()); });
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

  /// Some surfaces have no patch-aligned mesh at a coarse tolerance.
  TriangleMesh base() const {
    double tolerance =
        options_.density > 0.0 ? edge_of_density_ * edge_of_density_ / (6.0 * probe()) : options_.tolerance;
    tolerance = std::clamp(2.0 * tolerance, kFinestBase, kCoarsestBase);
    for (int n = 1;; ++n, tolerance *= 0.25) {
      try {
        return tessellate(surface_, {tolerance, false});
      } catch (const OpenSurfaceError&) {
        if (n == kBases) throw;
      }
    }
  }

  /// The point of the surface under one of a triangle, as its corners lead there.
  std::optional<SurfacePoint> below(const glm::dvec3& x, const std::array<std::uint32_t, 3>& corners) const {
    for (const bool smooth : {true, false})  // a vertex of a crease is on both sides of it
      for (const std::uint32_t v : corners) {
        if (evener_.on_crease(v) == smooth) continue;
        if (const auto at = evener_.walk().below(x, evener_.point(v).face)) return at;
      }
    return std::nullopt;
  }

  bool too_far(std::uint32_t triangle) const {
    const auto v = evener_.links().corners(triangle);
    const auto& x = evener_.positions();
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

  std::vector<std::uint32_t> to_refine() const {
    const LinkedTriangles& links = evener_.links();
    std::vector<std::uint8_t> bad(links.triangle_count(), 0);
    if (options_.density == 0.0)
      tbb::parallel_for(std::uint32_t{0}, links.triangle_count(), [&](std::uint32_t t) { bad[t] = too_far(t); });
    for (const auto& [a, b] : crossing_triangles(evener_.positions(), triangles())) bad[a] = bad[b] = 1;
    std::vector<std::uint32_t> found;
    for (std::uint32_t t = 0; t < bad.size(); ++t)
      if (bad[t]) found.push_back(t);
    return found;
  }
  std::vector<std::array<std::uint32_t, 3>> triangles() const {
    std::vector<std::array<std::uint32_t, 3>> all(evener_.links().triangle_count());
    for (std::uint32_t t = 0; t < all.size(); ++t) all[t] = evener_.links().corners(t);
    return all;
  }

  EvenMesh result() const {
    EvenMesh even;
    TriangleMesh& mesh = even.mesh;
    mesh.positions = evener_.positions();
    mesh.triangles = triangles();
    mesh.tolerance = options_.density > 0.0 ? 0.0 : options_.tolerance;
    const std::size_t vertices = mesh.positions.size(), count = mesh.triangles.size();
    mesh.normals.resize(vertices);
    even.vertex_face.resize(vertices);
    even.vertex_atom.resize(vertices);
    tbb::parallel_for(std::size_t{0}, vertices, [&](std::size_t v) {
      const SurfacePoint at = evener_.point(static_cast<std::uint32_t>(v));
      mesh.normals[v] = evener_.walk().normal(at);
      even.vertex_face[v] = at.face;
      even.vertex_atom[v] = evener_.walk().nearest_atom(at);
    });
    mesh.face.resize(count);
    mesh.kind.resize(count);
    mesh.patch.resize(count);
    mesh.component.resize(count);
    mesh.atom.resize(count);
    tbb::parallel_for(std::size_t{0}, count, [&](std::size_t t) {
      const auto& v = mesh.triangles[t];
      const glm::dvec3 middle = (mesh.positions[v[0]] + mesh.positions[v[1]] + mesh.positions[v[2]]) / 3.0;
      const SurfacePoint at = below(middle, v).value_or(evener_.point(v[0]));
      const Face& face = surface_.faces[at.face];
      mesh.face[t] = at.face;
      mesh.kind[t] = face.kind;
      mesh.patch[t] = face.patch;
      mesh.component[t] = face.component;
      mesh.atom[t] = evener_.walk().nearest_atom(at);
    });
    add_creases(mesh);
    check(mesh);
    return even;
  }

  /// At vertices on creases each triangle has the normal of the face that it lies nearest to.
  void add_creases(TriangleMesh& mesh) const {
    const LinkedTriangles& links = evener_.links();
    std::vector<glm::dvec3> sum(mesh.positions.size(), glm::dvec3(0.0));
    for (std::uint32_t half = 0; half < links.half_edge_count(); ++half) {
      if (links.crease(half) != kNone && half < links.twin(half))
        mesh.sharp_edges.push_back({links.from(half), links.to(half)});
      const std::uint32_t v = links.from(half);
      if (!evener_.on_crease(v)) continue;
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
  void check(const TriangleMesh& mesh) const {
    const std::vector<MeshSums> sums = component_sums(mesh, surface_.components.size());
    for (std::size_t c = 0; c < sums.size(); ++c) {
      const Component& component = surface_.components[c];
      const bool same = (sums[c].volume > 0.0) == (component.volume > 0.0);
      const double off = std::abs(sums[c].volume - component.volume);
      if (!same || (mesh.tolerance > 0.0 && !options_.tolerance_at && off > mesh.tolerance * component.area + 1e-9))
        throw OpenSurfaceError(fmt::format("component {} has {:.6g} Å³, its even mesh {:.6g}; ask for a finer one", c,
                                           component.volume, sums[c].volume));
    }
  }

  const Surface& surface_;
  const EvenMeshOptions& options_;
  double ball_radius_;  ///< Å, the smallest: of curvature where the probe has none
  double edge_of_density_;
  Evener evener_;
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
  try {
    return EvenMeshing(surface, options, true).run();
  } catch (const OpenSurfaceError&) {
    return EvenMeshing(surface, options, false).run();
  }
}

}  // namespace meniscus
