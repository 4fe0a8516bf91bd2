// SPDX-License-Identifier: BSD-3-Clause
// Adds the options of the preview, and turns them into a figure and into words for render.
#include "app/commands/preview_command.h"

#include <algorithm>
#include <charconv>
#include <iterator>
#include <string_view>

#include <fmt/format.h>

#include "app/options/figure_options.h"
#include "app/options/look_options.h"
#include "app/options/picture_options.h"
#include "app/options/property_options.h"
#include "app/options/scene_file.h"
#include "core/base/text.h"
#include "core/scene/surface_kind.h"

namespace meniscus {
namespace {

std::uint16_t parse_port(const std::string& text) {
  if (text.empty()) return 0;
  std::uint16_t port = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), port);
  if (error != std::errc() || end != text.data() + text.size())
    throw CLI::ValidationError("--serve", in_quotes(text) + " is no port, 0 to 65535; put FILE before --serve");
  return port;
}

/// Whether the preview changes the option while it runs, or render does not have it.
bool is_own(std::string_view name) {
  constexpr std::string_view kOthers[] = {"--help", "--scene", "--trust-scene", "--force"};
  if (std::ranges::find(kOthers, name) != std::end(kOthers)) return true;
  return std::ranges::any_of(properties(),
                             [&](const Property* property) { return property->has(live) && property->option == name; });
}

/// As they were said.
void add_words(const CLI::Option& option, std::vector<std::string>& words) {
  if (option.empty()) return;
  const std::string name = option.get_positional() ? "" : option.get_name();
  if (option.get_expected_max() == 0) return words.push_back(name);
  for (const std::string& value : option.results()) {
    if (name.empty() || value.starts_with('-')) {
      words.push_back(name.empty() ? value : name + "=" + value);
      continue;
    }
    words.push_back(name);
    words.push_back(value);
  }
}

RenderInput render_input(const CLI::App& command) {
  RenderInput input;
  for (const CLI::Option* option : command.get_options()) {
    const std::string name = option->get_positional() ? "" : option->get_name();
    if (name == "--color-by-file" || name == "--color-column") add_words(*option, input.number_words);
    if (name == "--map-file") add_words(*option, input.map_words);
    if (!is_own(name)) add_words(*option, input.words);
  }
  return input;
}

void add_session_options(CLI::App& command, PreviewCommand& state) {
  PropertyOptions options(command);
  options.add_parsed("preview.serve", [&state](const std::string& text) { state.port = parse_port(text); });
  options.add("preview.commands", state.commands);
  options.add("preview.record", state.record);
  options.add("preview.output_folder", state.output_folder);
  options.add("output.force", state.force)->description("Let --record replace a file");
}

}  // namespace

void declare_preview(CLI::App& command, PreviewCommand& state) {
  state.molecule.reading.model.all = true;
  add_atom_options(command, state.molecule);
  command.get_option("--model")->description("Model to show; default: all of them, each a frame");
  add_kind_option(command, state.molecule.surface);
  add_probe_option(command, state.molecule.surface);
  add_device_option(command, state.molecule.surface);
  add_color_options(command, state.molecule);
  add_figure_options(command, state.molecule, state.figure);
  add_trajectory_argument(command);
  add_frame_options(command, state.frames);
  for (const char* option : {"--only", "--progress"}) command.remove_option(command.get_option(option));
  add_picture_options(command, state.picture);
  add_look_options(command, state.look, state.picture);
  add_legend_options(command, state.legend, state.picture);
  command.remove_option(command.get_option("--legend-file"));
  add_annotation_options(command, state.annotations);
  command.remove_option(command.get_option("--time-stamp"));
  PropertyOptions(command)
      .add("image.samples", state.samples)
      ->description("Rays per pixel of exported pictures [4; of scenes 9]");
  add_background_option(command, state.background);
  command.get_option("--background")->description("white, black, #rrggbb, or transparent in exported pictures [white]");
  add_session_options(command, state);
  add_scene_options(command);
}

void take_preview(const CLI::App& command, PreviewCommand& state) {
  require_probe_of_kind(state.molecule.surface);
  state.of_scene = command.count("--scene") > 0;
  state.input = render_input(command);
  if (!state.of_scene) return;
  if (command.count("--preset") == 0) state.look.preset = LookRequest{}.preset;
  if (command.count("--background") == 0) state.background.reset();
  if (command.count("--model") == 0) state.molecule.reading.model = {};
}

PreviewFigure figure_of(const PreviewCommand& command, const ColorScheme& color) {
  PreviewFigure figure;
  figure.camera.projection = command.picture.projection;
  figure.kind = command.molecule.surface.kind;
  figure.probe_radius = command.molecule.surface.probe_radius;
  figure.show = command.molecule.show;
  figure.color = color;
  figure.figure = command.figure;
  figure.look = command.look;
  if (command.background) figure.background = *command.background;
  figure.legend = command.legend.within;
  figure.legend_style = command.legend.style;
  return figure;
}

ExportWishes wishes_of(const PreviewCommand& command, const CLI::App& parsed) {
  ExportWishes wishes;
  const auto given = [&](const char* option) { return parsed.count(option) > 0; };
  if (command.of_scene || given("--size") || given("--width") || given("--height"))
    wishes.size = command.picture.size();
  constexpr int kUsualSamples = 9;  // of render
  wishes.samples = command.of_scene ? command.samples.value_or(kUsualSamples) : command.samples;
  wishes.transparent = !command.background;
  wishes.dots_per_inch = command.picture.dots_per_inch;
  return wishes;
}

}  // namespace meniscus
