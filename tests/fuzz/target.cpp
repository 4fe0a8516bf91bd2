// SPDX-License-Identifier: BSD-3-Clause
// The list of targets, and what they share.
#include "tests/fuzz/target.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <stdexcept>
#include <vector>

namespace meniscus::fuzz {
namespace {

std::vector<Target>& list() {
  static std::vector<Target> all;
  return all;
}

}  // namespace

std::span<const Target> targets() { return list(); }

Registration::Registration(const char* name, void (*run)(std::string_view)) {
  const auto behind = std::ranges::upper_bound(list(), std::string_view(name), {}, &Target::name);
  list().insert(behind, {name, run});
}

void require(bool holds, const char* property) {
  if (!holds) throw PropertyError(std::string("does not hold: ") + property);
}

void require_clear(const std::exception& error) {
  const std::string_view text = error.what();
  require(!text.empty(), "an error says what is wrong");
  const bool steers = std::ranges::any_of(text, [](char c) { return (c >= 0 && c < 0x20 && c != '\n') || c == 0x7f; });
  require(!steers, "an error holds no control characters");
}

ScratchFile::ScratchFile(const std::string& name) {
  std::string pattern = (std::filesystem::temp_directory_path() / "meniscus-fuzz-XXXXXX").string();
  if (!::mkdtemp(pattern.data())) throw std::runtime_error("no folder for scratch files");
  folder_ = pattern;
  path_ = (folder_ / name).string();
}

ScratchFile::~ScratchFile() {
  std::error_code ignored;
  std::filesystem::remove_all(folder_, ignored);
}

const std::string& ScratchFile::write(std::string_view bytes) const {
  std::ofstream file(path_, std::ios::binary | std::ios::trunc);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  file.close();
  if (!file) throw std::runtime_error("scratch files cannot be written");
  return path_;
}

}  // namespace meniscus::fuzz
