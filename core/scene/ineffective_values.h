// SPDX-License-Identifier: BSD-3-Clause
// Finds values of a scene that change nothing, because another one is missing.
#pragma once

#include <concepts>
#include <functional>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/scene/scene.h"

namespace meniscus {

/// A scene, and a function that tells which of its values were given.
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
