// SPDX-License-Identifier: BSD-3-Clause
// Reads labels and scale bars, and turns them into texts of a picture.
#include "core/scene/annotations.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/trajectory/series_table.h"

namespace meniscus {
namespace {

glm::dvec3 middle_of(const Selection& selection, const Structure& structure) {
  const std::vector<bool> chosen = selection.evaluate(structure.atoms);
  glm::dvec3 sum(0.0);
  std::size_t count = 0;
  for (std::size_t a = 0; a < chosen.size(); ++a) {
    if (!chosen[a]) continue;
    sum += structure.atoms[a].position;
    ++count;
  }
  if (count == 0)
    throw InputError(
        structure.file, 0,
        fmt::format("--label {}: none of the {} atoms used is selected; chains and names are case-sensitive",
                    in_quotes(selection.text()), with_thousands(structure.atoms.size())));
  return sum / static_cast<double>(count);
}

/// Columns that `surface --csv-series` names get their unit, others stay as they are.
std::string title_of(const std::string& column) {
  const auto begins = [&](const char* word) { return column.starts_with(word); };
  std::string title = column;
  if (begins("ses_area") || begins("sas_area") || begins("vdw_area") || begins("cavity_area")) title += ", Å²";
  if (column == "volume" || column == "cavity_volume") title += ", Å³";
  if (title != column) std::ranges::replace(title, '_', ' ');
  return title;
}

}  // namespace

void parse_scale_bar(const std::string& text, AnnotationRequest& request) {
  request.scale_bar = true;
  request.bar_length.reset();
  if (text.empty() || text == "auto" || text == "true") return;
  double length = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), length);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(length) || length <= 0.0)
    throw RequestError(in_quotes(text) + " is not a length in Å; give a number above 0, or auto");
  request.bar_length = length;
}

LabelRequest parse_label(std::string_view text) {
  const std::size_t sign = text.rfind('=');
  if (sign == std::string::npos || sign == 0 || sign + 1 == text.size())
    throw RequestError(in_quotes(text) + " is not EXPR=TEXT, such as 'resid 48=Ser 48'");
  return {parse_selection(text.substr(0, sign)), std::string(text.substr(sign + 1))};
}

std::optional<Curve> curve_of(const AnnotationRequest& request, std::span<const std::uint64_t> frames) {
  if (request.curve.empty()) return std::nullopt;
  const SeriesTable table = read_series_table(request.curve, request.curve_column);
  Curve curve{title_of(table.column), {}, 0};
  for (const std::uint64_t frame : frames) curve.values.push_back(table.at(frame));
  return curve;
}

Annotations annotations_of(const AnnotationRequest& request, const Structure& structure) {
  Annotations annotations;
  annotations.panel = request.panel;
  annotations.scale_bar = request.scale_bar;
  annotations.bar_length = request.bar_length;
  for (const LabelRequest& label : request.labels)
    annotations.labels.push_back({label.text, middle_of(label.atoms, structure)});
  return annotations;
}

std::string time_text(const std::optional<double>& picoseconds, std::uint64_t frame) {
  return picoseconds ? fmt::format("{:.3f} ns", 1e-3 * *picoseconds) : fmt::format("frame {}", frame);
}

}  // namespace meniscus
