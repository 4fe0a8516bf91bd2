// SPDX-License-Identifier: BSD-3-Clause
// Turns drags, the wheel, clicks and keys into commands, without inertia.
#include "app/preview/window/gestures.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <glm/geometric.hpp>

#include "app/preview/command_json.h"

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

namespace {

constexpr double kSlack = 3.0;                // pixels; a hand that clicks moves that much
constexpr double kDoubleClickSeconds = 0.35;  // between two clicks
constexpr double kZoomPerNotch = 1.1;

void add(nlohmann::json command, std::vector<nlohmann::json>& commands) {
  if (commands.empty() || !merge_commands(commands.back(), command)) commands.push_back(std::move(command));
}

}  // namespace

void Gestures::take(const InputEvent& event, glm::ivec2 size, bool elsewhere, std::vector<nlohmann::json>& commands) {
  click_.reset();
  switch (event.kind) {
    case InputEvent::Kind::press:
      if (!elsewhere && !held_) press(event);
      break;
    case InputEvent::Kind::release:
      if (held_ && held_->button == event.button) release(event);
      break;
    case InputEvent::Kind::move:
      if (held_) move(event, size, commands);
      break;
    case InputEvent::Kind::scroll:
      if (!elsewhere && event.scroll != 0.0)
        add({{"command", "zoom"},
             {"factor", std::pow(kZoomPerNotch, event.scroll)},
             {"x", std::clamp(std::floor(event.position.x), 0.0, size.x - 1.0)},
             {"y", std::clamp(std::floor(event.position.y), 0.0, size.y - 1.0)}},
            commands);
      break;
    default:
      break;
  }
}

void Gestures::press(const InputEvent& event) {
  held_ = Hold{event.button, event.shift || event.button != MouseButton::left, event.position, event.position};
}

void Gestures::release(const InputEvent& event) {
  if (!held_->moved && event.button == MouseButton::left) {
    const bool twice = last_click_ && event.time - last_click_->time < kDoubleClickSeconds &&
                       glm::distance(event.position, last_click_->position) <= 2.0 * kSlack;
    click_ = Click{event.position, twice};
    last_click_.reset();
    if (!twice) last_click_ = event;
  }
  held_.reset();
}

void Gestures::move(const InputEvent& event, glm::ivec2 size, std::vector<nlohmann::json>& commands) {
  held_->moved |= glm::distance(event.position, held_->start) > kSlack;
  if (!held_->moved) return;
  const glm::dvec2 drag = (event.position - held_->last) / static_cast<double>(size.y);
  add({{"command", held_->pan ? "pan" : "orbit"}, {"dx", drag.x}, {"dy", drag.y}}, commands);
  held_->last = event.position;
}

}  // namespace meniscus
