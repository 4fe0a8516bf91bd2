// SPDX-License-Identifier: BSD-3-Clause
// Components of the reduced surface compared with the surface's: a cage whose cavity the outside cuts into, and others.
#include "core/surface/reduced_components.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "core/base/progress.h"
#include "core/surface/compute_surface.h"
#include "core/surface/measure.h"
#include "tests/support/molecules.h"

namespace meniscus::testing {
namespace {

ComponentSurface component_surface(const Balls& balls, double probe_radius = kWater) {
  const auto engine = make_cpu_engine();
  StageClock unused;
  return compute_component_surface(*engine, balls, probe_radius, unused);
}

// Six carbons on the axes. The probe is held in the middle, and at each of the eight windows, too narrow for it, a
// probe inside and one outside are 1.97 Å apart, which is less than two radii.
constexpr double kCage = 3.6;
Balls cage() { return octahedron(kCage * std::numbers::sqrt2); }

TEST(ReducedComponents, ACavityThatTheOutsideCutsIntoIsAComponentOfItsOwn) {
  const Surface exact = compute_surface_cpu(cage(), kWater);
  ASSERT_EQ(exact.components.size(), 1u);
  EXPECT_EQ(exact.components[0].euler, 2 + 2 - 2 * 8);  // two spheres, joined through eight windows
  const ReducedComponents of_exact = reduced_components(exact);
  EXPECT_EQ(of_exact.count, 2u);
  EXPECT_TRUE(cut_each_other(exact, of_exact));

  const ComponentSurface result = component_surface(cage());
  ASSERT_TRUE(result.surface.certificate.closed);
  ASSERT_EQ(result.components.count, 2u);
  ASSERT_EQ(result.surface.components.size(), 2u);
  for (const Component& sheet : result.surface.components) EXPECT_EQ(sheet.euler, 2);
  EXPECT_FALSE(cut_each_other(result.surface, result.components));
  const auto sizes = sizes_of(result.surface, result.components);
  EXPECT_GT(sizes[0].volume, 0);
  EXPECT_LT(sizes[1].volume, -4.0 / 3.0 * std::numbers::pi * std::pow(kWater, 3));
}

// A ball in the middle leaves the probe no room there, and touches nothing of the outside.
TEST(ReducedComponents, TheOutsideIsWhatItIsWithoutTheCavity) {
  Balls filled = cage();
  filled.push_back({{0, 0, 0}, 0.5});
  const Surface outside = compute_surface_cpu(filled, kWater);
  ASSERT_EQ(outside.components.size(), 1u);
  const ComponentSurface both = component_surface(cage());
  const auto sizes = sizes_of(both.surface, both.components);
  EXPECT_NEAR(sizes[0].area(), outside.area, 1e-9 * outside.area);
  EXPECT_NEAR(sizes[0].volume, outside.volume, 1e-9 * outside.volume);
}

// Both surfaces have the same rolling probes; they differ only where probes meet.
TEST(ReducedComponents, OnlyReentrantPatchesDependOnWhoCutsThem) {
  const Surface exact = compute_surface_cpu(cage(), kWater);
  const ComponentSurface own = component_surface(cage());
  const auto total = [](const Surface& surface, PatchKind kind) {
    double area = 0;
    for (const Face& face : surface.faces) area += face.kind == kind ? face.area : 0;
    return area;
  };
  for (const PatchKind kind : {PatchKind::convex, PatchKind::toroidal})
    EXPECT_NEAR(total(own.surface, kind), total(exact, kind), 1e-9 * exact.area);
  EXPECT_GT(total(own.surface, PatchKind::concave), total(exact, PatchKind::concave) + 1);
}

TEST(ReducedComponents, ASheetThatPinchesItselfIsOneComponent) {
  const Balls pair = two_atoms(5.9);  // the probe rolls on a circle of 0.97 Å: two closed sheets, each with a tip
  const ComponentSurface result = component_surface(pair);
  EXPECT_EQ(result.surface.components.size(), 2u);
  EXPECT_EQ(result.components.count, 1u);
}

TEST(ReducedComponents, MoleculesFarApartAreTwoLargestFirst) {
  const ComponentSurface result = component_surface({{{0, 0, 0}, 1.0}, {{20, 0, 0}, 2.0}});
  ASSERT_EQ(result.components.count, 2u);
  const auto sizes = sizes_of(result.surface, result.components);
  for (const auto& [n, r] : {std::pair<std::size_t, double>{0, 2.0}, {1, 1.0}}) {
    EXPECT_NEAR(sizes[n].contact, 4 * std::numbers::pi * r * r, 1e-9);
    EXPECT_NEAR(sizes[n].accessible, 4 * std::numbers::pi * (r + kWater) * (r + kWater), 1e-9);
    EXPECT_NEAR(sizes[n].volume, 4.0 / 3.0 * std::numbers::pi * r * r * r, 1e-9);
  }
}

TEST(ReducedComponents, WithoutAProbeTheyAreThoseOfTheSurface) {
  const ComponentSurface result = component_surface(cage(), 0.0);
  EXPECT_EQ(result.components.count, result.surface.components.size());
}

// Closed sheets, each of one component, have all of the area in spite of any ties.
TEST(ReducedComponents, EveryDegenerateMoleculeHasThem) {
  for (const NamedBalls& molecule : degenerate_molecules()) {
    SCOPED_TRACE(molecule.name);
    const ComponentSurface result = component_surface(molecule.balls, molecule.probe_radius);
    ASSERT_TRUE(result.surface.certificate.closed);
    std::vector<std::uint32_t> of_sheet(result.surface.components.size(), kNone);
    for (std::size_t f = 0; f < result.surface.faces.size(); ++f) {
      std::uint32_t& component = of_sheet[result.surface.faces[f].component];
      if (component == kNone) component = result.components.of_face[f];
      EXPECT_EQ(component, result.components.of_face[f]);
    }
    double area = 0, volume = 0;
    for (const ReducedComponentSize& size : sizes_of(result.surface, result.components)) {
      area += size.area();
      volume += size.volume;
    }
    EXPECT_NEAR(area, result.surface.area, 1e-9 * (1 + result.surface.area));
    EXPECT_NEAR(volume, result.surface.volume, 1e-9 * (1 + std::abs(result.surface.volume)));
  }
}

TEST(ReducedComponents, GasesHaveThem) {
  std::size_t cut = 0;
  for (std::uint32_t n = 0; n < 120; ++n) {
    SCOPED_TRACE(n);
    const GasCase gas = gas_case(n);
    const ComponentSurface result = component_surface(gas.balls, gas.probe_radius);
    EXPECT_TRUE(result.surface.certificate.closed);
    if (!result.surface.certificate.closed) continue;
    EXPECT_FALSE(cut_each_other(result.surface, result.components));
    const Surface exact = compute_surface_cpu(gas.balls, gas.probe_radius);
    cut += cut_each_other(exact, reduced_components(exact));
  }
  EXPECT_GT(cut, 0u);
}

TEST(ReducedComponents, AtomsShareTheAreaOfEachComponent) {
  const ComponentSurface result = component_surface(cage());
  const auto sizes = sizes_of(result.surface, result.components);
  const auto areas = atom_areas(result.surface, result.components.of_face, result.components.count);
  ASSERT_EQ(areas.size(), 2u);
  for (std::size_t c = 0; c < 2; ++c)
    for (std::size_t a = 0; a < 6; ++a) {  // by symmetry each atom has a sixth
      EXPECT_NEAR(areas[c].surface[a], sizes[c].area() / 6, 1e-7);
      EXPECT_NEAR(areas[c].accessible[a], sizes[c].accessible / 6, 1e-7);
    }
}

}  // namespace
}  // namespace meniscus::testing
