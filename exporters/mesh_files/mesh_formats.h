// SPDX-License-Identifier: BSD-3-Clause
// The table of the formats of mesh files, with the name, the features and the writer of each.
#pragma once

#include "core/base/output_file.h"
#include "exporters/mesh_files/writers.h"

namespace meniscus {

/// The range of the length of 1 Å in a file.
inline constexpr double kSmallestFileScale = 1e-12, kLargestFileScale = 1e6;

/// A format of mesh files.
struct MeshFormat {
  std::string_view word;   ///< short name, which is also the ending of its files (without the dot), except ply-ascii
  std::string_view title;  ///< name in messages and help
  std::string_view unit;   ///< unit of length that the format prescribes; empty if it prescribes none
  bool objects;            ///< true if a file may have several objects, with names
  bool colors;
  bool numbers;  ///< true if vertices may have VertexNumbers
  bool solid;    ///< true if programs fill it: it needs one closed surface and its inner points
  bool atoms;    ///< true if it contains names of atoms
  bool places;   ///< true if an object may be in several places at once
  bool opacity;  ///< true if vertices may have opacities
  void (*write)(OutputFile& file, const MeshFile& mesh);
  /// Writes all frames of a run, at least one, into one file; nullptr if each frame needs a file of its own.
  void (*write_run)(OutputFile& file, std::span<const MeshFile> frames, const RunTimes& times) = nullptr;
};

std::span<const MeshFormat> mesh_formats();

/// Returns the format with this word, or nullptr.
const MeshFormat* mesh_format(std::string_view word);
/// Returns the format of a path by its ending in any case, or nullptr.
const MeshFormat* mesh_format_of_path(std::string_view path);

/// Returns the words of all formats: "stl, 3mf, ...".
std::string mesh_format_words();

/// Writes the file whole or not at all. Objects are joined if the format allows only one. Throws OutputError, and
/// CapacityError for a mesh that exceeds the limits of the format.
void write_mesh_file(const MeshFormat& format, const std::string& path, Existing existing, MeshFile mesh);
/// Writes a run in a format that has write_run. Throws what write_mesh_file() throws.
void write_mesh_run(const MeshFormat& format, const std::string& path, Existing existing,
                    std::span<const MeshFile> frames, const RunTimes& times);

}  // namespace meniscus
