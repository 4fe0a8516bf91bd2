// SPDX-License-Identifier: BSD-3-Clause
// Holds the tables of Martini's beads by the names of residues and beads, and bonds beads by these names.
#include "core/structure/martini.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>

#include <glm/geometric.hpp>

#include "core/structure/residue_names.h"

namespace meniscus {
namespace {

constexpr double kRegular = 4.7, kSmall2 = 4.3, kSmall3 = 4.1, kTiny3 = 3.4;  // Å
constexpr double kLongestBackbone = 5.0, kLongestBead = 8.0;                  // Å

/// The beads of a residue, as names and types.
struct ResidueRow {
  std::string_view residue;
  std::string_view version2;  ///< "BB P5 SC1 C3 SC2 Qd"; without backbone beads
  std::string_view version3;
};

// Beads of martinize and martinize2 (vermouth 0.15), force fields martini22 and martini3001, without BB of version 2.
constexpr ResidueRow kProtein[] = {
    {"GLY", "", "BB SP1"},
    {"ALA", "", "BB SP2 SC1 TC3"},
    {"CYS", "SC1 C5", "BB P2 SC1 TC6"},
    {"VAL", "SC1 AC2", "BB SP2 SC1 SC3"},
    {"LEU", "SC1 AC1", "BB P2 SC1 SC2"},
    {"ILE", "SC1 AC1", "BB P2 SC1 SC2"},
    {"MET", "SC1 C5", "BB P2 SC1 C6"},
    {"PRO", "SC1 C3", "BB SP2a SC1 SC3"},
    {"HYP", "", "BB P1 SC1 P1"},
    {"ASN", "SC1 P5", "BB P2 SC1 SP5"},
    {"GLN", "SC1 P4", "BB P2 SC1 P5"},
    {"ASP", "SC1 Qa", "BB P2 SC1 SQ5n"},
    {"ASPP", "", "BB P2 SC1 SP2"},
    {"ASH", "", "BB P2 SC1 SP2"},
    {"ASP0", "SC1 P3", ""},
    {"GLU", "SC1 Qa", "BB P2 SC1 Q5n"},
    {"GLUP", "", "BB P2 SC1 P2"},
    {"GLH", "", "BB P2 SC1 P2"},
    {"GLU0", "SC1 P1", ""},
    {"THR", "SC1 P1", "BB P2 SC1 SP1"},
    {"SER", "SC1 P1", "BB P2 SC1 TP1"},
    {"LYS", "SC1 C3 SC2 Qd", "BB P2 SC1 SC3 SC2 SQ4p"},
    {"LSN", "SC1 C3 SC2 P1", "BB P2 SC1 SC3 SC2 SN6d"},
    {"LYN", "", "BB P2 SC1 SC3 SC2 SN6d"},
    {"ARG", "SC1 N0 SC2 Qd", "BB P2 SC1 SC3 SC2 SQ3p"},
    {"ARG0", "SC1 N0 SC2 P4", ""},
    {"HIS", "SC1 SC4 SC2 SP1 SC3 SP1", "BB P2 SC1 TC4 SC2 TN6d SC3 TN5a"},
    {"HIE", "SC1 SC4 SC2 SP1 SC3 SP1", "BB P2 SC1 TC4 SC2 TN6d SC3 TN5a"},
    {"HSE", "SC1 SC4 SC2 SP1 SC3 SP1", "BB P2 SC1 TC4 SC2 TN6d SC3 TN5a"},
    {"HID", "SC1 SC4 SC2 SP1 SC3 SP1", "BB P2 SC1 TC4 SC2 TN5a SC3 TN6d"},
    {"HSD", "SC1 SC4 SC2 SP1 SC3 SP1", "BB P2 SC1 TC4 SC2 TN5a SC3 TN6d"},
    {"HIP", "SC1 SC4 SC2 SP1 SC3 SQd", "BB P2 SC1 TC4 SC2 TP1dq SC3 TP1dq"},
    {"HSP", "SC1 SC4 SC2 SP1 SC3 SQd", "BB P2 SC1 TC4 SC2 TP1dq SC3 TP1dq"},
    {"PHE", "SC1 SC5 SC2 SC5 SC3 SC5", "BB P2 SC1 SC4 SC2 TC5 SC3 TC5"},
    {"TYR", "SC1 SC4 SC2 SC4 SC3 SP1", "BB P2 SC1 TC4 SC2 TC5 SC3 TC5 SC4 TN6"},
    {"TRP", "SC1 SC4 SC2 SNd SC3 SC5 SC4 SC5", "BB P2 SC1 TC4 SC2 TN6d SC3 TC5 SC4 TC5 SC5 TC5"},
};

// All lipids have the same beads, whatever their names. Martini 2: lipids of 2007, sphingolipids and sterols as revised
// (M. N. Melo et al., J. Chem. Phys. 143, 243152, 2015). Martini 3: phospholipids of 2021, sterols of L. Borges-Araújo
// et al., J. Chem. Theory Comput. 19, 7387 (2023). All beads of tails are apolar and of regular size.
constexpr std::string_view kLipid2 =
    "NC3 Q0 NH3 Qd PO4 Qa PO1 Qa PO2 Qa CNO P5 GL0 P4 GL1 Na GL2 Na GL3 Na GL4 Na AM1 P1 AM2 P5";
constexpr std::string_view kLipid3 = "NC3 Q1 NH3 Q4p PO4 Q5 CNO P6 GL0 P4 GL1 SN4a GL2 N4a";
constexpr std::string_view kSterol2 = "ROH SP1 R1 SC1 R2 SC3 R3 SC1 R4 SC1 R5 SC1 C1 SC1 C2 C1";
constexpr std::string_view kSterol3 = "ROH P1 R1 SC4 R2 SC3 R3 SC3 R4 SC3 R5 TC2 R6 TC2 C1 C2 C2 C2";
// Ions with their water shell. A name may belong to one version or to both.
constexpr std::string_view kIon2 = "NA+ Qd CL- Qa CA+ Qd CA2+ Qd CHO Q0";
constexpr std::string_view kIon3 = "NA+ TQ5 CL- TQ5 NA TQ5 CL TQ5 BR SQ4 ID SQ2 CA SD TMA Q2 BF4 Q2 PF6 Q1 NO3 SQ3n";

/// Returns the word after `name` in "NAME TYPE NAME TYPE"; empty if there is none.
std::string_view type_in(std::string_view row, std::string_view name) {
  while (!row.empty()) {
    const auto word = [&row] {
      const std::string_view found = row.substr(0, row.find(' '));
      row.remove_prefix(std::min(row.size(), found.size() + 1));
      return found;
    };
    const std::string_view known = word(), type = word();
    if (known == name) return type;
  }
  return {};
}

/// Returns the letter of the tail that a bead belongs to. Names such as C1A, D3B, T1A and C12C consist of a letter for
/// the chemistry, the place, and the tail. '\0' for any other name.
char tail_of(std::string_view name) {
  if (name.size() < 3 || std::string_view("CDTEF").find(name.front()) == std::string_view::npos) return '\0';
  if (name.back() < 'A' || name.back() > 'F') return '\0';
  const std::string_view number = name.substr(1, name.size() - 2);
  return number.find_first_not_of("0123456789") == std::string_view::npos ? name.back() : '\0';
}

bool is_sterol_name(std::string_view name) { return !type_in(kSterol3, name).empty(); }

std::string_view lipid_type(const std::string& residue, const std::string& name, int version) {
  if (is_sterol_name(name)) {
    static const std::set<std::string_view> kSterols{"CHOL", "CHL1", "CLR", "ERGO", "ERG"};
    return kSterols.contains(residue) ? type_in(version == 2 ? kSterol2 : kSterol3, name) : std::string_view();
  }
  if (tail_of(name) != '\0') return "C1";
  return type_in(version == 2 ? kLipid2 : kLipid3, name);
}

std::string_view type_of(const std::string& residue, const std::string& name, int version) {
  if (is_martini_water(residue))
    return residue == "SW" ? "SW" : residue == "TW" ? "TW" : name == "W" || name == "WF" ? "W" : std::string_view();
  if (is_martini_ion(residue)) return type_in(version == 2 ? kIon2 : kIon3, name);
  for (const ResidueRow& row : kProtein) {
    if (row.residue != residue) continue;
    if (version == 2 && name == "BB") return "BB";
    return type_in(version == 2 ? row.version2 : row.version3, name);
  }
  return lipid_type(residue, name, version);
}

double sigma_of(std::string_view type, int version) {
  if (type.size() < 2 || (type[0] != 'S' && type[0] != 'T')) return kRegular;
  if (type[0] == 'T') return kTiny3;
  return version == 2 ? kSmall2 : kSmall3;
}

BeadClass class_of(std::string_view type) {
  if (type == "BB") return BeadClass::backbone;
  const bool sized = type.size() > 1 && (type[0] == 'S' || type[0] == 'T' || type[0] == 'A');
  switch (type[sized ? 1 : 0]) {
    case 'Q':
    case 'D':
      return BeadClass::charged;
    case 'P':
      return BeadClass::polar;
    case 'N':
      return BeadClass::intermediate;
    case 'W':
      return BeadClass::water;
    default:
      return BeadClass::apolar;
  }
}

/// Calls visit(first, last) for each run of atoms of one residue, in which `last` is not included.
template <typename Visit>
void for_each_residue(std::span<const Atom> atoms, Visit&& visit) {
  for (std::size_t first = 0, last = 0; first < atoms.size(); first = last) {
    while (last < atoms.size() && atoms[last].residue == atoms[first].residue &&
           atoms[last].residue_name == atoms[first].residue_name && atoms[last].copy == atoms[first].copy)
      ++last;
    visit(first, last);
  }
}

constexpr std::pair<std::string_view, std::string_view> kSideChainRings[] = {
    {"HIS HIE HSE HID HSD HIP HSP PHE", "SC1-SC2 SC1-SC3 SC2-SC3"},
    {"TYR", "SC1-SC2 SC1-SC3 SC2-SC3 SC2-SC4 SC3-SC4"},
};
constexpr std::string_view kTryptophan2 = "SC1-SC2 SC1-SC3 SC2-SC3 SC2-SC4 SC3-SC4";
constexpr std::string_view kTryptophan3 = "SC1-SC2 SC2-SC5 SC4-SC5 SC1-SC4 SC2-SC4 SC3-SC5 SC3-SC4";

class BeadBonds {
 public:
  explicit BeadBonds(std::span<const Atom> atoms) : atoms_(atoms) {}

  std::vector<Bond> run() {
    for_each_residue(atoms_, [&](std::size_t first, std::size_t last) {
      if (atoms_[first].element != 0) return;
      places_.clear();
      for (std::size_t n = first; n < last; ++n) places_.try_emplace(atoms_[n].name, static_cast<std::uint32_t>(n));
      if (places_.contains("BB"))
        join_protein(atoms_[first]);
      else if (places_.contains("ROH"))
        join_sterol(first, last);
      else
        join_lipid(first, last);
    });
    return std::move(bonds_);
  }

 private:
  void join(std::uint32_t a, std::uint32_t b, double longest = kLongestBead) {
    if (a != b && glm::distance(atoms_[a].position, atoms_[b].position) <= longest)
      bonds_.push_back({std::min(a, b), std::max(a, b)});
  }

  void join(std::string_view first, std::string_view second) {
    const auto a = places_.find(first), b = places_.find(second);
    if (a != places_.end() && b != places_.end()) join(a->second, b->second);
  }

  void join_protein(const Atom& head) {
    const std::uint32_t own = places_.find("BB")->second;
    if (last_backbone_) {
      const Atom& last = atoms_[*last_backbone_];
      if (last.chain == head.chain && last.model == head.model && last.copy == head.copy)
        join(*last_backbone_, own, kLongestBackbone);
    }
    last_backbone_ = own;
    join("BB", "SC1");
    std::string_view pairs = "SC1-SC2";
    for (const auto& [residues, rings] : kSideChainRings)
      if (residues.find(head.residue_name) != std::string_view::npos) pairs = rings;
    if (head.residue_name == "TRP") pairs = places_.contains("SC5") ? kTryptophan3 : kTryptophan2;
    while (!pairs.empty()) {
      join(pairs.substr(0, 3), pairs.substr(4, 3));
      pairs.remove_prefix(std::min<std::size_t>(pairs.size(), 8));
    }
  }

  /// Bonds each bead to the nearest of those before it.
  void join_sterol(std::size_t first, std::size_t last) {
    for (std::size_t n = first + 1; n < last; ++n) {
      std::size_t nearest = first;
      for (std::size_t other = first; other < n; ++other)
        if (glm::distance(atoms_[n].position, atoms_[other].position) <
            glm::distance(atoms_[n].position, atoms_[nearest].position))
          nearest = other;
      join(static_cast<std::uint32_t>(n), static_cast<std::uint32_t>(nearest));
    }
  }

  void join_lipid(std::size_t first, std::size_t last) {
    for (const std::string_view head : {"NC3", "NH3", "CNO", "GL0"}) join(head, "PO4");
    for (const std::string_view link : {"GL1", "AM1"}) join("PO4", link);
    join("GL1", "GL2");
    join("AM1", "AM2");
    std::map<char, std::uint32_t> ends;
    for (std::size_t n = first; n < last; ++n) {
      const char tail = tail_of(atoms_[n].name);
      if (tail == '\0') continue;
      const auto place = static_cast<std::uint32_t>(n);
      const auto [end, begins] = ends.try_emplace(tail, place);
      if (begins) {
        for (const std::string_view link : tail == 'A' ? std::array{"GL1", "AM1"} : std::array{"GL2", "AM2"})
          if (const auto found = places_.find(link); found != places_.end()) join(found->second, place);
      } else {
        join(end->second, place);
        end->second = place;
      }
    }
  }

  std::span<const Atom> atoms_;
  std::map<std::string_view, std::uint32_t> places_;
  std::optional<std::uint32_t> last_backbone_;
  std::vector<Bond> bonds_;
};

}  // namespace

bool is_martini_water(const std::string& residue_name) {
  static const std::set<std::string_view> kWaters{"W", "WF", "PW", "SW", "TW"};
  return kWaters.contains(residue_name);
}

bool is_martini_ion(const std::string& residue_name) {
  static const std::set<std::string_view> kIons{"ION", "NA+", "CL-", "CA+", "NA", "CL", "CA", "BR", "IOD"};
  return kIons.contains(residue_name);
}

bool is_martini_mark(std::string_view name) {
  constexpr std::string_view kMarks[] = {"BB", "PO4", "GL0", "GL1", "GL2", "AM1", "AM2", "CNO", "ROH"};
  return std::ranges::find(kMarks, name) != std::end(kMarks);
}

bool has_martini_names(const std::string& residue_name, std::span<const std::string> names) {
  const auto has = [&](std::string_view name) { return std::ranges::find(names, name) != names.end(); };
  if (has("BB")) return is_amino_acid_name(canonical_residue(residue_name)) || !type_of(residue_name, "BB", 3).empty();
  return std::ranges::any_of(names, [](const std::string& name) { return is_martini_mark(name); });
}

MartiniVersion martini_version(std::span<const Atom> atoms) {
  bool any = false, two = false, three = false;
  for_each_residue(atoms, [&](std::size_t first, std::size_t last) {
    if (atoms[first].element != 0) return;
    std::vector<std::string> names;
    for (std::size_t n = first; n < last; ++n) names.push_back(atoms[n].name);
    const std::string& residue = atoms[first].residue_name;
    if (!has_martini_names(residue, names)) return;
    any = true;
    const auto has = [&](std::string_view name) { return std::ranges::find(names, name) != names.end(); };
    if (has("BB")) {
      if (residue == "ALA") (has("SC1") ? three : two) = true;
      if (residue == "TYR" && has("SC3")) (has("SC4") ? three : two) = true;
      if (residue == "TRP" && has("SC4")) (has("SC5") ? three : two) = true;
    }
    if (has("ROH") && has("R5")) (has("R6") ? three : two) = true;
    if (has("AM1") && has("AM2")) two = true;
  });
  if (!any) return {};
  return {two && !three ? 2 : 3, two != three};
}

std::optional<Bead> martini_bead(const std::string& residue_name, const std::string& name, int version) {
  const std::string_view type = type_of(residue_name, name, version);
  if (type.empty()) return {};
  static const double kOfMinimum = std::pow(2.0, 1.0 / 6.0) / 2.0;
  return Bead{type, kOfMinimum * sigma_of(type, version), class_of(type)};
}

std::vector<Bond> martini_bonds(std::span<const Atom> atoms) { return BeadBonds(atoms).run(); }

}  // namespace meniscus
