// SPDX-License-Identifier: BSD-3-Clause
// Keeps the words that main() got, and finds files from the program's own place: no path of the machine that built it
// is kept.
#include "app/process/this_program.h"

#include <filesystem>
#include <system_error>

#include "core/base/system_file.h"
#include "core/base/text.h"

namespace meniscus {
namespace {

namespace fs = std::filesystem;

std::string& remembered() {
  static std::string line;
  return line;
}

}  // namespace

std::filesystem::path addon_folder() {
  std::error_code none;
  const fs::path program = system_file::program_path().parent_path();
  const fs::path installed = program.parent_path() / "share/meniscus/addon", built = program / "share/meniscus/addon";
  return !fs::exists(installed, none) && fs::exists(built, none) ? built : installed;
}

void remember_command_line(std::span<const char* const> words) {
  std::string& line = remembered();
  line.clear();
  for (std::size_t n = 0; n < words.size(); ++n)
    line += n == 0 ? fs::path(words[0]).filename().string() : " " + escaped(shell_word(words[n]));
}

std::string command_line() { return remembered(); }

}  // namespace meniscus
