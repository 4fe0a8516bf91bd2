// SPDX-License-Identifier: BSD-3-Clause
// Reads PQR files: records of PDB with charge and radius, whose fields are separated by blanks.
#include "core/structure/formats/pdb_records.h"

#include <algorithm>
#include <cctype>
#include <cmath>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/base/text_file.h"
#include "core/structure/atom_classes.h"
#include "core/structure/formats/structure_formats.h"
#include "core/structure/residues.h"
#include "core/structure/structure.h"

namespace meniscus {
namespace {

/// An atom record of PQR, with its numbers as text that is part of the line.
struct PqrRecord {
  std::string name, residue_name, chain;
  std::int32_t residue_number = 0;
  char insertion_code = ' ', altloc = ' ';
  std::array<std::string_view, 5> numbers;  ///< x y z charge radius
};

constexpr std::size_t kNumbersStart = 30, kChargeStart = 54;  // columns 31 and 55 of PDB

bool is_number(std::string_view field) {
  double ignored = 0.0;
  return parse_number(field, ignored);
}

/// Splits a record at blanks. It has serial number, name, residue, an optional chain, number, an optional separate
/// insertion code, and five numbers.
std::optional<PqrRecord> by_blanks(std::string_view line) {
  std::vector<std::string_view> fields = fields_of(line.substr(line[0] == 'A' || line[0] == 'a' ? 4 : 6), 13);
  if (fields.size() < 9 || fields.size() > 11) return std::nullopt;
  PqrRecord record;
  std::copy(fields.end() - 5, fields.end(), record.numbers.begin());
  fields.resize(fields.size() - 5);
  std::int64_t ignored = 0;
  if (fields.size() > 4 && fields.back().size() == 1 && std::isalpha(static_cast<unsigned char>(fields.back()[0]))) {
    record.insertion_code = fields.back()[0];
    fields.pop_back();
  }
  if (fields.size() == 6 || !parse_residue_number(fields.back(), record.residue_number, record.insertion_code))
    return std::nullopt;
  if (fields.size() < 4 || parse_whole_number(fields[1], ignored)) return std::nullopt;
  record.name = fields[1];
  record.residue_name = fields[2];
  if (fields.size() == 5) record.chain = fields[3];
  return record;
}

/// Splits a record at the columns of PDB up to the coordinates, where fields may touch. Charge and radius follow,
/// separated by blanks.
std::optional<PqrRecord> by_columns(std::string_view line) {
  if (line.size() <= kChargeStart) return std::nullopt;
  const std::vector<std::string_view> charge_and_radius = fields_of(line.substr(kChargeStart), 3);
  if (charge_and_radius.size() != 2) return std::nullopt;
  Atom names;
  read_pdb_names(line.substr(0, kNumbersStart), names);
  PqrRecord record;
  record.name = names.name;
  record.residue_name = names.residue_name;
  record.chain = names.chain;
  if (!parse_residue_number(trimmed(line.substr(22, 4)), record.residue_number, record.insertion_code))
    return std::nullopt;
  record.insertion_code = names.insertion_code;
  record.altloc = names.altloc;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    record.numbers[axis] = trimmed(line.substr(kNumbersStart + 8 * axis, 8));
    if (!is_number(record.numbers[axis])) return std::nullopt;
  }
  record.numbers[3] = charge_and_radius[0];
  record.numbers[4] = charge_and_radius[1];
  return record;
}

bool has_pdb_coordinates(std::string_view line) {
  return line.size() >= kChargeStart && is_number(line.substr(kNumbersStart, 8)) &&
         is_number(line.substr(kNumbersStart + 8, 8)) && is_number(line.substr(kNumbersStart + 16, 8));
}

/// True if occupancy and B-factor fill six columns each. The numbers of PQR have more decimals and cross the border.
bool has_occupancy_and_b_factor(std::string_view line) {
  return has_pdb_coordinates(line) && line.size() > 60 && is_number(line.substr(54, 6)) &&
         is_number(line.substr(60, 6)) && (line.size() <= 66 || line[66] == ' ');
}

/// Splits a record at blanks or, if fields touch, at the columns of PDB. Returns nothing if neither gives all fields.
/// The split at blanks is preferred if it found a chain; otherwise the columns are used if they give the same numbers.
std::optional<PqrRecord> parse_pqr_record(std::string_view line) {
  const std::optional<PqrRecord> blanks = by_blanks(line);
  if (blanks && !blanks->chain.empty()) return blanks;
  const std::optional<PqrRecord> columns = by_columns(line);
  return columns && (!blanks || blanks->numbers == columns->numbers) ? columns : blanks;
}

}  // namespace

AtomRecordStyle style_of_atom_records(std::string_view text) {
  constexpr std::size_t kEnough = 100;
  std::size_t records = 0, pqr = 0, coordinates = 0, occupancies = 0;
  LineReader lines(text);
  for (std::string_view line; records < kEnough && lines.next(line);) {
    if (!is_pdb_atom(line)) continue;
    ++records;
    const std::optional<PqrRecord> record = parse_pqr_record(line);
    pqr += record && std::all_of(record->numbers.begin(), record->numbers.end(), is_number);
    coordinates += has_pdb_coordinates(line);
    occupancies += has_occupancy_and_b_factor(line);
  }
  AtomRecordStyle style;
  style.has_records = records > 0;
  style.is_pqr = records > 0 && 2 * pqr >= records;
  style.is_pdb = coordinates > 0 && !(style.is_pqr && 2 * occupancies < records);
  return style;
}

namespace {

constexpr std::string_view kLine = "ATOM serial name residue [chain] number x y z charge radius";

class PqrReader {
 public:
  PqrReader(const TextFile& file, const ModelChoice& models) : file_(file), choice_(models) {
    contents_.radii = FileRadii::usual;
  }

  FileContents run() {
    LineReader lines(file_.text);
    for (std::string_view line; lines.next(line);) take(line, lines.number());
    if (contents_.atoms.empty() && contents_.other_model_atoms == 0)
      throw InputError(file_.path, 0, "has no ATOM or HETATM records: no atoms");
    contents_.sites = classify_atoms(contents_.atoms, contents_.warnings, hints_);
    warn_of_doubtful_radii();
    return std::move(contents_);
  }

 private:
  void take(std::string_view line, std::size_t number) {
    if (is_pdb_record(line, "TER")) residues_.end_piece();
    if (is_pdb_record(line, "ENDMDL") || is_pdb_record(line, "END")) is_open_ = false;
    if (!is_pdb_atom(line)) return;
    if (!is_open_) ++contents_.models;
    is_open_ = true;
    const auto model = static_cast<std::int32_t>(contents_.models);
    if (choice_.takes(model)) {
      take_atom(line, number, model);
    } else {
      ++contents_.other_model_atoms;
    }
  }

  void take_atom(std::string_view line, std::size_t number, std::int32_t model) {
    const std::optional<PqrRecord> record = parse_pqr_record(line);
    if (!record)
      throw InputError(file_.path, number,
                       "{} cannot be split into fields: some are missing or touch; the expected line is: {}",
                       in_quotes(line), kLine);
    Atom atom;
    atom.model = model;
    atom.name = record->name;
    atom.residue_name = record->residue_name;
    atom.chain = atom.subchain = record->chain;
    atom.residue_number = record->residue_number;
    atom.insertion_code = record->insertion_code;
    atom.altloc = record->altloc;
    for (int axis = 0; axis < 3; ++axis) {
      atom.position[axis] =
          parse_coordinate(file_, number, "xyz"[axis], record -> numbers[static_cast<std::size_t>(axis)]);
    }
    if (!parse_single(record->numbers[3], atom.charge))
      throw InputError(file_.path, number, "charge is {}, not a finite number; the expected line is: {}",
                       in_quotes(record->numbers[3]), kLine);
    atom.radius = parse_radius(file_, number, record->numbers[4], kLine);
    residues_.number(atom);
    hints_.push_back({.is_heteroatom = is_pdb_record(line, "HETATM")});
    contents_.atoms.push_back(std::move(atom));
  }

  /// Warns of radii that are not plausible, as when occupancies and B-factors of PDB are read as charges and radii.
  void warn_of_doubtful_radii() {
    const std::vector<Atom>& atoms = contents_.atoms;
    const auto all = [&](auto&& is) { return !atoms.empty() && std::all_of(atoms.begin(), atoms.end(), is); };
    const bool ones = all([](const Atom& atom) { return atom.radius == 1.0; });
    const bool large = all([](const Atom& atom) { return atom.radius > 5.0; });
    if (ones) contents_.warnings.emplace_back("all radii are 1 Å; is the last column the radius?");
    if (large) contents_.warnings.emplace_back("all radii are above 5 Å; is the last column the radius, in Å?");
  }

  const TextFile& file_;
  const ModelChoice& choice_;
  FileContents contents_;
  std::vector<AtomHints> hints_;
  ResidueCounter residues_{contents_.atoms};
  bool is_open_ = false;
};

bool recognizes(std::string_view text) { return style_of_atom_records(text).is_pqr; }

FileContents read(const TextFile& file, const ModelChoice& models) { return PqrReader(file, models).run(); }

}  // namespace

const Reader kPqrReader{
    {"PQR", ".pqr", "PDB's atom records with charges and radii", "PDB2PQR and APBS documentation: PQR",
     "ATOM, HETATM: name, residue, chain (may be missing), number, position, charge and radius, "
     "blank-separated or, where fields touch, in PDB's columns; END and ENDMDL end a model"},
    recognizes,
    read};

}  // namespace meniscus
