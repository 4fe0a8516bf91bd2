// SPDX-License-Identifier: BSD-3-Clause
// Both views of a surface agree: the area within a patch's planes is the closed form of its faces.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "core/surface/compute_surface.h"
#include "core/math/union_find.h"
#include "tests/support/molecules.h"
#include "tests/support/patch_samples.h"
#include "tests/support/sanitized.h"

namespace meniscus::testing {
namespace {

// Compares for every patch the share of random points that the planes keep with the faces' Gauss-Bonnet areas.
void expect_areas_agree(const Surface& s, int samples, std::mt19937& random) {
  for (const PatchKind kind : {PatchKind::convex, PatchKind::toroidal, PatchKind::concave}) {
    double total = 0, total_variance = 0, faces = 0;
    for (std::uint32_t patch = 0; patch < patch_count(s, kind); ++patch) {
      int inside = 0;
      for (int n = 0; n < samples; ++n) inside += sample_patch(s, kind, patch, random).inside;
      const double whole = whole_area(s, kind, patch), area = face_area(s, kind, patch);
      const double share = std::clamp(area / whole, 0.0, 1.0), expected = share * samples;
      // The bound is wide enough for the Poisson tail of slivers, and has 6 standard deviations for the rest.
      EXPECT_NEAR(inside, expected, 6 * std::sqrt(expected * (1 - share)) + 4)
          << "kind " << int(kind) << ", patch " << patch << ", area " << area;
      total += whole * inside / samples;
      total_variance += whole * whole * share * (1 - share) / samples;
      faces += area;
    }
    EXPECT_NEAR(total, faces, 4 * std::sqrt(total_variance) + 1e-9) << "kind " << int(kind);
  }
}

TEST(PatchArea, Ubiquitin) {
  std::mt19937 random(1);
  expect_areas_agree(compute_surface_cpu(ubiquitin(), kWater), test::samples(2000), random);
}

TEST(PatchArea, DegenerateMolecules) {
  std::mt19937 random(2);
  for (const NamedBalls& molecule : degenerate_molecules()) {
    if (molecule.probe_radius == 0) continue;
    SCOPED_TRACE(molecule.name);
    expect_areas_agree(compute_surface_cpu(molecule.balls, molecule.probe_radius), test::samples(2000), random);
  }
}

TEST(PatchArea, Gases) {
  std::mt19937 random(3);
  for (std::uint32_t n = 0; n < 100; ++n) {
    const GasCase gas = gas_case(n);
    if (gas.probe_radius == 0) continue;
    SCOPED_TRACE("gas " + std::to_string(n));
    expect_areas_agree(compute_surface_cpu(gas.balls, gas.probe_radius), test::samples(300), random);
  }
}

// Returns areas of the connected pieces of a spherical patch on a grid of latitude and longitude, largest first.
std::vector<double> piece_areas(const Surface& s, PatchKind kind, std::uint32_t patch, int rows) {
  const int columns = 2 * rows;
  const bool convex = kind == PatchKind::convex;
  const glm::dvec3 center = convex ? s.atoms[s.convex[patch].atom].center : s.concave[patch].center;
  const double radius = convex ? s.atoms[s.convex[patch].atom].radius : s.probe_radius;
  std::vector<char> inside(static_cast<std::size_t>(rows) * columns);
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < columns; ++c) {
      const double theta = kPi * (r + 0.5) / rows, phi = 2 * kPi * (c + 0.5) / columns;
      const glm::dvec3 u(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta));
      inside[r * columns + c] = inside_planes(s, kind, patch, center + radius * u);
    }
  UnionFind joined(inside.size());
  const auto join = [&](int a, int b) {
    if (inside[a] && inside[b]) joined.unite(a, b);
  };
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < columns; ++c) {
      join(r * columns + c, r * columns + (c + 1) % columns);
      if (r + 1 < rows) join(r * columns + c, (r + 1) * columns + c);
      if (r == 0 || r + 1 == rows) join(r * columns + c, r * columns);
    }
  std::vector<double> area(inside.size(), 0.0);
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < columns; ++c)
      if (inside[r * columns + c])
        area[joined.find(r * columns + c)] +=
            radius * radius * (std::cos(kPi * r / rows) - std::cos(kPi * (r + 1) / rows)) * 2 * kPi / columns;
  std::erase(area, 0.0);
  std::sort(area.rbegin(), area.rend());
  return area;
}

struct FaceCheck {
  int checked = 0;     ///< patches of several loops whose pieces two grids agree on
  int many_faces = 0;  ///< checked patches in several pieces
  int rings = 0;       ///< faces with holes in checked patches
};

void check_pieces(const Surface& s, FaceCheck& check) {
  const auto one = [&](PatchKind kind, std::uint32_t patch, std::uint32_t first_face, std::uint32_t face_count) {
    std::uint32_t loops = 0, most = 0;
    std::vector<double> areas;
    for (std::uint32_t f = first_face; f < first_face + face_count; ++f) {
      loops += s.faces[f].loop_count;
      most = std::max(most, s.faces[f].loop_count);
      areas.push_back(s.faces[f].area);
    }
    if (loops < 2) return;
    const std::vector<double> coarse = piece_areas(s, kind, patch, 90), fine = piece_areas(s, kind, patch, 157);
    if (coarse.size() != fine.size()) return;  // A grid cannot see slivers or necks.
    // Pieces that are smaller than a grid can see are left out on both sides.
    const double radius = kind == PatchKind::convex ? s.atoms[s.convex[patch].atom].radius : s.probe_radius;
    const auto visible = [&](double area) { return area > 0.05 * radius * radius; };
    std::sort(areas.rbegin(), areas.rend());
    if (areas.empty() || !visible(areas.back()) || fine.empty() || !visible(fine.back())) return;
    ++check.checked;
    check.many_faces += areas.size() > 1;
    check.rings += most > 1;
    ASSERT_EQ(areas.size(), fine.size()) << "kind " << int(kind) << ", patch " << patch;
    for (std::size_t n = 0; n < areas.size(); ++n)
      EXPECT_NEAR(areas[n], fine[n], 0.08 * radius * radius) << "kind " << int(kind) << ", patch " << patch;
  };
  for (std::uint32_t n = 0; n < s.convex.size(); ++n)
    one(PatchKind::convex, n, s.convex[n].first_face, s.convex[n].face_count);
  for (std::uint32_t n = 0; n < s.concave.size(); ++n)
    one(PatchKind::concave, n, s.concave[n].first_face, s.concave[n].face_count);
}

TEST(Faces, PiecesOfPatchesWithSeveralLoops) {
  FaceCheck check;
  for (const NamedBalls& molecule : degenerate_molecules()) {
    SCOPED_TRACE(molecule.name);
    check_pieces(compute_surface_cpu(molecule.balls, molecule.probe_radius), check);
  }
  for (std::uint32_t n = 0; n < 40; ++n) {
    SCOPED_TRACE("gas " + std::to_string(n));
    const GasCase gas = gas_case(n);
    check_pieces(compute_surface_cpu(gas.balls, gas.probe_radius), check);
  }
  EXPECT_GT(check.checked, 100);
  EXPECT_GT(check.many_faces, 20);
  EXPECT_GT(check.rings, 20);
}

}  // namespace
}  // namespace meniscus::testing
