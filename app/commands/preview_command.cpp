// SPDX-License-Identifier: BSD-3-Clause
// Declares the options of the preview, and takes what they say as a figure and as words for render.
#include "app/commands/preview_command.h"

#include <algorithm>
#include <charconv>
#include <iterator>
#include <string_view>

#include <fmt/format.h>

#include "app/options/figure_options.h"
#include "app/options/look_options.h"
#include "app/options/picture_options.h"
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

/// Options that the preview changes while it runs, or that render has not.
constexpr std::string_view kOwnOptions[] = {"--help",
                                            "--samples",
                                            "--background",
                                            "--linear-alpha",
                                            "--object",
                                            "--hide-surface",
                                            "--scene",
                                            "--trust-scene",
                                            "--camera",
                                            "--projection",
                                            "--view",
                                            "--turn",
                                            "--zoom-to",
                                            "--size",
                                            "--width",
                                            "--height",
                                            "--dpi",
                                            "--surface",
                                            "--probe",
                                            "--show",
                                            "--color",
                                            "--map",
                                            "--map-file",
                                            "--color-range",
                                            "--missing-color",
                                            "--color-by-file",
                                            "--color-column",
                                            "--sticks",
                                            "--balls",
                                            "--spheres",
                                            "--tube",
                                            "--stick-radius",
                                            "--tube-radius",
                                            "--opacity",
                                            "--film-opacity",
                                            "--clip",
                                            "--cap-color",
                                            "--cap-hatching",
                                            "--preset",
                                            "--light",
                                            "--light-strength",
                                            "--ambient",
                                            "--roughness",
                                            "--specular",
                                            "--shininess",
                                            "--ambient-occlusion",
                                            "--ambient-occlusion-radius",
                                            "--silhouettes",
                                            "--outer-lines",
                                            "--inner-lines",
                                            "--part-lines",
                                            "--depth-cue",
                                            "--legend",
                                            "--legend-title",
                                            "--legend-size",
                                            "--legend-place",
                                            "--serve",
                                            "--commands",
                                            "--record",
                                            "--output-dir",
                                            "--force"};

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
    if (std::ranges::find(kOwnOptions, name) == std::end(kOwnOptions)) add_words(*option, input.words);
  }
  return input;
}

void add_session_options(CLI::App& command, PreviewCommand& state) {
  command
      .add_option_function<std::string>(
          "--serve", [&state](const std::string& text) { state.port = parse_port(text); },
          "No window: serve a page for browsers on 127.0.0.1, at this port or at any free one")
      ->expected(0, 1)
      ->type_name("[PORT]");
  const Heading heading(command, "Session");
  command.add_option("--commands", state.commands, "Carry out these commands first, one JSON object a line")
      ->type_name("FILE");
  command.add_option("--record", state.record, "Write every command to this file, for --commands")->type_name("FILE");
  command.add_option("--output-dir", state.output_folder, "Folder of exports [.]")->type_name("FOLDER");
  command.add_flag("--force", state.force, "Let --record replace a file");
}

}  // namespace

void declare_preview(CLI::App& command, PreviewCommand& state) {
  state.molecule.reading.model.all = true;
  add_atom_options(command, state.molecule);
  command.get_option("--model")->description("Model to show; default: all of them, each a frame");
  {
    const Heading heading(command, "Surface");
    add_kind_option(command, state.molecule.surface);
    add_probe_option(command, state.molecule.surface);
    add_device_option(command, state.molecule.surface);
  }
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
  command.add_option("--samples", state.samples, "Rays per pixel of exported pictures [4; of scenes 9]")
      ->check(CLI::Range(1, 1024).description(""))
      ->type_name("N");
  add_background_option(command, state.background,
                        "white (default), black, #rrggbb, or transparent in exported pictures");
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
