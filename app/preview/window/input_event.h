// SPDX-License-Identifier: BSD-3-Clause
// What a user does to a window, one small record each, in the order it was done; and what keys mean.
#pragma once

#include <glm/vec2.hpp>
#include <nlohmann/json.hpp>

#include "app/preview/key_table.h"

namespace meniscus {

enum class MouseButton { left, right, middle };

/// Positions and sizes are in pixels of the picture, from its upper left corner.
struct InputEvent {
  enum class Kind { press, release, move, leave, scroll, text, key, key_up };
  Kind kind = Kind::move;
  glm::dvec2 position{0.0};                ///< of the pointer when it happened
  MouseButton button = MouseButton::left;  ///< press and release
  double scroll = 0.0;                     ///< notches, > 0: away from the user
  char32_t letter = 0;                     ///< as typed on the user's keyboard
  int key = 0;                             ///< GLFW_KEY_...; key: also repeated while it is held
  bool shift = false;
  double time = 0.0;  ///< seconds on the window's clock
};

/// What a typed letter or a pressed key means while the session has this state; nothing for all other keys.
KeyMeaning event_meaning(const InputEvent& event, const nlohmann::json& state);

}  // namespace meniscus
