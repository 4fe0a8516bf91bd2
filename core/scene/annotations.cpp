// SPDX-License-Identifier: BSD-3-Clause
// Reads labels and scale bars, and turns them into texts of a picture.
#include "core/scene/annotations.h"

#include <charconv>

#include "core/base/constants.h"
#include "core/queries/copies.h"
#include "core/scene/representations.h"
#include "core/trajectory/frame_list.h"

namespace meniscus {
namespace {

glm::dvec3 middle_of(const Selection& selection, const Structure& structure) {
  const std::vector<Atom> atoms = shown_atoms(structure);
  const std::vector<bool> chosen = selection.evaluate(atoms);
  glm::dvec3 sum(0.0);
  std::size_t count = 0;
  const auto add = [&](std::size_t atom, const RigidMotion& motion) {
    if (!chosen[atom]) return;
    sum += motion(atoms[atom].position);
    ++count;
  };
  for (std::size_t a = 0; structure.instances.empty() && a < chosen.size(); ++a) add(a, {});
  for (const Instances& group : structure.instances)
    for (const RigidMotion& motion : group.motions)
      for (const std::uint32_t atom : group.atoms) add(atom, motion);
  if (count == 0)
    throw InputError(structure.file, 0,
                     message("@label {}@: none of the {} atoms used is selected; {}", in_quotes(selection.text()),
                             with_thousands(structure.atoms.size()), selection.why_none(structure.atoms)));
  return sum / static_cast<double>(count);
}

/// Returns the title of a column: columns of `surface --csv-series` get their unit, others keep their name.
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
  if (const auto parted = selection_and_text(text); parted && !parted->text.empty())
    return {parted->atoms, std::string(parted->text)};
  const std::size_t sign = text.find('=');
  if (sign != std::string::npos && sign > 0 && sign + 1 < text.size())
    parse_selection(text.substr(0, sign));  // throws an error that says what is wrong
  throw RequestError(in_quotes(text) + " is not EXPR=TEXT, such as 'resid 48=Ser 48'");
}

std::optional<Curve> curve_of(const AnnotationRequest& request, std::span<const std::uint64_t> frames) {
  if (request.curve.empty()) return std::nullopt;
  const SeriesTable table = read_series_table(request.curve, request.curve_column);
  Curve curve{title_of(table.column), {}, 0};
  for (const std::uint64_t frame : frames) curve.values.push_back(table.at(frame));
  return curve;
}

LegendStyle legend_style(const LegendStyle& requested, const LetterStyle& letters) {
  LegendStyle style = requested;
  if (!style.letters) style.letters = letters.all;
  style.color = letters.color;
  style.font = letters.font;
  style.border = letters.border;
  return style;
}

StripContents strip_contents(const AnnotationRequest& request, bool is_run) {
  return {!request.panel.empty(), !request.title.empty(), is_run && request.time_stamp,
          is_run && !request.curve.empty()};
}

Annotations annotations_of(const AnnotationRequest& request, const Structure& structure,
                           std::span<const PlaceLabel> lengths) {
  Annotations annotations;
  annotations.panel = request.panel;
  annotations.title = request.title;
  annotations.scale_bar = request.scale_bar;
  annotations.bar_length = request.bar_length;
  annotations.letters = request.letters;
  if (!request.labels.empty())
    for (const Ball& ball : standing_balls(structure)) annotations.atoms.emplace_back(ball.center, ball.radius);
  for (const LabelRequest& label : request.labels)
    annotations.labels.push_back({label.text, middle_of(label.atoms, structure)});
  if (!request.hides_lengths) annotations.labels.insert(annotations.labels.end(), lengths.begin(), lengths.end());
  return annotations;
}

std::string time_text(const std::optional<double>& picoseconds, std::uint64_t frame, double longest) {
  if (!picoseconds) return fmt::format("frame {}", frame);
  const TimeUnit unit = time_unit(longest);
  return fmt::format("{:.{}f} {}", *picoseconds / unit.picoseconds, unit.picoseconds == 1.0 ? 1 : 3, unit.name);
}

}  // namespace meniscus
