// SPDX-License-Identifier: BSD-3-Clause
// The pixels of a PNG file: filtered rows, compressed into chunks.
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

/// Appends a chunk: its length, its type, what it holds, and their checksum.
void add_chunk(std::vector<std::uint8_t>& file, std::string_view type, std::span<const std::uint8_t> content);

/// What comes out does not depend on how many rows come at once.
class PngStream {
 public:
  using Write = std::function<void(std::span<const std::uint8_t> bytes)>;
  /// size: of all rows. Up to `together` bytes are compressed as one, more in pieces. level: of 9, negative for the
  /// usual. Throws CapacityError where there is no memory to compress.
  PngStream(const Write& write, std::size_t size, std::size_t together, int level);

  /// Room for filtered rows, which are there when the next ones are asked for.
  std::span<std::uint8_t> room(std::size_t size);
  /// Behind the last row.
  void finish();

 private:
  static constexpr std::size_t kPart = 1 << 20;  // one thread's
  static constexpr std::size_t kPiece = 16 * kPart;
  static constexpr std::size_t kWindow = 1 << 15;

  void write_pieces();
  void write_piece(std::size_t size, bool is_last);
  void add_chunks(std::span<const std::uint8_t> stream);

  const Write& write_;
  const bool in_pieces_;
  const int level_;
  std::vector<std::uint8_t> rows_, before_;  // not compressed yet; the end of what is
  std::uint32_t sum_ = 1;
};

}  // namespace meniscus
