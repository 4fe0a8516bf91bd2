// SPDX-License-Identifier: BSD-3-Clause
// Reads prmtop of Amber: atoms, charges, bonds and radii of generalized Born models, without coordinates.

#include <algorithm>
#include <cctype>
#include <cmath>
#include <functional>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/base/text_file.h"
#include "core/structure/atom_classes.h"
#include "core/structure/formats/structure_formats.h"
#include "core/structure/residues.h"

namespace meniscus {
namespace {

/// The sections of a prmtop file, whose fields are read by name and number of fields. Each of these functions throws
/// InputError with file and line if there is no such section, if its columns are not understood, if it has fewer or
/// more fields, or if a field is not a number.
class PrmtopSections {
 public:
  /// Finds all sections. The file must outlive this object. Throws InputError if there is no section at all.
  explicit PrmtopSections(const TextFile& file);

  bool has(std::string_view name) const { return sections_.find(name) != sections_.end(); }

  /// Returns the texts of a section without blanks at both ends.
  std::vector<std::string> texts(std::string_view name, std::size_t count) const;
  /// Returns the numbers of a section, which must be finite.
  std::vector<double> numbers(std::string_view name, std::size_t count) const;
  /// Returns the integers of a section, which must be from `least` to `most`.
  std::vector<std::int64_t> whole_numbers(std::string_view name, std::size_t count, std::int64_t least,
                                          std::int64_t most) const;
  /// Returns the first `count` integers of a section, which may have more.
  std::vector<std::int64_t> first_whole_numbers(std::string_view name, std::size_t count) const;

 private:
  struct Section {
    std::size_t line = 0;                 ///< line of %FLAG
    std::size_t first_line = 0;           ///< line of the first field
    std::size_t per_line = 0, width = 0;  ///< fields of a line, and columns of a field; 0: unknown
    std::string_view text;
  };
  using Take = std::function<void(std::string_view field, std::size_t line)>;

  const Section& find(std::string_view name) const;
  enum class Fields { texts, numbers, first_numbers };
  void each_field(std::string_view name, std::size_t count, Fields kind, const Take& take) const;
  void take_number(std::string_view name, std::string_view field, std::size_t line,
                   std::vector<std::int64_t>& numbers) const;

  const TextFile& file_;
  std::map<std::string, Section, std::less<>> sections_;
};

/// Removes the digits at the beginning of a text and returns their number. Returns 0 if there are none, or if the
/// number is above 1,000 and so more than a line has columns.
std::size_t take_count(std::string_view& text) {
  std::size_t count = 0;
  while (!text.empty() && std::isdigit(static_cast<unsigned char>(text.front()))) {
    count = std::min<std::size_t>(10 * count + static_cast<std::size_t>(text.front() - '0'), 1'000'000);
    text.remove_prefix(1);
  }
  return count <= 1'000 ? count : 0;
}

PrmtopSections::PrmtopSections(const TextFile& file) : file_(file) {
  LineReader lines(file.text);
  Section* section = nullptr;
  for (std::string_view line; lines.next(line);) {
    if (line.starts_with("%FLAG")) {
      std::string_view rest = line.substr(5);
      section = &sections_[std::string(take_field(rest))];
      *section = {};
      section->line = lines.number();
    } else if (section && line.starts_with("%FORMAT(")) {
      // Formats are those of Fortran: 20a4, 10I8, 5E16.8.
      std::string_view columns = line.substr(8);
      section->per_line = take_count(columns);
      if (!columns.empty() && std::isalpha(static_cast<unsigned char>(columns.front()))) columns.remove_prefix(1);
      section->width = take_count(columns);
      section->first_line = lines.number() + 1;
      section->text = std::string_view(file.text).substr(file.text.size() - lines.bytes_left(), 0);
    } else if (section && section->first_line != 0 && !line.starts_with('%')) {
      section->text = {section->text.data(),
                       static_cast<std::size_t>(line.data() + line.size() - section->text.data())};
    }
  }
  if (sections_.empty())
    throw InputError(
        file.path, 0,
        "has no %FLAG: prmtop files of Amber 6 and before are not read; write it again with ParmEd's 'outparm'");
}

const PrmtopSections::Section& PrmtopSections::find(std::string_view name) const {
  const auto found = sections_.find(name);
  if (found == sections_.end())
    throw InputError(file_.path, 0, "has no section %FLAG {}; is the file cut short?", name);
  const Section& section = found->second;
  if (section.per_line == 0 || section.width == 0)
    throw InputError(file_.path, section.line, "%FLAG {} has no %FORMAT such as (20a4) or (5E16.8) after it", name);
  return section;
}

void PrmtopSections::each_field(std::string_view name, std::size_t count, Fields kind, const Take& take) const {
  const Section& section = find(name);
  if (count > section.text.size())  // a field has at least one letter
    throw InputError(file_.path, section.line,
                     "%FLAG {} should have {} fields, more than its {} bytes can hold; is the file cut "
                     "short?",
                     name, with_thousands(count), with_thousands(section.text.size()));
  LineReader lines(section.text);
  std::size_t taken = 0;
  for (std::string_view line; lines.next(line);) {
    for (std::size_t n = 0; n < section.per_line && taken < count; ++n, ++taken) {
      // A line may lack the blanks at its end, and also names that consist of blanks.
      if (kind != Fields::texts && trimmed(line).empty()) break;
      take(line.substr(0, section.width), section.first_line + lines.number() - 1);
      line.remove_prefix(std::min(line.size(), section.width));
    }
    if (kind != Fields::first_numbers && taken == count && !trimmed(line).empty())
      throw InputError(file_.path, section.first_line + lines.number() - 1,
                       "%FLAG {} has {} after its {} fields; do its POINTERS belong to another file?", name,
                       in_quotes(trimmed(line)), with_thousands(count));
  }
  if (taken < count)
    throw InputError(file_.path, section.line, "%FLAG {} should have {} fields, but {} follow; is the file cut short?",
                     name, with_thousands(count), with_thousands(taken));
}

std::vector<std::string> PrmtopSections::texts(std::string_view name, std::size_t count) const {
  std::vector<std::string> texts;
  each_field(name, count, Fields::texts,
             [&](std::string_view field, std::size_t) { texts.emplace_back(trimmed(field)); });
  return texts;
}

std::vector<double> PrmtopSections::numbers(std::string_view name, std::size_t count) const {
  std::vector<double> numbers;
  each_field(name, count, Fields::numbers, [&](std::string_view field, std::size_t line) {
    double number = 0.0;
    if (!parse_number(field, number))
      throw InputError(file_.path, line, "{} of %FLAG {} is not a number", in_quotes(field), name);
    numbers.push_back(number);
  });
  return numbers;
}

void PrmtopSections::take_number(std::string_view name, std::string_view field, std::size_t line,
                                 std::vector<std::int64_t>& numbers) const {
  std::int64_t number = 0;
  if (!parse_whole_number(field, number))
    throw InputError(file_.path, line, "{} of %FLAG {} is not a whole number", in_quotes(field), name);
  numbers.push_back(number);
}

std::vector<std::int64_t> PrmtopSections::whole_numbers(std::string_view name, std::size_t count, std::int64_t least,
                                                        std::int64_t most) const {
  std::vector<std::int64_t> numbers;
  each_field(name, count, Fields::numbers, [&](std::string_view field, std::size_t line) {
    take_number(name, field, line, numbers);
    if (numbers.back() < least || numbers.back() > most)
      throw InputError(file_.path, line, "%FLAG {} holds {}, which is not from {} to {}", name, numbers.back(), least,
                       most);
  });
  return numbers;
}

std::vector<std::int64_t> PrmtopSections::first_whole_numbers(std::string_view name, std::size_t count) const {
  std::vector<std::int64_t> numbers;
  each_field(name, count, Fields::first_numbers,
             [&](std::string_view field, std::size_t line) { take_number(name, field, line, numbers); });
  return numbers;
}

/// The unit of charges. In this unit the energy of two charges at a distance of 1 Å is their product in kcal/mol:
/// 18.2223 = √332.0522.
constexpr double kChargeUnit = 18.2223;

/// Places in the section POINTERS.
constexpr std::size_t kAtoms = 0, kBondsWithHydrogen = 2, kResidues = 11, kBondsWithoutHydrogen = 12, kPointers = 13;

class PrmtopReader {
 public:
  explicit PrmtopReader(const TextFile& file) : file_(file), sections_(file) {}

  FileContents run() {
    const std::vector<std::int64_t> pointers = sections_.first_whole_numbers("POINTERS", kPointers);
    atoms_ = count_of(pointers[kAtoms], "NATOM");
    if (atoms_ == 0) throw InputError(file_.path, 0, "lists no atoms: POINTERS begins with 0");
    contents_.atoms.resize(atoms_);
    read_atoms();
    read_radii();
    number_residues(count_of(pointers[kResidues], "NRES"));
    read_bonds("BONDS_INC_HYDROGEN", count_of(pointers[kBondsWithHydrogen], "NBONH"));
    read_bonds("BONDS_WITHOUT_HYDROGEN", count_of(pointers[kBondsWithoutHydrogen], "NBONA"));
    contents_.sites = classify_atoms(contents_.atoms, contents_.warnings, hints_, contents_.bonds);
    contents_.without_positions = true;
    contents_.models = 1;
    return std::move(contents_);
  }

 private:
  /// Returns a count of POINTERS. Throws InputError if it is more than the bytes of the file, because everything that
  /// is counted takes at least one byte.
  std::size_t count_of(std::int64_t pointer, const char* name) const {
    if (pointer < 0 || static_cast<std::uint64_t>(pointer) > file_.text.size())
      throw InputError(file_.path, 0, "POINTERS say {} of {}, which its {} bytes cannot hold; is the file cut short?",
                       pointer, name, with_thousands(file_.text.size()));
    return static_cast<std::size_t>(pointer);
  }

  void read_atoms() {
    const std::vector<std::string> names = sections_.texts("ATOM_NAME", atoms_);
    const std::vector<double> charges = sections_.numbers("CHARGE", atoms_), masses = sections_.numbers("MASS", atoms_);
    // Amber 12 and later have atomic numbers. -1 means that there is no element, as for a lone pair, or that LEaP does
    // not know it.
    std::vector<std::int64_t> elements;
    std::vector<std::string> types(atoms_);
    if (sections_.has("AMBER_ATOM_TYPE")) types = sections_.texts("AMBER_ATOM_TYPE", atoms_);
    if (sections_.has("ATOMIC_NUMBER")) elements = sections_.whole_numbers("ATOMIC_NUMBER", atoms_, -1, 118);
    for (std::size_t n = 0; n < atoms_; ++n) {
      Atom& atom = contents_.atoms[n];
      atom.name = names[n];
      if (!elements.empty()) atom.element = static_cast<std::uint8_t>(std::max<std::int64_t>(0, elements[n]));
      hints_.push_back(
          {.is_site = is_site_symbol(types[n]), .mass = static_cast<float>(std::clamp(masses[n], 0.0, 1e6))});
      if (std::abs(charges[n]) > std::numeric_limits<float>::max())
        throw InputError(file_.path, 0, "CHARGE of atom {} is {}", n + 1, charges[n]);
      atom.charge = static_cast<float>(charges[n] / kChargeUnit);
    }
    set_elements_by_mass(contents_.atoms, hints_);
  }

  void read_radii() {
    if (!sections_.has("RADII")) return;
    const std::vector<double> radii = sections_.numbers("RADII", atoms_);
    for (std::size_t n = 0; n < atoms_; ++n) {
      if (radii[n] < 0.0 || radii[n] > kLargestRadius)
        throw InputError(file_.path, 0, "RADII of atom {} is {}; it must be from 0 to {} Å", n + 1, radii[n],
                         kLargestRadius);
      contents_.atoms[n].radius = radii[n];
    }
    contents_.radii = FileRadii::on_request;
  }

  /// Numbers the residues. Chains, numbers and insertion codes of the PDB file are in the file only if ParmEd's addPDB
  /// was used.
  void number_residues(std::size_t count) {
    const std::vector<std::string> names = sections_.texts("RESIDUE_LABEL", count);
    std::vector<std::int64_t> first =
        sections_.whole_numbers("RESIDUE_POINTER", count, 1, static_cast<std::int64_t>(atoms_));
    if (count == 0 || first.front() != 1 || !std::ranges::is_sorted(first))
      throw InputError(file_.path, 0, "RESIDUE_POINTER does not begin with 1, or does not ascend");
    first.push_back(static_cast<std::int64_t>(atoms_) + 1);
    const bool has_numbers = sections_.has("RESIDUE_NUMBER");
    std::vector<std::int64_t> numbers;
    if (has_numbers) numbers = sections_.whole_numbers("RESIDUE_NUMBER", count, -99'999'999, 99'999'999);
    const std::vector<std::string> chains = optional_texts("RESIDUE_CHAINID", count),
                                   codes = optional_texts("RESIDUE_ICODE", count);
    std::vector<Atom> atoms = std::move(contents_.atoms);
    contents_.atoms.clear();
    contents_.atoms.reserve(atoms_);
    ResidueCounter residues(contents_.atoms);
    for (std::size_t r = 0; r < count; ++r) {
      residues.end_piece();
      for (auto n = static_cast<std::size_t>(first[r] - 1); n < static_cast<std::size_t>(first[r + 1] - 1); ++n) {
        Atom& atom = atoms[n];
        atom.residue_name = names[r];
        atom.residue_number = has_numbers ? static_cast<std::int32_t>(numbers[r]) : static_cast<std::int32_t>(r + 1);
        atom.chain = atom.subchain = atom.segment = chains[r];
        if (!codes[r].empty()) atom.insertion_code = codes[r].front();
        residues.number(atom);
        contents_.atoms.push_back(std::move(atom));
      }
    }
  }

  std::vector<std::string> optional_texts(std::string_view name, std::size_t count) const {
    return sections_.has(name) ? sections_.texts(name, count) : std::vector<std::string>(count);
  }

  /// Reads bonds of three numbers: two atoms, each as three times its place from 0, and a type.
  void read_bonds(std::string_view name, std::size_t count) {
    const std::vector<std::int64_t> numbers = sections_.whole_numbers(name, 3 * count, 0, std::int64_t{3} << 32);
    for (std::size_t n = 0; n < count; ++n) {
      Bond bond{};
      for (std::size_t end = 0; end < 2; ++end) {
        const std::int64_t place = numbers[3 * n + end];
        if (place % 3 != 0 || place / 3 >= static_cast<std::int64_t>(atoms_))
          throw InputError(file_.path, 0, "bond {} of {} names {}, which is not three times one of the atoms 0 to {}",
                           n + 1, name, place, with_thousands(atoms_ - 1));
        bond[end] = static_cast<std::uint32_t>(place / 3);
      }
      contents_.bonds.push_back(bond);
    }
  }

  const TextFile& file_;
  PrmtopSections sections_;
  FileContents contents_;
  std::vector<AtomHints> hints_;
  std::size_t atoms_ = 0;
};

bool recognizes(std::string_view text) { return text.starts_with("%VERSION") || text.starts_with("%FLAG"); }

FileContents read(const TextFile& file, const ModelChoice&) { return PrmtopReader(file).run(); }

}  // namespace

const Reader kPrmtopReader{
    {"prmtop", ".prmtop .parm7", "topology of Amber, without coordinates: add @trajectory@",
     "ambermd.org, File Formats: AMBER parameter/topology file",
     "atoms with residues, names, charges; elements by number or, where there are none, by mass and name; bonds; radii "
     "of generalized Born models for @radii file@; chains and numbers of ParmEd's addPDB"},
    recognizes,
    read};

}  // namespace meniscus
