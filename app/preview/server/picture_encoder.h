// SPDX-License-Identifier: BSD-3-Clause
// Pictures as bytes for a browser: small and quick while something moves, exact at rest.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec2.hpp>

namespace meniscus {

/// Encodes JPEG with one compressor for all pictures.
class JpegEncoder {
 public:
  JpegEncoder();
  ~JpegEncoder();
  JpegEncoder(const JpegEncoder&) = delete;
  JpegEncoder& operator=(const JpegEncoder&) = delete;

  /// rgba: 4 bytes a pixel, rows from the top; alpha is left out. quality: 1 to 100. Throws Error.
  std::vector<std::uint8_t> encode(std::span<const std::uint8_t> rgba, glm::ivec2 size, int quality);

 private:
  void* compressor_;
};

/// The same pixels as PNG, nothing lost, lightly compressed. Throws Error.
std::vector<std::uint8_t> encode_png(std::span<const std::uint8_t> rgba, glm::ivec2 size);

}  // namespace meniscus
