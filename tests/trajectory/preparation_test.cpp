// SPDX-License-Identifier: BSD-3-Clause
// Prepared frames: nearest images against brute force, molecules made whole, superposition, smoothing, reading ahead.
#include <algorithm>
#include <atomic>
#include <cmath>
#include <random>
#include <stdexcept>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/matrix.hpp>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/structure/bonds.h"
#include "core/structure/formats/read_structure.h"
#include "core/structure/superposition.h"
#include "core/trajectory/prepared_frames.h"
#include "tests/support/sample_files.h"

namespace meniscus {
namespace {

std::mt19937 g_random(11);

double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(g_random); }
glm::dvec3 point(double extent) {
  return {uniform(-extent, extent), uniform(-extent, extent), uniform(-extent, extent)};
}
glm::dmat3 rotation() {
  return glm::mat3_cast(glm::normalize(glm::dquat(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1), uniform(-1, 1))));
}

/// Returns boxes like those of simulations and worse: cubic, triclinic, flat, long, badly reduced.
glm::dmat3 any_cell() {
  const double a = uniform(5, 50), b = uniform(5, 50), c = uniform(5, 50);
  glm::dmat3 cell(glm::dvec3(a, 0, 0), glm::dvec3(uniform(-2 * a, 2 * a), b, 0),
                  glm::dvec3(uniform(-2 * a, 2 * a), uniform(-2 * b, 2 * b), c));
  if (g_random() % 3 == 0)
    cell = glm::dmat3(glm::dvec3(a, 0, 0), glm::dvec3(0, a, 0), glm::dvec3(a / 2, a / 2, a / std::sqrt(2.0)));
  return rotation() * cell;
}

TEST(PeriodicCell, ShortestOfManyImages) {
  for (int round = 0; round < 1000; ++round) {
    const glm::dmat3 vectors = any_cell();
    const auto cell = PeriodicCell::of(vectors);
    ASSERT_TRUE(cell);
    const glm::dvec3 start = vectors * glm::dvec3(uniform(-0.5, 0.5), uniform(-0.5, 0.5), uniform(-0.5, 0.5));
    double least = 1e300;
    for (int a = -7; a <= 7; ++a)
      for (int b = -7; b <= 7; ++b)
        for (int c = -7; c <= 7; ++c) least = std::min(least, glm::length(start + vectors * glm::dvec3(a, b, c)));
    const glm::dvec3 d = start + vectors * glm::dvec3(int(g_random() % 9) - 4, int(g_random() % 9) - 4, 3);
    const glm::dvec3 found = cell->shortest(d);
    EXPECT_NEAR(glm::length(found), least, 1e-9);
    const glm::dvec3 steps = glm::inverse(vectors) * (found - d);
    for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(steps[axis], std::round(steps[axis]), 1e-9);
  }
}

TEST(PeriodicCell, NoBox) {
  EXPECT_FALSE(PeriodicCell::of(glm::dmat3(0.0)));
  EXPECT_FALSE(PeriodicCell::of(glm::dmat3(glm::dvec3(30, 0, 0), glm::dvec3(0, 30, 0), glm::dvec3(30, 30, 0))));
  EXPECT_FALSE(PeriodicCell::of(glm::dmat3(std::nan(""))));
}

TEST(Superpose, FindsTheMotion) {
  std::vector<glm::dvec3> reference(40), moved;
  for (auto& x : reference) x = point(20);
  std::vector<std::uint32_t> atoms{3, 5, 7, 20, 21, 22, 30};
  for (int round = 0; round < 100; ++round) {
    const glm::dmat3 turn = rotation();
    const glm::dvec3 shift = point(100);
    moved.clear();
    for (const auto& x : reference) moved.push_back(turn * x + shift);
    const RigidMotion motion = superposition(reference, moved, atoms);
    EXPECT_NEAR(glm::determinant(motion.rotation), 1.0, 1e-12);
    for (std::size_t n = 0; n < moved.size(); ++n) EXPECT_LT(glm::distance(motion(moved[n]), reference[n]), 1e-5);
  }
}

TEST(Superpose, NothingFitsBetter) {
  std::vector<glm::dvec3> a(12), b(12);
  std::vector<std::uint32_t> atoms;
  for (std::uint32_t n = 0; n < a.size(); ++n) {
    a[n] = point(10);
    b[n] = a[n] + point(3);
    atoms.push_back(n);
  }
  const auto misfit = [&](const RigidMotion& motion) {
    double sum = 0.0;
    for (std::size_t n = 0; n < a.size(); ++n) sum += glm::dot(motion(b[n]) - a[n], motion(b[n]) - a[n]);
    return sum;
  };
  const RigidMotion best = superposition(a, b, atoms);
  for (int round = 0; round < 500; ++round) {
    RigidMotion other = best;
    other.rotation = glm::mat3_cast(glm::angleAxis(uniform(-0.2, 0.2), glm::normalize(point(1)))) * best.rotation;
    other.translation += point(0.1);
    EXPECT_GE(misfit(other), misfit(best) - 1e-6);
  }
}

/// A structure that is cut at the faces of a box, its whole form, and the box.
struct Cut {
  std::vector<Atom> atoms;
  std::vector<glm::dvec3> whole, cut;
  glm::dmat3 cell;
};

Cut cut_molecule() {
  ReadOptions options;
  options.keep_topology = true;
  Cut result;
  result.atoms = read_structure(kUbiquitin, options).topology->atoms;
  result.cell = glm::dmat3(glm::dvec3(48, 0, 0), glm::dvec3(16, 45, 0), glm::dvec3(-16, 22, 39));
  for (const Atom& atom : result.atoms) {
    result.whole.push_back(atom.position);
    glm::dvec3 fraction = glm::inverse(result.cell) * (atom.position - glm::dvec3(25, 20, 10));
    fraction -= glm::floor(fraction);
    result.cut.push_back(result.cell * fraction);
  }
  return result;
}

std::vector<std::uint32_t> polymer_of(const std::vector<Atom>& atoms) {
  std::vector<std::uint32_t> wanted;
  for (std::uint32_t n = 0; n < atoms.size(); ++n)
    if (atoms[n].kind == AtomClass::polymer) wanted.push_back(n);
  return wanted;
}

TEST(WholeMolecules, CutProteinComesTogether) {
  const Cut molecule = cut_molecule();
  const auto cell = PeriodicCell::of(molecule.cell);
  const auto wanted = polymer_of(molecule.atoms);
  for (const bool guess : {false, true}) {
    const auto bonds =
        guess ? guessed_bonds(molecule.atoms, molecule.cut, cell) : template_bonds(molecule.atoms, molecule.cut, cell);
    const WholeMolecules whole(molecule.atoms, bonds, wanted, "file");
    std::vector<glm::dvec3> positions = molecule.cut;
    whole.apply(molecule.cell, positions, "file: frame 0");
    const glm::dvec3 shift = molecule.whole[wanted[0]] - positions[wanted[0]];
    for (const std::uint32_t a : wanted) EXPECT_LT(glm::distance(positions[a] + shift, molecule.whole[a]), 1e-9);
  }
}

TEST(WholeMolecules, TemplatesAreTheBondsOfDistances) {
  const Cut molecule = cut_molecule();
  auto named = template_bonds(molecule.atoms, molecule.whole, {}),
       near = guessed_bonds(molecule.atoms, molecule.whole, {});
  for (auto* bonds : {&named, &near}) {
    for (Bond& bond : *bonds) std::ranges::sort(bond);
    std::ranges::sort(*bonds);
    std::erase_if(*bonds, [&](const Bond& bond) { return molecule.atoms[bond[0]].kind != AtomClass::polymer; });
    bonds->erase(std::unique(bonds->begin(), bonds->end()), bonds->end());
  }
  EXPECT_EQ(named, near);
  EXPECT_GT(named.size(), 600u);
}

TEST(WholeMolecules, WaterOfFourSites) {
  // TIP4P (W. L. Jorgensen et al., J. Chem. Phys. 79, 926, 1983): the hydrogens are nearer to M than to the oxygen.
  std::vector<Atom> atoms(4);
  const std::vector<glm::dvec3> positions{{0, 0, 0}, {0.586, 0.757, 0}, {0.586, -0.757, 0}, {0.15, 0, 0}};
  for (std::size_t n = 0; n < 4; ++n) {
    atoms[n].name = std::vector<std::string>{"OW", "HW1", "HW2", "MW"}[n];
    atoms[n].residue_name = "SOL";
    atoms[n].element = std::vector<std::uint8_t>{8, 1, 1, 0}[n];
  }
  EXPECT_EQ(template_bonds(atoms, positions, {}), (std::vector<Bond>{{0, 1}, {0, 2}, {0, 3}}));
}

TEST(WholeMolecules, PartnersGatherAroundTheLargest) {
  // Two rods of three and four atoms, put on opposite sides of the box.
  std::vector<Atom> atoms(7);
  for (std::uint32_t n = 0; n < 7; ++n) atoms[n].residue = n < 3 ? 0 : 1;
  const std::vector<Bond> bonds{{0, 1}, {1, 2}, {3, 4}, {4, 5}, {5, 6}};
  std::vector<glm::dvec3> x{{18, 0, 0}, {19, 0, 0}, {0, 0, 0}, {2, 1, 0}, {2, 2, 0}, {2, 3, 0}, {2, 4, 0}};
  const WholeMolecules whole(atoms, bonds, std::vector<std::uint32_t>{0, 3}, "file");
  whole.apply(glm::dmat3(20.0), x, "file");
  EXPECT_EQ(x[3], glm::dvec3(2, 1, 0));
  EXPECT_EQ(x[0], glm::dvec3(-2, 0, 0));
  EXPECT_EQ(x[2], glm::dvec3(0, 0, 0));
}

TEST(WholeMolecules, Refusals) {
  std::vector<Atom> atoms(3);  // atoms of one residue
  const auto complaint = [&](const std::vector<Bond>& bonds, const glm::dmat3& cell) -> std::string {
    std::vector<glm::dvec3> x{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
    try {
      WholeMolecules(atoms, bonds, std::vector<std::uint32_t>{0}, "file").apply(cell, x, "file: frame 4");
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(complaint({{0, 1}, {1, 2}}, glm::dmat3(3.5)), "");
  EXPECT_NE(complaint({{0, 1}}, glm::dmat3(3.5)).find("no bond is known"), std::string::npos);
  EXPECT_NE(complaint({{0, 1}, {1, 2}}, glm::dmat3(0.0)).find("without volume"), std::string::npos);
  // A chain of three in a box of three: its last atom is bonded to the next image of its first.
  EXPECT_NE(complaint({{0, 1}, {1, 2}, {2, 0}}, glm::dmat3(3.0)).find("image of their own"), std::string::npos);
}

/// A trajectory made by a formula, with one frame that cannot be read.
class MadeUp : public Trajectory {
 public:
  explicit MadeUp(std::uint64_t frames) : Trajectory("made-up", "formula") {
    atom_count_ = 5;
    frame_count_ = frames;
  }
  static glm::dvec3 at(double frame, std::size_t atom) {
    return {std::sin(0.3 * frame + double(atom)), 0.1 * frame * double(atom),
            std::cos(0.2 * frame) * double(atom * atom)};
  }
  std::uint64_t bad = ~0ull;

 private:
  void read_unchecked(std::uint64_t number, Frame& frame) override {
    frame.positions.clear();
    for (std::size_t n = 0; n < atom_count_; ++n) frame.positions.push_back(at(double(number), n));
    if (number == bad) frame.positions[2].y = std::nan("");
  }
};

TEST(PreparedFrames, MeansOverWindowsThatAreReflectedAtTheEnds) {
  MadeUp trajectory(20);
  Preparation preparation;
  preparation.smooth_half = 3;
  PreparedFrames frames(trajectory, preparation);
  Frame frame;
  for (const std::uint64_t number : {10u, 0u, 1u, 19u, 17u, 11u}) {
    frames.read(number, frame);
    for (std::size_t a = 0; a < 5; ++a) {
      const auto at = [a](int n) {
        if (n < 0) return 2.0 * MadeUp::at(0, a) - MadeUp::at(-n, a);
        if (n > 19) return 2.0 * MadeUp::at(19, a) - MadeUp::at(38 - n, a);
        return MadeUp::at(n, a);
      };
      glm::dvec3 mean(0.0);
      for (int n = int(number) - 3; n <= int(number) + 3; ++n) mean += at(n);
      EXPECT_LT(glm::distance(frame.positions[a], mean / 7.0), 1e-12);
      const bool is_end = number == 0 || number == 19;
      EXPECT_TRUE(!is_end || glm::distance(frame.positions[a], MadeUp::at(number, a)) < 1e-12);
    }
  }
}

/// A trajectory whose atoms tremble about a steady way.
class Trembling : public Trajectory {
 public:
  explicit Trembling() : Trajectory("trembling", "formula") {
    atom_count_ = 1;
    frame_count_ = 40;
  }

 private:
  void read_unchecked(std::uint64_t number, Frame& frame) override {
    frame.positions = {glm::dvec3(0.2 * double(number) + (number % 2 == 0 ? 0.5 : -0.5), 0.0, 0.0)};
  }
};

TEST(PreparedFrames, NothingJerksAtTheEnds) {
  Trembling trajectory;
  Preparation preparation;
  preparation.smooth_half = 4;
  PreparedFrames frames(trajectory, preparation);
  Frame before, frame;
  frames.read(0, before);
  for (std::uint64_t number = 1; number < 40; ++number) {
    frames.read(number, frame);
    // The mean moves by a step: the frame that comes in is nine frames from the one that goes out.
    EXPECT_NEAR(frame.positions[0].x - before.positions[0].x, 0.2, 2.0 * 0.5 / 9.0 + 1e-12) << number;
    before = frame;
  }
}

TEST(PreparedFrames, AWindowLongerThanTheRunIsTheRun) {
  MadeUp trajectory(3);
  Preparation preparation;
  preparation.smooth_half = 50;
  PreparedFrames frames(trajectory, preparation);
  Frame frame;
  frames.read(1, frame);
  for (std::size_t a = 0; a < 5; ++a) {
    const glm::dvec3 first = MadeUp::at(0, a), middle = MadeUp::at(1, a), last = MadeUp::at(2, a);
    // The frames are -1, 0, 1, 2, 3, with both ends reflected.
    const glm::dvec3 sum = (2.0 * first - middle) + first + middle + last + (2.0 * last - middle);
    EXPECT_LT(glm::distance(frame.positions[a], sum / 5.0), 1e-12);
  }
}

TEST(PreparedFrames, TheSameInAnyOrder) {
  MadeUp trajectory(30);
  Preparation preparation;
  preparation.smooth_half = 2;
  preparation.superposed = {0, 1, 2, 3};
  preparation.reference = 4;
  PreparedFrames forward(trajectory, preparation), backward(trajectory, preparation);
  std::vector<Frame> first(30);
  for (std::uint64_t n = 0; n < 30; ++n) forward.read(n, first[n]);
  Frame frame;
  for (std::uint64_t n = 30; n-- > 0;) {
    backward.read(n, frame);
    EXPECT_EQ(frame.positions, first[n].positions) << n;  // Both agree to the last bit.
  }
}

TEST(PreparedFrames, CenterStaysInPlace) {
  MadeUp trajectory(10);
  Preparation preparation;
  preparation.centered = {1, 3};
  preparation.reference = 2;
  PreparedFrames frames(trajectory, preparation);
  Frame reference, frame;
  frames.read(2, reference);
  frames.read(9, frame);
  const auto middle = [](const Frame& f) { return 0.5 * (f.positions[1] + f.positions[3]); };
  EXPECT_LT(glm::distance(middle(reference), middle(frame)), 1e-12);
  EXPECT_GT(glm::distance(middle(frame), 0.5 * (MadeUp::at(9, 1) + MadeUp::at(9, 3))), 0.1);
}

TEST(Trajectory, TimesHaveTheDigitsThatTheirPrecisionHolds) {
  struct Rounding : Trajectory {
    static double single(double time) { return with_fewest_digits(time, kSinglePrecision); }
    static double twice(double time) { return with_fewest_digits(time, kDoublePrecision); }
  };
  EXPECT_EQ(Rounding::single(29.999997357600556), 30.0);
  EXPECT_EQ(Rounding::single(100.00000762939453), 100.0);
  EXPECT_EQ(Rounding::single(double{0.1F}), 0.1);
  EXPECT_EQ(Rounding::single(1234567.25), 1234567.2);
  EXPECT_EQ(Rounding::single(-0.5), -0.5);
  EXPECT_EQ(Rounding::single(0.0), 0.0);
  EXPECT_EQ(Rounding::twice(3 * 0.1), 0.3);
  EXPECT_EQ(Rounding::twice(123456.789012), 123456.789012);
}

TEST(PreparedFrames, BoxIsNeededOnlyToMakeWhole) {
  MadeUp trajectory(3);
  Preparation preparation;
  preparation.whole.emplace(std::vector<Atom>(5), std::vector<Bond>{{0, 1}, {1, 2}, {2, 3}, {3, 4}},
                            std::vector<std::uint32_t>{0}, "file");
  PreparedFrames frames(trajectory, preparation);
  Frame frame;
  try {
    frames.read(1, frame);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("made-up: frame 1: has no periodic box"), std::string::npos);
  }
}

TEST(ReadAhead, InOrderWithErrorsInTheirPlace) {
  MadeUp trajectory(50);
  trajectory.bad = 7;
  std::vector<std::uint64_t> numbers{3, 7, 8, 49, 0};
  ReadAhead ahead([&](ReadFrame& read) { trajectory.read(read.number, read.frame); }, numbers, 2);
  for (const std::uint64_t number : numbers) {
    const auto read = ahead.next();
    ASSERT_TRUE(read);
    EXPECT_EQ(read->number, number);
    EXPECT_EQ(read->error != nullptr, number == 7);
    if (number == 7) {
      EXPECT_THROW(std::rethrow_exception(read->error), InputError);
    } else {
      EXPECT_EQ(read->frame.positions[1], MadeUp::at(double(number), 1));
    }
  }
  EXPECT_FALSE(ahead.next());
}

TEST(ReadAhead, NeverFartherAheadThanAsked) {
  std::atomic<int> made{0};
  std::vector<std::uint64_t> numbers(100);
  int taken = 0;
  {
    ReadAhead ahead([&](ReadFrame&) { ++made; }, numbers, 3);
    for (; taken < 10; ++taken) {
      ahead.next();
      EXPECT_LE(made, taken + 1 + 3 + 1);
    }
  }  // Reading stops although most frames were never requested.
  EXPECT_LT(made, 20);
}

}  // namespace
}  // namespace meniscus
