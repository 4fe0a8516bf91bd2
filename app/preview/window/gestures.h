// SPDX-License-Identifier: BSD-3-Clause
// The mouse over the picture, as commands: drag, wheel and clicks, without inertia.
#pragma once

#include <optional>
#include <vector>

#include <glm/vec2.hpp>
#include <nlohmann/json.hpp>

#include "app/preview/window/input_event.h"

namespace meniscus {

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
