// SPDX-License-Identifier: BSD-3-Clause
// Modules: parts of the program that are loaded when they are first needed, for the libraries they bring take time and
// memory at every start.
#pragma once

#include <cstddef>

namespace meniscus {

/// What to load, and what to say where that fails.
struct ModuleFile {
  const char* name;     ///< of the file, which lies beside the program or in lib/meniscus of its installation
  const char* built;    ///< its path where the program was built, for programs elsewhere in that folder
  const char* purpose;  ///< what needs it: "pictures"
  /// Bytes of address space that its libraries take. Among them are some that end the program when they begin without
  /// memory: so there has to be room for all before the first is loaded.
  std::size_t room;
};

/// Loads the module, and gives the address of one of its functions. Throws RequestError where the module is missing,
/// CapacityError where the system cannot load it.
void* load_from_module(const ModuleFile& module, const char* function);

/// Throws Error: the module does not fit the program.
[[noreturn]] void refuse_module(const ModuleFile& module);

}  // namespace meniscus
