// SPDX-License-Identifier: BSD-3-Clause
// Maps exceptions to statuses, stores the last message of each thread, and checks arrays of callers.
#include "exporters/bindings/c/c_calls.h"

#include <array>
#include <new>
#include <system_error>

#include "core/base/error.h"
#include "core/properties/properties.h"

namespace meniscus::c_api {
namespace {

/// The last message of this thread. It has a fixed size, because it is also written if memory does not suffice.
thread_local std::array<char, 4096> last_error{};

/// Stores a message. A message that is too long is cut between two characters.
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

std::size_t require_rows(const void* data, const CallerRows& rows, const char* name) {
  const std::size_t row = rows.width * rows.number, stride = rows.stride == 0 ? row : rows.stride;
  if (rows.count == 0) return stride;
  require(data, name);
  const auto address = reinterpret_cast<std::uintptr_t>(data);
  if (address % rows.number != 0)
    refuse(MENISCUS_USAGE, "{} is not aligned: its address is not a multiple of {}", name, rows.number);
  if (stride > kMostBytes)
    refuse(MENISCUS_USAGE, "{}_stride is {} bytes, which is -{} with a sign; rows must ascend", name, stride,
           ~stride + 1);
  if (stride < row || stride % rows.number != 0)
    refuse(MENISCUS_USAGE, "{}_stride is {} bytes; rows of {} numbers of {} bytes need a multiple of {}, at least {}",
           name, stride, rows.width, rows.number, rows.number, row);
  const std::size_t room = std::min<std::size_t>(kMostBytes, std::numeric_limits<std::uintptr_t>::max() - address);
  if (stride > room / rows.count)
    refuse(MENISCUS_USAGE, "{}: {} rows, {} bytes from one to the next, do not fit into memory", name, rows.count,
           stride);
  return stride;
}

void require_apart(const void* written, std::size_t written_bytes, const char* written_name, const void* read,
                   std::size_t read_bytes, const char* read_name) {
  const auto a = reinterpret_cast<std::uintptr_t>(written), b = reinterpret_cast<std::uintptr_t>(read);
  if (a < b + read_bytes && b < a + written_bytes)
    refuse(MENISCUS_USAGE, "{} and {} overlap; what is written needs room of its own", written_name, read_name);
}

void check_number(std::string_view key, const char* name, double value, const char* unit) {
  const Property& property = property_of(key);
  if (!property.is_within(value))
    refuse(MENISCUS_INPUT, "{} is {} {}; it has to be {} to {}", name, value, unit, property.lowest, property.highest);
}

}  // namespace meniscus::c_api

const char* meniscus_last_error(void) { return meniscus::c_api::last_error.data(); }

const char* meniscus_version(void) { return MENISCUS_VERSION; }
