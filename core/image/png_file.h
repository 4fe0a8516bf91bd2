// SPDX-License-Identifier: BSD-3-Clause
// PNG files, with their texts, without a library of many formats, which takes longer to load than a small picture to
// write.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string_view>

#include "core/image/image_codec.h"

namespace meniscus {

/// Returns a whole stream in zlib's format (RFC 1950). level: libdeflate's, from 1 to 12. Throws CapacityError if there
/// is not enough memory to compress.
std::vector<std::uint8_t> zlib_stream(std::span<const std::byte> bytes, int level);

/// Appends a number, the most significant byte first.
void add_word(std::vector<std::uint8_t>& bytes, std::uint32_t word);

/// Appends a chunk: its length, its type, its contents, and their checksum.
void add_chunk(std::vector<std::uint8_t>& file, std::string_view type, std::span<const std::uint8_t> content);

/// A stream of compressed rows. Its output does not depend on how many rows are added at once.
class PngStream {
 public:
  using Write = std::function<void(std::span<const std::uint8_t> bytes)>;
  /// size: size of all rows in bytes. Up to `together` bytes are compressed as one stream, more in pieces. level: up to
  /// 9, negative for the default. Throws CapacityError if there is not enough memory to compress.
  PngStream(const Write& write, std::size_t size, std::size_t together, int level);

  /// Returns room for filtered rows, which must be written before the next call.
  std::span<std::uint8_t> room(std::size_t size);
  /// Must be called after the last row.
  void finish();

 private:
  static constexpr std::size_t kPart = 1 << 20;  // the piece of one thread
  static constexpr std::size_t kPiece = 16 * kPart;
  static constexpr std::size_t kWindow = 1 << 15;

  void write_pieces();
  void write_piece(std::size_t size, bool is_last);
  void add_chunks(std::span<const std::uint8_t> stream);

  const Write& write_;
  const bool in_pieces_;
  const int level_;
  std::vector<std::uint8_t> rows_, before_;  // rows to be compressed; the end of the compressed ones
  std::uint32_t sum_ = 1;
};

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
  std::size_t pixel_, row_size_;  // bytes
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
