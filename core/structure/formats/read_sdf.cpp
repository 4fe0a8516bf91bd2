// SPDX-License-Identifier: BSD-3-Clause
// Reads MOL and SDF: small molecules with their bonds, as connection tables V2000 and V3000 of MDL.
#include <algorithm>
#include <cctype>
#include <cmath>
#include <unordered_map>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/base/text_file.h"
#include "core/structure/element_tables.h"
#include "core/structure/formats/structure_formats.h"

namespace meniscus {
namespace {

/// The fields of an atom. `charge` is the code of V2000 for a charge.
struct AtomLine {
  std::array<std::string_view, 3> position;
  std::string_view symbol, charge;
};

std::string_view columns(std::string_view line, std::size_t begin, std::size_t width) {
  return trimmed(line.substr(std::min(line.size(), begin), width));
}

bool is_symbol(std::string_view text) {
  return !text.empty() && (std::isalpha(static_cast<unsigned char>(text[0])) || text[0] == '*');
}

/// Splits the line of an atom, at the columns of V2000 or, as some programs write it, at blanks.
std::optional<AtomLine> atom_line(std::string_view line) {
  const auto good = [](const AtomLine& atom) {
    double ignored = 0.0;
    return is_symbol(atom.symbol) && std::ranges::all_of(atom.position, [&](std::string_view field) {
             return parse_number(field, ignored) || field == "nan" || field == "inf" || field == "-inf";
           });
  };
  AtomLine atom{
      {columns(line, 0, 10), columns(line, 10, 10), columns(line, 20, 10)}, columns(line, 31, 3), columns(line, 36, 3)};
  if (good(atom)) return atom;
  const std::vector<std::string_view> fields = fields_of(line, 7);
  if (fields.size() < 4) return std::nullopt;
  atom = {{fields[0], fields[1], fields[2]}, fields[3], fields.size() > 5 ? fields[5] : std::string_view()};
  return good(atom) ? std::optional(atom) : std::nullopt;
}

/// Parses two integers, in columns of three letters or separated by blanks.
std::optional<std::array<std::int64_t, 2>> pair_of(std::string_view line) {
  std::array<std::int64_t, 2> pair{};
  if (parse_whole_number(columns(line, 0, 3), pair[0]) && parse_whole_number(columns(line, 3, 3), pair[1])) return pair;
  const std::vector<std::string_view> fields = fields_of(line, 3);
  if (fields.size() < 2 || !parse_whole_number(fields[0], pair[0]) || !parse_whole_number(fields[1], pair[1]))
    return std::nullopt;
  return pair;
}

bool is_end(std::string_view line) { return line.starts_with("M  END") || line.starts_with("$$$$"); }

class SdfReader {
 public:
  SdfReader(const TextFile& file, const ModelChoice& models) : file_(file), choice_(models), lines_(file) {}

  FileContents run() {
    while (!lines_.only_blanks_left()) read_molecule();
    if (contents_.atoms.empty() && contents_.other_model_atoms == 0) throw InputError(file_.path, 0, "holds no atoms");
    contents_.of_molecules = true;
    return std::move(contents_);
  }

 private:
  void read_molecule() {
    std::string_view title, program, line;
    const bool whole = lines_.next(title) && lines_.next(program) && lines_.next(line) && lines_.next(line);
    ++contents_.models;
    is_wanted_ = choice_.takes(static_cast<std::int32_t>(contents_.models));
    first_ = contents_.atoms.size();
    seen_ = 0;
    name_ = take_field(title);
    if (name_.empty()) name_ = "UNL";
    is_flat_ = columns(program, 20, 2) != "3D";
    numbers_of_symbols_.clear();
    places_.clear();
    if (!whole)
      throw lines_.error(
          "ends where molecule {} should begin: three lines of title, program and comment, and one of counts",
          contents_.models);
    const bool v3000 = line.find("V3000") != std::string_view::npos;
    v3000 ? read_v3000() : read_v2000(line);
    read_properties(v3000);
    finish_molecule();
  }

  // V2000

  void read_v2000(std::string_view line) {
    const std::size_t counts_line = lines_.number();
    const auto counts = pair_of(line);
    if (!counts || (*counts)[0] < 0 || (*counts)[1] < 0)
      throw InputError(file_.path, counts_line,
                       "{} should begin with the numbers of atoms and bonds; title, program and comment "
                       "are the three lines before it",
                       in_quotes(line));
    const auto [atoms, bonds] = *counts;
    for (std::int64_t n = 0; n < atoms; ++n) {
      if (!lines_.next(line))
        refuse_short_frame(file_, counts_line, static_cast<std::size_t>(atoms), static_cast<std::size_t>(n));
      const std::optional<AtomLine> atom = is_end(line) ? std::nullopt : atom_line(line);
      if (!atom)
        throw lines_.error("{} is not an atom: x, y, z and a symbol; line {} says {} atoms, is it right?",
                           in_quotes(line), counts_line, atoms);
      take_atom(*atom);
    }
    for (std::int64_t n = 0; n < bonds; ++n) {
      const bool there = lines_.next(line) && !is_end(line);
      const auto ends = there ? pair_of(line) : std::nullopt;
      if (!ends)
        throw InputError(file_.path, there ? lines_.number() : counts_line,
                         there
                             ? fmt::format("{} is not a bond of two atoms; line {} says {} atoms and {} bonds, are "
                                           "they right?",
                                           in_quotes(line), counts_line, atoms, bonds)
                             : fmt::format("the count says {} bonds, but {} follow; is the file cut short?", bonds, n));
      take_bond(bond_end((*ends)[0]), bond_end((*ends)[1]));
    }
  }

  std::uint32_t bond_end(std::int64_t number) const {
    if (number < 1 || number > static_cast<std::int64_t>(seen_)) refuse_bond(std::to_string(number));
    return static_cast<std::uint32_t>(number - 1);
  }

  [[noreturn]] void refuse_bond(std::string_view atom) const {
    throw lines_.error("a bond names atom {}; the atoms are 1 to {}", in_quotes(atom), seen_);
  }

  /// Returns the charge for the code of an atom in V2000, where 4 is a radical.
  static float charge_of_number(std::string_view field) {
    constexpr std::array<float, 8> kCharges{0, 3, 2, 1, 0, -1, -2, -3};
    std::int64_t number = 0;
    const bool known = parse_whole_number(field, number) && number >= 0 && number < 8;
    return known ? kCharges[static_cast<std::size_t>(number)] : 0.0F;
  }

  /// Reads the lines after the bonds, and the data after the molecule.
  void read_properties(bool v3000) {
    bool charges_begun = false, ended = v3000;
    for (std::string_view line; lines_.next(line);) {
      if (line.starts_with("$$$$")) return;
      ended = ended || is_end(line);
      if (line.starts_with("M  CHG") || line.starts_with("M  RAD")) {
        // These lines replace all charges in the lines of atoms.
        if (!charges_begun) clear_charges();
        charges_begun = true;
        if (line[3] == 'C') read_charges(line);
      } else if (line.starts_with('>')) {
        read_data(line);
      } else if (!ended && is_symbol(columns(line, 31, 3)) && atom_line(line)) {
        throw lines_.error("{} is one atom more than are counted; correct the counts", in_quotes(line));
      }
    }
  }

  void clear_charges() {
    for (std::size_t n = first_; n < contents_.atoms.size(); ++n) contents_.atoms[n].charge = 0.0F;
  }

  /// Reads the number of charges, and then pairs of an atom and its charge.
  void read_charges(std::string_view line) {
    if (!is_wanted_) return;
    const std::vector<std::string_view> fields = fields_of(line.substr(6));
    for (std::size_t n = 1; n + 1 < fields.size(); n += 2) {
      std::int64_t atom = 0, charge = 0;
      if (!parse_whole_number(fields[n], atom) || atom < 1 || atom > static_cast<std::int64_t>(seen_) ||
          !parse_whole_number(fields[n + 1], charge) || std::abs(charge) > 15)
        throw lines_.error("charge {} of atom {}: the atoms are 1 to {}, charges -15 to 15", in_quotes(fields[n + 1]),
                           in_quotes(fields[n]), seen_);
      contents_.atoms[first_ + static_cast<std::size_t>(atom - 1)].charge = static_cast<float>(charge);
    }
  }

  /// Reads partial charges. PubChem writes their number and then lines of an atom and its charge; RDKit writes one for
  /// each atom.
  void read_data(std::string_view header) {
    const bool pubchem = header.find("<PUBCHEM_MMFF94_PARTIAL_CHARGES>") != std::string_view::npos;
    if (!is_wanted_ || (!pubchem && header.find("<atom.dprop.PartialCharge>") == std::string_view::npos)) return;
    std::vector<float> charges;
    if (pubchem) charges.assign(seen_, 0.0F);
    const std::size_t first_line = lines_.number() + 1;
    for (std::string_view line; lines_.next(line) && !trimmed(line).empty();) {
      const std::vector<std::string_view> fields = fields_of(line, line.size());
      if (pubchem && lines_.number() == first_line) continue;
      if (pubchem) {
        std::int64_t atom = 0;
        if (fields.size() != 2 || !parse_whole_number(fields[0], atom) || atom < 1 ||
            atom > static_cast<std::int64_t>(seen_) ||
            !parse_single(fields[1], charges[static_cast<std::size_t>(atom - 1)]))
          refuse_partial_charges(line);
      } else {
        for (const std::string_view field : fields)
          if (!parse_single(field, charges.emplace_back())) refuse_partial_charges(line);
      }
    }
    if (charges.size() != seen_)
      throw InputError(file_.path, first_line - 1, "{} partial charges follow for {} atoms", charges.size(), seen_);
    for (std::size_t n = 0; n < seen_; ++n) contents_.atoms[first_ + n].charge = charges[n];
    has_partial_charges_ = true;
  }

  [[noreturn]] void refuse_partial_charges(std::string_view line) const {
    throw lines_.error("{} holds no partial charges of the atoms 1 to {}", in_quotes(line), seen_);
  }

  // V3000

  /// Reads the text of a line "M  V30 ..." together with the lines that continue it. False at the end of the table.
  bool next_v30(std::string& text) {
    text.clear();
    for (std::string_view line; lines_.next(line);) {
      if (line.starts_with("M  END")) return false;
      if (line.starts_with("$$$$")) break;
      if (!line.starts_with("M  V30")) continue;
      line = trimmed(line.substr(6));
      const bool goes_on = line.ends_with('-');
      text += goes_on ? line.substr(0, line.size() - 1) : line;
      if (!goes_on) return true;
    }
    throw lines_.error("ends a molecule without M  END; is the file cut short?");
  }

  void read_v3000() {
    std::int64_t counted = -1;
    enum { kNone, kAtoms, kBonds } block = kNone;
    for (std::string text; next_v30(text);) {
      const std::vector<std::string_view> fields = fields_of(text);
      if (fields.empty()) continue;
      if (fields[0] == "BEGIN" && fields.size() > 1) {
        block = fields[1] == "ATOM" ? kAtoms : fields[1] == "BOND" ? kBonds : kNone;
      } else if (fields[0] == "END") {
        if (block == kAtoms && counted != static_cast<std::int64_t>(seen_))
          throw lines_.error("COUNTS says {} atoms, but {} follow; is the file cut short?", counted, seen_);
        block = kNone;
      } else if (fields[0] == "COUNTS") {
        if (fields.size() < 3 || !parse_whole_number(fields[1], counted))
          throw lines_.error("{} has no number of atoms", in_quotes(text));
      } else if (block == kAtoms) {
        take_v3000_atom(text, fields);
      } else if (block == kBonds) {
        take_v3000_bond(text, fields);
      }
    }
    if (counted != static_cast<std::int64_t>(seen_))
      throw lines_.error("is M  END, but the table V3000 has no whole block of atoms; is the file cut short?");
  }

  void take_v3000_atom(std::string_view text, const std::vector<std::string_view>& fields) {
    std::int64_t index = 0;
    if (fields.size() < 5 || !parse_whole_number(fields[0], index))
      throw lines_.error("{} is not an atom: number, symbol, x, y, z", in_quotes(text));
    if (!places_.try_emplace(index, static_cast<std::uint32_t>(seen_)).second)
      throw lines_.error("atom {} appears twice; give each atom its own number", index);
    take_atom({{fields[2], fields[3], fields[4]}, fields[1], {}});
    for (std::size_t n = 5; is_wanted_ && n < fields.size(); ++n) {
      if (!fields[n].starts_with("CHG=")) continue;
      if (!parse_single(fields[n].substr(4), contents_.atoms.back().charge))
        throw lines_.error("{} is not a charge", in_quotes(fields[n]));
    }
  }

  void take_v3000_bond(std::string_view text, const std::vector<std::string_view>& fields) {
    if (fields.size() < 4) throw lines_.error("{} is not a bond: number, kind and two atoms", in_quotes(text));
    std::array<std::uint32_t, 2> ends{};
    for (std::size_t n = 0; n < 2; ++n) {
      std::int64_t index = 0;
      const auto place = parse_whole_number(fields[2 + n], index) ? places_.find(index) : places_.end();
      if (place == places_.end()) refuse_bond(fields[2 + n]);
      ends[n] = place->second;
    }
    take_bond(ends[0], ends[1]);
  }

  // V2000 and V3000

  void take_atom(const AtomLine& line) {
    ++seen_;
    if (!is_wanted_) {
      ++contents_.other_model_atoms;
      return;
    }
    Atom atom;
    atom.model = static_cast<std::int32_t>(contents_.models);
    atom.index = static_cast<std::uint32_t>(contents_.atoms.size());
    atom.residue = molecules_;
    atom.residue_number = 1;
    atom.residue_name = name_;
    atom.kind = AtomClass::ligand;
    atom.element = element_of_symbol(line.symbol);
    atom.charge = charge_of_number(line.charge);
    atom.name = fmt::format("{}{}", line.symbol, ++numbers_of_symbols_[std::string(line.symbol)]);
    for (int axis = 0; axis < 3; ++axis)
      atom.position[axis] =
          parse_coordinate(file_, lines_.number(), "xyz"[axis], line.position[static_cast<std::size_t>(axis)]);
    contents_.atoms.push_back(std::move(atom));
  }

  /// Adds a bond between two places in the molecule, from 0.
  void take_bond(std::uint32_t a, std::uint32_t b) {
    if (a == b) throw lines_.error("atom {} is bonded to itself; correct the bond", a + 1);
    const auto first = static_cast<std::uint32_t>(first_);
    if (is_wanted_) contents_.bonds.push_back({first + std::min(a, b), first + std::max(a, b)});
  }

  /// Completes a molecule. If all charges are zero, the file is taken to have none.
  void finish_molecule() {
    if (!is_wanted_) return;
    ++molecules_;
    if (!contents_.bonds.empty() && contents_.bonds.back()[0] >= first_)
      contents_.fully_bonded.push_back(static_cast<std::int32_t>(contents_.models));
    const auto begin = contents_.atoms.begin() + static_cast<std::ptrdiff_t>(first_);
    const auto all = [&](auto&& is) { return std::all_of(begin, contents_.atoms.end(), is); };
    if (!has_partial_charges_ && all([](const Atom& atom) { return atom.charge == 0.0F; }))
      std::for_each(begin, contents_.atoms.end(),
                    [](Atom& atom) { atom.charge = std::numeric_limits<float>::quiet_NaN(); });
    has_partial_charges_ = false;
    // Drawings are not in Å, and their atoms overlap.
    if (seen_ > 3 && is_flat_ && all([](const Atom& atom) { return atom.position.z == 0.0; }))
      contents_.warnings.emplace_back(
          fmt::format("molecule {} is a drawing in two dimensions (all z are 0); a surface needs coordinates in three",
                      contents_.models));
  }

  const TextFile& file_;
  const ModelChoice& choice_;
  LineReader lines_;
  FileContents contents_;
  bool is_wanted_ = true, has_partial_charges_ = false, is_flat_ = true;
  std::size_t first_ = 0;        ///< first atom of this molecule in the contents
  std::size_t seen_ = 0;         ///< number of atoms of this molecule
  std::uint32_t molecules_ = 0;  ///< number of molecules used before it
  std::string_view name_;
  std::map<std::string, int> numbers_of_symbols_;
  /// The place of an atom in the molecule, by its number in V3000.
  std::unordered_map<std::int64_t, std::uint32_t> places_;
};

bool recognizes(std::string_view text) {
  LineReader lines(text);
  std::string_view line;
  for (int n = 0; n < 4; ++n)
    if (!lines.next(line)) return false;
  const std::string_view version = columns(line, 33, 6);
  if (version == "V2000" || version == "V3000") return true;
  // Files without a version are older than V2000.
  const auto counts = pair_of(line);
  return counts && (*counts)[0] > 0 && (*counts)[1] >= 0 && lines.next(line) && is_symbol(columns(line, 31, 3)) &&
         atom_line(line);
}

FileContents read(const TextFile& file, const ModelChoice& models) { return SdfReader(file, models).run(); }

}  // namespace

const Reader kSdfReader{
    {"SDF", ".sdf .sd .mol .mdl", "small molecules with bonds, one after the other",
     "CTfile Formats, BIOVIA (MDL); Dalby et al. 1992, J. Chem. Inf. Comput. Sci. 32, 244",
     "V2000 and V3000: positions, symbols, bonds, charges (M  CHG, CHG=; partial ones of PubChem and RDKit); the first "
     "word of the title is the residue, a ligand; each molecule is a model"},
    recognizes,
    read};

}  // namespace meniscus
