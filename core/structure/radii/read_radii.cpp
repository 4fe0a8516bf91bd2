// SPDX-License-Identifier: BSD-3-Clause
// Reads files of radii after recognizing their format: one atom or pattern per line, or CHARMM topologies with
// parameters.

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/parse_number.h"
#include "core/base/text.h"
#include "core/base/text_file.h"
#include "core/structure/radii/radii_file.h"

namespace meniscus {
namespace {

/// Collects topology (RESI, PRES, ATOM) and NONBONDED parameters from .rtf, .prm and .str files, by the documentation
/// of CHARMM (rtop, parmfile; B. R. Brooks et al., J. Comput. Chem. 30, 1545 (2009)).
class CharmmRadii {
 public:
  /// Reads a file. Throws InputError with file and line.
  void read(const TextFile& file);
  bool empty() const { return files_.empty(); }
  /// Returns half of Rmin by residue and atom. Atoms that only patches (PRES) have are added to every residue that
  /// lacks them, from the first patch that has them. Throws InputError if topology or parameters are missing, or if no
  /// type has parameters.
  RadiiTable table() const;

 private:
  enum class Section { topology, nonbonded, other };
  void read_atom(const TextFile& file, std::size_t line, const std::vector<std::string_view>& fields);
  void read_type(const TextFile& file, std::size_t line, const std::vector<std::string_view>& fields);

  std::string files_;                                                   // names of the files, joined by ", "
  std::map<std::string, std::map<std::string, std::string>> residues_;  // type by residue and atom
  std::map<std::string, std::string> patch_atoms_;                      // type by atom
  std::map<std::string, double> radii_;                                 // Rmin/2 in Å by type
  std::string residue_;                                                 // current residue; empty in a patch
  Section section_ = Section::other;
};

/// Returns the first four letters of a word in upper case, by which CHARMM compares words.
std::string keyword(std::string_view field) {
  std::string word(field.substr(0, 4));
  for (char& c : word) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return word;
}

constexpr std::array<std::string_view, 14> kParameterSections{"BOND", "ANGL", "THET", "DIHE", "PHI",  "IMPR",  "IMPH",
                                                              "CMAP", "NBFI", "HBON", "THOL", "ATOM", "ATOMS", "END"};

bool ends_nonbonded(const std::string& word) {
  return std::find(kParameterSections.begin(), kParameterSections.end(), word) != kParameterSections.end();
}

/// True if a line with these fields begins a part of a topology or parameter file.
bool is_charmm_line(const std::vector<std::string_view>& fields) {
  const std::string word = keyword(fields[0]);
  double number = 0.0;
  if (word == "RESI" || word == "PRES") return fields.size() >= 3 && parse_number(fields[2], number);
  return fields[0].size() >= 6 && (word == "NONB" || word == "NBON");
}

void CharmmRadii::read(const TextFile& file) {
  files_ += (files_.empty() ? "" : ", ") + file.path;
  section_ = Section::other;
  LineReader lines(file.text);
  // True after a line that ends in "-", which the next line continues: the options of NONBONDED.
  bool continued = false;
  for (std::string_view line; lines.next(line);) {
    line = trimmed(line.substr(0, line.find('!')));
    if (line.empty() || line[0] == '*') continue;
    const bool goes_on = line.ends_with('-');
    const std::vector<std::string_view> fields = fields_of(line);
    const std::string word = keyword(fields[0]);
    if (std::exchange(continued, goes_on)) continue;
    if ((word == "RESI" || word == "PRES") && fields.size() >= 2) {
      section_ = Section::topology;
      residue_ = word == "RESI" ? std::string(fields[1]) : std::string();
    } else if (word == "NONB" || word == "NBON") {
      section_ = Section::nonbonded;
    } else if (section_ == Section::topology && word == "ATOM") {
      read_atom(file, lines.number(), fields);
    } else if (section_ == Section::nonbonded && ends_nonbonded(word)) {
      section_ = Section::other;
    } else if (section_ == Section::nonbonded) {
      read_type(file, lines.number(), fields);
    }
  }
}

void CharmmRadii::read_atom(const TextFile& file, std::size_t line, const std::vector<std::string_view>& fields) {
  if (fields.size() < 3) throw InputError(file.path, line, "an ATOM needs a name and a type");
  const std::string name(fields[1]), type(fields[2]);
  if (residue_.empty()) {
    patch_atoms_.try_emplace(name, type);
  } else {
    residues_[residue_][name] = type;
  }
}

void CharmmRadii::read_type(const TextFile& file, std::size_t line, const std::vector<std::string_view>& fields) {
  double half = 0.0;
  if (fields.size() < 4 || !parse_number(fields[3], half) || half < 0.0 || half > kLargestRadius) {
    throw InputError(
        file.path, line,
        fmt::format("a line of NONBONDED needs a type, two numbers and half of Rmin, from 0 to {} Å", kLargestRadius));
  }
  radii_[std::string(fields[0])] = half;
}

RadiiTable CharmmRadii::table() const {
  if (residues_.empty()) throw InputError(files_, 0, "lacks residues; give the CHARMM topology (.rtf) too");
  if (radii_.empty()) throw InputError(files_, 0, "lacks NONBONDED parameters; give the CHARMM parameters (.prm) too");
  // Every residue may have the atoms of all patches.
  constexpr std::size_t kMostEntries = 1'000'000;
  if (patch_atoms_.size() > kMostEntries / residues_.size()) {
    throw CapacityError(
        fmt::format("{}: {} residues with the atoms of patches, {} of them, are more than this program "
                    "reads",
                    files_, with_thousands(residues_.size()), with_thousands(patch_atoms_.size())));
  }
  RadiiTable table(files_, "CHARMM");
  const auto add = [&](const std::string& residue, const std::string& atom, const std::string& type) {
    const auto radius = radii_.find(type);
    if (radius != radii_.end()) table.add(residue, atom, {radius->second, radius->second, type});
  };
  for (const auto& [residue, atoms] : residues_) {
    for (const auto& [atom, type] : atoms) add(residue, atom, type);
    for (const auto& [atom, type] : patch_atoms_) {
      if (!atoms.contains(atom)) add(residue, atom, type);
    }
  }
  if (table.empty())
    throw InputError(files_, 0, "no type of the topology has NONBONDED parameters; do the files match?");
  return table;
}

enum class RadiiFormat { atom_types, freesasa, charmm, force_field, plain };

using Fields = std::vector<std::string_view>;

/// Returns the fields of a line without its comment.
Fields fields_before_comment(std::string_view line, std::string_view comments = "#") {
  return fields_of(line.substr(0, line.find_first_of(comments)));
}

double radius_field(const TextFile& file, std::size_t line, std::string_view field) {
  return parse_radius(file, line, field, "a name and a radius");
}

RadiiFormat format_of(const TextFile& file) {
  LineReader lines(file.text);
  std::size_t most_fields = 0;
  for (std::string_view line; lines.next(line);) {
    const Fields fields = fields_before_comment(line, "#!");
    if (fields.empty()) continue;
    if (fields[0] == "types:" || fields[0] == "atoms:") return RadiiFormat::freesasa;
    if (fields[0] == "radius" && fields.size() >= 4) return RadiiFormat::atom_types;
    if (is_charmm_line(fields)) return RadiiFormat::charmm;
    most_fields = std::max(most_fields, fields.size());
  }
  if (most_fields >= 4) return RadiiFormat::force_field;
  if (most_fields == 3) return RadiiFormat::plain;
  throw InputError(file.path, 0,
                   "is not a table of radii; the kinds read are atmtypenumbers, FreeSASA .config, CHARMM topology and "
                   "parameters, PDB2PQR .DAT, or lines RESIDUE ATOM RADIUS");
}

/// Reads lines "radius KEY DISTANCE EXPLICIT [UNITED]", and then "RESIDUES ATOMS KEY" with patterns, in which
/// underscores stand for blanks.
RadiiTable read_atom_types(const TextFile& file) {
  RadiiTable table(file.path, "atom types");
  std::map<std::string, RadiiTable::Entry, std::less<>> radii;
  LineReader lines(file.text);
  for (std::string_view line; lines.next(line);) {
    const Fields fields = fields_before_comment(line);
    if (fields.empty()) continue;
    if (fields.size() < 3 || (fields[0] == "radius" && fields.size() < 4)) {
      throw InputError(file.path, lines.number(), "is neither 'radius KEY DISTANCE RADIUS' nor 'RESIDUE ATOM KEY'");
    }
    if (fields[0] == "radius") {
      const double explicit_radius = radius_field(file, lines.number(), fields[3]);
      const double united = fields.size() > 4 ? radius_field(file, lines.number(), fields[4]) : explicit_radius;
      radii[std::string(fields[1])] = {explicit_radius, united, fmt::format("type {}", fields[1])};
      continue;
    }
    const auto radius = radii.find(fields[2]);
    if (radius == radii.end()) {
      throw InputError(file.path, lines.number(),
                       fmt::format("type {} has no radius line above", in_quotes(fields[2])));
    }
    std::string atom(fields[1]);
    std::erase(atom, '_');
    try {
      table.add(NamePattern(fields[0]), NamePattern(atom), radius->second);
    } catch (const InputError&) {
      throw;
    } catch (const Error& error) {
      throw InputError(file.path, lines.number(), error.what());
    }
  }
  return table;
}

/// Reads the sections "types:" with NAME RADIUS [CLASS] and "atoms:" with RESIDUE ATOM TYPE.
RadiiTable read_freesasa(const TextFile& file) {
  RadiiTable table(file.path, "FreeSASA");
  std::map<std::string, double, std::less<>> types;
  LineReader lines(file.text);
  std::string section;
  for (std::string_view line; lines.next(line);) {
    const Fields fields = fields_before_comment(line);
    if (fields.empty()) continue;
    if (fields[0].ends_with(':')) {
      section = fields[0];
    } else if (section == "types:" && fields.size() >= 2) {
      types[std::string(fields[0])] = radius_field(file, lines.number(), fields[1]);
    } else if (section == "atoms:" && fields.size() >= 3) {
      const auto type = types.find(fields[2]);
      if (type == types.end()) {
        throw InputError(file.path, lines.number(), fmt::format("{} is not one of its types", in_quotes(fields[2])));
      }
      table.add(fields[0] == "ANY" ? "*" : std::string(fields[0]), std::string(fields[1]),
                {type->second, type->second, std::string(fields[2])});
    } else if (section != "name:") {
      throw InputError(file.path, lines.number(), "is outside of the sections types: and atoms:, or too short");
    }
  }
  return table;
}

/// Reads lines "RESIDUE ATOM [CHARGE] RADIUS".
RadiiTable read_lines(const TextFile& file, bool with_charge) {
  RadiiTable table(file.path, with_charge ? "force field" : "list");
  const std::size_t place = with_charge ? 3 : 2;
  LineReader lines(file.text);
  for (std::string_view line; lines.next(line);) {
    const Fields fields = fields_before_comment(line, "#!");
    if (fields.empty()) continue;
    if (fields.size() <= place) {
      throw InputError(
          file.path, lines.number(),
          fmt::format("has {} fields; RESIDUE ATOM {}RADIUS are needed", fields.size(), with_charge ? "CHARGE " : ""));
    }
    const double radius = radius_field(file, lines.number(), fields[place]);
    const bool any = fields[0] == "ANY" || fields[0] == "*";
    const bool typed = with_charge && fields.size() > 4;
    table.add(any ? "*" : std::string(fields[0]), std::string(fields[1]),
              {radius, radius, typed ? std::string(fields[4]) : fmt::format("{} {}", fields[0], fields[1])});
  }
  return table;
}

}  // namespace

std::vector<RadiiTable> read_radii_files(const std::vector<std::string>& paths) {
  std::vector<RadiiTable> tables;
  CharmmRadii charmm;
  std::size_t charmm_place = 0;
  for (const std::string& path : paths) {
    const TextFile file = read_text_file(path);
    switch (format_of(file)) {
      case RadiiFormat::atom_types:
        tables.push_back(read_atom_types(file));
        break;
      case RadiiFormat::freesasa:
        tables.push_back(read_freesasa(file));
        break;
      case RadiiFormat::charmm:
        charmm.read(file);
        charmm_place = tables.size();
        continue;
      case RadiiFormat::force_field:
        tables.push_back(read_lines(file, true));
        break;
      case RadiiFormat::plain:
        tables.push_back(read_lines(file, false));
        break;
    }
    if (tables.back().empty()) throw InputError(path, 0, "gives no atom a radius");
  }
  if (!charmm.empty()) tables.insert(tables.begin() + static_cast<std::ptrdiff_t>(charmm_place), charmm.table());
  return tables;
}

}  // namespace meniscus
