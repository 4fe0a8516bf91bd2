// SPDX-License-Identifier: BSD-3-Clause
// Sorts the bytes of tables, deflates them, and writes them as text.
#include "exporters/page/page_data.h"

#include <nlohmann/json.hpp>

#include "core/image/png_file.h"

namespace meniscus::page {

std::string deflated(std::string_view bytes) {
  constexpr int kLevel = 6;  // as small as the best level of zlib, and 20 times as fast
  const std::vector<std::uint8_t> packed = zlib_stream(std::as_bytes(std::span(bytes)), kLevel);
  return {packed.begin(), packed.end()};
}

std::string text_of(const nlohmann::json& description) {
  return description.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string deflated(const nlohmann::json& description) { return deflated(std::string_view(text_of(description))); }

PageTable packed_table(std::string_view name, std::span<const std::byte> bytes, std::size_t stride, Packing packing) {
  if (packing == Packing::plain)
    return {std::string(name), stride, std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size())};
  const std::size_t count = bytes.size() / stride;
  std::string sorted;
  sorted.reserve(bytes.size());
  for (std::size_t byte = 0; byte < stride; ++byte)
    for (std::size_t n = 0; n < count; ++n) sorted.push_back(static_cast<char>(bytes[n * stride + byte]));
  return {std::string(name), stride, deflated(std::string_view(sorted))};
}

std::size_t PageData::add(std::string packed) {
  const auto [place, is_new] = numbers_.emplace(std::move(packed), parts_.size() + 1);
  if (is_new) {
    parts_.push_back(&place->first);
    size_ += place->first.size();
  }
  return place->second;
}

std::string PageData::bytes(const std::string& first) const {
  std::string all;
  all.reserve(size_ + first.size() + 4 * (parts_.size() + 2));
  const auto put = [&](std::size_t number) {
    for (int n = 0; n < 4; ++n) all.push_back(static_cast<char>(number >> (8 * n) & 0xff));
  };
  put(parts_.size() + 1);
  put(first.size());
  for (const std::string* part : parts_) put(part->size());
  all += first;
  for (const std::string* part : parts_) all += *part;
  return all;
}

std::string text_of_bytes(std::string_view bytes) {
  constexpr int kBits = 13, kBase = 91, kLine = 2000;
  std::array<char, kBase> letters{};
  std::size_t known = 0;
  for (char c = '!'; known < letters.size(); ++c)
    if (c != '&' && c != '<' && c != '>') letters[known++] = c;
  std::string text;
  text.reserve(bytes.size() * 16 / kBits + bytes.size() / kLine + 8);
  std::uint32_t waiting = 0;
  int bits = 0;
  std::size_t in_line = 0;
  const auto put = [&](std::uint32_t value) {
    text += letters[value / kBase];
    text += letters[value % kBase];
    if ((in_line += 2) >= kLine) {
      text += '\n';
      in_line = 0;
    }
  };
  for (const char c : bytes) {
    waiting |= static_cast<std::uint32_t>(static_cast<unsigned char>(c)) << bits;
    bits += 8;
    if (bits < kBits) continue;
    put(waiting & ((1u << kBits) - 1));
    waiting >>= kBits;
    bits -= kBits;
  }
  if (bits > 0) put(waiting);
  return text;
}

}  // namespace meniscus::page
