// SPDX-License-Identifier: BSD-3-Clause
// What the script of a page reads: tables of records and a description as JSON, deflated and written as text.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

namespace meniscus::page {

/// Tables, one after the other. Of each the first bytes of all records come first, then the second ones, and so on:
/// what is alike in them lies together, and deflates well.
class PageData {
 public:
  /// T: of whole words, without padding.
  template <typename T>
  void add(std::string_view name, std::span<const T> records) {
    add_table(name, std::as_bytes(records), sizeof(T));
  }

  /// zlib's format (RFC 1950): the length of the JSON in four bytes, lowest first; the JSON, to which "tables" is
  /// added; the tables.
  std::string deflated(nlohmann::json description) const;

 private:
  void add_table(std::string_view name, std::span<const std::byte> bytes, std::size_t stride);

  nlohmann::json tables_ = nlohmann::json::array();
  std::string bytes_;
};

/// Bytes as printable text: 13 bits as two of 91 characters, none of which means anything in HTML, in lines. A fifth
/// longer than the bytes, where base64 is a third longer.
std::string text_of_bytes(std::string_view bytes);

}  // namespace meniscus::page
