// SPDX-License-Identifier: BSD-3-Clause
// The keys of a preview: letters are matched as typed, in either case, so that they follow the user's keyboard.
#include "app/preview/key_table.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "core/color/color_schemes.h"

namespace meniscus {
namespace {

using Json = nlohmann::json;

constexpr double kProbeStep = 0.1;    // Å
constexpr double kTurn = 1.0 / 36.0;  // heights of the picture: five degrees
constexpr double kZoom = 1.1;
constexpr double kUsualOcclusion = 1.0;    // share
constexpr double kUsualSilhouettes = 1.5;  // pixels

/// Keys of the program. Those that pages have, too, are in the stage's own list (exporters/page/page/page.html).
constexpr KeyHelp kHelp[] = {
    {"Z  Y", "undo, redo"},
    {"[  ]", "probe radius by 0.1 \xc3\x85"},
    {"1 2 3 ...", "colour scheme"},
    {"K", "colour by kind of patch"},
    {"A", "shade"},
    {"L", "lines"},
    {"G", "legend in pictures"},
    {"E", "name what is written"},
};

Json turned(double dx, double dy) { return {{"command", "orbit"}, {"dx", kTurn * dx}, {"dy", kTurn * dy}}; }

Json setting(std::string_view key, Json value) {
  return {{"command", "set"}, {"key", key}, {"value", std::move(value)}};
}

/// A strength of the look, off or as strong as it usually is.
Json flipped_look(const std::string& name, double usual, const Json& state) {
  return setting("look." + name, state["look"].value(name, 0.0) > 0.0 ? 0.0 : usual);
}

/// Another scheme, with the rules that there are.
Json with_scheme(const std::string& scheme, const Json& state) {
  Json value = state["color"].value("rules", Json::array());
  value.insert(value.begin(), scheme);
  return setting("surface.color", std::move(value));
}

std::optional<Json> probe_by(double step, const Json& state) {
  if (state.value("surface", "") == "vdw") return {};
  const double tenths = std::round(state["probe_radius"].get<double>() / kProbeStep + step / kProbeStep);
  return setting("surface.probe", std::max(0.0, tenths / 10.0));
}

std::optional<Json> frame_by(int step, const Json& state) {
  const int count = state["frames"].get<int>();
  if (count < 2) return {};
  return Json{{"command", "frame"}, {"index", (state["frame"].get<int>() + step + count) % count}};
}

std::optional<Json> motion_of(std::string_view key) {
  if (key == "ArrowLeft") return turned(-1.0, 0.0);
  if (key == "ArrowRight") return turned(1.0, 0.0);
  if (key == "ArrowUp") return turned(0.0, -1.0);
  if (key == "ArrowDown") return turned(0.0, 1.0);
  if (key == "+" || key == "=") return Json{{"command", "zoom"}, {"factor", kZoom}};
  if (key == "-") return Json{{"command", "zoom"}, {"factor", 1.0 / kZoom}};
  return {};
}

/// ASCII alone, whatever the locale.
std::string in_small_letters(std::string_view key) {
  std::string small(key);
  if (key.size() == 1 && key[0] >= 'A' && key[0] <= 'Z') small[0] = static_cast<char>(key[0] - 'A' + 'a');
  return small;
}

std::optional<Json> command_of(char letter, const Json& state) {
  const auto& schemes = numbered_schemes();
  if (letter >= '1' && letter <= '9' && static_cast<std::size_t>(letter - '1') < schemes.size())
    return with_scheme(schemes[static_cast<std::size_t>(letter - '1')], state);
  const bool perspective = state["camera"]["projection"] == "perspective";
  switch (letter) {
    case 'r':
      return Json{{"command", "reset_view"}};
    case 'z':
      if (state.value("undo", 0) == 0) return {};
      return Json{{"command", "undo"}};
    case 'y':
      if (state.value("redo", 0) == 0) return {};
      return Json{{"command", "redo"}};
    case 'o':
      return setting("camera.projection", perspective ? "orthographic" : "perspective");
    case ']':
      return probe_by(kProbeStep, state);
    case '[':
      return probe_by(-kProbeStep, state);
    case 'k':
      return setting("surface.color", state["patch_kinds"].get<bool>() ? "auto" : "kind");
    case 'a':
      return flipped_look("ambient_occlusion", kUsualOcclusion, state);
    case 'l':
      return flipped_look("silhouettes", kUsualSilhouettes, state);
    case 'g':
      return setting("legend.shown", !state["legend"].value("on", false));
    case ' ':
      if (state["frames"].get<int>() < 2) return {};
      return Json{{"command", state["playing"].get<bool>() ? "pause" : "play"}};
    case ',':
      return frame_by(-1, state);
    case '.':
      return frame_by(1, state);
    default:
      return {};
  }
}

constexpr FaceKey kFaceKeys[] = {
    {"h", FaceAction::help},
    {"?", FaceAction::help},
    {"p", FaceAction::panel},
    {"e", FaceAction::export_name},
};

std::optional<FaceAction> action_of(std::string_view key) {
  const auto known = std::ranges::find(kFaceKeys, key, &FaceKey::key);
  return known == std::end(kFaceKeys) ? std::nullopt : std::optional(known->action);
}

}  // namespace

std::string_view face_action_word(FaceAction action) {
  constexpr std::string_view kWords[] = {"help", "panel", "export"};
  return kWords[static_cast<std::size_t>(action)];
}

std::span<const KeyHelp> key_help() { return kHelp; }

std::span<const FaceKey> face_keys() { return kFaceKeys; }

const std::vector<std::string>& numbered_schemes() {
  static const std::vector<std::string> words = [] {
    std::vector<std::string> offered;
    for (const ColorSchemeMetadata& scheme : color_schemes()) {
      using By = ColorScheme::By;
      // Kinds of patch have a key of their own; the others are not there for every molecule.
      if (scheme.by != By::automatic && scheme.by != By::kind && scheme.by != By::component && scheme.by != By::file &&
          scheme.by != By::copy && scheme.by != By::model && scheme.by != By::volume && scheme.by != By::buried &&
          scheme.by != By::rmsf && scheme.by != By::accessibility)
        offered.emplace_back(scheme.word);
    }
    return offered;
  }();
  return words;
}

KeyMeaning key_meaning(std::string_view typed, const Json& state) {
  const std::string key = in_small_letters(typed);
  if (std::optional<Json> motion = motion_of(key)) return {std::move(motion), {}};
  return {key.size() == 1 ? command_of(key.front(), state) : std::nullopt, action_of(key)};
}

}  // namespace meniscus
