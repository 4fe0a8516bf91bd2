// SPDX-License-Identifier: BSD-3-Clause
// Writes the pixels of a PNG file: filtered rows, compressed into chunks.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string_view>
#include <vector>

namespace meniscus {

/// Appends a number, the most significant byte first.
void add_word(std::vector<std::uint8_t>& bytes, std::uint32_t word);

/// Appends a chunk: its length, its type, its contents, and their checksum.
void add_chunk(std::vector<std::uint8_t>& file, std::string_view type, std::span<const std::uint8_t> content);

/// A stream of compressed rows. Its output does not depend on how many rows are added at once.
class PngStream {
 public:
  using Write = std::function<void(std::span<const std::uint8_t> bytes)>;
  /// size: of all rows in bytes. Up to `together` bytes are compressed as one stream, more in pieces. level: up to 9,
  /// negative for the default. Throws CapacityError if there is not enough memory to compress.
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

}  // namespace meniscus
