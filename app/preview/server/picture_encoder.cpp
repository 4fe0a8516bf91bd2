// SPDX-License-Identifier: BSD-3-Clause
// JPEG through TurboJPEG, PNG with the pixels of files.
#include "app/preview/server/picture_encoder.h"

#include <string>

#include <turbojpeg.h>

#include "core/base/error.h"
#include "core/image/png_file.h"

namespace meniscus {

JpegEncoder::JpegEncoder() : compressor_(tjInitCompress()) {
  if (!compressor_) throw Error(std::string("JPEG: ") + tjGetErrorStr2(nullptr));
}

JpegEncoder::~JpegEncoder() { tjDestroy(compressor_); }

std::vector<std::uint8_t> JpegEncoder::encode(std::span<const std::uint8_t> rgba, glm::ivec2 size, int quality) {
  unsigned char* bytes = nullptr;
  unsigned long count = 0;
  const int failed = tjCompress2(compressor_, rgba.data(), size.x, 0, size.y, TJPF_RGBX, &bytes, &count, TJSAMP_420,
                                 quality, TJFLAG_FASTDCT);
  std::vector<std::uint8_t> result;
  if (!failed) result.assign(bytes, bytes + count);
  tjFree(bytes);
  if (failed) throw Error(std::string("JPEG: ") + tjGetErrorStr2(compressor_));
  return result;
}

std::vector<std::uint8_t> encode_png(std::span<const std::uint8_t> rgba, glm::ivec2 size) {
  ImageToEncode image;
  image.format = "png";
  image.width = size.x;
  image.height = size.y;
  image.channels = {"R", "G", "B"};
  image.color_space = "sRGB";
  image.png_level = 1;  // of 9; more takes longer for a little less
  return meniscus::encode_png(image, rgba, 4);
}

}  // namespace meniscus
