// SPDX-License-Identifier: BSD-3-Clause
// The column beside the picture: what can be changed, what was picked, how long a frame takes.
#pragma once

#include <array>
#include <string>

#include <nlohmann/json.hpp>

#include "app/preview/window/export_question.h"
#include "app/preview/window/figure_panel.h"
#include "app/preview/window/session_link.h"

namespace meniscus {

/// Lives between Gui frames; draw() belongs between Gui::begin and Gui::end.
class Panel {
 public:
  explicit Panel(SessionLink& link) : link_(link), figure_(link) {}

  /// Fills the right edge of the window. em: height of a letter.
  void draw(float em);
  static float width(float em) { return 20.0f * em; }

  /// An atom to tell about, as the command "pick" answers.
  void show_pick(const nlohmann::json& pick) { pick_ = pick; }
  /// The answer to a command for which a line should stand in the panel: a fault, or where an export went. time: of the
  /// window, seconds.
  void show_reply(const SessionReply& reply, double time);
  ExportQuestion& exporting() { return exporting_; }
  /// Puts the cursor into the field for the name of an export.
  void ask_for_name() { name_wanted_ = true; }

 private:
  void widgets();
  void title();
  void surface();
  void coloring();
  void view();
  void look();
  void strength(const nlohmann::json& slider);
  void light();
  void frames();
  void exports();
  void picked();
  void picture_wishes();
  void take_wishes();
  void progress();
  nlohmann::json wished(nlohmann::json command) const;
  void timing();
  void status();

  SessionLink& link_;
  FigurePanel figure_;
  nlohmann::json pick_ = nlohmann::json::object();
  std::string selection_;
  std::string name_ = "view";
  int format_ = 0;
  bool replace_ = false, transparent_ = false;
  int samples_ = 0, width_ = 0, height_ = 0;  ///< of an exported picture; 0: as shown
  nlohmann::json wishes_;                     ///< of the session, as they were taken last
  ExportQuestion exporting_;
  bool name_wanted_ = false;
  std::string line_;  ///< about the last export or fault
  bool line_is_fault_ = false;
};

/// What a pick says, in up to four lines: atom, residue and chain, kind of patch, exposed area.
std::array<std::string, 4> pick_lines(const nlohmann::json& pick);

/// How long the last picture took, as the command "stats" answers; how many a second only while it moves.
std::string timing_line(const nlohmann::json& stats, bool full);

}  // namespace meniscus
