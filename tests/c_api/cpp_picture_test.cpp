// SPDX-License-Identifier: BSD-3-Clause
// Pictures through the C++ header: as large as the sphere is, and refused where there is no room.
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include <meniscus/meniscus.hpp>

namespace {

TEST(CppApiPictures, AnOrthographicSphereIsAsLargeAsItIs) {
  const std::vector<meniscus::Ball> balls = {{{1.0, 2.0, 3.0}, 2.0}};
  const meniscus::Surface surface = meniscus::Computer().compute({balls});
  const meniscus::Renderer renderer(MENISCUS_SOFTWARE);
  meniscus::Camera camera = surface.camera(1.0, MENISCUS_ORTHOGRAPHIC);
  camera.height = 8.0;  // so the sphere is half as wide as the picture
  meniscus::Picture picture;
  picture.camera = &camera;
  picture.width = picture.height = 64;
  const std::vector<std::uint8_t> rgba = renderer.render(surface, picture);
  ASSERT_EQ(rgba.size(), 4U * 64 * 64);
  double covered = 0.0;
  for (std::size_t n = 3; n < rgba.size(); n += 4) covered += rgba[n] / 255.0;
  EXPECT_NEAR(covered, std::numbers::pi * 16 * 16, 12.0);
  std::vector<std::uint8_t> small(100);
  EXPECT_THROW(renderer.render(surface, picture, small), meniscus::UsageError);
  picture.width = -1;
  EXPECT_THROW(renderer.render(surface, picture), meniscus::UsageError);
}

}  // namespace
