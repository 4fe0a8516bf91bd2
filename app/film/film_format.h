// SPDX-License-Identifier: BSD-3-Clause
// How the pictures of a film are encoded: from what a user chose to the arguments of ffmpeg.
#pragma once

#include <string>
#include <vector>

#include <glm/vec2.hpp>

#include "core/scene/outputs.h"

namespace meniscus {

/// The pixels that an encoder takes: rows from the top, sRGB, channels of 16 bits little-endian.
struct FilmPixels {
  int channels = 3;  ///< 4: and alpha
  int bytes = 1;     ///< of a channel, 1 or 2
};

/// A format that a container can hold.
struct FilmEncoder {
  std::vector<std::string> arguments;  ///< of ffmpeg, behind its input
  FilmPixels pixels;
  glm::ivec2 unit{1};   ///< the size of a picture is a multiple of it
  glm::ivec2 least{1};  ///< and at least this
};

/// Does the name end as films do: .mp4, .mov, .mkv, .webm, .gif?
bool is_film_path(const std::string& path);

/// What is right for a film of that name. Throws UsageError for a codec that its container does not hold, and for bits,
/// chroma, a rate factor or transparency that its codec does not have.
FilmEncoder film_encoder(const std::string& path, const FilmFormat& format);

std::vector<std::string> film_codec_names();

}  // namespace meniscus
