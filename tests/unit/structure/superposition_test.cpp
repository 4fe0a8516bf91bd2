// SPDX-License-Identifier: BSD-3-Clause
// Superposition of molecules by their sequences: known motions, gaps, other names, chains in another order.
#include "core/structure/superposition.h"

#include <string>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <gtest/gtest.h>

#include "core/structure/formats/read_structure.h"
#include "core/structure/structure.h"

namespace meniscus {
namespace {

std::vector<Atom> ubiquitin() { return read_structure("/usr/share/freesasa/test-data/1ubq.pdb").atoms; }

RigidMotion some_motion() {
  const glm::dquat turn = glm::angleAxis(2.1, glm::normalize(glm::dvec3(1.0, -2.0, 0.5)));
  return {glm::mat3_cast(turn), {40.0, -7.0, 3.5}};
}

std::vector<Atom> moved(std::vector<Atom> atoms, const RigidMotion& motion) {
  for (Atom& atom : atoms) atom.position = motion(atom.position);
  return atoms;
}

std::vector<bool> alpha_carbons(const std::vector<Atom>& atoms) {
  std::vector<bool> selected;
  for (const Atom& atom : atoms) selected.push_back(atom.name == "CA");
  return selected;
}

Superposition fit_of(const std::vector<Atom>& reference, const std::vector<Atom>& other) {
  const std::vector<AtomPair> pairs =
      corresponding_atoms(reference, alpha_carbons(reference), other, alpha_carbons(other));
  return pairs.empty() ? Superposition{} : superposition(reference, other, pairs);
}

/// Returns the largest distance of the other molecule's atoms from their originals after the fit.
double farthest(const std::vector<Atom>& reference, const std::vector<Atom>& other, const RigidMotion& motion) {
  double most = 0.0;
  for (std::size_t n = 0; n < reference.size(); ++n)
    most = std::max(most, glm::distance(motion(other[n].position), reference[n].position));
  return most;
}

TEST(SuperpositionBySequence, UndoesAMotion) {
  const std::vector<Atom> reference = ubiquitin(), other = moved(reference, some_motion());
  const Superposition fit = fit_of(reference, other);
  EXPECT_EQ(fit.atoms, 76u);
  EXPECT_LT(fit.rmsd, 1e-5);
  EXPECT_LT(farthest(reference, other, fit.motion), 1e-5);
}

TEST(SuperpositionBySequence, NumbersAndChainsOfResiduesDoNotMatter) {
  const std::vector<Atom> reference = ubiquitin();
  std::vector<Atom> other = moved(reference, some_motion());
  for (Atom& atom : other) {
    atom.residue_number += 100;
    atom.chain = "X";
  }
  EXPECT_EQ(fit_of(reference, other).atoms, 76u);
}

TEST(SuperpositionBySequence, GapsMutationsAndOtherNamesAreAligned) {
  const std::vector<Atom> reference = ubiquitin();
  std::vector<Atom> other;
  for (Atom atom : moved(reference, some_motion())) {
    if (atom.residue_number >= 20 && atom.residue_number < 30) continue;
    if (atom.residue_name == "MET") atom.residue_name = "MSE";
    if (atom.residue_name == "HIS") atom.residue_name = "HSD";
    if (atom.residue_number == 45) atom.residue_name = "TRP";
    other.push_back(atom);
  }
  const Superposition fit = fit_of(reference, other);
  EXPECT_EQ(fit.atoms, 66u);
  EXPECT_LT(fit.rmsd, 1e-5);
}

TEST(SuperpositionBySequence, ChainsOfADimerArePairedByPlace) {
  std::vector<Atom> reference = ubiquitin();
  std::vector<Atom> second = moved(reference, {glm::dmat3(1.0), {35.0, 0.0, 0.0}});
  const std::size_t one = reference.size();
  for (Atom& atom : second) atom.chain = "B", atom.residue += 1000;
  reference.insert(reference.end(), second.begin(), second.end());
  // The dimer has a third chain elsewhere, and its chains are in another order.
  std::vector<Atom> other = moved(reference, some_motion());
  for (std::size_t n = 0; n < other.size(); ++n) other[n].chain = n < one ? "Z" : "Y";
  std::vector<Atom> third = moved(second, some_motion());
  for (Atom& atom : third) {
    atom.chain = "C", atom.residue += 2000;
    atom.position += glm::dvec3(0.0, 50.0, 0.0);
  }
  std::vector<Atom> all = third;
  all.insert(all.end(), other.begin() + static_cast<std::ptrdiff_t>(one), other.end());
  all.insert(all.end(), other.begin(), other.begin() + static_cast<std::ptrdiff_t>(one));
  const Superposition fit = fit_of(all, reference);
  EXPECT_EQ(fit.atoms, 152u);
  EXPECT_LT(fit.rmsd, 1e-5);
}

TEST(SuperpositionBySequence, AtomsOfOneNameNeedTheSameNumberOfThem) {
  std::vector<Atom> reference = ubiquitin();
  for (Atom& atom : reference) atom.name = "CA", atom.residue = 0, atom.residue_name = "UNK";
  const std::vector<Atom> other = moved(reference, some_motion());
  EXPECT_EQ(fit_of(reference, other).atoms, reference.size());
  EXPECT_EQ(fit_of(reference, std::vector<Atom>(other.begin() + 1, other.end())).atoms, 0u);
}

TEST(SuperpositionBySequence, StrangersDoNotCorrespond) {
  const std::vector<Atom> reference = ubiquitin();
  std::vector<Atom> other = reference;
  for (Atom& atom : other) atom.residue_name = "TRP";
  EXPECT_EQ(fit_of(reference, other).atoms, 0u);
}

}  // namespace
}  // namespace meniscus
