// SPDX-License-Identifier: BSD-3-Clause
// Copies a PNG file chunk by chunk.
#include "app/farm/png_without_time.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <fstream>
#include <iterator>

#include "app/process/program_error.h"
#include "core/base/output_file.h"

namespace meniscus::farm {
namespace {

constexpr std::string_view kSignature = "\x89PNG\r\n\x1a\n";
constexpr std::array<std::string_view, 4> kDropped{"tIME", "tEXt", "zTXt", "iTXt"};
constexpr std::size_t kFrameBytes = 12;  // of a chunk, around its data: length, type, CRC

std::size_t big_endian(std::string_view bytes) {
  std::size_t value = 0;
  for (const char byte : bytes.substr(0, 4)) value = value << 8 | static_cast<std::uint8_t>(byte);
  return value;
}

}  // namespace

std::string png_without_time(std::string_view file) {
  if (!file.starts_with(kSignature)) throw RunError(kExitInput, "the picture is not a PNG file");
  std::string result(kSignature);
  file.remove_prefix(kSignature.size());
  for (std::string_view type; type != "IEND";) {
    const std::size_t size = file.size() < kFrameBytes ? file.size() : kFrameBytes + big_endian(file);
    if (file.size() < kFrameBytes || file.size() < size) throw RunError(kExitInput, "the picture ends in the middle");
    type = file.substr(4, 4);
    if (std::ranges::find(kDropped, type) == kDropped.end()) result.append(file.substr(0, size));
    file.remove_prefix(size);
  }
  return result;
}

bool is_png(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::array<char, kSignature.size()> begin{};
  file.read(begin.data(), begin.size());
  return file && std::string_view(begin.data(), begin.size()) == kSignature;
}

void remove_png_time(const std::filesystem::path& path) {
  std::ifstream written(path, std::ios::binary);
  const std::string bytes(std::istreambuf_iterator<char>(written), {});
  OutputFile file(path, Existing::replace);
  file.write(png_without_time(bytes));
  file.commit();
}

}  // namespace meniscus::farm
