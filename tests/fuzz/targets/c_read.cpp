// SPDX-License-Identifier: BSD-3-Clause
// Files through the C interface: the first line chooses options, one a character, and the rest is the file.
#include <algorithm>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <stdexcept>
#include <string>

#include <meniscus/meniscus.h>

#include "tests/fuzz/target.h"

namespace meniscus::fuzz {
namespace {

bool done(meniscus_status status) {
  require(status >= MENISCUS_OK && status <= MENISCUS_NOT_CLOSED, "a status is one of the header");
  require(status != MENISCUS_INTERNAL, "no call finds a fault of the library");
  if (status != MENISCUS_OK) require_clear(std::runtime_error(meniscus_last_error()));
  return status == MENISCUS_OK;
}

/// Chooses option k by the k-th character; where there is none, the first of each list.
meniscus_read_options options_of(std::string_view line) {
  const auto choice = [&](std::size_t k, std::size_t count) {
    return k < line.size() ? static_cast<unsigned char>(line[k]) % count : 0;
  };
  static constexpr const char* kSelections[] = {nullptr,   "all",  "chain A",     "(",
                                                "name CA", "\xff", "resid -5--1", "water"};
  static constexpr const char* kAltlocs[] = {"best", "A", "first", "all", "", "both", nullptr};
  static constexpr const char* kRadii[] = {nullptr, "united", "protor", "file", "none"};
  static constexpr const char* kOverrides[] = {"element N=1.2", "all", "=", "chain A = 1e9"};
  constexpr std::int32_t kModels[] = {1, 0, 2, -1};
  meniscus_read_options options{};
  options.size = sizeof options;
  require(done(meniscus_default_read_options(&options)), "there are defaults");
  options.select = kSelections[choice(0, std::size(kSelections))];
  options.altloc = kAltlocs[choice(1, std::size(kAltlocs))];
  options.radii = kRadii[choice(2, std::size(kRadii))];
  options.model = kModels[choice(3, std::size(kModels))];
  options.hydrogens = static_cast<meniscus_hydrogens>(choice(4, 4));
  options.unknown_element = static_cast<meniscus_unknown_element>(choice(5, 4));
  options.keep_water = options.keep_ions = choice(6, 2) == 1;
  options.assembly = choice(7, 2) == 1 ? "1" : nullptr;
  options.radius = kOverrides;
  options.radius_count = choice(8, std::size(kOverrides) + 1);
  return options;
}

/// Checks that each column has a readable row for each atom, and that texts end within their rows.
void look_at(const meniscus_structure* structure, std::size_t atoms) {
  for (std::int32_t column = 0; column <= MENISCUS_STRUCTURE_HYDROPATHIES; ++column) {
    meniscus_array array{};
    require(done(meniscus_structure_table(structure, meniscus_structure_table_id{column}, &array)),
            "a structure has all its columns");
    require(column == MENISCUS_STRUCTURE_WARNINGS || array.count == atoms, "a column has a row an atom");
    const bool is_text = (column >= MENISCUS_STRUCTURE_NAMES && column <= MENISCUS_STRUCTURE_SEGMENTS) ||
                         column == MENISCUS_STRUCTURE_WARNINGS;
    for (std::size_t n = 0; n < array.count; ++n) {
      const char* const row = static_cast<const char*>(array.data) + n * array.stride;
      if (is_text) require(::strnlen(row, array.stride) < array.stride, "a text ends within its row");
    }
  }
}

void run_c_read(std::string_view bytes) {
  static const ScratchFile scratch("molecule");
  const std::string_view line = bytes.substr(0, bytes.find('\n'));
  const meniscus_read_options options = options_of(line);
  const std::string& path = scratch.write(bytes.substr(std::min(bytes.size(), line.size() + 1)));
  meniscus_structure* structure = nullptr;
  if (!done(meniscus_read(path.c_str(), &options, &structure))) {
    require(structure == nullptr, "what fails makes nothing");
    return;
  }
  meniscus_atoms atoms{};
  atoms.size = sizeof atoms;
  require(done(meniscus_structure_atoms(structure, &atoms)) && atoms.count > 0, "a structure has atoms");
  look_at(structure, atoms.count);
  meniscus_structure_release(structure);
}

const Registration registered_c_read{"c_read", run_c_read};

}  // namespace
}  // namespace meniscus::fuzz
