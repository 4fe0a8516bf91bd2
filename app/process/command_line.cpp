// SPDX-License-Identifier: BSD-3-Clause
// Keeps the words that main() got.
#include "app/process/command_line.h"

#include <filesystem>

#include "core/base/text.h"

namespace meniscus {
namespace {

std::string& remembered() {
  static std::string line;
  return line;
}

}  // namespace

void remember_command_line(std::span<const char* const> words) {
  std::string& line = remembered();
  line.clear();
  for (std::size_t n = 0; n < words.size(); ++n)
    line += n == 0 ? std::filesystem::path(words[0]).filename().string() : " " + escaped(shell_word(words[n]));
}

std::string command_line() { return remembered(); }

}  // namespace meniscus
