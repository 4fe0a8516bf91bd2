// SPDX-License-Identifier: BSD-3-Clause
// Cryptomatte (Friedman & Jones 2015, specification 1.2): ids of names, and their coverage in the channels of a pixel.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace meniscus {

/// Returns MurmurHash3_x86_32 (Appleby 2011) of the bytes, with seed 0.
std::uint32_t murmur_hash(std::string_view bytes);

/// Returns the bits of the float that encodes a name: its hash, with the lowest bit of the exponent flipped if the
/// float would be denormal, infinite or not a number. The result is never 0.
std::uint32_t matte_id(std::string_view name);

/// A layer of mattes: the names by which a compositor picks chains, residues or atoms.
struct Matte {
  std::string layer;              ///< "CryptoChain": its channels are CryptoChain00.R and so on
  std::vector<std::uint32_t> id;  ///< per thing: matte_id() of its name
  std::string manifest;           ///< JSON: the names, each with its id as eight hexadecimal digits
};

/// Returns the names and texts of the header that describe the layers of a matte.
std::vector<std::pair<std::string, std::string>> matte_header(const Matte& matte);

/// The number of ids per pixel. A pixel with more ids keeps those with the largest coverage.
inline constexpr std::size_t kMatteRanks = 6;
inline constexpr std::size_t kMatteChannels = 2 * kMatteRanks;

/// Returns "CryptoChain00.R", "CryptoChain00.G", ..., "CryptoChain02.A".
std::vector<std::string> matte_channels(const Matte& matte);

/// Writes the channels of one pixel: pairs of an id and the share of the pixel's rays that met it, sorted by falling
/// share, then by id, and filled up with zeros. ids: one per ray, 0 if it met nothing; they are sorted in place.
void write_mattes(std::span<std::uint32_t> ids, float* channels);

}  // namespace meniscus
