// SPDX-License-Identifier: BSD-3-Clause
// The meshes that even ones begin with, looked at triangle by triangle: where their corners lie, where they face.
#include "core/mesh/base_mesh.h"

#include <map>
#include <set>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "core/surface/compute_surface.h"
#include "tests/support/molecules.h"

namespace meniscus::testing {
namespace {

/// Returns the faces whose triangles have a vertex.
std::vector<std::set<std::uint32_t>> faces_at(const TriangleMesh& mesh) {
  std::vector<std::set<std::uint32_t>> faces(mesh.positions.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (const std::uint32_t v : mesh.triangles[t]) faces[v].insert(mesh.face[t]);
  return faces;
}

/// Counts triangles that face away from the solvent at the point of the surface below their middle.
std::size_t folded(const Surface& surface, const TriangleMesh& mesh) {
  const SurfaceWalk walk(surface);
  std::size_t count = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [i, j, k] = mesh.triangles[t];
    const glm::dvec3 a = mesh.positions[i], b = mesh.positions[j], c = mesh.positions[k];
    const auto on = walk.below((a + b + c) / 3.0, mesh.face[t]);
    count += on && glm::dot(glm::cross(b - a, c - a), walk.normal(*on)) < 0.0;
  }
  return count;
}

TEST(CoarseMesh, FacesOutwardButForFewFolds) {
  for (const double probe : {0.5, 1.4, 3.0}) {
    const Surface surface = compute_surface_cpu(ubiquitin(), probe);
    const TriangleMesh mesh = coarse_mesh(surface, SurfaceWalk(surface));
    EXPECT_LT(folded(surface, mesh), mesh.triangles.size() / 500) << probe;
  }
  const Surface cage = compute_surface_cpu(c60(), kWater);
  EXPECT_EQ(folded(cage, coarse_mesh(cage, SurfaceWalk(cage))), 0u);
}

// A vertex of one face alone is in it, not somewhere on its sphere or torus.
TEST(CoarseMesh, VerticesInsideFacesLieOnThem) {
  for (const double probe : {1.4, 3.0}) {
    const Surface surface = compute_surface_cpu(ubiquitin(), probe);
    const SurfaceWalk walk(surface);
    const TriangleMesh mesh = coarse_mesh(surface, walk);
    const std::vector<std::set<std::uint32_t>> faces = faces_at(mesh);
    std::size_t inside = 0;
    for (std::size_t v = 0; v < faces.size(); ++v) {
      if (faces[v].size() != 1) continue;
      ++inside;
      const auto on = walk.below(mesh.positions[v], *faces[v].begin());
      EXPECT_TRUE(on && on->face == *faces[v].begin()) << "vertex " << v << ", probe " << probe;
    }
    EXPECT_GT(inside, 500u);
  }
}

// Quadrangles need no vertex of their own.
TEST(CoarseMesh, ASaddleWithFourCornersIsTwoTriangles) {
  const Surface surface = compute_surface_cpu(c60(), kWater);
  const TriangleMesh mesh = coarse_mesh(surface, SurfaceWalk(surface));
  const std::vector<std::set<std::uint32_t>> faces = faces_at(mesh);
  std::map<std::uint32_t, std::set<std::uint32_t>> rim;
  std::map<std::uint32_t, std::size_t> triangles;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    ++triangles[mesh.face[t]];
    for (const std::uint32_t v : mesh.triangles[t])
      if (faces[v].size() > 1) rim[mesh.face[t]].insert(v);
  }
  std::size_t quadrangles = 0;
  for (const auto& [face, corners] : rim) {
    if (surface.faces[face].kind != PatchKind::toroidal || corners.size() != 4) continue;
    ++quadrangles;
    EXPECT_EQ(triangles[face], 2u) << "face " << face;
  }
  EXPECT_GT(quadrangles, 50u);
}

}  // namespace
}  // namespace meniscus::testing
