// SPDX-License-Identifier: BSD-3-Clause
// Chooses the reader, then decides atom by atom what is used, and keeps the account.
#include "core/molecule/read_structure.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstring>
#include <tuple>
#include <unordered_set>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/molecule/radii.h"

namespace meniscus {
namespace {

constexpr std::array<const Reader*, 3> kReaders{&kMmcifReader, &kPdbReader, &kXyzrReader};

std::string lower_case_name(const std::string& path) {
  std::string name = path;
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (name.ends_with(".gz")) name.resize(name.size() - 3);
  return name;
}

const Reader* reader_by_name(const std::string& name) {
  for (const Reader* reader : kReaders) {
    std::string_view rest = reader->metadata.extensions;
    while (!rest.empty()) {
      const std::string_view extension = rest.substr(0, rest.find(' '));
      if (name.ends_with(extension)) return reader;
      rest.remove_prefix(std::min(rest.size(), extension.size() + 1));
    }
  }
  return nullptr;
}

/// Formats we can name but not read; better refused by name than misread as PDB.
void refuse_known_foreign(const TextFile& file, const std::string& name) {
  const std::size_t first = file.text.find_first_not_of(" \t\n");
  if (file.text[first] == '<')
    throw InputError(file.path, 0, "looks like HTML or XML, not like a molecule; was the download refused?");
  if (file.text[first] == '{') throw InputError(file.path, 0, "looks like JSON; PDB, mmCIF and XYZR are read");
  for (const char* extension : {".pqr", ".gro", ".xyz", ".pdbqt", ".mol2", ".sdf"}) {
    if (name.ends_with(extension)) {
      throw InputError(file.path, 0, fmt::format("{} files are not read; convert it to PDB, mmCIF or XYZR", extension));
    }
  }
}

const Reader& choose_reader(const TextFile& file, std::vector<std::string>& warnings) {
  const std::string name = lower_case_name(file.path);
  refuse_known_foreign(file, name);
  const Reader* by_name = reader_by_name(name);
  for (const Reader* reader : kReaders) {
    if (!reader->recognizes(file.text)) continue;
    if (by_name && by_name != reader) {
      warnings.push_back(fmt::format("the name says {}, the content {}; read as {}", by_name->metadata.name,
                                     reader->metadata.name, reader->metadata.name));
    }
    return *reader;
  }
  if (by_name) return *by_name;  // its reader says what is missing, and where
  throw InputError(file.path, 0, "is in no format that is read (PDB, mmCIF, XYZR)");
}

/// The alternate location to keep in one residue: highest mean occupancy, then lowest mean B-factor, then letter.
char best_altloc(std::span<const Atom> residue) {
  struct Sum {
    double occupancy = 0.0, b_factor = 0.0;
    int count = 0;
  };
  std::map<char, Sum> sums;
  for (const Atom& atom : residue) {
    if (atom.altloc == ' ') continue;
    Sum& sum = sums[atom.altloc];
    sum.occupancy += std::isnan(atom.occupancy) ? 1.0 : atom.occupancy;
    sum.b_factor += std::isnan(atom.b_factor) ? 0.0 : atom.b_factor;
    ++sum.count;
  }
  if (sums.empty()) return ' ';
  const auto rank = [](const std::pair<const char, Sum>& entry) {
    return std::make_tuple(-entry.second.occupancy / entry.second.count, entry.second.b_factor / entry.second.count,
                           entry.first);
  };
  return std::min_element(sums.begin(), sums.end(), [&](const auto& a, const auto& b) { return rank(a) < rank(b); })
      ->first;
}

/// The altloc to keep, by residue.
std::vector<char> chosen_altlocs(const std::vector<Atom>& atoms) {
  std::uint32_t residue_count = 0;
  for (const Atom& atom : atoms) residue_count = std::max(residue_count, atom.residue + 1);
  std::vector<char> chosen(residue_count, ' ');
  std::map<std::uint32_t, std::vector<Atom>> with_alternatives;
  for (const Atom& atom : atoms) {
    if (atom.altloc != ' ') with_alternatives[atom.residue].push_back(atom);
  }
  for (const auto& [residue, members] : with_alternatives) chosen[residue] = best_altloc(members);
  return chosen;
}

/// Lone pairs and the mass-less sites of water models (LP, EP, M, MW, with digits), and the dummy atoms with which the
/// OPM database draws membranes.
bool is_virtual_site(const Atom& atom) {
  if (atom.residue_name == "DUM") return true;
  if (atom.element != 0) return false;
  const std::string letters = atom.name.substr(0, atom.name.find_first_of("0123456789"));
  for (const char* name : {"LP", "EP", "M", "MW", "EPW", "VS"}) {
    if (letters == name) return true;
  }
  return false;
}

const char* reason_to_exclude(const Atom& atom, char altloc, bool radii_from_file, const ReadOptions& options) {
  if (atom.altloc != ' ' && atom.altloc != altloc) return kExcludedAltloc;
  if (radii_from_file) return atom.radius == 0.0 ? kExcludedRadius : nullptr;
  if (atom.kind == AtomClass::water && !options.keep_water) return kExcludedWater;
  if (atom.kind == AtomClass::ion && !options.keep_ions) return kExcludedIon;
  if (is_virtual_site(atom)) return kExcludedVirtual;
  if (atom.element == 0 && options.unknown_element == UnknownElement::skip) return kExcludedElement;
  return nullptr;
}

void halt_on_unknown_elements(const Structure& structure) {
  std::map<std::string, std::size_t> names;
  std::size_t count = 0;
  for (const Atom& atom : structure.atoms) {
    if (atom.element != 0) continue;
    ++count;
    ++names[fmt::format("{} in {} {}{}", in_quotes(atom.name), atom.residue_name, atom.chain, atom.residue_number)];
  }
  if (count == 0) return;
  std::string examples;
  for (const auto& [name, number] : names) {
    if (examples.size() > 100) {
      examples += ", ...";
      break;
    }
    examples += (examples.empty() ? "" : ", ") + escaped(name);
  }
  throw InputError(structure.file, 0,
                   fmt::format("the element of {} {} is unknown: {}; correct the element column, or choose "
                               "--unknown-element guess or skip",
                               with_thousands(count), count == 1 ? "atom" : "atoms", examples));
}

void warn_of_coincident_atoms(Structure& structure) {
  std::unordered_set<std::string> places;
  std::size_t coincident = 0;
  for (const Atom& atom : structure.atoms) {
    std::string key(sizeof(atom.position), '\0');
    std::memcpy(key.data(), &atom.position, sizeof(atom.position));
    if (!places.insert(std::move(key)).second) ++coincident;
  }
  if (coincident == 0) return;
  structure.report.warnings.push_back(
      fmt::format("{} {} at exactly the place of another; the surface is as if they were one",
                  with_thousands(coincident), coincident == 1 ? "atom lies" : "atoms lie"));
}

/// Builds the assembly that is asked for; lists all when asked to, and then takes broken records as a warning.
void use_assemblies(Structure& structure, const TextFile& file, const Reader& reader, const ReadOptions& options) {
  if (options.list_assemblies && reader.assemblies) {
    try {
      structure.assemblies = reader.assemblies(file);
    } catch (const InputError& error) {
      structure.report.warnings.push_back(std::string("its assemblies cannot be read: ") + error.what());
    }
  }
  if (options.assembly.empty()) return;
  if (!reader.assemblies) {
    throw InputError(structure.file, 0,
                     fmt::format("is {}, which describes no assemblies; leave --assembly away", reader.metadata.name));
  }
  const std::vector<Assembly> assemblies = reader.assemblies(file);
  assemble(structure, find_assembly(assemblies, options.assembly, structure.file), options.copy_mode);
}

}  // namespace

std::span<const Reader* const> readers() { return kReaders; }

Structure read_structure(const std::string& path, const ReadOptions& options) {
  const TextFile file = read_text_file(path);
  Structure structure;
  structure.file = path;
  ReadReport& report = structure.report;
  const Reader& reader = choose_reader(file, report.warnings);
  structure.format = reader.metadata.name;

  FileContents contents = reader.read(file);
  report.read = contents.atoms.size() + contents.other_model_atoms;
  report.models = contents.models;
  report.warnings.insert(report.warnings.end(), contents.warnings.begin(), contents.warnings.end());
  if (contents.other_model_atoms > 0) report.excluded[kExcludedModel] = contents.other_model_atoms;

  const std::vector<char> altlocs = chosen_altlocs(contents.atoms);
  for (Atom& atom : contents.atoms) {
    if (const char* reason = reason_to_exclude(atom, altlocs[atom.residue], contents.radii_from_file, options)) {
      ++report.excluded[reason];
    } else {
      structure.atoms.push_back(std::move(atom));
    }
  }
  report.used = structure.atoms.size();
  if (structure.atoms.empty()) {
    throw InputError(path, 0,
                     fmt::format("leaves no atoms to make a surface of: {}; --keep-water and --keep-ions use more",
                                 report.sentence()));
  }
  if (contents.radii_from_file) {
    structure.radii_set = "file";
  } else {
    if (options.unknown_element == UnknownElement::halt) halt_on_unknown_elements(structure);
    assign_bondi_radii(structure);
  }
  warn_of_coincident_atoms(structure);
  use_assemblies(structure, file, reader, options);
  return structure;
}

}  // namespace meniscus
