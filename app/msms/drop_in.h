// SPDX-License-Identifier: BSD-3-Clause
// What the drop-in programs share: the spheres they read, and the files they write.
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
  std::vector<Ball> balls;  ///< those that the probe rolls over: a sphere of radius 0 is left out
  MsmsSpheres rows;
  double smallest_radius = 0.0, largest_radius = 0.0;
};

/// Reads x y z r [[1] name] a line; "-": standard input. Throws InputError, with file and line, also when there is no
/// sphere with a radius; CapacityError.
Spheres read_spheres(const std::string& file);

/// The same of spheres that came otherwise; `file` names them. Throws InputError: no number, a radius below 0 or above
/// kLargestRadius, a coordinate beyond kLargestCoordinate.
Spheres spheres_of(std::vector<Ball> balls, std::vector<std::string> names, const std::string& file);

/// -noh: takes out the balls of radius 1.2 Å, as MSMS tells hydrogens. Throws InputError where no other is there.
void leave_out_hydrogens(Spheres& spheres);

class OutputFiles {
 public:
  /// Begins a file, which replaces one of that name in the end. Throws OutputError: also where its folder is missing.
  void begin(const std::string& path);
  /// Writes all of a file; begins it if it has not begun.
  void write(const std::string& path, const std::string& text);
  /// Gives all files their names.
  void commit();

 private:
  std::map<std::string, std::unique_ptr<OutputFolder>> folders_;
  std::map<std::string, OutputFile*> files_;
};

}  // namespace meniscus::msms
