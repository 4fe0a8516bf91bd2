// SPDX-License-Identifier: BSD-3-Clause
// Reads Amber's prmtop: atoms, charges, bonds and radii of generalized Born models, without coordinates.
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/structure/atom_classes.h"
#include "core/structure/formats/prmtop_sections.h"
#include "core/structure/formats/structure_formats.h"
#include "core/structure/residues.h"
#include "core/base/parse_number.h"

namespace meniscus {
namespace {

/// Charges are in units in which the energy of two of them at 1 Å is their product in kcal/mol: 18.2223 = √332.0522.
constexpr double kChargeUnit = 18.2223;

/// Where POINTERS has what.
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
    classify_atoms(contents_.atoms, contents_.warnings, {}, contents_.bonds);
    contents_.without_positions = true;
    contents_.models = 1;
    return std::move(contents_);
  }

 private:
  /// Nothing that POINTERS counts is shorter than a byte of the file.
  std::size_t count_of(std::int64_t pointer, const char* name) const {
    if (pointer < 0 || static_cast<std::uint64_t>(pointer) > file_.text.size())
      throw InputError(file_.path, 0,
                       fmt::format("POINTERS say {} of {}, which its {} bytes cannot hold; is the file cut short?",
                                   pointer, name, with_thousands(file_.text.size())));
    return static_cast<std::size_t>(pointer);
  }

  void read_atoms() {
    const std::vector<std::string> names = sections_.texts("ATOM_NAME", atoms_);
    const std::vector<double> charges = sections_.numbers("CHARGE", atoms_), masses = sections_.numbers("MASS", atoms_);
    // Amber 12 and later; -1: no element, such as a lone pair.
    std::vector<std::int64_t> elements;
    if (sections_.has("ATOMIC_NUMBER")) elements = sections_.whole_numbers("ATOMIC_NUMBER", atoms_, -1, 118);
    for (std::size_t n = 0; n < atoms_; ++n) {
      Atom& atom = contents_.atoms[n];
      atom.name = names[n];
      atom.element = elements.empty() ? element_of_mass(names[n], masses[n])
                                      : static_cast<std::uint8_t>(std::max<std::int64_t>(0, elements[n]));
      if (std::abs(charges[n]) > std::numeric_limits<float>::max())
        throw InputError(file_.path, 0, fmt::format("CHARGE of atom {} is {}", n + 1, charges[n]));
      atom.charge = static_cast<float>(charges[n] / kChargeUnit);
    }
  }

  void read_radii() {
    if (!sections_.has("RADII")) return;
    const std::vector<double> radii = sections_.numbers("RADII", atoms_);
    for (std::size_t n = 0; n < atoms_; ++n) {
      if (radii[n] < 0.0 || radii[n] > kLargestRadius)
        throw InputError(
            file_.path, 0,
            fmt::format("RADII of atom {} is {}; it must be from 0 to {} Å", n + 1, radii[n], kLargestRadius));
      contents_.atoms[n].radius = radii[n];
    }
    contents_.radii = FileRadii::if_asked;
  }

  /// Chains, numbers and insertion codes of the PDB file are there only if ParmEd's addPDB put them in.
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

  /// Threes: two atoms, as three times their place from 0, and a type.
  void read_bonds(std::string_view name, std::size_t count) {
    const std::vector<std::int64_t> numbers = sections_.whole_numbers(name, 3 * count, 0, std::int64_t{3} << 32);
    for (std::size_t n = 0; n < count; ++n) {
      Bond bond{};
      for (std::size_t end = 0; end < 2; ++end) {
        const std::int64_t place = numbers[3 * n + end];
        if (place % 3 != 0 || place / 3 >= static_cast<std::int64_t>(atoms_))
          throw InputError(file_.path, 0,
                           fmt::format("bond {} of {} names {}, which is not three times one of the atoms 0 to {}",
                                       n + 1, name, place, with_thousands(atoms_ - 1)));
        bond[end] = static_cast<std::uint32_t>(place / 3);
      }
      contents_.bonds.push_back(bond);
    }
  }

  const TextFile& file_;
  PrmtopSections sections_;
  FileContents contents_;
  std::size_t atoms_ = 0;
};

bool recognizes(std::string_view text) { return text.starts_with("%VERSION") || text.starts_with("%FLAG"); }

FileContents read(const TextFile& file, const ModelChoice&) { return PrmtopReader(file).run(); }

}  // namespace

const Reader kPrmtopReader{
    {"prmtop", ".prmtop .parm7", "topology of Amber, without coordinates: add --trajectory",
     "ambermd.org, File Formats: AMBER parameter/topology file",
     "atoms with residues, names, charges; elements by number or, where there are none, by mass and name; bonds; radii "
     "of generalized Born models for --radii file; chains and numbers of ParmEd's addPDB"},
    recognizes,
    read};

}  // namespace meniscus
