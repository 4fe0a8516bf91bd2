// SPDX-License-Identifier: BSD-3-Clause
// Checks the pictures of a bundle, and makes its film.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "app/farm/bundle.h"

namespace meniscus::farm {

/// What is wrong with one frame.
struct FrameFault {
  std::uint64_t frame = 0;
  std::string what;
  bool is_there = false;  ///< so that a worker would not make it again
};

/// Frames that are missing; pictures that cannot be read, have the wrong size, or are blank: all pixels equal. In the
/// order of the run.
std::vector<FrameFault> faults_of(const Bundle& bundle, const std::filesystem::path& folder);

/// What a film shows instead of a frame that is not good.
enum class InPlace {
  hold,  ///< the frame before once more; before the first good frame that one
  drop   ///< nothing: the film is shorter
};

/// Makes the film of the bundle's pictures (app/film/film.h): the same bytes for the same pictures. What is transparent
/// shows white where the film keeps no alpha. `faults` are not all of the frames. Throws OutputError if ffmpeg is not
/// there or fails.
void encode_film(const Bundle& bundle, const std::filesystem::path& folder, const std::vector<FrameFault>& faults,
                 InPlace in_place);

}  // namespace meniscus::farm
