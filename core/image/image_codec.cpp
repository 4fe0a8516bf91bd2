// SPDX-License-Identifier: BSD-3-Clause
// Loads the module with OpenImageIO, and finds the time that files bear.
#include "core/image/image_codec.h"

#include <charconv>
#include <cstdlib>
#include <string_view>

#include "core/base/module_file.h"
#include "core/base/version.h"

namespace meniscus {
namespace {

const ImageCodec& load() {
  constexpr ModuleFile kModule{"meniscus_openimageio.so", "reading pictures, and writing WebP and EXR,",
                               std::size_t{640} << 20};
  using Give = const ImageCodec*(const char* version, std::size_t image_size);
  void* const give = load_from_module(kModule, "meniscus_image_codec");
  if (const ImageCodec* const codec = reinterpret_cast<Give*>(give)(MENISCUS_VERSION, sizeof(ImageToEncode)))
    return *codec;
  refuse_module(kModule);
}

}  // namespace

const ImageCodec& image_codec() {
  static const ImageCodec& codec = load();
  return codec;
}

std::time_t source_date() {
  const char* const text = std::getenv("SOURCE_DATE_EPOCH");
  if (!text) return 0;
  std::int64_t seconds = 0;
  const std::string_view digits(text);
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), seconds);
  return error == std::errc() && end == digits.data() + digits.size() ? seconds : 0;
}

}  // namespace meniscus
