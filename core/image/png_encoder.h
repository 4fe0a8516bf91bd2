// SPDX-License-Identifier: BSD-3-Clause
// PNG files without a library of many formats, whose loading takes longer than a small picture.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
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

}  // namespace meniscus
