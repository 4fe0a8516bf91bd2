// SPDX-License-Identifier: BSD-3-Clause
// Parses CIF; the only file that includes gemmi's grammar, which takes long to compile.
#include "core/structure/formats/cif_document.h"

#include <algorithm>
#include <cstdlib>
#include <new>
#include <string>

#include <gemmi/cif.hpp>

#include "core/base/error.h"
#include "core/base/text.h"

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

gemmi::cif::Document parse_cif(const TextFile& file) {
  try {
    return gemmi::cif::read_memory(file.text.data(), file.text.size(), "cif");
  } catch (const std::bad_alloc&) {
    throw;  // the machine's fault, not the file's
  } catch (const std::exception& error) {
    rethrow_parse_error(file, error.what());
  }
}

}  // namespace meniscus
