// SPDX-License-Identifier: BSD-3-Clause
// Light, shade, lines and air do what they say, the same in blocks of any size and every time.
#include "core/render/look.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "core/gpu/egl_context.h"
#include "core/image/color_space.h"
#include "core/render/presenter.h"
#include "core/render/renderer.h"
#include "core/surface/surface.h"
#include "tests/support/molecules.h"

namespace meniscus {
namespace {

constexpr glm::vec3 kGray{0.7f};

class Looks : public ::testing::Test {
 protected:
  Framebuffer render(const testing::Balls& balls, const Camera& camera, const Look& look, int samples = 1,
                     int block_edge = 2048, const std::vector<std::uint32_t>& part = {}) {
    const Surface surface = compute_surface_cpu(balls, 1.4);
    Coloring coloring;
    coloring.atom.assign(balls.size(), kGray);
    coloring.part = part;
    RenderSettings settings;
    settings.size = {200, 150};
    settings.samples = samples;
    settings.aovs = true;
    settings.look = look;
    settings.block_edge = block_edge;
    return renderer_.render(surface, coloring, camera, settings);
  }
  Framebuffer render(const testing::Balls& balls, const Look& look, int samples = 1, int block_edge = 2048) {
    return render(balls, frame_camera(balls, 4.0 / 3.0), look, samples, block_edge);
  }

  EglContext context_;
  Renderer renderer_;
};

const testing::Balls kOne{{{0, 0, 0}, 2.0}};
const Camera kFront{{0, 0, 10}, {0, 0, 0}, {0, 1, 0}, Projection::orthographic, 30.0, 6.0};  // 0.04 Å a pixel

Look everything() {
  Look look;
  look.ambient_occlusion = 1.0f;
  look.silhouettes = 3.0f;
  look.depth_cue = 0.7f;
  return look;
}

float brightness(const glm::vec4& c) { return c.x + c.y + c.z; }

TEST_F(Looks, BlocksAndRepetitionDoNotShow) {
  for (const int samples : {1, 3}) {
    const Framebuffer whole = render(testing::ubiquitin(), everything(), samples);
    EXPECT_TRUE(whole.color == render(testing::ubiquitin(), everything(), samples).color);
    const Framebuffer blocks = render(testing::ubiquitin(), everything(), samples, 96);
    EXPECT_TRUE(whole.color == blocks.color);
    EXPECT_TRUE(whole.z == blocks.z && whole.atom == blocks.atom);
    EXPECT_TRUE(whole.z == render(testing::ubiquitin(), Look{}, samples).z) << "hits are what they are";
  }
}

TEST_F(Looks, ShadeDarkensCleftsAndNothingElse) {
  Look look;
  look.ambient_occlusion = 1.0f;
  // A lone ball has nothing around it: at most some rounding close to its rim.
  const Framebuffer bare = render(kOne, kFront, {}), shaded = render(kOne, kFront, look);
  for (std::size_t at = 0; at < bare.color.size(); ++at)
    EXPECT_NEAR(brightness(shaded.color[at]), brightness(bare.color[at]), 0.03f * brightness(bare.color[at]) + 0.002f);
  // Behind a ring of atoms the one in the middle loses light, the more so the farther back it stands.
  float before = 1.02f;
  for (const double back : {1.0, 2.0, 3.0}) {
    testing::Balls well = testing::ring(10, 3.0);
    well.push_back({{0, 0, -back}, 1.7});
    const Camera camera{{0, 0, 30}, {0, 0, 0}, {0, 1, 0}, Projection::perspective, 30.0, 1.0};
    const std::size_t middle = 75 * 200 + 100;
    const float share =
        brightness(render(well, camera, look).color[middle]) / brightness(render(well, camera, {}).color[middle]);
    EXPECT_LT(share, before - 0.02f) << back;
    before = share;
  }
  const Framebuffer plain = render(testing::ubiquitin(), {}), deep = render(testing::ubiquitin(), look);
  double sum_plain = 0, sum_deep = 0;
  for (std::size_t at = 0; at < plain.color.size(); ++at) {
    EXPECT_LE(brightness(deep.color[at]), brightness(plain.color[at]) * 1.0001f);
    EXPECT_EQ(deep.color[at].w, plain.color[at].w);
    sum_plain += brightness(plain.color[at]);
    sum_deep += brightness(deep.color[at]);
  }
  EXPECT_LT(sum_deep, 0.9 * sum_plain);
  EXPECT_GT(sum_deep, 0.4 * sum_plain);
}

TEST_F(Looks, ShadeReachesAsFarAsItsRadiusAndNoFarther) {
  // A ball hovers over a large one and shades it where some of it that the picture shows is within reach.
  const testing::Balls lone{{{0, 0, 0}, 10.0}}, both{{{0, 0, 0}, 10.0}, {{8, 0, 14}, 3.0}};
  const Camera camera{{4, 0, 40}, {4, 0, 0}, {0, 1, 0}, Projection::orthographic, 30.0, 16.0};
  constexpr double kPixel = 16.0 / 150.0, kRadius = 5.0;
  constexpr double kBlur = 4.0 * kPixel;  // shade is averaged over 5 x 5 pixels, which stretch where it is steep
  Look look;
  look.ambient_occlusion = 1.0f;
  look.ambient_occlusion_radius = static_cast<float>(kRadius);
  const Framebuffer without = render(lone, camera, look), with = render(both, camera, look);
  std::size_t shaded = 0, beyond = 0, strays = 0;
  for (std::size_t at = 0; at < without.atom.size(); ++at) {
    if (without.atom[at] != 0 || with.atom[at] != 0 || without.normal[at].z < 0.8f) continue;  // rims are coarse
    double distance = 1e9;
    for (std::size_t other = 0; other < with.atom.size(); ++other) {
      if (with.atom[other] != 1) continue;
      distance = std::min<double>(distance, glm::distance(with.position[at], with.position[other]));
    }
    // The frames of the two scenes round differently; shade is far more.
    const float lost = 1.0f - brightness(with.color[at]) / brightness(without.color[at]);
    const bool differs = std::abs(lost) > 1e-3f;
    if (distance > kRadius + kBlur) {
      strays += differs ? 1 : 0;
      beyond += distance < 1.2 * kRadius ? 1 : 0;
    }
    shaded += differs && distance > 0.85 * kRadius ? 1 : 0;
  }
  EXPECT_GT(shaded, 10u) << "close to the radius some shade is left";
  EXPECT_GT(beyond, 200u) << "a radius a little larger would show";
  EXPECT_LT(strays, beyond / 10) << "by the edge of the other ball means are over fewer pixels";
}

TEST_F(Looks, ShadeLeavesNoPattern) {
  // On a wall of atoms seen straight on, shade repeats with the wall and not with the pixels' blocks of 4.
  testing::Balls wall = testing::lattice(9, 7, 1, 4.0);
  Look look;
  look.ambient_occlusion = 1.0f;
  look.ambient_occlusion_radius = 2.0f;                                                             // 25 pixels
  const Camera camera{{16, 12, 50}, {16, 12, 0}, {0, 1, 0}, Projection::orthographic, 30.0, 12.0};  // 50 pixels an atom
  const Framebuffer bare = render(wall, camera, {}), shaded = render(wall, camera, look);
  for (int y = 28; y < 72; ++y)
    for (int x = 28; x < 122; ++x) {
      const auto share = [&](int dx, int dy) {
        const std::size_t at = static_cast<std::size_t>(y + dy) * 200 + x + dx;
        return (brightness(shaded.color[at]) + 1e-6f) / (brightness(bare.color[at]) + 1e-6f);  // 1 in a gap
      };
      EXPECT_NEAR(share(0, 0), share(50, 0), 0.012f);
      EXPECT_NEAR(share(0, 0), share(0, 50), 0.012f);
    }
}

/// Widths in pixels of black along the row `y`: pixels that ink covers, by how much.
float ink_along(const Framebuffer& bare, const Framebuffer& inked, int y, int begin, int end) {
  float sum = 0.0f;
  for (int x = begin; x < end; ++x) {
    const std::size_t at = static_cast<std::size_t>(y) * 200 + x;
    const float alpha = bare.color[at].w;
    sum += alpha > 0.0f ? 1.0f - brightness(inked.color[at]) / brightness(bare.color[at]) : inked.color[at].w;
  }
  return sum;
}

TEST_F(Looks, LinesAreAsWideAsAsked) {
  for (const float width : {1.0f, 2.0f, 5.0f}) {
    Look look;
    look.silhouettes = width;
    const Framebuffer bare = render(kOne, kFront, {}), inked = render(kOne, kFront, look);
    EXPECT_NEAR(ink_along(bare, inked, 75, 0, 100), width, 0.05f);  // the left rim, and nothing inside
    EXPECT_NEAR(ink_along(bare, inked, 75, 60, 140), 0.0f, 0.01f);
    EXPECT_EQ(inked.color[0].w, 0.0f);
    // One ball in front of another: a line between them, none where they touch.
    const testing::Balls two{{{0, 0, 0}, 2.0}, {{1.0, 0, -20}, 2.0}};
    EXPECT_GT(ink_along(render(two, kFront, {}), render(two, kFront, look), 75, 101, 160), 0.8f * width);
  }
}

TEST_F(Looks, LinesPartChains) {
  const testing::Balls two{{{-1, 0, 0}, 2.0}, {{1, 0, 0}, 2.0}};
  Look look;
  look.silhouettes = 2.0f;
  const Framebuffer bare = render(two, kFront, {});
  EXPECT_EQ(ink_along(bare, render(two, kFront, look), 75, 80, 120), 0.0f);
  EXPECT_EQ(ink_along(bare, render(two, kFront, look, 1, 2048, {4, 4}), 75, 80, 120), 0.0f);
  const Framebuffer parted = render(two, kFront, look, 1, 2048, {4, 2});
  EXPECT_NEAR(ink_along(bare, parted, 75, 80, 120), 2.0f, 0.2f);
  EXPECT_NEAR(ink_along(bare, parted, 75, 80, 97) + ink_along(bare, parted, 75, 103, 120), 0.0f, 0.01f);
}

TEST_F(Looks, DepthCuesFadeTheFarthestByTheShareAsked) {
  const testing::Balls two{{{-1.5, 0, 0}, 1.0}, {{1.5, 0, -40}, 1.0}};
  const Camera camera{{0, 0, 10}, {0, 0, 0}, {0, 1, 0}, Projection::orthographic, 30.0, 6.0};
  Look look;
  look.depth_cue = 0.5f;
  const Framebuffer bare = render(two, camera, {}), faded = render(two, camera, look);
  const std::size_t near = 75 * 200 + 62, far = 75 * 200 + 137;  // 1.5 Å from the middle
  EXPECT_NEAR(faded.color[near].w, 1.0f, 0.001f);                // its front is where depth begins
  // Depth ends at the back of the second ball, 42 Å later; its front is at 40.
  EXPECT_NEAR(faded.color[far].w, 1.0f - 0.5f * 40.0f / 42.0f, 0.001f);
  EXPECT_NEAR(faded.color[far].x, bare.color[far].x * faded.color[far].w, 1e-5f);
}

TEST_F(Looks, DepthIsThatAlongTheViewAxis) {
  // A wide perspective: rays to the corner are longer than deep. Both balls begin and end at the same depths.
  const testing::Balls two{{{0, 0, 0}, 1.0}, {{9, 0, 0}, 1.0}};
  const Camera camera{{0, 0, 10}, {0, 0, 0}, {0, 1, 0}, Projection::perspective, 75.0, 1.0};
  Look look;
  look.depth_cue = 1.0f;
  const Framebuffer bare = render(two, camera, {}), faded = render(two, camera, look);
  int seen = 0;
  for (std::size_t at = 0; at < bare.color.size(); ++at) {
    if (bare.color[at].w == 0.0f) continue;
    ++seen;
    const float depth = 10.0f - bare.position[at].z;
    EXPECT_NEAR(faded.color[at].w, 1.0f - (depth - 9.0f) / 2.0f, 0.002f);
  }
  EXPECT_GT(seen, 200);
}

TEST_F(Looks, LightComesFromWhereItIsSaidTo) {
  const auto at = [](int x, int y) { return static_cast<std::size_t>(y) * 200 + x; };
  Look left, right, off;
  left.light_direction = {-3, 0, 1};
  right.light_direction = {3, 0, 1};
  off.light_strength = 0.0f;
  const Framebuffer from_left = render(kOne, kFront, left), from_right = render(kOne, kFront, right);
  EXPECT_GT(brightness(from_left.color[at(65, 75)]), 1.5f * brightness(from_left.color[at(134, 75)]));
  EXPECT_GT(brightness(from_right.color[at(134, 75)]), 1.5f * brightness(from_right.color[at(65, 75)]));
  const Framebuffer dark = render(kOne, kFront, off);
  EXPECT_LT(brightness(dark.color[at(65, 75)]), 0.7f * brightness(from_left.color[at(65, 75)]));
  Look usual;
  usual.light_direction *= 4.0f;
  EXPECT_TRUE(render(kOne, kFront, usual).color == render(kOne, kFront, {}).color) << "a direction has no length";
}

TEST_F(Looks, PresentedPicturesAreThePictureOverItsBackground) {
  const Framebuffer picture = render(testing::ubiquitin(), everything(), 3);
  const glm::vec3 background{0.2f, 0.5f, 1.0f};
  Presenter presenter;
  presenter.present(renderer_.samples(), picture.size, 3, background);
  const std::vector<std::uint8_t> rgba = presenter.rgba();
  ASSERT_EQ(rgba.size(), picture.color.size() * 4);
  for (std::size_t at = 0; at < picture.color.size(); ++at) {
    const glm::vec4& c = picture.color[at];
    const glm::vec3 expected = srgb_from_linear(glm::vec3(c) + linear_from_srgb(background) * (1.0f - c.w));
    for (int n = 0; n < 3; ++n) EXPECT_NEAR(rgba[4 * at + n], 255.0f * expected[n], 0.6f);
    EXPECT_EQ(rgba[4 * at + 3], 255);
  }
}

}  // namespace
}  // namespace meniscus
