// SPDX-License-Identifier: BSD-3-Clause
// Adds the options of the preview, with its own defaults.
#include "app/commands/preview_command.h"

#include <charconv>

#include <fmt/format.h>

#include "app/options/property_options.h"
#include "core/base/text.h"
#include "core/scene/surface_kind.h"

namespace meniscus {
namespace {

std::uint16_t parse_port(const std::string& text) {
  if (text.empty()) return 0;
  std::uint16_t port = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), port);
  if (error != std::errc() || end != text.data() + text.size())
    throw CLI::ValidationError("--serve", in_quotes(text) + " is not a port from 0 to 65535; put FILE before --serve");
  return port;
}

}  // namespace

MoleculeRequest PreviewCommand::read_molecule_request() const {
  MoleculeRequest molecule = scene.molecule;
  molecule.reading.model.all = models;
  return molecule;
}

TakenProperties preview_properties() {
  return render_properties().with({"-surface.interface",
                                   "-surface.by",
                                   "-surface.cavities",
                                   "-surface.threads",
                                   "-surface.verify",
                                   "-frames.only",
                                   "-frames.progress",
                                   "-Film",
                                   "-camera.path",
                                   "-camera.turntable",
                                   "-camera.follow",
                                   "-camera.save",
                                   "-image.aovs",
                                   "-image.cryptomatte",
                                   "-image.color_space",
                                   "-image.extent",
                                   "-picture.any_cost",
                                   "-legend.file",
                                   "-annotations.time_stamp",
                                   "-annotations.curve",
                                   "-annotations.curve_column",
                                   "-output.file",
                                   "-scene.save"},
                                  {{{"output.force"}, {"preview.record"}, "it is only for --record"}});
}

void add_preview_options(CLI::App& command, DeclaredPreview& declared) {
  SceneOptions& shared = declared.options;
  shared.be_live();
  shared.option("molecule.model")->description("Model to show; default: all of them, each a frame");
  shared.option("image.samples")->description("Rays per pixel of exported pictures [4; of scenes 9]");
  shared.option("image.background")
      ->description("A colour (white, grey, #rrggbb), or transparent in exported pictures [white]");
  PropertyOptions options(command);
  PreviewCommand& state = declared.state;
  options.add_parsed("preview.serve", [&state](const std::string& text) { state.port = parse_port(text); });
  options.add("preview.token_file", state.token_file);
  options.add("preview.commands", state.commands);
  options.add("preview.record", state.record);
  options.add("preview.output_folder", state.output_folder);
}

void take_preview(DeclaredPreview& declared, const std::vector<std::string>& named) {
  SceneOptions& options = declared.options;
  options.take(named);
  PreviewCommand& state = declared.state;
  Scene& scene = state.scene;
  require_probe_of_kind(scene.molecule.surface);
  const bool is_scene = !options.file().empty();
  if (!is_scene && !options.is_given("image.background")) scene.image.background = glm::vec3(1.0f);
  state.models =
      !is_scene && !options.is_given("molecule.model") && !scene.frames.asked() && scene.molecule.reading.added.empty();
  state.aims = is_scene || scene.picture.direction || scene.picture.zoom_to || !scene.picture.turns.empty();
  if (is_scene || options.is_given("image.size") || options.is_given("image.width") || options.is_given("image.height"))
    state.wishes.size = scene.picture.size();
  if (is_scene || options.is_given("image.samples")) state.wishes.samples = scene.image.samples;
  state.wishes.transparent = !scene.image.background;
  state.wishes.dots_per_inch = scene.picture.dots_per_inch;
}

}  // namespace meniscus
