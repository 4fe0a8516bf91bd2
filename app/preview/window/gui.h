// SPDX-License-Identifier: BSD-3-Clause
// Dear ImGui in the preview's window: its letters, its colours, and where a frame of it begins and ends.
#pragma once

#include "app/preview/window/desktop_window.h"

namespace meniscus {

/// One at a time, while the window's context is current. Between begin() and end() the functions of ImGui may be used.
class Gui {
 public:
  explicit Gui(DesktopWindow& window);
  ~Gui();
  Gui(const Gui&) = delete;
  Gui& operator=(const Gui&) = delete;

  void begin();
  /// Draws over what the window shows.
  void end();

  /// Height of a letter, in the units ImGui counts in; everything else is sized by it.
  float em() const { return em_; }
  /// True if the pointer, or the keyboard, is busy with a widget.
  static bool wants_mouse();
  static bool wants_keyboard();

 private:
  float em_ = 0.0f;
};

}  // namespace meniscus
