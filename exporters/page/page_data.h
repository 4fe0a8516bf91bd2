// SPDX-License-Identifier: BSD-3-Clause
// What the script of a page reads: descriptions as JSON and tables of records, deflated and written as text.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace meniscus::page {

/// zlib's format (RFC 1950).
std::string deflated(std::string_view bytes);
std::string deflated(const nlohmann::json& description);
/// Returns a description as text, in UTF-8 whatever the encoding of its names.
std::string text_of(const nlohmann::json& description);

/// The form of a packed table.
enum class Packing {
  deflated,  ///< the first bytes of all records come first, then the second ones, and so on: what is alike in them lies
             ///< together, and deflates well
  plain      ///< the records as they are
};

struct PageTable {
  std::string name;
  std::size_t stride = 0;  ///< bytes of a record
  std::string packed;
};

PageTable packed_table(std::string_view name, std::span<const std::byte> bytes, std::size_t stride, Packing packing);
/// T: of whole words, without padding.
template <typename T>
PageTable page_table(std::string_view name, const std::vector<T>& records, Packing packing) {
  return packed_table(name, std::as_bytes(std::span(records)), sizeof(T), packing);
}

/// Parts, each deflated by itself, so that a page unpacks what it shows. Those that are equal are held once.
class PageData {
 public:
  /// Its number, by which the page finds it.
  std::size_t add(std::string packed);
  std::size_t size() const { return size_; }  ///< bytes

  /// How many parts there are, and how long each is, in four bytes each, lowest first; then the parts: `first`, and the
  /// others, which are numbered from 1.
  std::string bytes(const std::string& first) const;

 private:
  std::map<std::string, std::size_t> numbers_;
  std::vector<const std::string*> parts_;
  std::size_t size_ = 0;
};

/// Bytes as printable text: 13 bits as two of 91 characters, none of which means anything in HTML, in lines. A fifth
/// longer than the bytes, where base64 is a third longer.
std::string text_of_bytes(std::string_view bytes);

}  // namespace meniscus::page
