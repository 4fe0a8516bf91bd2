// SPDX-License-Identifier: BSD-3-Clause
// Pictures that stay on the GPU equal those of the complete surface.
#include "core/render/gl_renderer.h"

#include <algorithm>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "core/gpu/egl_context.h"
#include "core/surface/compute_surface.h"
#include "core/visible_surface/view_pipeline.h"
#include "tests/support/molecules.h"
#include "core/color/coloring.h"

namespace meniscus {
namespace {

TEST(Renderer, PicksWhatItDraws) {
  const EglContext context;
  ViewPipeline atoms;
  atoms.set_atoms({{{0, 0, 0}, 1.7}, {{3, 0, 0}, 1.5}});
  Coloring coloring;
  coloring.atom = {{1, 0, 0}, {0, 0, 1}};
  atoms.set_coloring(coloring);
  Camera camera;
  camera.position = {0, 0, 20};
  camera.projection = Projection::orthographic;
  camera.height = 8;
  RenderSettings settings;
  settings.size = {64, 64};
  settings.look.background = {0, 1, 0};
  GlRenderer renderer;
  renderer.draw(atoms, camera, settings);

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

TEST(Renderer, PicksTheAtomOfEveryPixelOfThePicture) {
  const EglContext context;
  const std::vector<Ball> balls{{{0, 0, 0}, 1.7}, {{3, 0.4, 0}, 1.5}, {{1.2, 2.6, -1}, 1.2}, {{-2, 2, 1}, 1.6}};
  Coloring coloring;
  coloring.atom.assign(balls.size(), glm::vec3(0.5f));
  ViewPipeline atoms;
  atoms.set_atoms(balls);
  atoms.set_coloring(coloring);
  GlRenderer renderer, other;
  // The molecule overflows wide and high pictures, so that all four borders show some of it.
  for (const glm::ivec2 size : {glm::ivec2{61, 34}, glm::ivec2{27, 50}}) {
    Camera camera;
    camera.position = {0.7, 1, 20};
    camera.target = {0.7, 1, 0};
    camera.projection = Projection::orthographic;
    camera.height = size.x > size.y ? 3.0 : 5.0;
    RenderSettings settings;
    settings.size = size;
    renderer.draw(atoms, camera, settings);
    settings.aovs = true;
    const Framebuffer picture = other.render(compute_surface_cpu(balls, 1.4), coloring, camera, settings);
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
