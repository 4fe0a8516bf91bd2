// SPDX-License-Identifier: BSD-3-Clause
// Shadows and shade by rays agree with closed forms and an oracle that knows only the balls; pictures are the same for
// any blocks and vectors.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/queries/copies.h"
#include "core/render/cpu/occluders.h"
#include "core/scene/cut.h"
#include "core/shapes/shapes.h"
#include "tests/image/lit_subject.h"
#include "tests/support/sphere_tracer.h"

namespace meniscus {
namespace {

using testing::Balls;

/// Returns whether a pixel of grey, with ambient 1 and one sample, is in full light.
bool lit(const Framebuffer& picture, std::size_t at) {
  float brightest = 0.0f;
  for (const glm::vec4& pixel : picture.color) brightest = std::max(brightest, pixel.x);
  return picture.color[at].x > 0.95f * brightest;
}

/// Pixels whose light differs for the oracle, among those that it can decide: rays that pass the solid closely, or
/// leave along the surface, are left out.
struct Comparison {
  int asked = 0, dark = 0, wrong = 0;
};

Comparison compare(const Subject& subject, const testing::SphereTracer& oracle) {
  const Framebuffer picture = subject.picture();
  const glm::dvec3 lamp = subject.lamp();
  Comparison result;
  for (std::size_t at = 0; at < picture.color.size(); at += 3) {
    if (!std::isfinite(picture.z[at])) continue;
    const glm::dvec3 normal(picture.normal[at]);
    if (std::abs(glm::dot(normal, lamp)) < 0.02) continue;
    bool dark = glm::dot(normal, lamp) < 0.0;
    if (!dark) dark = oracle.trace(glm::dvec3(picture.position[at]) + 2e-3 * normal, lamp, 200.0, 1e-6).has_value();
    ++result.asked;
    result.dark += dark;
    result.wrong += lit(picture, at) == dark;
  }
  return result;
}

TEST(Shadows, AreThoseOfTheOracleThatKnowsOnlyTheBalls) {
  for (const testing::NamedBalls& molecule :
       {testing::NamedBalls{"1UBQ", testing::ubiquitin()}, testing::NamedBalls{"C60", testing::c60(), 0.5}}) {
    Subject subject(molecule.balls, molecule.probe_radius);
    const testing::SphereTracer oracle(molecule.balls, molecule.probe_radius);
    const Comparison seen = compare(subject, oracle);
    EXPECT_GT(seen.asked, 1500) << molecule.name;
    EXPECT_GT(seen.dark, seen.asked / 10) << molecule.name;
    EXPECT_LE(seen.wrong, seen.asked / 500) << molecule.name;
  }
}

/// Two balls with separate surfaces, and the lamp next to the camera: the front one covers a disc.
TEST(Shadows, OfABallAreADisc) {
  Subject subject({{{0.0, 0.0, 0.0}, 4.0}, {{0.0, 0.0, 20.0}, 1.5}});
  subject.camera = {.position = {0.0, 0.0, 60.0}, .target = {0.0, 0.0, 0.0}, .up = {0.0, 1.0, 0.0}};
  subject.camera.projection = Projection::orthographic;
  subject.camera.height = 12.0;
  subject.settings.look.light_direction = {0.15f, 0.0f, 1.0f};
  const Framebuffer picture = subject.picture();
  const glm::dvec3 lamp = subject.lamp(), ball(0.0, 0.0, 20.0);
  int dark = 0, wrong = 0;
  for (std::size_t at = 0; at < picture.color.size(); ++at) {
    if (picture.atom[at] != 0) continue;
    const glm::dvec3 point(picture.position[at]), across = ball - point - lamp * glm::dot(ball - point, lamp);
    if (glm::dot(glm::dvec3(picture.normal[at]), lamp) < 0.05) continue;
    const bool covered = glm::length(across) < 1.5;
    dark += covered;
    wrong += lit(picture, at) == covered && std::abs(glm::length(across) - 1.5) > 1e-3;
  }
  EXPECT_GT(dark, 100);
  EXPECT_EQ(wrong, 0);
}

TEST(Shadows, OfADarknessAreThatShareOfTheDarkest) {
  Subject subject(testing::c60(), 0.5);
  const Framebuffer dark = subject.picture();
  subject.settings.look.shadows = 0.25f;
  const Framebuffer lighter = subject.picture();
  subject.settings.look.shadows = 0.0f;
  const Framebuffer none = subject.picture();
  for (std::size_t at = 0; at < none.color.size(); ++at)
    EXPECT_NEAR(lighter.color[at].x, 0.75f * none.color[at].x + 0.25f * dark.color[at].x, 1e-5f);
}

/// Removed parts cast no shadow, and a cap casts the shadow of the solid behind it.
TEST(Shadows, OfACutAreThoseOfWhatIsLeft) {
  const Balls balls = testing::ubiquitin();
  Subject subject(balls);
  PictureObject& object = subject.objects.front();
  object.clip.push_back(clip_plane(parse_cut("depth>0.45"), subject.camera, subject.surface.atoms));
  const testing::SphereTracer oracle(balls, 1.4);
  const Framebuffer picture = subject.picture();
  const glm::dvec3 lamp = subject.lamp();
  const ClipPlane plane = object.clip.front();
  int caps = 0, wrong = 0, asked = 0;
  for (std::size_t at = 0; at < picture.color.size(); ++at) {
    if (!std::isfinite(picture.z[at])) continue;
    const glm::dvec3 point(picture.position[at]), normal(picture.normal[at]);
    if (std::abs(glm::dot(normal, lamp)) < 0.02) continue;
    // The lamp's ray leaves the kept part here.
    const double leaves = (plane.offset - glm::dot(plane.normal, point)) / glm::dot(plane.normal, lamp);
    const bool is_cap = picture.kind[at] == Framebuffer::kCap;
    bool dark = glm::dot(normal, lamp) < 0.0;
    if (!dark && !is_cap) dark = oracle.trace(point + 2e-3 * normal, lamp, leaves, 1e-6).has_value();
    caps += is_cap;
    ++asked;
    wrong += lit(picture, at) == dark;
  }
  EXPECT_GT(caps, 500);
  EXPECT_LE(wrong, asked / 300);
}

/// Light that would enter a slab by one cap and leave it by the other is blocked, though no surface lies in between.
TEST(Shadows, OfASlabAreThoseOfItsCaps) {
  Subject floor({{{-18.0, 0.0, -18.0}, 4.0}});
  const Surface ball = compute_surface_cpu(Balls{{{0.0, 0.0, 0.0}, 2.5}}, 1.4);
  Coloring coloring;
  coloring.atom.assign(1, kGrey);
  PictureObject& slab = floor.objects.emplace_back();
  slab.surface = &ball;
  slab.coloring = &coloring;
  slab.clip = {{{1.0, 0.0, 0.0}, 0.6}, {{-1.0, 0.0, 0.0}, 0.6}};
  floor.camera = {.position = {-18.0, 0.0, 60.0}, .target = {-18.0, 0.0, 0.0}, .up = {0.0, 1.0, 0.0}};
  floor.camera.projection = Projection::orthographic;
  floor.camera.height = 9.0;
  floor.settings.look.light_direction = {1.0f, 0.0f, 1.0f};
  const Framebuffer picture = floor.picture();
  const glm::dvec3 lamp = floor.lamp();
  int dark = 0, wrong = 0;
  for (std::size_t at = 0; at < picture.color.size(); ++at) {
    if (!std::isfinite(picture.z[at]) || glm::dot(glm::dvec3(picture.normal[at]), lamp) < 0.05) continue;
    const glm::dvec3 point(picture.position[at]);
    const double in = (-0.6 - point.x) / lamp.x, out = (0.6 - point.x) / lamp.x;
    const double nearest = glm::length(point + std::clamp(-glm::dot(point, lamp), in, out) * lamp);
    dark += nearest < 2.5;
    wrong += lit(picture, at) == (nearest < 2.5) && std::abs(nearest - 2.5) > 1e-3;
  }
  EXPECT_GT(dark, 300);
  EXPECT_EQ(wrong, 0);
}

/// A stick is next to a ball: points that see the lamp within the stick's radius of its axis are dark.
TEST(Shadows, OfAStickAreAStrip) {
  Subject subject({{{0.0, 0.0, 0.0}, 4.0}});
  subject.camera = {.position = {0.0, 0.0, 60.0}, .target = {0.0, 0.0, 0.0}, .up = {0.0, 1.0, 0.0}};
  subject.camera.projection = Projection::orthographic;
  subject.camera.height = 12.0;
  subject.settings.look.light_direction = {0.15f, 0.0f, 1.0f};
  Shapes shapes;
  shapes.cylinders.push_back({{0.0, -9.0, 20.0}, {0.0, 9.0, 20.0}, 0.8, 0, 0});
  PictureObject& stick = subject.objects.emplace_back();
  stick.shapes = &shapes;
  stick.coloring = &subject.coloring;
  const Framebuffer picture = subject.picture();
  const glm::dvec3 lamp = subject.lamp(), across = glm::normalize(glm::cross(lamp, glm::dvec3(0.0, 1.0, 0.0)));
  int dark = 0, wrong = 0;
  for (std::size_t at = 0; at < picture.color.size(); ++at) {
    if (!std::isfinite(picture.z[at]) || picture.object[at] != 0) continue;
    if (glm::dot(glm::dvec3(picture.normal[at]), lamp) < 0.05) continue;
    const double aside = std::abs(glm::dot(glm::dvec3(0.0, 0.0, 20.0) - glm::dvec3(picture.position[at]), across));
    dark += aside < 0.8;
    wrong += lit(picture, at) == (aside < 0.8) && std::abs(aside - 0.8) > 1e-3;
  }
  EXPECT_GT(dark, 300);
  EXPECT_EQ(wrong, 0);
}

/// Copies are in memory once; rays turn to them. A few pixels at the edges of shadows may differ by rounding.
TEST(Shadows, OfCopiesAreThoseOfOneSurface) {
  SurfaceObject object;
  object.surface = compute_surface_cpu(testing::c60(), 0.5);
  object.coloring.atom.assign(object.surface.atoms.size(), kGrey);
  object.atom.resize(object.surface.atoms.size());
  const double turn = 0.7;
  const glm::dmat3 about_z{
      {std::cos(turn), std::sin(turn), 0.0}, {-std::sin(turn), std::cos(turn), 0.0}, {0.0, 0.0, 1.0}};
  object.copies = {{}, {about_z, {9.0, 7.0, 12.0}}, {about_z * about_z, {-4.0, 9.0, 21.0}}};
  const SurfaceObject whole = merged({object});
  const Camera camera = frame_camera(whole.surface.atoms, 4.0 / 3.0);
  RenderSettings settings;
  settings.size = {160, 120};
  settings.look.shadows = 1.0f;
  const Framebuffer one = CpuRenderer().render(whole_surface(whole.surface, whole.coloring), camera, settings);
  const Framebuffer copies = CpuRenderer().render_copies({&object, 1}, camera, settings);
  settings.look.shadows = 0.0f;
  const Framebuffer without = CpuRenderer().render(whole_surface(whole.surface, whole.coloring), camera, settings);
  int different = 0, shadowed = 0;
  for (std::size_t at = 0; at < one.color.size(); ++at) {
    different += glm::length(one.color[at] - copies.color[at]) > 1e-3f;
    shadowed += glm::length(one.color[at] - without.color[at]) > 0.1f;
  }
  EXPECT_GT(shadowed, 100);
  EXPECT_LE(different, 5);
}

/// A transparent ball lets the light pass.
TEST(Shadows, AreNotCastByWhatIsSeenThrough) {
  Subject subject({{{0.0, 0.0, 0.0}, 4.0}, {{0.0, 0.0, 20.0}, 1.5}});
  subject.camera = {.position = {0.0, 0.0, 60.0}, .target = {0.0, 0.0, 0.0}, .up = {0.0, 1.0, 0.0}};
  subject.camera.projection = Projection::orthographic;
  subject.camera.height = 12.0;
  subject.settings.look.light_direction = {0.15f, 0.0f, 1.0f};
  subject.coloring.opacity = {1.0f, 0.5f};
  const Framebuffer with = subject.picture();
  subject.settings.look.shadows = 0.0f;
  const Framebuffer without = subject.picture();
  const glm::dvec3 lamp = subject.lamp();
  for (std::size_t at = 0; at < with.color.size(); ++at) {
    if (with.atom[at] != 0 || glm::dot(glm::dvec3(with.normal[at]), lamp) < 0.02) continue;
    EXPECT_FLOAT_EQ(with.color[at].x, without.color[at].x);
  }
}

TEST(TracedLight, IsTheSameForAnyBlocksAndVectors) {
  Subject subject(testing::ubiquitin());
  subject.settings.samples = 3;
  subject.settings.look.shadow_softness = 6.0f;
  subject.settings.look.ambient_occlusion = 0.9f;
  subject.settings.look.ambient_occlusion_rays = 12.0f;
  subject.settings.aovs = false;
  const Framebuffer usual = subject.picture();
  subject.settings.block_edge = 64;
  EXPECT_TRUE(same_bits(usual, subject.picture()));
  for (const int lanes : {4, 8})
    EXPECT_TRUE(same_bits(usual, CpuRenderer(lanes).render(subject.objects, subject.camera, subject.settings)))
        << lanes;
}

/// Points spread over a surface by the pixels of a picture, up to a number.
struct Sampled {
  std::vector<glm::dvec3> positions, normals;
};

Sampled sampled(const Subject& subject, std::size_t count) {
  const Framebuffer picture = subject.picture();
  Sampled points;
  std::vector<std::size_t> hits;
  for (std::size_t at = 0; at < picture.z.size(); ++at)
    if (std::isfinite(picture.z[at])) hits.push_back(at);
  for (std::size_t n = 0; n < count; ++n) {
    const std::size_t at = hits[n * hits.size() / count];
    points.positions.emplace_back(picture.position[at]);
    points.normals.emplace_back(glm::normalize(glm::dvec3(picture.normal[at])));
  }
  return points;
}

/// Returns random directions, which are independent of the even ones.
std::vector<glm::vec3> drawn_directions(std::size_t count) {
  std::mt19937_64 lots(2026);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  std::vector<glm::vec3> directions;
  for (std::size_t n = 0; n < count; ++n) {
    const double z = 2.0 * share(lots) - 1.0, angle = 2.0 * std::numbers::pi * share(lots);
    directions.emplace_back(std::sqrt(1.0 - z * z) * std::cos(angle), std::sqrt(1.0 - z * z) * std::sin(angle), z);
  }
  return directions;
}

TEST(SkyVisibility, IsOneOnABallAndThatOfTheViewFactorBesideAnother) {
  // A ball of radius R, seen from a point that faces it at distance D, covers (R / D)² of the sky by cosine.
  const Surface one = compute_surface_cpu(Balls{{{0.0, 0.0, 0.0}, 2.0}}, 1.4);
  const Surface two = compute_surface_cpu(Balls{{{0.0, 0.0, 0.0}, 2.0}, {{0.0, 0.0, 12.0}, 4.0}}, 1.4);
  const std::vector<glm::dvec3> position{{0.0, 0.0, 2.0}}, normal{{0.0, 0.0, 1.0}};
  EXPECT_EQ(sky_visibility(one, {position, normal}).front(), 1.0f);
  EXPECT_NEAR(sky_visibility(two, {position, normal}).front(), 1.0 - 0.16, 0.02);
  EXPECT_NEAR(sky_visibility(two, {position, normal}, drawn_directions(200000)).front(), 1.0 - 0.16, 0.004);
}

TEST(SkyVisibility, IsThatOfTenThousandRaysAtAThousandPoints) {
  const Subject subject(testing::ubiquitin());
  const Sampled points = sampled(subject, 1000);
  const std::vector<float> few = sky_visibility(subject.surface, {points.positions, points.normals});
  const std::vector<float> many =
      sky_visibility(subject.surface, {points.positions, points.normals}, drawn_directions(20000));
  double squares = 0.0, largest = 0.0;
  for (std::size_t n = 0; n < few.size(); ++n) {
    const double error = std::abs(few[n] - many[n]);
    squares += error * error;
    largest = std::max(largest, error);
  }
  RecordProperty("rms", std::to_string(std::sqrt(squares / 1000.0)));
  RecordProperty("largest", std::to_string(largest));
  EXPECT_LT(std::sqrt(squares / 1000.0), 0.012);
  EXPECT_LT(largest, 0.05);
}

/// Rays are compared one by one with the balls.
TEST(SkyVisibility, HasTheRaysOfTheOracle) {
  const Balls balls = testing::ubiquitin();
  const Subject subject(balls);
  const Sampled points = sampled(subject, 40);
  const std::vector<glm::vec3> directions = drawn_directions(100);
  const testing::SphereTracer oracle(balls, 1.4);
  const std::vector<float> ours = sky_visibility(subject.surface, {points.positions, points.normals}, directions);
  for (std::size_t n = 0; n < ours.size(); ++n) {
    double seen = 0.0, all = 0.0;
    for (const glm::vec3& direction : directions) {
      const double cosine = glm::dot(points.normals[n], glm::dvec3(direction));
      if (cosine <= 0.0) continue;
      all += cosine;
      if (!oracle.trace(points.positions[n] + 2e-3 * points.normals[n], glm::dvec3(direction), 100.0, 1e-6))
        seen += cosine;
    }
    EXPECT_NEAR(ours[n], seen / all, 0.03) << n;  // A ray or two may pass within rounding.
  }
}

}  // namespace
}  // namespace meniscus
