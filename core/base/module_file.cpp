// SPDX-License-Identifier: BSD-3-Clause
// Finds modules next to the program, in its installation or by the loader, and loads them. The library alone has none,
// nor have programs that are built without them.
#include "core/base/module_file.h"

#include <fmt/format.h>

#include "core/base/error.h"

#ifdef MENISCUS_WITH_MODULES

#include <filesystem>
#include <string>
#include <system_error>

#include <dlfcn.h>
#include <sys/mman.h>

#include "core/base/system_file.h"

namespace meniscus {
namespace {

namespace fs = std::filesystem;

void require_address_space(const ModuleFile& module) {
  void* const room = ::mmap(nullptr, module.room, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (room == MAP_FAILED)
    throw CapacityError("{} need {} MiB of address space more (ulimit -v)", module.purpose, module.room >> 20);
  ::munmap(room, module.room);
}

std::string path_of(const ModuleFile& module) {
  std::error_code none;
  const fs::path program = system_file::program_path().parent_path();
  for (const fs::path& path : {program / module.name, program / "../lib/meniscus" / module.name})
    if (fs::exists(path, none)) return path.string();
  return module.name;
}

}  // namespace

void* load_from_module(const ModuleFile& module, const char* function) {
  const std::string path = path_of(module);
  require_address_space(module);
  void* const handle = ::dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  void* const address = handle ? ::dlsym(handle, function) : nullptr;
  if (address) return address;
  if (!handle && path == module.name)
    throw RequestError(
        "{} need {} next to the program, but it is missing; it is in the packages for Debian and in "
        "builds from source (meniscus help install)",
        module.purpose, module.name);
  const char* const why = ::dlerror();
  throw CapacityError("{} need {}, which cannot be loaded: {}", module.purpose, module.name, why ? why : path.c_str());
}

#else

namespace meniscus {

void* load_from_module(const ModuleFile& module, const char*) {
  throw RequestError(
      "{} need {}, which is not part of this build; the packages for Debian and builds from source have it (meniscus "
      "help install)",
      module.purpose, module.name);
}

#endif

void refuse_module(const ModuleFile& module) {
  throw Error("{} belongs to another build; install it together with the program", module.name);
}

}  // namespace meniscus
