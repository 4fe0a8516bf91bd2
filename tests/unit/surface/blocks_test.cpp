// SPDX-License-Identifier: BSD-3-Clause
// Surfaces computed block by block have the numbers of the whole surface, to the last bit; blocks that do not fit are
// not closed.
#include "core/surface/blocks.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <numeric>
#include <span>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/progress.h"
#include "core/math/ball.h"
#include "core/surface/compute_surface.h"
#include "core/surface/measure.h"
#include "tests/support/molecules.h"

namespace meniscus::testing {
namespace {

using Blocks = std::vector<std::vector<std::uint32_t>>;

Surface in_blocks(const Balls& balls, double probe_radius, const Blocks& blocks, int attempts = 1,
                  ClipPlanes planes = ClipPlanes::left_out) {
  StageClock unused;
  return surface_in_blocks(balls, probe_radius, blocks, halo_reach(balls, probe_radius), planes, unused, attempts);
}

void expect_equal(const Surface& blocks, const Surface& whole) {
  ASSERT_TRUE(blocks.certificate.closed);
  ASSERT_TRUE(blocks.sums);
  EXPECT_EQ(blocks.area, whole.area);
  EXPECT_EQ(blocks.volume, whole.volume);
  ASSERT_EQ(blocks.components.size(), whole.components.size());
  for (std::size_t c = 0; c < whole.components.size(); ++c) {
    EXPECT_EQ(blocks.components[c].kind, whole.components[c].kind) << c;
    EXPECT_EQ(blocks.components[c].area, whole.components[c].area) << c;
    EXPECT_EQ(blocks.components[c].volume, whole.components[c].volume) << c;
    EXPECT_EQ(blocks.components[c].euler, whole.components[c].euler) << c;
  }
  const SurfaceCounts a = blocks.counts(), b = whole.counts();
  EXPECT_EQ(a.convex, b.convex);
  EXPECT_EQ(a.toroidal, b.toroidal);
  EXPECT_EQ(a.concave, b.concave);
  EXPECT_EQ(a.free_edges, b.free_edges);
  EXPECT_EQ(a.spindle, b.spindle);
  EXPECT_EQ(a.fixed_probes, b.fixed_probes);
  EXPECT_EQ(a.arcs, b.arcs);
  EXPECT_EQ(accessible_area(blocks), accessible_area(whole));
  const AtomAreas of_blocks = atom_areas(blocks), of_whole = atom_areas(whole);
  EXPECT_EQ(of_blocks.surface, of_whole.surface);
  EXPECT_EQ(of_blocks.accessible, of_whole.accessible);
}

void expect_equal(const Surface& a, std::span<const std::uint32_t> planes_a, const Surface& b,
                  std::span<const std::uint32_t> planes_b) {
  ASSERT_EQ(planes_a.size(), planes_b.size());
  for (std::size_t n = 0; n < planes_a.size(); ++n) {
    EXPECT_EQ(a.planes[planes_a[n]].normal, b.planes[planes_b[n]].normal);
    EXPECT_EQ(a.planes[planes_a[n]].offset, b.planes[planes_b[n]].offset);
  }
}

std::vector<std::uint32_t> counting(std::uint32_t first, std::uint32_t count) {
  std::vector<std::uint32_t> numbers(count);
  std::iota(numbers.begin(), numbers.end(), first);
  return numbers;
}

std::vector<std::uint32_t> contacts_of(const Surface& s, const ConcavePatch& patch) {
  return {s.contacts.begin() + patch.first_contact, s.contacts.begin() + patch.first_contact + patch.contact_count};
}

// Compares what pictures use of the patches that blocks keep.
void expect_equal_patches(const Surface& blocks, const Surface& whole) {
  ASSERT_EQ(blocks.convex.size(), whole.convex.size());
  for (std::size_t n = 0; n < whole.convex.size(); ++n) {
    const ConvexPatch &a = blocks.convex[n], &b = whole.convex[n];
    EXPECT_EQ(a.atom, b.atom);
    EXPECT_EQ(a.face_count, b.face_count);
    expect_equal(blocks, counting(a.first_plane, a.plane_count), whole, counting(b.first_plane, b.plane_count));
  }
  ASSERT_EQ(blocks.concave.size(), whole.concave.size());
  for (std::size_t n = 0; n < whole.concave.size(); ++n) {
    const ConcavePatch &a = blocks.concave[n], &b = whole.concave[n];
    EXPECT_EQ(a.center, b.center);
    EXPECT_EQ(a.face_count, b.face_count);
    EXPECT_EQ(a.side_count, b.side_count);
    EXPECT_EQ(contacts_of(blocks, a), contacts_of(whole, b));
    expect_equal(blocks, counting(a.first_plane, a.plane_count()), whole, counting(b.first_plane, b.plane_count()));
  }
  ASSERT_EQ(blocks.toroidal.size(), whole.toroidal.size());
  for (std::size_t n = 0; n < whole.toroidal.size(); ++n) {
    const ToroidalPatch &a = blocks.toroidal[n], &b = whole.toroidal[n];
    EXPECT_EQ(a.atom, b.atom);
    EXPECT_EQ(a.probe, b.probe);
    EXPECT_EQ(a.center, b.center);
    EXPECT_EQ(a.axis, b.axis);
    EXPECT_EQ(a.radius, b.radius);
    EXPECT_EQ(a.start, b.start);
    EXPECT_EQ(a.sweep, b.sweep);
    EXPECT_EQ(a.has_piece, b.has_piece);
  }
}

TEST(Blocks, EachAtomIsInOneBlock) {
  const Balls balls = gas(3, 1000, 40, 1.2, 1.9);
  const Blocks blocks = divide_into_blocks(balls, 130);
  EXPECT_EQ(blocks.size(), 8u);
  std::vector<int> count(balls.size(), 0);
  for (const std::vector<std::uint32_t>& block : blocks) {
    EXPECT_LE(block.size(), 130u);
    EXPECT_TRUE(std::ranges::is_sorted(block));
    for (const std::uint32_t a : block) ++count[a];
  }
  EXPECT_EQ(std::ranges::count(count, 1), 1000);
}

TEST(Blocks, HaveTheNumbersOfTheWhole) {
  const Balls toxin = enterotoxin();
  for (const double probe : {0.0, 1.4, 2.5}) {
    const Surface whole = compute_surface_cpu(toxin, probe);
    for (const std::size_t most : {3000u, 900u, 250u}) {
      SCOPED_TRACE(::testing::Message() << "probe " << probe << ", blocks of " << most);
      expect_equal(in_blocks(toxin, probe, divide_into_blocks(toxin, most)), whole);
    }
  }
}

// A hollow ball of atoms: each of its two components has pieces in all blocks. Bored through, it is one of genus 1.
TEST(Blocks, ShareComponents) {
  Balls shell;
  for (std::size_t n = 0; n < 900; ++n) shell.push_back({14.0 * spiral_direction(n, 900), 1.7});
  const Surface hollow = compute_surface_cpu(shell, kWater);
  ASSERT_EQ(hollow.components.size(), 2u);
  ASSERT_EQ(hollow.components[1].kind, ComponentKind::cavity);
  expect_equal(in_blocks(shell, kWater, divide_into_blocks(shell, 100)), hollow);
  std::erase_if(shell, [](const Ball& b) { return std::hypot(b.center.x, b.center.y) < 6; });
  const Surface bored = compute_surface_cpu(shell, kWater);
  ASSERT_EQ(bored.components.size(), 1u);
  ASSERT_EQ(bored.components[0].euler, 0);
  expect_equal(in_blocks(shell, kWater, divide_into_blocks(shell, 100)), bored);
}

TEST(Blocks, GasesInBlocks) {
  for (std::uint32_t n = 0; n < 60; ++n) {
    const Balls balls = gas(n, 300, 14 + n % 20, 1.0, 2.0);
    const double probe = 0.5 * (n % 5);
    SCOPED_TRACE(::testing::Message() << "gas " << n);
    const Surface blocks = in_blocks(balls, probe, divide_into_blocks(balls, 40), 1, ClipPlanes::listed),
                  whole = compute_surface_cpu(balls, probe);
    expect_equal(blocks, whole);
    if (probe > 0.0) expect_equal_patches(blocks, whole);
  }
}

// On a lattice with equal radii almost everything ties. What one block decides all have to.
TEST(Blocks, DecideTiesAlike) {
  const Balls crystal = lattice(9, 9, 9, 3.0);
  const Surface whole = compute_surface_cpu(crystal, kWater);
  const Surface blocks = in_blocks(crystal, kWater, divide_into_blocks(crystal, 100));
  ASSERT_TRUE(blocks.certificate.closed);
  EXPECT_NEAR(blocks.area, whole.area, 1e-9 * whole.area);
  EXPECT_NEAR(blocks.volume, whole.volume, 1e-9 * whole.volume);
  EXPECT_EQ(blocks.components.size(), whole.components.size());
}

TEST(Blocks, GasesFullOfTies) {
  for (std::uint32_t n = 0; n < 400; ++n) {
    SCOPED_TRACE(::testing::Message() << "gas " << n);
    const GasCase gas = gas_case(n);
    const Surface whole = compute_surface_cpu(gas.balls, gas.probe_radius);
    const Surface parts =
        in_blocks(gas.balls, gas.probe_radius, divide_into_blocks(gas.balls, gas.balls.size() / 3 + 1));
    ASSERT_TRUE(parts.certificate.closed);
    EXPECT_NEAR(parts.area, whole.area, 1e-7 * (1 + whole.area));
    EXPECT_NEAR(parts.volume, whole.volume, 1e-7 * (1 + std::abs(whole.volume)));
    EXPECT_EQ(parts.components.size(), whole.components.size());
  }
}

// A probe touches four atoms but for 1e-7 Å: decisions and positions disagree about it until radii grow.
TEST(Blocks, GrowRadiiWhereTiesAreAlone) {
  Balls balls{{{-118.9157, 5.0141, 502.9119}, kCarbon},
              {{-118.7671, 6.2168, 503.8820}, kCarbon},
              {{-114.1242, 7.6050, 501.8511}, kCarbon},
              {{-118.4060, 3.6914, 503.5706}, kCarbon}};
  const std::size_t tied = balls.size();
  for (const Ball& b : ubiquitin()) balls.push_back(b);
  const Blocks blocks = divide_into_blocks(balls, 200);
  const Surface once = in_blocks(balls, kWater, blocks);
  EXPECT_FALSE(once.certificate.closed);
  for (const std::uint32_t a : once.certificate.open_atoms) EXPECT_LT(a, tied);

  const Surface parts = in_blocks(balls, kWater, blocks, kTieAttempts), whole = compute_surface_cpu(balls, kWater);
  ASSERT_TRUE(parts.certificate.closed);
  EXPECT_GT(parts.certificate.grown_by, 0.0);
  EXPECT_GE(parts.certificate.exact_within, parts.certificate.grown_by);
  EXPECT_NEAR(parts.area, whole.area, 1e-6 * whole.area);
  EXPECT_NEAR(parts.volume, whole.volume, 1e-6 * whole.volume);
  for (std::size_t a = 0; a < balls.size(); ++a) EXPECT_EQ(parts.atoms[a].radius > balls[a].radius, a < tied) << a;
}

// A block without any halo sees nothing of the others: that is closed, and wrong. So the reach is not left to callers
// of compute_without_borders().
TEST(Blocks, WithHalosTooThinAreNotClosed) {
  const Balls toxin = enterotoxin();
  StageClock unused;
  for (const double reach : {2.0, 4.0}) {
    const Surface open =
        surface_in_blocks(toxin, kWater, divide_into_blocks(toxin, 900), reach, ClipPlanes::left_out, unused, 1);
    EXPECT_FALSE(open.certificate.closed) << reach;
    EXPECT_FALSE(open.certificate.open_atoms.empty()) << reach;
  }
}

TEST(Blocks, AreMadeOfManyAtomsAlone) {
  StageClock unused;
  EXPECT_FALSE(compute_without_borders(enterotoxin(), kWater, ClipPlanes::left_out, unused).sums);
  const Balls apart = lattice(75, 75, 75, 8.0);  // 421,875 atoms that do not touch
  const Surface spheres = compute_without_borders(apart, kWater, ClipPlanes::left_out, unused);
  ASSERT_TRUE(spheres.sums);
  EXPECT_TRUE(spheres.certificate.closed);
  EXPECT_EQ(spheres.components.size(), apart.size());
  const double sphere = 4 * std::numbers::pi * kCarbon * kCarbon;
  EXPECT_NEAR(spheres.area, sphere * static_cast<double>(apart.size()), 1e-9 * spheres.area);
  EXPECT_NEAR(atom_areas(spheres).surface[200000], sphere, 1e-12 * sphere);
  EXPECT_THROW(require_borders(spheres), std::logic_error);
}

TEST(Blocks, HaveThePatchesOfTheWhole) {
  const Balls toxin = enterotoxin();
  for (const double probe : {1.4, 2.5}) {
    const Surface whole = compute_surface_cpu(toxin, probe);
    for (const std::size_t most : {3000u, 250u}) {
      SCOPED_TRACE(::testing::Message() << "probe " << probe << ", blocks of " << most);
      const Surface blocks = in_blocks(toxin, probe, divide_into_blocks(toxin, most), 1, ClipPlanes::listed);
      expect_equal(blocks, whole);
      expect_equal_patches(blocks, whole);
      EXPECT_TRUE(blocks.borders.empty() && blocks.faces.empty() && blocks.cuts.empty());
    }
  }
}

// Without a probe only spheres have area.
TEST(Blocks, HaveSpheresWithoutAProbe) {
  const Balls toxin = enterotoxin();
  const Surface whole = compute_surface_cpu(toxin, 0.0),
                blocks = in_blocks(toxin, 0.0, divide_into_blocks(toxin, 900), 1, ClipPlanes::listed);
  ASSERT_EQ(blocks.convex.size(), whole.convex.size());
  EXPECT_FALSE(blocks.planes.empty());
  EXPECT_TRUE(blocks.toroidal.empty() && blocks.concave.empty());
}

TEST(Blocks, HaloHoldsAllThatReaches) {
  const Balls row = collinear(40, 1.5);
  const std::vector<std::uint32_t> larger =
      with_halo(row, std::vector<std::uint32_t>{10, 11, 12}, halo_reach(row, kWater));
  const auto reached = static_cast<std::uint32_t>((2 * kCarbon + 4 * kWater) / 1.5);  // 9 Å
  EXPECT_EQ(larger.front(), 10 - reached);
  EXPECT_EQ(larger.back(), 12 + reached);
}

}  // namespace
}  // namespace meniscus::testing
