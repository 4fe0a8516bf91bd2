// SPDX-License-Identifier: BSD-3-Clause
// Hashes the names of mattes, and ranks the ids that the rays of a pixel met.
#include "core/image/cryptomatte.h"

#include <algorithm>
#include <array>
#include <bit>

#include <fmt/format.h>

namespace meniscus {

std::uint32_t murmur_hash(std::string_view bytes) {
  constexpr std::uint32_t kFirst = 0xcc9e2d51u, kSecond = 0x1b873593u;
  const auto byte = [&](std::size_t at) { return static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[at])); };
  const auto mixed = [](std::uint32_t word) { return std::rotl(word * kFirst, 15) * kSecond; };
  std::uint32_t hash = 0;
  std::size_t at = 0;
  for (; at + 4 <= bytes.size(); at += 4) {
    hash ^= mixed(byte(at) | byte(at + 1) << 8 | byte(at + 2) << 16 | byte(at + 3) << 24);
    hash = std::rotl(hash, 13) * 5 + 0xe6546b64u;
  }
  std::uint32_t tail = 0;
  for (std::size_t n = 0; at + n < bytes.size(); ++n) tail |= byte(at + n) << (8 * n);
  hash ^= mixed(tail);
  hash ^= static_cast<std::uint32_t>(bytes.size());
  hash = (hash ^ hash >> 16) * 0x85ebca6bu;
  hash = (hash ^ hash >> 13) * 0xc2b2ae35u;
  return hash ^ hash >> 16;
}

std::uint32_t matte_id(std::string_view name) {
  const std::uint32_t hash = murmur_hash(name), exponent = hash >> 23 & 255u;
  return exponent == 0 || exponent == 255u ? hash ^ 1u << 23 : hash;
}

std::vector<std::pair<std::string, std::string>> matte_header(const Matte& matte) {
  const std::string key = "cryptomatte/" + fmt::format("{:08x}", matte_id(matte.layer)).substr(0, 7);
  return {{key + "/name", matte.layer},
          {key + "/hash", "MurmurHash3_32"},
          {key + "/conversion", "uint32_to_float32"},
          {key + "/manifest", matte.manifest}};
}

std::vector<std::string> matte_channels(const Matte& matte) {
  std::vector<std::string> names;
  for (std::size_t layer = 0; layer < kMatteRanks / 2; ++layer)
    for (const char letter : {'R', 'G', 'B', 'A'})
      names.push_back(fmt::format("{}{:02}.{}", matte.layer, layer, letter));
  return names;
}

void write_mattes(std::span<std::uint32_t> ids, float* channels) {
  struct Rank {
    std::ptrdiff_t count;
    std::uint32_t id;
  };
  // One more rank than the pixel keeps: the id with the smallest coverage is put there and dropped.
  std::array<Rank, kMatteRanks + 1> ranks{};
  std::ranges::sort(ids);
  for (auto first = ids.begin(); first != ids.end();) {
    const auto end = std::find_if(first, ids.end(), [&](std::uint32_t id) { return id != *first; });
    if (*first != 0) {
      ranks.back() = {end - first, *first};
      for (std::size_t n = kMatteRanks; n > 0 && ranks[n].count > ranks[n - 1].count; --n)
        std::swap(ranks[n], ranks[n - 1]);
    }
    first = end;
  }
  for (std::size_t n = 0; n < kMatteRanks; ++n) {
    channels[2 * n] = std::bit_cast<float>(ranks[n].id);
    channels[2 * n + 1] = static_cast<float>(ranks[n].count) / static_cast<float>(ids.size());
  }
}

}  // namespace meniscus
