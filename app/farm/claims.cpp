// SPDX-License-Identifier: BSD-3-Clause
// Stores claims on frames as files.
#include "app/farm/claims.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <vector>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fmt/format.h>

#include "app/farm/bundle.h"
#include "app/farm/inner_path.h"
#include "core/base/error.h"
#include "core/base/output_file.h"

namespace meniscus::farm {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLargestClaim = 4096;
constexpr int kMostGenerations = 1000;  // so many workers died of one frame

Claims* current = nullptr;
std::mutex current_mutex;

}  // namespace

Claims::Claims(fs::path folder, double lease)
    : folder_(std::move(folder)), name_(new_worker_name()), life_(folder_ / life_path(name_)), lease_(lease) {
  make_folders_of(life_);
  begin_ = touch();
  heart_ = std::thread([this] { keep_alive(); });
  const std::lock_guard lock(current_mutex);
  current = this;
}

Claims::~Claims() {
  {
    const std::lock_guard lock(current_mutex);
    current = nullptr;
  }
  give_all_back();
  heart_.join();
}

/// Now, by the file system: the time it gives this worker's file.
FileTime Claims::touch() {
  if (over_) return begin_;
  const int file = ::open(life_.c_str(), O_WRONLY | O_CREAT | O_NOFOLLOW | O_CLOEXEC, 0666);
  const auto fail = [&] {
    const int error = errno;
    if (file >= 0) ::close(file);
    throw OutputError(life_.string(), fmt::format("cannot be written: {}", std::strerror(error)));
  };
  if (file < 0) fail();
  struct stat status {};
  if (::fstat(file, &status) != 0) fail();
  if (status.st_size == 0) {
    const std::string text = life_text(lease_);
    if (::write(file, text.data(), text.size()) != static_cast<ssize_t>(text.size())) fail();
  }
  // No time given: the server's, where there is one.
  if (::futimens(file, nullptr) != 0) fail();
  ::close(file);
  return modified(life_).value_or(begin_);
}

void Claims::keep_alive() {
  std::unique_lock lock(mutex_);
  while (!stop_.wait_for(lock, std::chrono::duration<double>(lease_ / 4.0), [&] { return over_.load(); })) {
    try {
      touch();
    } catch (const OutputError&) {
      // A disk that is full or away for a while: others take over if it lasts.
    }
  }
}

fs::path Claims::claim_path(const std::string& step, std::uint64_t frame, int generation) const {
  return fs::path("state") / step / fmt::format("frame_{}.claim{}", frame_digits(frame), generation);
}

/// False: there is one already.
bool Claims::make_claim(const fs::path& path) const {
  const fs::path whole = folder_ / path;
  make_folders_of(whole);
  const int file = ::open(whole.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
  if (file < 0 && errno == EEXIST) return false;
  const std::string text = name_ + "\n";
  const bool written = file >= 0 && ::write(file, text.data(), text.size()) == static_cast<ssize_t>(text.size());
  const int error = errno;
  if (file >= 0) ::close(file);
  if (written) return true;
  if (file >= 0) ::unlink(whole.c_str());
  throw OutputError(whole.string(), fmt::format("cannot be written: {}", std::strerror(error)));
}

Claims::Holder Claims::holder(const fs::path& claim) {
  const std::optional<std::string> text = inner_text(folder_, claim, kLargestClaim);
  if (!text) return {};
  const std::string worker = text->substr(0, text->find('\n'));
  if (worker == name_) return {true, true};
  if (text->ends_with('\n') && is_inner_path(worker))
    return {lives(folder_, worker, [this] { return touch(); }), false};
  // Its writer has only begun, or died when it had.
  const std::optional<FileTime> when = modified(folder_ / claim);
  return {when && seconds_between(*when, touch()) < kDefaultLease, false};
}

bool Claims::take(const std::string& step, std::uint64_t frame) {
  for (int generation = 1; generation <= kMostGenerations; ++generation) {
    const fs::path path = claim_path(step, frame, generation);
    {
      // A worker that gives all back sees a claim with its entry, or neither, and nothing is claimed after that.
      const std::lock_guard lock(mutex_);
      if (over_) return false;
      if (make_claim(path)) {
        // One that was given back below a later one.
        if (holder(claim_path(step, frame, generation + 1)).lives) {
          ::unlink((folder_ / path).c_str());
          return false;
        }
        held_[{step, frame}] = generation;
        return true;
      }
    }
    const Holder found = holder(path);
    if (found.lives) return found.is_self;
  }
  return false;
}

void Claims::give_back(const std::string& step, std::uint64_t frame) {
  const std::lock_guard lock(mutex_);
  const auto found = held_.find({step, frame});
  if (found == held_.end()) return;
  remove_claims(step, frame, found->second);
  held_.erase(found);
}

void Claims::remove_claims(const std::string& step, std::uint64_t frame, int generation) const {
  std::error_code ignored;
  // Another took over meanwhile: what lies below its claim stays until it is done.
  if (fs::exists(folder_ / claim_path(step, frame, generation + 1), ignored)) return;
  // From the first: as long as one of the dead is left, nobody begins below this one.
  for (int n = 1; n <= generation; ++n) ::unlink((folder_ / claim_path(step, frame, n)).c_str());
}

bool Claims::is_taken(const std::string& step, std::uint64_t frame) {
  for (int generation = 1; generation <= kMostGenerations; ++generation) {
    const fs::path path = claim_path(step, frame, generation);
    if (inner_entry(folder_, path) == Entry::nothing) return false;
    const Holder found = holder(path);
    if (found.lives) return !found.is_self;
  }
  return false;
}

std::size_t Claims::others() {
  const std::vector<std::string> names = live_workers(folder_, [this] { return touch(); });
  return names.size() - static_cast<std::size_t>(std::ranges::count(names, name_));
}

void Claims::give_all_back() {
  {
    const std::lock_guard lock(mutex_);
    over_ = true;
    for (const auto& [frame, generation] : held_) remove_claims(frame.first, frame.second, generation);
    held_.clear();
    ::unlink(life_.c_str());
  }
  stop_.notify_all();
}

void give_back_all_claims() {
  const std::lock_guard lock(current_mutex);
  if (current) current->give_all_back();
}

}  // namespace meniscus::farm
