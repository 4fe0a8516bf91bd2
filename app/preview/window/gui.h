// SPDX-License-Identifier: BSD-3-Clause
// Dear ImGui in the preview's window: its letters, its colours, and where a frame of it begins and ends.
#pragma once

#include <array>
#include <deque>
#include <map>
#include <string>

#include "app/preview/window/desktop_window.h"

namespace meniscus {

/// One at a time, while the window's context is current. Between begin() and end() the functions of ImGui may be used.
class Gui {
 public:
  static constexpr float kLetterHeight = 15.0f;  ///< pixels on an ordinary screen

  explicit Gui(DesktopWindow& window);
  ~Gui();
  Gui(const Gui&) = delete;
  Gui& operator=(const Gui&) = delete;

  /// To be handed on to the widgets, in this order.
  void take(const InputEvent& event) { waiting_.push_back(event); }
  /// Hands on as much of it as one frame can tell apart: a key that goes down and up in one frame would not be seen.
  void begin();
  /// Draws over what the window shows. True if another frame is needed for what still waits.
  bool end();

  /// Height of a letter, in the units ImGui counts in; everything else is sized by it.
  float em() const { return em_; }
  /// True while a list hangs open, which may lie over the picture.
  static bool list_open();
  void close_lists() { lists_close_ = true; }
  /// True while a field is typed into.
  static bool typing();

  /// Keeps where the widget that was drawn last has its corners, until the next frame begins; if its middle is in
  /// sight.
  static void mark(const std::string& name);
  /// Left, top, right and bottom of marked widgets, pixels of the window.
  const std::map<std::string, std::array<double, 4>>& places() const { return places_; }

 private:
  void hand_on();

  DesktopWindow& window_;
  std::deque<InputEvent> waiting_;
  std::array<bool, 3> held_{};  // buttons, as handed on
  glm::dvec2 pointer_{0.0};     // ImGui's units, as handed on
  bool inside_ = false;
  bool lists_close_ = false;
  std::map<std::string, std::array<double, 4>> places_;
  float em_ = 0.0f;
};

}  // namespace meniscus
