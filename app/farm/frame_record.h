// SPDX-License-Identifier: BSD-3-Clause
// The result of one frame in one step: a small file in state/STEP/, the farm's only memory.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/farm/bundle.h"
#include "app/farm/inner_path.h"

namespace meniscus::farm {

/// A file that a frame consists of.
struct MadeFile {
  std::string path;  ///< relative to the bundle
  std::uint64_t bytes = 0;
  std::string sha256;
};

/// A frame that was made, or that failed.
struct FrameRecord {
  std::uint64_t frame = 0;
  int exit_code = 0;            ///< 0: made
  std::string error;            ///< of a frame that failed: one line
  std::uint64_t tries = 1;      ///< that failed one after another, with this one
  std::optional<double> again;  ///< of a frame that failed: seconds until the next try
  std::vector<MadeFile> files;  ///< of a frame that was made
  double seconds = 0.0;         ///< that it took
  std::string first_try;        ///< why a second process made it, if the first was ended by a signal
  std::string worker;           ///< who made it (sign_of_life.h); empty in records of older programs
  double ended = 0.0;           ///< when it was made or failed: seconds since 1970, by the worker's clock

  bool done() const { return exit_code == 0; }
};

/// Instead of a frame: the files in scene/ that all frames of a step have in common, state/STEP/shared.json. A frame
/// that has a record has these, too.
inline constexpr std::uint64_t kSharedFiles = ~std::uint64_t{0};

/// How closely files are compared with their record.
enum class Look {
  sizes,    ///< quick: a look at the folder
  contents  ///< by checksum
};

/// The records of one bundle. Records of another bundle, damaged ones, and none at all are the same: nothing.
class FrameRecords {
 public:
  FrameRecords(std::filesystem::path folder, const Bundle& bundle);

  std::optional<FrameRecord> read(const std::string& step, std::uint64_t frame) const;
  /// When it was written; nothing if there is none.
  std::optional<FileTime> written(const std::string& step, std::uint64_t frame) const;
  /// Whole or not at all. Throws OutputError.
  void write(const std::string& step, const FrameRecord& record) const;

  /// Records the files that frames have in common as they are now, unless there are none, or that is known.
  void write_shared(const std::string& step) const;
  /// The frame as it lies in the bundle: paths (relative) with sizes and checksums. Throws InputError.
  FrameRecord measured(std::uint64_t frame, const std::vector<std::string>& paths, double seconds) const;
  /// What is wrong with the files of a frame that was made: "" or "images/frame_00042.png: is missing".
  std::string fault(const FrameRecord& record, Look look = Look::contents) const;

 private:
  /// Relative to the bundle.
  std::filesystem::path path_of(const std::string& step, std::uint64_t frame) const;

  std::filesystem::path folder_;
  std::string fingerprint_;
};

}  // namespace meniscus::farm
