// SPDX-License-Identifier: BSD-3-Clause
// Models of text files that are found by offset equal those of the formats' readers, with boxes and times.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/structure/formats/structure_formats.h"
#include "core/trajectory/formats/trajectory_formats.h"
#include "tests/support/run_program.h"
#include "tests/trajectory/samples.h"
#include "core/trajectory/trajectory.h"

namespace meniscus {
namespace {

using test::refusal;
using test::TemporaryFolder;

std::string atom(double x) {
  return fmt::format("ATOM      1  N   THR A   1    {:8.3f}  14.0991113.625  1.00 13.79           N\n", x);
}

/// Opens the file and compares each frame with the model from the format's own reader.
std::unique_ptr<Trajectory> open_and_compare(const std::string& path, std::uint64_t frames) {
  auto trajectory = open_trajectory(path);
  EXPECT_EQ(trajectory->frame_count(), frames);
  const TextFile file = read_text_file(path);
  for (std::uint64_t n = trajectory->frame_count(); n-- > 0;) {
    Frame frame;
    trajectory->read(n, frame);
    const FileContents model = choose_reader(file).read(file, {static_cast<std::int32_t>(n + 1), false});
    EXPECT_EQ(frame.positions.size(), model.atoms.size());
    for (std::size_t k = 0; k < std::min(frame.positions.size(), model.atoms.size()); ++k)
      EXPECT_EQ(frame.positions[k], model.atoms[k].position);
  }
  return trajectory;
}

TEST(TextFrames, ModelsOfPdbInEveryForm) {
  const TemporaryFolder folder;
  const auto model = [](int number, const std::string& atoms) {
    return fmt::format("MODEL {:8}\n{}TER\nENDMDL\n", number, atoms);
  };
  const std::string three = model(1, atom(1) + atom(2)) + model(2, atom(3) + atom(4)) + model(7, atom(5) + atom(6));
  const std::string ended = atom(1) + atom(2) + "END\n" + atom(3) + atom(4) + "TER\nEND\nREMARK\n" + atom(5) + atom(6);
  EXPECT_EQ(open_and_compare(folder.file("a.pdb", "HEADER\n" + three + "END\n"), 3)->format(), "models of PDB");
  open_and_compare(folder.file("b.pdb", ended + "END\n"), 3);
  open_and_compare(folder.file("c.pdb", ended), 3);
  open_and_compare(folder.file("d.pdb", "MODEL        1\n" + atom(1) + "END\nMODEL        2\n" + atom(2)), 2);
  open_and_compare(folder.file("g.pdb", "MODEL        1\n" + atom(1) + "END\n" + atom(3) + "ENDMDL\nMODEL        2\n" +
                                            atom(2) + atom(4) + "ENDMDL\n"),
                   2);
  open_and_compare(folder.file("e.pdb", test::gzipped(three)), 3);
  std::string returns = three;
  for (std::size_t n = 0; (n = returns.find('\n', n)) != std::string::npos; n += 2) returns.insert(n, 1, '\r');
  open_and_compare(folder.file("f.pdb", returns), 3);
  open_and_compare("/usr/share/pymol/data/demo/1tii.pdb", 1);
}

TEST(TextFrames, BoxesOfPdb) {
  const TemporaryFolder folder;
  const auto box = [](double edge) {
    return fmt::format("CRYST1{0:9.3f}{0:9.3f}{0:9.3f}  90.00  90.00  90.00 P 1\n", edge);
  };
  const auto trajectory = open_trajectory(
      folder.file("a.pdb", box(20) + "MODEL 1\n" + atom(1) + "ENDMDL\nMODEL 2\n" + box(30) + atom(1) + "ENDMDL\n" +
                               "MODEL 3\n" + atom(1) + "ENDMDL\n" + box(1) + "MODEL 4\n" + atom(1) + "ENDMDL\n"));
  Frame frame;
  for (const std::uint64_t number : {2U, 0U, 1U}) {
    trajectory->read(number, frame);
    EXPECT_EQ(frame.cell, glm::dmat3(number == 0 ? 20.0 : 30.0));
  }
  trajectory->read(3, frame);
  EXPECT_FALSE(frame.cell);
}

TEST(TextFrames, GroWithBoxesAndTimes) {
  const TemporaryFolder folder;
  const auto frame_text = [](const std::string& title, double x, const std::string& box) {
    return fmt::format("{}\n    1\n    1SOL     OW    1{:8.3f}   1.624   1.679\n{}\n", title, x, box);
  };
  const auto trajectory =
      open_and_compare(folder.file("a.gro", frame_text("Water t=   1.50000 step= 30", 1, " 3.0 4.0 5.0") +
                                                frame_text("left= 3", 2, " 3 4 5 0 0 0.5 0 -1 0.25") +
                                                frame_text("", 3, " 0 0 0") + "\n\n"),
                       3);
  Frame frame;
  trajectory->read(1, frame);
  EXPECT_FALSE(frame.time || frame.step);
  EXPECT_EQ(frame.cell, glm::dmat3(30, 0, 0, 5, 40, 0, -10, 2.5, 50));
  trajectory->read(0, frame);
  EXPECT_EQ(frame.time, 1.5);
  EXPECT_EQ(frame.step, 30);
  EXPECT_EQ(frame.cell, glm::dmat3(30, 0, 0, 0, 40, 0, 0, 0, 50));
  trajectory->read(2, frame);
  EXPECT_FALSE(frame.cell);
}

TEST(TextFrames, XyzWithLattices) {
  const TemporaryFolder folder;
  const std::string first = "2\nLattice=\"9 0 0 1 8 0 2 3 7\" Properties=species:S:1:pos:R:3\nC 1 2 3\nO 4 5 6\n";
  const auto trajectory = open_and_compare(folder.file("a.xyz", first + "\n2\n\nC 7 8 9\nO 1 1 1\n\n\n"), 2);
  Frame frame;
  trajectory->read(1, frame);
  EXPECT_FALSE(frame.cell);
  trajectory->read(0, frame);
  EXPECT_EQ(frame.cell, glm::dmat3(9, 0, 0, 1, 8, 0, 2, 3, 7));
  open_and_compare(folder.file("b.xyz", "2\n\nC 7 8 9\nO 1 1 1\n2\n\nC 7 8 9\nO 1 1 1"), 2);
}

void expect_cut(const std::string& name, const std::string& frame) {
  const TemporaryFolder folder;
  const std::string bytes = frame + frame;
  for (std::size_t length = frame.size() + 2; length + 2 < bytes.size(); ++length) {
    const auto trajectory = open_trajectory(folder.file(name, bytes.substr(0, length)));
    EXPECT_EQ(trajectory->frame_count(), 1U) << length;
    EXPECT_EQ(trajectory->cut_short(), "the file ends within frame 1; its 1 whole frame is used") << length;
  }
}

TEST(TextFrames, CutFilesGiveTheirWholeFrames) {
  expect_cut("a.xyz", "2\n\nC 1.25 2.5 3.5\nO 4.25 5.5 6.5\n");
  expect_cut("a.gro", "x\n    1\n    1SOL     OW    1   0.126   1.624   1.679\n   3.00000   4.00000   5.00000\n");
  const TemporaryFolder folder;
  const std::string model = "MODEL        1\n" + atom(1) + atom(2) + "ENDMDL\n";
  for (std::size_t length = 20; length < 15 + atom(1).size() + 54; ++length) {
    const auto trajectory = open_trajectory(folder.file("a.pdb", model + model.substr(0, length)));
    EXPECT_EQ(trajectory->frame_count(), 1U) << length;
    EXPECT_FALSE(trajectory->cut_short().empty()) << length;
  }
}

TEST(TextFrames, DamageIsNamedWithFrameAndLine) {
  const TemporaryFolder folder;
  const auto trajectory = open_trajectory(folder.file("a.xyz", "1\n\nC 1 2 3\n1\n\nC 1 x 3\nmore\n"));
  EXPECT_EQ(trajectory->frame_count(), 3U);
  Frame frame;
  trajectory->read(0, frame);
  EXPECT_NE(refusal([&] { trajectory->read(1, frame); }).find("a.xyz, frame 1:3: coordinate y is 'x'"),
            std::string::npos);
  EXPECT_NE(refusal([&] { trajectory->read(2, frame); }).find("a.xyz, frame 2:1: 'more' should be the number of atoms"),
            std::string::npos);
  EXPECT_NE(refusal([&] { open_trajectory(folder.file("b.xyz", "2\n\nC 1 2 3\n")); }).find("the count says 2 atoms"),
            std::string::npos);
  const auto other = open_trajectory(folder.file("c.xyz", "1\n\nC 1 2 3\n2\n\nC 1 2 3\nC 1 2 4\n"));
  EXPECT_NE(refusal([&] { other->read(1, frame); }).find("frame 1 holds 2 atoms, the first frame 1"),
            std::string::npos);
  EXPECT_NE(refusal([&] {
              open_trajectory(folder.file("a.psf", "PSF\n\n 1 !NATOM\n1 A 1 ALA N N 0 14 0\n\n 0 !NBOND\n"));
            }).find("it is not a trajectory"),
            std::string::npos);
}

}  // namespace
}  // namespace meniscus
