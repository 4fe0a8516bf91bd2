// SPDX-License-Identifier: BSD-3-Clause
// Writes the header and the arrays of a .mns file, and describes a camera in JSON.
#include "exporters/blender/mns_file.h"

#include <zlib.h>

#include <bit>
#include <cassert>
#include <cstring>

#include <nlohmann/json.hpp>

#include "core/camera/camera_json.h"

namespace meniscus::blender {
namespace {

static_assert(std::endian::native == std::endian::little, "arrays are written as they lie in memory");

constexpr std::size_t kAlignment = 64;
constexpr std::size_t kPrologue = 64;
/// As in PNG: a byte that is no text, then line ends that a transfer "as text" would change.
constexpr char kMagic[8] = {'\x89', 'M', 'N', 'S', '\r', '\n', '\x1a', '\n'};

std::size_t aligned(std::size_t offset) { return (offset + kAlignment - 1) / kAlignment * kAlignment; }

std::uint32_t checksum(std::uint32_t so_far, std::span<const std::byte> bytes) {
  if (bytes.empty()) return so_far;  // a null pointer would make zlib start anew
  return static_cast<std::uint32_t>(
      crc32_z(so_far, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()));
}

template <class T>
void put(std::vector<std::byte>& bytes, std::size_t at, T value) {
  std::memcpy(bytes.data() + at, &value, sizeof value);
}

}  // namespace

void MnsWriter::add_bytes(const std::string& name, const char* type, std::span<const std::byte> bytes, std::size_t rows,
                          int columns) {
  arrays_.push_back({prefix_ + name, type, rows, columns, bytes.size(), {bytes.begin(), bytes.end()}, {}});
}
void MnsWriter::add(const std::string& name, std::span<const float> values, int columns) {
  add_bytes(name, "<f4", std::as_bytes(values), values.size() / columns, columns);
}
void MnsWriter::add(const std::string& name, std::span<const double> values, int columns) {
  add_bytes(name, "<f8", std::as_bytes(values), values.size() / columns, columns);
}
void MnsWriter::add(const std::string& name, std::span<const std::uint32_t> values, int columns) {
  add_bytes(name, "<u4", std::as_bytes(values), values.size() / columns, columns);
}
void MnsWriter::add(const std::string& name, std::span<const std::int32_t> values, int columns) {
  add_bytes(name, "<i4", std::as_bytes(values), values.size() / columns, columns);
}
void MnsWriter::add(const std::string& name, std::span<const std::uint8_t> values, int columns) {
  add_bytes(name, "|u1", std::as_bytes(values), values.size() / columns, columns);
}

void MnsWriter::write(const std::string& path, Existing existing, nlohmann::json header) const {
  // Offsets count from the end of the header, so that the header's own length does not matter for them.
  std::size_t offset = 0;
  nlohmann::json table = nlohmann::json::array();
  for (const Array& array : arrays_) {
    table.push_back({{"name", array.name},
                     {"type", array.type},
                     {"rows", array.rows},
                     {"columns", array.columns},
                     {"offset", offset}});
    offset = aligned(offset + array.byte_count);
  }
  header["arrays"] = std::move(table);
  std::string text = header.dump(1, ' ', true, nlohmann::json::error_handler_t::replace);
  text.resize(aligned(text.size() + 1), ' ');
  text.back() = '\n';

  // The prologue holds the checksum of all that follows; zeros keep its place.
  std::vector<std::byte> prologue(kPrologue);
  OutputFile file(path, existing);
  file.write(std::span<const std::byte>(prologue));
  std::uint32_t crc = 0;
  const auto write = [&](std::span<const std::byte> bytes) {
    crc = checksum(crc, bytes);
    file.write(bytes);
  };
  write(std::as_bytes(std::span(text)));
  const std::vector<std::byte> padding(kAlignment);
  for (const Array& array : arrays_) {
    std::size_t count = array.bytes.size();
    if (array.make) {
      ArraySink sink([&](std::span<const std::byte> bytes) {
        count += bytes.size();
        write(bytes);
      });
      array.make(sink);
      sink.flush();
    } else {
      write(array.bytes);
    }
    assert(count == array.byte_count);
    write(std::span(padding).first(aligned(count) - count));
  }
  std::memcpy(prologue.data(), kMagic, sizeof kMagic);
  put(prologue, 8, version_);
  put(prologue, 12, crc);
  put(prologue, 16, static_cast<std::uint64_t>(text.size()));
  put(prologue, 24, static_cast<std::uint64_t>(kPrologue + text.size() + offset));
  file.rewrite_beginning(prologue);
  file.commit();
}

nlohmann::json shot_object(const Shot& shot) {
  nlohmann::json camera = camera_object(shot.camera);
  camera["size"] = {shot.width, shot.height};
  return camera;
}

}  // namespace meniscus::blender
