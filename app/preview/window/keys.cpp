// SPDX-License-Identifier: BSD-3-Clause
// Letters are taken as typed, so that they are where the user's keyboard has them.
#include "app/preview/window/keys.h"

#include <algorithm>
#include <cmath>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include "core/color/color_schemes.h"

namespace meniscus {
namespace {

using Json = nlohmann::json;

constexpr double kProbeStep = 0.1;         // Å
constexpr double kUsualOcclusion = 1.0;    // share
constexpr double kUsualSilhouettes = 1.5;  // pixels

constexpr KeyHelp kHelp[] = {
    {"left drag", "turn"},
    {"right drag, middle drag, shift + left drag", "move"},
    {"wheel", "zoom"},
    {"click", "tell about the atom"},
    {"double click", "zoom to the residue"},
    {"r", "show everything"},
    {"o", "orthographic / perspective"},
    {"+  -", "probe radius by 0.1 \xc3\x85"},
    {"1 2 3 ...", "colour scheme"},
    {"k", "colour by kind of patch"},
    {"a", "ambient occlusion"},
    {"s", "silhouettes"},
    {"space", "play / pause"},
    {"left  right", "frame before / after"},
    {"e", "export this view"},
    {"p", "panel"},
    {"h", "this help"},
    {"q  Esc", "leave"},
};

/// A strength of the look, off or as strong as it usually is.
Json flipped_look(const char* key, double usual, const Json& state) {
  return {{"command", "look"}, {key, state["look"].value(key, 0.0) > 0.0 ? 0.0 : usual}};
}

Json probe_by(double step, const Json& state) {
  const double tenths = std::round(state["probe_radius"].get<double>() / kProbeStep + step / kProbeStep);
  return {{"command", "probe"}, {"radius", std::max(0.0, tenths / 10.0)}};
}

std::optional<Json> frame_by(int step, const Json& state) {
  const int count = state["frames"].get<int>();
  if (count < 2) return {};
  return Json{{"command", "frame"}, {"index", (state["frame"].get<int>() + step + count) % count}};
}

std::optional<Json> command_of(char32_t letter, const Json& state) {
  const auto& schemes = offered_schemes();
  if (letter >= U'1' && letter <= U'9' && letter - U'1' < schemes.size())
    return Json{{"command", "color"}, {"scheme", schemes[letter - U'1']}};
  const bool perspective = state["camera"]["projection"] == "perspective";
  switch (letter) {
    case U'r':
      return Json{{"command", "reset_view"}};
    case U'o':
      return Json{{"command", "projection"}, {"projection", perspective ? "orthographic" : "perspective"}};
    case U'+':
      return probe_by(kProbeStep, state);
    case U'-':
      return probe_by(-kProbeStep, state);
    case U'k':
      return Json{{"command", "patch_kinds"}, {"on", !state["patch_kinds"].get<bool>()}};
    case U'a':
      return flipped_look("ambient_occlusion", kUsualOcclusion, state);
    case U's':
      return flipped_look("silhouettes", kUsualSilhouettes, state);
    case U' ':
      if (state["frames"].get<int>() < 2) return {};
      return Json{{"command", state["playing"].get<bool>() ? "pause" : "play"}};
    default:
      return {};
  }
}

std::optional<WindowAction> action_of(char32_t letter) {
  if (letter == U'h' || letter == U'?') return WindowAction::help;
  if (letter == U'p') return WindowAction::panel;
  if (letter == U'e') return WindowAction::export_name;
  if (letter == U'q') return WindowAction::leave;
  return {};
}

}  // namespace

std::span<const KeyHelp> key_help() { return kHelp; }

const std::vector<std::string>& offered_schemes() {
  static const std::vector<std::string> words = [] {
    std::vector<std::string> offered;
    for (const ColorSchemeMetadata& scheme : color_schemes()) {
      using By = ColorScheme::By;
      // Kinds of patch have a switch of their own; parts of the surface and files do not fit a session.
      if (scheme.by != By::kind && scheme.by != By::component && scheme.by != By::file && scheme.by != By::copy)
        offered.emplace_back(scheme.word);
    }
    return offered;
  }();
  return words;
}

KeyMeaning key_meaning(const InputEvent& event, const Json& state) {
  if (event.kind == InputEvent::Kind::text) return {command_of(event.letter, state), action_of(event.letter)};
  if (event.kind != InputEvent::Kind::key) return {};
  if (event.key == GLFW_KEY_ESCAPE) return {{}, WindowAction::leave};
  if (event.key == GLFW_KEY_LEFT) return {frame_by(-1, state), {}};
  if (event.key == GLFW_KEY_RIGHT) return {frame_by(1, state), {}};
  return {};
}

}  // namespace meniscus
