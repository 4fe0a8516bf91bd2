// SPDX-License-Identifier: BSD-3-Clause
// Cryptomatte (Friedman & Jones 2015, specification 1.2): ids of names, and what the channels of a pixel hold of them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace meniscus {

/// MurmurHash3_x86_32 (Appleby 2011) of the bytes, with seed 0.
std::uint32_t murmur_hash(std::string_view bytes);

/// The bits of the float that stands for a name: its hash, in which the lowest bit of the exponent is turned over where
/// the float would be denormal, infinite or not a number. Never 0.
std::uint32_t matte_id(std::string_view name);

/// A layer of mattes: the names by which a compositor picks chains, residues or atoms.
struct Matte {
  std::string layer;              ///< "CryptoChain": its channels are CryptoChain00.R and so on
  std::vector<std::uint32_t> id;  ///< of each thing: matte_id() of its name
  std::string manifest;           ///< JSON: the names, each with its id as eight hexadecimal digits
};

/// Names and texts of the header that say what the layers of a matte are.
std::vector<std::pair<std::string, std::string>> matte_header(const Matte& matte);

/// Ids that a pixel has room for. A pixel that shows more of them keeps those of the largest coverage.
inline constexpr std::size_t kMatteRanks = 6;
inline constexpr std::size_t kMatteChannels = 2 * kMatteRanks;

/// "CryptoChain00.R", "CryptoChain00.G", ..., "CryptoChain02.A".
std::vector<std::string> matte_channels(const Matte& matte);

/// Writes the channels of one pixel: an id and the share of the pixel's rays that met it, ranks by falling share, then
/// by id; zeros behind the last. ids: what the rays met, 0 for nothing; they are sorted.
void write_mattes(std::span<std::uint32_t> ids, float* channels);

}  // namespace meniscus
