// SPDX-License-Identifier: BSD-3-Clause
// Dear ImGui in the preview's window: fonts, colours, where a frame begins and ends, and the parts of panels.
#pragma once

#include <array>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

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

/// A line that parts the panel.
void heading(const char* text);
/// Text of a file or the session, never a format.
void plain(const std::string& text);
/// The same in the colour of faults.
void fault(const std::string& text);
/// A name at the left; the next widget is at its right and fills the line.
void label(const char* text);
/// The next widget in the same line, close by.
void same_line();
/// Says more about the widget before, while the mouse is on it.
void tooltip(const std::string& text);
/// A list to choose from; the word chosen now, or nothing.
std::optional<std::string> chosen(const char* id, const std::string& current, const std::vector<std::string>& words);
/// A number of a slider with no more digits than it shows.
double rounded(float value);

/// What a pick says, in up to four lines: atom, residue and chain, kind of patch, exposed area.
std::array<std::string, 4> pick_lines(const nlohmann::json& pick);

/// All keys and gestures, in the middle of the window beside a panel of this width.
void draw_help(float panel);

/// A line of text where the picture will be, until there is one.
void draw_notice(float panel, const std::string& text);

/// Asks there whether unsaved work may be lost: true to close, false to stay; nothing while there is no answer.
std::optional<bool> draw_close_question(float panel);

/// What the mouse points at, as the command "pick" answers; nothing for null or a miss.
void draw_answer(const nlohmann::json& pick);

}  // namespace meniscus
