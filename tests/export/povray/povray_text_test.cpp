// SPDX-License-Identifier: BSD-3-Clause
// Numbers, boxes, pieces of colour and refusals of the POV-Ray exporter, without POV-Ray.
#include <cmath>
#include <clocale>
#include <limits>
#include <numbers>
#include <random>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/surface/compute_surface.h"
#include "exporters/povray/povray_scene.h"
#include "exporters/povray/scene_text.h"
#include "exporters/povray/surface_pieces.h"
#include "tests/export/povray/patch_molecules.h"
#include "tests/support/run_program.h"

namespace meniscus::povray {
namespace {

using testing::kWater;

TEST(SceneText, NumbersAreShortFixedAndWithoutLocale) {
  std::setlocale(LC_ALL, "de_DE.UTF-8");  // This locale, where it is installed, has a decimal comma.
  SceneText text;
  text.length(1.5).literal(" ").length(-0.0000001).literal(" ").length(123.4567891).literal(" ").length(40.0);
  text.literal(" ").ratio(1.0 / 3.0).literal(" ").ratio(-1e-9).literal(" ").length(100.0);
  EXPECT_EQ(text.text(), "1.5 0 123.456789 40 0.3333333 0 100");
  std::setlocale(LC_ALL, "C");
}

TEST(SceneText, RefusesNumbersThatAreNotFinite) {
  SceneText text;
  EXPECT_THROW(text.length(std::numeric_limits<double>::quiet_NaN()), Error);
  EXPECT_THROW(text.ratio(std::numeric_limits<double>::infinity()), Error);
  EXPECT_THROW(text.full(-std::numeric_limits<double>::infinity()), Error);
}

// Far from the origin a rounded normal tilts the plane; the written offset makes up for it at the anchor.
TEST(SceneText, PlanesStayPutNearTheirAnchor) {
  const glm::dvec3 normal = glm::normalize(glm::dvec3(0.3, -0.7, 0.11)), anchor(400, -300, 500);
  SceneText text;
  text.plane({normal, glm::dot(normal, anchor)}, anchor);
  double x = 0, y = 0, z = 0, offset = 0;
  ASSERT_EQ(std::sscanf(text.text().c_str(), "plane{<%lf,%lf,%lf>,%lf}", &x, &y, &z, &offset), 4);
  EXPECT_NEAR(glm::dot(glm::normalize(glm::dvec3(x, y, z)), anchor), offset, 1e-6);
}

glm::dvec3 random_unit(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
}

void expect_tight(const Box& box, const Box& sampled, double slack) {
  for (int k = 0; k < 3; ++k) {
    EXPECT_LE(box.low[k], sampled.low[k] + 1e-9);
    EXPECT_GE(box.high[k], sampled.high[k] - 1e-9);
    EXPECT_NEAR(box.low[k], sampled.low[k], slack);
    EXPECT_NEAR(box.high[k], sampled.high[k], slack);
  }
}

TEST(PatchExtent, ArcsFitTheirSamples) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> sweep(0.01, 2.0 * std::numbers::pi);
  for (int n = 0; n < 300; ++n) {
    Border b;
    b.axis = random_unit(random);
    b.start = glm::normalize(glm::cross(b.axis, random_unit(random)));
    b.center = 10.0 * random_unit(random);
    b.radius = 2.0;
    b.sweep = n == 0 ? 2.0 * std::numbers::pi : sweep(random);
    Box sampled;
    for (int s = 0; s <= 2000; ++s) {
      const double t = b.sweep * s / 2000;
      sampled.include(b.center + b.radius * (std::cos(t) * b.start + std::sin(t) * glm::cross(b.axis, b.start)));
    }
    expect_tight(arc_extent(b), sampled, 1e-4);
  }
}

// Samples a saddle patch by its definition: the probe rolls, and the arc lies between its contacts.
Box sampled_saddle(const Surface& s, const ToroidalPatch& t) {
  Box sampled;
  for (int i = 0; i <= 300; ++i) {
    const double angle = t.sweep * i / 300;
    const glm::dvec3 outward = std::cos(angle) * t.start + std::sin(angle) * glm::cross(t.axis, t.start);
    const glm::dvec3 probe = t.center + t.radius * outward;
    const glm::dvec3 from = glm::normalize(s.atoms[t.atom[0]].center - probe);
    const glm::dvec3 to = glm::normalize(s.atoms[t.atom[1]].center - probe);
    for (int j = 0; j <= 300; ++j) {
      const double turn = std::acos(glm::dot(from, to)), f = j / 300.0;
      const glm::dvec3 x =
          probe + s.probe_radius * (std::sin((1 - f) * turn) * from + std::sin(f * turn) * to) / std::sin(turn);
      if (glm::dot(x - t.center, outward) >= 0.0) sampled.include(x);
    }
  }
  return sampled;
}

TEST(PatchExtent, SaddlesFitTheirSamples) {
  for (const testing::NamedBalls& m :
       {testing::free_torus(), testing::free_spindle(), testing::cut_probes(), testing::wide_arc(),
        testing::NamedBalls{"gas", testing::gas(3, 12, 8.0, 1.2, 1.8)}}) {
    const Surface s = compute_surface_cpu(m.balls, kWater);
    for (const ToroidalPatch& t : s.toroidal)
      if (t.face_count > 0) expect_tight(toroidal_extent(s, t), sampled_saddle(s, t), 0.02);
  }
}

TEST(PatchExtent, ConcavePatchesFitTheirSamples) {
  std::mt19937 random(11);
  for (const testing::NamedBalls& m : {testing::three_atoms(), testing::cut_probes(), testing::square()}) {
    const Surface s = compute_surface_cpu(m.balls, kWater);
    for (const ConcavePatch& c : s.concave) {
      if (c.face_count == 0) continue;
      Box sampled;
      for (int n = 0; n < 400000; ++n) {
        const glm::dvec3 x = c.center + s.probe_radius * random_unit(random);
        bool inside = true;
        for (std::uint32_t p = 0; p < c.plane_count(); ++p)
          inside = inside && glm::dot(s.planes[c.first_plane + p].normal, x) <= s.planes[c.first_plane + p].offset;
        if (inside) sampled.include(x);
      }
      expect_tight(concave_extent(s, c), sampled, 0.05);
    }
  }
}

TEST(Palette, PatchesSplitOnlyBetweenColours) {
  const Surface s = compute_surface_cpu(testing::three_atoms().balls, kWater);
  const std::size_t patches = s.convex.size() + s.toroidal.size() + s.concave.size();
  const auto pieces = [&](const Coloring& coloring) {
    ColorTable table;
    return make_palette(s, coloring, table).pieces;
  };
  EXPECT_EQ(pieces(testing::turning_colors(3, 1)).size(), patches);
  EXPECT_EQ(pieces(testing::turning_colors(3, 3)).size(), 3u + 2u * 3u + 3u * 2u);
  Coloring by_kind = testing::turning_colors(3, 3);
  by_kind.kind = {{{1, 0, 0}, {0, 1, 0}, {1, 0, 0}}};
  ColorTable table;
  EXPECT_EQ(make_palette(s, by_kind, table).pieces.size(), patches);
  EXPECT_EQ(table.colors().size(), 2u);

  // One of three atoms in a ring is hidden: its convex patch goes, and no other patch goes as a whole.
  for (Coloring coloring : {testing::turning_colors(3, 1), testing::turning_colors(3, 3), by_kind}) {
    const std::size_t all = pieces(coloring).size();
    const bool one_color = coloring.atom[0] == coloring.atom[1] || coloring.kind;
    coloring.hidden = {false, true, false};
    EXPECT_EQ(pieces(coloring).size(), one_color ? all - 1 : 2u + 2u + 2u + 2u * 2u);
    coloring.hidden = {true, true, true};
    EXPECT_TRUE(pieces(coloring).empty());
  }
}

TEST(WriteScene, RefusesWhatItCannotWriteAndLeavesNothing) {
  const Surface s = compute_surface_cpu(testing::one_atom().balls, kWater);
  const Camera camera = frame_camera(s.atoms, 1.0);
  const test::TemporaryFolder scratch;
  const auto write = [&](const SceneOptions& options, const Surface& surface) {
    const SurfaceObject object{"one", surface, testing::turning_colors(1, 1), {0}};
    return write_scene({&object, 1}, camera, options, scratch.path() / "scene");
  };
  for (const std::string name : {"", "a b", "x\"", "../up", "a;b", "ä"}) {
    SceneOptions options;
    options.name = name;
    EXPECT_THROW(write(options, s), Error) << name;
  }
  SceneOptions no_pixels;
  no_pixels.width = 0;
  EXPECT_THROW(write(no_pixels, s), Error);
  Surface broken = s;
  broken.atoms[0].radius = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(write({}, broken), Error);
  EXPECT_FALSE(std::filesystem::exists(scratch.path() / "scene"));

  EXPECT_EQ(write({}, s).files.size(), 7u);
  EXPECT_THROW(write({}, s), OutputError);
  SceneOptions replace;
  replace.existing = Existing::replace;
  EXPECT_NO_THROW(write(replace, s));
}

}  // namespace
}  // namespace meniscus::povray
