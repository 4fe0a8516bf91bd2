// SPDX-License-Identifier: BSD-3-Clause
// Checks every file of a bundle's frames.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "app/farm/bundle.h"
#include "app/farm/film_note.h"
#include "app/farm/frame_record.h"

namespace meniscus::farm {

/// What is wrong with one frame.
struct FrameFault {
  std::string step;
  std::uint64_t frame = 0;
  int exit_code = 0;    ///< that of the frame if it failed, else kExitInput
  bool failed = false;  ///< when it was made, and so perhaps each time
  std::string what;
};

/// What is wrong with the files of a frame that was made, and with its picture: "" or a line.
std::string fault_of(const FrameRecord& record, const FrameRecords& records, const Bundle& bundle,
                     const std::filesystem::path& folder);

/// Frames that are missing, failed, or not what was made; pictures that cannot be read, have the wrong size, or are
/// blank: all pixels equal.
std::vector<FrameFault> faults_of(const Bundle& bundle, const std::filesystem::path& folder);

/// Makes the film of the bundle's pictures (app/film/film.h): the same bytes for the same pictures. What is transparent
/// shows white. without: frames that are not looked at, and not all of them. Throws OutputError if ffmpeg is not there
/// or fails.
void encode_film(const Bundle& bundle, const std::filesystem::path& folder, const FilmNote& without);

}  // namespace meniscus::farm
