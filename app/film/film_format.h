// SPDX-License-Identifier: BSD-3-Clause
// How the pictures of a film are encoded: from what a user chose to the arguments of ffmpeg.
#pragma once

#include <string>
#include <vector>

#include <glm/vec2.hpp>

#include "core/scene/outputs.h"

namespace meniscus {

/// The kind of pixels that an encoder takes: rows from the top, sRGB, channels of 16 bits in little-endian order.
struct FilmPixels {
  int channels = 3;  ///< 3, or 4 with alpha
  int bytes = 1;     ///< bytes of a channel, 1 or 2
};

/// A format that a container can hold.
struct FilmEncoder {
  std::vector<std::string> arguments;  ///< arguments of ffmpeg, behind its input
  FilmPixels pixels;
  glm::ivec2 unit{1};   ///< the size of a picture is a multiple of this size
  glm::ivec2 least{1};  ///< the smallest size of a picture
};

/// True if the name ends in .mp4, .mov, .mkv, .webm or .gif.
bool is_film_path(const std::string& path);

/// Returns how a film of this name is encoded. Throws UsageError for a codec that its container does not hold, and for
/// bits, chroma, a rate factor or transparency that its codec does not have.
FilmEncoder film_encoder(const std::string& path, const FilmFormat& format);

std::vector<std::string> film_codec_names();

}  // namespace meniscus
