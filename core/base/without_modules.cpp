// SPDX-License-Identifier: BSD-3-Clause
// Replaces module_file.cpp in a build of the library alone, because modules belong to the program.
#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/module_file.h"

namespace meniscus {

void* load_from_module(const ModuleFile& module, const char*) {
  throw Error(
      fmt::format("{} are for the program meniscus: the library alone does not have {}", module.purpose, module.name));
}

void refuse_module(const ModuleFile& module) {
  throw Error(fmt::format("{} belongs to another build; install it together with the program", module.name));
}

}  // namespace meniscus
