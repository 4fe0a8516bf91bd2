// SPDX-License-Identifier: BSD-3-Clause
// The formats of mesh files: a table of what each is called, holds, and is written by.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "core/base/output_file.h"
#include "exporters/mesh_files/mesh_file.h"

namespace meniscus {

/// What 1 Å may be in a file.
inline constexpr double kSmallestFileScale = 1e-12, kLargestFileScale = 1e6;

/// One format, one file beside this one.
struct MeshFormat {
  std::string_view word;   ///< how it is called, and the ending of its files without the dot, but for ply-ascii
  std::string_view title;  ///< for people
  std::string_view unit;   ///< that it says lengths are in; empty: it says none
  bool objects;            ///< more than one, with names
  bool colors;
  bool numbers;  ///< of vertices: VertexNumbers
  bool solid;    ///< made for programs that fill it: needs one closed surface, with its inner points
  bool atoms;    ///< names them
  bool places;   ///< an object may be in several places at once
  bool opacity;  ///< of vertices
  void (*write)(OutputFile& file, const MeshFile& mesh);
  /// All frames of a run, at least one, in one file; nullptr: each needs a file of its own.
  void (*write_run)(OutputFile& file, std::span<const MeshFile> frames, const RunTimes& times) = nullptr;
};

std::span<const MeshFormat> mesh_formats();

/// By its word, or nullptr.
const MeshFormat* mesh_format(std::string_view word);
/// By the ending of a path, in letters of either case, or nullptr.
const MeshFormat* mesh_format_of_path(std::string_view path);

/// Their words: "stl, 3mf, ...".
std::string mesh_format_words();

/// Writes the file whole or not at all; objects are joined where the format holds one. Throws OutputError,
/// CapacityError for what the format cannot hold.
void write_mesh_file(const MeshFormat& format, const std::string& path, Existing existing, MeshFile mesh);
/// A run, in a format that has write_run. Throws likewise.
void write_mesh_run(const MeshFormat& format, const std::string& path, Existing existing,
                    std::span<const MeshFile> frames, const RunTimes& times);

}  // namespace meniscus
