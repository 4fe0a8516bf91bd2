// SPDX-License-Identifier: BSD-3-Clause
// Replaces the molecules of scenes in builds without gemmi, nlohmann_json or FreeType. There a scene has only its look
// and its picture.
#include "core/scene/scene_value.h"

namespace meniscus {
namespace {

[[noreturn]] void refuse(const char* what) {
  throw RequestError(fmt::format("this build has no {}: it was made without gemmi, nlohmann_json or FreeType", what));
}

}  // namespace

Selection parse_selection(std::string_view) { refuse("selections"); }
LabelRequest parse_label(std::string_view) { refuse("labels"); }
void parse_scale_bar(const std::string&, AnnotationRequest&) { refuse("scale bars"); }

std::optional<ViewDirection> parse_view_direction(std::string_view) { refuse("sides of molecules"); }
std::vector<std::string> view_direction_words() { return {}; }
std::optional<Turn> parse_turn(std::string_view) { refuse("turns of molecules"); }

bool ColorScheme::uses_scale() const { return has_scale(); }  // rules are not checked

namespace scene_values {

std::span<const SceneValue> molecule_values() { return {}; }
std::span<const SceneValue> surface_values() { return {}; }
void complete_molecule(Scene& scene) {
  if (scene.look.preset > LookPreset::classic) refuse("looks of molecules");
}

}  // namespace scene_values
}  // namespace meniscus
