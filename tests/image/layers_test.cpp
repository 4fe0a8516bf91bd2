// SPDX-License-Identifier: BSD-3-Clause
// Pictures of several cut, transparent objects: counted layers, caps by the oracle of the solid, shapes.
#include <cmath>
#include <cstring>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/image/color_space.h"
#include "core/queries/surface_parts.h"
#include "core/render/cpu/cpu_renderer.h"
#include "core/scene/cut.h"
#include "core/shapes/shapes.h"
#include "core/surface/compute_surface.h"
#include "tests/support/molecules.h"

namespace meniscus {
namespace {

using testing::Balls;

constexpr float kOpacity = 0.5f;

/// A surface in one colour, whose picture is taken through the centres of pixels.
struct Subject {
  Surface surface;
  Coloring coloring;
  Camera camera;
  RenderSettings settings;
  PictureObject object;

  explicit Subject(const Balls& balls, double probe_radius = 1.4)
      : surface(compute_surface_cpu(balls, probe_radius)), camera(frame_camera(surface.atoms, 4.0 / 3.0)) {
    coloring.atom.assign(surface.atoms.size(), glm::vec3(0.8f));
    settings.size = {320, 240};
    settings.aovs = true;
    object.surface = &surface;
    object.coloring = &coloring;
  }
  Subject(const Subject&) = delete;
  Subject& operator=(const Subject&) = delete;

  void see_through() { coloring.opacity.assign(surface.atoms.size(), kOpacity); }
  void cut(const char* text) { object.clip.push_back(clip_plane(parse_cut(text), camera, surface.atoms)); }
  Framebuffer picture() const { return CpuRenderer().render({&object, 1}, camera, settings); }
};

bool same_bits(const Framebuffer& a, const Framebuffer& b) {
  return a.color.size() == b.color.size() &&
         std::memcmp(a.color.data(), b.color.data(), a.color.size() * sizeof a.color[0]) == 0;
}

/// Returns how many layers of kOpacity a pixel of one sample shows; a fraction means that layers are wrong.
double layers(const glm::vec4& pixel) { return std::log(1.0 - pixel.w) / std::log(1.0 - kOpacity); }

/// Counts pixels whose layers are not an even number, though every ray that enters a solid leaves it. Rays end beyond
/// ten layers.
int odd_pixels(const Framebuffer& picture) {
  int odd = 0;
  for (const glm::vec4& pixel : picture.color) {
    const double count = layers(pixel);
    odd += count < 9.5 && std::abs(count / 2.0 - std::round(count / 2.0)) > 1e-3;
  }
  return odd;
}

TEST(Layers, ABallHasTwo) {
  Subject ball({{{0.0, 0.0, 0.0}, 1.7}});
  ball.see_through();
  const Framebuffer picture = ball.picture();
  EXPECT_FLOAT_EQ(picture.color[120 * 320 + 160].w, 1.0f - (1.0f - kOpacity) * (1.0f - kOpacity));
  EXPECT_EQ(odd_pixels(picture), 0);
}

TEST(Layers, ComeInPairsOnClosedSurfaces) {
  for (const testing::NamedBalls& molecule :
       {testing::NamedBalls{"1UBQ", testing::ubiquitin()}, testing::NamedBalls{"1TII", testing::enterotoxin()},
        testing::NamedBalls{"no probe", testing::ubiquitin(), 0.0}, testing::NamedBalls{"C60", testing::c60(), 0.5}}) {
    Subject subject(molecule.balls, molecule.probe_radius);
    subject.see_through();
    EXPECT_LE(odd_pixels(subject.picture()), 2)
        << molecule.name;  // A ray that touches a border counts once, or thrice.
  }
}

TEST(Layers, ComeInPairsOnSlabsToo) {
  Subject subject(testing::enterotoxin());
  subject.see_through();
  subject.cut("depth>0.35");
  subject.cut("depth<0.6");
  subject.cut("1,0.2,0.1<35");
  const Framebuffer picture = subject.picture();
  EXPECT_LE(odd_pixels(picture), 2);
  EXPECT_GT(std::ranges::count(picture.kind, Framebuffer::kCap), 1000);
}

TEST(Layers, ComeInPairsWhereAPlaneIsSeenFromTheSide) {
  Subject subject(testing::enterotoxin());
  subject.see_through();
  const glm::dvec3 left = -view_basis(subject.camera).right;  // Rays on the left go out through the plane.
  subject.object.clip.push_back({left, glm::dot(left, subject.camera.position) + 5.0});
  const Framebuffer picture = subject.picture();
  EXPECT_LE(odd_pixels(picture), 2);
  EXPECT_GT(std::ranges::count_if(picture.color, [](const glm::vec4& pixel) { return pixel.w > 0.0f; }), 10000);
}

TEST(Layers, CapsAreWhereThePlaneIsInTheSolid) {
  Subject subject(testing::enterotoxin());
  subject.cut("depth>0.5");
  const Framebuffer picture = subject.picture();
  const ClipPlane plane = subject.object.clip[0];
  int caps = 0, wrong = 0;
  for (int y = 0; y < 240; y += 3)
    for (int x = 0; x < 320; x += 3) {
      const Ray ray = pixel_ray(subject.camera, subject.settings.size, glm::dvec2(x, y) + 0.5);
      const double t = (plane.offset - glm::dot(plane.normal, ray.origin)) / glm::dot(plane.normal, ray.direction);
      const bool solid = !in_solvent(subject.surface.atoms, 1.4, ray.origin + t * ray.direction);
      const std::size_t at = static_cast<std::size_t>(y) * 320 + x;
      caps += solid;
      wrong += solid != (picture.kind[at] == Framebuffer::kCap);
      if (!solid) continue;
      EXPECT_NEAR(picture.z[at], t, 1e-3);
      const auto off_sphere = [&](const Ball& ball) {
        return glm::length(ray.origin + t * ray.direction - ball.center) - ball.radius;
      };
      const std::vector<Ball>& balls = subject.surface.atoms;
      const double least = off_sphere(*std::ranges::min_element(balls, {}, off_sphere));
      EXPECT_NEAR(off_sphere(balls[picture.atom[at]]), least, 1e-4) << x << ' ' << y;
    }
  EXPECT_GT(caps, 1000);
  EXPECT_EQ(wrong, 0);
}

TEST(Layers, ACapOfABallIsADisk) {
  Subject ball({{{0.0, 0.0, 0.0}, 2.0}});
  ball.camera = {{0, 0, 20}, {0, 0, 0}, {0, 1, 0}, Projection::orthographic, 30.0, 6.0};
  ball.cut("z<1");
  const Framebuffer picture = ball.picture();
  const double pixel = 6.0 / 240.0;
  EXPECT_NEAR(static_cast<double>(std::ranges::count(picture.kind, Framebuffer::kCap)) * pixel * pixel,
              std::numbers::pi * 3.0, 0.02);
  EXPECT_FLOAT_EQ(picture.position[120 * 320 + 160].z, 1.0f);
  EXPECT_FLOAT_EQ(picture.normal[120 * 320 + 160].z, 1.0f);
}

// Only the farthest ball of a row along the view is left: it is then the nearest, and as bright as it is alone.
TEST(Layers, AirBeginsWhereACutPictureDoes) {
  const Camera camera{.position = {0, 0, 60}, .projection = Projection::orthographic, .height = 10.0};
  const auto middle = [&](Subject& subject) {
    subject.camera = camera;
    subject.settings.look.depth_cue = 0.8f;
    subject.settings.look.depth_cue_keeps_alpha = true;
    return subject.picture().color[120 * 320 + 160].x;
  };
  Subject alone({{{0.0, 0.0, 0.0}, 1.7}}), row({{{0.0, 0.0, 0.0}, 1.7}, {{0.0, 0.0, 20.0}, 1.7}});
  row.camera = camera;
  row.cut("z<10");
  EXPECT_NEAR(middle(row), middle(alone), 1e-3f);
  row.object.clip.clear();
  row.coloring.hidden = {false, true};
  EXPECT_GT(std::abs(middle(row) - middle(alone)), 0.05f);
}

TEST(Layers, HiddenAtomsAreSolidButNotSeenWhereAPlaneCuts) {
  Subject subject(testing::ubiquitin());
  subject.cut("depth>0.5");
  const auto whole = std::ranges::count(subject.picture().kind, Framebuffer::kCap);
  for (std::size_t n = 0; n < subject.surface.atoms.size(); ++n) subject.coloring.hidden.push_back(n % 2 == 0);
  const Framebuffer picture = subject.picture();
  const auto shown = std::ranges::count(picture.kind, Framebuffer::kCap);
  EXPECT_NEAR(static_cast<double>(shown) / static_cast<double>(whole), 0.5, 0.1);
  for (const std::uint32_t atom : picture.atom) EXPECT_TRUE(atom == kNone || atom % 2 == 1);
}

TEST(Layers, AFilmIsDenserWhereTheViewGrazesIt) {
  Subject ball({{{0.0, 0.0, 0.0}, 2.0}});
  ball.camera = {{0, 0, 20}, {0, 0, 0}, {0, 1, 0}, Projection::orthographic, 30.0, 6.0};
  ball.see_through();
  ball.object.thickens = true;
  const Framebuffer picture = ball.picture();
  for (const int x : {160, 200, 220}) {
    const double across = (x + 0.5 - 160.0) * 6.0 / 240.0, down = 0.5 * 6.0 / 240.0;
    const double cosine = std::sqrt(1.0 - (across * across + down * down) / 4.0);
    EXPECT_NEAR(1.0 - picture.color[120 * 320 + x].w, std::pow(1.0 - kOpacity, 2.0 / cosine), 2e-5);
  }
}

TEST(Layers, OfOneOpaqueObjectMakeThePictureOfItAlone) {
  Subject subject(testing::ubiquitin());
  for (std::size_t n = 0; n < subject.surface.atoms.size(); ++n)
    subject.coloring.part.push_back(static_cast<std::uint32_t>(n / 200));
  const Shapes nothing;
  std::vector<PictureObject> both{subject.object, {}};
  both[1].shapes = &nothing;
  both[1].coloring = &subject.coloring;
  for (const bool effects : {false, true}) {
    subject.settings.samples = 3;
    if (effects) {
      subject.settings.look.ambient_occlusion = 0.9f;
      subject.settings.look.silhouettes = 2.0f;
    }
    EXPECT_TRUE(same_bits(CpuRenderer().render(both, subject.camera, subject.settings), subject.picture()));
  }
}

/// Returns the sum of light over white paper.
double light(const Framebuffer& picture) {
  double sum = 0.0;
  for (const glm::vec4& pixel : picture.color) sum += pixel.x + (1.0 - pixel.w);
  return sum;
}

TEST(Layers, WhatIsSeenThroughHasShadeAndLinesAsFarAsItCovers) {
  Subject subject(testing::ubiquitin());
  subject.settings.look.material.specular = 0.0f;  // Highlights of the shade are not tested.
  const auto picture = [&](float opacity, bool effects) {
    subject.coloring.opacity.assign(opacity < 1.0f ? subject.surface.atoms.size() : 0, opacity);
    subject.settings.look.ambient_occlusion = effects ? 0.9f : 0.0f;
    subject.settings.look.silhouettes = effects ? 2.0f : 0.0f;
    subject.settings.look.depth_cue = effects ? 0.3f : 0.0f;
    return subject.picture();
  };
  // A surface that is nearly opaque looks like the opaque picture; one that is nearly invisible has no lines.
  const Framebuffer opaque = picture(1.0f, true), nearly = picture(0.9999f, true);
  float farthest = 0.0f;
  for (std::size_t n = 0; n < opaque.color.size(); ++n)
    for (int c = 0; c < 4; ++c) farthest = std::max(farthest, std::abs(opaque.color[n][c] - nearly.color[n][c]));
  EXPECT_LT(farthest, 0.002f);
  for (const glm::vec4& pixel : picture(0.001f, true).color) ASSERT_LT(pixel.w, 0.02f);
  // In between, both effects make the surface darker, and less so the less it covers.
  const auto darker = [&](float opacity) { return light(picture(opacity, false)) - light(picture(opacity, true)); };
  const double half = darker(0.5f), quarter = darker(0.25f);
  EXPECT_GT(quarter, 40.0);  // An opacity of a quarter blocks a sixteenth of the light.
  EXPECT_GT(half, 1.5 * quarter);
  // Lines next to a transparent surface reach as far as those of an opaque one.
  const Framebuffer halved = picture(0.5f, true);
  for (std::size_t n = 0; n < opaque.color.size(); ++n)
    ASSERT_EQ(opaque.color[n].w > 0.0f, halved.color[n].w > 0.0f) << n;
}

TEST(Layers, LinesOfWhatIsSeenThroughDoNotAddUpFromSampleToSample) {
  Subject subject({{{0.0, 0.0, 0.0}, 1.7}});
  subject.camera = {{0, 0, 20}, {0, 0, 0}, {0, 1, 0}, Projection::orthographic, 30.0, 6.0};
  subject.settings.samples = 4;
  subject.settings.look.silhouettes = 14.0f;  // Lines reach far into empty tiles.
  const Framebuffer opaque = subject.picture();
  subject.coloring.opacity.assign(1, 0.9999f);
  const Framebuffer nearly = subject.picture();
  for (std::size_t n = 0; n < opaque.color.size(); ++n) ASSERT_NEAR(opaque.color[n].w, nearly.color[n].w, 0.002f) << n;
}

TEST(Layers, AreTheSameForAllVectorsAndBlocks) {
  Subject subject(testing::ubiquitin());
  subject.see_through();
  subject.cut("depth>0.3");
  subject.settings.samples = 5;
  subject.settings.look.ambient_occlusion = 0.5f;
  subject.settings.look.silhouettes = 3.0f;
  const Framebuffer widest = subject.picture();
  for (const int lanes : {4, 8})
    EXPECT_TRUE(same_bits(CpuRenderer(lanes).render({&subject.object, 1}, subject.camera, subject.settings), widest));
  subject.settings.block_edge = 96;
  EXPECT_TRUE(same_bits(subject.picture(), widest));
}

/// One atom at the origin and another at (4, 0, 0) as shapes.
struct ShapeSubject {
  Shapes shapes;
  Coloring coloring;
  Camera camera{{0, 0, 20}, {0, 0, 0}, {0, 1, 0}, Projection::orthographic, 30.0, 6.0};
  RenderSettings settings;

  ShapeSubject() {
    coloring.atom = {{0.8f, 0.2f, 0.2f}, {0.2f, 0.2f, 0.8f}};
    settings.size = {320, 240};
    settings.aovs = true;
  }
  Framebuffer picture() const {
    PictureObject object;
    object.shapes = &shapes;
    object.coloring = &coloring;
    return CpuRenderer().render({&object, 1}, camera, settings);
  }
};

TEST(Layers, PreviewsHaveTheHighlightsOfFiles) {
  Subject subject(testing::ubiquitin());
  subject.cut("depth>0.5");
  subject.object.material.specular = 0.9f;
  subject.settings.look.ambient_occlusion = 0.8f;
  const Framebuffer picture = subject.picture();
  CpuRenderer renderer;
  ASSERT_TRUE(renderer.draw({&subject.object, 1}, subject.camera, subject.settings));
  std::vector<std::uint8_t> expected(4 * picture.color.size());
  display_bytes(picture.color, subject.settings.look.background, 4, expected.data());
  EXPECT_TRUE(renderer.rgba() == expected);
}

TEST(Layers, ASphereIsTheBallThatItIs) {
  Subject ball({{{0.0, 0.0, 0.0}, 2.0}});
  ShapeSubject shape;
  shape.shapes.spheres.push_back({{0.0, 0.0, 0.0}, 2.0, 0});
  shape.coloring.atom[0] = ball.coloring.atom[0];
  ball.camera = shape.camera;
  EXPECT_TRUE(same_bits(shape.picture(), ball.picture()));
}

TEST(Layers, CutShapesAreSolid) {
  const auto is_capped = [](const std::vector<SphereShape>& spheres) {
    ShapeSubject subject;
    subject.shapes.spheres = spheres;
    PictureObject object;
    object.shapes = &subject.shapes;
    object.coloring = &subject.coloring;
    object.clip.push_back({{0.0, 0.0, 1.0}, 0.0});  // The viewer's half is gone.
    const Framebuffer picture = CpuRenderer().render({&object, 1}, subject.camera, subject.settings);
    const std::size_t middle = 120 * 320 + 160;
    return std::abs(picture.position[middle].z) < 1e-3f && picture.kind[middle] == Framebuffer::kCap &&
           picture.color[middle].x > 0.1f;
  };
  EXPECT_TRUE(is_capped({{{0.0, 0.0, 0.0}, 1.5, 0}}));
  // Beyond the plane the ray enters one sphere within the other, or leaves one sphere and enters another.
  EXPECT_TRUE(is_capped({{{0.0, 0.0, 0.0}, 1.5, 0}, {{0.0, 0.0, -0.8}, 0.5, 0}}));
  EXPECT_TRUE(is_capped({{{0.0, 0.0, 0.0}, 1.5, 0}, {{0.0, 0.0, -4.0}, 1.0, 0}}));
  EXPECT_FALSE(is_capped({{{0.0, 0.0, -2.0}, 1.5, 0}}));
}

TEST(Layers, ACylinderIsRoundAndOfTwoColors) {
  ShapeSubject shape;
  shape.shapes.cylinders.push_back({{-2.0, 0.0, 0.0}, {2.0, 0.0, 0.0}, 0.5, 0, 1});
  const Framebuffer picture = shape.picture();
  for (int y = 0; y < 240; ++y)
    for (int x = 0; x < 320; ++x) {
      const double across = (x + 0.5 - 160.0) * 6.0 / 240.0, up = (119.5 - y) * 6.0 / 240.0;
      const std::size_t at = static_cast<std::size_t>(y) * 320 + x;
      const bool on = std::abs(across) < 2.0 && std::abs(up) < 0.5;
      ASSERT_EQ(picture.kind[at], on ? Framebuffer::kShape : kNone) << x << ' ' << y;
      if (!on) continue;
      EXPECT_NEAR(picture.z[at], 20.0 - std::sqrt(0.25 - up * up), 2e-5);
      EXPECT_EQ(picture.atom[at], across < 0.0 ? 0u : 1u);
      EXPECT_NEAR(picture.normal[at].y, up / 0.5, 1e-5);
    }
}

TEST(Layers, ATriangleHasTheNormalsOfItsCorners) {
  ShapeSubject shape;
  shape.shapes.mesh.positions = {{-2.0, -2.0, 1.0}, {2.0, -2.0, 1.0}, {-2.0, 2.0, 3.0}};
  const glm::vec3 tilted = glm::normalize(glm::vec3(1.0f, 0.0f, 1.0f));
  shape.shapes.mesh.normals = {{0.0f, 0.0f, 1.0f}, tilted, {0.0f, 0.0f, 1.0f}};
  shape.shapes.mesh.atoms = {0, 1, 0};
  shape.shapes.mesh.triangles = {{0, 1, 2}};
  const Framebuffer picture = shape.picture();
  for (int y = 0; y < 240; ++y)
    for (int x = 0; x < 320; ++x) {
      const double across = (x + 0.5 - 160.0) * 6.0 / 240.0, up = (119.5 - y) * 6.0 / 240.0;
      const double u = (across + 2.0) / 4.0, v = (up + 2.0) / 4.0;
      const std::size_t at = static_cast<std::size_t>(y) * 320 + x;
      if (std::abs(1.0 - u - v) < 1e-3) continue;
      ASSERT_EQ(picture.kind[at] != kNone, u > 0.0 && v > 0.0 && u + v < 1.0) << x << ' ' << y;
      if (picture.kind[at] == kNone) continue;
      EXPECT_NEAR(picture.z[at], 20.0 - (1.0 + 2.0 * v), 1e-5);
      const glm::dvec3 normal = glm::normalize((1.0 - u) * glm::dvec3(0.0, 0.0, 1.0) + u * glm::dvec3(tilted));
      EXPECT_NEAR(picture.normal[at].x, normal.x, 1e-5);
      const double others = std::max(v, 1.0 - u - v);
      if (std::abs(u - others) > 1e-5) {
        EXPECT_EQ(picture.atom[at], u > others ? 1u : 0u);
      }
    }
}

TEST(Cut, SaysWhatIsWrong) {
  const auto message = [](const char* text) -> std::string {
    try {
      parse_cut(text);
    } catch (const RequestError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(message("x=3"),
            "'x=3' is not a plane: there is no < or >; write one such as x<20, 1,1,0>35, depth>0.5 or "
            "before ligand");
  EXPECT_NE(message("w<3").find("a direction of three numbers"), std::string::npos);
  EXPECT_NE(message("0,0,0<3").find("a direction of three numbers"), std::string::npos);
  EXPECT_NE(message("1,2<3").find("a direction of three numbers"), std::string::npos);
  EXPECT_NE(message("x<").find("one number"), std::string::npos);
  EXPECT_NE(message("x<nan").find("one number"), std::string::npos);
  EXPECT_NE(message("x<1e999").find("one number"), std::string::npos);
  EXPECT_NE(message("x<1<2").find("one number"), std::string::npos);
  EXPECT_EQ(message(" x < +3.5 "), "");
}

TEST(Cut, KeepsTheSideThatItNames) {
  const Balls balls = testing::two_atoms(6.0);
  const Camera camera = frame_camera(balls, 1.0);
  const auto keeps = [&](const char* text, const glm::dvec3& point) {
    const ClipPlane plane = clip_plane(parse_cut(text), camera, balls);
    EXPECT_NEAR(glm::length(plane.normal), 1.0, 1e-12);
    return glm::dot(plane.normal, point) < plane.offset;
  };
  EXPECT_TRUE(keeps("x<3", {2.9, 0, 0}));
  EXPECT_FALSE(keeps("x<3", {3.1, 0, 0}));
  EXPECT_TRUE(keeps("0,2,0>4", {0, 2.1, 0}));
  EXPECT_FALSE(keeps("0,2,0>4", {0, 1.9, 0}));
  const glm::dvec3 forward = view_basis(camera).forward, middle(3.0, 0.0, 0.0);
  EXPECT_TRUE(keeps("depth>0.5", middle + 0.1 * forward));
  EXPECT_FALSE(keeps("depth>0.5", middle - 0.1 * forward));
}

}  // namespace
}  // namespace meniscus
