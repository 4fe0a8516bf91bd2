// SPDX-License-Identifier: BSD-3-Clause
// Impossible numbers are refused: each fault that a surface could hide behind closed borders is planted and found.
#include "core/surface/certificate.h"

#include <cmath>
#include <random>
#include <string>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/base/progress.h"
#include "core/math/double_geometry.h"
#include "core/mesh/compare_mesh.h"
#include "core/mesh/tessellate.h"
#include "core/surface/blocks.h"
#include "core/surface/components.h"
#include "core/surface/compute_surface.h"
#include "core/surface/convex_planes.h"
#include "tests/support/molecules.h"

namespace meniscus::testing {
namespace {

bool holds(Surface surface, const MeasurementDoubts& doubts = {}) {
  surface.certificate = {};
  certify(surface, doubts);
  return surface.certificate.closed;
}

// Returns a lattice whose cells have room for the probe, and so cavities.
Surface lattice_with_cavities() { return compute_surface_cpu(lattice(3, 3, 3, 3.8), kWater); }

Surface lone_atom() { return compute_surface_cpu(Balls{{{0, 0, 0}, kCarbon}}, kWater); }

// Returns the surface of two probes with three contacts each, too far apart to cut each other.
Surface three_atoms() { return compute_surface_cpu(ring(3, 3.0), kWater); }

Face& first_face(Surface& surface, PatchKind kind) {
  for (Face& face : surface.faces)
    if (face.kind == kind) return face;
  ADD_FAILURE() << "no such face";
  return surface.faces.front();
}

double border_length(const Surface& surface, const Face& face) {
  double length = 0;
  for (std::uint32_t l = face.first_loop; l < face.first_loop + face.loop_count; ++l)
    for (std::uint32_t n = 0; n < surface.loops[l].half_border_count; ++n) {
      const Border& border = surface.borders[surface.half_borders[surface.loops[l].first_half_border + n] / 2];
      length += border.radius * border.sweep;
    }
  return length;
}

TEST(Certificate, HoldsForWhatItShould) {
  EXPECT_TRUE(holds(lattice_with_cavities()));
  for (const NamedBalls& molecule : degenerate_molecules())
    EXPECT_TRUE(holds(compute_surface_cpu(molecule.balls, molecule.probe_radius))) << molecule.name;
}

TEST(Certificate, FindsAFaceThatIsOffByASphere) {
  for (const PatchKind kind : {PatchKind::convex, PatchKind::concave})
    for (const double sign : {1.0, -1.0}) {
      Surface surface = lattice_with_cavities();
      const double radius = kind == PatchKind::convex ? kCarbon : kWater;
      first_face(surface, kind).area += sign * 4 * kPi * radius * radius;
      EXPECT_FALSE(holds(surface)) << int(kind) << ' ' << sign;
    }
}

// A convex face may fill a whole sphere, but a probe has all its contacts on one side.
TEST(Certificate, FindsAReEntrantFaceOfMoreThanHalfASphere) {
  Surface surface = three_atoms();
  first_face(surface, PatchKind::concave).area = 3 * kPi * kWater * kWater;
  EXPECT_FALSE(holds(surface));
}

TEST(Certificate, FindsASaddleLargerThanItsTorus) {
  for (const double tori : {0.9, 1.1}) {
    Surface surface = three_atoms();
    Face& face = first_face(surface, PatchKind::toroidal);
    face.area = tori * 4 * kPi * kPi * kWater * (surface.toroidal[face.patch].radius + kWater);
    EXPECT_EQ(holds(surface), tori < 1);
  }
}

TEST(Certificate, FindsFacesThatFillMoreThanTheirAtom) {
  for (const double share : {0.45, 0.55}) {
    Surface surface = lone_atom();
    surface.faces[0].area *= share;
    surface.faces.push_back(surface.faces[0]);
    surface.convex[0].face_count = 2;
    EXPECT_EQ(holds(surface), share < 0.5);
  }
}

TEST(Certificate, FindsAFaceWithoutANumber) {
  for (const PatchKind kind : {PatchKind::convex, PatchKind::toroidal, PatchKind::concave}) {
    Surface surface = lattice_with_cavities();
    first_face(surface, kind).area = std::nan("");
    EXPECT_FALSE(holds(surface)) << int(kind);
  }
}

TEST(Certificate, FindsAComponentOnTheWrongSide) {
  const Surface surface = lattice_with_cavities();
  ASSERT_GT(surface.components.size(), 1u);
  for (std::size_t c = 0; c < surface.components.size(); ++c) {
    Surface flipped = surface;
    Component& component = flipped.components[c];
    component.kind = component.kind == ComponentKind::outer ? ComponentKind::cavity : ComponentKind::outer;
    EXPECT_FALSE(holds(flipped)) << c;
    Surface negated = surface;
    negated.components[c].volume *= -1;
    EXPECT_FALSE(holds(negated)) << c;
  }
}

// Half a probe cannot be where a whole one must have room.
TEST(Certificate, FindsACavityWithoutRoomForTheProbe) {
  const double probe = 4 * kPi / 3 * kWater * kWater * kWater;
  for (const double volumes : {0.5, 1.0}) {
    Surface surface = lattice_with_cavities();
    Component& cavity = surface.components.back();
    ASSERT_EQ(cavity.kind, ComponentKind::cavity);
    cavity.volume = -volumes * probe;
    EXPECT_EQ(holds(surface), volumes == 1.0);
  }
}

TEST(Certificate, FindsAnOddEulerNumberAndOneAboveTwo) {
  for (const int euler : {1, 3, 4, -7}) {
    Surface surface = lattice_with_cavities();
    surface.components[0].euler = euler;
    EXPECT_FALSE(holds(surface)) << euler;
  }
}

// A lone atom shows everything; a plane that covers most of it contradicts, and so does a face of no area without one.
TEST(Certificate, FindsPlanesThatContradictTheFaces) {
  EXPECT_TRUE(holds(lone_atom()));
  for (const double share : {0.0, 1.0})
    for (const double offset : {-1.0, 1.0}) {
      Surface surface = lone_atom();
      surface.faces[0].area *= share;
      surface.convex[0].first_plane = static_cast<std::uint32_t>(surface.planes.size());
      surface.convex[0].plane_count = 1;
      surface.planes.push_back({{0, 0, 1}, offset});
      EXPECT_EQ(holds(surface), (share > 0.5) == (offset > 0)) << share << ' ' << offset;
    }
}

TEST(Certificate, FindsContactsThatGoRoundTheWrongWay) {
  Surface surface = three_atoms();
  const ConcavePatch& patch = surface.concave[0];
  for (std::uint32_t n = patch.first_plane; n < patch.first_plane + patch.side_count; ++n)
    surface.planes[n] = {-surface.planes[n].normal, -surface.planes[n].offset};
  EXPECT_FALSE(holds(surface));
}

// Where rounding may turn a plane, the area divided along the planes must be that of the borders: a little is too much.
constexpr double kLittle = 1e-5;

TEST(Certificate, ComparesPlanesAndBordersOfProbesWithFourContacts) {
  Surface surface = lattice_with_cavities();
  Face& face = first_face(surface, PatchKind::concave);
  ASSERT_GT(surface.concave[face.patch].contact_count, 3u);
  face.area += kLittle;
  EXPECT_FALSE(holds(surface));
}

TEST(Certificate, ComparesPlanesAndBordersWhereCornersAreBlurred) {
  Surface surface = three_atoms();
  Face& face = first_face(surface, PatchKind::concave);
  const auto index = static_cast<std::uint32_t>(&face - surface.faces.data());
  EXPECT_TRUE(holds(surface, {{index}, {}}));
  face.area += kLittle;
  EXPECT_FALSE(holds(surface, {{index}, {}}));
}

// Two probes on both sides of three atoms, so near to each other that rounding could swap them.
TEST(Certificate, ComparesPlanesAndBordersOfPatchesCutFromCloseBy) {
  const double apart = 8e-4, reach = kCarbon + kWater;
  Surface surface = compute_surface_cpu(ring(3, std::sqrt(3 * (reach * reach - apart * apart))), kWater);
  EXPECT_TRUE(holds(surface));
  ASSERT_EQ(surface.concave[0].contact_count, 3u);
  ASSERT_GT(surface.concave[0].cut_count, 0u);
  first_face(surface, PatchKind::concave).area += kLittle;
  EXPECT_FALSE(holds(surface));
}

// The plane cuts a patch without a cusp among its borders.
TEST(Certificate, FindsACutThatLeavesNoCusp) {
  for (const double distance : {0.5, 1.9}) {
    Surface surface = three_atoms();
    ConcavePatch& patch = surface.concave[0];
    const std::vector<Plane> sides(surface.planes.begin() + patch.first_plane,
                                   surface.planes.begin() + patch.first_plane + patch.side_count);
    const glm::dvec3 normal = glm::normalize(surface.atoms[0].center - patch.center);
    patch.first_plane = static_cast<std::uint32_t>(surface.planes.size());
    patch.cut_count = 1;
    surface.planes.insert(surface.planes.end(), sides.begin(), sides.end());
    surface.planes.push_back({normal, glm::dot(normal, patch.center) + distance});
    EXPECT_EQ(holds(surface), distance > kWater) << distance;
  }
}

TEST(Certificate, NamesDisputedFaces) {
  EXPECT_FALSE(holds(lattice_with_cavities(), {{0}, {0}}));
  EXPECT_TRUE(holds(lattice_with_cavities(), {{0}, {}}));
}

// The volume's sign is an independent answer where both are sure. Planes that are found when asked give the same sides.
TEST(SideOfComponents, AgreesWithTheSignOfTheVolume) {
  std::mt19937 random(3);
  std::size_t cavities = 0;
  const auto expect_agreement = [&](const Balls& balls, double probe_radius) {
    const Surface surface = compute_surface_cpu(balls, probe_radius);
    const std::vector<ComponentKind> sides = side_of_components(surface, ListedPlanes(surface));
    StageClock unused;
    const Surface unlisted = compute_without_borders(balls, probe_radius, ClipPlanes::left_out, unused);
    ASSERT_EQ(sides.size(), surface.components.size());
    ASSERT_EQ(sides.size(), unlisted.components.size());
    for (std::size_t c = 0; c < sides.size(); ++c) {
      EXPECT_EQ(sides[c], unlisted.components[c].kind);
      if (std::abs(surface.components[c].volume) < 1e-6) continue;
      EXPECT_EQ(sides[c] == ComponentKind::cavity, surface.components[c].volume < 0);
      cavities += sides[c] == ComponentKind::cavity;
    }
  };
  for (const NamedBalls& molecule : degenerate_molecules())
    expect_agreement(rotated(molecule.balls, random_rotation(random)), molecule.probe_radius);
  for (std::uint32_t n = 0; n < 200; ++n) {
    const GasCase gas = gas_case(n);
    expect_agreement(gas.balls, gas.probe_radius);
  }
  for (const double probe : {0.0, 0.4, 1.4}) expect_agreement(enterotoxin(), probe);
  EXPECT_GT(cavities, 50u);
}

TEST(TieLadder, GrowsOnlyWhatDoesNotClose) {
  const Balls balls = ubiquitin();
  int attempts = 0;
  const auto closing_at = [&](int attempt) {
    return [&, attempt](std::span<const Ball> grown) {
      Surface surface;
      surface.atoms.assign(grown.begin(), grown.end());
      surface.certificate.closed = attempts++ == attempt;
      return surface;
    };
  };
  const Surface first = compute_through_ties(balls, closing_at(0));
  EXPECT_EQ(attempts, 1);
  EXPECT_EQ(first.certificate.grown_by, 0.0);
  EXPECT_EQ(first.atoms[5].radius, balls[5].radius);
  attempts = 0;
  const Surface third = compute_through_ties(balls, closing_at(2));
  EXPECT_EQ(attempts, 3);
  EXPECT_EQ(third.certificate.grown_by, tie_growth(2));
  for (std::size_t a = 0; a < balls.size(); ++a) {
    EXPECT_GE(third.atoms[a].radius - balls[a].radius, 0.499 * tie_growth(2));
    EXPECT_LE(third.atoms[a].radius - balls[a].radius, 1.001 * tie_growth(2));
    EXPECT_EQ(third.atoms[a].center, balls[a].center);
  }
  EXPECT_NE(third.atoms[0].radius - balls[0].radius, third.atoms[1].radius - balls[1].radius);
  attempts = 0;
  const Surface none = compute_through_ties(balls, closing_at(-1));
  EXPECT_FALSE(none.certificate.closed);
  EXPECT_EQ(attempts, kTieAttempts + 1);  // The first attempt ran again, for it was not kept.
  EXPECT_EQ(none.atoms[5].radius, balls[5].radius);
}

// Growth begins with the least that decisions do not see, and goes by threes; each rung draws again.
TEST(TieLadder, GrowsByThreesAndDrawsAnew) {
  EXPECT_EQ(tie_growth(0), 0.0);
  EXPECT_DOUBLE_EQ(tie_growth(1), 1e-8);
  for (int attempt = 2; attempt < kTieAttempts; ++attempt)
    EXPECT_DOUBLE_EQ(tie_growth(attempt), 3 * tie_growth(attempt - 1));
  const Balls balls{{{0, 0, 0}, kCarbon}, {{1, 0, 0}, kCarbon}};
  const auto share = [&](int attempt) {
    return (grown_balls(balls, attempt)[0].radius - kCarbon) / tie_growth(attempt);
  };
  for (int attempt = 7; attempt + 1 < kTieAttempts; ++attempt)  // Before, rounding blurs the shares.
    EXPECT_GT(std::abs(share(attempt + 1) - share(attempt)), 1e-4) << attempt;
}

double exact_within(const Balls& balls, double probe_radius = kWater) {
  return compute_surface_cpu(balls, probe_radius).certificate.exact_within;
}

// How near radii the surface is exact for: 0 where no decision rests on growth, else no less than what it rests on.
TEST(ExactWithin, IsTheGrowthWhereItDecides) {
  const double kGrowth = geometry::kLargestGrowth;
  const auto pair = [](double gap) {
    return Balls{{{0, 0, 0}, kCarbon}, {{2 * (kCarbon + kWater) + gap, 0, 0}, kCarbon}};
  };
  for (const double gap : {-1e-3, -1e-8, 4e-9, 1e-8, 1.0}) EXPECT_EQ(exact_within(pair(gap)), 0.0) << gap;
  for (const double gap : {-1e-9, -1e-12, 0.0, 1e-12, 1e-9}) EXPECT_EQ(exact_within(pair(gap)), kGrowth) << gap;
  // Four spheres pass through one point, or nearly so.
  const auto square = [](double lift) {
    Balls balls = lattice(2, 2, 1, 3.0);
    balls[0].center.z += lift;
    return balls;
  };
  EXPECT_EQ(exact_within(square(0)), kGrowth);
  EXPECT_EQ(exact_within(square(0.01)), 0.0);
  EXPECT_EQ(exact_within(ubiquitin()), 0.0);
  EXPECT_EQ(exact_within(enterotoxin()), 0.0);
}

TEST(ExactWithin, CountsWhatASwallowedAtomSticksOut) {
  const auto dolls = [](double out) { return Balls{{{0, 0, 0}, 2.0}, {{0.5, 0, 0}, 1.5 + out}}; };
  EXPECT_NEAR(exact_within(dolls(5e-7)), 5e-7, 1e-12);
  EXPECT_EQ(exact_within(dolls(-1e-3)), 0.0);
}

TEST(ExactWithin, IsNoLessThanTheGrowthOfRadii) {
  for (const NamedBalls& molecule : degenerate_molecules()) {
    const Certificate certificate = compute_surface_cpu(molecule.balls, molecule.probe_radius).certificate;
    EXPECT_GE(certificate.exact_within, certificate.grown_by) << molecule.name;
  }
}

// Ties as such are distinguished by the decisions; radii grow only where positions contradict them.
TEST(TieLadder, IsNotNeededForTiesThatDecisionsTellApart) {
  for (const NamedBalls& molecule : degenerate_molecules())
    EXPECT_EQ(compute_surface_cpu(molecule.balls, molecule.probe_radius).certificate.grown_by, 0.0) << molecule.name;
  for (std::uint32_t n = 0; n < 200; ++n) {
    const GasCase gas = gas_case(n);
    EXPECT_EQ(compute_surface_cpu(gas.balls, gas.probe_radius).certificate.grown_by, 0.0) << n;
  }
}

// --verify compares these: a face off by a sphere, a component by a probe, an impossible area.
TEST(CompareMesh, FindsWhatTrianglesContradict) {
  const Surface surface = compute_surface_cpu(lattice(3, 3, 3, 3.8), kWater);
  const TriangleMesh mesh = tessellate(surface, {0.1, false});
  EXPECT_TRUE(differences(surface, mesh).empty());
  for (const PatchKind kind : {PatchKind::convex, PatchKind::concave}) {
    Surface wrong = surface;
    first_face(wrong, kind).area += 4 * kPi * kWater * kWater;
    EXPECT_EQ(differences(wrong, mesh).size(), 1u);
  }
  Surface wrong = surface;
  wrong.components.back().volume = -wrong.components.back().volume;
  EXPECT_EQ(differences(wrong, mesh).size(), 1u);
  wrong.faces[0].area = std::nan("");
  EXPECT_EQ(differences(wrong, mesh).size(), 2u);
}

// The bounds that the header states: what exceeds one by half is found, whatever the kind of face; half of it is not.
TEST(CompareMesh, FindsAsLittleAsItSays) {
  const Surface surface = three_atoms();
  const TriangleMesh mesh = tessellate(surface, {0.01, false});
  for (const auto& [part, count] : {std::pair{0.5, 0u}, {1.5, 1u}}) {
    for (const PatchKind kind : {PatchKind::convex, PatchKind::toroidal, PatchKind::concave}) {
      Surface wrong = surface;
      Face& face = first_face(wrong, kind);
      const double curvature = kind == PatchKind::convex ? kCarbon : kWater;
      const double strip = 2 * (border_length(surface, face) + 0.5 * mesh.tolerance);
      face.area += part * mesh.tolerance * (4 / curvature * face.area + strip);
      EXPECT_EQ(differences(wrong, mesh).size(), count) << int(kind);
    }
    Surface wrong = surface;
    wrong.components[0].volume += part * 2 * mesh.tolerance * wrong.components[0].area;
    EXPECT_EQ(differences(wrong, mesh).size(), count);
  }
}

}  // namespace
}  // namespace meniscus::testing
