// SPDX-License-Identifier: BSD-3-Clause
// Goes by the keys, in whatever order and however often they come; the last one counts.
#include "app/msms/shaper_settings.h"

#include <string_view>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/text/parse_number.h"
#include "core/text/text_file.h"
#include "core/text/text_lines.h"

namespace meniscus::msms {
namespace {

constexpr double kLargestProbe = 100.0, kLargestCavity = 1e9;   // Å, Å³
constexpr double kSmallestScale = 0.1, kLargestScale = 20.0;    // points per Å
constexpr std::size_t kLargestSettings = std::size_t{1} << 20;  // bytes

/// One line's value, and where it stands.
struct Value {
  const TextFile& file;
  std::size_t line;
  std::string_view key, text;

  [[noreturn]] void refuse(const std::string& instead) const {
    throw InputError(file.path, static_cast<int>(line),
                     fmt::format("{} is {}; give {}", key, in_quotes(text), instead));
  }
  double number(double least, double most) const {
    double value = 0.0;
    if (!parse_number(text, value) || !(value >= least && value <= most))
      refuse(fmt::format("a number from {} to {}", least, most));
    return value;
  }
  bool truth() const {
    if (text != "true" && text != "false") refuse("true or false");
    return text == "true";
  }
};

void take(const Value& value, ShaperSettings& settings) {
  if (value.key == "XYZR_FileName") {
    settings.spheres = value.text;
  } else if (value.key == "Probe_Radius") {
    settings.probe_radius = value.number(0.0, kLargestProbe);
  } else if (value.key == "Grid_scale") {
    settings.grid_scale = value.number(kSmallestScale, kLargestScale);
  } else if (value.key == "Cavity_Detection_Filling") {
    settings.fill_cavities = value.truth();
  } else if (value.key == "Conditional_Volume_Filling_Value") {
    settings.smallest_cavity = value.number(0.0, kLargestCavity);
  } else if (value.key == "Surface") {
    if (value.text != "ses") value.refuse("ses, the one surface that there is here");
  } else if (value.key == "Save_Mesh_MSMS_Format") {
    if (!value.truth()) value.refuse("true, the one form that there is here");
  }
}

}  // namespace

ShaperSettings read_shaper_settings(const std::string& path) {
  const TextFile file = read_text_file(path, kLargestSettings);
  ShaperSettings settings;
  LineReader lines(file.text);
  for (std::string_view line; lines.next(line);) {
    line = trimmed(line);
    if (line.empty() || line.front() == '#' || line.front() == '%') continue;
    const std::size_t equals = line.find('=');
    if (equals == std::string_view::npos)
      throw InputError(file.path, lines.number(), fmt::format("{} is not of the form key = value", in_quotes(line)));
    take({file, lines.number(), trimmed(line.substr(0, equals)), trimmed(line.substr(equals + 1))}, settings);
  }
  if (settings.spheres.empty()) throw InputError(file.path, 0, "has no XYZR_FileName, the file of spheres; add it");
  return settings;
}

}  // namespace meniscus::msms
