// SPDX-License-Identifier: BSD-3-Clause
// Maps errors to exit codes.
#include "app/process/program_error.h"

#include <filesystem>
#include <new>
#include <string_view>
#include <system_error>

namespace meniscus {
namespace {

template <typename Kind>
bool is(const std::exception& error) {
  return dynamic_cast<const Kind*>(&error) != nullptr;
}

/// Returns the code for something that the system refused: memory or another thread, or to make, rename or remove a
/// folder.
ExitCode code_of_system(const std::system_error& error) {
  if (error.code() == std::errc::not_enough_memory || error.code() == std::errc::resource_unavailable_try_again)
    return kExitCapacity;
  return is<std::filesystem::filesystem_error>(error) ? kExitOutput : kExitInternal;
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
  if (std::string_view(error.what()).starts_with("pthread_create"))
    return kExitCapacity;  // oneTBB reports it in these words
  if (const auto* system = dynamic_cast<const std::system_error*>(&error)) return code_of_system(*system);
  return kExitInternal;
}

}  // namespace meniscus
