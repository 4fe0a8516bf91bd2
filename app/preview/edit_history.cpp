// SPDX-License-Identifier: BSD-3-Clause
// Two stacks of figures.
#include "app/preview/edit_history.h"

#include <utility>

namespace meniscus {
namespace {

constexpr std::size_t kMostSteps = 100;

}  // namespace

void EditHistory::note(std::string_view kind, const PreviewFigure& before) {
  future_.clear();
  if (!kind.empty() && kind == kind_) return;
  kind_ = kind;
  past_.push_back(before);
  if (past_.size() > kMostSteps) past_.pop_front();
}

std::optional<PreviewFigure> EditHistory::move(const PreviewFigure& now, std::deque<PreviewFigure>& from,
                                               std::deque<PreviewFigure>& to) {
  end_step();
  if (from.empty()) return {};
  to.push_back(now);
  PreviewFigure figure = std::move(from.back());
  from.pop_back();
  return figure;
}

}  // namespace meniscus
