// SPDX-License-Identifier: BSD-3-Clause
// Finds and loads the module beside the program, in lib/meniscus of its installation, or where it was built.
#include "core/image/image_codec.h"

#include <array>
#include <cstddef>
#include <filesystem>
#include <system_error>

#include <dlfcn.h>
#include <sys/mman.h>

#include <fmt/format.h>

#include "core/base/error.h"

namespace meniscus {
namespace {

namespace fs = std::filesystem;

/// What the module gives. Throws CapacityError where the system cannot load it, Error if it belongs to another build.
const ImageCodec& load(const fs::path& module) {
  using Give = const ImageCodec*(const char* version, std::size_t image_size);
  void* const handle = ::dlopen(module.c_str(), RTLD_NOW | RTLD_LOCAL);
  void* const give = handle ? ::dlsym(handle, "meniscus_image_codec") : nullptr;
  if (!give) {
    const char* const why = ::dlerror();
    throw CapacityError("pictures cannot be written: " + (why ? std::string(why) : module.string()));
  }
  if (const ImageCodec* const codec = reinterpret_cast<Give*>(give)(MENISCUS_VERSION, sizeof(ImageToEncode)))
    return *codec;
  throw Error(module.string() + " belongs to another build; install it together with the program");
}

// Among what OpenImageIO brings there are libraries that end the program when they begin without memory. So there has
// to be room for all of them before the first is loaded: together they take this much of the address space.
void require_room() {
  constexpr std::size_t kRoom = std::size_t{640} << 20;
  void* const room = ::mmap(nullptr, kRoom, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (room == MAP_FAILED)
    throw CapacityError(fmt::format("pictures need {} MiB of address space more (ulimit -v)", kRoom >> 20));
  ::munmap(room, kRoom);
}

const ImageCodec& find_and_load() {
  const std::string name = MENISCUS_IMAGE_MODULE_NAME;
  std::error_code none;
  const fs::path program = fs::read_symlink("/proc/self/exe", none).parent_path();
  for (const fs::path& module : {program / name, program / "../lib/meniscus" / name, fs::path(MENISCUS_IMAGE_MODULE)})
    if (fs::exists(module, none)) {
      require_room();
      return load(module);
    }
  throw Error("pictures need " + name + " beside the program, and it is not there");
}

}  // namespace

std::size_t pixel_bytes(const ImageToEncode& image) {
  constexpr std::array<std::size_t, 3> kBytes{1, 2, 4};
  return static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height) * image.channels.size() *
         kBytes[static_cast<std::size_t>(image.sample)];
}

const ImageCodec& image_codec() {
  static const ImageCodec& codec = find_and_load();
  return codec;
}

}  // namespace meniscus
