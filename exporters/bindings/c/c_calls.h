// SPDX-License-Identifier: BSD-3-Clause
// The boundary of the C interface: turns exceptions into codes, and messages for meniscus_last_error().
#pragma once

#include <exception>
#include <stdexcept>
#include <string>

#include <fmt/format.h>

#include "exporters/bindings/c/include/meniscus/meniscus.h"

namespace meniscus::c_api {

/// A call that is refused before anything is computed.
class Refusal : public std::runtime_error {
 public:
  Refusal(meniscus_status status, const std::string& text) : std::runtime_error(text), status_(status) {}
  meniscus_status status() const { return status_; }

 private:
  meniscus_status status_;
};

template <typename... Values>
[[noreturn]] void refuse(meniscus_status status, fmt::format_string<Values...> text, const Values&... values) {
  throw Refusal(status, fmt::vformat(fmt::string_view(text), fmt::make_format_args(values...)));
}

/// Keeps the text of the exception for this thread and returns its code.
meniscus_status report(const std::exception_ptr& error) noexcept;

/// Every function of the interface that can fail is one such call.
template <typename Call>
meniscus_status guarded(const Call& call) noexcept {
  try {
    call();
    return MENISCUS_OK;
  } catch (...) {
    return report(std::current_exception());
  }
}

}  // namespace meniscus::c_api
