// SPDX-License-Identifier: BSD-3-Clause
// Joins trajectories.
#include "core/trajectory/joined_frames.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/text.h"

namespace meniscus {

JoinedFrames::JoinedFrames(std::vector<std::unique_ptr<Trajectory>> parts)
    : Trajectory(parts.front()->path(), parts.front()->format()), parts_(std::move(parts)) {
  if (parts_.size() > 1) path_ += fmt::format(" and {} more", parts_.size() - 1);
  atom_count_ = parts_.front()->atom_count();
  for (std::size_t n = 0; n < parts_.size(); ++n) {
    const Trajectory& part = *parts_[n];
    if (part.atom_count() != atom_count_) {
      throw InputError(
          part.path(), 0,
          fmt::format("its frames have {} atoms, those of {} {}; trajectories in a row need the same",
                      with_thousands(part.atom_count()), parts_.front()->path(), with_thousands(atom_count_)));
    }
    begin_.push_back(frame_count_);
    frame_count_ += part.frame_count();
    for (const Warning& warning : part.warnings())
      warnings_.emplace_back(part.path() + ": " + warning.text, warning.details);
    if (!part.cut_short().empty())
      cut_short_ += fmt::format("{}{}: {}", cut_short_.empty() ? "" : "; ", part.path(), part.cut_short());
    if (n > 0) warn_of_overlap(n);
  }
}

void JoinedFrames::warn_of_overlap(std::size_t part) {
  Frame last, first;
  try {
    parts_[part - 1]->read(parts_[part - 1]->frame_count() - 1, last);
    parts_[part]->read(0, first);
  } catch (const InputError&) {
    return;  // whoever makes this frame says what is wrong with it
  }
  if (!last.time || !first.time || *first.time > *last.time) return;
  warnings_.emplace_back(fmt::format("{} begins at {} ps, and {} ends at {} ps; no frame is left out",
                                     parts_[part]->path(), *first.time, parts_[part - 1]->path(), *last.time));
}

void JoinedFrames::read_unchecked(std::uint64_t number, Frame& frame) {
  const auto behind = std::ranges::upper_bound(begin_, number);
  const auto part = static_cast<std::size_t>(behind - begin_.begin()) - 1;
  parts_[part]->read(number - begin_[part], frame);
}

}  // namespace meniscus
