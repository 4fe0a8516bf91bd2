// SPDX-License-Identifier: BSD-3-Clause
// Reads frames on one thread into a short queue.
#include "core/trajectory/read_ahead.h"

#include <utility>

namespace meniscus {

ReadAhead::ReadAhead(std::function<void(ReadFrame&)> read, std::vector<std::uint64_t> numbers, std::size_t depth)
    : read_(std::move(read)), numbers_(std::move(numbers)), depth_(depth), thread_([this] { work(); }) {}

ReadAhead::~ReadAhead() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void ReadAhead::work() {
  for (const std::uint64_t number : numbers_) {
    {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [this] { return stop_ || ready_.size() < depth_; });
      if (stop_) return;
    }
    ReadFrame fresh;
    fresh.number = number;
    try {
      read_(fresh);
    } catch (...) {
      fresh.error = std::current_exception();
    }
    {
      const std::lock_guard lock(mutex_);
      ready_.push_back(std::move(fresh));
    }
    changed_.notify_all();
  }
}

std::optional<ReadFrame> ReadAhead::next() {
  if (taken_ == numbers_.size()) return {};
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return !ready_.empty(); });
  std::optional<ReadFrame> frame(std::move(ready_.front()));
  ready_.pop_front();
  ++taken_;
  lock.unlock();
  changed_.notify_all();
  return frame;
}

}  // namespace meniscus
