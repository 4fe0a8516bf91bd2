// SPDX-License-Identifier: BSD-3-Clause
// Makes zip archives.
#include "exporters/mesh_files/zip_archive.h"

#include <limits>
#include <memory>
#include <new>
#include <span>
#include <utility>

#include <fmt/format.h>
#include <libdeflate.h>

#include "core/base/error.h"
#include "exporters/mesh_files/writers.h"

namespace meniscus {
namespace {

constexpr std::uint16_t kZipVersion = 20;            // 2.0: folders and deflate
constexpr std::uint16_t kStored = 0, kDeflated = 8;  // method
constexpr std::uint16_t kTime = 0, kDate = 33;       // 1980-01-01 00:00
constexpr std::size_t kLocalHeader = 30, kExtraHeader = 4, kUsdAlignment = 64;
constexpr std::uint16_t kPadding = 0x1986;  // identifier of the extra field in archives that OpenUSD writes
constexpr int kLevel = 6;

struct CompressorDeleter {
  void operator()(libdeflate_compressor* compressor) const { ::libdeflate_free_compressor(compressor); }
};

void require_small(std::size_t size, const std::string& name) {
  if (size < std::numeric_limits<std::uint32_t>::max()) return;
  throw CapacityError(
      fmt::format("{} would have {} bytes, and zip has room for 4 GiB; ask for a coarser mesh", name, size));
}

std::uint32_t checksum_of(std::string_view content) { return ::libdeflate_crc32(0, content.data(), content.size()); }

}  // namespace

void ZipArchive::add_deflated(const std::string& name, std::string_view content) {
  require_small(content.size(), name);
  const std::unique_ptr<libdeflate_compressor, CompressorDeleter> compressor(::libdeflate_alloc_compressor(kLevel));
  if (!compressor) throw std::bad_alloc();
  std::vector<std::byte> packed(::libdeflate_deflate_compress_bound(compressor.get(), content.size()));
  packed.resize(
      ::libdeflate_deflate_compress(compressor.get(), content.data(), content.size(), packed.data(), packed.size()));
  add({name, kDeflated, checksum_of(content), static_cast<std::uint32_t>(packed.size()),
       static_cast<std::uint32_t>(content.size())},
      packed.data(), 1);
}

void ZipArchive::add_stored(const std::string& name, std::string_view content) {
  require_small(content.size(), name);
  const auto size = static_cast<std::uint32_t>(content.size());
  add({name, kStored, checksum_of(content), size, size}, content.data(), kUsdAlignment);
}

void ZipArchive::add(Entry entry, const void* content, std::size_t alignment) {
  require_small(bytes_.size() + entry.packed, "the archive");
  entry.place = static_cast<std::uint32_t>(bytes_.size());
  const std::size_t start = bytes_.size() + kLocalHeader + entry.name.size();
  const bool pads = start % alignment != 0;
  // Padding is an extra field, which begins with a header of its own.
  const std::size_t padding = (alignment - (start + kExtraHeader) % alignment) % alignment;
  BinaryRows header;
  header.put(std::uint32_t{0x04034b50});
  for (const std::uint16_t word : {kZipVersion, std::uint16_t{0}, entry.method, kTime, kDate}) header.put(word);
  for (const std::uint32_t word : {entry.checksum, entry.packed, entry.size}) header.put(word);
  header.put(static_cast<std::uint16_t>(entry.name.size()));
  header.put(static_cast<std::uint16_t>(pads ? kExtraHeader + padding : 0));
  header.put_text(entry.name);
  if (pads) {
    header.put(kPadding);
    header.put(static_cast<std::uint16_t>(padding));
    header.put_text(std::string(padding, '\0'));
  }
  const std::span<const std::byte> body(static_cast<const std::byte*>(content), entry.packed);
  bytes_.insert(bytes_.end(), header.bytes().begin(), header.bytes().end());
  bytes_.insert(bytes_.end(), body.begin(), body.end());
  entries_.push_back(std::move(entry));
}

std::vector<std::byte> ZipArchive::finish() {
  BinaryRows directory;
  for (const Entry& entry : entries_) {
    directory.put(std::uint32_t{0x02014b50});
    for (const std::uint16_t word : {kZipVersion, kZipVersion, std::uint16_t{0}, entry.method, kTime, kDate})
      directory.put(word);
    for (const std::uint32_t word : {entry.checksum, entry.packed, entry.size}) directory.put(word);
    directory.put(static_cast<std::uint16_t>(entry.name.size()));
    for (int n = 0; n < 4; ++n) directory.put(std::uint16_t{0});  // extra field, comment, disk, internal attributes
    directory.put(std::uint32_t{0});                              // external attributes
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
