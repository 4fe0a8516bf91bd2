// SPDX-License-Identifier: BSD-3-Clause
// A window on the desktop with a GL 4.5 context in it, and its events since the last call.
#pragma once

#include <string>
#include <vector>

#include <glm/vec2.hpp>

#include "app/preview/window/gestures.h"
#include "core/gpu/egl_context.h"

struct GLFWwindow;

namespace meniscus {

/// One at a time, on the main thread. Its context is current there.
class DesktopWindow {
 public:
  /// size: in the desktop's units, which are pixels unless it scales; less on a small screen. Throws GpuError without a
  /// display, EGL, or GL 4.5.
  DesktopWindow(const std::string& title, glm::ivec2 size);
  ~DesktopWindow();
  DesktopWindow(const DesktopWindow&) = delete;
  DesktopWindow& operator=(const DesktopWindow&) = delete;

  /// Waits until something happens or someone calls wake(): true; or until the time is over. 0 only looks.
  bool wait(double seconds);
  /// May be called from any thread.
  static void wake();
  std::vector<InputEvent> take_events();
  /// Shows what was drawn. Throws GpuError if the driver has lost the context.
  void swap();

  void close();
  /// It is not to be closed after all.
  void stay();
  void hide();
  bool closing() const;
  glm::ivec2 pixels() const;  ///< 0 while minimised
  glm::dvec2 pixels_per_unit() const;
  double scale() const;    ///< how much larger than on an ordinary screen letters should be
  double seconds() const;  ///< since the start of the program
  const ContextDescription& context() const { return context_; }
  ForeignContext gl(const std::string& kernel_folder) const {
    return {gl_.display, gl_.context, gl_.reports_resets, kernel_folder};
  }
  GLFWwindow* glfw() { return window_; }

 private:
  void listen();
  InputEvent& add_event(InputEvent::Kind kind);

  GLFWwindow* window_ = nullptr;
  ContextDescription context_;
  ForeignContext gl_;
  std::vector<InputEvent> events_;
  glm::dvec2 pointer_{0.0};
};

}  // namespace meniscus
