// SPDX-License-Identifier: BSD-3-Clause
// Reads coordinate files of CHARMM (CARD), which have fixed columns of two widths.

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/base/text_file.h"
#include "core/structure/atom_classes.h"
#include "core/structure/formats/pdb_records.h"
#include "core/structure/formats/structure_formats.h"
#include "core/structure/residues.h"

namespace meniscus {
namespace {

/// The begins and widths of the columns of a row.
struct CardColumns {
  std::size_t running, residue_name, name, name_width, x, width, segment, residue;

  static std::string_view field(std::string_view line, std::size_t begin, std::size_t width) {
    return line.size() <= begin ? std::string_view() : trimmed(line.substr(begin, width));
  }
  std::string_view word(std::string_view line, std::size_t begin) const { return field(line, begin, name_width); }
  std::string_view coordinate(std::string_view line, int axis) const {
    return field(line, x + width * static_cast<std::size_t>(axis), width);
  }
};
constexpr CardColumns kStandard{6, 11, 16, 4, 20, 10, 51, 56}, kExtended{12, 22, 32, 8, 40, 20, 102, 112};

constexpr double kNotPlaced = 9999.0;  // each coordinate of an atom that CHARMM could not place

/// Returns the columns of a line. Standard rows end in column 70, which is before the coordinates of extended rows end.
const CardColumns& columns_of(std::string_view line) {
  return line.size() < kExtended.x + 3 * kExtended.width ? kStandard : kExtended;
}

/// Skips the titles, which begin with asterisks, and reads the number of atoms, which "EXT" may follow.
bool read_count(LineReader& lines, std::int64_t& count) {
  bool titled = false;
  for (std::string_view line; lines.next(line); titled = true) {
    if (line.starts_with('*')) continue;
    return titled && parse_whole_number(take_field(line), count) && count > 0 &&
           (trimmed(line).empty() || trimmed(line) == "EXT");
  }
  return false;
}

bool recognizes(std::string_view text) {
  LineReader lines(text);
  std::int64_t count = 0;
  std::string_view line;
  double ignored = 0.0;
  return read_count(lines, count) && lines.next(line) && parse_number(columns_of(line).coordinate(line, 2), ignored);
}

Atom atom_of(const TextFile& file, std::size_t number, std::string_view line) {
  const CardColumns& columns = columns_of(line);
  if (line.size() < columns.x + 3 * columns.width)
    throw InputError(file.path, number, "{} ends before its coordinates do; does the count say too many atoms?",
                     in_quotes(line));
  Atom atom;
  atom.residue_name = columns.word(line, columns.residue_name);
  atom.name = columns.word(line, columns.name);
  atom.segment = atom.chain = atom.subchain = columns.word(line, columns.segment);
  for (int axis = 0; axis < 3; ++axis)
    atom.position[axis] = parse_coordinate(file, number, "xyz"[axis], columns.coordinate(line, axis));
  if (atom.position == glm::dvec3(kNotPlaced))
    throw InputError(file.path, number,
                     "{} is at 9999 9999 9999, as CHARMM writes atoms that it has not placed; build them "
                     "(ic build, hbuild) and write the file again",
                     in_quotes(atom.name));
  if (!parse_residue_number(columns.word(line, columns.residue), atom.residue_number, atom.insertion_code))
    parse_residue_number(columns.word(line, columns.running), atom.residue_number, atom.insertion_code);
  return atom;
}

FileContents read(const TextFile& file, const ModelChoice& models) {
  FileContents contents;
  LineReader lines(file);
  std::int64_t count = 0;
  if (!read_count(lines, count))
    throw lines.error("should be the number of atoms, which follows titles that begin with *");
  const std::size_t count_line = lines.number(), atoms = static_cast<std::size_t>(count);
  contents.models = 1;
  if (!models.takes(1)) return contents;
  ResidueCounter residues(contents.atoms);
  for (std::size_t n = 0; n < atoms; ++n) {
    std::string_view line;
    if (!lines.next(line)) refuse_short_frame(file, count_line, atoms, n);
    Atom atom = atom_of(file, lines.number(), line);
    residues.number(atom);
    contents.atoms.push_back(std::move(atom));
  }
  if (!lines.only_blanks_left())
    throw InputError(file.path, lines.number() + 1, "comes after the {} atoms of the count; correct it",
                     with_thousands(atoms));
  contents.sites = classify_atoms(contents.atoms, contents.warnings);
  return contents;
}

}  // namespace

const Reader kCharmmCrdReader{
    {"CRD", ".crd .cor", "coordinates of CHARMM (CARD), with names", "CHARMM documentation, io.info: coordinate files",
     "titles, count, atoms in fixed columns of both widths (EXT); segments are the chains, elements guessed by name; "
     "alone, or as @trajectory@ of a PSF"},
    recognizes,
    read};

}  // namespace meniscus
