// SPDX-License-Identifier: BSD-3-Clause
// Writes zip archives: records around streams of libdeflate.
#include "exporters/mesh_files/zip_archive.h"

#include <limits>
#include <memory>
#include <new>
#include <utility>

#include <fmt/format.h>
#include <libdeflate.h>

#include "core/base/error.h"
#include "exporters/mesh_files/binary_rows.h"

namespace meniscus {
namespace {

constexpr std::uint16_t kVersion = 20;          // 2.0: folders and deflate
constexpr std::uint16_t kDeflated = 8;          // method
constexpr std::uint16_t kTime = 0, kDate = 33;  // 1980-01-01 00:00
constexpr int kLevel = 6;

struct CompressorDeleter {
  void operator()(libdeflate_compressor* compressor) const { ::libdeflate_free_compressor(compressor); }
};

void require_small(std::size_t size, const std::string& name) {
  if (size < std::numeric_limits<std::uint32_t>::max()) return;
  throw CapacityError(
      fmt::format("{} would have {} bytes, and zip has room for 4 GiB; ask for a coarser mesh", name, size));
}

}  // namespace

void ZipArchive::add(const std::string& name, std::string_view content) {
  require_small(content.size(), name);
  const std::unique_ptr<libdeflate_compressor, CompressorDeleter> compressor(::libdeflate_alloc_compressor(kLevel));
  if (!compressor) throw std::bad_alloc();
  std::vector<std::byte> packed(::libdeflate_deflate_compress_bound(compressor.get(), content.size()));
  packed.resize(
      ::libdeflate_deflate_compress(compressor.get(), content.data(), content.size(), packed.data(), packed.size()));
  require_small(bytes_.size() + packed.size(), "the archive");
  const Entry entry{name, ::libdeflate_crc32(0, content.data(), content.size()),
                    static_cast<std::uint32_t>(packed.size()), static_cast<std::uint32_t>(content.size()),
                    static_cast<std::uint32_t>(bytes_.size())};
  BinaryRows header;
  header.put(std::uint32_t{0x04034b50});
  for (const std::uint16_t word : {kVersion, std::uint16_t{0}, kDeflated, kTime, kDate}) header.put(word);
  for (const std::uint32_t word : {entry.checksum, entry.packed, entry.size}) header.put(word);
  header.put(static_cast<std::uint16_t>(name.size()));
  header.put(std::uint16_t{0});
  header.put_text(name);
  bytes_.insert(bytes_.end(), header.bytes().begin(), header.bytes().end());
  bytes_.insert(bytes_.end(), packed.begin(), packed.end());
  entries_.push_back(entry);
}

std::vector<std::byte> ZipArchive::finish() {
  BinaryRows directory;
  for (const Entry& entry : entries_) {
    directory.put(std::uint32_t{0x02014b50});
    for (const std::uint16_t word : {kVersion, kVersion, std::uint16_t{0}, kDeflated, kTime, kDate})
      directory.put(word);
    for (const std::uint32_t word : {entry.checksum, entry.packed, entry.size}) directory.put(word);
    directory.put(static_cast<std::uint16_t>(entry.name.size()));
    for (int n = 0; n < 4; ++n) directory.put(std::uint16_t{0});  // no extra field, comment, disk, inner attributes
    directory.put(std::uint32_t{0});                              // nor outer ones
    directory.put(entry.place);
    directory.put_text(entry.name);
  }
  const auto count = static_cast<std::uint16_t>(entries_.size());
  BinaryRows end;
  end.put(std::uint32_t{0x06054b50});
  for (const std::uint16_t word : {std::uint16_t{0}, std::uint16_t{0}, count, count}) end.put(word);
  end.put(static_cast<std::uint32_t>(directory.size()));
  end.put(static_cast<std::uint32_t>(bytes_.size()));
  end.put(std::uint16_t{0});
  bytes_.insert(bytes_.end(), directory.bytes().begin(), directory.bytes().end());
  bytes_.insert(bytes_.end(), end.bytes().begin(), end.bytes().end());
  return std::move(bytes_);
}

}  // namespace meniscus
