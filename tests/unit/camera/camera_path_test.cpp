// SPDX-License-Identifier: BSD-3-Clause
// Cameras that move: through their keys, smoothly, around, along; and frames that show every moment of a run.
#include "core/camera/camera.h"
#include "core/camera/camera_json.h"

#include <cmath>
#include <numbers>
#include <random>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/math/ball.h"

namespace meniscus {
namespace {

Camera camera(glm::dvec3 position, glm::dvec3 target, glm::dvec3 up, double fov) {
  Camera c;
  c.position = position;
  c.target = target;
  c.up = up;
  c.vertical_fov = fov;
  return c;
}

std::vector<CameraKey> four_keys() {
  return {{0.0, camera({0, 0, 50}, {0, 0, 0}, {0, 1, 0}, 30)},
          {10.0, camera({40, 5, 20}, {2, 0, 1}, {0.1, 1, 0}, 40)},
          {40.0, camera({10, -30, -60}, {3, 3, 3}, {0, 0, 1}, 25)},
          {45.0, camera({-20, -30, -40}, {0, 4, 3}, {0, 1, 1}, 25)}};
}

void expect_same_view(const Camera& a, const Camera& b, double tolerance) {
  EXPECT_LT(glm::distance(a.position, b.position), tolerance);
  EXPECT_LT(glm::distance(a.target, b.target), tolerance);
  EXPECT_LT(glm::distance(view_basis(a).up, view_basis(b).up), tolerance);
  EXPECT_NEAR(a.vertical_fov, b.vertical_fov, tolerance);
}

TEST(CameraPath, GoesThroughItsKeysAndStaysAtItsEnds) {
  const CameraPath path(four_keys());
  for (const CameraKey& key : four_keys()) expect_same_view(path.at(key.frame), key.camera, 1e-12);
  expect_same_view(path.at(-5.0), four_keys().front().camera, 1e-12);
  expect_same_view(path.at(1e9), four_keys().back().camera, 1e-12);
  for (const double frame : {10.0, 40.0})  // Both sides are tried.
    for (const double step : {-1e-7, 1e-7}) expect_same_view(path.at(frame + step), path.at(frame), 1e-4);
}

TEST(CameraPath, HasNoKinks) {
  const CameraPath path(four_keys());
  constexpr double h = 1e-4;
  for (const double frame : {10.0, 40.0}) {
    const auto speed = [&](double from, double to) {
      return (path.at(to).position - path.at(from).position) / (to - from);
    };
    EXPECT_LT(glm::distance(speed(frame - h, frame), speed(frame, frame + h)), 0.02) << frame;
  }
}

TEST(CameraPath, ZoomKeepsItsPace) {
  // The distance doubles every ten frames: a steady zoom has a constant ratio, not a constant speed.
  std::vector<CameraKey> keys;
  for (int n = 0; n < 4; ++n)
    keys.push_back({10.0 * n, camera({0, 0, 10.0 * std::pow(2.0, n)}, {0, 0, 0}, {0, 1, 0}, 30)});
  const CameraPath path(keys);
  for (double frame = 0.0; frame <= 30.0; frame += 1.7)
    EXPECT_NEAR(glm::length(path.at(frame).position), 10.0 * std::pow(2.0, frame / 10.0), 1e-9);
}

TEST(CameraPath, TurningKeepsItsPace) {
  // The camera makes a twelfth of a turn every ten frames: the angle grows with the frame, between the keys too.
  const Camera start = camera({0, 0, 50}, {0, 0, 0}, {0, 1, 0}, 30);
  std::vector<CameraKey> keys;
  for (int n = 0; n < 5; ++n)
    keys.push_back({10.0 * n, turned(start, glm::dvec3(0.0), {0, 1, 0}, n * std::numbers::pi / 6.0)});
  const CameraPath path(keys);
  for (double frame = 0.0; frame <= 40.0; frame += 0.7) {
    const glm::dvec3 eye = path.at(frame).position;
    EXPECT_NEAR(std::atan2(eye.x, eye.z), frame * std::numbers::pi / 60.0, 1e-9) << frame;
  }
}

TEST(CameraPath, TurnsCarryEverything) {
  const Camera start = camera({10, 3, 50}, {1, 2, 3}, {0, 1, 0}, 30);
  const glm::dvec3 pivot(1, 0, 2), axis(0, 1, 0);
  expect_same_view(turned(start, pivot, axis, 2.0 * std::numbers::pi), start, 1e-12);
  const Camera half = turned(start, pivot, axis, std::numbers::pi);
  EXPECT_LT(glm::distance(half.position, glm::dvec3(-8, 3, -46)), 1e-12);
  EXPECT_NEAR(glm::distance(half.position, half.target), glm::distance(start.position, start.target), 1e-12);
  expect_same_view(turned(turned(start, pivot, axis, 0.3), pivot, axis, -0.3), start, 1e-12);
  EXPECT_EQ(shifted(start, {1, 1, 1}).target, glm::dvec3(2, 3, 4));
}

TEST(CameraPath, FilesAndTheirFaults) {
  const std::string good = camera_json(camera({0, 0, 5}, {0, 0, 0}, {0, 1, 0}, 30));
  const auto complaint = [](const std::string& json) -> std::string {
    try {
      parse_camera_path(json, "path.json");
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(complaint(R"({"keys":[{"frame":0,"camera":)" + good + R"(},{"frame":2.5,"camera":)" + good + "}]}"), "");
  EXPECT_NE(complaint("nonsense").find("path.json: camera path: must be"), std::string::npos);
  EXPECT_NE(complaint(R"({"keys":[]})").find("must be"), std::string::npos);
  EXPECT_NE(complaint(R"({"keys":[{"frame":"a"}]})").find("key 1 must have"), std::string::npos);
  EXPECT_NE(complaint(R"({"keys":[{"frame":1,"camera":{}}]})").find("path.json: key 1: camera: \"position\""),
            std::string::npos);
  EXPECT_NE(complaint(R"({"keys":[{"frame":1,"camera":)" + good + R"(},{"frame":1,"camera":)" + good + "}]}")
                .find("key 2: frame numbers must increase"),
            std::string::npos);
}

TEST(DecisiveBalls, FrameAllThatWasAdded) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> at(-30.0, 30.0), radius(0.5, 3.0);
  for (int round = 0; round < 50; ++round) {
    std::vector<Ball> all;
    for (int n = 0; n < 500; ++n) all.push_back({{at(random), 0.5 * at(random), at(random)}, radius(random)});
    Camera lens;
    lens.projection = round % 2 ? Projection::perspective : Projection::orthographic;
    const ViewBasis basis = broad_side(all);
    DecisiveBalls decisive(basis, 1.5, lens);
    for (std::size_t n = 0; n < all.size(); n += 100) decisive.add(std::span(all).subspan(n, 100));
    const Camera few = decisive.frame(), many = frame_camera(all, basis, 1.5, lens);
    EXPECT_LT(glm::distance(few.position, many.position), 1e-9);
    EXPECT_LT(glm::distance(few.target, many.target), 1e-9);
    EXPECT_NEAR(few.height, many.height, 1e-9);
  }
}

}  // namespace
}  // namespace meniscus
