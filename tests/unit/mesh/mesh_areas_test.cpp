// SPDX-License-Identifier: BSD-3-Clause
// The triangles of an atom come to its exact area as the mesh gets finer, of parts of a surface too.
#include <algorithm>
#include <cmath>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "core/mesh/tessellate.h"
#include "core/queries/surface_parts.h"
#include "core/surface/compute_surface.h"
#include "core/surface/measure.h"
#include "tests/support/molecules.h"

namespace meniscus {
namespace {

/// Returns the largest difference of an atom's triangles to its exact area, Å².
double worst_atom(const Surface& surface, double tolerance) {
  const TriangleMesh mesh = tessellate(surface, {tolerance, true});
  std::vector<double> area(surface.atoms.size(), 0.0);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    area[mesh.atom[t]] +=
        0.5 * glm::length(glm::cross(mesh.positions[b] - mesh.positions[a], mesh.positions[c] - mesh.positions[a]));
  }
  const AtomAreas exact = atom_areas(surface);
  double worst = 0.0;
  for (std::size_t n = 0; n < area.size(); ++n) worst = std::max(worst, std::abs(area[n] - exact.surface[n]));
  return worst;
}

TEST(MeshAreas, OfAtomsConvergeToTheClosedForm) {
  for (const testing::Balls& balls : {testing::ubiquitin(), testing::octahedron(3.0), testing::two_atoms(5.5)}) {
    const Surface surface = compute_surface_cpu(balls, testing::kWater);
    const double coarse = worst_atom(surface, 0.02), fine = worst_atom(surface, 0.005);
    EXPECT_LT(coarse, 1.0);
    EXPECT_LT(fine, 0.4 * coarse);
  }
}

TEST(MeshAreas, OfPartsToo) {
  for (const testing::Balls& balls : {testing::ubiquitin(), testing::c60(), testing::two_atoms(5.8)}) {
    const Surface whole = compute_surface_cpu(balls, testing::kWater);
    ASSERT_GT(whole.components.size(), 1u);
    for (std::size_t c = 0; c < whole.components.size(); ++c) {
      std::vector<bool> keep(whole.components.size(), false);
      keep[c] = true;
      const Surface part = part_of(whole, keep).surface;
      EXPECT_LT(worst_atom(part, 0.005), 0.3) << "component " << c;
      const MeshMeasure measured = measure(tessellate(part, {0.005, true}));
      EXPECT_TRUE(measured.closed);
      EXPECT_EQ(measured.euler(), part.components[0].euler);
    }
  }
}

}  // namespace
}  // namespace meniscus
