// SPDX-License-Identifier: BSD-3-Clause
// Which error ends the program with which code.
#include "app/program_error.h"

#include <new>

namespace meniscus {
namespace {

template <typename Kind>
bool is(const std::exception& error) {
  return dynamic_cast<const Kind*>(&error) != nullptr;
}

}  // namespace

ExitCode exit_code_of(const std::exception& error) {
  if (const auto* run = dynamic_cast<const RunError*>(&error)) return run->code();
  if (is<RequestError>(error) || is<SelectionError>(error)) return kExitUsage;
  if (is<InputError>(error)) return kExitInput;
  if (is<GpuError>(error)) return kExitGpu;
  if (is<CapacityError>(error) || is<std::bad_alloc>(error)) return kExitCapacity;
  if (is<OutputError>(error)) return kExitOutput;
  if (is<OpenSurfaceError>(error)) return kExitNotClosed;
  return kExitInternal;
}

}  // namespace meniscus
