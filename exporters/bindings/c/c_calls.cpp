// SPDX-License-Identifier: BSD-3-Clause
// Maps exceptions to codes, and keeps the last message of each thread.
#include "exporters/bindings/c/c_calls.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <new>
#include <string_view>
#include <system_error>

#include "core/base/error.h"
#include "core/base/version.h"

namespace meniscus::c_api {
namespace {

/// In place, so that a text can be kept when there is no memory, and nothing has to end with its thread.
thread_local std::array<char, 4096> last_error{};

/// Cut at the start of a character, where it is too long.
void keep(std::string_view text) noexcept {
  std::size_t length = std::min(text.size(), last_error.size() - 1);
  if (length < text.size())
    while (length > 0 && (static_cast<unsigned char>(text[length]) & 0xc0) == 0x80) --length;
  std::memcpy(last_error.data(), text.data(), length);
  last_error[length] = '\0';
}

meniscus_status kept(meniscus_status status, std::string_view text) noexcept {
  keep(text);
  return status;
}

}  // namespace

meniscus_status report(const std::exception_ptr& error) noexcept {
  try {
    std::rethrow_exception(error);
  } catch (const Refusal& refusal) {
    return kept(refusal.status(), refusal.what());
  } catch (const InputError& input) {
    return kept(MENISCUS_INPUT, input.what());
  } catch (const SelectionError& selection) {
    return kept(MENISCUS_USAGE, selection.what());
  } catch (const RequestError& request) {
    return kept(MENISCUS_USAGE, request.what());
  } catch (const GpuError& gpu) {
    return kept(MENISCUS_NO_GPU, gpu.what());
  } catch (const CapacityError& capacity) {
    return kept(MENISCUS_CAPACITY, capacity.what());
  } catch (const OutputError& output) {
    return kept(MENISCUS_OUTPUT, output.what());
  } catch (const OpenSurfaceError& open) {
    return kept(MENISCUS_NOT_CLOSED, open.what());
  } catch (const std::bad_alloc&) {
    return kept(MENISCUS_CAPACITY, "out of memory");
  } catch (const std::length_error&) {
    return kept(MENISCUS_CAPACITY, "out of memory: something would be longer than memory can be");
  } catch (const std::system_error& system) {
    return kept(MENISCUS_CAPACITY, system.what());  // no thread, no lock
  } catch (const std::exception& other) {
    return kept(MENISCUS_INTERNAL, other.what());
  } catch (...) {
    return kept(MENISCUS_INTERNAL, "an exception without a text");
  }
}

}  // namespace meniscus::c_api

const char* meniscus_last_error(void) { return meniscus::c_api::last_error.data(); }

const char* meniscus_version(void) { return MENISCUS_VERSION; }
