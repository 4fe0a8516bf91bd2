// SPDX-License-Identifier: BSD-3-Clause
// Reads PSF: the atoms, charges, masses and bonds of CHARMM, NAMD and X-PLOR, without coordinates.
#include <algorithm>
#include <cctype>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/base/text_file.h"
#include "core/structure/atom_classes.h"
#include "core/structure/formats/pdb_records.h"
#include "core/structure/formats/structure_formats.h"
#include "core/structure/residues.h"

namespace meniscus {
namespace {

class PsfReader {
 public:
  explicit PsfReader(const TextFile& file) : file_(file), lines_(file) {}

  FileContents run() {
    std::string_view line;
    lines_.next(line);
    is_extended_ = line.find("EXT") != std::string_view::npos;
    const std::optional<std::size_t> atoms = find_section("!NATOM");
    if (!atoms) throw InputError(file_.path, 0, "has no line with a number and !NATOM; is the file cut short?");
    read_atoms(*atoms);
    if (const std::optional<std::size_t> bonds = find_section("!NBOND"))
      read_bonds(*bonds);
    else
      contents_.warnings.emplace_back("it has no section !NBOND, so its bonds are unknown; is the file cut short?");
    set_elements_by_mass(contents_.atoms, hints_);
    contents_.sites = classify_atoms(contents_.atoms, contents_.warnings, hints_, contents_.bonds);
    contents_.without_positions = true;
    contents_.models = 1;
    return std::move(contents_);
  }

 private:
  /// Goes to the line "N !NAME..." and returns N. Returns nothing without such a line, as in files without a topology.
  std::optional<std::size_t> find_section(std::string_view name) {
    for (std::string_view line; lines_.next(line);) {
      const std::size_t at = line.find(name);
      std::int64_t count = 0;
      // The line may be a title.
      if (at == std::string_view::npos || !parse_whole_number(line.substr(0, at), count)) continue;
      if (count < 0) throw lines_.error("{} says {}", name, count);
      if (static_cast<std::uint64_t>(count) > lines_.bytes_left() / 2)
        throw lines_.error("{} says {}, more than the {} bytes after it can hold; is the file cut short?", name,
                           with_thousands(static_cast<std::uint64_t>(count)), with_thousands(lines_.bytes_left()));
      return static_cast<std::size_t>(count);
    }
    return std::nullopt;
  }

  void read_atoms(std::size_t count) {
    const std::size_t count_line = lines_.number();
    if (count == 0) throw InputError(file_.path, count_line, "lists no atoms");
    for (std::size_t n = 0; n < count; ++n) {
      std::string_view line;
      if (!lines_.next(line)) refuse_short_frame(file_, count_line, count, n);
      read_atom(line);
    }
  }

  static bool is_residue_number(std::string_view field) {
    Atom ignored;
    return parse_residue_number(field, ignored.residue_number, ignored.insertion_code);
  }

  /// Returns segment, residue number, residue name, atom name, type, charge and mass of a line.
  std::array<std::string_view, 7> columns_of(std::string_view line) const {
    std::vector<std::string_view> fields = fields_of(line, 12);
    if (fields.size() == 8) {
      // One field is blank. It is the type, as ProDy writes it, if the third field is a number and the second is not;
      // otherwise it is the segment.
      const bool has_segment = !is_residue_number(fields[1]) && is_residue_number(fields[2]);
      fields.insert(fields.begin() + (has_segment ? 5 : 1), std::string_view());
    }
    if (fields.size() < 9 && line.size() > (is_extended_ ? 51 : 33)) fields = fixed_columns_of(line);
    if (fields.size() < 9)
      throw lines_.error(
          "{} is not an atom: number, segment, residue, residue name, name, type, charge, mass and "
          "a flag; is the file cut short, or the number of atoms wrong?",
          in_quotes(line));
    return {fields[1], fields[2], fields[3], fields[4], fields[5], fields[6], fields[7]};
  }

  /// Splits a line in which several fields are blank at the columns of CHARMM, which have four or eight letters.
  std::vector<std::string_view> fixed_columns_of(std::string_view line) const {
    const std::size_t number = is_extended_ ? 10 : 8, width = is_extended_ ? 8 : 4;
    std::vector<std::string_view> fields{line.substr(0, number)};
    for (std::size_t n = 0; n < 4; ++n) fields.push_back(trimmed(line.substr(number + 1 + n * (width + 1), width)));
    const std::size_t type = number + 1 + 4 * (width + 1);
    fields.push_back(trimmed(line.substr(type, 4)));
    for (const std::string_view field : fields_of(line.substr(type + 4), 4)) fields.push_back(field);
    return fields;
  }

  void read_atom(std::string_view line) {
    const auto [segment, residue, residue_name, name, type, charge, mass] = columns_of(line);
    Atom atom;
    atom.segment = segment;
    atom.chain = atom.subchain = atom.segment;
    atom.residue_name = residue_name;
    atom.name = name;
    if (!parse_residue_number(residue, atom.residue_number, atom.insertion_code))
      throw lines_.error("residue {} is not a number; columns may have run together", in_quotes(residue));
    AtomHints hint;
    if (!parse_single(charge, atom.charge) || !parse_single(mass, hint.mass))
      throw lines_.error("charge {} and mass {} are not both numbers; columns may have run together", in_quotes(charge),
                         in_quotes(mass));
    hint.is_site = type == "DRUD" || type.starts_with("LP");
    hints_.push_back(hint);
    residues_.number(atom);
    contents_.atoms.push_back(std::move(atom));
  }

  void read_bonds(std::size_t count) {
    const std::size_t count_line = lines_.number();
    std::vector<std::uint32_t> ends;
    ends.reserve(2 * count);
    for (std::string_view line; ends.size() < 2 * count && lines_.next(line);) {
      if (line.find('!') != std::string_view::npos) break;  // the next section begins
      take_bond_ends(line, 2 * count, ends);
    }
    if (ends.size() < 2 * count)
      throw InputError(file_.path, count_line, "!NBOND says {} bonds, but {} follow; is the file cut short?",
                       with_thousands(count), with_thousands(ends.size() / 2));
    for (std::size_t n = 0; n < count; ++n) contents_.bonds.push_back({ends[2 * n], ends[2 * n + 1]});
  }

  /// Appends the atoms of a line of bonds. In the largest systems numbers fill their columns, so that no blanks
  /// separate them.
  void take_bond_ends(std::string_view line, std::size_t most, std::vector<std::uint32_t>& ends) const {
    const std::size_t width = is_extended_ ? 10 : 8;
    const bool touching =
        std::ranges::any_of(fields_of(line), [&](std::string_view field) { return field.size() > width; });
    while (ends.size() < most) {
      std::string_view field = touching ? line.substr(0, width) : take_field(line);
      if (touching) line.remove_prefix(field.size());
      if (trimmed(field).empty()) return;
      std::int64_t atom = 0;
      if (!parse_whole_number(field, atom) || atom < 1 || atom > static_cast<std::int64_t>(contents_.atoms.size()))
        throw lines_.error("a bond names atom {}; the atoms are 1 to {}", in_quotes(trimmed(field)),
                           with_thousands(contents_.atoms.size()));
      ends.push_back(static_cast<std::uint32_t>(atom - 1));
    }
  }

  const TextFile& file_;
  LineReader lines_;
  FileContents contents_;
  std::vector<AtomHints> hints_;
  ResidueCounter residues_{contents_.atoms};
  bool is_extended_ = false;
};

bool recognizes(std::string_view text) {
  return text.starts_with("PSF") && (text.size() == 3 || std::isspace(static_cast<unsigned char>(text[3])));
}

FileContents read(const TextFile& file, const ModelChoice&) { return PsfReader(file).run(); }

}  // namespace

const Reader kPsfReader{
    {"PSF", ".psf", "topology of CHARMM, NAMD and X-PLOR, without coordinates: add @trajectory@",
     "CHARMM documentation, struct.info; NAMD tutorial, PSF files",
     "atoms with segments (they are the chains), residues, names, charges; elements by mass and name; Drude particles "
     "and lone pairs by type and mass; bonds; standard, EXT, XPLOR and NAMD forms"},
    recognizes,
    read};

}  // namespace meniscus
