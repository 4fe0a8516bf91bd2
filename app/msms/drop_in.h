// SPDX-License-Identifier: BSD-3-Clause
// The common part of the drop-in programs: the spheres that they read, and the files that they write.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/base/output_file.h"
#include "core/math/ball.h"
#include "exporters/msms/msms_files.h"

namespace meniscus::msms {

struct Spheres {
  std::vector<Ball> balls;  ///< spheres that the probe touches: spheres of radius 0 are left out
  MsmsSpheres rows;
  double smallest_radius = 0.0, largest_radius = 0.0;
};

/// Reads lines x y z r [[1] name]; "-": standard input. Throws InputError, with file and line, also if there is no
/// sphere with a radius; CapacityError.
Spheres read_spheres(const std::string& file);

/// Makes spheres from other sources; `file` names them in errors. Throws InputError for NaN, for a radius below 0 or
/// above kLargestRadius, and for a coordinate beyond kLargestCoordinate.
Spheres spheres_of(std::vector<Ball> balls, std::vector<std::string> names, const std::string& file);

/// Implements -noh: removes the balls of radius 1.2 Å, by which MSMS recognizes hydrogens. Throws InputError if no
/// other ball exists.
void leave_out_hydrogens(Spheres& spheres);

class OutputFiles {
 public:
  /// Begins a file, which replaces an existing one at the end. Throws OutputError, also if its folder is missing.
  void begin(const std::string& path);
  /// Writes the whole contents of a file; begins it if it has not begun.
  void write(const std::string& path, const std::string& text);
  /// Gives all files their final names.
  void commit();

 private:
  std::map<std::string, std::unique_ptr<OutputFolder>> folders_;
  std::map<std::string, OutputFile*> files_;
};

}  // namespace meniscus::msms
