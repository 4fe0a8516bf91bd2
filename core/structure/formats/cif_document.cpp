// SPDX-License-Identifier: BSD-3-Clause
// Parses CIF; the only file that includes gemmi's grammar, which takes long to compile.
#include "core/structure/formats/cif_document.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <new>
#include <string>
#include <string_view>

#include <gemmi/cif.hpp>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/structure/formats/binary_cif.h"

namespace meniscus {
namespace {

/// gemmi's parser says "name:line:column(byte): what"; we pass "cif" as the name.
[[noreturn]] void rethrow_parse_error(const TextFile& file, const std::string& message) {
  std::size_t line = 0;
  std::string what = message;
  if (message.starts_with("cif:")) {
    line = std::strtoul(message.c_str() + 4, nullptr, 10);
    what = message.substr(std::min(message.size(), message.find(": ") + 2));
  }
  throw InputError(file.path, line, "is not a readable mmCIF file: " + escaped(what));
}

}  // namespace

bool is_binary_cif(std::string_view bytes) {
  const auto byte = [&](std::size_t n) { return n < bytes.size() ? static_cast<unsigned char>(bytes[n]) : 0u; };
  // A map of up to 15, 2^16 or 2^32 keys, then the length of the first one.
  const std::size_t key = (byte(0) & 0xf0u) == 0x80u ? 1 : byte(0) == 0xdeu ? 3 : byte(0) == 0xdfu ? 5 : 0;
  if (key == 0 || bytes.size() < key) return false;
  const std::string_view rest = bytes.substr(key, 16);
  constexpr std::array<std::string_view, 3> kKeys{"encoder", "version", "dataBlocks"};
  return std::ranges::any_of(kKeys, [&](std::string_view name) {
    const std::size_t at = rest.find(name);
    return at != 0 && at <= 2 && static_cast<unsigned char>(rest[at - 1]) % 32 == name.size();
  });
}

gemmi::cif::Document parse_cif(const TextFile& file) {
  if (is_binary_cif(file.text)) return read_binary_cif(file);
  try {
    return gemmi::cif::read_memory(file.text.data(), file.text.size(), "cif");
  } catch (const std::bad_alloc&) {
    throw;  // the machine's fault, not the file's
  } catch (const std::exception& error) {
    rethrow_parse_error(file, error.what());
  }
}

}  // namespace meniscus
