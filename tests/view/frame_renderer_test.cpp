// SPDX-License-Identifier: BSD-3-Clause
// Frames of the preview against pictures of the complete surface.
#include "core/view/frame_renderer.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "core/gpu/egl_context.h"
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

}  // namespace
}  // namespace meniscus
