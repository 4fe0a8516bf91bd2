// SPDX-License-Identifier: BSD-3-Clause
// A film that ffmpeg encodes from pictures as they are made.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <sys/types.h>

#include <glm/vec2.hpp>

#include "core/base/output_file.h"

namespace meniscus {

/// Does the name end as films do: .mp4, .mkv, .mov?
bool is_film_path(const std::string& path);

/// Throws UsageError unless the size, in pixels, is even both ways, as the encoder needs it.
void check_film_size(glm::ivec2 size);

/// One film in H.264 (yuv420p, BT.709, constant quality 18); equal pictures give equal bytes on one machine. It appears
/// under its name when finish() succeeds: when ffmpeg had nothing to complain of and the file is whole. Needs the
/// program ffmpeg; without it, or when it fails, throws OutputError.
class FilmWriter {
 public:
  FilmWriter(const std::string& path, Existing existing, glm::ivec2 size, double frames_per_second);
  ~FilmWriter();
  FilmWriter(const FilmWriter&) = delete;
  FilmWriter& operator=(const FilmWriter&) = delete;

  /// rgb: 8 bit sRGB, 3 bytes a pixel, rows from the top.
  void add(std::span<const std::uint8_t> rgb);
  void finish();

 private:
  void wait();
  void end_pictures();
  std::string fault() const;  ///< why what the encoder has written is no film; empty if it is one

  OutputFile file_;
  pid_t encoder_ = -1;
  int pictures_ = -1;    ///< socket to the encoder's standard input
  int complaints_ = -1;  ///< what it writes on standard error
  int status_ = 0;
  std::uint64_t added_ = 0;  ///< pictures
};

}  // namespace meniscus
