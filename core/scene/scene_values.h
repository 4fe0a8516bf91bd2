// SPDX-License-Identifier: BSD-3-Clause
// The values of a scene by the keys of their properties, as text: what command lines, scene files and previews set, and
// which of them change nothing.
#pragma once

#include <concepts>
#include <initializer_list>

#include "core/base/error.h"
#include "core/properties/presets.h"
#include "core/properties/properties.h"
#include "core/scene/scene.h"

namespace meniscus {

/// The error of a value that a property cannot have, or that contradicts another one. It says what is wrong, but not
/// where the value was given: the command line adds the option, a scene file the place.
class ValueError : public RequestError {
 public:
  ValueError(std::string_view property_key, const std::string& what) : RequestError(what), key_(property_key) {}
  std::string_view key() const { return key_; }

 private:
  std::string key_;
};

/// True if scenes have a value of this property. Properties of a command alone, such as overwriting, do not count.
bool is_scene_value(const Property& property);

/// Returns the name of a property in programs: its option without leading dashes, and with "_" for other dashes:
/// "depth_cue".
std::string value_name(const Property& property);
/// Returns the property of a scene that has this name or key, "depth_cue" or "look.depth_cue". Throws RequestError that
/// proposes the nearest name.
const Property& scene_property(std::string_view name);

/// Sets a value. The property must be one of scenes (is_scene_value). `texts` has one text or, for repeatable
/// properties, any number, which are added to the values of the scene. A flag is "true" or "false". An option that was
/// given without its value (value_optional) is "". Throws ValueError for a text that the property cannot have, and
/// SelectionError.
void set_value(Scene& scene, const Property& property, std::span<const std::string> texts);

/// Returns the texts from which set_value() reads the scene's value, to the last bit; empty if it is that of Scene{}.
std::vector<std::string> value_texts(const Scene& scene, const Property& property);

/// The looks that follow the lights of LookPreset in the table of presets.
inline constexpr LookPreset kGhost{5}, kGoodsell{6}, kPocket{7}, kRibbon{8};
inline const Preset& preset_of(LookPreset look) { return kPresets[static_cast<std::size_t>(look)]; }
/// Replaces a preset that has settings by them and by its light. Values of the scene have priority: entries of its
/// lists follow the entries of the preset, and other values, its cuts too, replace values of the preset.
void take_preset(Scene& scene);

/// Completes a scene after all values are set. A preset becomes its light and its settings. Lengths on paper become
/// pixels. If molecule.color is not set, the numbers of a number file colour all atoms. The sides of an interface are
/// coloured by their buried areas and face the viewer. Completing a scene again changes nothing. Throws ValueError for
/// values that contradict each other.
void complete(Scene& scene);

/// Returns a copy of a completed scene for reading and computing: its molecule also has the atoms that are drawn in
/// addition to the surface, and of an interface only the atoms of both sides. The copy must not be saved, because a
/// saved copy would have a selection that the user did not choose. Throws ValueError if something else is to be drawn
/// with an interface.
Scene prepared_scene(Scene scene);

/// A scene, and a function that says which of its values were given.
struct GivenScene {
  const Scene& scene;
  std::function<bool(std::string_view key)> is_given;
  bool is_live = false;  ///< the scene changes while it is shown, so that a value may have an effect later

  /// Returns true if any of these keys was given.
  bool any(const std::vector<std::string_view>& keys) const;
};

/// A condition that is met if a value of some keys was given, or if a function of the scene returns true.
struct Condition {
  std::function<bool(const GivenScene& given)> is_met;

  Condition(std::initializer_list<std::string_view> keys);
  template <std::predicate<const GivenScene&> Function>
  Condition(Function function) : is_met(function) {}
};

/// A condition without which some values have no effect.
struct Need {
  std::vector<std::string_view> keys;
  Condition condition;
  std::string_view missing;  ///< says what is missing and what to add; names options as message() does
  bool is_refused = false;   ///< true if a user would take the result for another one
};

/// A sentence about values without effect. It is the message of an error if they are refused.
struct SceneNote {
  std::string text;  ///< begins with "note: " or "warning: " unless it is refused
  bool is_refused = false;
};

/// Returns a note for each group of values without effect, and for each value that is more likely one of another unit.
/// needs: conditions of the caller, in addition to the conditions of all scenes.
std::vector<SceneNote> ineffective_values(const GivenScene& given, std::span<const Need> needs);

}  // namespace meniscus
