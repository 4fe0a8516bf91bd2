// SPDX-License-Identifier: BSD-3-Clause
// Says a view in the options of `meniscus render`.
#include "app/preview/render_words.h"

#include <nlohmann/json.hpp>

#include <fmt/format.h>

#include "core/camera/camera_json.h"
#include "app/options/object_option.h"
#include "core/base/text.h"
#include "core/color/color_maps.h"
#include "core/color/named_colors.h"
#include "core/properties/properties.h"

namespace meniscus {
namespace {

class Words {
 public:
  explicit Words(std::vector<std::string> first) : words_(std::move(first)) {}

  void add(const std::vector<std::string>& words) { words_.insert(words_.end(), words.begin(), words.end()); }
  void flag(const char* name, bool on) {
    if (on) words_.emplace_back(name);
  }
  /// A value that begins with a dash would be taken for an option.
  void option(std::string_view name, const std::string& value) {
    if (value.starts_with('-')) return words_.push_back(fmt::format("{}={}", name, value));
    words_.emplace_back(name);
    words_.push_back(value);
  }
  template <typename Number>
  void number(std::string_view name, const std::optional<Number>& value) {
    if (value) option(name, fmt::format("{}", *value));
  }
  std::vector<std::string> take() { return std::move(words_); }

 private:
  std::vector<std::string> words_;
};

void add_look(const LookRequest& look, Words& words) {
  words.option("--preset", preset_word(look.preset));
  if (look.light_direction)
    words.option("--light",
                 fmt::format("{},{},{}", look.light_direction->x, look.light_direction->y, look.light_direction->z));
  for (const LookNumber& number : look_numbers()) words.number(property_of(number.key).option, look.*number.asked);
  words.flag("--linear-alpha", look.linear_alpha);
}

void add_colors(const RenderInput& input, const RenderedView& view, Words& words) {
  const PreviewFigure& figure = view.figure;
  const ColorScheme& color = figure.color;
  if (figure.patch_kinds) {
    words.option("--color", "kind");
  } else {
    if (!color.uses_file() || color.by != ColorScheme::By::file) words.option("--color", scheme_word(color));
    if (color.uses_file()) words.add(input.number_words);
    if (color.uses_scale()) {
      if (color.own_map)
        words.add(input.map_words);
      else if (color.map)
        words.option("--map", std::string(map_name(*color.map)));
      const auto range = color.range ? color.range : view.range;
      if (range) words.option("--color-range", fmt::format("{}:{}", (*range)[0], (*range)[1]));
      if (color.missing) words.option("--missing-color", hex_color(*color.missing));
    }
    for (const ColorRule& rule : color.rules)
      words.option("--color", rule.atoms.text() + "=" + scheme_word(rule.paint));
  }
  for (const OpacityRule& rule : color.opacities)
    words.option("--opacity", (rule.atoms ? rule.atoms->text() + "=" : "") + fmt::format("{}", rule.opacity));
}

void add_figure(const FigureRequest& figure, Words& words) {
  words.flag("--film-opacity", figure.thickens);
  for (const Cut& cut : figure.cuts) words.option("--clip", cut_text(cut));
  if (figure.cap.color) words.option("--cap-color", hex_color(*figure.cap.color));
  if (figure.cap.hatching > 0.0) words.option("--cap-hatching", fmt::format("{}", figure.cap.hatching));
  for (const RepresentationRequest& request : figure.representations.requests)
    words.option(option_word(request.kind), request.atoms.text());
  words.number("--stick-radius", figure.representations.stick_radius);
  words.number("--tube-radius", figure.representations.tube_radius);
  words.flag("--hide-surface", figure.hides_surface);
  for (const FigureObjectRequest& object : figure.objects)
    words.option("--object", figure_object_json(object).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
}

void add_legend(const PreviewFigure& figure, Words& words) {
  const LegendStyle& style = figure.legend_style;
  words.flag("--legend", true);
  if (style.title) words.option("--legend-title", *style.title);
  words.number("--legend-size", style.letters);
  if (style.place != LegendStyle::Place::automatic)
    words.option("--legend-place", style.place == LegendStyle::Place::right ? "right" : "below");
}

}  // namespace

std::string preset_word(LookPreset preset) {
  return words_of(property_of("look.preset"))[static_cast<std::size_t>(preset)];
}

std::vector<std::string> render_words(const RenderInput& input, const RenderedView& view) {
  const PreviewFigure& figure = view.figure;
  Words words({"meniscus", "render"});
  words.add(input.words);
  if (view.model) words.option("--model", fmt::format("{}", *view.model));
  if (view.frame) {
    words.option("--only", fmt::format("{}", *view.frame));
    words.option("-o", "frame_#####.png");
  }
  words.option("--camera", nlohmann::json(camera_object(figure.camera)).dump());
  words.option("--size", fmt::format("{}x{}", view.size.x, view.size.y));
  if (view.dots_per_inch > 0.0) words.option("--dpi", fmt::format("{}", view.dots_per_inch));
  words.option("--samples", fmt::format("{}", view.samples));
  words.option("--background", view.transparent ? "transparent" : hex_color(figure.background));
  if (figure.kind != SurfaceKind::ses) words.option("--surface", kind_word(figure.kind));
  if (figure.kind != SurfaceKind::vdw) words.option("--probe", fmt::format("{}", figure.probe_radius));
  if (figure.show) words.option("--show", figure.show->text());
  add_colors(input, view, words);
  add_figure(figure.figure, words);
  add_look(figure.look, words);
  if (figure.legend) add_legend(figure, words);
  return words.take();
}

std::string shell_line(std::span<const std::string> words) {
  std::string line;
  for (const std::string& word : words) {
    const bool plain =
        word.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_./:,+=") ==
            std::string::npos &&
        !word.empty();
    line += (line.empty() ? "" : " ") + (plain ? word : escaped(shell_word(word)));
  }
  return line;
}

}  // namespace meniscus
