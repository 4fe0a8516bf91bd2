// SPDX-License-Identifier: BSD-3-Clause
// Declares the picture request.
#include "app/options/picture_options.h"
#include "app/options/value_words.h"

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

}  // namespace

void add_size_option(CLI::App& command, ViewRequest& request, const std::string& what) {
  command
      .add_option_function<std::string>(
          "--size", [&request](const std::string& text) { parse_size(text, request); },
          fmt::format("{} in pixels [{}x{}]", what, request.width, request.height))
      ->type_name("WxH");
}

void add_picture_options(CLI::App& command, ViewRequest& request) {
  add_size_option(command, request, "Picture");
  CLI::Option* const camera = command.add_option("--camera", request.camera_file, "Camera as JSON [shows everything]");
  camera->type_name("FILE");
  const std::map<std::string, Projection> words{{"perspective", Projection::perspective},
                                                {"orthographic", Projection::orthographic}};
  command.add_option("--projection", request.projection, "Of the default camera: perspective (default), orthographic")
      ->transform(one_of(words))
      ->type_name("WORD")
      ->excludes(camera);
}

}  // namespace meniscus
