// SPDX-License-Identifier: BSD-3-Clause
// Declares the picture options and finds the camera they mean.
#include "app/options/picture_options.h"

#include <charconv>
#include <map>
#include <string_view>

#include <fmt/format.h>

#include "core/base/text.h"

namespace meniscus {
namespace {

constexpr int kLargestSide = 65535;  // pixels; PNG and EXR readers of other programs stop here

bool parse_side(std::string_view text, int& side) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), side);
  return error == std::errc() && end == text.data() + text.size() && side >= 1 && side <= kLargestSide;
}

void parse_size(const std::string& text, PictureOptions& options) {
  const std::size_t cross = text.find('x');
  const std::string_view whole(text);
  if (cross == std::string::npos || !parse_side(whole.substr(0, cross), options.width) ||
      !parse_side(whole.substr(cross + 1), options.height)) {
    throw CLI::ValidationError(
        "--size", fmt::format("{} is not WIDTHxHEIGHT in pixels, 1 to {} each, such as 1920x1080", in_quotes(text),
                              kLargestSide));
  }
}

}  // namespace

void add_size_option(CLI::App& command, PictureOptions& options, const std::string& what) {
  command
      .add_option_function<std::string>(
          "--size", [&options](const std::string& text) { parse_size(text, options); },
          fmt::format("{} in pixels [{}x{}]", what, options.width, options.height))
      ->type_name("WxH");
}

void add_picture_options(CLI::App& command, PictureOptions& options) {
  add_size_option(command, options, "Picture");
  CLI::Option* const camera = command.add_option("--camera", options.camera_file, "Camera as JSON [shows everything]");
  camera->type_name("FILE");
  const std::map<std::string, Projection> words{{"perspective", Projection::perspective},
                                                {"orthographic", Projection::orthographic}};
  command.add_option("--projection", options.projection, "Of the default camera: perspective (default), orthographic")
      ->transform(CLI::CheckedTransformer(words).description(""))
      ->type_name("WORD")
      ->excludes(camera);
}

std::optional<Camera> given_camera(const PictureOptions& options) {
  if (options.camera_file.empty()) return {};
  return read_camera(options.camera_file);
}

Camera picture_camera(const PictureOptions& options, const std::optional<Camera>& given, std::span<const Ball> balls) {
  if (given) return *given;
  return frame_camera(balls, static_cast<double>(options.width) / options.height, options.projection);
}

}  // namespace meniscus
