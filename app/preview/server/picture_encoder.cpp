// SPDX-License-Identifier: BSD-3-Clause
// JPEG through TurboJPEG, PNG through OpenImageIO.
#include "app/preview/server/picture_encoder.h"

#include <string>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <turbojpeg.h>

#include "core/base/error.h"

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
  constexpr int kQuickly = 1;  // of 9; more takes ten times as long for a tenth less
  std::vector<std::uint8_t> bytes;
  OIIO::Filesystem::IOVecOutput sink(bytes);
  void* const proxy = &sink;
  OIIO::ImageSpec spec(size.x, size.y, 3, OIIO::TypeDesc::UINT8);
  spec.attribute("oiio:ColorSpace", "sRGB");
  spec.attribute("png:compressionLevel", kQuickly);
  spec.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &proxy);
  const auto output = OIIO::ImageOutput::create("picture.png");
  if (!output) throw Error("PNG: " + OIIO::geterror());
  if (!output->open("picture.png", spec) || !output->write_image(OIIO::TypeDesc::UINT8, rgba.data(), 4) ||
      !output->close())
    throw Error("PNG: " + output->geterror());
  return bytes;
}

}  // namespace meniscus
