// SPDX-License-Identifier: BSD-3-Clause
// Pictures through the C interface equal the library's, have a thread of their own, and are refused after fork().
#include <array>
#include <cmath>
#include <cstring>
#include <thread>
#include <vector>

#include <sys/wait.h>
#include <unistd.h>

#include "tests/c_api/c_objects.h"

namespace meniscus {
namespace {

using namespace test;

SceneOf scene_of(const char* size) { return scene_with({{"size", size}}); }

std::array<int, 4> pixel_at(const std::vector<std::uint8_t>& rgba, int width, int x, int y) {
  const auto* const p = &rgba[4 * (static_cast<std::size_t>(y) * width + x)];
  return {p[0], p[1], p[2], p[3]};
}

TEST(CApiPictures, AnOrthographicSphereIsAsLargeAsItIs) {
  const Computer made = computer();
  const SurfaceOf surface = computed(made.get(), testing::Balls{{{5.0, 5.0, 5.0}, 2.0}});
  const Renderer draws = renderer(MENISCUS_SOFTWARE);
  meniscus_camera camera{};
  camera.size = sizeof camera;
  ASSERT_EQ(meniscus_surface_camera(surface.get(), 1.0, MENISCUS_ORTHOGRAPHIC, &camera), MENISCUS_OK);
  camera.height = 8.0;  // The sphere is half as wide as the picture.
  const SceneOf scene = scene_with({{"size", "100x100"}, {"preset", "classic"}});
  const float green[3] = {0.0f, 1.0f, 0.0f};
  std::vector<std::uint8_t> rgba(40000);
  const auto draw = [&] {
    return meniscus_render(draws.get(), surface.get(), scene.get(), &camera, green, rgba.data(), rgba.size());
  };
  ASSERT_EQ(draw(), MENISCUS_OK) << meniscus_last_error();
  double covered = 0.0;
  for (std::size_t n = 3; n < rgba.size(); n += 4) covered += rgba[n] / 255.0;
  EXPECT_NEAR(covered, 3.14159 * 25 * 25, 20.0);
  const auto middle = pixel_at(rgba, 100, 50, 50), corner = pixel_at(rgba, 100, 0, 0);
  EXPECT_LT(middle[0], 30);  // The highlight is brighter.
  EXPECT_GT(middle[1], 100);
  EXPECT_EQ(middle[3], 255);
  EXPECT_EQ(corner[3], 0);

  ASSERT_EQ(meniscus_scene_set(scene.get(), "background", "#ff0000"), MENISCUS_OK);
  ASSERT_EQ(draw(), MENISCUS_OK);
  EXPECT_EQ(pixel_at(rgba, 100, 0, 0), (std::array<int, 4>{255, 0, 0, 255}));
}

TEST(CApiPictures, AreTheSameFromAnyThread) {
  const Computer made = computer();
  const SurfaceOf surface = computed(made.get(), testing::collinear(5, 1.5));
  const Renderer draws = renderer(MENISCUS_SOFTWARE);
  const SceneOf scene = scene_of("64x48");
  std::vector<std::vector<std::uint8_t>> drawn(4, std::vector<std::uint8_t>(64 * 48 * 4));
  std::vector<std::thread> threads;
  for (auto& rgba : drawn)
    threads.emplace_back([&] {
      EXPECT_EQ(meniscus_render(draws.get(), surface.get(), scene.get(), nullptr, nullptr, rgba.data(), rgba.size()),
                MENISCUS_OK)
          << meniscus_last_error();
    });
  for (std::thread& thread : threads) thread.join();
  for (const auto& rgba : drawn) EXPECT_EQ(rgba, drawn[0]);
  EXPECT_GT(pixel_at(drawn[0], 64, 32, 24)[3], 0);
}

TEST(CApiPictures, OfTheCpuAreThoseOfGlButForRounding) {
  const Computer made = computer();
  const SurfaceOf surface = computed(made.get(), testing::tetrahedron(3.5));
  const SceneOf scene = scene_with({{"size", "120x90"}, {"ambient_occlusion", "0.8"}, {"silhouettes", "2"}});
  std::vector<std::uint8_t> by_gl(120 * 90 * 4), by_cpu(by_gl.size());
  const auto draw = [&](meniscus_device device, std::vector<std::uint8_t>& rgba) {
    const Renderer draws = renderer(device);
    return meniscus_render(draws.get(), surface.get(), scene.get(), nullptr, nullptr, rgba.data(), rgba.size());
  };
  ASSERT_EQ(draw(MENISCUS_SOFTWARE, by_gl), MENISCUS_OK);
  ASSERT_EQ(draw(MENISCUS_CPU, by_cpu), MENISCUS_OK);
  std::size_t different = 0;
  for (std::size_t n = 0; n < by_gl.size(); ++n) different += std::abs(by_gl[n] - by_cpu[n]) > 1;
  EXPECT_LE(different, by_gl.size() / 1000);
  EXPECT_EQ(pixel_at(by_cpu, 120, 60, 45)[3], 255);
}

TEST(CApiPictures, RefuseWhatCannotBe) {
  const Computer made = computer();
  const SurfaceOf surface = computed(made.get(), testing::two_atoms(4.0));
  const Renderer draws = renderer(MENISCUS_SOFTWARE);
  std::vector<std::uint8_t> rgba(64 * 48 * 4);
  const auto draw = [&](const SceneOf& scene, const meniscus_camera* camera, const float* colors) {
    return meniscus_render(draws.get(), surface.get(), scene.get(), camera, colors, rgba.data(), rgba.size());
  };
  const auto said = [](const char* words) { return std::strstr(meniscus_last_error(), words) != nullptr; };
  const float colors[6] = {0.0f, 0.0f, 0.0f, 0.5f, std::nanf(""), 0.5f};
  meniscus_camera camera{};
  camera.size = sizeof camera;  // The camera is at its own target.
  EXPECT_EQ(draw(scene_of("65x48"), nullptr, nullptr), MENISCUS_USAGE);
  EXPECT_TRUE(said("65x48 pixels need")) << meniscus_last_error();
  EXPECT_EQ(draw(scene_of("64x48"), &camera, nullptr), MENISCUS_INPUT);
  EXPECT_EQ(draw(scene_of("64x48"), nullptr, colors), MENISCUS_INPUT);
  EXPECT_TRUE(said("channel 1 of the colour of atom 1")) << meniscus_last_error();
  for (const auto& [name, value] :
       {std::pair{"clip", "z<0"}, {"color", "chain"}, {"color", "element C=red"}, {"view", "top"}, {"panel", "A"}}) {
    EXPECT_EQ(draw(scene_with({{"size", "64x48"}, {name, value}}), nullptr, nullptr), MENISCUS_USAGE);
    EXPECT_TRUE(said(name)) << meniscus_last_error();
  }
  meniscus_renderer* none = nullptr;
  EXPECT_EQ(meniscus_renderer_new(meniscus_device{9}, &none), MENISCUS_USAGE);
}

// Drivers keep threads that a child does not have, so that it would wait for them.
TEST(CApiPictures, AreRefusedInAChildOfFork) {
  const Computer made = computer();
  const SurfaceOf surface = computed(made.get(), testing::two_atoms(4.0));
  Renderer draws = renderer(MENISCUS_SOFTWARE);
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    ::alarm(60);
    std::vector<std::uint8_t> rgba(64 * 48 * 4);
    const SceneOf scene = scene_of("64x48");
    meniscus_renderer* fresh = nullptr;
    bool right = meniscus_render(draws.get(), surface.get(), scene.get(), nullptr, nullptr, rgba.data(), rgba.size()) ==
                 MENISCUS_NO_GPU;
    right = right && std::strstr(meniscus_last_error(), "fork") != nullptr;
    right = right && meniscus_renderer_new(MENISCUS_SOFTWARE, &fresh) == MENISCUS_NO_GPU;
    draws.reset();
    ::_exit(right ? 0 : 1);
  }
  int status = -1;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << status;
}

TEST(CApiPictures, SurfacesComputedBySoftwareGlAreThoseOfTheCpu) {
  const testing::Balls balls = testing::collinear(6, 1.3);
  meniscus_options options = default_options();
  options.device = MENISCUS_SOFTWARE;
  const Computer gl = computer(options), cpu = computer();
  EXPECT_EQ(summary_of(computed(gl.get(), balls)).area, summary_of(computed(cpu.get(), balls)).area);
  options.device = MENISCUS_CPU;
  options.verify = 1;
  const Computer both = computer(options);
  const SurfaceOf surface = computed(both.get(), balls);
  EXPECT_NE(std::strstr(summary_of(surface).device, "verified on"), nullptr);
}

}  // namespace
}  // namespace meniscus
