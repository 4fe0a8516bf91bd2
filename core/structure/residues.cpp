// SPDX-License-Identifier: BSD-3-Clause
// Numbers residues, chooses among their alternate locations, finds bonds between them, and separates ligands, lipids
// and ions from polymers.
#include "core/structure/residues.h"

#include <cctype>
#include <set>
#include <tuple>

#include "core/base/text.h"
#include "core/math/ball.h"
#include "core/structure/bonds.h"
#include "core/structure/element_tables.h"
#include "core/structure/residue_names.h"
#include "core/structure/sugars.h"

namespace meniscus {
namespace {

bool same_place(const Atom& a, const Atom& b) {
  return a.residue_number == b.residue_number && a.insertion_code == b.insertion_code && a.model == b.model &&
         a.chain == b.chain && a.subchain == b.subchain && a.segment == b.segment;
}

/// True if two atoms at one place may belong to one residue. Residues of several names at one place are alternatives
/// (microheterogeneity) if both have a letter.
bool same_or_alternative_name(const Atom& a, const Atom& b) {
  return a.residue_name == b.residue_name || (a.altloc != ' ' && b.altloc != ' ');
}

std::string key_of(const Atom& atom) {
  return fmt::format("{}\n{}\n{}\n{}\n{}\n{}", atom.model, atom.chain, atom.subchain, atom.segment, atom.residue_number,
                     atom.insertion_code);
}

}  // namespace

bool ResidueCounter::continues(const Piece& piece, const Atom& atom) const {
  const auto begin = atoms_.begin() + static_cast<std::ptrdiff_t>(piece.begin);
  const auto end = atoms_.begin() + static_cast<std::ptrdiff_t>(piece.end);
  return same_or_alternative_name(atoms_[piece.begin], atom) && std::none_of(begin, end, [&](const Atom& other) {
           return other.name == atom.name && other.altloc == atom.altloc && other.residue_name == atom.residue_name;
         });
}

void ResidueCounter::number(Atom& atom) {
  atom.index = static_cast<std::uint32_t>(atoms_.size());
  if (!is_piece_open_ || !same_place(atoms_.back(), atom) || !same_or_alternative_name(atoms_.back(), atom)) {
    const auto [found, added] = last_piece_.try_emplace(key_of(atom), Piece{residues_, atoms_.size(), atoms_.size()});
    piece_ = &found->second;
    if (added || !continues(*piece_, atom)) {
      *piece_ = {residues_++, atoms_.size(), atoms_.size()};
    } else {
      piece_->begin = atoms_.size();
    }
    is_piece_open_ = true;
  }
  piece_->end = atoms_.size() + 1;
  atom.residue = piece_->residue;
}

namespace {

/// The atoms of one alternate location in one residue.
struct Conformer {
  char letter;
  double occupancy = 0.0, b_factor = 0.0;  ///< sums over the atoms; a missing value counts as 1 and 0
  std::vector<std::uint32_t> atoms{};

  double mean_occupancy() const { return occupancy / static_cast<double>(atoms.size()); }
  auto rank() const { return std::make_tuple(-mean_occupancy(), b_factor / static_cast<double>(atoms.size()), letter); }
};

/// A residue with alternate locations, whose atoms are added in the order of the file and then chosen.
class AlternateResidue {
 public:
  AlternateResidue(const std::vector<Atom>& atoms, std::vector<bool>& kept) : atoms_(atoms), kept_(kept) {}

  void add(std::uint32_t n) {
    const Atom& atom = atoms_[n];
    if (atom.altloc == ' ') return keep(n);
    auto found = std::ranges::find(conformers_, atom.altloc, &Conformer::letter);
    if (found == conformers_.end()) found = conformers_.insert(found, Conformer{atom.altloc});
    found->occupancy += std::isnan(atom.occupancy) ? 1.0 : atom.occupancy;
    found->b_factor += std::isnan(atom.b_factor) ? 0.0 : atom.b_factor;
    found->atoms.push_back(n);
  }

  /// Chooses the atoms to keep. Returns a description of what was taken from other alternate locations; empty if
  /// nothing was.
  std::string choose(const AltlocChoice& choice) {
    const Conformer best = *chosen(choice);
    for (const std::uint32_t n : best.atoms) keep(n);
    const Atom& first = atoms_[best.atoms.front()];
    std::ranges::stable_sort(conformers_, std::ranges::greater{}, &Conformer::mean_occupancy);
    std::string words;
    for (const bool hydrogens : {false, true})
      for (const Conformer& other : conformers_) words += complete(first.residue_name, other, hydrogens);
    if (words.empty()) return words;
    return fmt::format("{} {}{}:{} beside {}", escaped(first.residue_name), escaped(first.chain), first.residue_number,
                       words, escaped(std::string(1, best.letter)));
  }

 private:
  void keep(std::uint32_t n) {
    kept_[n] = true;
    names_.insert(atoms_[n].name);
  }

  std::vector<Conformer>::const_iterator chosen(const AltlocChoice& choice) const {
    if (choice.rule == AltlocChoice::Rule::first) return conformers_.begin();
    const auto wanted = std::ranges::find(conformers_, choice.letter, &Conformer::letter);
    if (choice.rule == AltlocChoice::Rule::letter && wanted != conformers_.end()) return wanted;
    return std::ranges::min_element(conformers_, {}, &Conformer::rank);
  }

  std::string complete(const std::string& residue_name, const Conformer& from, bool hydrogens) {
    std::string names;
    for (const std::uint32_t n : from.atoms) {
      const Atom& atom = atoms_[n];
      if (atom.residue_name != residue_name || (atom.element == 1) != hydrogens || names_.contains(atom.name)) continue;
      if (hydrogens && !has_bonded_atom(n, from)) continue;
      keep(n);
      names += ' ' + escaped(atom.name);
    }
    return names.empty() ? names : fmt::format("{} of {}", names, escaped(std::string(1, from.letter)));
  }

  /// True if the atom that this hydrogen is bonded to is kept. Without this condition H and D, which have two names but
  /// one place in neutron structures, and hydrogens of a group that rotates would be kept twice.
  bool has_bonded_atom(std::uint32_t hydrogen, const Conformer& from) const {
    constexpr double kLongestToHydrogen = 1.6;  // Å
    return std::ranges::any_of(from.atoms, [&](std::uint32_t n) {
      return kept_[n] && atoms_[n].element != 1 &&
             glm::distance(atoms_[n].position, atoms_[hydrogen].position) <= kLongestToHydrogen;
    });
  }

  const std::vector<Atom>& atoms_;
  std::vector<bool>& kept_;
  std::vector<Conformer> conformers_;
  std::set<std::string_view> names_;  ///< names of the atoms that are kept
};

}  // namespace

std::optional<AltlocChoice> parse_altloc_choice(std::string_view text) {
  if (text == "best") return AltlocChoice{AltlocChoice::Rule::best};
  if (text == "first") return AltlocChoice{AltlocChoice::Rule::first};
  if (text == "all") return AltlocChoice{AltlocChoice::Rule::all};
  if (text.size() == 1 && std::isalnum(static_cast<unsigned char>(text[0])))
    return AltlocChoice{AltlocChoice::Rule::letter, text[0]};
  return std::nullopt;
}

std::vector<bool> kept_alternates(const std::vector<Atom>& atoms, const AltlocChoice& choice,
                                  std::vector<Warning>& warnings) {
  std::vector<bool> kept(atoms.size(), true);
  std::map<std::uint32_t, AlternateResidue> residues;
  for (const Atom& atom : atoms)
    if (atom.altloc != ' ' && choice.rule != AltlocChoice::Rule::all) residues.try_emplace(atom.residue, atoms, kept);
  for (std::uint32_t n = 0; n < atoms.size() && !residues.empty(); ++n) {
    const auto residue = residues.find(atoms[n].residue);
    if (residue == residues.end()) continue;
    kept[n] = false;
    residue->second.add(n);
  }
  std::vector<std::string> mixed;
  for (auto& [number, residue] : residues)
    if (std::string words = residue.choose(choice); !words.empty()) mixed.push_back(std::move(words));
  if (!mixed.empty())
    warnings.emplace_back(
        fmt::format("{} {} atoms that the chosen alternate location lacks; they are taken from the next (first: {})",
                    with_thousands(mixed.size()), mixed.size() == 1 ? "residue has" : "residues have", mixed.front()),
        mixed);
  return kept;
}

namespace {

// Å, length of a bond between residues.
constexpr double kShortest = 1.0, kLongest = 2.2;

/// The role of an atom that links a residue to the next or previous one: C and N, O3' and P.
enum class End : std::uint8_t { none, carbonyl, amine, hydroxyl, phosphorus };

bool complementary(End a, End b) {
  return (a == End::carbonyl && b == End::amine) || (a == End::hydroxyl && b == End::phosphorus);
}

class LinkFinder {
 public:
  explicit LinkFinder(std::span<const Atom> atoms) : atoms_(atoms) {
    for (const Atom& atom : atoms) residues_ = std::max<std::size_t>(residues_, atom.residue + std::size_t{1});
    linked_.resize(residues_);
    find_ends();
  }

  void join_by(std::span<const Bond> bonds) {
    for (const auto& [a, b] : bonds) {
      if (complementary(ends_[a], ends_[b]) || complementary(ends_[b], ends_[a])) join(a, b);
    }
  }

  void join_by_distance() {
    for (std::uint32_t n = 0; n < atoms_.size(); ++n) {
      if ((ends_[n] == End::amine || ends_[n] == End::phosphorus) && has_position(n)) cells_[cell_of(n)].push_back(n);
    }
    for (std::uint32_t n = 0; n < atoms_.size(); ++n) {
      if ((ends_[n] == End::carbonyl || ends_[n] == End::hydroxyl) && has_position(n)) join_near(n);
    }
  }

  std::vector<bool> linked() && { return std::move(linked_); }

 private:
  void find_ends() {
    std::vector<bool> amino_acid(residues_), nucleotide(residues_);
    for (const Atom& atom : atoms_) {
      if (atom.name == "CA" || is_chain_cap_name(atom.residue_name)) amino_acid[atom.residue] = true;
      if (atom.name == "C4'" || atom.name == "C4*") nucleotide[atom.residue] = true;
    }
    ends_.resize(atoms_.size(), End::none);
    for (std::size_t n = 0; n < atoms_.size(); ++n) {
      const std::string& name = atoms_[n].name;
      if (amino_acid[atoms_[n].residue] && name == "C") ends_[n] = End::carbonyl;
      if (amino_acid[atoms_[n].residue] && name == "N") ends_[n] = End::amine;
      if (nucleotide[atoms_[n].residue] && name == "P") ends_[n] = End::phosphorus;
      if (nucleotide[atoms_[n].residue] && (name == "O3'" || name == "O3*")) ends_[n] = End::hydroxyl;
    }
  }

  bool has_position(std::uint32_t n) const { return atoms_[n].position != glm::dvec3(0.0); }

  static std::uint64_t key(const glm::dvec3& corner) {
    std::uint64_t result = 0;
    for (int axis = 0; axis < 3; ++axis) result = (result << 21) + static_cast<std::uint64_t>(corner[axis] + (1 << 20));
    return result;
  }

  glm::dvec3 corner_of(std::uint32_t n) const { return glm::floor(atoms_[n].position / kLongest); }
  std::uint64_t cell_of(std::uint32_t n) const { return key(corner_of(n)); }

  void join_near(std::uint32_t n) {
    for (int x = -1; x <= 1; ++x) {
      for (int y = -1; y <= 1; ++y) {
        for (int z = -1; z <= 1; ++z) {
          const auto found = cells_.find(key(corner_of(n) + glm::dvec3(x, y, z)));
          if (found == cells_.end()) continue;
          for (const std::uint32_t other : found->second)
            if (bonded(n, other)) join(n, other);
        }
      }
    }
  }

  bool bonded(std::uint32_t a, std::uint32_t b) const {
    const Atom &first = atoms_[a], &second = atoms_[b];
    if (!complementary(ends_[a], ends_[b]) || first.model != second.model) return false;
    if (first.altloc != second.altloc && first.altloc != ' ' && second.altloc != ' ') return false;
    const double distance = glm::distance(first.position, second.position);
    return kShortest <= distance && distance <= kLongest;
  }

  void join(std::uint32_t a, std::uint32_t b) {
    if (atoms_[a].residue == atoms_[b].residue) return;
    linked_[atoms_[a].residue] = linked_[atoms_[b].residue] = true;
  }

  std::span<const Atom> atoms_;
  std::size_t residues_ = 0;
  std::vector<End> ends_;  ///< role of each atom
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> cells_;
  std::vector<bool> linked_;
};

}  // namespace

std::vector<bool> linked_residues(std::span<const Atom> atoms, std::span<const Bond> bonds) {
  LinkFinder finder(atoms);
  finder.join_by(bonds);
  finder.join_by_distance();
  return std::move(finder).linked();
}

std::vector<double> relative_accessibility(const Structure& structure, std::span<const double> areas) {
  std::vector<double> numbers(structure.atoms.size(), std::numeric_limits<double>::quiet_NaN());
  for (const AtomGroup& residue : group_atoms(structure, Grouping::residue)) {
    const std::string name = canonical_residue(structure.atoms[residue.atoms.front()].residue_name);
    std::set<std::string> heavy{"OXT"};  // OXT may be missing
    double area = 0.0;
    for (const std::uint32_t a : residue.atoms) {
      area += areas[a];
      if (const std::string& atom = structure.atoms[a].name; !bonding_class(name, atom).empty())
        heavy.insert(canonical_atom(name, atom));
    }
    if (heavy.size() != heavy_atoms_of(name)) continue;
    for (const std::uint32_t a : residue.atoms) numbers[a] = area / greatest_accessible_area(name);
  }
  return numbers;
}

namespace {

using Part = OutsidePolymer::Part;

constexpr std::size_t kFewMolecules = 20;      // more molecules of one name are solvent, salt or a membrane
constexpr std::size_t kLargeLigand = 40;       // heavy atoms; chlorophyll has 65, and a photosystem has 96 of it
constexpr std::size_t kWatersPerResidue = 10;  // crystals have up to about one

/// The atoms [first, last) of one residue.
struct Residue {
  std::size_t first, last;
};

std::vector<Residue> residues_of(std::span<const Atom> atoms) {
  std::vector<Residue> residues;
  for (std::size_t n = 0; n < atoms.size(); ++n) {
    const bool is_new =
        n == 0 || atoms[n].residue != atoms[n - 1].residue || atoms[n].residue_name != atoms[n - 1].residue_name;
    if (is_new) residues.push_back({n, n});
    residues.back().last = n + 1;
  }
  return residues;
}

/// Returns for each residue whether it is a sugar that is bound to a polymer.
std::vector<bool> bound_sugars(std::span<const Atom> atoms, std::span<const Residue> residues,
                               std::span<const Bond> listed) {
  constexpr std::uint32_t kPolymer = 0xffffffffu;  // the place of all residues of polymers together
  std::vector<bool> bound(residues.size());
  std::vector<Atom> near;              // the atoms of sugars, then the atoms of polymers that may be bound to them
  std::vector<std::uint32_t> residue;  // residue of each atom in `near`
  std::vector<glm::dvec3> positions;
  for (std::uint32_t r = 0; r < residues.size(); ++r) {
    const std::span<const Atom> own = atoms.subspan(residues[r].first, residues[r].last - residues[r].first);
    if (own.front().kind != AtomClass::ligand || !sugar_of(own)) continue;
    for (const Atom& atom : own) {
      near.push_back(atom);
      residue.push_back(r);
      positions.push_back(atom.position);
    }
  }
  if (near.empty()) return bound;
  const BallGrid grid(positions, kLongestBond);
  for (const Atom& atom : atoms) {
    if (atom.kind != AtomClass::polymer) continue;
    if (!grid.any_near(atom.position, kLongestBond, [](std::uint32_t) { return true; })) continue;
    near.push_back(atom);
    residue.push_back(kPolymer);
  }
  const std::vector<Bond> bonds = molecule_bonds(near, listed);
  const auto is_bound = [&](std::uint32_t atom) { return residue[atom] == kPolymer || bound[residue[atom]]; };
  for (bool grows = true; grows;) {
    grows = false;
    for (const auto& [a, b] : bonds) {
      if (is_bound(a) == is_bound(b)) continue;
      bound[residue[is_bound(a) ? b : a]] = true;
      grows = true;
    }
  }
  return bound;
}

}  // namespace

OutsidePolymer outside_polymer(std::span<const Atom> atoms, std::span<const Bond> bonds) {
  OutsidePolymer outside;
  const std::vector<Residue> residues = residues_of(atoms);
  const auto head = [&](const Residue& residue) -> const Atom& { return atoms[residue.first]; };
  const auto count = [&](AtomClass kind) {
    return static_cast<std::size_t>(
        std::ranges::count_if(residues, [&](const Residue& residue) { return head(residue).kind == kind; }));
  };
  const std::size_t polymer = count(AtomClass::polymer);
  if (polymer == 0) return outside;
  outside.part.assign(atoms.size(), Part::inside);
  outside.drawn.assign(atoms.size(), false);
  const bool in_water = count(AtomClass::water) > kWatersPerResidue * polymer;
  const std::vector<bool> bound = bound_sugars(atoms, residues, bonds);
  std::map<std::pair<std::int32_t, std::string>, std::vector<Residue>> by_name;
  for (std::size_t r = 0; r < residues.size(); ++r) {
    const Atom& first = head(residues[r]);
    const bool is_ligand = first.kind == AtomClass::ligand && !bound[r];
    if (!is_ligand && (first.kind != AtomClass::ion || in_water)) continue;
    const bool is_of_membrane =
        is_ligand && is_lipid(atoms.subspan(residues[r].first, residues[r].last - residues[r].first));
    by_name[{first.model, is_of_membrane ? "" : first.residue_name}].push_back(residues[r]);
    if (!is_ligand) continue;
    for (std::size_t n = residues[r].first; n < residues[r].last; ++n)
      outside.part[n] = is_of_membrane ? Part::lipid : Part::ligand;
  }
  for (const auto& [name, molecules] : by_name) {
    const bool is_of_membrane = outside.part[molecules.front().first] == Part::lipid;
    for (const Residue& molecule : molecules) {
      const std::span<const Atom> own = atoms.subspan(molecule.first, molecule.last - molecule.first);
      const auto heavy = std::ranges::count_if(own, [](const Atom& atom) { return atom.element != 1; });
      if (molecules.size() > kFewMolecules && (is_of_membrane || static_cast<std::size_t>(heavy) < kLargeLigand))
        continue;
      for (std::size_t n = molecule.first; n < molecule.last; ++n) outside.drawn[n] = true;
    }
  }
  return outside;
}

bool has_only_ions(std::span<const Atom> atoms) {
  return std::ranges::all_of(
      atoms, [](const Atom& atom) { return atom.kind == AtomClass::ion || atom.kind == AtomClass::water; });
}

}  // namespace meniscus
