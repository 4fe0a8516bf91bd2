// SPDX-License-Identifier: BSD-3-Clause
// Coordinates of one moment: restart files of Amber and of NAMD, with all that may follow the positions, cut and
// damaged.
#include <bit>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/trajectory/formats/trajectory_formats.h"
#include "core/trajectory/trajectory.h"
#include "tests/support/run_program.h"
#include "tests/trajectory/byte_writer.h"
#include "tests/trajectory/samples.h"

namespace meniscus {
namespace {

using test::refusal;
using test::TemporaryFolder;

double amber_number(int place) { return 1.25 * place - 3; }

std::string rows(int count, double factor = 1.0) {
  std::string text;
  for (int n = 0; n < count; ++n)
    text += fmt::format("{:12.7f}{}", factor * amber_number(n), n % 6 == 5 || n + 1 == count ? "\n" : "");
  return text;
}

const std::string kBox = "  20.0000000  30.0000000  40.0000000  90.0000000  90.0000000  90.0000000\n";

std::string restart(int atoms, bool velocities, const std::string& box, const std::string& time = "  0.2500000E+01") {
  return fmt::format("a title\n{:5}{}\n", atoms, time) + rows(3 * atoms) + (velocities ? rows(3 * atoms, 0.1) : "") +
         box;
}

TEST(AmberRestart, PositionsBoxAndTimeOfAnyNumberOfAtoms) {
  const TemporaryFolder folder;
  for (int atoms = 1; atoms < 9; ++atoms)
    for (const bool velocities : {false, true})
      for (const std::string& box : {std::string(), kBox}) {
        const std::string path = folder.file("a", restart(atoms, velocities, box));
        EXPECT_EQ(bare_trajectory_format(path), "Amber restart");
        const auto trajectory = open_trajectory(path);
        ASSERT_EQ(trajectory->frame_count(), 1u);
        ASSERT_EQ(trajectory->atom_count(), static_cast<std::size_t>(atoms));
        Frame frame;
        trajectory->read(0, frame);
        for (int n = 0; n < 3 * atoms; ++n)
          EXPECT_EQ(frame.positions[static_cast<std::size_t>(n / 3)][n % 3], amber_number(n));
        EXPECT_EQ(frame.time, 2.5);
        const bool either = atoms == 2 && !velocities;  // Six numbers may be velocities or a box.
        EXPECT_EQ(frame.cell.has_value(), !box.empty() && !either) << atoms << velocities;
        if (!frame.cell) continue;
        EXPECT_EQ(*frame.cell, glm::dmat3(20, 0, 0, 0, 30, 0, 0, 0, 40));
      }
  const auto no_time = open_trajectory(folder.file("a.rst7", restart(3, false, "", "")));
  Frame frame;
  no_time->read(0, frame);
  EXPECT_FALSE(frame.time);
  const auto edges = open_trajectory(folder.file("a.rst7", restart(3, true, kBox.substr(0, 36) + "\n")));
  ASSERT_EQ(edges->warnings().size(), 1u);
  edges->read(0, frame);
  EXPECT_FALSE(frame.cell);
}

TEST(AmberRestart, CutAndDamagedFilesAreRefused) {
  const TemporaryFolder folder;
  const std::string whole = restart(5, true, kBox);
  const std::size_t positions = restart(5, false, "").size();
  Frame all, frame;
  open_trajectory(folder.file("w.rst7", whole))->read(0, all);
  for (std::size_t length = restart(1, false, "").size(); length < whole.size(); ++length) {
    const std::string said = refusal([&] {
      open_trajectory(folder.file("a.rst7", whole.substr(0, length)))->read(0, frame);
      EXPECT_EQ(frame.positions, all.positions) << length;
    });
    EXPECT_TRUE(length + 1 >= positions || said != "no error") << length;
    if (length == positions + 42 ||
        length == whole.size() - 5) {  // cuts within a number of the velocities or of the box
      EXPECT_NE(said.find("is the file cut short?"), std::string::npos) << said;
    }
  }
  std::string starred = whole;
  starred.replace(starred.find("  -1.7500000"), 12, "************");
  EXPECT_NE(refusal([&] { open_trajectory(folder.file("a.rst7", starred)); }).find("a.rst7:3: coordinate y is '******"),
            std::string::npos);
  EXPECT_NE(refusal([&] { open_trajectory(folder.file("a.rst7", "title\nmany\n")); }).find("a.rst7:2: should have"),
            std::string::npos);
}

std::string namd(std::endian order, std::int32_t atoms, int numbers) {
  test::ByteWriter bytes(order);
  bytes.put(atoms);
  for (int n = 0; n < numbers; ++n) bytes.put(amber_number(n));
  return bytes.bytes();
}

TEST(NamdCoordinates, BothByteOrders) {
  const TemporaryFolder folder;
  for (const std::endian order : {std::endian::little, std::endian::big})
    for (const int atoms : {1, 7, 300}) {
      const std::string path = folder.file("a", namd(order, atoms, 3 * atoms));
      EXPECT_EQ(bare_trajectory_format(path), "NAMD coordinates");
      const auto trajectory = open_trajectory(path);
      Frame frame;
      trajectory->read(0, frame);
      ASSERT_EQ(frame.positions.size(), static_cast<std::size_t>(atoms));
      for (int n = 0; n < 3 * atoms; ++n)
        EXPECT_EQ(frame.positions[static_cast<std::size_t>(n / 3)][n % 3], amber_number(n));
      EXPECT_FALSE(frame.cell || frame.time);
    }
}

TEST(NamdCoordinates, OtherFilesOfTheName) {
  const TemporaryFolder folder;
  const auto cut = [&](int atoms) {
    Frame frame;
    open_trajectory(folder.file("a.coor", namd(std::endian::little, atoms, 3 * atoms - 1)))->read(0, frame);
  };
  EXPECT_NE(refusal([&] { cut(3); }).find("is not a coordinate file of NAMD"), std::string::npos);
  EXPECT_NE(refusal([&] { cut(300); }).find("it ends at byte 7,196, but 7,200 bytes at byte 4 are needed"),
            std::string::npos);
  EXPECT_NE(refusal([&] {
              open_trajectory(folder.file("a.vel", namd(std::endian::little, 3, 9)));
            }).find("holds velocities by its name"),
            std::string::npos);
  const std::string line = "ATOM      1  C   ALA A   1       1.500   2.000   3.000  1.00  0.00           C\n";
  const auto text = open_trajectory(folder.file("b.coor", line + "END\n"));
  EXPECT_EQ(text->format(), "models of PDB");
  Frame frame;
  text->read(0, frame);
  EXPECT_EQ(frame.positions.front().x, 1.5);
}

}  // namespace
}  // namespace meniscus
