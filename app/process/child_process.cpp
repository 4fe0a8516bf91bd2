// SPDX-License-Identifier: BSD-3-Clause
// The common part of children on every system: lines, bytes and the texts about their ends.
#include "app/process/child_process.h"

#include <array>
#include <utility>

#include <fmt/format.h>

#include "app/process/system_process.h"
#include "core/base/system_file.h"

namespace meniscus {
namespace {

constexpr std::size_t kLongestLine = 1 << 16;
constexpr int kKilled = kSignalCode + 9;  // the code of a child that SIGKILL ended

}  // namespace

std::optional<std::string> ChildProcess::next_line() {
  while (true) {
    const std::size_t end = pending_.find('\n');
    if (end != std::string::npos) {
      std::string line = pending_.substr(0, end);
      pending_.erase(0, end + 1);
      return line;
    }
    if (pending_.size() >= kLongestLine) return std::exchange(pending_, {});
    std::array<char, 4096> part{};
    const std::ptrdiff_t count = system_file::read(output_, reinterpret_cast<std::byte*>(part.data()), part.size());
    if (count <= 0) break;
    pending_.append(part.data(), static_cast<std::size_t>(count));
  }
  if (pending_.empty()) return {};
  return std::exchange(pending_, {});
}

bool FedProcess::feed(std::span<const std::uint8_t> bytes) {
  while (!bytes.empty()) {
    const std::ptrdiff_t sent = system_process::send(input_, bytes);
    if (sent <= 0) return false;
    bytes = bytes.subspan(static_cast<std::size_t>(sent));
  }
  return true;
}

std::string FedProcess::complaints() const {
  std::array<char, 2000> text{};
  const std::ptrdiff_t length =
      system_file::read_at(complaints_, reinterpret_cast<std::byte*>(text.data()), text.size(), 0);
  return {text.data(), length > 0 ? static_cast<std::size_t>(length) : 0};
}

std::string signal_text(int code) {
  return code == kKilled ? std::string("the process that made it was killed, as when memory runs out")
                         : fmt::format("the process that made it was ended by signal {}", code - kSignalCode);
}

int signal_exit_code(int code) { return code == kKilled ? kExitCapacity : kExitInternal; }

}  // namespace meniscus
