// SPDX-License-Identifier: BSD-3-Clause
// What a figure was before each step, for undo and redo.
#pragma once

#include <cstddef>
#include <deque>
#include <optional>
#include <string>
#include <string_view>

#include "app/preview/preview_view.h"

namespace meniscus {

/// Steps of one kind that follow each other without end_step() between them, such as the movements of one drag, are
/// one step.
class EditHistory {
 public:
  /// What was there before a step of this kind; empty: a step by itself.
  void note(std::string_view kind, const PreviewFigure& before);
  /// The next step is one by itself.
  void end_step() { kind_.clear(); }

  /// The figure that undo and redo bring back, given the one there is; nothing if there is none.
  std::optional<PreviewFigure> undo(const PreviewFigure& now) { return move(now, past_, future_); }
  std::optional<PreviewFigure> redo(const PreviewFigure& now) { return move(now, future_, past_); }
  std::size_t undo_steps() const { return past_.size(); }
  std::size_t redo_steps() const { return future_.size(); }

 private:
  std::optional<PreviewFigure> move(const PreviewFigure& now, std::deque<PreviewFigure>& from,
                                    std::deque<PreviewFigure>& to);

  std::deque<PreviewFigure> past_, future_;
  std::string kind_;  ///< of the last step; empty: it is ended
};

}  // namespace meniscus
