// SPDX-License-Identifier: BSD-3-Clause
// Finds options that have no effect because another one is missing, by a table of what each needs.
#include "app/options/idle_options.h"

#include <algorithm>
#include <cctype>
#include <initializer_list>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "app/film/film_format.h"
#include "app/process/program_error.h"
#include "core/base/parse_number.h"
#include "core/properties/properties.h"
#include "core/render/look.h"
#include "core/scene/scene_values.h"

namespace meniscus {
namespace {

/// A command whose options are parsed, as the table asks about it.
class Asked {
 public:
  explicit Asked(const TakenOptions& options) : options_(options), command_(options.command) {}

  bool has(const char* option) const { return command_.get_option_no_throw(option) != nullptr; }
  /// Was it given, by the command line or the scene?
  bool given(const char* option) const {
    const CLI::Option* const found = command_.get_option_no_throw(option);
    if (found && found->count() > 0) return true;
    const Property* const property = has(option) ? scene_property(option) : nullptr;
    return property && options_.is_given(property->key);
  }
  bool any(std::initializer_list<const char*> options) const {
    return std::ranges::any_of(options, [&](const char* option) { return given(option); });
  }
  /// The value that counts; empty if there is none.
  std::string value(const char* option) const {
    if (!given(option)) return "";
    if (const CLI::Option* const found = command_.get_option_no_throw(option); found->count() > 0)
      return found->results().back();
    const std::vector<std::string> texts = value_texts(options_.scene, *scene_property(option));
    return texts.empty() ? "" : texts.back();
  }
  const std::string& name() const { return command_.get_name(); }

  bool is_run() const { return options_.scene.frames.asked(); }
  bool is_film() const { return is_film_path(value("--output")); }

  Look look() const { return look_of(options_.scene.look, {1, 1}, std::nullopt, Hues::free); }
  /// Colours are not simply those given. Objects may have a material of their own.
  bool is_shaded() const { return given("--object") || look().material.ambient < 1.0f; }
  bool has_highlights() const { return given("--object") || look().material.specular > 0.0f; }

 private:
  static const Property* scene_property(std::string_view option) {
    for (const Property* property : properties())
      if (property->long_option() == option && is_scene_value(*property)) return property;
    return nullptr;
  }

  const TakenOptions& options_;
  const CLI::App& command_;
};

/// What some options need to do anything.
struct Need {
  std::vector<const char*> options;
  bool (*is_met)(const Asked&);
  const char* missing;  ///< a sentence that says what is not there, and what to do
  bool is_refused = false;
};

bool has_legend(const Asked& asked) { return asked.any({"--legend", "--legend-file"}); }

bool ends_as(const std::string& path, std::initializer_list<std::string_view> endings) {
  return std::ranges::any_of(endings, [&](std::string_view ending) { return path.ends_with(ending); });
}

const std::vector<Need>& needs() {
  static const std::vector<Need> kNeeds{
      {{"--trajectory-atoms", "--trust-atom-order", "--select-once", "--whole", "--superpose", "--center",
        "--reference", "--smooth", "--camera-path", "--turntable", "--follow", "--time-stamp", "--curve",
        "--csv-series", "--csv-cavities", "--plot"},
       [](const Asked& asked) { return !asked.has("--stride") || asked.is_run(); },
       "there is no run of frames; add --trajectory FILE, --frames all for the models of FILE, or --repeat N to show "
       "one molecule N times",
       true},
      {{"--min-patch", "--patch-lines", "--patch-line-color"},
       [](const Asked& asked) { return asked.given("--patches") || asked.name() == "preview"; },
       "there are no patches; add --patches EXPR"},
      {{"--patches"},
       [](const Asked& asked) {
         return !asked.has("--csv-patches") || !asked.is_run() || asked.any({"--csv-patches", "--json"});
       },
       "of a run, patches are written by --csv-patches FILE or --json; add one of them"},
      {{"--jobs", "--progress"},
       [](const Asked& asked) { return !asked.has("--stride") || asked.is_run(); },
       "there is no run of frames"},
      {{"--reference"},
       [](const Asked& asked) {
         return asked.any({"--superpose", "--center"});
       },
       "it is the frame that --superpose and --center refer to; add one of them",
       true},
      {{"--trajectory-atoms", "--trust-atom-order"},
       [](const Asked& asked) { return asked.given("--trajectory"); },
       "the frames are models of FILE itself; add --trajectory FILE",
       true},
      {{"--superpose", "--center", "--reference"},
       [](const Asked& asked) {
         if (asked.name() == "pockets") return asked.any({"--csv", "--json"});
         return asked.name() != "surface" || asked.any({"--csv-cavities", "--gradients"});
       },
       "areas and volumes stay the same however a frame is turned and moved; places and gradients, which are written "
       "to "
       "files, do not"},
      {{"--open-sky"},
       [](const Asked& asked) { return asked.given("--csv"); },
       "it is a column of --csv FILE; add that"},
      {{"--codec", "--crf", "--bits", "--chroma"},
       [](const Asked& asked) { return !asked.has("--samples") || asked.is_film(); },
       "the output is not a film; name one, such as -o a.mp4",
       true},
      {{"--fps"},
       [](const Asked& asked) {
         if (asked.has("--hold") || asked.has("--density")) return true;
         return asked.has("--samples") ? asked.is_film() : !asked.has("--stride") || asked.is_run();
       },
       "the output is not a film"},
      {{"--fps"},
       [](const Asked& asked) {
         if (!asked.has("--density")) return true;
         return asked.is_run() && (ends_as(asked.value("--output"), {".usd", ".usda", ".usdz"}) ||
                                   asked.value("--format").starts_with("usd"));
       },
       "of meshes USD alone has times; name a file of a run, such as -o a.usda"},
      {{"--preset", "--specular", "--shininess"},
       [](const Asked& asked) {
         const std::string format = asked.value("--format");
         return !asked.has("--density") || ends_as(asked.value("--output"), {".usd", ".usda", ".usdz", ".glb"}) ||
                format.starts_with("usd") || format == "glb";
       },
       "of meshes USD and GLB alone have materials; name a file of one of them, such as -o a.usda"},
      {{"--film-opacity", "--patches"},
       [](const Asked& asked) { return !asked.given("--hide-surface"); },
       "the surface is hidden, and shapes beside it are no films, and have no patches"},
      {{"--clip"},
       [](const Asked& asked) { return !asked.given("--hide-surface") || asked.given("--clip-all"); },
       "the surface is hidden; add --clip-all to cut what is beside it"},
      {{"--cap-color", "--cap-hatching", "--clip-all"},
       [](const Asked& asked) {
         return asked.any({"--clip", "--look-into"});
       },
       "nothing is cut; add --clip PLANE"},
      {{"--film-opacity"},
       [](const Asked& asked) { return asked.given("--opacity"); },
       "all of the surface is opaque; add --opacity"},
      {{"--stick-radius"},
       [](const Asked& asked) {
         return asked.any({"--sticks", "--balls", "--bases", "--glycans"});
       },
       "there are no sticks; add --sticks EXPR, --balls EXPR or --bases EXPR"},
      {{"--tube-radius"},
       [](const Asked& asked) { return asked.given("--tube"); },
       "there is no tube; add --tube EXPR"},
      {{"--legend-title", "--legend-size", "--legend-place", "--legend-name"},
       has_legend,
       "there is no legend; add --legend"},
      {{"--letter-size", "--letter-color"},
       [](const Asked& asked) {
         return has_legend(asked) || asked.name() == "preview" ||
                asked.any({"--label", "--scale-bar", "--panel", "--title", "--time-stamp", "--curve"});
       },
       "there are no letters in the picture; add --legend, --label, --scale-bar or --panel"},
      {{"--color-title", "--color-unit"},
       [](const Asked& asked) { return has_legend(asked) || asked.name() == "preview"; },
       "they name the scale of a legend, and there is none"},
      {{"--light", "--light-strength"},
       [](const Asked& asked) { return asked.is_shaded() || asked.has_highlights() || asked.look().shadows > 0.0f; },
       "with --ambient 1, as --preset flat has it, colours are exactly those given; add a smaller --ambient"},
      {{"--roughness"},
       [](const Asked& asked) { return asked.is_shaded(); },
       "with --ambient 1, as --preset flat has it, nothing is shaded; add a smaller --ambient"},
      {{"--shininess"},
       [](const Asked& asked) { return asked.has_highlights(); },
       "there are no highlights; add --specular"},
      {{"--shadow-softness"},
       [](const Asked& asked) { return asked.look().shadows > 0.0f; },
       "there are no shadows; add --shadows"},
      {{"--ambient-occlusion-radius", "--ambient-occlusion-rays"},
       [](const Asked& asked) { return asked.look().ambient_occlusion > 0.0f; },
       "no shade is cast; add --ambient-occlusion"},
      {{"--linear-alpha"},
       [](const Asked& asked) {
         if (asked.has("--serve")) return true;  // pictures are exported later
         const std::string ground = asked.value("--background");
         return (ground.empty() || ground == "transparent") &&
                ends_as(asked.value("--output"), {".png", ".tif", ".tiff"});
       },
       "it is for the edges of transparent .png and .tif pictures"},
      {{"--dpi"},
       [](const Asked& asked) {
         return asked.has("--samples") || asked.any({"--width", "--height"});
       },
       "the size is in pixels; add --width or --height with a length, such as 85mm"},
      {{"--size", "--width", "--height", "--projection", "--view", "--turn", "--zoom-to", "--camera"},
       [](const Asked& asked) {
         if (asked.name() != "mesh" && asked.name() != "ply") return true;
         return asked.given("--tolerance-pixels") ||
                (asked.name() == "mesh" && asked.given("--camera") && !asked.any({"--tolerance", "--density"}));
       },
       "a mesh has no picture; they matter for --tolerance-pixels alone"},
      {{"--width", "--height"},
       [](const Asked& asked) {
         return asked.name() != "mvs" || !asked.given("--tolerance") ||
                (asked.given("--width") && asked.given("--height"));
       },
       "viewers choose the size, and --tolerance says how fine the mesh is"},
      {{"--show"},
       [](const Asked& asked) { return asked.name() != "pockets" || asked.given("--figure"); },
       "it says what --figure shows; --select takes some of the atoms"},
      {{"--tolerance"},
       [](const Asked& asked) { return asked.name() != "pockets" || asked.given("--mesh"); },
       "it is that of a mesh; add --mesh FILE"},
      {{"--unknown-element"},
       [](const Asked& asked) { return asked.name() != "info"; },
       "all atoms are listed, with a guessed radius where the element is unknown"},
      {{"--force"},
       [](const Asked& asked) { return asked.name() != "preview" || asked.given("--record"); },
       "it is only for --record"}};
  return kNeeds;
}

bool has_unit(const std::string& text) {
  return !text.empty() && std::isalpha(static_cast<unsigned char>(text.back()));
}

/// A value that is possible, and more likely one of another unit.
void add_unlikely_values(const Asked& asked, std::vector<std::string>& sentences) {
  constexpr double kSmallestUsualProbe = 0.5, kSmallestUsualSide = 200.0;  // Å, pixels
  double number = 0.0;
  if (const std::string probe = asked.value("--probe");
      parse_number(probe, number) && number > 0.0 && number < kSmallestUsualProbe)
    sentences.push_back(
        fmt::format("warning: --probe {} is in Å, and no solvent is so small; {} nm would be --probe {:g}", probe,
                    probe, 10.0 * number));
  for (const char* const side : {"--width", "--height"}) {
    const std::string length = asked.value(side);
    if (!has_unit(length) && parse_number(length, number) && number < kSmallestUsualSide)
      sentences.push_back(
          fmt::format("warning: {} {} is in pixels, which makes a small picture; in millimetres it is {} {}mm", side,
                      length, side, length));
  }
}

}  // namespace

std::vector<std::string> idle_options(const TakenOptions& options) {
  const Asked asked(options);
  std::vector<std::string> sentences;
  for (const Need& need : needs()) {
    std::vector<std::string_view> idle;
    for (const char* const option : need.options)
      if (asked.given(option)) idle.emplace_back(option);
    if (idle.empty() || need.is_met(asked)) continue;
    const std::string sentence =
        fmt::format("{} {} no effect: {}", fmt::join(idle, ", "), idle.size() == 1 ? "has" : "have", need.missing);
    if (need.is_refused) throw UsageError(sentence);
    sentences.push_back("note: " + sentence);
  }
  add_unlikely_values(asked, sentences);
  return sentences;
}

}  // namespace meniscus
