// SPDX-License-Identifier: BSD-3-Clause
// The common part of the drop-in programs: the spheres that they read, and the files that they write.
#pragma once

#include <map>

#include "core/base/output_file.h"
#include "core/math/ball.h"
#include "exporters/msms/msms_files.h"

namespace meniscus::msms {

/// The spheres of a run, without spheres of radius 0, and their names and numbers for the files of MSMS.
struct Spheres {
  std::vector<Ball> balls;  ///< spheres of a radius above 0, in Å, in the order of the input
  /// The name and number of all input spheres, also of radius 0; of_atom has one entry per ball.
  MsmsSpheres rows;
  double smallest_radius = 0.0, largest_radius = 0.0;  ///< Å, over all input spheres; 0 if a sphere has that radius
};

/// Reads a file of lines "x y z r", "x y z r NAME" or "x y z r 1 NAME", in Å. The 1 says that the sphere is part of the
/// surface; no other number is allowed there. The file "-" is standard input. Throws InputError, with file and line,
/// for anything else, and if no sphere has a radius above 0. Throws CapacityError if the input is too large.
Spheres read_spheres(const std::string& file);

/// Makes spheres from other sources. `names` has one name per ball; if all are empty, or there are none, the files get
/// no column of names. `file` names the source in errors. Throws InputError for NaN, for a radius below 0 or above
/// kLargestRadius (Å), for a coordinate beyond kLargestCoordinate (Å), and if no ball has a radius above 0.
Spheres spheres_of(std::vector<Ball> balls, std::vector<std::string> names, const std::string& file);

/// Implements -noh: removes balls of radius 1.2 Å, MSMS' hydrogens. Throws InputError if there are no others.
void leave_out_hydrogens(Spheres& spheres);

/// The output files of a run. commit() gives them their final names, folder by folder, and replaces existing files;
/// before it, no existing file changes. Files that are never committed are deleted. All members throw OutputError.
class OutputFiles {
 public:
  /// Begins a file. Throws OutputError also if its folder is missing.
  void begin(const std::string& path);
  /// Appends the text to a file, which begins if it has not begun.
  void write(const std::string& path, const std::string& text);
  /// Gives all files their final names.
  void commit();

 private:
  std::map<std::string, std::unique_ptr<OutputFolder>> folders_;
  std::map<std::string, OutputFile*> files_;
};

}  // namespace meniscus::msms
