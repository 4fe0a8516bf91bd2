// SPDX-License-Identifier: BSD-3-Clause
// User input in a window, one record per event, and what keys and the mouse over the picture mean as commands.
#pragma once

#include <optional>
#include <vector>

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

/// A button that went down and up in one place.
struct Click {
  glm::dvec2 position{0.0};  ///< pixels
  bool twice = false;        ///< the second of a double click
};

/// Left drag turns, right, middle or shift drag pans, the wheel zooms. A drag that began in the picture is followed
/// wherever it goes.
class Gestures {
 public:
  /// size: of the picture, pixels. The event is over the picture unless `elsewhere`. What it means is added to
  /// `commands`; movements that follow each other become one.
  void take(const InputEvent& event, glm::ivec2 size, bool elsewhere, std::vector<nlohmann::json>& commands);

  /// The click that the last event ended, if it ended one.
  std::optional<Click> click() const { return click_; }
  bool dragging() const { return held_.has_value(); }

 private:
  struct Hold {
    MouseButton button;
    bool pan;
    glm::dvec2 start, last;
    bool moved = false;
  };

  void press(const InputEvent& event);
  void release(const InputEvent& event);
  void move(const InputEvent& event, glm::ivec2 size, std::vector<nlohmann::json>& commands);

  std::optional<Hold> held_;
  std::optional<Click> click_;
  std::optional<InputEvent> last_click_;
};

}  // namespace meniscus
