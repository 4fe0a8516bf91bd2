// SPDX-License-Identifier: BSD-3-Clause
// Camera files, pixel rays and default framing.
#include "core/camera/camera.h"
#include "core/camera/camera_json.h"
#include "core/surface/primitives.h"

#include <cmath>
#include <random>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "core/base/error.h"

namespace meniscus {
namespace {

const char* const kPerspective =
    R"({"position":[1,2,30.1],"target":[1,2,3],"up":[0,1,0.5],"projection":"perspective","vertical_fov":40})";
const char* const kOrthographic =
    R"({"position":[0,0,10],"target":[0,0,0],"up":[0,2,0],"projection":"orthographic","height":8})";

std::string error_of(const std::string& json) {
  try {
    parse_camera(json, "c.json");
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST(CameraFile, SurvivesWritingAndReading) {
  for (const char* json : {kPerspective, kOrthographic}) {
    const Camera camera = parse_camera(json, "c.json");
    const Camera again = parse_camera(camera_json(camera), "again.json");
    EXPECT_EQ(again.position, camera.position);
    EXPECT_EQ(again.target, camera.target);
    EXPECT_EQ(again.up, camera.up);
    EXPECT_EQ(again.projection, camera.projection);
    EXPECT_EQ(again.vertical_fov, camera.vertical_fov);
    EXPECT_EQ(again.height, camera.height);
  }
  EXPECT_EQ(parse_camera(kPerspective, "c").position.z, 30.1);
  EXPECT_EQ(parse_camera(kOrthographic, "c").height, 8.0);
}

TEST(CameraFile, SaysWhatIsWrong) {
  EXPECT_EQ(error_of("{\n\"position\": [1,\n}"), "c.json:3: camera: this is not JSON");
  EXPECT_EQ(error_of("[]"), "c.json: camera: expected one JSON object {...}");
  EXPECT_EQ(error_of("{}"), "c.json: camera: \"position\" is missing");
  EXPECT_EQ(error_of(replaced(kPerspective, "[1,2,3]", "[1,2,30.1]")),
            "c.json: camera: position and target are the same point, so there is no view direction");
  EXPECT_EQ(error_of(replaced(kPerspective, "[0,1,0.5]", "[0,0,-5]")),
            "c.json: camera: \"up\" is parallel to the view direction");
  EXPECT_EQ(error_of(replaced(kPerspective, "[0,1,0.5]", "[0,0,0]")), "c.json: camera: \"up\" has no direction");
  EXPECT_EQ(error_of(replaced(kPerspective, "[0,1,0.5]", "[0,1]")),
            "c.json: camera: \"up\" is [0,1]; it must be three numbers [x, y, z]");
  EXPECT_EQ(error_of(replaced(kPerspective, "40", "180")),
            "c.json: camera: \"vertical_fov\" is 180 degrees; it must lie between 0 and 180");
  EXPECT_EQ(error_of(replaced(kPerspective, "40", "0")),
            "c.json: camera: \"vertical_fov\" is 0 degrees; it must lie between 0 and 180");
  EXPECT_EQ(error_of(replaced(kPerspective, "40", "\"wide\"")),
            "c.json: camera: \"vertical_fov\" is \"wide\"; it must be a number");
  EXPECT_EQ(error_of(replaced(kPerspective, "perspective\"", "fisheye\"")),
            "c.json: camera: \"projection\" is \"fisheye\"; it must be \"perspective\" or \"orthographic\"");
  EXPECT_EQ(error_of(replaced(kPerspective, "vertical_fov", "fov")), "c.json: camera: \"vertical_fov\" is missing");
  EXPECT_EQ(error_of(replaced(kOrthographic, "8}", "8,\"vertical_fov\":3}")),
            "c.json: camera: unknown key \"vertical_fov\"");
  EXPECT_EQ(error_of(replaced(kOrthographic, ":8}", ":-8}")),
            "c.json: camera: \"height\" is -8 Å; it must be positive");
  EXPECT_EQ(error_of(replaced(kOrthographic, ":8}", ":1e999}")), "c.json: camera: a number is too large");
  EXPECT_THROW(read_any_camera("/nonexistent/camera.json", 1.0), InputError);
}

TEST(Camera, RaysPassThroughPixelCentres) {
  const Camera orthographic = parse_camera(kOrthographic, "c");
  const Ray corner = pixel_ray(orthographic, {16, 8}, {0.5, 0.5});
  EXPECT_EQ(corner.origin, glm::dvec3(-7.5, 3.5, 10.0));
  EXPECT_EQ(corner.direction, glm::dvec3(0, 0, -1));
  Camera perspective = orthographic;
  perspective.projection = Projection::perspective;
  perspective.vertical_fov = 90.0;
  const Ray lower_right = pixel_ray(perspective, {2, 2}, {1.5, 1.5});
  EXPECT_EQ(lower_right.origin, glm::dvec3(0, 0, 10));
  EXPECT_LT(glm::length(lower_right.direction - glm::normalize(glm::dvec3(0.5, -0.5, -1))), 1e-15);
}

TEST(Camera, BasisIsRightHandedAndOrthonormal) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 100; ++i) {
    Camera camera;
    camera.position = {normal(random), normal(random), normal(random)};
    camera.target = {normal(random), normal(random), normal(random)};
    camera.up = {normal(random), normal(random), normal(random)};
    const ViewBasis basis = view_basis(camera);
    EXPECT_LT(glm::length(glm::cross(basis.right, basis.up) + basis.forward), 1e-14);
    EXPECT_NEAR(glm::length(basis.right), 1.0, 1e-14);
    EXPECT_GT(glm::dot(basis.up, camera.up), 0.0);
  }
}

/// Returns the least distance of any ball's rim from the planes through the picture's edges, in Å; negative: cut off.
double clearance(const Surface& surface, const Camera& camera, double aspect) {
  const ViewBasis basis = view_basis(camera);
  const glm::dvec2 half = half_extent(camera, aspect);
  double lowest = 1e300;
  for (const Ball& ball : surface.atoms) {
    const glm::dvec3 v = ball.center - camera.position;
    for (const auto& [axis, extent] : {std::pair{basis.right, half.x}, {basis.up, half.y}})
      for (const double sign : {-1.0, 1.0}) {
        const bool perspective = camera.projection == Projection::perspective;
        const double distance = perspective ? (glm::dot(v, basis.forward) * extent + sign * glm::dot(v, axis)) /
                                                  std::sqrt(1.0 + extent * extent)
                                            : extent + sign * glm::dot(v, axis);
        lowest = std::min(lowest, distance - ball.radius);
      }
    EXPECT_GT(glm::dot(v, basis.forward), ball.radius);
  }
  return lowest;
}

TEST(Camera, DefaultFramingShowsEverythingAndLittleElse) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (const std::size_t count : {1u, 2u, 3u, 200u})
    for (const double aspect : {0.4, 1.0, 1.7})
      for (const Projection projection : {Projection::perspective, Projection::orthographic}) {
        Surface surface;
        for (std::size_t i = 0; i < count; ++i)
          surface.atoms.push_back({{100 + 20 * uniform(random), 30 * uniform(random), 8 * uniform(random)}, 1.7});
        const Camera camera = frame_camera(surface.atoms, aspect, projection);
        EXPECT_NO_THROW(validate_camera(camera, "default"));
        EXPECT_GT(clearance(surface, camera, aspect), 0.0);
        Camera closer = camera;  // less than one margin closer, something is cut off
        if (projection == Projection::perspective) closer.vertical_fov *= 0.9;
        closer.height *= 0.9;
        EXPECT_LT(clearance(surface, closer, aspect), 0.0);
      }
}

}  // namespace
}  // namespace meniscus
