// SPDX-License-Identifier: BSD-3-Clause
// Ids of names by Cryptomatte's specification and MurmurHash3's reference, and ranks of ids in a pixel.
#include "core/image/cryptomatte.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <map>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/image/color_space.h"

namespace meniscus {
namespace {

TEST(Cryptomatte, HashesAsTheReferenceDoes) {
  // The values come from smhasher's MurmurHash3_x86_32 with seed 0; the last two from section 1 of the specification.
  EXPECT_EQ(murmur_hash(""), 0u);
  EXPECT_EQ(murmur_hash("hello"), 0x248bfa47u);
  EXPECT_EQ(murmur_hash("The quick brown fox jumps over the lazy dog"), 0x2e4ff723u);
  EXPECT_EQ(murmur_hash("bunny"), 0x13851a76u);
  EXPECT_EQ(murmur_hash("default"), 0x42c9679fu);
}

TEST(Cryptomatte, IdsAreNumbersThatEveryProgramKeeps) {
  int mended = 0;
  for (int n = 0; n < 2000; ++n) {
    const std::string name = fmt::format("A/ALA {}", n);
    const float id = std::bit_cast<float>(matte_id(name));
    EXPECT_TRUE(std::isnormal(id)) << name;
    if (matte_id(name) != murmur_hash(name)) ++mended;
  }
  EXPECT_GT(mended, 2);  // one in 128 has such an exponent
}

TEST(Cryptomatte, RanksByCoverage) {
  constexpr std::uint32_t kA = 0x13851a76u, kB = 0x42c9679fu;
  std::array<std::uint32_t, 8> ids{kB, 0, kA, kA, 0, kA, kB, 0};
  std::array<float, kMatteChannels> channels{};
  write_mattes(ids, channels.data());
  EXPECT_EQ(std::bit_cast<std::uint32_t>(channels[0]), kA);
  EXPECT_EQ(channels[1], 3.0f / 8.0f);
  EXPECT_EQ(std::bit_cast<std::uint32_t>(channels[2]), kB);
  EXPECT_EQ(channels[3], 2.0f / 8.0f);
  EXPECT_TRUE(std::all_of(channels.begin() + 4, channels.end(), [](float value) { return value == 0.0f; }));
}

TEST(Cryptomatte, KeepsTheLargestOfMoreThanThereIsRoomFor) {
  std::vector<std::uint32_t> ids;
  for (std::uint32_t id = 1; id <= 9; ++id) ids.insert(ids.end(), id, 0x3f800000u + id);  // the n-th n times
  std::array<float, kMatteChannels> channels{};
  write_mattes(ids, channels.data());
  for (std::uint32_t rank = 0; rank < kMatteRanks; ++rank) {
    EXPECT_EQ(std::bit_cast<std::uint32_t>(channels[2 * rank]), 0x3f800000u + 9 - rank);
    EXPECT_EQ(channels[2 * rank + 1], static_cast<float>(9 - rank) / 45.0f);
  }
}

TEST(Primaries, AcescgIsWhatItsChromaticitiesSay) {
  // White stays white, and luminance is that of the primaries adapted to the other white.
  const glm::vec3 white = from_rec709(glm::vec3(1.0f), Primaries::ap1);
  for (int channel = 0; channel < 3; ++channel) EXPECT_NEAR(white[channel], 1.0f, 1e-6f);
  EXPECT_EQ(from_rec709({0.2f, 0.4f, 0.6f}, Primaries::rec709), glm::vec3(0.2f, 0.4f, 0.6f));
  // OpenColorIO 2.4: "Linear Rec.709 (sRGB)" to "ACEScg" in cg-config-v1.0.0_aces-v1.3_ocio-v2.1.
  const glm::vec3 red = from_rec709({1.0f, 0.0f, 0.0f}, Primaries::ap1);
  const std::array<float, 3> expected{0.6130974f, 0.07019372f, 0.020615593f};
  for (int channel = 0; channel < 3; ++channel)
    EXPECT_NEAR(red[channel], expected[static_cast<std::size_t>(channel)], 1e-6f);
}

}  // namespace
}  // namespace meniscus
