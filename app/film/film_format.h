// SPDX-License-Identifier: BSD-3-Clause
// How the pictures of a film are encoded: what a user may choose, and what ffmpeg is told of it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <glm/vec2.hpp>

namespace meniscus {

/// As asked for; what is empty or 0 is left to the codec, and the codec to the ending of the name.
struct FilmFormat {
  std::string codec;               ///< h264, h265, vp9, prores, prores4444, dnxhr or gif
  std::optional<int> rate_factor;  ///< --crf: less is better and larger
  int bits = 0;                    ///< of a channel, 8 or 10
  int chroma = 0;                  ///< 420, 422 or 444: colour in how many of the pixels

  bool operator==(const FilmFormat&) const = default;
};

/// The pixels that an encoder takes: rows from the top, sRGB, channels of 16 bits little-endian.
struct FilmPixels {
  int channels = 3;  ///< 4: and alpha, as ProRes 4444 keeps it
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
/// chroma or a rate factor that its codec does not have.
FilmEncoder film_encoder(const std::string& path, const FilmFormat& format);

std::vector<std::string> film_codec_names();

}  // namespace meniscus
