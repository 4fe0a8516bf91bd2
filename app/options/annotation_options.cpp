// SPDX-License-Identifier: BSD-3-Clause
// Declares what is written into a picture.
#include "app/options/annotation_options.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "app/options/molecule_options.h"
#include "app/options/picture_options.h"
#include "app/options/value_words.h"
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
  command.add_flag("--legend", request.within,
                   "Write what the colours mean at the right (of high pictures: below); the molecule is framed beside "
                   "it");
  command.add_option("--legend-file", request.file, "Write the legend as a picture of its own")->type_name("FILE");
  command.add_option("--legend-title", request.style.title, "Instead of the usual one; '' for none")->type_name("TEXT");
  command
      .add_option_function<std::string>(
          "--legend-size",
          [&request, &picture](const std::string& text) {
            constexpr double kLeast = 6.0, kMost = 1000.0;
            const double pixels = std::round(pixels_of("--legend-size", text, picture));
            if (!(pixels >= kLeast && pixels <= kMost))
              throw CLI::ValidationError("--legend-size", fmt::format("{} makes {:.4g} pixels; letters have {} to {}",
                                                                      in_quotes(text), pixels, kLeast, kMost));
            request.style.letters = static_cast<int>(pixels);
          },
          "Height of its letters: pixels, or 8pt, 3mm [a thirtieth of the shorter side]")
      ->type_name("SIZE");
  const std::map<std::string, LegendStyle::Place> places{{"auto", LegendStyle::Place::automatic},
                                                         {"right", LegendStyle::Place::right},
                                                         {"below", LegendStyle::Place::below}};
  command.add_option("--legend-place", request.style.place, "auto (default), right or below")
      ->transform(one_of(places))
      ->type_name("WORD");
}

void add_annotation_options(CLI::App& command, AnnotationRequest& request) {
  command.add_option("--panel", request.panel, "Letter of the panel, at the top left")->type_name("TEXT");
  command
      .add_option_function<std::string>(
          "--scale-bar", [&request](const std::string& text) { parse_scale_bar(text, request); },
          "A bar of so many Å at the bottom left, or of a round length (auto, default); of a perspective camera it "
          "holds where that looks at")
      ->expected(0, 1)
      ->check(proposes({"auto"}))
      ->type_name("Å");
  command
      .add_option_function<std::vector<std::string>>(
          "--label",
          [&request](const std::vector<std::string>& texts) {
            request.labels.clear();
            for (const std::string& text : texts) request.labels.push_back(parse_label(text));
          },
          "Write TEXT beside the middle of these atoms, with a line that leads there, before whatever is in front of "
          "it; repeatable")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->type_name("EXPR=TEXT");
  command.add_flag("--time-stamp", request.time_stamp,
                   "Of frames: write the time in ns at the top right, or the frame's number where there are no times");
}

void add_curve_options(CLI::App& command, AnnotationRequest& request) {
  CLI::Option* const curve =
      command
          .add_option(
              "--curve", request.curve,
              "Of frames: draw numbers of the run (surface --csv-series) as a curve at the bottom right, with a "
              "mark where each frame is")
          ->type_name("FILE.csv");
  command.add_option("--curve-column", request.curve_column, "Which column of --curve [the first behind the time]")
      ->needs(curve)
      ->type_name("NAME");
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
