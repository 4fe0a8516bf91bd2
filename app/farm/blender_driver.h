// SPDX-License-Identifier: BSD-3-Clause
// The program that Blender runs to render frames: the driver of exactly this version of the add-on.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/farm/bundle.h"

namespace meniscus::farm {

/// A file of the add-on that this program was built with.
struct DriverFile {
  std::string path;  ///< below the add-on's folder: "render_mns.py"
  std::string sha256;
};

/// In the order of their paths. Their checksums are part of this program.
const std::vector<DriverFile>& driver_files();

/// Throws RequestError unless the bundle brings exactly these files below inputs/blender/, or none for bundles whose
/// frames are not made by Blender: what Blender runs is a program, which only we may choose.
void check_driver(const Bundle& bundle);

/// A copy of the driver in a hidden folder of the bundle, away with this object. Made of files with the right checksums
/// and of nothing else that may lie beside them.
class DriverCopy {
 public:
  /// Throws InputError: missing or changed; OutputError.
  explicit DriverCopy(const std::filesystem::path& bundle_folder);
  ~DriverCopy();
  DriverCopy(const DriverCopy&) = delete;
  DriverCopy& operator=(const DriverCopy&) = delete;

  /// Relative to the bundle.
  std::string script() const { return name_ + "/render_mns.py"; }

 private:
  DriverCopy(const std::filesystem::path& bundle_folder, std::string name);

  std::string name_;
  std::filesystem::path path_;
};

}  // namespace meniscus::farm
