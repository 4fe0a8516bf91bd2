// SPDX-License-Identifier: BSD-3-Clause
// Pictures through the C++ header have the sphere's size, and are refused where there is no room.
#include <numbers>
#include <optional>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include <meniscus/meniscus.hpp>

namespace {

TEST(CppApiPictures, AnOrthographicSphereIsAsLargeAsItIs) {
  const std::vector<meniscus::Ball> balls = {{{1.0, 2.0, 3.0}, 2.0}};
  const meniscus::Surface surface = meniscus::Computer().compute({balls});
  const meniscus::Renderer renderer(MENISCUS_SOFTWARE);
  meniscus::Camera camera = surface.camera(1.0, MENISCUS_ORTHOGRAPHIC);
  camera.height = 8.0;  // The sphere is half as wide as the picture.
  meniscus::Scene scene;
  scene.set("size", "64x64").set("silhouettes", "0");
  const meniscus::Picture picture = renderer.render(surface, scene, &camera);
  ASSERT_EQ(picture.rgba.size(), 4U * 64 * 64);
  double covered = 0.0;
  for (std::size_t n = 3; n < picture.rgba.size(); n += 4) covered += picture.rgba[n] / 255.0;
  EXPECT_NEAR(covered, std::numbers::pi * 16 * 16, 12.0);
  EXPECT_THROW(renderer.render(surface, scene, &camera, std::vector<float>(4)), meniscus::UsageError);
  EXPECT_THROW(scene.set("size", "-1x64"), meniscus::UsageError);
}

TEST(CppApiPictures, ScenesHoldWhatTheyAreGiven) {
  meniscus::Scene scene;
  EXPECT_EQ(scene.get("depth_cue"), std::nullopt);
  EXPECT_EQ(scene.set("depth_cue", "0.5").get("look.depth_cue"), "0.5");
  scene.set("label", "resid 1=one").set("label", "resid 2=two");
  EXPECT_EQ(meniscus::Scene::parse(scene.json()).get("label", 1), "resid 2=two");
  EXPECT_EQ(scene.reset("label").get("label"), std::nullopt);
  EXPECT_THROW(scene.render(MENISCUS_CPU), meniscus::UsageError);  // The scene has no molecule.
  EXPECT_THROW(meniscus::Scene::parse("{"), meniscus::InputError);
  EXPECT_GT(meniscus::Scene::properties().size(), 90U);
}

TEST(CppApiPictures, PagesAreTexts) {
  const std::vector<meniscus::Ball> balls = {{{1.0, 2.0, 3.0}, 2.0}, {{1.0, 2.0, 6.0}, 2.0}};
  const meniscus::Surface surface = meniscus::Computer().compute({balls});
  meniscus::Scene look;
  look.set("size", "32x24").set("color", "red");
  const meniscus::Page page(surface, nullptr, look);
  EXPECT_TRUE(page.html().starts_with("<!DOCTYPE html>"));
  EXPECT_TRUE(page.html().ends_with("</html>\n"));
  EXPECT_NE(page.html().find("Surface of 2 atoms"), std::string_view::npos);
  const std::vector<float> colors = {1, 0, 0, 0, 0, 1};
  EXPECT_NE(meniscus::Page(surface, nullptr, look, nullptr, colors).html(), page.html());
  EXPECT_THROW(meniscus::Page(surface, nullptr, look, nullptr, std::vector<float>(4)), meniscus::UsageError);
  EXPECT_THROW(meniscus::Page{meniscus::Scene()}, meniscus::UsageError);  // The scene has no molecule.
}

}  // namespace
