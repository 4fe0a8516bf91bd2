// SPDX-License-Identifier: BSD-3-Clause
// Writes BinaryCIF by its specification, for tests.
#pragma once

#include <bit>
#include <cstdint>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace meniscus::test {

using Json = nlohmann::json;

/// Returns little-endian bytes of these numbers, and their type in ByteArray.
template <typename Number>
Json bytes_of(const std::vector<Number>& numbers) {
  std::vector<std::uint8_t> bytes;
  for (const Number number : numbers) {
    if constexpr (sizeof(Number) == 8) {
      for (int n = 0; n < 8; ++n)
        bytes.push_back(static_cast<std::uint8_t>(std::bit_cast<std::uint64_t>(number) >> (8 * n)));
    } else if constexpr (sizeof(Number) == 4) {
      for (int n = 0; n < 4; ++n)
        bytes.push_back(static_cast<std::uint8_t>(std::bit_cast<std::uint32_t>(number) >> (8 * n)));
    } else {
      for (std::size_t n = 0; n < sizeof(Number); ++n)
        bytes.push_back(static_cast<std::uint8_t>(static_cast<std::uint16_t>(number) >> (8 * n)));
    }
  }
  return Json::binary(bytes);
}

inline Json byte_array(int type) { return {{"kind", "ByteArray"}, {"type", type}}; }

/// Returns an encoded column whose encodings end in ByteArray of a type.
template <typename Number>
Json data(const std::vector<Number>& numbers, int type, std::vector<Json> encodings = {}) {
  encodings.push_back(byte_array(type));
  return {{"data", bytes_of(numbers)}, {"encoding", encodings}};
}

/// Returns distinct texts, which `all` holds one after the other, and the number of each row's text.
inline Json strings(const std::string& all, const std::vector<std::int32_t>& offsets,
                    const std::vector<std::int8_t>& places) {
  return {{"data", bytes_of(places)},
          {"encoding",
           {{{"kind", "StringArray"},
             {"dataEncoding", Json::array({byte_array(1)})},
             {"stringData", all},
             {"offsetEncoding", Json::array({byte_array(3)})},
             {"offsets", bytes_of(offsets)}}}}};
}

inline Json column(const std::string& name, const Json& values, const Json& mask = nullptr) {
  return {{"name", name}, {"data", values}, {"mask", mask}};
}

/// Returns a file of one block.
inline std::string binary_cif(const std::vector<Json>& categories) {
  const Json file = {{"encoder", "test"},
                     {"version", "0.3.0"},
                     {"dataBlocks", Json::array({{{"header", "X"}, {"categories", categories}}})}};
  const std::vector<std::uint8_t> bytes = Json::to_msgpack(file);
  return {bytes.begin(), bytes.end()};
}

/// Returns three atoms that use every encoding: N, CA and an atom O without a B-factor, at x 1.5, -2.25, 300, y 0, 1,
/// 2, z 0.5, 1.5, 2.5.
inline std::vector<Json> atom_columns() {
  const Json fixed = {{"kind", "FixedPoint"}, {"factor", 100}, {"srcType", 33}},
             delta = {{"kind", "Delta"}, {"origin", 150}, {"srcType", 3}},
             packed = {{"kind", "IntegerPacking"}, {"byteCount", 2}, {"isUnsigned", false}, {"srcSize", 3}},
             quantized = {{"kind", "IntervalQuantization"}, {"min", 0}, {"max", 2}, {"numSteps", 3}, {"srcType", 32}},
             packed_bytes = {{"kind", "IntegerPacking"}, {"byteCount", 1}, {"isUnsigned", true}, {"srcSize", 4}},
             repeats = {{"kind", "RunLength"}, {"srcType", 3}, {"srcSize", 3}};
  return {column("Cartn_x", data<std::int16_t>({0, -375, 30225}, 2, {fixed, delta, packed})),
          column("Cartn_y", data<std::int32_t>({0, 1, 2}, 3, {quantized})),
          column("Cartn_z", data<float>({0.5F, 1.5F, 2.5F}, 32)),
          column("type_symbol", strings("NCO", {0, 1, 2, 3}, {0, 1, 2})),
          column("label_atom_id", strings("NCAO5'", {0, 1, 3, 6}, {0, 1, 2})),
          column("label_comp_id", strings("ALA", {0, 3}, {0, 0, 0})),
          column("label_asym_id", strings("A", {0, 1}, {0, 0, 0})),
          column("auth_seq_id", data<std::uint8_t>({255, 45, 2, 7, 1}, 4, {repeats, packed_bytes})),
          column("B_iso_or_equiv", data<double>({10.5, 20.25, 0.0}, 33), data<std::uint8_t>({0, 0, 2}, 4))};
}

inline Json category(const std::string& name, int rows, const std::vector<Json>& columns) {
  return {{"name", name}, {"rowCount", rows}, {"columns", columns}};
}

}  // namespace meniscus::test
