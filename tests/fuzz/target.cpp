// SPDX-License-Identifier: BSD-3-Clause
// The list of targets, and their common functions.
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

/// Returns whether a text begins with a control character of ASCII but the line end, one of U+0080 to U+009F in UTF-8,
/// or U+2028 to U+202E, which turn a line around or break it.
bool begins_with_control(std::string_view text) {
  const auto byte = static_cast<unsigned char>(text[0]);
  if (text.size() > 2 && text.starts_with("\xe2\x80") && text[2] >= '\xa8' && text[2] <= '\xae') return true;
  if (byte == 0xc2 && text.size() > 1) return (static_cast<unsigned char>(text[1]) & 0xe0) == 0x80;
  return (byte < 0x20 && byte != '\n') || byte == 0x7f;
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
  for (std::size_t n = 0; n < text.size(); ++n)
    require(!begins_with_control(text.substr(n)), "an error holds no control characters");
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
