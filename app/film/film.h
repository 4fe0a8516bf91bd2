// SPDX-License-Identifier: BSD-3-Clause
// Films that ffmpeg encodes from pictures: their formats, and whether such a file is complete.
#pragma once

#include "app/process/child_process.h"
#include "core/base/output_file.h"
#include "core/scene/outputs.h"

namespace meniscus {

/// The pixels that an encoder takes: rows from the top, sRGB, channels of 16 bits in little-endian order.
struct FilmPixels {
  int channels = 3;  ///< 3, or 4 with alpha
  int bytes = 1;     ///< bytes of a channel, 1 or 2
};

/// The encoder of a film's format.
struct FilmEncoder {
  std::vector<std::string> arguments;  ///< arguments of ffmpeg, after its input
  FilmPixels pixels;
  glm::ivec2 unit{1};   ///< the size of a picture is a multiple of this size
  glm::ivec2 least{1};  ///< the smallest size of a picture
};

/// Returns true if the name ends in .mp4, .mov, .mkv, .webm or .gif.
bool is_film_path(const std::string& path);

/// Returns how a film of this name is encoded. Throws UsageError for a codec that its container does not hold, and for
/// bits, chroma, a rate factor or transparency that its codec does not have.
FilmEncoder film_encoder(const std::string& path, const FilmFormat& format);

std::vector<std::string> film_codec_names();

/// Returns why the file is not a complete film of this many pictures; the text is empty if it is one. MP4 and MOV
/// (ISO/IEC 14496-12): the boxes fill the file, and the table of samples has all pictures and no more bytes than the
/// media data. Matroska (RFC 9559), in .mkv and .webm: the elements fill the file, the clusters hold all pictures, and
/// there are cues to seek by. GIF (CompuServe 1990): the blocks fill the file, and the trailer ends it.
std::string film_fault(const std::filesystem::path& path, std::uint64_t pictures);

/// Throws UsageError unless the encoder takes the size in pixels, which is even if the encoder halves colours.
void check_film_size(const FilmEncoder& encoder, glm::ivec2 size);

/// Writes one film, in BT.709; equal pictures give equal bytes on one machine. The film appears under its name when
/// finish() succeeds: ffmpeg reported no error and the file is complete. Throws OutputError if the program ffmpeg is
/// missing or fails.
class FilmWriter {
 public:
  /// Throws UsageError for values that the format cannot have.
  FilmWriter(const std::string& path, Existing existing, glm::ivec2 size, double frames_per_second,
             const FilmFormat& format = {});

  /// Returns the kind of pixels that add() takes.
  const FilmPixels& pixels() const { return pixels_; }

  void add(std::span<const std::uint8_t> picture);
  void finish();

 private:
  /// Waits for the encoder's end and returns why its file is not a film; the text is empty if it is one.
  std::string fault();

  OutputFile file_;
  FilmPixels pixels_;
  std::uint64_t added_ = 0;  ///< number of pictures
  std::optional<FedProcess> encoder_;
};

}  // namespace meniscus
