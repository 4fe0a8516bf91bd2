// SPDX-License-Identifier: BSD-3-Clause
// Adds the options of pictures: size, background, and the camera, which may move over a run of frames.
#include "app/options/picture_options.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <string_view>

#include <fmt/format.h>

#include "app/options/property_options.h"
#include "core/base/text.h"
#include "core/color/named_colors.h"
#include "core/base/parse_number.h"

namespace meniscus {
namespace {

constexpr int kLargestSide = 65535;  // pixels; PNG and EXR readers of other programs stop here

bool parse_side(std::string_view text, int& side) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), side);
  return error == std::errc() && end == text.data() + text.size() && side >= 1 && side <= kLargestSide;
}

void parse_size(const std::string& text, ViewRequest& request) {
  const std::size_t cross = text.find('x');
  const std::string_view whole(text);
  if (cross == std::string::npos || !parse_side(whole.substr(0, cross), request.width) ||
      !parse_side(whole.substr(cross + 1), request.height)) {
    throw CLI::ValidationError(
        "--size", fmt::format("{} is not WIDTHxHEIGHT in pixels, 1 to {} each, such as 1920x1080", in_quotes(text),
                              kLargestSide));
  }
}

constexpr double kUsualResolution = 300.0, kMillimetersPerInch = 25.4;

/// "85mm", "3.5in", "8.5cm", "1000px" or "1000" in pixels. Lengths take 300 dots an inch where nothing else was said.
int parse_length(const char* option, const std::string& text, ViewRequest& request) {
  const double pixels = std::round(pixels_of(option, text, request));
  if (!(pixels >= 1.0 && pixels <= kLargestSide))
    throw CLI::ValidationError(
        option, fmt::format("{} makes {:.0f} pixels; a side has 1 to {}", in_quotes(text), pixels, kLargestSide));
  return static_cast<int>(pixels);
}

/// One side alone keeps the shape of the picture.
void add_length_options(PropertyOptions& options, ViewRequest& request, CLI::Option* size) {
  options.add("image.dpi", request.dots_per_inch);
  const double shape = request.aspect();
  CLI::Option* const width = options.add_parsed("image.width", [&request, shape](const std::string& text) {
    request.width = parse_length("--width", text, request);
    request.height = std::clamp(static_cast<int>(std::lround(request.width / shape)), 1, kLargestSide);
  });
  width->excludes(size);
  options
      .add_parsed("image.height",
                  [&request, shape, width](const std::string& text) {
                    request.height = parse_length("--height", text, request);
                    if (width->empty())
                      request.width =
                          std::clamp(static_cast<int>(std::lround(request.height * shape)), 1, kLargestSide);
                  })
      ->excludes(size);
}

void parse_view(const std::string& text, ViewRequest& request) {
  request.direction = parse_view_direction(text);
  if (!request.direction)
    throw CLI::ValidationError(
        "--view", fmt::format("{} is none of {}", in_quotes(text), CLI::detail::join(view_direction_words(), ", ")));
}

void parse_turns(const std::vector<std::string>& texts, ViewRequest& request) {
  for (const std::string& text : texts) {
    const std::optional<Turn> turn = parse_turn(text);
    if (!turn)
      throw CLI::ValidationError(
          "--turn",
          in_quotes(text) + " is no axis of the picture (x, y, z) with degrees behind it, such as y90 or x-30");
    request.turns.push_back(*turn);
  }
}

void parse_background(const std::string& text, std::optional<glm::vec3>& background) {
  background.reset();
  if (text == "transparent") return;
  if (text == "white") background = glm::vec3(1.0f);
  if (text == "black") background = glm::vec3(0.0f);
  if (!background) background = parse_hex_color(text);
  if (!background)
    throw CLI::ValidationError("--background", in_quotes(text) + " is none of transparent, white, black, #rrggbb");
}

}  // namespace

double pixels_of(const char* option, const std::string& text, ViewRequest& request) {
  constexpr double kPointsPerInch = 72.0;
  const std::size_t end = std::min(text.find_first_not_of("0123456789.+-eE"), text.size());
  const std::string unit = text.substr(end);
  const std::map<std::string, double> per_inch{
      {"in", 1.0}, {"cm", kMillimetersPerInch / 10.0}, {"mm", kMillimetersPerInch}, {"pt", kPointsPerInch}};
  const auto length = per_inch.find(unit);
  double value = 0.0;
  if (!parse_number(text.substr(0, end), value) || (length == per_inch.end() && !unit.empty() && unit != "px"))
    throw CLI::ValidationError(option, in_quotes(text) + " is no length, such as 85mm, 8.5cm, 3.5in, 8pt or 1000px");
  if (length == per_inch.end()) return value;
  if (request.dots_per_inch == 0.0) request.dots_per_inch = kUsualResolution;
  return value * request.dots_per_inch / length->second;
}

void add_size_option(CLI::App& command, ViewRequest& request, const std::string& what) {
  PropertyOptions(command)
      .add_parsed("image.size", [&request](const std::string& text) { parse_size(text, request); })
      ->description(fmt::format("{} in pixels [{}x{}]", what, request.width, request.height));
}

void add_picture_options(CLI::App& command, ViewRequest& request) {
  add_size_option(command, request, "Size");
  PropertyOptions options(command);
  add_length_options(options, request, command.get_option("--size"));
  CLI::Option* const camera = options.add("camera.from", request.camera_file);
  options.add_word("camera.projection", request.projection, {Projection::perspective, Projection::orthographic})
      ->excludes(camera);
  options.add_parsed("camera.view", [&request](const std::string& text) { parse_view(text, request); })
      ->check(proposes(view_direction_words()))
      ->excludes(camera);
  options.add_list("camera.turn", [&request](const std::vector<std::string>& texts) { parse_turns(texts, request); });
  options.add_selection("camera.zoom_to", request.zoom_to);
}

void add_background_option(CLI::App& command, std::optional<glm::vec3>& background) {
  PropertyOptions(command).add_parsed("image.background",
                                      [&background](const std::string& text) { parse_background(text, background); });
}

void add_run_camera_options(CLI::App& command, CameraMotionRequest& motion) {
  PropertyOptions options(command);
  CLI::Option* const path = options.add("camera.path", motion.path_file);
  for (const char* name : {"--camera", "--view", "--turn", "--zoom-to"}) path->excludes(command.get_option(name));
  options.add("camera.turntable", motion.turns);
  options.add_selection("camera.follow", motion.follow);
}

}  // namespace meniscus
