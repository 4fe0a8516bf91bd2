// SPDX-License-Identifier: BSD-3-Clause
// Reads and writes cameras as JSON, and reads the cameras of PyMOL and ChimeraX.
#include "core/camera/camera_json.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fstream>
#include <initializer_list>
#include <iterator>
#include <numbers>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <nlohmann/json.hpp>

#include "core/base/error.h"
#include "core/base/system_file.h"
#include "core/base/text.h"
#include "core/base/text_file.h"
#include "core/math/rigid_motion.h"

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
        throw InputError(file_, 0, "camera: unknown key {}", shown(Json(key)));
  }

 private:
  const Json& member(const char* key) const {
    if (!json_.contains(key)) throw InputError(file_, 0, "camera: \"{}\" is missing", key);
    return json_.at(key);
  }
  [[noreturn]] void fail(const char* key, const char* what) const {
    throw InputError(file_, 0, "camera: \"{}\" is {}; it {}", key, shown(json_.at(key)), what);
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

namespace {

constexpr std::size_t kViewNumbers = 18, kMatrixNumbers = 12;

/// Splits the text at blanks and commas, and at the brackets and backslashes of PyMOL's notation. Comments (#) end at
/// their line.
std::vector<std::string_view> words_of(std::string_view text, bool with_comments) {
  std::vector<std::string_view> words;
  const auto parts = [](char c) {
    return std::isspace(static_cast<unsigned char>(c)) != 0 || c == ',' || c == '(' || c == ')' || c == '[' ||
           c == ']' || c == '\\' || c == ';';
  };
  for (std::size_t n = 0; n < text.size();) {
    if (with_comments && text[n] == '#') {
      n = std::min(text.find('\n', n), text.size());
      continue;
    }
    std::size_t end = n;
    while (end < text.size() && !parts(text[end]) && !(with_comments && text[end] == '#')) ++end;
    if (end > n) words.push_back(text.substr(n, end - n));
    n = std::max(end, n + 1);
    if (end < text.size() && text[end] == '#') n = end;
  }
  return words;
}

class ForeignReader {
 public:
  ForeignReader(std::string_view text, const std::string& file) : text_(text), file_(file) {}

  [[noreturn]] void fail(const std::string& what) const { throw InputError(file_, 0, "camera: " + what); }

  double number(std::string_view word, const char* of) const {
    double value = 0.0;
    if (!parse_number(word, value)) fail(fmt::format("{} is not a finite number of {}", in_quotes(word), of));
    return value;
  }

  /// Returns the numbers from `words[first]` on, as the three rows of rotation and translation.
  RigidMotion motion(const std::vector<std::string_view>& words, std::size_t first, const char* of) const {
    if (words.size() < first + kMatrixNumbers) fail(fmt::format("{} has fewer than 12 numbers", of));
    RigidMotion result;
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 3; ++column) result.rotation[column][row] = number(words[first++], of);
      result.translation[row] = number(words[first++], of);
    }
    result.rotation = rotation(result.rotation, of);
    return result;
  }

  /// Returns the rotation nearest to rounded numbers; throws if they are not a rotation.
  glm::dmat3 rotation(const glm::dmat3& m, const char* of) const {
    constexpr double kRounding = 1e-3;
    const glm::dmat3 product = glm::transpose(m) * m;
    double deviation = 0.0;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) deviation = std::max(deviation, std::abs(product[i][j] - (i == j ? 1.0 : 0.0)));
    if (!(deviation <= kRounding) || glm::determinant(m) < 0.0)
      fail(fmt::format("the matrix of {} is not a rotation", of));
    const glm::dvec3 x = glm::normalize(m[0]), z = glm::normalize(glm::cross(x, m[1]));
    return {x, glm::cross(z, x), z};
  }

  Camera pymol() const {
    constexpr const char* kOf = "PyMOL's get_view";
    std::vector<std::string_view> words = words_of(text_, true);
    std::erase_if(words, [](std::string_view word) {
      return word == "set_view" || word == "cmd.set_view" || word == "get_view" || word == "_" || word.empty();
    });
    if (words.size() != kViewNumbers)
      fail(
          fmt::format("this is not a camera: expected JSON, the 18 numbers of PyMOL's get_view (here are {} words), or "
                      "ChimeraX's `view matrix`",
                      words.size()));
    double v[kViewNumbers];
    for (std::size_t n = 0; n < kViewNumbers; ++n) v[n] = number(words[n], kOf);
    // The first nine numbers are written by rows; each column is an axis of the camera.
    const glm::dmat3 axes = rotation({{v[0], v[3], v[6]}, {v[1], v[4], v[7]}, {v[2], v[5], v[8]}}, kOf);
    const glm::dvec3 origin(v[12], v[13], v[14]);  // the centre of rotation; v[9..11] is its place seen from the camera
    Camera camera;
    camera.position = origin - axes * glm::dvec3(v[9], v[10], v[11]);
    const double distance = -v[11];
    if (!(distance > 0.0)) fail("PyMOL's get_view has the molecule behind the camera");
    camera.target = camera.position - axes[2] * distance;
    camera.up = axes[1];
    // A flag above 1 is the angle, negative in perspective. Other flags say whether the camera is orthoscopic, with the
    // usual angle.
    const double flag = v[17], angle = std::abs(flag) > 1.0 ? std::abs(flag) : 20.0;
    if (flag > 0.0) {
      camera.projection = Projection::orthographic;
      camera.height = 2.0 * distance * std::tan(angle * (std::numbers::pi / 360.0));
    } else {
      camera.vertical_fov = angle;
    }
    return camera;
  }

  Camera chimerax(const std::vector<std::string_view>& words, std::size_t place, double aspect) const {
    RigidMotion camera = motion(words, place + 1, "ChimeraX's camera");
    std::optional<RigidMotion> models;
    place += 1 + kMatrixNumbers;
    if (place < words.size() && words[place] == "models") ++place;
    for (; place + kMatrixNumbers < words.size() && words[place].starts_with('#'); place += 1 + kMatrixNumbers) {
      const RigidMotion model = motion(words, place + 1, "ChimeraX's models");
      if (models && !near(*models, model))
        fail(
            "ChimeraX has moved its models relative to each other, which one camera cannot show; reset their positions "
            "first");
      models = model;
    }
    if (place != words.size()) fail(fmt::format("{} is not part of ChimeraX's `view matrix`", in_quotes(words[place])));
    if (models) {
      const glm::dmat3 back = glm::transpose(models->rotation);
      camera = {back * camera.rotation, back * (camera.translation - models->translation)};
    }
    Camera result;
    result.position = camera.translation;
    constexpr double kAhead = 100.0;  // Å; the text gives only a direction
    result.target = camera.translation - camera.rotation[2] * kAhead;
    result.up = camera.rotation[1];
    constexpr double kHalfAngle = std::numbers::pi / 12.0;
    result.vertical_fov = std::atan(std::tan(kHalfAngle) / aspect) * (360.0 / std::numbers::pi);
    return result;
  }

 private:
  static bool near(const RigidMotion& a, const RigidMotion& b) {
    constexpr double kRounding = 1e-3;
    double apart = glm::length(a.translation - b.translation);
    for (int column = 0; column < 3; ++column)
      apart = std::max(apart, glm::length(a.rotation[column] - b.rotation[column]));
    return apart < kRounding;
  }

  std::string_view text_;
  const std::string& file_;
};

}  // namespace

Camera parse_any_camera(std::string_view text, const std::string& file, double aspect) {
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
  if (first == std::string_view::npos || text[first] == '{' || text[first] == '"' || text.starts_with(kByteOrderMark))
    return parse_camera(text, file);
  const ForeignReader reader(text, file);
  const std::vector<std::string_view> words = words_of(text, false);
  std::optional<Camera> camera;
  for (std::size_t n = 0; n < words.size() && !camera; ++n)
    if (words[n] == "camera") camera = reader.chimerax(words, n, aspect);
  if (!camera) camera = reader.pymol();
  validate_camera(*camera, file);
  return *camera;
}

Camera read_any_camera(const std::string& file, double aspect) {
  if (file.starts_with('{')) return parse_any_camera(file, option_name("camera"), aspect);
  std::ifstream stream(path_of_text(file), std::ios::binary);
  if (!stream) throw InputError(file, 0, "camera: the file cannot be opened");
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  if (stream.bad()) throw InputError(file, 0, "camera: the file cannot be read");
  return parse_any_camera(text, file, aspect);
}

}  // namespace meniscus
