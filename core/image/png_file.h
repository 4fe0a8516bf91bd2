// SPDX-License-Identifier: BSD-3-Clause
// Writes PNG files without a library of many formats, which would take longer to load than a small picture to write;
// reads and adds texts in them.
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

/// Writes a file (W3C, Portable Network Graphics, 2nd edition: 8 bits per channel) as its rows come, with the same
/// pixels and notes as OpenImageIO. Throws CapacityError if there is not enough memory to compress.
class PngEncoder {
 public:
  /// The size in bytes up to which rows are compressed as one stream; larger pictures are compressed in pieces, which
  /// takes longer.
  static constexpr std::size_t kTogether = std::size_t{64} << 20;

  /// A function that receives the bytes of the file in order.
  using Write = std::function<void(std::span<const std::uint8_t> bytes)>;
  PngEncoder(const ImageToEncode& image, Write write, std::size_t together = kTogether);
  ~PngEncoder();

  /// Adds the next rows, any whole number of them, with `byte_stride` from pixel to pixel.
  void add(std::span<const std::uint8_t> rows, int byte_stride);
  /// Must be called after the last row.
  void finish();

 private:
  void filter(std::span<const std::uint8_t> rows);

  Write write_;
  std::size_t pixel_, row_size_;  // in bytes
  bool averages_;
  std::vector<std::uint8_t> last_row_;  // zeros above the first row
  std::unique_ptr<PngStream> stream_;
};

/// Returns the bytes of a file with these pixels.
std::vector<std::uint8_t> encode_png(const ImageToEncode& image, std::span<const std::uint8_t> pixels, int byte_stride);

/// The key of the text with the scene of a picture.
inline constexpr std::string_view kSceneNote = "Meniscus scene";
/// The key of the text in a picture of a resumable run that identifies the run.
inline constexpr std::string_view kMadeOfNote = "Meniscus run";

/// True if a file begins like a PNG file.
bool is_png(const std::filesystem::path& path);

/// Returns the uncompressed text under this key in a PNG file (iTXt; Portable Network Graphics, W3C 2003, section
/// 11.3.4.5); nothing if there is none or the file is not PNG.
std::optional<std::string> png_note(const std::filesystem::path& path, std::string_view key);

/// True if a file ends as whole PNG files do.
bool ends_as_png(const std::filesystem::path& path);

/// Returns a PNG file without its chunks of time and text (tIME, tEXt, zTXt, iTXt; PNG, W3C 2003), so that the same
/// picture is the same file. Pixels and colour space stay as they are. Returns nothing if it is no whole PNG file.
std::optional<std::string> png_without_time(std::string_view file);

}  // namespace meniscus
