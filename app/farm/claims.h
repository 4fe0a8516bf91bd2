// SPDX-License-Identifier: BSD-3-Clause
// Claims on frames in the bundle's folder, so that any number of workers on any machines share its work.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>

#include "app/farm/sign_of_life.h"

namespace meniscus::farm {

/// The claims of one worker.
///
/// A claim is a file state/STEP/frame_00042.claim1 that is made with O_EXCL, which file systems of many machines keep
/// exclusive, too (NFS since version 3), and that names the worker. A worker shows that it lives by touching its own
/// file in state/workers/ four times in a lease. One whose file is older than its lease is dead, and so is one on this
/// machine whose process is gone; then the next claim, .claim2, decides by O_EXCL who goes on. No claim of another is
/// ever removed or renamed, so nothing can be lost between looking and taking. Ages are differences of times that the
/// file system itself gave: clocks of machines do not matter.
///
/// A worker that slept over its lease and goes on makes a frame twice; that costs time and nothing else, for frames
/// appear whole and do not depend on the worker that made them.
class Claims {
 public:
  /// Begins to show that this worker is running. Throws OutputError if that cannot be written.
  explicit Claims(std::filesystem::path folder, double lease = kDefaultLease);
  /// Gives all back.
  ~Claims();
  Claims(const Claims&) = delete;
  Claims& operator=(const Claims&) = delete;

  /// Whether the frame is this worker's now. False: another that lives has it, or all was given back. Look at its
  /// record again when you have it: another may have made it just before. Throws OutputError.
  bool take(const std::string& step, std::uint64_t frame);
  /// When its record is written, or when it should not be made.
  void give_back(const std::string& step, std::uint64_t frame);

  /// Whether another worker that lives has the frame.
  bool is_taken(const std::string& step, std::uint64_t frame);
  /// Other workers that live.
  std::size_t others();
  /// Of this worker: in its claims, and in records of frames it made.
  const std::string& name() const { return name_; }
  /// The file system's time.
  FileTime now() { return touch(); }
  /// When this worker began, by the file system.
  FileTime begin() const { return begin_; }

 private:
  friend void give_back_all_claims();
  struct Holder {
    bool lives = false;
    bool is_self = false;
  };

  std::filesystem::path claim_path(const std::string& step, std::uint64_t frame, int generation) const;
  bool make_claim(const std::filesystem::path& path) const;
  void remove_claims(const std::string& step, std::uint64_t frame, int generation) const;
  Holder holder(const std::filesystem::path& claim);
  FileTime touch();
  void keep_alive();
  void give_all_back();

  std::filesystem::path folder_;
  std::string name_;
  std::filesystem::path life_;  ///< the file that is touched
  double lease_;
  FileTime begin_ = 0;
  std::mutex mutex_;                                           ///< of what is held, and of the files that say so
  std::map<std::pair<std::string, std::uint64_t>, int> held_;  ///< generations
  std::atomic<bool> over_ = false;
  std::condition_variable stop_;
  std::thread heart_;
};

/// Gives back what this process has, for the thread that ends the program; afterwards its worker gets nothing more.
void give_back_all_claims();

}  // namespace meniscus::farm
