// SPDX-License-Identifier: BSD-3-Clause
// Classifies atoms residue by residue if the class depends on other atoms, and otherwise atom by atom; and builds and
// searches trees of points.
#include <algorithm>
#include <cmath>

#include <glm/common.hpp>

#include "core/structure/residue_names.h"
#include "core/structure/secondary_structure.h"
#include "core/structure/selection/selection_steps.h"
#include "core/structure/structure.h"
#include "core/structure/sugars.h"

namespace meniscus {
namespace {

enum class Chemistry : std::uint8_t { other, protein, nucleic };

bool is_in_list(std::string_view names, const std::string& name) {
  if (name.empty() || name.find(' ') != std::string::npos) return false;
  return names.find(' ' + name + ' ') != std::string_view::npos;
}

// Names by IUPAC-IUB 1970 and 1983, with the older names of phosphate oxygens (O1P) and sugars (C5*).
constexpr std::string_view kProteinBackbone = " N CA C O ";
constexpr std::string_view kProteinMainChain =
    " N CA C O OXT OT OT1 OT2 H H1 H2 H3 HN HT1 HT2 HT3 1H 2H 3H HA HA1 HA2 HA3 1HA 2HA HXT D D1 D2 D3 DA ";
constexpr std::string_view kNucleicBackbone = " P OP1 OP2 OP3 O1P O2P O3P O5' C5' C4' C3' O3' O5* C5* C4* C3* O3* ";
constexpr std::string_view kPhosphateHydrogens = " HOP2 HOP3 HO5 HO3 H5T H3T ";

// Residues that the wwPDB writes as ATOM if they are part of a chain.
constexpr std::string_view kStandardResidues =
    " ALA ARG ASN ASP CYS GLN GLU GLY HIS ILE LEU LYS MET PHE PRO SER THR TRP TYR VAL ASX GLX UNK SEC PYL"
    " A C G I N U DA DC DG DI DN DT DU ";

/// True for an atom of a base. Other names of nucleotides have a prime or an asterisk in the sugar, and a P in the
/// phosphate.
bool is_base_atom(const std::string& name) {
  return name.find_first_of("'*P") == std::string::npos && !is_in_list(kPhosphateHydrogens, name);
}

Chemistry chemistry_of(std::span<const Atom> residue) {
  const Atom& head = residue.front();
  if (is_amino_acid_name(head.residue_name)) return Chemistry::protein;
  if (is_nucleotide_name(head.residue_name)) return Chemistry::nucleic;
  if (head.kind != AtomClass::polymer) return Chemistry::other;
  const auto has = [&](std::string_view name) {
    return std::any_of(residue.begin(), residue.end(), [&](const Atom& atom) { return atom.name == name; });
  };
  if (has("N") && has("CA") && has("C")) return Chemistry::protein;
  return has("C4'") || has("C4*") ? Chemistry::nucleic : Chemistry::other;
}

bool has_flag(AtomFlag flag, Chemistry chemistry, const Atom& atom) {
  const bool protein = chemistry == Chemistry::protein, nucleic = chemistry == Chemistry::nucleic;
  switch (flag) {
    case AtomFlag::protein:
      return protein;
    case AtomFlag::nucleic:
      return nucleic;
    case AtomFlag::backbone:
      return is_in_list(protein ? kProteinBackbone : nucleic ? kNucleicBackbone : std::string_view(), atom.name);
    case AtomFlag::sidechain:
      return (protein && !is_in_list(kProteinMainChain, atom.name)) || (nucleic && is_base_atom(atom.name));
    default:
      return false;
  }
}

/// Returns whether a residue belongs to a class that depends on all its atoms.
bool has_flag(AtomFlag flag, std::span<const Atom> residue) {
  if (flag == AtomFlag::glycan) return sugar_of(residue) != nullptr;
  if (flag == AtomFlag::lipid) return is_lipid(residue);
  const bool carbon = std::any_of(residue.begin(), residue.end(), [](const Atom& atom) { return atom.element == 6; });
  const bool ligand = residue.front().kind == AtomClass::ligand;
  if (flag == AtomFlag::organic) return ligand && carbon;
  return (ligand && !carbon) || residue.front().kind == AtomClass::ion;
}

bool has_flag(AtomFlag flag, const Atom& atom) {
  switch (flag) {
    case AtomFlag::all:
      return true;
    case AtomFlag::polymer:
      return atom.kind == AtomClass::polymer;
    case AtomFlag::ligand:
      return atom.kind == AtomClass::ligand;
    case AtomFlag::water:
      return atom.kind == AtomClass::water;
    case AtomFlag::ion:
      return atom.kind == AtomClass::ion;
    case AtomFlag::heteroatom:
      return atom.kind != AtomClass::unclassified &&
             (atom.kind != AtomClass::polymer || !is_in_list(kStandardResidues, atom.residue_name));
    case AtomFlag::hydrogen:
      return atom.element == 1;
    case AtomFlag::heavy:
      return atom.element != 1;
    default:
      return false;
  }
}

bool needs_residues(AtomFlag flag) {
  return flag == AtomFlag::protein || flag == AtomFlag::nucleic || flag == AtomFlag::backbone ||
         flag == AtomFlag::sidechain || flag == AtomFlag::organic || flag == AtomFlag::inorganic ||
         flag == AtomFlag::glycan || flag == AtomFlag::lipid;
}

}  // namespace

std::vector<bool> atoms_with(AtomFlag flag, std::span<const Atom> atoms) {
  std::vector<bool> result(atoms.size());
  if (flag == AtomFlag::helix || flag == AtomFlag::strand || flag == AtomFlag::coil) {
    const std::vector<SecondaryStructure> kinds = secondary_structure(atoms);
    const std::vector<bool> protein = atoms_with(AtomFlag::protein, atoms);
    const SecondaryStructure wanted = flag == AtomFlag::helix    ? SecondaryStructure::helix
                                      : flag == AtomFlag::strand ? SecondaryStructure::strand
                                                                 : SecondaryStructure::coil;
    for (std::size_t n = 0; n < atoms.size(); ++n) result[n] = protein[n] && kinds[n] == wanted;
    return result;
  }
  if (!needs_residues(flag)) {
    for (std::size_t n = 0; n < atoms.size(); ++n) result[n] = has_flag(flag, atoms[n]);
    return result;
  }
  std::size_t last = 0;
  for (std::size_t first = 0; first < atoms.size(); first = last) {
    const Atom& head = atoms[first];
    while (last < atoms.size() && atoms[last].residue == head.residue && atoms[last].residue_name == head.residue_name)
      ++last;
    const std::span<const Atom> residue = atoms.subspan(first, last - first);
    if (flag == AtomFlag::organic || flag == AtomFlag::inorganic || flag == AtomFlag::glycan ||
        flag == AtomFlag::lipid) {
      const bool yes = has_flag(flag, residue);
      for (std::size_t n = first; n < last; ++n) result[n] = yes;
      continue;
    }
    const Chemistry chemistry = chemistry_of(residue);
    for (std::size_t n = first; n < last; ++n) result[n] = has_flag(flag, chemistry, atoms[n]);
  }
  return result;
}

namespace {

constexpr std::uint32_t kLeafPoints = 8;

double squared_length(const glm::dvec3& v) { return v.x * v.x + v.y * v.y + v.z * v.z; }

}  // namespace

PointTree::PointTree(std::vector<glm::dvec3> points) : points_(std::move(points)) {
  if (!points_.empty()) build(0, static_cast<std::uint32_t>(points_.size()));
}

void PointTree::build(std::uint32_t first, std::uint32_t last) {
  const std::size_t own = nodes_.size();
  Node node{points_[first], points_[first], first, last};
  for (std::uint32_t n = first; n < last; ++n) {
    node.low = glm::min(node.low, points_[n]);
    node.high = glm::max(node.high, points_[n]);
  }
  nodes_.push_back(node);
  if (last - first <= kLeafPoints) return;
  const glm::dvec3 extent = node.high - node.low;
  const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : (extent.y >= extent.z ? 1 : 2);
  const std::uint32_t middle = first + (last - first) / 2;
  std::nth_element(points_.begin() + first, points_.begin() + middle, points_.begin() + last,
                   [axis](const glm::dvec3& a, const glm::dvec3& b) { return a[axis] < b[axis]; });
  build(first, middle);
  nodes_[own].far_child = static_cast<std::uint32_t>(nodes_.size());
  build(middle, last);
}

// Decisions about boxes agree with those about points, because rounding keeps the order of numbers: a distance to the
// near (far) side of a box, summed in the same order, never exceeds (falls below) that of a point inside.
bool PointTree::any_within(const glm::dvec3& place, double reach) const {
  const double limit = reach * reach;
  std::array<std::uint32_t, 64> pending{};  // 2^32 points have 32 levels
  std::size_t count = 0;
  if (!nodes_.empty()) pending[count++] = 0;
  while (count > 0) {
    const std::uint32_t own = pending[--count];
    const Node& node = nodes_[own];
    const glm::dvec3 below = node.low - place, above = place - node.high;
    if (squared_length(glm::max(glm::max(below, above), glm::dvec3(0.0))) > limit) continue;
    if (squared_length(glm::max(glm::abs(below), glm::abs(above))) <= limit) return true;
    if (node.far_child != 0) {
      pending[count++] = node.far_child;
      pending[count++] = own + 1;
      continue;
    }
    for (std::uint32_t n = node.first; n < node.last; ++n) {
      if (squared_length(points_[n] - place) <= limit) return true;
    }
  }
  return false;
}

}  // namespace meniscus
