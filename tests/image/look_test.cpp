// SPDX-License-Identifier: BSD-3-Clause
// Light, shade, lines and depth cueing have their stated effects, equal in blocks of any size and every time.
#include "core/render/look.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "core/color/color_schemes.h"
#include "core/color/coloring.h"
#include "core/gpu/egl_context.h"
#include "core/image/color_space.h"
#include "core/render/gl_renderer.h"
#include "core/render/ray_caster.h"
#include "core/scene/renderers.h"
#include "core/surface/compute_surface.h"
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
  GlRenderer renderer_;
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
  // Nothing is around a lone ball: at most some rounding close to its rim.
  const Framebuffer bare = render(kOne, kFront, {}), shaded = render(kOne, kFront, look);
  for (std::size_t at = 0; at < bare.color.size(); ++at)
    EXPECT_NEAR(brightness(shaded.color[at]), brightness(bare.color[at]), 0.03f * brightness(bare.color[at]) + 0.002f);
  // The atom in the middle of a ring loses light, the more so the farther back it is.
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

TEST_F(Looks, ShadeLeavesNoPattern) {
  // Shade on a wall of atoms, seen straight on, repeats with the wall, and the texels of the maps do not show.
  testing::Balls wall = testing::lattice(25, 23, 1, 4.0);
  Look look;
  look.ambient_occlusion = 1.0f;
  const Camera camera{{48, 44, 50}, {48, 44, 0}, {0, 1, 0}, Projection::orthographic, 30.0, 12.0};  // 50 pixels an atom
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

/// Returns the width of black along row `y` in pixels, by their coverage with ink.
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
    // One ball is in front of another: a line is between them, and none where they touch.
    const testing::Balls two{{{0, 0, 0}, 2.0}, {{1.0, 0, -20}, 2.0}};
    EXPECT_GT(ink_along(render(two, kFront, {}), render(two, kFront, look), 75, 101, 160), 0.8f * width);
  }
}

TEST_F(Looks, LinesOfEachKindHaveTheirOwnWidth) {
  // Two parts touch, and a ball is far behind both.
  const testing::Balls three{{{-1, 0, 0}, 2.0}, {{1, 0, 0}, 2.0}, {{0, 1.6, -30}, 2.0}};
  const std::vector<std::uint32_t> part{4, 2, 4};
  const Framebuffer bare = render(three, kFront, {});
  const auto ink = [&](const Look& look, int y, int begin, int end) {
    return ink_along(bare, render(three, kFront, look, 1, 2048, part), y, begin, end);
  };
  Look look;
  look.outer_lines = 4.0f;
  look.inner_lines = 0.0f;
  look.part_lines = 2.0f;
  EXPECT_NEAR(ink(look, 75, 0, 60), 4.0f, 0.1f);
  EXPECT_NEAR(ink(look, 75, 80, 120), 2.0f, 0.2f);
  Look inner;
  inner.outer_lines = inner.part_lines = 0.0f;
  inner.inner_lines = 3.0f;
  EXPECT_NEAR(ink(inner, 75, 0, 60), 0.0f, 0.01f);
  EXPECT_NEAR(ink(inner, 75, 80, 120), 0.0f, 0.01f);
  float behind = 0.0f, none = 0.0f;  // The middle column is measured, where the far ball reaches out above.
  const Framebuffer lined = render(three, kFront, inner, 1, 2048, part),
                    other = render(three, kFront, look, 1, 2048, part);
  for (int y = 20; y < 60; ++y) {
    const std::size_t at = static_cast<std::size_t>(y) * 200 + 88;
    if (bare.color[at].w < 1.0f) continue;
    behind += 1.0f - brightness(lined.color[at]) / brightness(bare.color[at]);
    none += y > 30 ? 1.0f - brightness(other.color[at]) / brightness(bare.color[at]) : 0.0f;
  }
  EXPECT_GT(behind, 2.0f);
  EXPECT_LT(none, 0.6f * behind);
}

/// Returns a look without light, so that the red of lines around patches is the share that they cover.
Look patch_lines(float width) {
  Look look;
  look.material = {.ambient = 1.0f, .roughness = 0.0f, .specular = 0.0f, .shininess = 40.0f};
  look.patch_lines = width;
  look.patch_line_color = {1.0f, 0.0f, 0.0f};
  return look;
}

Coloring with_patches(std::vector<bool> in_patch) {
  Coloring coloring;
  coloring.atom.assign(in_patch.size(), glm::vec3(0.0f));
  coloring.in_patch = std::move(in_patch);
  return coloring;
}

/// What a line of one pixel around patches covers of a pixel: by its neighbours' atoms. Nothing: steps of in-between
/// height decide. forward: of the camera, orthographic.
std::optional<float> share_by_owners(const Framebuffer& picture, const std::vector<bool>& in_patch,
                                     const glm::vec3& forward, glm::ivec2 pixel) {
  constexpr float kNoStep = 0.25f, kStep = 2.0f;  // Å: less than any slope makes, more than one that is not steep makes
  constexpr float kSteep = 0.2f;
  const auto at = [&](glm::ivec2 p) { return static_cast<std::size_t>(p.y) * picture.size.x + p.x; };
  const std::uint32_t owner = picture.atom[at(pixel)];
  float share = 0.0f, doubtful = 0.0f;
  for (int y = -1; y <= 1; ++y)
    for (int x = -1; x <= 1; ++x) {
      const glm::ivec2 other = pixel + glm::ivec2(x, y);
      if (other.x < 0 || other.y < 0 || other.x >= picture.size.x || other.y >= picture.size.y) continue;
      const std::uint32_t next = picture.atom[at(other)];
      if (owner == kNone || next == kNone || in_patch[owner] == in_patch[next]) continue;
      const float step = std::abs(picture.z[at(pixel)] - picture.z[at(other)]);
      const float covered = std::clamp(1.5f - std::hypot(static_cast<float>(x), static_cast<float>(y)), 0.0f, 1.0f);
      const auto facing = [&](glm::ivec2 p) { return std::abs(glm::dot(picture.normal[at(p)], forward)); };
      if (step > kStep && std::max(facing(pixel), facing(other)) > kSteep) continue;
      float& of = step < kNoStep ? share : doubtful;
      of = std::max(of, covered);
    }
  if (doubtful > share) return {};
  return share;
}

TEST_F(Looks, PatchesAreOutlinedWhereTheAtomsOfPixelsSay) {
  const Surface surface = compute_surface_cpu(testing::ubiquitin(), 1.4);
  std::vector<bool> in_patch;
  for (std::size_t n = 0; n < surface.atoms.size(); ++n)
    in_patch.push_back(surface.atoms[n].center.x > surface.atoms[0].center.x || n % 7 == 0);
  RenderSettings settings;
  settings.size = {400, 300};
  settings.aovs = true;
  settings.look = patch_lines(1.0f);
  const Camera camera = frame_camera(surface.atoms, 4.0 / 3.0, Projection::orthographic);
  const glm::vec3 forward(view_basis(camera).forward);
  const auto cpu = std::make_unique<StillRenderer>();
  for (const bool on_gpu : {false, true}) {
    SCOPED_TRACE(on_gpu ? "GL" : "CPU");
    const Framebuffer picture = on_gpu ? renderer_.render(surface, with_patches(in_patch), camera, settings)
                                       : cpu->render(whole_surface(surface, with_patches(in_patch)), camera, settings);
    std::size_t lines = 0, wanted = 0, doubtful = 0, wrong = 0;
    for (int y = 0; y < 300; ++y)
      for (int x = 0; x < 400; ++x) {
        const float red = picture.color[static_cast<std::size_t>(y) * 400 + x].x;
        const std::optional<float> share = share_by_owners(picture, in_patch, forward, {x, y});
        doubtful += !share;
        if (!share) continue;
        lines += red > 0.0f;
        wanted += *share > 0.0f;
        wrong += std::abs(red - *share) > 1e-5f;
      }
    EXPECT_EQ(lines, wanted);
    EXPECT_EQ(wrong, 0u);
    EXPECT_GT(wanted, 2500u);
    EXPECT_LT(doubtful, wanted / 5);
    RecordProperty("lines", static_cast<int>(lines));
    RecordProperty("doubtful", static_cast<int>(doubtful));
  }
}

TEST_F(Looks, PatchesHaveNoLinesWhereOneIsInFrontOfAnother) {
  const testing::Balls apart{{{0, 0, 0}, 2.0}, {{1.0, 0, -20}, 2.0}}, touching{{{-1, 0, 0}, 2.0}, {{1, 0, 0}, 2.0}};
  for (const auto& [balls, has_border] : {std::pair{apart, false}, std::pair{touching, true}}) {
    const Surface surface = compute_surface_cpu(balls, 1.4);
    RenderSettings settings;
    settings.size = {200, 150};
    settings.look = patch_lines(2.0f);
    const Framebuffer picture = renderer_.render(surface, with_patches({true, false}), kFront, settings);
    float widest = 0.0f;
    for (int y = 0; y < 150; ++y) {
      float width = 0.0f;
      for (int x = 0; x < 200; ++x) width += picture.color[static_cast<std::size_t>(y) * 200 + x].x;
      widest = std::max(widest, width);
    }
    EXPECT_NEAR(widest, has_border ? 2.0f : 0.0f, 0.1f);
  }
}

TEST_F(Looks, LinesFromAfarAreOfWhatIsLarge) {
  // A ball is 3 Å in front of another: a line is between them where they fill the picture, and none where 300 Å do.
  const testing::Balls two{{{0, 0, 0}, 2.0}, {{1.0, 0, -3}, 2.0}};
  Look look;
  look.outer_lines = 0.0f;
  look.inner_lines = 2.0f;
  look.line_step = 0.012f;
  const Framebuffer bare = render(two, kFront, {}), lined = render(two, kFront, look);
  EXPECT_FALSE(bare.color == lined.color);
  Camera far = kFront;
  far.height = 300.0;
  EXPECT_TRUE(render(two, far, {}).color == render(two, far, look).color);
  look.line_step = 0.0f;
  far.height = 60.0;
  EXPECT_FALSE(render(two, far, {}).color == render(two, far, look).color) << "two pixels are nothing then";
}

TEST_F(Looks, FlatIsExactlyTheColourGiven) {
  Look look;
  look.material = {.ambient = 1.0f, .roughness = 0.0f, .specular = 0.0f, .shininess = 40.0f};
  const Framebuffer flat = render(testing::ubiquitin(), look);
  const glm::vec3 gray = linear_from_srgb(kGray);
  std::size_t covered = 0;
  for (const glm::vec4& pixel : flat.color) {
    if (pixel.w == 0.0f) continue;
    ++covered;
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(pixel[c], gray[c], 1e-6f);
  }
  EXPECT_GT(covered, 1000u);
}

TEST_F(Looks, WhiteLampsShowTheColourGivenWhereItFacesThem) {
  Look look;
  look.lamps = Lamps::white;
  look.material.specular = 0.0f;
  for (const glm::vec3& light :
       {glm::vec3(-0.45f, 0.65f, 0.75f), glm::vec3(0.0f, 0.0f, 1.0f), glm::vec3(0.6f, -0.2f, 0.5f)}) {
    look.light_direction = light;
    const glm::vec3 to = glm::normalize(light);
    const Framebuffer picture = render(kOne, kFront, look);
    // The ball of 2 Å is in the middle, at 0.04 Å a pixel.
    const auto x = static_cast<int>(99.5f + 50.0f * to.x), y = static_cast<int>(74.5f - 50.0f * to.y);
    const glm::vec4& pixel = picture.color[static_cast<std::size_t>(y) * 200 + x];
    const float expected = linear_from_srgb(kGray.x);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(pixel[c], expected, 0.01f * expected) << light.x;
    EXPECT_NEAR(pixel.x, pixel.z, 1e-5f) << "white is white";
  }
}

TEST_F(Looks, HighlightsDoNotShineInTheShade) {
  // Highlights are measured at the bottom of a well that faces camera and lamp, and on a lone ball.
  testing::Balls well = testing::ring(10, 3.0);
  for (const Ball& ball : testing::ring(10, 3.0)) well.push_back({ball.center - glm::dvec3(0, 0, 2.5), ball.radius});
  well.push_back({{0, 0, -5}, 1.7});
  const Camera camera{{0, 0, 30}, {0, 0, 0}, {0, 1, 0}, Projection::perspective, 30.0, 1.0};
  const auto added = [&](const testing::Balls& balls, const Camera& from, float shade) {
    Look look;
    look.light_direction = {0, 0, 1};
    look.ambient_occlusion = shade;
    look.ambient_occlusion_radius = 20.0f;
    look.material.specular = 0.5f;
    const float bright = brightness(render(balls, from, look).color[75 * 200 + 100]);
    look.material.specular = 0.0f;
    return bright - brightness(render(balls, from, look).color[75 * 200 + 100]);
  };
  EXPECT_GT(added(kOne, kFront, 1.0f), 1.2f);
  EXPECT_GT(added(well, camera, 0.0f), 1.2f);
  EXPECT_LT(added(well, camera, 1.0f), 0.5f);
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

TEST_F(Looks, DepthCuesThatKeepAlphaEndInTheBackground) {
  const testing::Balls two{{{-1.5, 0, 0}, 1.0}, {{1.5, 0, -40}, 1.0}};
  const Camera camera{{0, 0, 10}, {0, 0, 0}, {0, 1, 0}, Projection::orthographic, 30.0, 6.0};
  Look look;
  look.depth_cue = 0.5f;
  look.background = {0.2f, 0.6f, 1.0f};
  const Framebuffer fading = render(two, camera, look);
  look.depth_cue_keeps_alpha = true;
  const Framebuffer picture = render(two, camera, look);
  const glm::vec3 air = linear_from_srgb(look.background);
  for (std::size_t at = 0; at < picture.color.size(); ++at) {
    const glm::vec4& pixel = picture.color[at];
    EXPECT_EQ(pixel.w, fading.color[at].w > 0.0f ? 1.0f : 0.0f);
    if (pixel.w == 0.0f) continue;
    // Over its background the picture equals the other one.
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(pixel[c], fading.color[at][c] + (1.0f - fading.color[at].w) * air[c], 1e-5f);
  }
}

TEST_F(Looks, DepthIsThatAlongTheViewAxis) {
  // In a wide perspective rays to the corner are longer than deep. Both balls begin and end at the same depths.
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

// A surface that covers its own inside shall not fade it, too.
TEST(LookOfASeenThroughSurface, HasNoDepthCueUnlessItIsAskedFor) {
  constexpr glm::vec3 kPaper(1.0f);
  const auto look = [&](std::initializer_list<const char*> opacities, const LookRequest& request = {}) {
    ColorScheme color;
    for (const char* rule : opacities) color.opacities.push_back(parse_opacity_rule(rule));
    return look_of(request, {640, 480}, kPaper, hues_of(color, false));
  };
  const Look opaque = look({});
  EXPECT_GT(opaque.depth_cue, 0.0f);
  const Look ghost = look({"0.3"});
  EXPECT_EQ(ghost.depth_cue, 0.0f);
  EXPECT_EQ(ghost.material.specular, opaque.material.specular);
  EXPECT_EQ(ghost.ambient_occlusion, opaque.ambient_occlusion);
  EXPECT_EQ(look({"chain A=0.5", "chain B=1"}).depth_cue, 0.0f);
  EXPECT_EQ(look({"chain A=0"}).depth_cue, opaque.depth_cue);  // hidden
  LookRequest asked;
  asked.depth_cue = 0.2f;
  EXPECT_EQ(look({"0.3"}, asked).depth_cue, 0.2f);
}

TEST(LookOfAPreset, FadesLittleAndNotAtAllWithoutABackground) {
  LookRequest request;
  for (const LookPreset preset : {LookPreset::publication, LookPreset::cover, LookPreset::soft}) {
    request.preset = preset;
    EXPECT_EQ(look_of(request, {640, 480}, glm::vec3(1.0f), Hues::free).depth_cue, 0.1f);
    EXPECT_EQ(look_of(request, {640, 480}, {}, Hues::free).depth_cue, 0.0f);
  }
  request.depth_cue = 0.3f;
  EXPECT_EQ(look_of(request, {640, 480}, {}, Hues::free).depth_cue, 0.3f);
}

TEST(LookOfNumbers, TakesLessLightFromDarkColors) {
  ColorScheme color;
  const Look free = look_of({}, {640, 480}, {}, hues_of(color, false));
  color.by = ColorScheme::By::bfactor;
  const Look kept = look_of({}, {640, 480}, {}, hues_of(color, false));
  EXPECT_LT(kept.ambient_occlusion, free.ambient_occlusion);
  EXPECT_GT(kept.material.ambient, free.material.ambient);
}

}  // namespace
}  // namespace meniscus
