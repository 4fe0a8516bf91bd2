// SPDX-License-Identifier: BSD-3-Clause
// The files that journals take, TIFF and JPEG, without a library of many formats.
#pragma once

#include "core/image/image_codec.h"

namespace meniscus {

/// The purpose of a JPEG file.
enum class JpegUse : std::uint8_t {
  draft,  ///< a picture that moves: it is encoded fast, and colours have half the resolution
  page,   ///< a still picture of a page
  file,   ///< a file of its own: the loss is invisible, and text stays sharp
};

/// Returns a picture as JPEG. pixels: rows from the top, 3 or 4 bytes a pixel; the fourth is left out. Throws Error if
/// TurboJPEG fails.
std::vector<std::uint8_t> encode_jpeg(std::span<const std::uint8_t> pixels, int width, int height, JpegUse use);

/// Returns an encoder of "tiff", with 8 or 16 bits per channel and the compression "none", "lzw" or "zip"; of "jpeg",
/// with three channels of 8 bits; or the codec's encoder for other formats. Throws the errors of image_codec();
/// std::runtime_error if a TIFF file would have more than 4 GiB, a JPEG file more than 65,500 pixels a side, or one of
/// its texts more than 64 KiB.
std::unique_ptr<RowEncoder> begin_rows(const ImageToEncode& image);

}  // namespace meniscus
