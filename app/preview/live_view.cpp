// SPDX-License-Identifier: BSD-3-Clause
// The one schedule of drafts and full pictures.
#include "app/preview/live_view.h"

#include <algorithm>

#include "core/base/error.h"

namespace meniscus {
namespace {

using namespace std::chrono_literals;

constexpr auto kPause = 60ms;      // of the hand, until the draft gets its full size
constexpr auto kPatience = 400ms;  // with drafts of a surface that nobody wants any more
constexpr LiveView::Clock::duration kRest = 150ms, kLongestRest = 1500ms;

}  // namespace

LiveView::LiveView(PreviewSession& session)
    : session_(session), seen_revision_(session.state().revision), last_change_(Clock::now()), rest_(kRest) {}

nlohmann::json LiveView::apply(const nlohmann::json& command) {
  nlohmann::json reply = session_.apply(command);
  note_change();
  return reply;
}

void LiveView::note_change() {
  if (session_.state().revision == seen_revision_) return;
  seen_revision_ = session_.state().revision;
  last_change_ = Clock::now();
  fault_.clear();
  if (session_.state().playing) return;
  draft_cost_.reset();
  plain_cost_.reset();
}

bool LiveView::draw(Quality quality, const std::function<Change()>& waiting) {
  const Clock::time_point begin = Clock::now();
  const auto stop = [&] {
    if (quality != Quality::draft) return waiting() != Change::none;
    return Clock::now() - begin > kPatience && waiting() == Change::surface;
  };
  try {
    const bool whole = session_.render(quality, stop);
    if (!whole) return false;
  } catch (const GpuError&) {
    throw;
  } catch (const Error& error) {
    fault_ = error.what();
    return false;
  }
  const Clock::duration cost = Clock::now() - begin;
  if (quality == Quality::draft) draft_cost_ = cost;
  if (quality == Quality::plain) plain_cost_ = cost;
  if (quality == Quality::full) rest_ = std::clamp(cost, kRest, kLongestRest);
  return true;
}

std::optional<Quality> LiveView::drawn() const {
  for (const Quality quality : {Quality::full, Quality::plain, Quality::draft})
    if (session_.is_drawn(quality)) return quality;
  return {};
}

std::optional<Quality> LiveView::next() const {
  const std::optional<Quality> best = drawn();
  if (!fault_.empty() || best == Quality::full || (best && session_.state().playing)) return {};
  if (!best) return Quality::draft;
  return best == Quality::draft ? Quality::plain : Quality::full;
}

LiveView::Clock::duration LiveView::rest(Quality quality) const {
  if (quality == Quality::draft) return Clock::duration::zero();
  return quality == Quality::plain ? kPause : rest_;
}

Quality LiveView::at_once() const {
  if (!session_.state().playing || !draft_cost_) return Quality::draft;
  constexpr int kMostLikely = 3;  // drafts of a quarter of the pixels that a plain picture takes
  const std::chrono::duration<double> frame(0.8 / session_.state().frames_per_second);
  return plain_cost_.value_or(kMostLikely * *draft_cost_) < frame ? Quality::plain : Quality::draft;
}

Quality LiveView::due(Clock::time_point now) const {
  const Clock::duration rested = now - last_change_;
  if (session_.state().playing) return at_once();
  if (rested < rest(Quality::plain)) return Quality::draft;
  return rested < rest(Quality::full) ? Quality::plain : Quality::full;
}

}  // namespace meniscus
