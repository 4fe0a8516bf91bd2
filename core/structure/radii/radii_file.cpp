// SPDX-License-Identifier: BSD-3-Clause
// Reads files of radii in any known layout, and finds the radius of an atom in the table made of them.
#include "core/structure/radii/assign_radii.h"

#include <algorithm>
#include <cctype>
#include <cmath>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/base/text_file.h"
#include "core/structure/residue_names.h"
#include "core/structure/structure.h"

namespace meniscus {
namespace {

constexpr std::size_t kLongestPattern = 200;

[[noreturn]] void refuse(std::string_view text, const char* why) {
  throw Error("the pattern {} {}", in_quotes(text), why);
}

/// Returns the characters of "[...]", whose opening bracket is at `place`. `place` becomes that of the closing bracket.
std::bitset<256> set_at(std::string_view text, std::size_t& place) {
  const std::size_t close = text.find(']', place + 2);
  if (close == std::string_view::npos) refuse(text, "has a bracket that is not closed");
  std::bitset<256> characters;
  const bool inverted = text[place + 1] == '^';
  for (std::size_t n = place + (inverted ? 2 : 1); n < close; ++n) {
    const auto first = static_cast<unsigned char>(text[n]);
    unsigned char last = first;
    if (n + 2 < close && text[n + 1] == '-') {
      last = static_cast<unsigned char>(text[n + 2]);
      n += 2;
    }
    for (unsigned c = first; c <= last; ++c) characters.set(c);
  }
  place = close;
  return inverted ? ~characters : characters;
}

}  // namespace

NamePattern::NamePattern(std::string_view text) {
  if (text.size() > kLongestPattern) refuse(text, "is too long");
  if (text == "*") text = ".*";
  std::size_t first = 0;
  for (std::size_t n = 0; n <= text.size(); ++n) {
    if (n + 1 < text.size() && text[n] == '\\') {
      ++n;
    } else if (n == text.size() || text[n] == '|') {
      alternatives_.push_back(pieces_of(text.substr(first, n - first)));
      first = n + 1;
    }
  }
}

std::vector<NamePattern::Piece> NamePattern::pieces_of(std::string_view alternative) {
  std::vector<Piece> pieces;
  for (std::size_t n = 0; n < alternative.size(); ++n) {
    const char c = alternative[n];
    if (c == '*' || c == '+' || c == '?') {
      if (pieces.empty()) refuse(alternative, "begins with a repetition sign");
      pieces.back().is_optional |= c != '+';
      pieces.back().is_repeated |= c != '?';
      continue;
    }
    Piece piece;
    if (c == '[') {
      piece.characters = set_at(alternative, n);
    } else if (c == '.') {
      piece.characters.set();
    } else if (c == '(' || c == ')' || c == '{' || c == '^' || c == '$') {
      refuse(alternative, "uses brackets or anchors, which are not read");
    } else {
      if (c == '\\' && ++n == alternative.size()) refuse(alternative, "ends in a backslash");
      piece.characters.set(static_cast<unsigned char>(alternative[n]));
    }
    pieces.push_back(piece);
  }
  return pieces;
}

bool NamePattern::matches(std::string_view name) const {
  for (const std::vector<Piece>& pieces : alternatives_) {
    if (matches(pieces, name)) return true;
  }
  return false;
}

bool NamePattern::matches(const std::vector<Piece>& pieces, std::string_view name) {
  std::vector<bool> at(pieces.size() + 1);  // entry p: true if the name so far may end after p pieces
  at[0] = true;
  const auto skip_optional = [&] {
    for (std::size_t p = 0; p < pieces.size(); ++p) at[p + 1] = at[p + 1] || (at[p] && pieces[p].is_optional);
  };
  skip_optional();
  for (const char c : name) {
    std::vector<bool> next(at.size());
    for (std::size_t p = 0; p < pieces.size(); ++p) {
      if (!pieces[p].characters[static_cast<unsigned char>(c)]) continue;
      if (at[p] || (at[p + 1] && pieces[p].is_repeated)) next[p + 1] = true;
    }
    at = std::move(next);
    skip_optional();
  }
  return at.back();
}

namespace {

std::string key(const std::string& residue, const std::string& atom) { return residue + ' ' + atom; }

bool is_hydrogen_name(const std::string& name) {
  const std::size_t letter = name.find_first_not_of("0123456789");
  return letter != std::string::npos && name[letter] == 'H';
}

}  // namespace

void RadiiTable::add(const std::string& residue, const std::string& atom, const Entry& entry) {
  names_[key(residue, atom)] = entry;
  const std::string canonical = canonical_residue(residue);
  names_.try_emplace(key(canonical, canonical_atom(canonical, atom)), entry);
  has_hydrogens_ = has_hydrogens_ || is_hydrogen_name(atom);
}

void RadiiTable::add(NamePattern residue, NamePattern atom, const Entry& entry) {
  has_hydrogens_ = has_hydrogens_ || atom.matches_hydrogen();
  patterns_.push_back({std::move(residue), std::move(atom), entry});
}

const RadiiTable::Entry* RadiiTable::find_named(const std::string& residue, const std::string& atom) const {
  const std::string canonical = canonical_residue(residue);
  const std::string canonical_name = canonical_atom(canonical, atom);
  // AMBER names the residues at the ends of a chain NALA and CALA.
  for (const std::string& name : {key(residue, atom), key(canonical, canonical_name), key("*", atom),
                                  key("*", canonical_name), key('N' + canonical, atom), key('C' + canonical, atom)}) {
    const auto found = names_.find(name);
    if (found != names_.end()) return &found->second;
  }
  return nullptr;
}

std::optional<FoundRadius> RadiiTable::find(const Atom& atom, bool hydrogens_used) const {
  const Entry* entry = find_named(atom.residue_name, atom.name);
  if (!entry && is_hydrogen_name(atom.name) && std::isdigit(static_cast<unsigned char>(atom.name.back()))) {
    std::string other = atom.name;
    for (const char digit : {'1', '2', '3'}) {
      other.back() = digit;
      if (!entry) entry = find_named(atom.residue_name, other);
    }
  }
  for (const Rule& rule : patterns_) {
    if (entry) break;
    if (rule.residue.matches(atom.residue_name) && rule.atom.matches(atom.name)) entry = &rule.entry;
  }
  if (!entry) return std::nullopt;
  return FoundRadius{hydrogens_used ? entry->with_hydrogens : entry->united, entry->label, source_};
}

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
std::string keyword(std::string_view field) { return upper_case(field.substr(0, 4)); }

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
  LineReader lines(file);
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
  if (fields.size() < 4 || !parse_number(fields[3], half) || half < 0.0 || half > kLargestRadius)
    throw InputError(file.path, line, "a line of NONBONDED needs a type, two numbers and half of Rmin, from 0 to {} Å",
                     kLargestRadius);
  radii_[std::string(fields[0])] = half;
}

RadiiTable CharmmRadii::table() const {
  if (residues_.empty()) throw InputError(files_, 0, "lacks residues; give the CHARMM topology (.rtf) too");
  if (radii_.empty()) throw InputError(files_, 0, "lacks NONBONDED parameters; give the CHARMM parameters (.prm) too");
  // Every residue may have the atoms of all patches.
  constexpr std::size_t kMostEntries = 1'000'000;
  if (patch_atoms_.size() > kMostEntries / residues_.size())
    throw CapacityError(
        "{}: {} residues with the atoms of patches, {} of them, are more than this program "
        "reads",
        files_, with_thousands(residues_.size()), with_thousands(patch_atoms_.size()));
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
  LineReader lines(file);
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
  LineReader lines(file);
  for (std::string_view line; lines.next(line);) {
    const Fields fields = fields_before_comment(line);
    if (fields.empty()) continue;
    if (fields.size() < 3 || (fields[0] == "radius" && fields.size() < 4))
      throw lines.error("is neither 'radius KEY DISTANCE RADIUS' nor 'RESIDUE ATOM KEY'");
    if (fields[0] == "radius") {
      const double explicit_radius = radius_field(file, lines.number(), fields[3]);
      const double united = fields.size() > 4 ? radius_field(file, lines.number(), fields[4]) : explicit_radius;
      radii[std::string(fields[1])] = {explicit_radius, united, fmt::format("type {}", fields[1])};
      continue;
    }
    const auto radius = radii.find(fields[2]);
    if (radius == radii.end()) throw lines.error("type {} has no radius line above", in_quotes(fields[2]));
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
  LineReader lines(file);
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
      if (type == types.end()) throw lines.error("{} is not one of its types", in_quotes(fields[2]));
      table.add(fields[0] == "ANY" ? "*" : std::string(fields[0]), std::string(fields[1]),
                {type->second, type->second, std::string(fields[2])});
    } else if (section != "name:") {
      throw lines.error("is outside of the sections types: and atoms:, or too short");
    }
  }
  return table;
}

/// Reads lines "RESIDUE ATOM [CHARGE] RADIUS".
RadiiTable read_lines(const TextFile& file, bool with_charge) {
  RadiiTable table(file.path, with_charge ? "force field" : "list");
  const std::size_t place = with_charge ? 3 : 2;
  LineReader lines(file);
  for (std::string_view line; lines.next(line);) {
    const Fields fields = fields_before_comment(line, "#!");
    if (fields.empty()) continue;
    if (fields.size() <= place)
      throw lines.error("has {} fields; RESIDUE ATOM {}RADIUS are needed", fields.size(), with_charge ? "CHARGE " : "");
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
