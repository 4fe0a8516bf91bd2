// SPDX-License-Identifier: BSD-3-Clause
// Brings together what was made in several copies of one bundle.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "app/farm/bundle.h"
#include "app/farm/claims.h"
#include "app/farm/frame_record.h"

namespace meniscus::farm {

/// The result of a frame in a copy that was not taken.
struct NotTaken {
  std::string step;
  std::uint64_t frame = 0;  ///< or kSharedFiles
  std::string what;         ///< is wrong with it
};

/// What became of the results in one copy: each frame has one in each step.
struct Merged {
  std::uint64_t taken = 0;   ///< their frames are made here, too, now
  std::uint64_t bytes = 0;   ///< of the files that were copied
  std::uint64_t there = 0;   ///< the same was here already
  std::uint64_t failed = 0;  ///< their frames failed in the copy, and are not made here
  std::uint64_t busy = 0;    ///< a worker is making their frames here
  std::vector<NotTaken> not_taken;
};

/// A copy of the bundle that takes what others have. It claims each frame as a worker does, so that workers may run on
/// it meanwhile. A result appears here as a worker would write it: its files, each whole or not at all, then its log,
/// then its record.
class MergeTarget {
 public:
  /// Looks at every file that the bundle has. Throws InputError for links and the like, OutputError if it cannot write.
  MergeTarget(const Bundle& bundle, std::filesystem::path folder);

  /// Takes each result of the copy that is good, and not here: its record is of this bundle and this frame, its files
  /// have the recorded checksums, its picture can be read and has the bundle's size. What is here stays. The copy needs
  /// bundle.json, state/, and the files of its frames; its inputs are not looked at. Throws InputError: the copy is
  /// another bundle, or none; OutputError.
  Merged take_from(const std::filesystem::path& copy);

 private:
  using Sums = std::map<std::string, std::string>;  ///< checksums of files by their paths

  void take(const std::string& step, std::uint64_t frame, const std::filesystem::path& copy,
            const FrameRecords& records, Merged& merged);
  void take_failure(const std::string& step, const FrameRecord& record, const std::filesystem::path& copy,
                    Merged& merged);
  void take_files(const FrameRecord& record, const std::filesystem::path& copy, Merged& merged);
  bool look(const std::string& step, std::uint64_t frame);
  std::string difference(const FrameRecord& record) const;
  void keep(const std::string& step, const FrameRecord& record, const std::filesystem::path& copy);

  const Bundle& bundle_;
  std::filesystem::path folder_;
  FrameRecords records_;
  Claims claims_;
  std::vector<std::uint64_t> results_;                    ///< of each step: the shared files, then the frames
  std::set<std::pair<std::string, std::uint64_t>> good_;  ///< frames of steps that are made here
  Sums sums_;                                             ///< of their files
};

}  // namespace meniscus::farm
