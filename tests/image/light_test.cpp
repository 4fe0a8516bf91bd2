// SPDX-License-Identifier: BSD-3-Clause
// Shadows and traced shade of pictures: closed forms, an oracle that knows only the balls, and the same picture for any
// blocks and vectors.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "core/queries/copies.h"
#include "core/queries/surface_object.h"
#include "core/render/cpu/cpu_renderer.h"
#include "core/render/cpu/occluders.h"
#include "core/scene/cut.h"
#include "core/shapes/shapes.h"
#include "core/surface/compute_surface.h"
#include "tests/support/molecules.h"
#include "tests/support/sphere_tracer.h"

namespace meniscus {
namespace {

using testing::Balls;

constexpr glm::vec3 kGrey(0.8f);

/// A surface in grey, seen through the centres of pixels, under a sharp lamp that is all of its light.
struct Subject {
  Surface surface;
  Coloring coloring;
  Camera camera;
  RenderSettings settings;
  std::vector<PictureObject> objects;

  explicit Subject(const Balls& balls, double probe_radius = 1.4)
      : surface(compute_surface_cpu(balls, probe_radius)), camera(frame_camera(surface.atoms, 4.0 / 3.0)) {
    coloring.atom.assign(surface.atoms.size(), kGrey);
    settings.size = {160, 120};
    settings.aovs = true;
    settings.look.material = {.ambient = 1.0f, .roughness = 0.0f, .specular = 0.0f};
    settings.look.shadows = 1.0f;
    PictureObject& object = objects.emplace_back();
    object.surface = &surface;
    object.coloring = &coloring;
  }
  Subject(const Subject&) = delete;
  Subject& operator=(const Subject&) = delete;

  Framebuffer picture() const { return CpuRenderer().render(objects, camera, settings); }
  glm::dvec3 lamp() const {
    const ViewBasis basis = view_basis(camera);
    const glm::dvec3 l = glm::normalize(glm::dvec3(settings.look.light_direction));
    return basis.right * l.x + basis.up * l.y - basis.forward * l.z;
  }
};

/// Whether a pixel of grey, with ambient 1 and one sample, is in full light.
bool lit(const Framebuffer& picture, std::size_t at) {
  float brightest = 0.0f;
  for (const glm::vec4& pixel : picture.color) brightest = std::max(brightest, pixel.x);
  return picture.color[at].x > 0.95f * brightest;
}

bool same_bits(const Framebuffer& a, const Framebuffer& b) {
  return a.color.size() == b.color.size() &&
         std::memcmp(a.color.data(), b.color.data(), a.color.size() * sizeof a.color[0]) == 0;
}

/// Pixels whose light the oracle sees otherwise, of those that it can tell: rays that pass the solid closely, or leave
/// along the surface, are left out.
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

/// Two balls so far apart that their surfaces are theirs, the lamp beside the camera: the one in front covers a disc.
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

/// What is cut away casts none, and a cap casts what the solid behind it would.
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
    // Where the lamp's ray leaves what is kept.
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

/// Light that would go into a slab by one cap and out of it by the other is kept away: nowhere in between is a surface.
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

/// A stick beside a ball: dark is what sees the lamp within its radius of the axis.
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

/// Copies are in memory once; rays turn to them. Some pixels at the edges of shadows may differ by rounding.
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

/// A ball that is seen through lets the light pass.
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

/// Returns for each pixel the share of the light that shade from maps leaves; nothing is 1.
std::vector<float> light_left(Subject& subject, float sky, float shadows) {
  Look& look = subject.settings.look;
  look.shadows = look.ambient_occlusion = 0.0f;
  const Framebuffer bare = subject.picture();
  look.ambient_occlusion = sky;
  look.ambient_occlusion_radius = 1000.0f;  // of rays
  look.shadows = shadows;
  look.shadow_softness = 12.0f;
  const Framebuffer shaded = subject.picture();
  std::vector<float> left;
  for (std::size_t at = 0; at < bare.color.size(); ++at)
    left.push_back(bare.color[at].w > 0.0f ? shaded.color[at].x / bare.color[at].x : 1.0f);
  return left;
}

TEST(MappedLight, IsWholeOnALoneBall) {
  Subject subject({{{0.0, 0.0, 0.0}, 2.0}});
  for (const float left : light_left(subject, 1.0f, 0.0f)) EXPECT_GT(left, 0.995f);
}

// The balls that stand for the back of a thin plate do not stand out of its front.
TEST(MappedLight, IsWholeOnAThinPlate) {
  Subject subject({{{0.0, 0.0, -60.0}, 1.0}});  // far away, for the atom of the plate
  Shapes shapes;
  const std::vector<glm::dvec3> square{{-3.0, -3.0, 0.0}, {3.0, -3.0, 0.0}, {3.0, 3.0, 0.0}, {-3.0, 3.0, 0.0}};
  add_plate(shapes.mesh, square, {0.0, 0.0, 1.0}, 0.15, 0);
  PictureObject& plate = subject.objects.emplace_back();
  plate.shapes = &shapes;
  plate.coloring = &subject.coloring;
  subject.camera = {.position = {6.0, 4.0, 40.0}, .target = {0.0, 0.0, 0.0}, .up = {0.0, 1.0, 0.0}};
  subject.camera.projection = Projection::orthographic;
  subject.camera.height = 4.0;
  for (const float shadows : {0.0f, 1.0f}) {
    const std::vector<float> left = light_left(subject, 1.0f - shadows, shadows);
    EXPECT_GT(std::ranges::min(left), 0.85f) << shadows;
    EXPECT_GT(std::accumulate(left.begin(), left.end(), 0.0) / static_cast<double>(left.size()), 0.97) << shadows;
  }
}

// A ball of radius r whose centre is at distance d, at an angle to the normal, covers (r / d)² cos(angle) of the sky
// while all of it is above the horizon (Howell, A Catalog of Radiation Heat Transfer Configuration Factors, B-38).
TEST(MappedLight, BesideABallIsThatOfItsViewFactor) {
  const Ball large{{0.0, 0.0, 0.0}, 10.0}, small{{5.0, 0.0, 16.0}, 3.0};
  const double kLift = 0.4 * static_cast<double>(kernel::kLightLift);  // Å, from where light is looked for
  Subject subject({large, small});
  subject.camera = {.position = {-40.0, 0.0, 40.0}, .target = {0.0, 0.0, 8.0}, .up = {0.0, 1.0, 0.0}};
  subject.camera.projection = Projection::orthographic;
  subject.camera.height = 16.0;
  const std::vector<float> left = light_left(subject, 1.0f, 0.0f);
  const Framebuffer picture = subject.picture();
  int count = 0;
  double bias = 0.0;
  float least = 1.0f;
  for (std::size_t at = 0; at < left.size(); ++at) {
    if (picture.atom[at] != 0) continue;
    const glm::dvec3 normal(picture.normal[at]);
    const glm::dvec3 way = small.center - glm::dvec3(picture.position[at]) - kLift * normal;
    const double distance = glm::length(way), cosine = glm::dot(way, normal) / distance;
    if (std::acos(cosine) + std::asin(small.radius / distance) > 1.45) continue;
    const double expected = 1.0 - cosine * small.radius * small.radius / (distance * distance);
    EXPECT_NEAR(left[at], expected, 0.04);
    bias += left[at] - expected;
    least = std::min(least, left[at]);
    ++count;
  }
  EXPECT_GT(count, 500);
  EXPECT_LT(std::abs(bias), 0.015 * count);
  EXPECT_LT(least, 0.8f);
}

TEST(MappedLight, IsScarceAtTheBottomOfAPit) {
  Balls pit;
  for (const double z : {0.0, -2.5, -5.0, -7.5})
    for (const Ball& ball : testing::ring(10, 3.0)) pit.push_back({ball.center + glm::dvec3(0, 0, z), ball.radius});
  pit.push_back({{0.0, 0.0, -9.0}, 1.7});
  Subject subject(pit);
  subject.camera = {.position = {0.0, 0.0, 30.0}, .target = {0.0, 0.0, 0.0}, .up = {0.0, 1.0, 0.0}};
  const std::vector<float> left = light_left(subject, 1.0f, 0.0f);
  EXPECT_LT(left[60 * 160 + 80], 0.2f);
}

TEST(MappedLight, IsThatOfRays) {
  Subject subject(testing::ubiquitin());
  subject.settings.size = {320, 240};
  for (const float shadows : {0.0f, 1.0f}) {
    const std::vector<float> left = light_left(subject, 1.0f - shadows, shadows);
    subject.settings.look.ambient_occlusion = 1.0f;
    subject.settings.look.ambient_occlusion_rays = 256.0f;
    subject.settings.samples = 1;
    Look bare = subject.settings.look;
    bare.ambient_occlusion = bare.shadows = 0.0f;
    if (shadows > 0.0f) subject.settings.look.ambient_occlusion = 1e-6f;
    const Framebuffer traced = subject.picture();
    std::swap(bare, subject.settings.look);
    const Framebuffer open = subject.picture();
    std::vector<float> errors;
    for (std::size_t at = 0; at < left.size(); ++at)
      if (std::isfinite(traced.z[at])) errors.push_back(std::abs(left[at] - traced.color[at].x / open.color[at].x));
    std::ranges::sort(errors);
    EXPECT_LT(errors[errors.size() / 2], 0.03f) << shadows;
    EXPECT_LT(errors[errors.size() * 95 / 100], 0.15f) << shadows;
    subject.settings.look.ambient_occlusion_rays = 0.0f;
  }
}

TEST(MappedLight, IsFiniteInPicturesOfAnySize) {
  Subject subject(testing::ubiquitin());
  subject.settings.aovs = false;
  subject.settings.look = look_of({}, {64, 48}, {}, Hues::free, false);
  for (int width = 1; width <= 40; width += 3)
    for (const int height : {1, 5, 16, 37}) {
      subject.settings.size = {width, height};
      for (const glm::vec4& pixel : subject.picture().color)
        for (int n = 0; n < 4; ++n) ASSERT_TRUE(std::isfinite(pixel[n])) << width << "x" << height;
    }
}

TEST(MappedLight, IsTheSameForAnyBlocksVectorsAndThreads) {
  Subject subject(testing::ubiquitin());
  subject.settings.samples = 4;
  subject.settings.look.shadow_softness = 6.0f;
  subject.settings.look.ambient_occlusion = 0.9f;
  subject.settings.aovs = false;
  const Framebuffer usual = subject.picture();
  subject.settings.block_edge = 64;
  EXPECT_TRUE(same_bits(usual, subject.picture()));
  for (const int lanes : {4, 8})
    EXPECT_TRUE(same_bits(usual, CpuRenderer(lanes).render(subject.objects, subject.camera, subject.settings)))
        << lanes;
  for (const std::size_t threads : {1, 2, 3}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    EXPECT_TRUE(same_bits(usual, subject.picture())) << threads;
  }
}

// Returns the change at the 99th percentile of the light that points of the surface get in a turn by half a degree.
float change_in_a_turn(float sky, float shadows) {
  Subject subject(testing::ubiquitin());
  subject.settings.size = {480, 360};
  subject.camera = frame_camera(subject.surface.atoms, 4.0 / 3.0, Projection::orthographic);
  const std::vector<float> before = light_left(subject, sky, shadows);
  const Framebuffer picture = subject.picture();
  const glm::dvec3 back = subject.camera.position - subject.camera.target, up = view_basis(subject.camera).up;
  constexpr double kTurn = 0.5 * std::numbers::pi / 180.0;
  subject.camera.up = up;
  subject.camera.position = subject.camera.target + std::cos(kTurn) * back + std::sin(kTurn) * glm::cross(up, back);
  const std::vector<float> after = light_left(subject, sky, shadows);
  const Framebuffer turned = subject.picture();
  const ViewBasis basis = view_basis(subject.camera);
  const double pixel = subject.camera.height / 360.0;
  std::vector<float> changes;
  for (std::size_t at = 0; at < before.size(); ++at) {
    if (!std::isfinite(picture.z[at])) continue;
    const glm::dvec3 point(picture.position[at]), way = point - subject.camera.position;
    const double x = glm::dot(way, basis.right) / pixel + 239.5, y = 179.5 - glm::dot(way, basis.up) / pixel;
    if (x < 0.0 || y < 0.0 || x >= 479.0 || y >= 359.0) continue;
    float there = 0.0f;
    bool same = true;  // surface, without an edge between the pixels
    for (int n = 0; n < 4; ++n) {
      const std::size_t other = (static_cast<std::size_t>(y) + n / 2) * 480 + static_cast<std::size_t>(x) + n % 2;
      const double right = x - std::floor(x), down = y - std::floor(y);
      there += static_cast<float>((n % 2 ? right : 1.0 - right) * (n / 2 ? down : 1.0 - down)) * after[other];
      same = same && std::isfinite(turned.z[other]) && glm::distance(glm::dvec3(turned.position[other]), point) < 0.3;
    }
    if (same) changes.push_back(std::abs(there - before[at]));
  }
  EXPECT_GT(changes.size(), 20'000u);
  std::ranges::sort(changes);
  return changes[changes.size() * 99 / 100];
}

// In a slow turn a point of the surface keeps its shade. The lamp moves with the camera: with infinitely many places on
// the lamp and infinitely small texels the light changes by 0.015, because the penumbras move.
TEST(MappedLight, StaysAtItsPointWhileTheCameraTurns) {
  const float sky = change_in_a_turn(1.0f, 0.0f), lamp = change_in_a_turn(0.0f, 1.0f);
  RecordProperty("change of the shade at the 99th percentile", std::to_string(sky));
  RecordProperty("change of the shadows at the 99th percentile", std::to_string(lamp));
  EXPECT_LT(sky, 0.02f);
  EXPECT_LT(lamp, 0.026f);
}

// A ball that dissolves over another one lets its light go step by step, and does not darken it where it is hardly
// visible.
TEST(MappedLight, OfWhatDissolvesChangesGradually) {
  Subject subject({{{0.0, 0.0, 0.0}, 10.0}, {{0.0, 0.0, 17.0}, 5.0}});
  subject.camera = {.position = {-40.0, 0.0, 40.0}, .target = {0.0, 0.0, 6.0}, .up = {0.0, 1.0, 0.0}};
  subject.camera.projection = Projection::orthographic;
  subject.camera.height = 24.0;
  subject.settings.look.light_direction = {0.7f, 0.0f, 0.7f};  // the dissolving ball is between the lamp and the other
  for (const float shadows : {0.0f, 1.0f}) {
    constexpr int kSteps = 20;
    std::vector<double> mean;
    for (int step = 0; step <= kSteps; ++step) {
      subject.coloring.opacity = {1.0f, 1.0f - static_cast<float>(step) / kSteps};
      const std::vector<float> left = light_left(subject, 1.0f - shadows, shadows);
      const Framebuffer picture = subject.picture();
      double sum = 0.0;
      int count = 0;
      for (std::size_t at = 0; at < left.size(); ++at) {
        const glm::dvec3 place(picture.position[at]);
        if (picture.atom[at] != 0 || place.z - place.x < 4.0 || place.z - place.x > 13.0) continue;
        sum += left[at];
        ++count;
      }
      ASSERT_GT(count, 500);
      mean.push_back(sum / count);
    }
    const double whole = mean.back() - mean.front();
    EXPECT_GT(whole, 0.05) << shadows;
    double greatest = 0.0;
    for (int step = 0; step < kSteps; ++step) greatest = std::max(greatest, mean[step + 1] - mean[step]);
    RecordProperty("greatest step of the mean step", std::to_string(greatest / whole * kSteps));
    EXPECT_LT(greatest, 2.5 * whole / kSteps) << shadows;
    EXPECT_LT(mean.back() - mean[14], 0.12 * whole) << shadows;  // at an opacity of 0.3
  }
}

TEST(MappedLight, OfACutIsThatOfWhatIsLeft) {
  // The plane takes away the ball that shades the other one.
  Subject subject({{{0.0, 0.0, 0.0}, 4.0}, {{0.0, 0.0, 12.0}, 4.0}});
  subject.camera = {.position = {20.0, 0.0, 20.0}, .target = {0.0, 0.0, 2.0}, .up = {0.0, 1.0, 0.0}};
  subject.objects[0].clip = {{{0.0, 0.0, 1.0}, 5.0}};
  for (const float left : light_left(subject, 1.0f, 0.0f)) EXPECT_GT(left, 0.995f);
}

/// Points spread over a surface by the pixels of a picture, at most so many.
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

/// Directions drawn by lot: independent of the even ones.
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

/// Ray by ray, against the balls.
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
    EXPECT_NEAR(ours[n], seen / all, 0.03) << n;  // a ray or two may pass within rounding
  }
}

}  // namespace
}  // namespace meniscus
