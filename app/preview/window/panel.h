// SPDX-License-Identifier: BSD-3-Clause
// The column beside the picture: the controls, what was picked, and the time of a frame.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "app/preview/window/export_panel.h"
#include "app/preview/window/figure_panel.h"
#include "app/preview/window/session_link.h"

namespace meniscus {

/// Lives between Gui frames; draw() belongs between Gui::begin and Gui::end.
class Panel {
 public:
  explicit Panel(SessionLink& link) : link_(link), figure_(link), exports_(link) {}

  /// Fills the right edge of the window. em: height of a letter.
  void draw(float em);
  static float width(float em) { return 20.0f * em; }

  /// An atom to tell about, as the command "pick" answers.
  void show_pick(const nlohmann::json& pick) { pick_ = pick; }
  ExportPanel& exports() { return exports_; }
  const ExportPanel& exports() const { return exports_; }

 private:
  void widgets();
  void title();
  void surface();
  void coloring();
  void view();
  void strip();
  void look();
  void strength(const nlohmann::json& slider);
  void light();
  void frames();
  void picked();
  void timing();
  void status();

  SessionLink& link_;
  FigurePanel figure_;
  ExportPanel exports_;
  nlohmann::json pick_ = nlohmann::json::object();
  std::string selection_;
  float write_height_ = 0.0f;  ///< of what writes, as it was drawn last
};

/// What the session is doing, and for how long.
std::string working_line(const SessionLink& link);

/// How long the last picture took, as the command "stats" answers; how many a second only while it moves.
std::string timing_line(const nlohmann::json& stats, bool full);

}  // namespace meniscus
