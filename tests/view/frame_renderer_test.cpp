// SPDX-License-Identifier: BSD-3-Clause
// Frames of the preview against pictures of the complete surface.
#include "core/visible_surface/frame_renderer.h"

#include <algorithm>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "core/gpu/egl_context.h"
#include "core/render/ray_caster.h"
#include "core/surface/surface.h"
#include "tests/support/molecules.h"

namespace meniscus {
namespace {

TEST(FrameRenderer, PicksWhatItDraws) {
  const EglContext context({DeviceChoice::Kind::software, 0});
  FrameRenderer renderer;
  renderer.set_atoms({{{0, 0, 0}, 1.7}, {{3, 0, 0}, 1.5}});
  Coloring coloring;
  coloring.atom = {{1, 0, 0}, {0, 0, 1}};
  renderer.set_coloring(coloring);
  FrameRequest request;
  request.camera.position = {0, 0, 20};
  request.camera.projection = Projection::orthographic;
  request.camera.height = 8;
  request.size = {64, 64};
  request.look.background = {0, 1, 0};
  renderer.render(request);

  const std::vector<std::uint8_t> rgba = renderer.rgba();
  ASSERT_EQ(rgba.size(), 64u * 64u * 4u);
  EXPECT_EQ(rgba[0], 0);
  EXPECT_EQ(rgba[1], 255);
  EXPECT_FALSE(renderer.pick({0, 0}));
  const auto red = renderer.pick({32, 32}), blue = renderer.pick({32 + 24, 32});
  ASSERT_TRUE(red);
  ASSERT_TRUE(blue);
  EXPECT_EQ(red->atom, 0u);
  EXPECT_EQ(red->kind, PatchKind::convex);
  EXPECT_NEAR(glm::length(red->position), 1.7, 1e-5);
  EXPECT_EQ(blue->atom, 1u);
  EXPECT_EQ(renderer.pick({32 + 13, 32 - 8})->kind, PatchKind::toroidal);
  EXPECT_FALSE(renderer.pick({64, 0}));
}

TEST(FrameRenderer, PicksTheAtomOfEveryPixelOfThePicture) {
  const EglContext context({DeviceChoice::Kind::software, 0});
  const std::vector<Ball> balls{{{0, 0, 0}, 1.7}, {{3, 0.4, 0}, 1.5}, {{1.2, 2.6, -1}, 1.2}, {{-2, 2, 1}, 1.6}};
  Coloring coloring;
  coloring.atom.assign(balls.size(), glm::vec3(0.5f));
  FrameRenderer renderer;
  renderer.set_atoms(balls);
  renderer.set_coloring(coloring);
  RayCaster caster;
  // Wide and high pictures that the molecule overflows, so that all four borders show some of it.
  for (const glm::ivec2 size : {glm::ivec2{61, 34}, glm::ivec2{27, 50}}) {
    FrameRequest request;
    request.camera.position = {0.7, 1, 20};
    request.camera.target = {0.7, 1, 0};
    request.camera.projection = Projection::orthographic;
    request.camera.height = size.x > size.y ? 3.0 : 5.0;
    request.size = size;
    renderer.render(request);
    RenderSettings settings;
    settings.size = size;
    settings.samples = 1;
    settings.aovs = true;
    const Framebuffer picture = caster.render(compute_surface_cpu(balls, 1.4), coloring, request.camera, settings);
    std::size_t at = 0, border = 0;
    for (int y = 0; y < size.y; ++y) {
      for (int x = 0; x < size.x; ++x, ++at) {
        const auto picked = renderer.pick({x, y});
        ASSERT_EQ(picked ? picked->atom : kNone, picture.atom[at]) << x << ", " << y;
        if (!picked) continue;
        EXPECT_LT(glm::distance(picked->position, glm::dvec3(picture.position[at])), 1e-4) << x << ", " << y;
        border |= (x == 0 ? 1u : 0u) | (x == size.x - 1 ? 2u : 0u) | (y == 0 ? 4u : 0u) | (y == size.y - 1 ? 8u : 0u);
      }
    }
    EXPECT_EQ(border, 15u);
    EXPECT_TRUE(std::ranges::find(picture.atom, kNone) != picture.atom.end());
  }
}

}  // namespace
}  // namespace meniscus
