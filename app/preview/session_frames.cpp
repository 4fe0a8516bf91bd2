// SPDX-License-Identifier: BSD-3-Clause
// The commands of frames: which is shown, how they play, and the camera's keys among them.
#include "app/preview/command_reader.h"
#include "app/preview/session.h"
#include "core/base/error.h"

namespace meniscus {

nlohmann::json PreviewSession::set_frame(const CommandReader& command) {
  show_frame(static_cast<std::size_t>(command.integer("index", 0, static_cast<int>(frame_count()) - 1)));
  return nlohmann::json::object();
}

nlohmann::json PreviewSession::next_frame(const CommandReader&) {
  // A frame that cannot be read is passed over, or playing would never come past it.
  for (std::size_t step = 1;; ++step) {
    try {
      show_frame((view_.frame + step) % frame_count());
      return {{"frame", view_.frame}};
    } catch (const InputError&) {
      if (step >= frame_count()) throw;
    }
  }
}

nlohmann::json PreviewSession::set_key(const CommandReader& command) {
  if (!command.flag_or(true, "on")) {
    view_.keys.erase(view_.frame);
  } else {
    for (const auto& [frame, camera] : view_.keys)
      if (frame != view_.frame && camera.projection != view_.camera.projection)
        throw RequestError("key: all keys of the camera must have one projection, that of the first");
    view_.keys[view_.frame] = view_.camera;
  }
  return {{"keys", view_.keys.size()}};
}

nlohmann::json PreviewSession::follow_keys(const CommandReader& command) {
  view_.follows_keys = command.flag("on");
  show_frame(view_.frame);
  return {{"follow_keys", view_.follows_keys}};
}

nlohmann::json PreviewSession::play(const CommandReader& command) {
  view_.frames_per_second = command.number_or(view_.frames_per_second, "fps", 0.1, 240.0);
  view_.playing = frame_count() > 1;
  return {{"playing", view_.playing}};
}

nlohmann::json PreviewSession::pause(const CommandReader& command) {
  view_.frames_per_second = command.number_or(view_.frames_per_second, "fps", 0.1, 240.0);
  view_.playing = false;
  return {{"playing", false}};
}

}  // namespace meniscus
