// SPDX-License-Identifier: BSD-3-Clause
// The preview on a desktop: one function that opens a window and returns when it is closed.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <glm/vec2.hpp>
#include <nlohmann/json.hpp>

#include "app/preview/window/latency.h"
#include "app/preview/window/session_link.h"

namespace meniscus {

struct WindowOptions {
  std::string title = "Meniscus";
  glm::ivec2 size{1280, 960};            ///< of the picture at first, units of the desktop; smaller on a small screen
  std::string kernel_folder{};           ///< as DeviceChoice has it
  std::vector<nlohmann::json> commands;  ///< carried out first, each until its picture is in the window
  /// Gets the reply to each of them; what it throws ends the window.
  std::function<void(std::size_t index, const nlohmann::json& reply)> replied;
};

/// What there is to say when the window is closed.
struct WindowReport {
  ContextDescription context;
  FrameLatency latency;  ///< of the pictures that followed a movement
};

/// Runs until the user leaves or a command says quit; on the main thread. make: called on another one, with the context
/// that is current there. Throws GpuError without a display, EGL or GL 4.5, or when the context is lost, and what
/// `make` throws.
WindowReport run_window(const WindowOptions& options, SessionThread::Make make);

}  // namespace meniscus
