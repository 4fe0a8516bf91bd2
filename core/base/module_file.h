// SPDX-License-Identifier: BSD-3-Clause
// Modules: parts of the program that are loaded when they are first needed, because their libraries would cost time and
// memory at every start.
#pragma once

#include <cstddef>

namespace meniscus {

/// The file of a module, and how error messages describe it.
struct ModuleFile {
  /// Name of the file, which is in the folder of the program, in lib/meniscus of its installation or, for other
  /// programs of a build folder, in their run path.
  const char* name;
  const char* purpose;  ///< things that need the module: "pictures"
  /// Bytes of address space that its libraries take. Some of these libraries end the program if they start without
  /// memory, so that there must be room for all of them before the first is loaded.
  std::size_t room;
};

/// Loads the module and returns the address of one of its functions. Throws RequestError if the module is missing, and
/// CapacityError if the system cannot load it.
void* load_from_module(const ModuleFile& module, const char* function);

/// Throws an Error: the module belongs to another build than the program.
[[noreturn]] void refuse_module(const ModuleFile& module);

}  // namespace meniscus
