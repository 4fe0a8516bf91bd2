// SPDX-License-Identifier: BSD-3-Clause
// Templates as paths of atom names, and distances to the nearest image.
#include "core/structure/found_bonds.h"

#include <cstddef>
#include <string>
#include <string_view>
#include <unordered_map>

#include <gemmi/elem.hpp>
#include <glm/geometric.hpp>

#include "core/structure/canonical_names.h"

namespace meniscus {
namespace {

constexpr std::string_view kBackboneBonds =
    "N-CA-C-O C-OXT C-O1 C-O2 C-OC1 C-OC2";  // the last four: ends of chains by GROMACS
constexpr std::string_view kSugarBonds = "OP1-P-OP2 P-OP3 P-O5'-C5'-C4'-C3'-C2'-C1'-O4'-C4' C3'-O3' C2'-O2'";

/// Heavy atoms of a residue beyond its backbone or sugar: paths of bonded atoms, names of wwPDB's components.
constexpr std::pair<std::string_view, std::string_view> kSideChainBonds[] = {
    {"ALA", "CA-CB"},
    {"ARG", "CA-CB-CG-CD-NE-CZ-NH1 CZ-NH2"},
    {"ASN", "CA-CB-CG-OD1 CG-ND2"},
    {"ASP", "CA-CB-CG-OD1 CG-OD2"},
    {"CYS", "CA-CB-SG"},
    {"GLN", "CA-CB-CG-CD-OE1 CD-NE2"},
    {"GLU", "CA-CB-CG-CD-OE1 CD-OE2"},
    {"GLY", ""},
    {"HIS", "CA-CB-CG-ND1-CE1-NE2-CD2-CG"},
    {"ILE", "CA-CB-CG1-CD1 CB-CG2"},
    {"LEU", "CA-CB-CG-CD1 CG-CD2"},
    {"LYS", "CA-CB-CG-CD-CE-NZ"},
    {"MET", "CA-CB-CG-SD-CE"},
    {"MSE", "CA-CB-CG-SE-CE"},
    {"PHE", "CA-CB-CG-CD1-CE1-CZ-CE2-CD2-CG"},
    {"PRO", "CA-CB-CG-CD-N"},
    {"SER", "CA-CB-OG"},
    {"THR", "CA-CB-OG1 CB-CG2"},
    {"TRP", "CA-CB-CG-CD1-NE1-CE2-CD2-CG CD2-CE3-CZ3-CH2-CZ2-CE2"},
    {"TYR", "CA-CB-CG-CD1-CE1-CZ-CE2-CD2-CG CZ-OH"},
    {"VAL", "CA-CB-CG1 CB-CG2"},
    {"ACE", "CH3-C-O"},
    {"NME", "N-CH3 N-C"},
    {"NH2", ""},
    {"HOH", ""},
    {"A", "C1'-N9-C8-N7-C5-C6-N1-C2-N3-C4-N9 C4-C5 C6-N6"},
    {"G", "C1'-N9-C8-N7-C5-C6-N1-C2-N3-C4-N9 C4-C5 C6-O6 C2-N2"},
    {"C", "C1'-N1-C2-N3-C4-C5-C6-N1 C2-O2 C4-N4"},
    {"U", "C1'-N1-C2-N3-C4-C5-C6-N1 C2-O2 C4-O4"},
    {"DA", "C1'-N9-C8-N7-C5-C6-N1-C2-N3-C4-N9 C4-C5 C6-N6"},
    {"DG", "C1'-N9-C8-N7-C5-C6-N1-C2-N3-C4-N9 C4-C5 C6-O6 C2-N2"},
    {"DC", "C1'-N1-C2-N3-C4-C5-C6-N1 C2-O2 C4-N4"},
    {"DT", "C1'-N1-C2-N3-C4-C5-C6-N1 C2-O2 C4-O4 C5-C7 C5-C5M"},
};

class BondFinder {
 public:
  BondFinder(std::span<const Atom> atoms, std::span<const glm::dvec3> positions,
             const std::optional<PeriodicCell>& cell)
      : atoms_(atoms), positions_(positions), cell_(cell) {
    for (std::uint32_t n = 0; n < atoms.size(); ++n) {
      if (n == 0 || atoms[n].residue != atoms[n - 1].residue) begins_.push_back(n);
    }
    begins_.push_back(static_cast<std::uint32_t>(atoms.size()));
  }

  std::vector<Bond> by_template() {
    for (std::size_t r = 0; r + 1 < begins_.size(); ++r) {
      const std::string residue = canonical_residue(atoms_[begins_[r]].residue_name);
      const Names names = names_of(r, residue);
      for (const auto& [name, side_chain] : kSideChainBonds) {
        if (name != residue) continue;
        join_path(names, kBackboneBonds);
        join_path(names, kSugarBonds);
        join_path(names, side_chain);
      }
      join_hydrogens(r);
      if (r > 0 && atoms_[begins_[r]].chain == atoms_[begins_[r - 1]].chain) {
        join(last_names_, "C", names, "N");
        join(last_names_, "O3'", names, "P");
      }
      last_names_ = names;
    }
    return std::move(bonds_);
  }

  std::vector<Bond> by_distance() {
    for (std::size_t r = 0; r + 1 < begins_.size(); ++r) {
      const bool continues = r > 0 && atoms_[begins_[r]].chain == atoms_[begins_[r - 1]].chain;
      for (std::uint32_t a = begins_[r]; a < begins_[r + 1]; ++a)
        for (std::uint32_t b = continues ? begins_[r - 1] : begins_[r]; b < a; ++b)
          if (squared_distance(a, b) <= squared_reach(a, b)) bonds_.push_back({b, a});
    }
    return std::move(bonds_);
  }

 private:
  using Names = std::unordered_map<std::string, std::uint32_t>;

  Names names_of(std::size_t r, const std::string& residue) const {
    Names names;
    for (std::uint32_t n = begins_[r]; n < begins_[r + 1]; ++n)
      if (atoms_[n].element != 1) names.try_emplace(canonical_atom(residue, atoms_[n].name), n);
    return names;
  }

  double squared_distance(std::uint32_t a, std::uint32_t b) const {
    glm::dvec3 d = positions_[a] - positions_[b];
    if (cell_) d = cell_->shortest(d);
    return glm::dot(d, d);
  }

  double squared_reach(std::uint32_t a, std::uint32_t b) const {
    const auto radius = [&](std::uint32_t n) { return gemmi::Element(atoms_[n].element).covalent_r(); };
    if (atoms_[a].element == 1 && atoms_[b].element == 1) return 0.0;
    const double reach = radius(a) + radius(b) + 0.4;
    return reach * reach;
  }

  /// Every two neighbours of "A-B-C D-E" that are both there.
  void join_path(const Names& names, std::string_view paths) {
    const std::uint32_t* last = nullptr;
    while (!paths.empty()) {
      const std::size_t end = paths.find_first_of("- ");
      const auto found = names.find(std::string(paths.substr(0, end)));
      const std::uint32_t* atom = found == names.end() ? nullptr : &found->second;
      if (last && atom) bonds_.push_back({*last, *atom});
      last = end != std::string_view::npos && paths[end] == '-' ? atom : nullptr;
      paths.remove_prefix(end == std::string_view::npos ? paths.size() : end + 1);
    }
  }

  void join_hydrogens(std::size_t r) {
    constexpr double kLongestToHydrogen = 1.6;
    for (std::uint32_t h = begins_[r]; h < begins_[r + 1]; ++h) {
      if (atoms_[h].element > 1) continue;  // and sites without an element, such as the fourth of water models
      std::uint32_t nearest = h;
      double least = kLongestToHydrogen * kLongestToHydrogen;
      for (std::uint32_t n = begins_[r]; n < begins_[r + 1]; ++n) {
        if (atoms_[n].element <= 1 || squared_distance(h, n) > least) continue;
        nearest = n;
        least = squared_distance(h, n);
      }
      if (nearest != h) bonds_.push_back({nearest, h});
    }
  }

  void join(const Names& first, const char* first_name, const Names& second, const char* second_name) {
    constexpr double kLongestLink = 2.2;
    const auto a = first.find(first_name), b = second.find(second_name);
    if (a == first.end() || b == second.end()) return;
    if (squared_distance(a->second, b->second) <= kLongestLink * kLongestLink) bonds_.push_back({a->second, b->second});
  }

  std::span<const Atom> atoms_;
  std::span<const glm::dvec3> positions_;
  const std::optional<PeriodicCell>& cell_;
  std::vector<std::uint32_t> begins_;  ///< of the residues, and the end
  Names last_names_;
  std::vector<Bond> bonds_;
};

}  // namespace

std::vector<Bond> template_bonds(std::span<const Atom> atoms, std::span<const glm::dvec3> positions,
                                 const std::optional<PeriodicCell>& cell) {
  return BondFinder(atoms, positions, cell).by_template();
}

std::vector<Bond> guessed_bonds(std::span<const Atom> atoms, std::span<const glm::dvec3> positions,
                                const std::optional<PeriodicCell>& cell) {
  return BondFinder(atoms, positions, cell).by_distance();
}

}  // namespace meniscus
