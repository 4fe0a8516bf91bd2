// SPDX-License-Identifier: BSD-3-Clause
// Checks the pictures of a bundle, and makes its film.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>

#include "app/farm/bundle.h"

namespace meniscus::farm {

/// A frame that is not good.
struct FrameFault {
  std::string sentence;   ///< what is wrong
  bool is_there = false;  ///< true if a worker would not make it again
};

/// Faults by the number of the frame.
using FrameFaults = std::map<std::uint64_t, FrameFault>;

/// Finds frames that are missing, and pictures that cannot be read, have the wrong size, or are blank: all pixels
/// equal.
FrameFaults faults_of(const Bundle& bundle, const std::filesystem::path& folder);

/// The choice of what a film shows instead of a frame that is not good.
enum class InPlace {
  hold,  ///< the frame before once more; before the first good frame that one
  drop   ///< nothing: the film is shorter
};

/// Makes the film of the bundle's pictures (app/film/film.h): the same bytes for the same pictures. White shows through
/// transparent parts where the film keeps no alpha. Some frames are not among the `faults`. Throws OutputError if
/// ffmpeg is not there or fails.
void encode_film(const Bundle& bundle, const std::filesystem::path& folder, const FrameFaults& faults,
                 InPlace in_place);

}  // namespace meniscus::farm
