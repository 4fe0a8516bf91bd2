// SPDX-License-Identifier: BSD-3-Clause
// What a figure's colours mean, which of them a preview has, and two stacks of figures.
#include "app/preview/preview_state.h"

#include <string>

#include <fmt/format.h>

#include "core/base/error.h"

namespace meniscus {
namespace {

constexpr std::size_t kMostSteps = 100;

/// What makes pictures of the schemes that a preview has not; empty: it has it.
std::string who_shows(ColorScheme::By scheme, bool has_numbers) {
  using By = ColorScheme::By;
  if (scheme == By::component) return "parts of the surface have no atoms of their own; use meniscus render";
  if (scheme == By::volume) return "volume maps are for render and export mesh";
  if (scheme == By::buried) return "areas that are buried between groups are measured by meniscus render and export";
  if (scheme == By::rmsf && !has_numbers)
    return "fluctuations are measured once, over all frames; begin the preview with --color rmsf and --trajectory or "
           "--frames";
  return {};
}

void require_shown(const ColorScheme& color) {
  if (const std::string who = who_shows(color.by, !color.file.empty()); !who.empty())
    throw RequestError(fmt::format("color: \"{}\" needs more than atoms: {}", scheme_word(color), who));
}

}  // namespace

ColorScheme PreviewFigure::told_scheme() const {
  ColorScheme told = color;
  if (patch_kinds) {
    told.by = ColorScheme::By::kind;
    told.rules.clear();
  }
  return told;
}

void require_previewed(const ColorScheme& color) {
  if (color.uses_frames())
    throw RequestError("numbers by frame are for render and export blender; leave the column frame of their file away");
  require_shown(color);
  for (const ColorRule& rule : color.rules) require_shown(rule.paint);
}

bool is_previewed(ColorScheme::By scheme) { return who_shows(scheme, false).empty(); }

void EditHistory::note(std::string_view kind, const PreviewFigure& before) {
  future_.clear();
  if (!kind.empty() && kind == kind_) return;
  kind_ = kind;
  past_.push_back(before);
  if (past_.size() > kMostSteps) past_.pop_front();
}

void EditHistory::move(const PreviewFigure& now, std::deque<PreviewFigure>& from, std::deque<PreviewFigure>& to) {
  end_step();
  to.push_back(now);
  from.pop_back();
}

}  // namespace meniscus
