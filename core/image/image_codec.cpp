// SPDX-License-Identifier: BSD-3-Clause
// Finds and loads the module beside the program, in lib/meniscus of its installation, or where it was built.
#include "core/image/image_codec.h"

#include <array>
#include <filesystem>
#include <system_error>

#include <dlfcn.h>

#include "core/base/error.h"

namespace meniscus {
namespace {

namespace fs = std::filesystem;

/// What the module gives, or `why` it gives nothing.
const ImageCodec* load(const fs::path& module, std::string& why) {
  using Give = const ImageCodec*(const char* version, std::size_t image_size);
  void* const handle = ::dlopen(module.c_str(), RTLD_NOW | RTLD_LOCAL);
  void* const give = handle ? ::dlsym(handle, "meniscus_image_codec") : nullptr;
  if (!give) {
    why = ::dlerror();
    return nullptr;
  }
  const ImageCodec* const codec = reinterpret_cast<Give*>(give)(MENISCUS_VERSION, sizeof(ImageToEncode));
  if (!codec) why = module.string() + " belongs to another build";
  return codec;
}

const ImageCodec& load_from_anywhere() {
  const std::string name = MENISCUS_IMAGE_MODULE_NAME;
  std::error_code none;
  const fs::path program = fs::read_symlink("/proc/self/exe", none).parent_path();
  std::string why;
  for (const fs::path& module : {program / name, program / "../lib/meniscus" / name, fs::path(MENISCUS_IMAGE_MODULE)}) {
    if (!fs::exists(module, none)) continue;
    if (const ImageCodec* codec = load(module, why)) return *codec;
  }
  throw Error("pictures need " + name + " beside the program: " + (why.empty() ? "it is not there" : why));
}

}  // namespace

std::size_t pixel_bytes(const ImageToEncode& image) {
  constexpr std::array<std::size_t, 3> kBytes{1, 2, 4};
  return static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height) * image.channels.size() *
         kBytes[static_cast<std::size_t>(image.sample)];
}

const ImageCodec& image_codec() {
  static const ImageCodec& codec = load_from_anywhere();
  return codec;
}

}  // namespace meniscus
