// SPDX-License-Identifier: BSD-3-Clause
// Pictures of the CPU equal those of GL but for rounding, with the same bits for any vectors, threads and blocks.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "core/gpu/egl_context.h"
#include "core/image/color_space.h"
#include "core/scene/renderers.h"
#include "core/shapes/shapes.h"
#include "core/surface/compute_surface.h"
#include "tests/support/molecules.h"
#include "core/camera/camera.h"

namespace meniscus {
namespace {

using testing::Balls;

/// A surface in two colours, and the settings of its picture.
struct Picture {
  std::string name;
  Surface surface;
  Coloring coloring;
  Camera camera;
  RenderSettings settings;

  Picture(std::string name_, const Balls& balls, double probe_radius, Projection projection = Projection::perspective)
      : name(std::move(name_)), surface(compute_surface_cpu(balls, probe_radius)) {
    for (std::size_t n = 0; n < surface.atoms.size(); ++n)
      coloring.atom.push_back(n % 2 ? glm::vec3(0.8f, 0.25f, 0.2f) : glm::vec3(0.3f, 0.5f, 0.9f));
    settings.size = {230, 170};  // The sides are no whole numbers of tiles.
    settings.samples = 2;
    settings.aovs = true;
    camera = frame_camera(surface.atoms, 230.0 / 170.0, projection);
  }

  Framebuffer by(StillRenderer& renderer) const {
    return renderer.render(whole_surface(surface, coloring), camera, settings);
  }
};

Look all_effects() {
  Look look;
  look.ambient_occlusion = 0.9f;
  look.shadows = 0.6f;
  look.shadow_softness = 10.0f;
  look.silhouettes = 2.5f;
  look.depth_cue = 0.5f;
  return look;
}

std::vector<Picture> pictures() {
  std::vector<Picture> all;
  all.emplace_back("spindle torus", testing::two_atoms(5.2, 1.7, 1.3), 1.4, Projection::orthographic);
  all.emplace_back("free torus", testing::two_atoms(2.5), 1.4);
  all.emplace_back("tied lattice", testing::lattice(3, 3, 2, 4.0), 1.4);
  all.emplace_back("no probe", testing::ubiquitin(), 0.0);
  all.emplace_back("1UBQ", testing::ubiquitin(), 1.4, Projection::orthographic);
  all.back().coloring.kind = {{{0.2f, 0.6f, 0.4f}, {0.4f, 0.6f, 0.9f}, {0.8f, 0.4f, 0.2f}}};
  all.emplace_back("1TII", testing::enterotoxin(), 1.4);
  all.back().settings.look = all_effects();
  all.back().settings.samples = 6;
  for (std::size_t n = 0; n < all.back().surface.atoms.size(); ++n)
    all.back().coloring.part.push_back(static_cast<std::uint32_t>(n / 1000));
  all.emplace_back("1UBQ in part", testing::ubiquitin(), 1.4);
  for (std::size_t n = 0; n < all.back().surface.atoms.size(); ++n) all.back().coloring.hidden.push_back(n % 5 < 2);
  all.back().settings.look = all_effects();
  all.emplace_back("1UBQ with patches", testing::ubiquitin(), 1.4);
  for (std::size_t n = 0; n < all.back().surface.atoms.size(); ++n)
    all.back().coloring.in_patch.push_back(n % 100 < 30);
  all.back().coloring.part.assign(all.back().surface.atoms.size(), 2);
  all.back().settings.look = all_effects();
  all.back().settings.look.patch_lines = 4.0f;
  all.back().settings.look.patch_line_color = {0.9f, 0.8f, 0.1f};
  all.emplace_back("cavity from inside", testing::c60(), 0.5);
  glm::dvec3 middle(0.0);
  for (const Ball& ball : all.back().surface.atoms) middle += ball.center / 60.0;
  all.back().camera = {middle, middle + glm::dvec3(0.3, 0.2, 1.0), {0, 1, 0}, Projection::perspective, 60.0, 1.0};
  return all;
}

/// Numbers of pixels that differ.
struct Difference {
  int color = 0;        ///< colours that differ in 8 bits
  int by_more = 0;      ///< colours that differ by more than 1 of 255
  int worst_color = 0;  ///< largest difference of a channel, in 8 bits
  int atom = 0, depth = 0;
};

Difference difference(const Framebuffer& a, const Framebuffer& b) {
  Difference result;
  for (std::size_t n = 0; n < a.color.size(); ++n) {
    int worst = 0;
    for (int channel = 0; channel < 4; ++channel) {
      const auto byte = [&](const Framebuffer& of) {
        return static_cast<int>(display_byte(display_color(of.color[n], {})[channel]));
      };
      worst = std::max(worst, std::abs(byte(a) - byte(b)));
    }
    result.color += worst > 0;
    result.by_more += worst > 1;
    result.worst_color = std::max(result.worst_color, worst);
    result.atom += a.atom[n] != b.atom[n];
    result.depth += a.z[n] != b.z[n] && !(std::abs(a.z[n] - b.z[n]) < 1e-3f);
  }
  return result;
}

TEST(CpuPicture, IsThatOfGlButForRounding) {
  const EglContext context;
  const auto gl = make_gl_still_renderer(context), cpu = std::make_unique<StillRenderer>();
  for (const Picture& picture : pictures()) {
    const Framebuffer by_gl = picture.by(*gl), by_cpu = picture.by(*cpu);
    const Difference found = difference(by_gl, by_cpu);
    const auto pixels = static_cast<int>(by_gl.color.size());
    // A ray that touches a silhouette, or the border of two atoms, may be taken for one side or the other.
    EXPECT_LE(found.color, pixels / 500) << picture.name;
    EXPECT_LE(found.by_more, pixels / 5000) << picture.name;
    EXPECT_LE(found.worst_color, picture.settings.samples == 6 ? 43 : 130) << picture.name;  // one sample of a pixel
    EXPECT_LE(found.atom, pixels / 5000) << picture.name;
    EXPECT_LE(found.depth, pixels / 5000) << picture.name;
    RecordProperty(picture.name + " pixels", found.color);
    RecordProperty(picture.name + " worst", found.worst_color);
  }
}

void expect_same_bits(const Framebuffer& a, const Framebuffer& b, const std::string& name) {
  EXPECT_EQ(a.color, b.color) << name;
  EXPECT_EQ(a.z, b.z) << name;
  EXPECT_EQ(a.normal, b.normal) << name;
  EXPECT_EQ(a.position, b.position) << name;
  EXPECT_EQ(a.atom, b.atom) << name;
  EXPECT_EQ(a.kind, b.kind) << name;
  EXPECT_EQ(a.component, b.component) << name;
}

TEST(CpuPicture, IsTheSameWhateverTheVectorWidth) {
  // Where the machine has no longer vectors, the shorter ones are compared with themselves.
  const auto longest = std::make_unique<StillRenderer>();
  for (const int lanes : {4, 8}) {
    const auto other = std::make_unique<StillRenderer>(lanes);
    for (const Picture& picture : pictures())
      expect_same_bits(picture.by(*longest), picture.by(*other), picture.name + " " + std::to_string(lanes));
  }
}

TEST(CpuPicture, IsTheSameForAnyThreadsAndBlocks) {
  const auto renderer = std::make_unique<StillRenderer>();
  for (Picture& picture : pictures()) {
    const Framebuffer whole = picture.by(*renderer);
    {
      const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
      expect_same_bits(whole, picture.by(*renderer), picture.name + " on one thread");
    }
    picture.settings.block_edge = 48;
    expect_same_bits(whole, picture.by(*renderer), picture.name + " in blocks");
  }
}

TEST(CpuPicture, AdaptiveSamplesShowWhatAllSamplesShow) {
  const auto renderer = std::make_unique<StillRenderer>();
  for (Picture& picture : pictures()) {
    picture.settings.size = {480, 360};
    picture.settings.samples = 9;
    const Framebuffer all = picture.by(*renderer);
    picture.settings.adaptive = true;
    const Framebuffer some = picture.by(*renderer);
    const Difference found = difference(all, some);
    EXPECT_LE(found.by_more, 480 * 360 / 10'000) << picture.name;
    EXPECT_LE(found.worst_color, 94) << picture.name;  // One of nine samples differs at the edge of a clear picture.
    EXPECT_GT(found.color, 0) << picture.name << " leaves out no sample";
    EXPECT_EQ(found.atom + found.depth, 0) << picture.name;
    picture.settings.block_edge = 48;
    expect_same_bits(some, picture.by(*renderer), picture.name + " in blocks");
    const auto narrow = std::make_unique<StillRenderer>(4);
    expect_same_bits(some, picture.by(*narrow), picture.name + " by short vectors");
  }
}

TEST(CpuPicture, AdaptiveSamplesMissNothingThin) {
  // Sticks of a twentieth of a pixel lie between the centres of pixels, where first samples are even.
  const auto renderer = std::make_unique<StillRenderer>();
  Shapes shapes;
  for (int n = 0; n < 20; ++n)
    shapes.cylinders.push_back({{-50.0, 5.0 * n - 50.0, 0.0}, {50.0, 5.1 * n - 50.0, 0.0}, 0.01, 0, 0});
  Coloring coloring;
  coloring.atom = {glm::vec3(0.9f)};
  std::array<PictureObject, 1> objects;
  objects[0].shapes = &shapes;
  objects[0].coloring = &coloring;
  RenderSettings settings;
  settings.size = {250, 250};
  settings.samples = 9;
  const Camera camera{{0, 0, 200}, {0, 0, 0}, {0, 1, 0}, Projection::orthographic, 30.0, 110.0};
  const Framebuffer all = renderer->render(objects, camera, settings);
  settings.adaptive = true;
  expect_same_bits(all, renderer->render(objects, camera, settings), "thin sticks");
  EXPECT_TRUE(std::ranges::any_of(all.color, [](const glm::vec4& color) { return color.w > 0.0f; }));
}

/// Returns the light that shade leaves, in 8 bits, for squares of `edge` pixels that are wholly covered, else -1.
std::vector<int> shaded_grays(const Framebuffer& picture, int edge) {
  const glm::ivec2 size = picture.size / edge;
  std::vector<int> grays(static_cast<std::size_t>(size.x) * size.y, -1);
  for (int y = 0; y < size.y; ++y)
    for (int x = 0; x < size.x; ++x) {
      glm::vec4 sum(0.0f);
      for (int v = 0; v < edge * edge; ++v)
        sum += picture.color[static_cast<std::size_t>(y * edge + v / edge) * picture.size.x + x * edge + v % edge];
      sum /= static_cast<float>(edge * edge);
      if (sum.w > 0.9999f) grays[static_cast<std::size_t>(y) * size.x + x] = display_byte(display_color(sum, {}).x);
    }
  return grays;
}

TEST(CpuPicture, ShadeIsThatOfTheMoleculeAtAnyResolution) {
  const auto renderer = std::make_unique<StillRenderer>();
  Picture picture("1UBQ", testing::ubiquitin(), 1.4);
  picture.coloring.atom.assign(picture.coloring.atom.size(), glm::vec3(0.7f));
  picture.settings.aovs = false;
  picture.settings.look.ambient_occlusion = 1.0f;
  picture.settings.look.ambient_occlusion_radius = 15.0f;  // about 150 and 750 pixels
  picture.settings.samples = 9;
  picture.settings.size = {480, 360};
  const std::vector<int> small = shaded_grays(picture.by(*renderer), 1);
  picture.settings.samples = 1;
  picture.settings.size = {5 * 480, 5 * 360};  // more pixels than its map of depths has
  const std::vector<int> large = shaded_grays(picture.by(*renderer), 5);
  std::vector<int> differences;
  for (std::size_t n = 0; n < small.size(); ++n)
    if (small[n] >= 0 && large[n] >= 0) differences.push_back(std::abs(small[n] - large[n]));
  ASSERT_GT(differences.size(), 10'000u);
  std::ranges::sort(differences);
  EXPECT_LE(differences[differences.size() * 95 / 100], 2);
  EXPECT_LE(differences[differences.size() / 2], 1);
}

// A ball is far in front of a dark seam: at its rim some samples of a pixel see the one, some the other.
TEST(CpuPicture, ShadeThatSamplesShareIsThatOfWhatTheyMeet) {
  const auto renderer = std::make_unique<StillRenderer>();
  const Balls seam{{{-2.2, 0, 0}, 3.0}, {{2.2, 0, 0}, 3.0}}, ball{{{0, 0, 60}, 1.5}};
  Balls both = seam;
  both.push_back(ball.front());
  const auto drawn = [&](const Balls& balls) {
    Picture picture("balls", balls, 0.0);
    picture.coloring.atom.assign(balls.size(), glm::vec3(0.9f));
    picture.camera = {{0, 0, 100}, {0, 0, 0}, {0, 1, 0}, Projection::orthographic, 30.0, 7.0};
    picture.settings.aovs = false;
    picture.settings.samples = 9;
    picture.settings.look.ambient_occlusion = 1.0f;
    picture.settings.look.ambient_occlusion_radius = 6.0f;
    return picture.by(*renderer).color;
  };
  const std::vector<glm::vec4> behind = drawn(seam), before = drawn(ball), all = drawn(both);
  float largest = 0.0f;
  int rim = 0;
  for (std::size_t n = 0; n < all.size(); ++n) {
    if (before[n].w == 0.0f || before[n].w == 1.0f) continue;
    ++rim;
    largest = std::max(largest, std::abs(all[n].x - before[n].x - (1.0f - before[n].w) * behind[n].x));
  }
  EXPECT_GT(rim, 100);
  EXPECT_LT(largest, 0.02f);
}

TEST(CpuPicture, ShadeOfLargePicturesIsTheSameInBlocksAndByGl) {
  const EglContext context;
  const auto gl = make_gl_still_renderer(context), cpu = std::make_unique<StillRenderer>();
  Picture picture("a wide one", testing::ubiquitin(), 1.4);
  picture.settings.size = {2208, 96};
  picture.settings.samples = 2;
  picture.settings.look.ambient_occlusion = 1.0f;
  picture.settings.look.ambient_occlusion_radius = 20.0f;
  picture.camera = {{0, 0, 0}, {0, 0, 0}, {0, 1, 0}, Projection::orthographic, 30.0, 1.6};
  for (const Ball& ball : picture.surface.atoms) picture.camera.target += ball.center / 602.0;
  picture.camera.position = picture.camera.target + glm::dvec3(0, 0, 60);
  const Framebuffer whole = picture.by(*cpu), by_gl = picture.by(*gl);
  const Difference found = difference(by_gl, whole);
  const auto pixels = static_cast<int>(whole.color.size());
  EXPECT_LE(found.color, pixels / 500);
  EXPECT_LE(found.by_more, pixels / 5000);
  picture.settings.block_edge = 400;
  expect_same_bits(whole, picture.by(*cpu), "in blocks on the CPU");
  expect_same_bits(by_gl, picture.by(*gl), "in blocks by GL");
}

}  // namespace
}  // namespace meniscus
