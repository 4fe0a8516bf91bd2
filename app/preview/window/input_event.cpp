// SPDX-License-Identifier: BSD-3-Clause
// GLFW names keys by numbers, the table of keys as browsers do.
#include "app/preview/window/input_event.h"

#include <string>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

namespace meniscus {

KeyMeaning event_meaning(const InputEvent& event, const nlohmann::json& state) {
  if (event.kind == InputEvent::Kind::text && event.letter < 0x80)
    return key_meaning(std::string(1, static_cast<char>(event.letter)), state);
  if (event.kind != InputEvent::Kind::key) return {};
  switch (event.key) {
    case GLFW_KEY_ESCAPE:
      return key_meaning("Escape", state);
    case GLFW_KEY_LEFT:
      return key_meaning("ArrowLeft", state);
    case GLFW_KEY_RIGHT:
      return key_meaning("ArrowRight", state);
    case GLFW_KEY_UP:
      return key_meaning("ArrowUp", state);
    case GLFW_KEY_DOWN:
      return key_meaning("ArrowDown", state);
    default:
      return {};
  }
}

}  // namespace meniscus
