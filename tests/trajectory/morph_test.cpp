// SPDX-License-Identifier: BSD-3-Clause
// Paths between structures keep bonds and hands, let nothing pass through anything, and have the right ends.
#include "core/trajectory/morph.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/structure/formats/pdb_records.h"
#include "core/structure/formats/read_structure.h"
#include "tests/support/run_program.h"
#include "tests/support/sample_files.h"

namespace meniscus {
namespace {

/// Returns ubiquitin with residues from `hinge` on turned by an angle about an axis through its alpha carbon.
Structure bent(int hinge, double angle) {
  Structure structure = read_structure(kUbiquitin, {});
  glm::dvec3 middle(0.0);
  for (const Atom& atom : structure.atoms)
    if (atom.residue_number == hinge && atom.name == "CA") middle = atom.position;
  const glm::dquat turn = glm::angleAxis(angle, glm::normalize(glm::dvec3(1, 0.3, -0.2)));
  for (Atom& atom : structure.atoms)
    if (atom.residue_number > hinge || (atom.residue_number == hinge && (atom.name == "C" || atom.name == "O")))
      atom.position = middle + turn * (atom.position - middle);
  return structure;
}

std::vector<bool> all(const Structure& structure) { return std::vector<bool>(structure.atoms.size(), true); }

Morph morph_of(const std::vector<Structure>& structures, std::vector<std::vector<bool>> fitted = {}) {
  if (fitted.empty())
    for (const Structure& structure : structures) fitted.push_back(all(structure));
  return Morph(common_atoms(structures, fitted));
}

/// Returns the signed volumes of N, C and CB around each alpha carbon.
std::vector<double> hands(const std::vector<Atom>& atoms, const std::vector<glm::dvec3>& x) {
  std::vector<double> found;
  for (std::size_t a = 0; a + 4 < atoms.size(); ++a)
    if (atoms[a].name == "N" && atoms[a + 1].name == "CA" && atoms[a + 4].name == "CB")
      found.push_back(glm::dot(x[a] - x[a + 1], glm::cross(x[a + 2] - x[a + 1], x[a + 4] - x[a + 1])));
  return found;
}

TEST(Morphs, ADomainTurnsAsABody) {
  const std::vector<Structure> ends{bent(72, 0.0), bent(72, -1.5)};
  std::vector<std::vector<bool>> fitted;
  for (const Structure& structure : ends) {
    fitted.push_back(all(structure));
    for (std::size_t a = 0; a < structure.atoms.size(); ++a) fitted.back()[a] = structure.atoms[a].residue_number < 70;
  }
  const Morph morph = morph_of(ends, fitted);
  ASSERT_EQ(morph.atoms().size(), ends.front().atoms.size());
  constexpr std::size_t kSteps = 12;
  const std::vector<std::vector<glm::dvec3>> way = morph.models(0, kSteps);
  ASSERT_EQ(way.size(), kSteps);
  EXPECT_EQ(way.front(), morph.at(0));
  const std::vector<double> hand = hands(morph.atoms(), morph.at(0));
  EXPECT_GT(hand.size(), 60u);
  for (std::size_t n = 1; n < kSteps; ++n) {
    const std::vector<glm::dvec3>& now = way[n];
    for (const auto& [a, b] : morph.bonds()) {
      const double from = glm::distance(morph.at(0)[a], morph.at(0)[b]),
                   to = glm::distance(morph.at(1)[a], morph.at(1)[b]);
      const double share = double(n) / kSteps;
      EXPECT_NEAR(glm::distance(now[a], now[b]), (1.0 - share) * from + share * to, 0.02);
    }
    const std::vector<double> here = hands(morph.atoms(), now);
    for (std::size_t c = 0; c < hand.size(); ++c) EXPECT_GT(here[c] * hand[c], 0.0) << n;
    // One body stays, and the other turns in steps: on a straight line they would be shorter in the middle.
    double moved = 0.0, longest = 0.0;
    for (std::size_t a = 0; a < now.size(); ++a) {
      if (morph.atoms()[a].residue_number < 60) moved = std::max(moved, glm::distance(now[a], morph.at(0)[a]));
      longest = std::max(longest, glm::distance(now[a], way[n - 1][a]));
    }
    EXPECT_LT(moved, 0.7) << n;
    EXPECT_LT(longest, 4.0) << n;
  }
}

TEST(Morphs, NothingPassesThroughAnything) {
  // Two short chains of carbons change places along the line between them.
  Structure from;
  from.file = "made-up";
  for (int n = 0; n < 8; ++n) {
    Atom atom;
    atom.kind = AtomClass::polymer;
    atom.element = 6;
    atom.radius = 1.7;
    atom.index = static_cast<std::uint32_t>(n);
    atom.residue = static_cast<std::uint32_t>(n);
    atom.residue_number = n % 4 + 1;
    atom.name = "CA";
    atom.residue_name = "ALA";
    atom.chain = n < 4 ? "A" : "B";
    atom.position = {3.8 * (n % 4), (n < 4 ? 0.0 : 0.3) + 0.8 * (n % 2), n < 4 ? 0.0 : 9.0};
    from.atoms.push_back(atom);
  }
  CommonAtoms common{from.atoms, {{}, {}}, {}, {0, 1, 2, 3, 4, 5, 6, 7}};
  for (const Atom& atom : from.atoms) {
    common.positions[0].push_back(atom.position);
    common.positions[1].push_back({atom.position.x, atom.position.y, 9.0 - atom.position.z});
  }
  const Morph morph(common);
  double nearest = 1e9;
  for (const std::vector<glm::dvec3>& now : morph.models(0, 20))
    for (std::size_t a = 0; a < 4; ++a)
      for (std::size_t b = 4; b < 8; ++b) nearest = std::min(nearest, glm::distance(now[a], now[b]));
  EXPECT_GT(nearest, 0.8 * 3.4 - 0.1);
  // Overlap is reported: on the straight way the chains meet.
  std::vector<glm::dvec3> straight;
  for (std::size_t a = 0; a < 8; ++a) straight.push_back(0.5 * (morph.at(0)[a] + morph.at(1)[a]));
  EXPECT_GT(morph.overlap(0, straight), 2.0);
  EXPECT_EQ(morph.overlap(0, morph.at(0)), 0.0);
}

TEST(Morphs, AtomsThatAllHaveAreMovedWhateverTheirChainsAreCalled) {
  std::vector<Structure> structures{bent(40, 0.0), bent(40, 0.4), bent(40, 0.8)};
  for (Atom& atom : structures[1].atoms) {
    atom.chain = "Q";
    atom.residue_number += 100;
  }
  std::erase_if(structures[2].atoms, [](const Atom& atom) { return atom.residue_number == 48 && atom.name == "NZ"; });
  const Morph morph = morph_of(structures);
  EXPECT_EQ(morph.stops(), 3u);
  EXPECT_EQ(morph.atoms().size(), structures[0].atoms.size() - 1);
  EXPECT_EQ(morph.models(1, 4).front(), morph.at(1));
  structures[1].atoms.resize(2);
  EXPECT_THROW(morph_of(structures), InputError);
}

TEST(PdbModelFiles, AreReadBackAsTheyWere) {
  test::TemporaryFolder folder;
  const Structure structure = read_structure(kUbiquitin, {});
  std::vector<glm::dvec3> first, second;
  for (const Atom& atom : structure.atoms) {
    first.push_back(atom.position);
    second.push_back(atom.position + glm::dvec3(1.0, -2.0, 0.5));
  }
  const std::string path = (folder.path() / "models.pdb").string();
  PdbModels file(path, Existing::refuse, structure.atoms);
  file.add(first);
  file.add(second);
  file.commit();
  for (const int model : {1, 2}) {
    ReadOptions options;
    options.model.number = model;
    const Structure again = read_structure(path, options);
    ASSERT_EQ(again.atoms.size(), structure.atoms.size());
    for (std::size_t a = 0; a < again.atoms.size(); ++a) {
      const Atom &one = structure.atoms[a], &other = again.atoms[a];
      EXPECT_EQ(std::tie(one.name, one.residue_name, one.chain, one.residue_number, one.element, one.kind),
                std::tie(other.name, other.residue_name, other.chain, other.residue_number, other.element, other.kind));
      EXPECT_LT(glm::distance(other.position, (model == 1 ? first : second)[a]), 1e-3);
      EXPECT_NEAR(other.b_factor, one.b_factor, 0.005);
    }
  }
  EXPECT_THROW(PdbModels(path, Existing::refuse, structure.atoms), OutputError);
  second[3].x = 1e4;
  PdbModels far((folder.path() / "far.pdb").string(), Existing::refuse, structure.atoms);
  EXPECT_THROW(far.add(second), RequestError);
  std::vector<Atom> odd(structure.atoms.begin(), structure.atoms.begin() + 1);
  odd[0].residue_number = 10000;
  EXPECT_THROW(PdbModels((folder.path() / "odd.pdb").string(), Existing::refuse, odd), RequestError);
}

}  // namespace
}  // namespace meniscus
