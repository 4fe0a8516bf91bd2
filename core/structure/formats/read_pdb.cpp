// SPDX-License-Identifier: BSD-3-Clause
// Reads PDB: strictly in the columns that a surface needs, leniently elsewhere; and PDBQT of AutoDock, which adds
// partial charges and types of atoms.
//
// No library does both and keeps the order of the file and residues whose numbers wrap.

#include <algorithm>
#include <cctype>
#include <charconv>
#include <set>

#include <gemmi/elem.hpp>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/base/text_file.h"
#include "core/structure/assembly.h"
#include "core/structure/atom_classes.h"
#include "core/structure/element_tables.h"
#include "core/structure/formats/pdb_records.h"
#include "core/structure/formats/structure_formats.h"
#include "core/structure/martini.h"
#include "core/structure/plausibility.h"
#include "core/structure/residues.h"
#include "core/structure/secondary_structure.h"

namespace meniscus {
namespace {

constexpr std::size_t kCoordinatesEnd = 54, kTrailingColumns = 66;  // ends of columns

bool is_letter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; }
bool is_digit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }

/// Returns the element by the position of the name in columns 13 to 16. Elements of one letter begin in column 14
/// (gemmi ignores the blank), but hydrogens with long names (HG11, 1HB) in column 13. A lower-case letter ("Cl1") is
/// the second letter of the symbol.
gemmi::Element element_by_place(std::string_view name) {
  const char letters[3] = {name[0], name[1], '\0'};
  const char first[2] = {name[0], '\0'};
  const char shifted[3] = {name[1], name[2], '\0'};
  if (name[0] == ' ' && name[1] <= 'Z' && name[2] >= 'a' && name[2] <= 'z') return gemmi::Element(shifted);
  if ((name[0] == 'H' || name[0] == 'h') && name[3] != ' ') return gemmi::El::H;
  return is_digit(name[1]) ? gemmi::Element(first) : gemmi::Element(letters);
}

class PdbReader {
 public:
  PdbReader(const TextFile& file, const ModelChoice& models, TrailingColumns read_trailing)
      : file_(file), choice_(models), read_trailing_(read_trailing) {}

  FileContents run() {
    LineReader lines(file_.text);
    for (std::string_view line; lines.next(line);) take(line, lines.number());
    if (contents_.atoms.empty() && contents_.other_model_atoms == 0)
      throw InputError(file_.path, 0, "has no ATOM or HETATM records: no atoms");
    std::vector<Warning>& warnings = contents_.warnings;
    if (left_ > right_)
      for (AtomHints& hint : hints_) hint.element = 0;
    contents_.sites = classify_atoms(contents_.atoms, warnings, hints_);
    contents_.bonds = bonds_.bonds();
    mark_secondary_structure(contents_.atoms, secondary_);
    number_.warn(warnings, "no readable residue number; counted on from the residue before");
    occupancy_.warn(warnings, "no readable occupancy; treated as missing");
    b_factor_.warn(warnings, "no readable B-factor; treated as missing");
    if (martini_version(contents_.atoms).number == 0)
      element_.warn(warnings, "no element column; elements were guessed from the names");
    symbol_.warn(warnings, "an unknown element symbol; the element was guessed from the name");
    if (unmarked_models_ > 0) {
      warnings.emplace_back(
          fmt::format("{} {} no MODEL or ENDMDL record; atoms after END or MODEL were read as another model",
                      unmarked_models_, unmarked_models_ == 1 ? "model has" : "models have"));
    }
    return std::move(contents_);
  }

 private:
  void take(std::string_view line, std::size_t number) {
    if (is_pdb_atom(line)) {
      take_atom(line, number);
    } else if (is_pdb_record(line, "TER")) {
      if (is_open_ && wanted() && !contents_.atoms.empty()) ended_chains_.insert(contents_.atoms.back().chain);
      residues_.end_piece();
    } else if (is_pdb_record(line, "MODEL")) {
      if (is_open_) ++unmarked_models_;
      close_model();
      in_model_record_ = true;
    } else if (is_pdb_record(line, "ENDMDL")) {
      close_model();
      in_model_record_ = false;
    } else if (is_pdb_record(line, "END")) {
      has_ended_ = true;
    } else if (is_pdb_record(line, "CONECT")) {
      bonds_.add_record(line);
    } else if (is_pdb_record(line, "EXPDTA")) {
      take_experiment(line);
    } else if (read_trailing_ && is_pdb_record(line, "BRANCH")) {
      take_branch(line);
    } else if (is_pdb_record(line, "HELIX")) {
      take_range(line, SecondaryStructure::helix, 19, 31);
    } else if (is_pdb_record(line, "SHEET")) {
      take_range(line, SecondaryStructure::strand, 21, 32);
    }
  }

  /// Reads the experimental method from column 11 on. Predicted models have none.
  void take_experiment(std::string_view line) {
    if (line.size() <= 10 || line.find("MODEL") != std::string_view::npos || !contents_.experiment.empty()) return;
    contents_.experiment = std::string(trimmed(line.substr(10)));
  }

  /// Reads a helix or strand. Chain, number and insertion code of the first and last residue begin at these columns. In
  /// HELIX a blank separates chain and number. Records that cannot be read are ignored, because nothing but colours
  /// depends on them.
  void take_range(std::string_view line, SecondaryStructure kind, std::size_t first, std::size_t last) {
    const std::size_t gap = kind == SecondaryStructure::helix ? 2 : 1;
    if (line.size() < last + gap + 4) return;
    SecondaryRange range{std::string(trimmed(line.substr(first, 1))), {}, {}, kind};
    const auto residue = [&](std::size_t column, SecondaryRange::Residue& end) {
      const std::string_view digits = trimmed(line.substr(column + gap, 4));
      const auto [rest, error] = std::from_chars(digits.data(), digits.data() + digits.size(), end.first);
      end.second = column + gap + 4 < line.size() ? line[column + gap + 4] : ' ';
      return error == std::errc() && rest == digits.data() + digits.size();
    };
    if (residue(first, range.first) && residue(last, range.last)) secondary_.push_back(std::move(range));
  }

  /// Begins a model if none is open. Atoms after END belong to a new model, as molecular dynamics programs write them.
  void open_model() {
    if (is_open_ && has_ended_ && !in_model_record_) {
      ++unmarked_models_;
      close_model();
    }
    has_ended_ = false;
    if (is_open_) return;
    ++contents_.models;
    is_open_ = true;
  }

  void close_model() {
    is_open_ = has_ended_ = false;
    ended_chains_.clear();
    residues_.end_piece();
  }

  std::int32_t model() const { return static_cast<std::int32_t>(contents_.models); }
  bool wanted() const { return choice_.takes(model()); }

  void take_atom(std::string_view line, std::size_t number) {
    open_model();
    if (!wanted()) {
      ++contents_.other_model_atoms;
      return;
    }
    if (line.size() < kCoordinatesEnd)
      throw InputError(file_.path, number, "atom record {} is cut short at column {}; coordinates need 54 columns",
                       in_quotes(line), line.size());
    Atom atom;
    atom.model = model();
    try {
      for (int axis = 0; axis < 3; ++axis) {
        const std::size_t column = 30 + 8 * static_cast<std::size_t>(axis);
        atom.position[axis] = parse_coordinate(file_, number, "xyz"[axis], line.substr(column, 8));
      }
    } catch (const InputError&) {
      refuse_shifted(line, number);
      throw;
    }
    read_pdb_names(read_trailing_ ? line.substr(0, kTrailingColumns) : line, atom);
    if (!residue_numbers_.read(line, atom)) number_.add(number, line.substr(22, 4));
    atom.occupancy = optional_number(line, 54, occupancy_, number);
    atom.b_factor = optional_number(line, 60, b_factor_, number);
    take_element(line, number, atom);
    residues_.number(atom);
    contents_.atoms.push_back(std::move(atom));
    if (contents_.atoms.front().model == model()) bonds_.add_atom(line);
  }

  /// Throws InputError if the decimal points of all coordinates are too far to the right, as after a number with more
  /// digits than columns.
  void refuse_shifted(std::string_view line, std::size_t number) const {
    for (const std::size_t shift : {1, 2, 3})
      if (line.size() > 50 + shift && line[34 + shift] == '.' && line[42 + shift] == '.' && line[50 + shift] == '.')
        throw InputError(file_.path, number,
                         "the coordinates of {} begin in column {} instead of 31, as after a number that is "
                         "too long for its columns; write hybrid-36 numbers or mmCIF",
                         in_quotes(line), 31 + shift);
  }

  float optional_number(std::string_view line, std::size_t column, WarningCollector& oddity, std::size_t number) {
    float value = 0.0F;
    const std::string_view field = line.substr(std::min(line.size(), column), 6);
    if (parse_single(field, value)) return value;
    oddity.add(number, field);
    return std::numeric_limits<float>::quiet_NaN();
  }

  /// Takes the element. TER marks the residues before it as polymer, but some programs write a single TER at the very
  /// end. Therefore only HETATM after a TER of the same chain is a statement. If chains have no names, that TER may
  /// belong to another chain.
  void take_element(std::string_view line, std::size_t number, Atom& atom) {
    AtomHints& hints = hints_.emplace_back();
    hints.is_heteroatom = is_pdb_record(line, "HETATM");
    if (hints.is_heteroatom && !atom.chain.empty() && ended_chains_.contains(atom.chain))
      hints.residue = ResidueStatement::other;
    if (read_trailing_) {
      if (!read_trailing_(file_, number, line, atom))
        symbol_.add(number, line.substr(kTrailingColumns));
      else
        hints.is_site = atom.element == 0;
      return;
    }
    const std::string symbol(line.substr(std::min<std::size_t>(line.size(), 76), 2));
    if (std::any_of(symbol.begin(), symbol.end(), is_letter)) {
      atom.element = static_cast<std::uint8_t>(gemmi::Element(symbol).atomic_number());
      hints.is_site = is_site_symbol(trimmed(symbol));
      if (atom.element == 0 && !hints.is_site) symbol_.add(number, symbol);
    } else {
      element_.add(number, line.substr(12, 14));
      hints.element = static_cast<std::uint8_t>(element_by_place(line.substr(12, 4)).atomic_number());
      count_place(line.substr(12, 4));
    }
  }

  /// Counts names that begin in column 14, and short names of one-letter elements that do not (C1, OAB, CAB), because
  /// some programs begin all names in column 13.
  void count_place(std::string_view name) {
    if (name[0] == ' ' && is_letter(name[1])) ++right_;
    if (!is_letter(name[0]) || name[3] != ' ') return;
    const bool of_one = !is_letter(name[1]) || element_by_place(name) == gemmi::El::X;
    if (of_one || (name.starts_with("CA") && name[2] != ' ')) ++left_;
  }

  /// Reads two serial numbers, which are the atoms of a rotatable bond in docking.
  void take_branch(std::string_view line) {
    const std::vector<std::string_view> fields = fields_of(line, 3);
    const bool of_first = contents_.atoms.empty() || contents_.atoms.front().model == model();
    if (wanted() && of_first && fields.size() == 3) bonds_.add_pair(fields[1], fields[2]);
  }

  const TextFile& file_;
  const ModelChoice& choice_;
  TrailingColumns read_trailing_;
  FileContents contents_;
  std::vector<AtomHints> hints_;
  ResidueCounter residues_{contents_.atoms};
  PdbBonds bonds_;
  std::vector<SecondaryRange> secondary_;
  PdbResidueNumbers residue_numbers_;
  std::set<std::string> ended_chains_;
  bool is_open_ = false, has_ended_ = false, in_model_record_ = false;
  std::size_t unmarked_models_ = 0, left_ = 0, right_ = 0;
  WarningCollector number_, occupancy_, b_factor_, element_, symbol_;
};

bool recognizes(std::string_view text) {
  const AtomRecordStyle style = style_of_atom_records(text);
  if (style.has_records) return style.is_pdb;
  constexpr std::array<std::string_view, 14> kOtherRecords{"HEADER", "TITLE ", "COMPND", "SOURCE", "REMARK",
                                                           "CRYST1", "MODEL ", "SEQRES", "EXPDTA", "AUTHOR",
                                                           "KEYWDS", "CONECT", "ENDMDL", "DBREF "};
  LineReader lines(text);
  for (std::string_view line; lines.next(line);) {
    if (std::any_of(kOtherRecords.begin(), kOtherRecords.end(),
                    [&](std::string_view record) { return is_pdb_record(line, record); }))
      return true;
  }
  return false;
}

FileContents read(const TextFile& file, const ModelChoice& models) { return read_pdb(file, models, nullptr); }

bool positions(std::string_view model, std::vector<glm::dvec3>& positions) {
  LineReader lines(model);
  positions.clear();
  for (std::string_view line; lines.next(line);) {
    if (!is_pdb_atom(line)) continue;
    glm::dvec3& position = positions.emplace_back();
    if (line.size() < kCoordinatesEnd || !try_parse_coordinate(line.substr(30, 8), 1.0, position.x) ||
        !try_parse_coordinate(line.substr(38, 8), 1.0, position.y) ||
        !try_parse_coordinate(line.substr(46, 8), 1.0, position.z))
      return false;
  }
  return true;
}

}  // namespace

FileContents read_pdb(const TextFile& file, const ModelChoice& models, TrailingColumns read_trailing) {
  return PdbReader(file, models, read_trailing).run();
}

const Reader kPdbReader{
    {"PDB", ".pdb .ent .pdb1 .brk", "Protein Data Bank format, in fixed columns",
     "wwPDB file format 3.3 (2012); hybrid-36 numbers by R. W. Grosse-Kunstleve",
     "ATOM, HETATM, TER, MODEL, ENDMDL, END, CONECT, HELIX, SHEET; serial numbers (decimal, hybrid-36, hexadecimal, "
     "stars) only name the atoms of CONECT, residue numbers (decimal, hybrid-36, hexadecimal) kept; chain names of "
     "two letters, residue names of four, segments"},
    recognizes,
    read,
    read_pdb_assemblies,
    positions};

namespace {

/// These functions return the charge in columns 67 to 76, and the type from column 78 on.
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

/// True for points that are not atoms: G0 and similar types, which mark the partner of a carbon CG0 in rings opened by
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
                     "charge in columns 67 to 76 is {}, not a finite number; is this PDB, not PDBQT?",
                     in_quotes(charge_of(line)));
  if (type_of(line).empty())
    throw InputError(file.path, number, "atom record {} has no AutoDock type in columns 78 and 79", in_quotes(line));
  if (is_pseudo_atom(type_of(line))) return true;
  atom.element = element_of_type(type_of(line));
  return atom.element != 0;
}

/// True if most records have a charge. PDB has text or nothing in these columns.
bool recognizes_pdbqt(std::string_view text) {
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

FileContents read_pdbqt(const TextFile& file, const ModelChoice& models) {
  return read_pdb(file, models, read_trailing_columns);
}

}  // namespace

const Reader kPdbqtReader{
    {"PDBQT", ".pdbqt", "molecules and docked poses of AutoDock and Vina",
     "AutoDock 4.2 User Guide, appendix; autodock-vina.readthedocs.io",
     "what is read of PDB; partial charges, elements by AutoDock's types; BRANCH names bonds, others are found by "
     "distance; each MODEL (pose) is a model"},
    recognizes_pdbqt,
    read_pdbqt};

}  // namespace meniscus
