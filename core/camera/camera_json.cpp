// SPDX-License-Identifier: BSD-3-Clause
// Reads and writes cameras and their paths as JSON; errors name the key.
#include "core/camera/camera_json.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <initializer_list>
#include <iterator>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/base/error.h"
#include "core/base/system_file.h"
#include "core/base/text_file.h"
#include "core/base/text.h"

namespace meniscus {
namespace {

constexpr double kLargestFrame = 1e9;

using Json = nlohmann::ordered_json;

/// Formats a value for messages: short, and without control characters.
std::string shown(const Json& value) {
  constexpr std::size_t kLongest = 100;
  return shortened(value.dump(), kLongest);
}

/// Reads the values of one camera file, with errors that name the key.
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

Json to_json(const glm::dvec3& v) { return Json::array({v.x, v.y, v.z}); }

}  // namespace

Camera parse_camera(std::string_view text, const std::string& file) {
  if (is_nested_too_deep(text)) throw InputError(file, 0, "camera: the JSON is nested too deep");
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

CameraPath parse_camera_path(std::string_view text, const std::string& file) {
  const auto fail = [&](const std::string& what) { throw InputError(file, 0, "camera path: " + what); };
  if (is_nested_too_deep(text)) fail("the JSON is nested too deep");
  const nlohmann::json json = nlohmann::json::parse(text, nullptr, false);
  if (!json.is_object() || !json.contains("keys") || !json["keys"].is_array() || json["keys"].empty())
    fail(R"(must be {"keys":[{"frame":0,"camera":{...}},...]})");
  std::vector<CameraKey> keys;
  for (const nlohmann::json& entry : json["keys"]) {
    const std::string where = fmt::format("key {}", keys.size() + 1);
    if (!entry.is_object() || !entry.contains("frame") || !entry["frame"].is_number() || !entry.contains("camera"))
      fail(where + " must have a \"frame\", a number, and a \"camera\"");
    const double frame = entry["frame"].get<double>();
    if (!(std::abs(frame) <= kLargestFrame)) fail(where + fmt::format(": the frame is beyond {:.0f}", kLargestFrame));
    keys.push_back({frame, parse_camera(entry["camera"].dump(), fmt::format("{}: {}", file, where))});
    if (keys.size() == 1) continue;
    if (!(keys[keys.size() - 2].frame < frame)) fail(where + ": frame numbers must increase from key to key");
    if (keys.front().camera.projection != keys.back().camera.projection)
      fail(where + ": all keys must have the same projection");
  }
  return CameraPath(std::move(keys));
}

CameraPath read_camera_path(const std::string& file) {
  std::ifstream stream(path_of_text(file), std::ios::binary);
  if (!stream) throw InputError(file, 0, "camera path: cannot be read");
  return parse_camera_path(std::string(std::istreambuf_iterator<char>(stream), {}), file);
}

nlohmann::ordered_json camera_path_object(const std::vector<CameraKey>& keys) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const CameraKey& key : keys) list.push_back({{"frame", key.frame}, {"camera", camera_object(key.camera)}});
  return nlohmann::ordered_json{{"keys", list}};
}

std::string camera_path_json(const std::vector<CameraKey>& keys) { return camera_path_object(keys).dump(2) + "\n"; }

}  // namespace meniscus
