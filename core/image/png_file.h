// SPDX-License-Identifier: BSD-3-Clause
// PNG files without a library of many formats, whose loading takes longer than a small picture, and the texts in them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/image/image_codec.h"

namespace meniscus {

class PngStream;

/// Writes a file (W3C, Portable Network Graphics, 2nd edition: 8 bits a channel) as its rows come, with the pixels and
/// the notes that OpenImageIO would write. Throws CapacityError where there is no memory to compress.
class PngEncoder {
 public:
  /// Rows of at most so many bytes are compressed as one; those of larger pictures in pieces, which takes longer.
  static constexpr std::size_t kTogether = std::size_t{64} << 20;

  /// write: is given the bytes of the file, in their order.
  using Write = std::function<void(std::span<const std::uint8_t> bytes)>;
  PngEncoder(const ImageToEncode& image, Write write, std::size_t together = kTogether);
  ~PngEncoder();

  /// The next rows, any whole number of them, with `byte_stride` from pixel to pixel.
  void add(std::span<const std::uint8_t> rows, int byte_stride);
  /// Behind the last row.
  void finish();

 private:
  void filter(std::span<const std::uint8_t> rows);

  Write write_;
  std::size_t pixel_, row_size_;  // bytes
  bool averages_;
  std::vector<std::uint8_t> last_row_;  // nothing above the first
  std::unique_ptr<PngStream> stream_;
};

/// The bytes of a file of these pixels.
std::vector<std::uint8_t> encode_png(const ImageToEncode& image, std::span<const std::uint8_t> pixels, int byte_stride);

/// Under which key a picture has the scene that it was made of.
inline constexpr std::string_view kSceneNote = "Meniscus scene";
/// And a picture of a run that can be resumed, of what the run was made.
inline constexpr std::string_view kMadeOfNote = "Meniscus run";

/// Whether a file begins as PNG files do.
bool is_png(const std::filesystem::path& path);

/// The uncompressed text that a PNG file has under this key (iTXt; Portable Network Graphics, W3C 2003, section
/// 11.3.4.5); nothing if it has none or is not a PNG file.
std::optional<std::string> png_note(const std::filesystem::path& path, std::string_view key);

/// True if a file ends as whole PNG files do.
bool ends_as_png(const std::filesystem::path& path);

/// Returns a PNG file without its chunks of time and text (tIME, tEXt, zTXt, iTXt; PNG, W3C 2003), so that the same
/// picture is the same file. Pixels and colour space stay as they are. Returns nothing if it is no whole PNG file.
std::optional<std::string> png_without_time(std::string_view file);

}  // namespace meniscus
