// SPDX-License-Identifier: BSD-3-Clause
// A zip archive in memory: files deflated, or stored so that programs may map them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace meniscus {

/// Builds an archive according to PKWARE's APPNOTE 6.3.3: local headers with their content, the central directory, and
/// its end record. All times are the earliest of the format, so that equal content gives equal bytes.
class ZipArchive {
 public:
  /// Adds a file in compressed form. Throws CapacityError for content of 4 GiB or more.
  void add_deflated(const std::string& name, std::string_view content);
  /// Adds a file without compression at a multiple of 64 bytes, which USDZ requires. Throws CapacityError for content
  /// of 4 GiB or more.
  void add_stored(const std::string& name, std::string_view content);
  /// Returns the bytes of the archive. It must be called once, after all files were added.
  std::vector<std::byte> finish();

 private:
  struct Entry {
    std::string name;
    std::uint16_t method = 0;
    std::uint32_t checksum = 0, packed = 0, size = 0, place = 0;
  };
  void add(Entry entry, const void* content, std::size_t alignment);

  std::vector<std::byte> bytes_;
  std::vector<Entry> entries_;
};

}  // namespace meniscus
