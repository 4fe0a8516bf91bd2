// SPDX-License-Identifier: BSD-3-Clause
// Turns options of `meniscus render` into settings of its pictures, and those that scenes share into words that each
// scene parses.
#include "app/commands/render_command.h"

#include <CLI/CLI.hpp>

#include "app/process/program_main.h"
#include "core/base/text.h"
#include "core/scene/scene_json.h"

namespace meniscus {

ImageSettings image_settings(const RenderCommand& command) {
  const Scene& scene = command.scene;
  ImageSettings settings{scene.image.background, command.existing(), scene.look.has_linear_alpha()};
  settings.dots_per_inch = scene.picture.dots_per_inch;
  settings.names_program = command.names_program;
  if (command.provenance) settings.command = command_line();
  if (command.keeps_scene) settings.scene = scene_text(scene, "", *command.added);
  settings.exr.primaries = scene.image.primaries;
  settings.made_of = command.made_of;
  settings.tiff = scene.image.tiff;
  return settings;
}

RenderSettings picture_settings(const RenderCommand& command, const PictureLayout& layout) {
  RenderSettings settings = render_settings(command.scene, layout);
  // Exact times are needed only for pictures with printed times.
  if (command.stats || (!command.scene.frames.is_requested() && !command.reporting.quiet))
    settings.timing = StageTiming::exact;
  return settings;
}

std::vector<std::string> shared_words(const SceneOptions& options, std::span<const std::string_view> but) {
  std::vector<std::string> words;
  for (const Property* property : properties()) {
    if (!options.taken().has(*property) || !options.typed(property->key) ||
        std::ranges::find(but, property->key) != but.end())
      continue;
    const std::string name(property->long_option());
    if (property->type == ValueType::flag) {
      words.push_back(name);
      continue;
    }
    for (const std::string& text : options.typed_texts(*property)) {
      words.push_back(name);
      words.push_back(text);
    }
  }
  return words;
}

SceneCommand read_scene_file(const std::string& path, std::vector<std::string> words, const Reporting& reporting) {
  CLI::App app("", "render");
  DeclaredCommand<RenderCommand> read(app, render_properties());
  read.state.reporting.quiet = true;
  // The scene's own output is not written, so it may exist, and may be read.
  words.insert(words.begin(), {"--scene", path, "-o", "-"});
  std::ranges::reverse(words);
  app.parse(words);
  read.state.reporting.quiet = true;  // an option without effect in one scene may have one in another
  read.options.take();
  SceneCommand command = std::move(static_cast<SceneCommand&>(read.state));
  const PictureOutput& image = command.scene.image;
  if (image.extent || image.aovs || image.cryptomatte || image.primaries != Primaries::rec709)
    throw UsageError(
        "{}: this command shows complete surfaces as sRGB colours; leave image.extent, "
        "image.aovs, image.cryptomatte and image.color_space out",
        escaped(path));
  command.reporting = reporting;
  return command;
}

void make_draft(Scene& scene) {
  ViewRequest& picture = scene.picture;
  // Returns half the size, an even number, as films require.
  const auto half = [](int pixels) { return std::max(2, (pixels / 2 + 1) / 2 * 2); };
  picture.width = half(picture.width);
  picture.height = half(picture.height);
  picture.dots_per_inch /= 2.0;
  constexpr int kLeastLetter = 6;
  LetterStyle& letters = scene.annotations.letters;
  for (std::optional<int>* const height :
       {&letters.all, &letters.labels, &letters.scale_bar, &letters.panel, &scene.legend.style.letters})
    if (*height) *height = std::max(**height / 2, kLeastLetter);
  letters.border /= 2;
  LookRequest& look = scene.look;
  for (std::optional<float>* const width : {&look.silhouettes, &look.outer_lines, &look.inner_lines, &look.part_lines})
    if (*width) *width = **width / 2.0f;
  look.ambient_occlusion_rays.reset();
  scene.image.samples = 1;
}

}  // namespace meniscus
