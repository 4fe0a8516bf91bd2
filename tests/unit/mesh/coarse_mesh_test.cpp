// SPDX-License-Identifier: BSD-3-Clause
// The meshes that even ones begin with, looked at triangle by triangle: where their corners lie, where they face.
#include "core/mesh/base_mesh.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "core/mesh/tessellate.h"
#include "core/surface/compute_surface.h"
#include "tests/support/molecules.h"

namespace meniscus::testing {
namespace {

/// The faces whose triangles have a vertex.
std::vector<std::set<std::uint32_t>> faces_at(const TriangleMesh& mesh) {
  std::vector<std::set<std::uint32_t>> faces(mesh.positions.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (const std::uint32_t v : mesh.triangles[t]) faces[v].insert(mesh.face[t]);
  return faces;
}

/// Triangles that face away from the solvent at the point of the surface below their middle.
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

/// Where the corners of each triangle are, and its face; ascending.
std::vector<std::pair<std::array<std::array<double, 3>, 3>, std::uint32_t>> placed(const TriangleMesh& mesh) {
  std::vector<std::pair<std::array<std::array<double, 3>, 3>, std::uint32_t>> all(mesh.triangles.size());
  for (std::size_t t = 0; t < all.size(); ++t) {
    for (int k = 0; k < 3; ++k) {
      const glm::dvec3& x = mesh.positions[mesh.triangles[t][k]];
      all[t].first[k] = {x.x, x.y, x.z};
    }
    all[t].second = mesh.face[t];
  }
  std::ranges::sort(all);
  return all;
}

// Of many triangles those that follow one another lie near one another; else all is as it was.
TEST(BaseMesh, PutsManyTrianglesInOrder) {
  constexpr double kFine = 0.008;
  const Surface surface = compute_surface_cpu(ubiquitin(), kWater);
  const SurfaceWalk walk(surface);
  const TriangleMesh made = tessellate(surface, {kFine, false});
  const BaseMesh base = base_mesh(surface, walk, Beginning::patches, kFine);
  ASSERT_GT(made.triangles.size(), 200'000u);
  EXPECT_EQ(base.mesh.positions.size(), made.positions.size());
  EXPECT_TRUE(placed(base.mesh) == placed(made));
  ASSERT_EQ(base.vertex_face.size(), base.mesh.positions.size());
  for (std::size_t v = 0; v < base.vertex_face.size(); v += 97) {
    const auto on = walk.below(base.mesh.positions[v], base.vertex_face[v]);
    EXPECT_TRUE(on && glm::distance(on->position, base.mesh.positions[v]) < 1e-6) << v;
  }
  const auto far_jumps = [](const TriangleMesh& mesh) {
    std::size_t count = 0;
    for (std::size_t t = 1; t < mesh.triangles.size(); ++t)
      count += glm::distance(mesh.positions[mesh.triangles[t][0]], mesh.positions[mesh.triangles[t - 1][0]]) > 4.0;
    return count;
  };
  EXPECT_LT(far_jumps(base.mesh), made.triangles.size() / 100);
}

}  // namespace
}  // namespace meniscus::testing
