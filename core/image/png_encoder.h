// SPDX-License-Identifier: BSD-3-Clause
// PNG files without a library of many formats, whose loading takes longer than a small picture.
#pragma once

#include <cstdint>
#include <vector>

#include "core/image/image_codec.h"

namespace meniscus {

/// The bytes of the file (W3C, Portable Network Graphics, 2nd edition: 8 bits a channel), with the pixels and the notes
/// that OpenImageIO would write. image.bytes has the pixels. Throws CapacityError where there is no memory to compress.
std::vector<std::uint8_t> encode_png(const ImageToEncode& image);

}  // namespace meniscus
