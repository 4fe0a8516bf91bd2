// SPDX-License-Identifier: BSD-3-Clause
// Shade and shadows from maps of light agree with closed forms and rays; pictures are the same for any blocks, vectors
// and threads.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "core/shapes/shapes.h"
#include "tests/image/lit_subject.h"

namespace meniscus {
namespace {

/// Returns for each pixel the share of the light that shade from maps leaves; empty pixels have 1.
std::vector<float> light_left(Subject& subject, float sky, float shadows) {
  Look& look = subject.settings.look;
  look.shadows = look.ambient_occlusion = 0.0f;
  const Framebuffer bare = subject.picture();
  look.ambient_occlusion = sky;
  look.ambient_occlusion_radius = 1000.0f;  // radius of rays
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

// Balls that stand for the back of a thin plate do not reach through its front.
TEST(MappedLight, IsWholeOnAThinPlate) {
  Subject subject({{{0.0, 0.0, -60.0}, 1.0}});  // This ball is far away, for the atom of the plate.
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
  const double kLift = 0.4 * static_cast<double>(kernel::kLightLift);  // Å above the surface
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
  testing::Balls pit;
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
    bool same = true;  // true on the surface, without an edge between the pixels
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

// A ball that dissolves in front of another one lets its light through step by step, and does not darken it where it is
// hardly visible.
TEST(MappedLight, OfWhatDissolvesChangesGradually) {
  Subject subject({{{0.0, 0.0, 0.0}, 10.0}, {{0.0, 0.0, 17.0}, 5.0}});
  subject.camera = {.position = {-40.0, 0.0, 40.0}, .target = {0.0, 0.0, 6.0}, .up = {0.0, 1.0, 0.0}};
  subject.camera.projection = Projection::orthographic;
  subject.camera.height = 24.0;
  subject.settings.look.light_direction = {0.7f, 0.0f, 0.7f};  // The lamp is behind the dissolving ball.
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

}  // namespace
}  // namespace meniscus
