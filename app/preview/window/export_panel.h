// SPDX-License-Identifier: BSD-3-Clause
// The part of the panel that exports: what to write, its name, its size, and the progress.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "app/preview/window/session_link.h"

namespace meniscus {

/// draw() belongs into the panel.
class ExportPanel {
 public:
  explicit ExportPanel(SessionLink& link) : link_(link) {}

  void draw();
  /// Puts the cursor into the field for the name.
  void ask_for_name() { name_wanted_ = true; }
  /// The answer to a command for which a line should be in the panel: a fault, or where an export went. time: of the
  /// window, seconds.
  void show_reply(const SessionReply& reply, double time);
  ExportQuestion& question() { return question_; }

  /// About the last export or fault; empty: nothing.
  const std::string& line() const { return line_; }
  bool line_is_fault() const { return line_is_fault_; }

 private:
  void picture_controls();
  void take_options();
  void progress();
  nlohmann::json with_picture_options(nlohmann::json command) const;

  SessionLink& link_;
  std::string name_ = "view";
  int format_ = 0;
  bool replace_ = false, transparent_ = false;
  int samples_ = 0, width_ = 0, height_ = 0;  ///< of an exported picture; 0: as shown
  nlohmann::json options_;                    ///< of the session, as they were taken last
  ExportQuestion question_;
  bool name_wanted_ = false;
  std::string line_;
  bool line_is_fault_ = false;
};

}  // namespace meniscus
