// SPDX-License-Identifier: BSD-3-Clause
// Averages the curvature of a mesh around each vertex, and computes how much of the sky vertices and atoms see.
#include "core/mesh/mesh_attributes.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <numeric>

#include <glm/geometric.hpp>
#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include "core/mesh/triangle_mesh.h"
#include "core/render/cpu/occluders.h"

namespace meniscus {
namespace {

/// Integrals over the part of the mesh that belongs to a vertex.
struct Measure {
  double area = 0.0, mean = 0.0, gaussian = 0.0;
};

/// Measures the curvature at each vertex of a mesh, and averages these measures.
class Smoothing {
 public:
  explicit Smoothing(const TriangleMesh& mesh) : mesh_(mesh), measures_(mesh.positions.size()) {
    link_edges();
    for (Measure& m : measures_) m.gaussian = 2.0 * std::numbers::pi;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) measure(t);
  }

  /// Returns the mean curvature within `radius` of a vertex. `seen` and `queue` are scratch memory of the caller.
  Curvature average_around(std::uint32_t vertex, double radius, std::vector<std::uint32_t>& seen,
                           std::vector<std::uint32_t>& queue) const {
    Measure sum;
    queue.assign(1, vertex);
    seen[vertex] = vertex;
    for (std::size_t n = 0; n < queue.size(); ++n) {
      const Measure& m = measures_[queue[n]];
      sum.area += m.area;
      sum.mean += m.mean;
      sum.gaussian += m.gaussian;
      for (std::uint32_t i = first_[queue[n]]; i < first_[queue[n] + 1]; ++i) {
        const std::uint32_t next = end_[i].vertex;
        if (seen[next] == vertex || glm::distance(mesh_.positions[next], mesh_.positions[vertex]) > radius) continue;
        seen[next] = vertex;
        queue.push_back(next);
      }
    }
    return {sum.mean / sum.area, sum.gaussian / sum.area};
  }

 private:
  /// An edge that leaves a vertex, and the triangle on its left.
  struct End {
    std::uint32_t vertex, triangle;
  };

  void link_edges() {
    first_.assign(mesh_.positions.size() + 1, 0);
    for (const auto& t : mesh_.triangles)
      for (const std::uint32_t v : t) ++first_[v];
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    end_.resize(first_.back());
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t)
      for (int k = 0; k < 3; ++k) end_[--first_[mesh_.triangles[t][k]]] = {mesh_.triangles[t][(k + 1) % 3], t};
  }

  glm::dvec3 cross(std::size_t t) const {
    const auto& [a, b, c] = mesh_.triangles[t];
    const auto& x = mesh_.positions;
    return glm::cross(x[b] - x[a], x[c] - x[a]);
  }

  /// Returns the triangle on the other side of an edge, or kNone.
  std::uint32_t triangle_across(std::uint32_t from, std::uint32_t to) const {
    for (std::uint32_t i = first_[to]; i < first_[to + 1]; ++i)
      if (end_[i].vertex == from) return end_[i].triangle;
    return kNone;
  }

  void measure(std::size_t t) {
    const glm::dvec3 normal = cross(t);
    const double twice_area = glm::length(normal);
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t a = mesh_.triangles[t][k], b = mesh_.triangles[t][(k + 1) % 3],
                          c = mesh_.triangles[t][(k + 2) % 3];
      const glm::dvec3 &x = mesh_.positions[a], along = mesh_.positions[b] - x;
      measures_[a].area += twice_area / 6.0;
      measures_[a].gaussian -= std::atan2(twice_area, glm::dot(along, mesh_.positions[c] - x));
      const std::uint32_t other = triangle_across(a, b);
      if (a > b || other == kNone) continue;
      // Half the angle times the length is the integral of the mean curvature; each end has half of it.
      const glm::dvec3 beyond = cross(other), direction = along / std::max(glm::length(along), 1e-300);
      const double angle = std::atan2(glm::dot(direction, glm::cross(normal, beyond)), glm::dot(normal, beyond));
      for (const std::uint32_t v : {a, b}) measures_[v].mean += 0.25 * angle * glm::length(along);
    }
  }

  const TriangleMesh& mesh_;
  std::vector<std::uint32_t> first_;  // per vertex: the start of its edges in end_, followed by their end
  std::vector<End> end_;
  std::vector<Measure> measures_;
};

}  // namespace

std::vector<Curvature> smoothed_curvatures(const TriangleMesh& mesh, double radius) {
  const Smoothing smoothing(mesh);
  std::vector<Curvature> smoothed(mesh.positions.size());
  struct Scratch {
    std::vector<std::uint32_t> seen, queue;
  };
  tbb::enumerable_thread_specific<Scratch> scratches([&] { return Scratch{std::vector(smoothed.size(), kNone), {}}; });
  tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, static_cast<std::uint32_t>(smoothed.size()), 256),
                    [&](const auto& range) {
                      Scratch& scratch = scratches.local();
                      for (std::uint32_t v = range.begin(); v != range.end(); ++v)
                        smoothed[v] = smoothing.average_around(v, radius, scratch.seen, scratch.queue);
                    });
  return smoothed;
}

std::vector<float> vertex_open_sky(const Surface& surface, const TriangleMesh& mesh) {
  return sky_visibility(surface, {mesh.positions, mesh.normals});
}

std::vector<double> atom_open_sky(const Surface& surface, const TriangleMesh& mesh) {
  const std::vector<float> seen = vertex_open_sky(surface, mesh);
  std::vector<double> means(surface.atoms.size(), 0.0), areas = means;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    const glm::dvec3 &from = mesh.positions[a], side = mesh.positions[b] - from, other = mesh.positions[c] - from;
    const double area = glm::length(glm::cross(side, other));
    means[mesh.atom[t]] += area * static_cast<double>(seen[a] + seen[b] + seen[c]) / 3.0;
    areas[mesh.atom[t]] += area;
  }
  for (std::size_t n = 0; n < means.size(); ++n)
    if (areas[n] > 0.0) means[n] /= areas[n];
  return means;
}

}  // namespace meniscus
