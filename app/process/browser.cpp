// SPDX-License-Identifier: BSD-3-Clause
// Chooses the program that opens addresses, and waits for its exit code on a thread.
#include "app/process/browser.h"

#include <cstdlib>
#include <thread>
#include <utility>

#include <fmt/format.h>

#include "app/process/child_process.h"

namespace meniscus {
namespace {

std::string variable(const char* name) {
  const char* const value = std::getenv(name);
  return value ? value : "";
}

#if defined(__APPLE__)
constexpr const char* kOpener = "open";
bool has_display() { return true; }
#else
constexpr const char* kOpener = "xdg-open";
bool has_display() { return !variable("DISPLAY").empty() || !variable("WAYLAND_DISPLAY").empty(); }
#endif

}  // namespace

void open_in_browser(const std::string& address, std::function<void(const std::string& reason)> failed) {
  // Editors on another machine name a program that needs no display here. A list of names, and names with arguments,
  // are for xdg-open.
  std::string opener = variable("BROWSER");
  if (opener.empty() || opener.find_first_of(" :%") != std::string::npos) {
    if (!has_display()) return failed("there is no display");
    opener = kOpener;
  }
  std::thread([opener, address, failed = std::move(failed)] {
    const int code = run_apart({opener, address});
    if (code == kNotStarted) return failed(opener + " cannot be started");
    if (code != 0) failed(fmt::format("{} ended with code {}", opener, code));
  }).detach();
}

}  // namespace meniscus
