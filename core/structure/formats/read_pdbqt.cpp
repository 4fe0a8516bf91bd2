// SPDX-License-Identifier: BSD-3-Clause
// Reads PDBQT of AutoDock: records of PDB with partial charges and types of atoms.
#include <algorithm>
#include <array>
#include <utility>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/base/text_file.h"
#include "core/structure/element_tables.h"
#include "core/structure/formats/pdb_records.h"

namespace meniscus {
namespace {

/// Return the charge in columns 67 to 76, and the type from column 78 on.
std::string_view charge_of(std::string_view line) { return line.size() < 67 ? "" : trimmed(line.substr(66, 10)); }
std::string_view type_of(std::string_view line) {
  std::string_view rest = line.substr(std::min<std::size_t>(line.size(), 77));
  return take_field(rest);
}

/// Types that are no symbols of elements, or symbols of other elements: NA is nitrogen, Na sodium. W is the oxygen of
/// water; G, J and Q are carbons where a ring is opened.
constexpr std::pair<std::string_view, std::uint8_t> kTypes[] = {
    {"A", 6},  {"CG", 6}, {"G", 6},  {"GA", 6}, {"J", 6}, {"Q", 6},   {"NA", 7}, {"NS", 7},
    {"NX", 7}, {"OA", 8}, {"OS", 8}, {"OX", 8}, {"W", 8}, {"SA", 16}, {"HD", 1}, {"HS", 1}};

/// True for points that are no atoms: G0 and the like, where the partner of a carbon CG0 belongs in rings opened by
/// Vina, and TZ, where zinc binds.
bool is_pseudo_atom(std::string_view type) {
  return type == "TZ" || (type.size() == 2 && type[0] == 'G' && type[1] <= '9');
}

/// Returns the element of a type; 0 if it is unknown.
std::uint8_t element_of_type(std::string_view type) {
  const std::string_view letters = type.substr(0, type.find_first_of("0123456789"));
  const auto* found = std::ranges::find(kTypes, letters, &std::pair<std::string_view, std::uint8_t>::first);
  return found != std::end(kTypes) ? found->second : element_of_symbol(letters);
}

bool read_trailing_columns(const TextFile& file, std::size_t number, std::string_view line, Atom& atom) {
  if (!parse_single(charge_of(line), atom.charge))
    throw InputError(file.path, number,
                     fmt::format("charge in columns 67 to 76 is {}, not a finite number; is this PDB, not PDBQT?",
                                 in_quotes(charge_of(line))));
  if (type_of(line).empty())
    throw InputError(file.path, number,
                     fmt::format("atom record {} has no AutoDock type in columns 78 and 79", in_quotes(line)));
  if (is_pseudo_atom(type_of(line))) return true;
  atom.element = element_of_type(type_of(line));
  return atom.element != 0;
}

/// True if most records have a charge. PDB has text or nothing in these columns.
bool recognizes(std::string_view text) {
  constexpr std::size_t kEnough = 100;
  std::size_t records = 0, charged = 0;
  LineReader lines(text);
  for (std::string_view line; records < kEnough && lines.next(line);) {
    if (!is_pdb_atom(line)) continue;
    ++records;
    float charge = 0.0F;
    charged += charge_of(line).find('.') != std::string_view::npos && parse_single(charge_of(line), charge) &&
               !type_of(line).empty();
  }
  return charged > 0 && 2 * charged >= records;
}

FileContents read(const TextFile& file, const ModelChoice& models) {
  return read_pdb(file, models, read_trailing_columns);
}

}  // namespace

const Reader kPdbqtReader{
    {"PDBQT", ".pdbqt", "molecules and docked poses of AutoDock and Vina",
     "AutoDock 4.2 User Guide, appendix; autodock-vina.readthedocs.io",
     "what is read of PDB; partial charges, elements by AutoDock's types; BRANCH names bonds, others are found by "
     "distance; each MODEL (pose) is a model"},
    recognizes,
    read};

}  // namespace meniscus
