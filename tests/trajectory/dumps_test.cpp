// SPDX-License-Identifier: BSD-3-Clause
// Trajectories as text without atoms: mdcrd of Amber and dumps of LAMMPS, cut, damaged and of other molecules.
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/trajectory/formats/trajectory_formats.h"
#include "tests/support/run_program.h"
#include "tests/trajectory/samples.h"
#include "core/trajectory/trajectory.h"

namespace meniscus {
namespace {

using test::refusal;
using test::TemporaryFolder;

std::string with_returns(const std::string& text) {
  std::string result;
  for (const char letter : text) result += letter == '\n' ? std::string("\r\n") : std::string(1, letter);
  return result;
}

void expect_words(const std::string& said, const std::string& words) {
  EXPECT_NE(said.find(words), std::string::npos) << said;
}

double mdcrd_number(int frame, int place) { return frame + 1.25 * place * (place % 2 == 0 ? 1 : -1); }

std::string mdcrd(int atoms, int frames, const std::string& box) {
  std::string text = "a title\n";
  for (int frame = 0; frame < frames; ++frame) {
    for (int n = 0; n < 3 * atoms; ++n) {
      text += fmt::format("{:8.3f}", mdcrd_number(frame, n));
      if (n % 10 == 9 || n + 1 == 3 * atoms) text += '\n';
    }
    text += box;
  }
  return text;
}

std::unique_ptr<Trajectory> open_mdcrd(const std::string& path, std::size_t atoms) {
  return open_trajectory(path, {.index_folder = {}, .atoms = [atoms] { return atoms; }});
}

TEST(Mdcrd, FramesOfEveryLayout) {
  const TemporaryFolder folder;
  for (const int atoms : {1, 2, 4, 10, 20}) {
    for (const std::string& box : {std::string(), std::string("  20.000  30.000  40.000\n")}) {
      if (atoms == 1 && !box.empty()) continue;  // A box is as long as an atom.
      const std::string text = mdcrd(atoms, 3, box);
      for (const std::string& written : {text, with_returns(text), text + "\n \n", text.substr(0, text.size() - 1)}) {
        const auto trajectory = open_mdcrd(folder.file("a.mdcrd", written), static_cast<std::size_t>(atoms));
        ASSERT_EQ(trajectory->frame_count(), 3u) << atoms << box;
        EXPECT_EQ(trajectory->cut_short(), "");
        EXPECT_TRUE(trajectory->warnings().empty());
        Frame frame;
        for (const int number : {2, 0, 1}) {
          trajectory->read(static_cast<std::uint64_t>(number), frame);
          for (int n = 0; n < 3 * atoms; ++n)
            EXPECT_DOUBLE_EQ(frame.positions[static_cast<std::size_t>(n / 3)][n % 3], mdcrd_number(number, n));
          EXPECT_EQ(frame.cell.has_value(), !box.empty());
          if (frame.cell) {
            EXPECT_EQ(*frame.cell, glm::dmat3(20, 0, 0, 0, 30, 0, 0, 0, 40));
          }
          EXPECT_FALSE(frame.time || frame.step);
        }
      }
    }
  }
  const auto cube = open_mdcrd(folder.file("c.mdcrd", mdcrd(4, 2, "  20.000  20.000  20.000\n")), 4);
  ASSERT_EQ(cube->warnings().size(), 1u);
  expect_words(cube->warnings().front().text, "a truncated octahedron needs NetCDF");
}

TEST(Mdcrd, CutFilesGiveTheirWholeFrames) {
  const TemporaryFolder folder;
  const std::string whole = mdcrd(4, 2, "  20.000  30.000  40.000\n"), one = mdcrd(4, 1, "  20.000  30.000  40.000\n");
  for (std::size_t length = one.size() + 2; length + 1 < whole.size(); ++length) {
    const auto trajectory = open_mdcrd(folder.file("a.mdcrd", whole.substr(0, length)), 4);
    EXPECT_EQ(trajectory->frame_count(), 1u) << length;
    EXPECT_EQ(trajectory->cut_short(), "the file ends within frame 1; its 1 whole frame is used") << length;
  }
  expect_words(refusal([&] { open_mdcrd(folder.file("a.mdcrd", one.substr(0, 60)), 4); }),
               "a.mdcrd:2: the file ends within its first frame, which should have 4 atoms as FILE has");
}

TEST(Mdcrd, OtherMoleculesAndDamageAreNamed) {
  const TemporaryFolder folder;
  const std::string text = mdcrd(12, 2, "");
  expect_words(refusal([&] { open_trajectory(folder.file("a.mdcrd", text)); }), "does not say how many atoms");
  expect_words(refusal([&] { open_mdcrd(folder.file("a.mdcrd", text), 10); }), "a frame of 10 atoms has here");
  expect_words(refusal([&] { open_mdcrd(folder.file("a.mdcrd", text), 11); }), "a frame of 11 atoms has here");
  std::string starred = text;
  starred.replace(starred.find("   3.500", 100), 8, "********");
  const auto trajectory = open_mdcrd(folder.file("b.mdcrd", starred), 12);
  Frame frame;
  trajectory->read(0, frame);
  expect_words(refusal([&] { trajectory->read(1, frame); }), "b.mdcrd:6: ******** marks a coordinate");
}

std::string lammps(const std::string& columns, const std::string& first, const std::string& second,
                   const std::string& bounds = "ITEM: BOX BOUNDS pp pp pp\n0 10\n1 11\n-2 8\n") {
  const auto frame = [&](int step, const std::string& rows) {
    return fmt::format("ITEM: TIMESTEP\n{}\nITEM: NUMBER OF ATOMS\n3\n{}ITEM: ATOMS {}\n{}", step, bounds, columns,
                       rows);
  };
  return frame(0, first) + frame(5, second);
}

const std::string kFirst = "7 1 2 3\n2 4 5 6\n9 0.5 0.25 1\n", kSecond = "2 4 5 7\n9 1.5 0.25 1\n7 1 2 4\n";

TEST(LammpsDump, AtomsGoByTheirNumbers) {
  const TemporaryFolder folder;
  const std::string text = lammps("id x y z", kFirst, kSecond);
  for (const std::string& written : {text, with_returns(text), text + "\n\n"}) {
    const auto trajectory = open_trajectory(folder.file("a.lammpstrj", written));
    ASSERT_EQ(trajectory->frame_count(), 2u);
    EXPECT_EQ(trajectory->cut_short(), "");
    Frame frame;
    trajectory->read(1, frame);
    EXPECT_EQ(frame.positions, (std::vector<glm::dvec3>{{4, 5, 7}, {1, 2, 4}, {1.5, 0.25, 1}}));
    EXPECT_EQ(frame.step, 5);
    EXPECT_EQ(frame.cell, glm::dmat3(10.0));
    trajectory->read(0, frame);
    EXPECT_EQ(frame.positions, (std::vector<glm::dvec3>{{4, 5, 6}, {1, 2, 3}, {0.5, 0.25, 1}}));
  }
  Frame frame;
  open_trajectory(folder.file("s.dump", lammps("id xs ys zs", kFirst, kSecond)))->read(0, frame);
  EXPECT_EQ(frame.positions[2], glm::dvec3(5, 3.5, 8));
  const std::string open = "ITEM: BOX BOUNDS pp ss ff\n0 10\n1 11\n-2 8\n";
  open_trajectory(folder.file("o.dump", lammps("id x y z", kFirst, kSecond, open)))->read(0, frame);
  EXPECT_FALSE(frame.cell);
}

TEST(LammpsDump, CutFilesGiveTheirWholeFrames) {
  const TemporaryFolder folder;
  const std::string whole = lammps("id x y z", kFirst, kSecond);
  const std::size_t one = whole.find("ITEM: TIMESTEP", 10);
  // A last line with all columns would be an atom, even if its last number is cut.
  for (std::size_t length = one + 1; length < whole.size() - 1; ++length) {
    const auto trajectory = open_trajectory(folder.file("a.lammpstrj", whole.substr(0, length)));
    EXPECT_EQ(trajectory->frame_count(), 1u) << length;
    EXPECT_EQ(trajectory->cut_short(), "the file ends within frame 1; its 1 whole frame is used") << length;
  }
  for (const std::size_t size : {one, whole.size()}) {
    const auto trajectory = open_trajectory(folder.file("a.lammpstrj", whole.substr(0, size - 1)));
    EXPECT_EQ(trajectory->frame_count(), size == one ? 1u : 2u);
    EXPECT_EQ(trajectory->cut_short(), "");
    ASSERT_EQ(trajectory->warnings().size(), 2u);  // The other warning says that units are missing.
    expect_words(trajectory->warnings().back().text, "its last line has no line end; if the file was cut there");
    Frame frame, same;
    trajectory->read(trajectory->frame_count() - 1, frame);
    open_trajectory(folder.file("w.lammpstrj", whole))->read(trajectory->frame_count() - 1, same);
    EXPECT_EQ(frame.positions, same.positions);
  }
  expect_words(refusal([&] { open_trajectory(folder.file("a.lammpstrj", whole.substr(0, one - 3))); }),
               "holds no complete frame");
}

TEST(LammpsDump, AtomsWithoutNumbersAreTakenInOrderIfTrusted) {
  const TemporaryFolder folder;
  const std::string path = folder.file("a.lammpstrj", lammps("type x y z", kFirst, kSecond));
  const auto trajectory = open_trajectory(path, {{}, {}, true});
  Frame frame;
  trajectory->read(0, frame);
  EXPECT_EQ(frame.positions, (std::vector<glm::dvec3>{{1, 2, 3}, {4, 5, 6}, {0.5, 0.25, 1}}));
  trajectory->read(1, frame);
  EXPECT_EQ(frame.positions[0], glm::dvec3(4, 5, 7));
  EXPECT_EQ(open_trajectory(folder.file("b.dump", lammps("id x y z", kFirst, kSecond)), {{}, {}, true})->atom_count(),
            3u);
}

TEST(LammpsDump, WhatIsNoTrajectoryIsNamed) {
  const TemporaryFolder folder;
  const auto said = [&](const std::string& text) {
    return refusal([&] {
      const auto trajectory = open_trajectory(folder.file("a.lammpstrj", text));
      Frame frame;
      trajectory->read(1, frame);
    });
  };
  expect_words(said(lammps("type x y z", kFirst, kSecond)),
               "has no column 'id', so its atoms cannot be identified; add id to dump custom, or --trust-atom-order if "
               "they are in");
  expect_words(said(lammps("id vx vy vz", kFirst, kSecond)), "neither xu yu zu, xsu ysu zsu, x y z nor xs ys zs");
  expect_words(said(lammps("id x y z", kFirst, "2 4 5 7\n8 1.5 0.25 1\n7 1 2 4\n")),
               "has the atom 8 where the first frame has 9: a dump of a changing group is not a trajectory");
  expect_words(said(lammps("id x y z", kFirst, "2 4 5 7\n2 1.5 0.25 1\n7 1 2 4\n")), "has the atom 2 twice");
  expect_words(said(lammps("id x y z", kFirst, "2 4 5 7\n9 1.5 nan 1\n7 1 2 4\n")), "has the atom '9 1.5 nan 1'");
  expect_words(said("ITEM: UNITS\nlj\n" + lammps("id x y z", kFirst, kSecond)), "its units are 'lj'");
  expect_words(said(lammps("id x y z", kFirst, kSecond, "ITEM: BOX BOUNDS abc origin\n1 0 0 0\n0 1 0 0\n0 0 1 0\n")),
               "general triclinic box");
  expect_words(said(lammps("id xs ys zs", kFirst, kSecond, "")), "has positions as fractions of a box, but no box");
  expect_words(said("ITEM: TIMESTEP\n0\nITEM: NUMBER OF ENTRIES\n3\nITEM: ENTRIES c_1\n1\n2\n3\n"),
               "has 'NUMBER OF ENTRIES', which is not part of a dump of atoms");
  EXPECT_EQ(open_trajectory(folder.file("u.dump", lammps("id x y z", kFirst, kSecond)))->warnings().size(), 1u);
}

TEST(Tpr, IsRefusedWithTheCommandThatConvertsIt) {
  const TemporaryFolder folder;
  using std::string_literals::operator""s;
  const std::string start = "\0\0\0\x1f\0\0\0\x1eVERSION 2022.5-Debian_2022.5_2\0\0\0\0\0\4\0\0\0\x7f"s;
  const std::string path = folder.file("run.tpr", start + std::string(100, '\0'));
  expect_words(refusal([&] { open_trajectory(path); }), "gmx editconf -f run.tpr -conect -o run.pdb");
  const test::ProgramResult result = test::run_program(test::meniscus_program(), {"surface", path});
  EXPECT_EQ(result.exit_code, 3);
  expect_words(result.err, "is a run input file of GROMACS (TPR)");
}

}  // namespace
}  // namespace meniscus
