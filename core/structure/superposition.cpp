// SPDX-License-Identifier: BSD-3-Clause
// Aligns the sequences of chains, pairs the chains, and superposes their atoms.
#include "core/structure/superposition.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <set>

#include <gemmi/qcp.hpp>
#include <gemmi/resinfo.hpp>
#include <gemmi/seqalign.hpp>
#include <glm/geometric.hpp>

#include "core/structure/residue_names.h"
#include "core/structure/structure.h"

namespace meniscus {
namespace {

/// The residues of a chain, each with the places of its atoms.
struct Sequence {
  std::vector<std::string> names;
  std::vector<std::vector<std::uint32_t>> atoms;
};

/// Returns the standard residue that a modified one derives from, such as MET for MSE, or else the canonical name.
std::string standard_name(const std::string& residue_name) {
  const std::string name = canonical_residue(residue_name);
  const gemmi::ResidueInfo info = gemmi::find_tabulated_residue(name);
  if (!info.is_amino_acid() || info.is_standard()) return name;
  const int letter = std::toupper(static_cast<unsigned char>(info.one_letter_code));
  const char* const standard = gemmi::expand_protein_one_letter(static_cast<char>(letter));
  return standard ? standard : name;
}

/// Returns the sequences of the chains, from the atoms that take part, in the order of the file. The first of several
/// alternate locations is used.
std::vector<Sequence> sequences(std::span<const Atom> atoms, const std::vector<bool>& counts) {
  std::vector<Sequence> chains;
  std::map<std::pair<std::int32_t, std::string>, std::size_t> places;
  std::uint32_t last_residue = std::numeric_limits<std::uint32_t>::max();
  for (std::uint32_t a = 0; a < atoms.size(); ++a) {
    if (!counts[a]) continue;
    const Atom& atom = atoms[a];
    const auto [place, fresh] = places.try_emplace({atom.model, atom.chain}, chains.size());
    if (fresh) chains.emplace_back();
    Sequence& chain = chains[place->second];
    if (fresh || atom.residue != last_residue) {
      chain.names.push_back(standard_name(atom.residue_name));
      chain.atoms.emplace_back();
    }
    last_residue = atom.residue;
    std::vector<std::uint32_t>& residue = chain.atoms.back();
    const auto is_same = [&](std::uint32_t other) { return atoms[other].name == atom.name; };
    if (atom.altloc == ' ' || std::ranges::none_of(residue, is_same)) residue.push_back(a);
  }
  return chains;
}

/// Appends the pairs of atoms of two residues with the same name. If several atoms have one name, they are paired in
/// order, provided that both residues have as many of them.
void pair_residues(std::span<const Atom> reference, const std::vector<std::uint32_t>& of_reference,
                   std::span<const Atom> moved, const std::vector<std::uint32_t>& of_moved,
                   std::vector<AtomPair>& pairs) {
  const auto name_of = [](const Atom& atom) { return canonical_atom(canonical_residue(atom.residue_name), atom.name); };
  std::map<std::string, std::pair<std::vector<std::uint32_t>, std::vector<std::uint32_t>>> by_name;
  for (const std::uint32_t a : of_reference) by_name[name_of(reference[a])].first.push_back(a);
  for (const std::uint32_t a : of_moved) by_name[name_of(moved[a])].second.push_back(a);
  for (const auto& [name, both] : by_name)
    if (both.first.size() == both.second.size())
      for (std::size_t n = 0; n < both.first.size(); ++n) pairs.push_back({both.first[n], both.second[n]});
}

struct ChainPair {
  std::size_t reference = 0, moved = 0;
  int score = 0;
  std::vector<AtomPair> atoms;
};

gemmi::AlignmentScoring blosum62() {
#if __has_include(<gemmi/seqtools.hpp>)  // since gemmi 0.7
  return *gemmi::AlignmentScoring::blosum62();
#else
  return gemmi::prepare_blosum62_scoring();
#endif
}

/// Returns the scores of all residues of the chains. gemmi 0.5.7 reads a wrong row of the matrix for residues that are
/// not in it. Such residues get the scores of nucleotides in BLAST.
gemmi::AlignmentScoring scoring_of(const std::vector<Sequence>& some, const std::vector<Sequence>& others) {
  constexpr std::int8_t kSame = 5, kDifferent = -4;
  const gemmi::AlignmentScoring known = blosum62();
  std::set<std::string> names;
  for (const std::vector<Sequence>* chains : {&some, &others})
    for (const Sequence& chain : *chains) names.insert(chain.names.begin(), chain.names.end());
  const auto place = [&](const std::string& name) {
    return static_cast<std::size_t>(std::ranges::find(known.matrix_encoding, name) - known.matrix_encoding.begin());
  };
  gemmi::AlignmentScoring scoring = known;
  scoring.matrix_encoding.assign(names.begin(), names.end());
  scoring.score_matrix.clear();
  const std::size_t count = known.matrix_encoding.size();
  for (const std::string& a : names)
    for (const std::string& b : names)
      scoring.score_matrix.push_back(place(a) < count && place(b) < count
                                         ? known.score_matrix[place(a) * count + place(b)]
                                     : a == b ? kSame
                                              : kDifferent);
  return scoring;
}

gemmi::AlignmentResult alignment(const std::vector<std::string>& query, const std::vector<std::string>& target,
                                 const gemmi::AlignmentScoring& scoring) {
#if __has_include(<gemmi/seqtools.hpp>)  // since gemmi 0.7
  return gemmi::align_string_sequences(query, target, {}, &scoring);
#else
  return gemmi::align_string_sequences(query, target, {}, scoring);
#endif
}

ChainPair aligned(const Sequence& reference, std::span<const Atom> of_reference, const Sequence& moved,
                  std::span<const Atom> of_moved, const gemmi::AlignmentScoring& scoring) {
  const gemmi::AlignmentResult result = alignment(moved.names, reference.names, scoring);
  ChainPair pair;
  pair.score = result.score;
  std::size_t r = 0, m = 0;
  for (const gemmi::AlignmentResult::Item& item : result.cigar) {
    for (std::uint32_t n = 0; n < item.len(); ++n) {
      if (item.op() == 'M') pair_residues(of_reference, reference.atoms[r], of_moved, moved.atoms[m], pair.atoms);
      if (item.op() != 'I') ++r;
      if (item.op() != 'D') ++m;
    }
  }
  return pair;
}

double rmsd_of(std::span<const Atom> reference, std::span<const Atom> moved, std::span<const AtomPair> pairs,
               const RigidMotion& motion) {
  double sum = 0.0;
  for (const AtomPair& pair : pairs) {
    const glm::dvec3 away = motion(moved[pair.moved].position) - reference[pair.reference].position;
    sum += glm::dot(away, away);
  }
  return std::sqrt(sum / static_cast<double>(pairs.size()));
}

RigidMotion motion_of(const std::vector<gemmi::Position>& target, const std::vector<gemmi::Position>& moved) {
  const gemmi::SupResult best = gemmi::superpose_positions(target.data(), moved.data(), target.size(), nullptr);
  const gemmi::Mat33& m = best.transform.mat;
  RigidMotion motion;
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) motion.rotation[column][row] = m[row][column];
  motion.translation = {best.transform.vec.x, best.transform.vec.y, best.transform.vec.z};
  return motion;
}

gemmi::Position position_of(const glm::dvec3& x) { return {x.x, x.y, x.z}; }

constexpr std::size_t kFewestPairs = 3;

/// Returns all pairs of chains with enough atoms for a superposition, in descending order of their score.
std::vector<ChainPair> chain_pairs(std::span<const Atom> reference, const std::vector<Sequence>& of_reference,
                                   std::span<const Atom> moved, const std::vector<Sequence>& of_moved) {
  const gemmi::AlignmentScoring scoring = scoring_of(of_reference, of_moved);
  std::vector<ChainPair> pairs;
  for (std::size_t m = 0; m < of_moved.size(); ++m) {
    for (std::size_t r = 0; r < of_reference.size(); ++r) {
      ChainPair pair = aligned(of_reference[r], reference, of_moved[m], moved, scoring);
      pair.reference = r;
      pair.moved = m;
      if (pair.score > 0 && pair.atoms.size() >= kFewestPairs) pairs.push_back(std::move(pair));
    }
  }
  std::ranges::stable_sort(pairs, [](const ChainPair& a, const ChainPair& b) { return a.score > b.score; });
  return pairs;
}

/// True if the score of `other` is nearly that of `best`. Among such pairs, as in a homodimer, the positions of the
/// chains decide.
bool is_nearly(const ChainPair& best, const ChainPair& other) {
  constexpr double kNearly = 0.9;
  return other.score >= kNearly * best.score;
}

/// Returns the atoms of the first pair of chains and of all other pairs that are found from it.
std::vector<AtomPair> paired_from(const ChainPair& first, const std::vector<ChainPair>& candidates,
                                  std::span<const Atom> reference, std::span<const Atom> moved) {
  std::vector<AtomPair> pairs;
  std::set<std::size_t> taken_reference, taken_moved;
  const auto is_free = [&](const ChainPair& pair) {
    return !taken_reference.contains(pair.reference) && !taken_moved.contains(pair.moved);
  };
  const ChainPair* chosen = &first;
  while (true) {
    pairs.insert(pairs.end(), chosen->atoms.begin(), chosen->atoms.end());
    taken_reference.insert(chosen->reference);
    taken_moved.insert(chosen->moved);
    const auto best = std::ranges::find_if(candidates, is_free);
    if (best == candidates.end()) return pairs;
    const RigidMotion motion = superposition(reference, moved, pairs).motion;
    double least = std::numeric_limits<double>::infinity();
    for (const ChainPair& other : candidates) {
      if (!is_free(other) || other.moved != best->moved || !is_nearly(*best, other)) continue;
      const double rmsd = rmsd_of(reference, moved, other.atoms, motion);
      if (rmsd >= least) continue;
      least = rmsd;
      chosen = &other;
    }
  }
}

}  // namespace

RigidMotion superposition(std::span<const glm::dvec3> reference, std::span<const glm::dvec3> positions,
                          std::span<const std::uint32_t> atoms) {
  std::vector<gemmi::Position> target, moved;
  for (const std::uint32_t a : atoms) {
    target.push_back(position_of(reference[a]));
    moved.push_back(position_of(positions[a]));
  }
  return motion_of(target, moved);
}

Superposition superposition(std::span<const Atom> reference, std::span<const Atom> moved,
                            std::span<const AtomPair> pairs) {
  std::vector<gemmi::Position> target, from;
  for (const AtomPair& pair : pairs) {
    target.push_back(position_of(reference[pair.reference].position));
    from.push_back(position_of(moved[pair.moved].position));
  }
  Superposition fit{motion_of(target, from), pairs.size(), 0.0};
  fit.rmsd = rmsd_of(reference, moved, pairs, fit.motion);
  return fit;
}

std::vector<AtomPair> corresponding_atoms(std::span<const Atom> reference, const std::vector<bool>& of_reference,
                                          std::span<const Atom> moved, const std::vector<bool>& of_moved) {
  constexpr std::size_t kMostTried = 64;
  const std::vector<ChainPair> candidates =
      chain_pairs(reference, sequences(reference, of_reference), moved, sequences(moved, of_moved));
  std::vector<AtomPair> best;
  double least = 0.0;
  for (std::size_t n = 0; n < std::min(candidates.size(), kMostTried); ++n) {
    if (!is_nearly(candidates.front(), candidates[n])) break;
    std::vector<AtomPair> pairs = paired_from(candidates[n], candidates, reference, moved);
    if (pairs.size() < best.size()) continue;
    const double rmsd = superposition(reference, moved, pairs).rmsd;
    if (pairs.size() == best.size() && rmsd >= least) continue;
    best = std::move(pairs);
    least = rmsd;
  }
  return best;
}

}  // namespace meniscus
