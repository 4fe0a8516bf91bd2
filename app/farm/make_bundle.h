// SPDX-License-Identifier: BSD-3-Clause
// Makes the folder of a bundle.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/farm/bundled_command.h"
#include "app/farm/emit.h"

namespace meniscus::farm {

struct BundleOptions {
  std::filesystem::path folder;
  std::vector<Engine> engines;
  std::string farm_path;
  std::optional<Film> film;
  Chunking chunking;
  bool cores_asked = false;     ///< else as many as --threads after -- says, if it does
  bool by_reference = false;    ///< files that the command reads are not copied
  std::filesystem::path addon;  ///< folder of render_mns.py
  bool force = false;
};

/// What came of it.
struct MadeBundle {
  Bundle bundle;
  bool was_there = false;          ///< the same bundle lay there already; only engine files were written
  std::vector<std::string> notes;  ///< for people
};

/// Chooses the camera and the chunks, and writes the bundle whole or not at all. For chunks by time it makes one frame
/// and measures how long that takes. Then it writes the legend that all frames have in common, if the command has one
/// as a picture of its own. Throws UsageError, InputError, OutputError (another bundle is there and `force` is not, or
/// something that is not a bundle), RunError if the trial frame fails.
MadeBundle make_bundle(const BundleOptions& options, const BundledCommand& command);

}  // namespace meniscus::farm
