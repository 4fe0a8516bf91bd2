// SPDX-License-Identifier: BSD-3-Clause
// Parses CIF. This is the only file that includes gemmi's grammar, which takes long to compile.
#include "core/structure/formats/cif_document.h"

#include <algorithm>
#include <cstdlib>
#include <new>

#include <gemmi/cif.hpp>

namespace meniscus {
namespace {

/// Throws InputError for an error of gemmi's parser, whose text is "name:line:column(byte): what". The name is "cif".
[[noreturn]] void rethrow_parse_error(const TextFile& file, const std::string& message) {
  std::size_t line = 0;
  std::string what = message;
  if (message.starts_with("cif:")) {
    line = std::strtoul(message.c_str() + 4, nullptr, 10);
    what = message.substr(std::min(message.size(), message.find(": ") + 2));
  }
  throw InputError(file.path, line, "is not a readable mmCIF file: " + escaped(what));
}

constexpr std::size_t kRowsAtOnce = 4096;

// A document whose rows of _atom_site are passed on while they are parsed.
struct StreamedDocument : gemmi::cif::Document {
  const TakeAtomRows* take = nullptr;
  bool in_atoms = false;      // true while the loop of atoms is read
  std::size_t row_count = 0;  // rows of this loop that were passed on

  gemmi::cif::Loop& loop() { return items_->back().loop; }

  // The table may also be in a save frame, in which atoms are ignored.
  void begin_values() { in_atoms = items_ == &blocks.back().items && loop().tags.front().starts_with("_atom_site."); }

  void hand_over() {
    const std::size_t rows = loop().values.size() / loop().tags.size();
    if (rows == 0) return;
    (*take)(blocks.back(), row_count);
    loop().values.clear();
    row_count += rows;
  }
};

// The actions of gemmi's grammar, which are extended for two rules.
template <typename Rule>
struct StreamAction : gemmi::cif::Action<Rule> {};

template <>
struct StreamAction<gemmi::cif::rules::loop_value> {
  template <typename Input>
  static void apply(const Input& in, StreamedDocument& out) {
    gemmi::cif::Action<gemmi::cif::rules::loop_value>::apply(in, out);
    if (out.loop().values.size() == 1 && out.row_count == 0) out.begin_values();
    if (out.in_atoms && out.loop().values.size() == kRowsAtOnce * out.loop().tags.size()) out.hand_over();
  }
};

template <>
struct StreamAction<gemmi::cif::rules::loop> {
  template <typename Input>
  static void apply(const Input& in, StreamedDocument& out) {
    gemmi::cif::Action<gemmi::cif::rules::loop>::apply(in, out);
    if (out.in_atoms) out.hand_over();
    out.in_atoms = false;
    out.row_count = 0;
  }
};

gemmi::cif::Document stream(const TextFile& file, const TakeAtomRows& take) {
  tao::pegtl::memory_input<> in(file.text.data(), file.text.size(), "cif");
  StreamedDocument document;
  document.take = &take;
  tao::pegtl::parse<gemmi::cif::rules::file, StreamAction, gemmi::cif::Errors>(in, document);
  gemmi::cif::check_for_missing_values(document);
  gemmi::cif::check_for_duplicates(document);
  return document;
}

// Passes on the rows that were not passed on while parsing: the rows of BinaryCIF, and a table with a single atom,
// which is not a loop.
gemmi::cif::Document hand_over_rest(gemmi::cif::Document document, const TakeAtomRows& take) {
  for (gemmi::cif::Block& block : document.blocks)
    if (block.find("_atom_site.", {"Cartn_x"}).length() > 0) take(block, 0);
  return document;
}

}  // namespace

bool is_binary_cif(std::string_view bytes) {
  const auto byte = [&](std::size_t n) { return n < bytes.size() ? static_cast<unsigned char>(bytes[n]) : 0u; };
  // The file begins with a map of up to 15, 2^16 or 2^32 keys, and the length of the first key follows.
  const std::size_t key = (byte(0) & 0xf0u) == 0x80u ? 1 : byte(0) == 0xdeu ? 3 : byte(0) == 0xdfu ? 5 : 0;
  if (key == 0 || bytes.size() < key) return false;
  const std::string_view rest = bytes.substr(key, 16);
  constexpr std::array<std::string_view, 3> kKeys{"encoder", "version", "dataBlocks"};
  return std::ranges::any_of(kKeys, [&](std::string_view name) {
    const std::size_t at = rest.find(name);
    return at != 0 && at <= 2 && static_cast<unsigned char>(rest[at - 1]) % 32 == name.size();
  });
}

gemmi::cif::Document parse_cif(const TextFile& file, const TakeAtomRows& take) {
  if (is_binary_cif(file.text)) return hand_over_rest(read_binary_cif(file), take);
  try {
    return hand_over_rest(stream(file, take), take);
  } catch (const std::bad_alloc&) {
    throw;  // running out of memory is no error of the file
  } catch (const InputError&) {
    throw;
  } catch (const std::exception& error) {
    rethrow_parse_error(file, error.what());
  }
}

#ifndef MENISCUS_WITH_JSON
gemmi::cif::Document read_binary_cif(const TextFile& file) {
  throw InputError(file.path, 0,
                   "is BinaryCIF, which this build does not read: it was made without nlohmann_json; give it as mmCIF");
}
#endif

}  // namespace meniscus
