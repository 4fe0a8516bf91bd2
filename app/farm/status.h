// SPDX-License-Identifier: BSD-3-Clause
// The progress of a bundle, from its folder alone: no queue needs to be asked.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/farm/bundle.h"
#include "app/farm/film_note.h"
#include "app/farm/frame_record.h"

namespace meniscus::farm {

/// A frame that was made, but whose files are gone or of another size now.
struct DamagedFrame {
  std::uint64_t frame = 0;
  std::string what;
};

struct StepStatus {
  std::string step;
  std::uint64_t done = 0, missing = 0;
  std::vector<FrameRecord> failed;          ///< in the order of the run
  std::vector<DamagedFrame> damaged;        ///< likewise
  std::optional<double> seconds_per_frame;  ///< mean of those done
  std::optional<double> seconds_left;       ///< of one worker alone, for all that is not done
  std::optional<double> seconds_to_go;      ///< of all workers that live now, each at the pace it had so far

  std::uint64_t left() const { return missing + failed.size() + damaged.size(); }
};

struct BundleStatus {
  std::vector<StepStatus> steps;
  std::vector<std::string> workers;     ///< that live now, by name
  std::optional<double> seconds_to_go;  ///< of all steps, one after another; nothing if one is not known
  std::optional<FilmNote> film;         ///< if it was made without some frames
  bool paused = false;
};

/// Of files their sizes are looked at; `farm verify` looks at what is in them.
BundleStatus status_of(const Bundle& bundle, const std::filesystem::path& folder);

}  // namespace meniscus::farm
