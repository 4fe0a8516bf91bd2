// SPDX-License-Identifier: BSD-3-Clause
// Reads colour maps from text and JSON.
#include "core/color/color_maps.h"

#include <nlohmann/json.hpp>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/base/text_file.h"
#include "core/color/named_colors.h"

namespace meniscus {
namespace {

constexpr std::size_t kMostColors = 4096;

class RampReader {
 public:
  explicit RampReader(const TextFile& file) : file_(file) {}

  ColorRamp read() {
    if (trimmed(file_.text).starts_with('['))
      read_json();
    else
      read_lines();
    if (ramp_.colors.size() < 2)
      throw InputError(file_.path, 0, fmt::format("holds {} colours; a map has at least two", ramp_.colors.size()));
    finish_places();
    return std::move(ramp_);
  }

 private:
  void add(std::size_t line, const std::optional<double>& place, std::string_view color) {
    const auto fail = [&](const std::string& what) { throw InputError(file_.path, line, what); };
    const std::optional<glm::vec3> read = parse_color(color);
    if (!read) fail(fmt::format("{} is not a colour; write #rrggbb, #rgb or a name such as red", in_quotes(color)));
    if (ramp_.colors.size() == kMostColors) fail(fmt::format("a map has at most {} colours", kMostColors));
    if (!ramp_.colors.empty() && place.has_value() == ramp_.places.empty())
      fail("some colours have a position, others do not");
    if (place && !ramp_.places.empty() && !(*place > ramp_.places.back()))
      fail(fmt::format("the position {:g} does not follow {:g}; positions must increase", *place, ramp_.places.back()));
    if (place) ramp_.places.push_back(*place);
    ramp_.colors.push_back(*read);
  }

  void read_lines() {
    LineReader lines(file_.text);
    std::string_view line;
    while (lines.next(line)) {
      std::string text(line.substr(0, line.find("# ")));
      std::ranges::replace_if(
          text, [](char c) { return c == ',' || c == ';'; }, ' ');
      const std::vector<std::string_view> fields = fields_of(text, 3);
      if (fields.empty() || fields[0] == "#") continue;
      std::optional<double> place;
      if (double number = 0.0; fields.size() == 2 && parse_number(fields[0], number)) place = number;
      if (fields.size() > 2 || (fields.size() == 2 && !place))
        throw InputError(file_.path, lines.number(),
                         fmt::format("{} is neither a colour nor a position and a colour", in_quotes(trimmed(line))));
      add(lines.number(), place, fields.back());
    }
  }

  void read_json() {
    const nlohmann::json list = is_nested_too_deep(file_.text) ? nlohmann::json(nlohmann::json::value_t::discarded)
                                                               : nlohmann::json::parse(file_.text, nullptr, false);
    if (list.is_discarded()) throw InputError(file_.path, 0, "begins as a JSON list, but is not valid JSON");
    for (const nlohmann::json& entry : list) {
      const bool pair = entry.is_array() && entry.size() == 2 && entry[0].is_number() && entry[1].is_string();
      if (!pair && !entry.is_string())
        throw InputError(
            file_.path, 0,
            fmt::format("entry {} is neither a colour such as \"#ff0000\" nor a pair of a position and a colour",
                        ramp_.colors.size() + 1));
      add(0, pair ? std::optional(entry[0].get<double>()) : std::nullopt,
          pair ? entry[1].get<std::string>() : entry.get<std::string>());
    }
  }

  void finish_places() {
    const double first = ramp_.places.empty() ? 0.0 : ramp_.places.front();
    const double width = ramp_.places.empty() ? 1.0 : ramp_.places.back() - first;
    if (ramp_.places.empty())
      for (std::size_t n = 0; n < ramp_.colors.size(); ++n)
        ramp_.places.push_back(static_cast<double>(n) / static_cast<double>(ramp_.colors.size() - 1));
    for (double& place : ramp_.places) place = (place - first) / width;
  }

  const TextFile& file_;
  ColorRamp ramp_;
};

}  // namespace

ColorRamp read_color_ramp(const std::string& path) {
  const TextFile file = read_text_file(path, std::size_t{1} << 20);
  return RampReader(file).read();
}

}  // namespace meniscus
