// SPDX-License-Identifier: BSD-3-Clause
// Goes from chunk to chunk.
#include "core/image/png_note.h"

#include <array>
#include <cstdint>
#include <fstream>

namespace meniscus {
namespace {

constexpr std::string_view kSignature("\x89PNG\r\n\x1a\n", 8);
constexpr std::uint32_t kLongestNote = 16u << 20;

std::uint32_t word_at(const char* bytes) {
  std::uint32_t word = 0;
  for (int n = 0; n < 4; ++n) word = word << 8 | static_cast<unsigned char>(bytes[n]);
  return word;
}

}  // namespace

bool is_png(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::array<char, 8> head{};
  return file.read(head.data(), head.size()) && std::string_view(head.data(), head.size()) == kSignature;
}

std::optional<std::string> png_note(const std::filesystem::path& path, std::string_view key) {
  std::ifstream file(path, std::ios::binary);
  std::array<char, 8> head{};
  if (!file.read(head.data(), head.size()) || std::string_view(head.data(), head.size()) != kSignature) return {};
  // Key, its end, compression, its method, ends of language and translated key.
  std::string start(key);
  start.append(5, '\0');
  while (file.read(head.data(), head.size())) {
    const std::uint32_t length = word_at(head.data());
    const std::string_view kind(head.data() + 4, 4);
    if (kind == "IDAT" || kind == "IEND") return {};  // ours stand before the pixels
    if (kind == "iTXt" && length <= kLongestNote) {
      std::string content(length, '\0');
      if (!file.read(content.data(), length)) return {};
      if (content.starts_with(start)) return content.substr(start.size());
      file.seekg(4, std::ios::cur);
    } else {
      file.seekg(static_cast<std::streamoff>(length) + 4, std::ios::cur);
    }
  }
  return {};
}

}  // namespace meniscus
