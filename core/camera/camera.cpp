// SPDX-License-Identifier: BSD-3-Clause
// Camera files, picture axes and pixel rays.
#include "core/camera/camera.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <iterator>
#include <numbers>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include "core/base/error.h"
#include "core/base/json_depth.h"
#include "core/base/text.h"

namespace meniscus {
namespace {

using Json = nlohmann::ordered_json;

/// A value as it may stand in a message: short, and without control characters.
std::string shown(const Json& value) {
  constexpr std::size_t kLongest = 100;
  return shortened(value.dump(), kLongest);
}

/// Values of one camera file, with complaints that name the key.
class CameraReader {
 public:
  CameraReader(const Json& json, const std::string& file) : json_(json), file_(file) {}

  glm::dvec3 vector(const char* key) const {
    const Json& value = member(key);
    if (!value.is_array() || value.size() != 3) fail(key, "must be three numbers [x, y, z]");
    glm::dvec3 result;
    for (int i = 0; i < 3; ++i) {
      if (!value[i].is_number()) fail(key, "must be three numbers [x, y, z]");
      result[i] = value[i].get<double>();
    }
    return result;
  }

  double number(const char* key) const {
    if (!member(key).is_number()) fail(key, "must be a number");
    return member(key).get<double>();
  }

  Projection projection() const {
    if (member("projection") == "perspective") return Projection::perspective;
    if (member("projection") == "orthographic") return Projection::orthographic;
    fail("projection", "must be \"perspective\" or \"orthographic\"");
  }

  void expect_only(std::initializer_list<std::string_view> keys) const {
    for (const auto& [key, value] : json_.items())
      if (std::ranges::find(keys, key) == keys.end())
        throw InputError(file_, 0, fmt::format("camera: unknown key {}", shown(Json(key))));
  }

 private:
  const Json& member(const char* key) const {
    if (!json_.contains(key)) throw InputError(file_, 0, fmt::format("camera: \"{}\" is missing", key));
    return json_.at(key);
  }
  [[noreturn]] void fail(const char* key, const char* what) const {
    throw InputError(file_, 0, fmt::format("camera: \"{}\" is {}; it {}", key, shown(json_.at(key)), what));
  }

  const Json& json_;
  const std::string& file_;
};

bool is_finite(const glm::dvec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

Json to_json(const glm::dvec3& v) { return Json::array({v.x, v.y, v.z}); }

}  // namespace

Camera parse_camera(std::string_view text, const std::string& file) {
  if (is_nested_too_deep(text)) throw InputError(file, 0, "camera: is nested too deep to be one");
  Json json;
  try {
    json = Json::parse(text);
  } catch (const Json::parse_error& error) {
    const auto end = text.begin() + static_cast<std::ptrdiff_t>(std::min(error.byte, text.size()));
    const auto line = 1 + std::count(text.begin(), end, '\n');
    throw InputError(file, static_cast<std::size_t>(line), "camera: this is not JSON");
  } catch (const Json::exception&) {
    throw InputError(file, 0, "camera: a number is too large");
  }
  if (!json.is_object()) throw InputError(file, 0, "camera: expected one JSON object {...}");
  const CameraReader reader(json, file);
  Camera camera;
  camera.position = reader.vector("position");
  camera.target = reader.vector("target");
  camera.up = reader.vector("up");
  camera.projection = reader.projection();
  if (camera.projection == Projection::perspective) {
    camera.vertical_fov = reader.number("vertical_fov");
    reader.expect_only({"position", "target", "up", "projection", "vertical_fov"});
  } else {
    camera.height = reader.number("height");
    reader.expect_only({"position", "target", "up", "projection", "height"});
  }
  validate_camera(camera, file);
  return camera;
}

Camera read_camera(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw InputError(file, 0, "camera: the file cannot be opened");
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  if (stream.bad()) throw InputError(file, 0, "camera: the file cannot be read");
  return parse_camera(text, file);
}

nlohmann::ordered_json camera_object(const Camera& camera) {
  Json json;
  json["position"] = to_json(camera.position);
  json["target"] = to_json(camera.target);
  json["up"] = to_json(camera.up);
  if (camera.projection == Projection::perspective) {
    json["projection"] = "perspective";
    json["vertical_fov"] = camera.vertical_fov;
  } else {
    json["projection"] = "orthographic";
    json["height"] = camera.height;
  }
  return json;
}

std::string camera_json(const Camera& camera) { return camera_object(camera).dump(2) + "\n"; }

void validate_camera(const Camera& camera, const std::string& file) {
  const auto fail = [&](const std::string& what) { throw InputError(file, 0, "camera: " + what); };
  if (!is_finite(camera.position) || !is_finite(camera.target) || !is_finite(camera.up)) fail("a number is not finite");
  const glm::dvec3 view = camera.target - camera.position;
  const double scale = std::max(glm::length(camera.position), glm::length(camera.target));
  // Squares of smaller and larger numbers have no place in double precision.
  constexpr double kSmallest = 1e-100, kLargest = 1e100;
  if (!(scale <= kLargest)) fail(fmt::format("position and target must lie within {:g} Å of the origin", kLargest));
  if (glm::length(view) <= 1e-12 * scale || glm::length(view) < kSmallest)
    fail("position and target are the same point, so there is no view direction");
  const double up_length = glm::length(camera.up);
  if (!(up_length >= kSmallest && up_length <= kLargest)) fail("\"up\" has no direction");
  // The sine of their angle; below this the picture would turn with rounding errors.
  if (glm::length(glm::cross(view / glm::length(view), camera.up / up_length)) < 1e-9)
    fail("\"up\" is parallel to the view direction");
  if (camera.projection == Projection::perspective) {
    if (!(camera.vertical_fov > 0.0 && camera.vertical_fov < 180.0))
      fail(fmt::format("\"vertical_fov\" is {} degrees; it must lie between 0 and 180", camera.vertical_fov));
  } else if (!(camera.height >= kSmallest && camera.height <= kLargest)) {
    fail(fmt::format("\"height\" is {} Å; it must be positive", camera.height));
  }
}

ViewBasis view_basis(const Camera& camera) {
  const glm::dvec3 forward = glm::normalize(camera.target - camera.position);
  const glm::dvec3 right = glm::normalize(glm::cross(forward, camera.up / glm::length(camera.up)));
  return {right, glm::cross(right, forward), forward};
}

glm::dvec2 half_extent(const Camera& camera, double aspect) {
  const double half_height = camera.projection == Projection::perspective
                                 ? std::tan(camera.vertical_fov * (std::numbers::pi / 360.0))
                                 : 0.5 * camera.height;
  return {half_height * aspect, half_height};
}

Ray pixel_ray(const Camera& camera, glm::dvec2 size, glm::dvec2 pixel) {
  const ViewBasis basis = view_basis(camera);
  const glm::dvec2 half = half_extent(camera, size.x / size.y);
  const glm::dvec3 offset =
      basis.right * (half.x * (2.0 * pixel.x / size.x - 1.0)) + basis.up * (half.y * (1.0 - 2.0 * pixel.y / size.y));
  if (camera.projection == Projection::orthographic) return {camera.position + offset, basis.forward};
  return {camera.position, glm::normalize(basis.forward + offset)};
}

}  // namespace meniscus
