// SPDX-License-Identifier: BSD-3-Clause
// The container of .mns files: a JSON header and aligned little-endian arrays (FORMAT.md).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "core/base/output_file.h"

namespace meniscus::blender {

inline constexpr std::uint32_t kMnsVersion = 2;

/// Collects named arrays, then writes them behind their header.
class MnsWriter {
 public:
  /// Names of arrays that are added from now on begin with this.
  void set_prefix(const std::string& prefix) { prefix_ = prefix; }
  /// `columns` numbers a row. Names must differ; the values are copied.
  void add(const std::string& name, std::span<const float> values, int columns = 1);
  void add(const std::string& name, std::span<const double> values, int columns = 1);
  void add(const std::string& name, std::span<const std::uint32_t> values, int columns = 1);
  void add(const std::string& name, std::span<const std::int32_t> values, int columns = 1);
  void add(const std::string& name, std::span<const std::uint8_t> values, int columns = 1);

  /// Writes the whole file under `path`, or throws OutputError and leaves none. `header` must be an object; the key
  /// "arrays" is added to it.
  void write(const std::string& path, Existing existing, nlohmann::json header) const;

 private:
  struct Array {
    std::string name;
    std::string type;  ///< as numpy writes it: "<f4", "<f8", "<u4", "<i4", "|u1"
    std::size_t rows = 0;
    int columns = 1;
    std::vector<std::byte> bytes;
  };
  void add_bytes(const std::string& name, const char* type, std::span<const std::byte> bytes, std::size_t rows,
                 int columns);
  std::string prefix_;
  std::vector<Array> arrays_;
};

}  // namespace meniscus::blender
