// SPDX-License-Identifier: BSD-3-Clause
// Patches of chosen atoms: sums, closed forms, and the pieces of a fine mesh.
#include "core/queries/surface_parts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "core/math/union_find.h"
#include "core/mesh/tessellate.h"
#include "core/surface/compute_surface.h"
#include "core/surface/measure.h"
#include "tests/support/molecules.h"

namespace meniscus {
namespace {

using Choice = std::vector<bool>;

double sum_of(const std::vector<AtomPatch>& patches) {
  return std::accumulate(patches.begin(), patches.end(), 0.0,
                         [](double sum, const AtomPatch& patch) { return sum + patch.area; });
}

/// Returns the same areas by a mesh whose triangles belong to one atom each: joined by their edges, the largest first.
/// Triangles of one re-entrant patch and atom count as joined.
std::vector<double> by_mesh(const TriangleMesh& mesh, const Choice& chosen) {
  UnionFind joined(mesh.triangles.size());
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> by_edge, by_patch;
  const auto join = [&](auto& seen, const auto& key, std::uint32_t t) {
    const auto [first, is_new] = seen.try_emplace(key, t);
    if (!is_new && chosen[mesh.atom[t]] && chosen[mesh.atom[first->second]]) joined.unite(t, first->second);
  };
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& corners = mesh.triangles[t];
    for (int c = 0; c < 3; ++c) join(by_edge, std::pair(std::minmax({corners[c], corners[(c + 1) % 3]})), t);
    if (mesh.kind[t] == PatchKind::concave) join(by_patch, std::pair(mesh.patch[t], mesh.atom[t]), t);
  }
  std::map<std::uint32_t, double> areas;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    if (!chosen[mesh.atom[t]]) continue;
    const auto& [a, b, c] = mesh.triangles[t];
    areas[joined.find(t)] +=
        0.5 * glm::length(glm::cross(mesh.positions[b] - mesh.positions[a], mesh.positions[c] - mesh.positions[a]));
  }
  std::vector<double> found;
  for (const auto& [first, area] : areas) found.push_back(area);
  std::ranges::sort(found, std::greater<>());
  return found;
}

TEST(AtomPatches, OfABallAreTheBall) {
  const Surface surface = compute_surface_cpu({{{{1.0, 2.0, 3.0}, 2.0}}}, testing::kWater);
  const std::vector<AtomPatch> patches = atom_patches(surface, {true});
  ASSERT_EQ(patches.size(), 1u);
  EXPECT_DOUBLE_EQ(patches[0].area, surface.area);
  EXPECT_TRUE(atom_patches(surface, {false}).empty());
}

TEST(AtomPatches, OfApartAtomsAreTwo) {
  const Surface apart = compute_surface_cpu(testing::two_atoms(9.0, 1.5, 1.7), testing::kWater);
  const std::vector<AtomPatch> two = atom_patches(apart, {true, true});
  ASSERT_EQ(two.size(), 2u);
  EXPECT_EQ(two[0].atoms, std::vector<std::uint32_t>{1});  // the larger atom
  EXPECT_NEAR(sum_of(two), apart.area, 1e-9);
  const Surface together = compute_surface_cpu(testing::two_atoms(3.0), testing::kWater);
  const std::vector<AtomPatch> one = atom_patches(together, {true, true});
  ASSERT_EQ(one.size(), 1u);
  EXPECT_NEAR(one[0].area, together.area, 1e-9);
  EXPECT_EQ(one[0].atoms, (std::vector<std::uint32_t>{0, 1}));
}

TEST(AtomPatches, EndWhereAtomsThatAreNotChosenBegin) {
  // The ends of a row of three are two patches, and a spindle parts even neighbours.
  const Surface row = compute_surface_cpu(testing::collinear(3, 2.5), testing::kWater);
  EXPECT_EQ(atom_patches(row, {true, false, true}).size(), 2u);
  EXPECT_EQ(atom_patches(row, {true, true, false}).size(), 1u);
  const Surface spindle = compute_surface_cpu(testing::two_atoms(5.8), testing::kWater);
  ASSERT_EQ(spindle.counts().spindle, 1u);
  EXPECT_EQ(atom_patches(spindle, {true, true}).size(), spindle.components.size());
}

TEST(AtomPatches, AddUpToTheAreasOfTheAtoms) {
  for (const testing::NamedBalls& molecule : testing::degenerate_molecules()) {
    SCOPED_TRACE(molecule.name);
    const Surface surface = compute_surface_cpu(molecule.balls, molecule.probe_radius);
    const AtomAreas areas = atom_areas(surface);
    Choice chosen(surface.atoms.size());
    double wanted = 0.0;
    for (std::size_t a = 0; a < chosen.size(); ++a) {
      chosen[a] = a % 3 != 1;
      if (chosen[a]) wanted += areas.surface[a];
    }
    EXPECT_NEAR(sum_of(atom_patches(surface, chosen)), wanted, 1e-9 * (1.0 + surface.area));
    const std::vector<AtomPatch> all = atom_patches(surface, Choice(surface.atoms.size(), true));
    EXPECT_NEAR(sum_of(all), surface.area, 1e-9 * (1.0 + surface.area));
    EXPECT_LE(all.size(), surface.components.size());
  }
}

TEST(AtomPatches, AreThePiecesOfAMesh) {
  const Surface surface = compute_surface_cpu(testing::ubiquitin(), testing::kWater);
  const TriangleMesh mesh = tessellate(surface, {0.01, true});
  for (const std::uint32_t step : {2u, 3u, 7u}) {
    Choice chosen(surface.atoms.size());
    for (std::uint32_t a = 0; a < chosen.size(); ++a) chosen[a] = a / 5 % step == 0;
    const std::vector<AtomPatch> patches = atom_patches(surface, chosen);
    const std::vector<double> meshed = by_mesh(mesh, chosen);
    ASSERT_EQ(patches.size(), meshed.size()) << "one of " << step;
    EXPECT_GT(patches.size(), 5u);
    for (std::size_t n = 0; n < patches.size(); ++n)
      EXPECT_NEAR(patches[n].area, meshed[n], 0.02 + 0.01 * patches[n].area) << n;
  }
}

TEST(AtomPatches, LeavesOutAtomsOfSmallPatchesAlone) {
  for (const std::uint32_t n : {3u, 17u, 40u}) {
    const testing::GasCase gas = testing::gas_case(n);
    const Surface surface = compute_surface_cpu(gas.balls, gas.probe_radius);
    Choice chosen;
    for (std::size_t a = 0; a < surface.atoms.size(); ++a) chosen.push_back(a % 3 != 0);
    EXPECT_EQ(atoms_of_patches(surface, chosen, 0.0), chosen);
    const std::vector<AtomPatch> patches = atom_patches(surface, chosen);
    const double least = patches[patches.size() / 2].area;
    const Choice left = atoms_of_patches(surface, chosen, least);
    for (const AtomPatch& patch : patches) {
      const auto count = std::ranges::count_if(patch.atoms, [&](std::uint32_t atom) { return left[atom]; });
      EXPECT_TRUE(count == 0 || count == static_cast<std::ptrdiff_t>(patch.atoms.size())) << "whole or not at all";
      const bool shares = std::ranges::any_of(patches, [&](const AtomPatch& other) {
        return &other != &patch && std::ranges::any_of(other.atoms, [&](std::uint32_t a) {
          return std::ranges::count(patch.atoms, a) > 0;
        });
      });
      EXPECT_TRUE(patch.area < least || count > 0);
      EXPECT_TRUE(patch.area >= least || shares || count == 0);
    }
    EXPECT_EQ(std::ranges::count(atoms_of_patches(surface, chosen, surface.area + 1.0), true), 0);
  }
}

}  // namespace
}  // namespace meniscus
