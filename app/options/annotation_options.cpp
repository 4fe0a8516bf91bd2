// SPDX-License-Identifier: BSD-3-Clause
// Adds the options of legends and labels, and turns what they say into texts of a picture.
#include "app/options/annotation_options.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include <fmt/format.h>

#include "app/options/molecule_options.h"
#include "app/options/picture_options.h"
#include "app/options/property_options.h"
#include "core/base/error.h"
#include "core/base/text.h"
#include "core/trajectory/series_table.h"

namespace meniscus {
namespace {

void parse_scale_bar(const std::string& text, AnnotationRequest& request) {
  request.scale_bar = true;
  request.bar_length.reset();
  if (text.empty() || text == "auto" || text == "true") return;
  double length = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), length);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(length) || length <= 0.0)
    throw CLI::ValidationError("--scale-bar", in_quotes(text) + " is no length in Å; give a number above 0, or auto");
  request.bar_length = length;
}

/// At the last equals sign, for selections may have some.
LabelRequest parse_label(const std::string& text) {
  const std::size_t sign = text.rfind('=');
  if (sign == std::string::npos || sign == 0 || sign + 1 == text.size())
    throw CLI::ValidationError("--label", in_quotes(text) + " is not EXPR=TEXT, such as 'resid 48=Ser 48'");
  return {parse_selection_option("--label", text.substr(0, sign)), text.substr(sign + 1)};
}

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

void add_legend_options(CLI::App& command, LegendRequest& request, ViewRequest& picture) {
  PropertyOptions options(command);
  options.add("legend.shown", request.within);
  options.add("legend.file", request.file);
  options.add("legend.title", request.style.title);
  options.add_parsed("legend.size", [&request, &picture](const std::string& text) {
    const Property& size = property_of("legend.size");
    const double pixels = std::round(pixels_of("--legend-size", text, picture));
    if (!size.is_within(pixels))
      throw CLI::ValidationError("--legend-size", fmt::format("{} makes {:.4g} pixels; letters have {} to {}",
                                                              in_quotes(text), pixels, size.lowest, size.highest));
    request.style.letters = static_cast<int>(pixels);
  });
  using enum LegendStyle::Place;
  options.add_word("legend.place", request.style.place, {automatic, right, below});
}

void add_annotation_options(CLI::App& command, AnnotationRequest& request) {
  PropertyOptions options(command);
  options.add("annotations.panel", request.panel);
  options.add_parsed("annotations.scale_bar", [&request](const std::string& text) { parse_scale_bar(text, request); });
  options
      .add_list("annotations.labels",
                [&request](const std::vector<std::string>& texts) {
                  request.labels.clear();
                  for (const std::string& text : texts) request.labels.push_back(parse_label(text));
                })
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  options.add("annotations.time_stamp", request.time_stamp);
}

void add_curve_options(CLI::App& command, AnnotationRequest& request) {
  PropertyOptions options(command);
  CLI::Option* const curve = options.add("annotations.curve", request.curve);
  options.add("annotations.curve_column", request.curve_column)->needs(curve);
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
