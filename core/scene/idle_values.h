// SPDX-License-Identifier: BSD-3-Clause
// Values of a scene that change nothing, because another one is missing.
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

/// A scene, and which of its values someone chose.
struct GivenScene {
  const Scene& scene;
  std::function<bool(std::string_view key)> is_given;
  bool is_live = false;  ///< the scene changes while it is shown, so that a value may have an effect later

  /// Returns true if any of these keys was given.
  bool any(const std::vector<std::string_view>& keys) const;
};

/// What a value needs: any of some keys, or whatever a function finds in the scene.
struct Condition {
  std::function<bool(const GivenScene& given)> is_met;

  Condition(std::initializer_list<std::string_view> keys);
  template <std::predicate<const GivenScene&> Function>
  Condition(Function function) : is_met(function) {}
};

/// What some values need to have an effect.
struct Need {
  std::vector<std::string_view> keys;
  Condition condition;
  std::string_view missing;  ///< what is not there, and what to do; options are named as in message()
  bool is_refused = false;   ///< numbers or frames would be taken for others
};

/// A sentence about values without effect; of those that are refused it is the message of the error.
struct SceneNote {
  std::string text;  ///< begins with "note: " or "warning: " unless it is refused
  bool is_refused = false;
};

/// Returns a note for each group of values without effect, and for each value that is more likely one of another unit.
/// needs: conditions of the caller, besides those of all scenes.
std::vector<SceneNote> idle_values(const GivenScene& given, std::span<const Need> needs);

}  // namespace meniscus
