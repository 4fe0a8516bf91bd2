// SPDX-License-Identifier: BSD-3-Clause
// Reads PQR: PDB's atom records with charge and radius.
#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/structure/atom_classes.h"
#include "core/text/parse_number.h"
#include "core/structure/formats/pdb_columns.h"
#include "core/structure/formats/pqr_record.h"
#include "core/structure/formats/reader.h"
#include "core/structure/residue_counter.h"
#include "core/text/text_lines.h"

namespace meniscus {
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
    classify_atoms(contents_.atoms, contents_.warnings, hints_);
    warn_of_doubtful_radii();
    return std::move(contents_);
  }

 private:
  void take(std::string_view line, std::size_t number) {
    if (is_pdb_record(line, "TER")) residues_.end_piece();
    if (is_pdb_record(line, "ENDMDL") || is_pdb_record(line, "END")) open_ = false;
    if (!is_pdb_atom(line)) return;
    if (!open_) ++contents_.models;
    open_ = true;
    const auto model = static_cast<std::int32_t>(contents_.models);
    if (choice_.takes(model)) {
      take_atom(line, number, model);
    } else {
      ++contents_.other_model_atoms;
    }
  }

  void take_atom(std::string_view line, std::size_t number, std::int32_t model) {
    const std::optional<PqrRecord> record = parse_pqr_record(line);
    if (!record) {
      throw InputError(
          file_.path, number,
          fmt::format("{} cannot be taken apart: fields are missing or touch; a line is: {}", in_quotes(line), kLine));
    }
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
    if (!parse_single(record->numbers[3], atom.charge)) {
      throw InputError(
          file_.path, number,
          fmt::format("charge is {}, not a finite number; a line is: {}", in_quotes(record->numbers[3]), kLine));
    }
    atom.radius = parse_radius(file_, number, record->numbers[4], kLine);
    residues_.number(atom);
    hints_.push_back({.heteroatom = is_pdb_record(line, "HETATM")});
    contents_.atoms.push_back(std::move(atom));
  }

  /// Occupancies and B-factors of a PDB file look like charges and radii, but not like good ones.
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
  bool open_ = false;
};

bool recognizes(std::string_view text) { return style_of_atom_records(text).pqr; }

FileContents read(const TextFile& file, const ModelChoice& models) { return PqrReader(file, models).run(); }

}  // namespace

const Reader kPqrReader{
    {"PQR", ".pqr", "PDB's atom records with charges and radii", "PDB2PQR and APBS documentation: PQR",
     "ATOM, HETATM: name, residue, chain (may be missing), number, position, charge and radius, "
     "blank-separated or, where fields touch, in PDB's columns; END and ENDMDL end a model"},
    recognizes,
    read};

}  // namespace meniscus
