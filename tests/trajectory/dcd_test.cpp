// SPDX-License-Identifier: BSD-3-Clause
// DCD: both byte orders, markers of both sizes, fixed atoms, boxes of every form, cut and damaged files.
#include <cmath>
#include <limits>
#include <algorithm>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "core/trajectory/formats/trajectory_formats.h"
#include "tests/support/run_program.h"
#include "tests/trajectory/byte_writer.h"
#include "tests/trajectory/samples.h"
#include "core/trajectory/trajectory.h"

namespace meniscus {
namespace {

using test::ByteWriter;
using test::coordinate;
using test::dcd;
using test::DcdSample;
using test::refusal;
using test::TemporaryFolder;

std::unique_ptr<Trajectory> open_bytes(const TemporaryFolder& folder, const std::string& bytes) {
  return open_trajectory(folder.file("a.dcd", bytes));
}

void expect_frame(const Frame& frame, const DcdSample& sample, std::uint32_t number) {
  ASSERT_EQ(frame.positions.size(), sample.atoms);
  for (std::uint32_t atom = 0; atom < sample.atoms; ++atom) {
    const bool moves =
        sample.free.empty() || std::find(sample.free.begin(), sample.free.end(), atom + 1) != sample.free.end();
    for (int axis = 0; axis < 3; ++axis)
      EXPECT_EQ(frame.positions[atom][axis], coordinate(moves ? number : 0, atom, axis)) << number << ' ' << atom;
  }
}

TEST(Dcd, EveryLayoutReadsTheSameInAnyOrder) {
  const TemporaryFolder folder;
  for (const std::endian order : {std::endian::little, std::endian::big}) {
    for (const int marker : {4, 8}) {
      for (const std::int32_t version : {0, 24, 36}) {
        for (const bool fixed : {false, true}) {
          DcdSample sample{.order = order, .marker = marker, .version = version};
          if (fixed) sample.free = {2, 4};
          if (version != 0) sample.cell = {10.0, 90.0, 20.0, 90.0, 90.0, 30.0};
          sample.fourth_axis = version == 36;
          const auto trajectory = open_bytes(folder, dcd(sample));
          EXPECT_EQ(trajectory->format(), "DCD");
          ASSERT_EQ(trajectory->frame_count(), 3U);
          EXPECT_EQ(trajectory->atom_count(), 4U);
          EXPECT_TRUE(trajectory->warnings().empty() && trajectory->cut_short().empty());
          Frame frame;
          for (const std::uint32_t number : {2U, 0U, 1U, 2U}) {
            trajectory->read(number, frame);
            expect_frame(frame, sample, number);
            EXPECT_EQ(frame.step, 100 + 10 * number);
            EXPECT_NEAR(frame.time.value(), (100.0 + 10.0 * number) * 0.5 * 4.888821e-2, 1e-6);
            if (version != 0) {
              EXPECT_EQ(frame.cell, glm::dmat3(10, 0, 0, 0, 20, 0, 0, 0, 30));
            }
            EXPECT_EQ(frame.cell.has_value(), version != 0);
          }
        }
      }
    }
  }
}

// A step of 1 fs or 0.4 ps as a float, by the unit's constants of several programs, is exactly that time.
TEST(Dcd, TimesAreThoseThatPeopleKnow) {
  const TemporaryFolder folder;
  for (const double unit : {4.888821e-2, 4.88882129e-2, 4.8888211e-2}) {
    for (const double step : {0.001, 0.4}) {
      const auto trajectory = open_bytes(folder, dcd({.time_step = step / unit}));
      Frame frame;
      for (const std::uint64_t number : {0, 1, 2}) {
        trajectory->read(number, frame);
        EXPECT_EQ(frame.time, (100.0 + 10.0 * static_cast<double>(number)) * step) << unit;
      }
    }
  }
}

TEST(Dcd, BoxesInEveryForm) {
  const TemporaryFolder folder;
  const auto cell_of = [&](std::vector<double> numbers, std::int32_t version) {
    const auto trajectory = open_bytes(folder, dcd({.version = version, .cell = std::move(numbers)}));
    Frame frame;
    trajectory->read(1, frame);
    return frame.cell;
  };
  // The cells have edges 10, 20, 30 and angles alpha 90, beta 60, gamma 120, as degrees and as cosines.
  for (const auto& cell : {cell_of({10, 120, 20, 60, 90, 30}, 24), cell_of({10, -0.5, 20, 0.5, 0.0, 30}, 24)}) {
    ASSERT_TRUE(cell);
    EXPECT_NEAR(glm::length((*cell)[1]), 20.0, 1e-12);
    EXPECT_NEAR(glm::length((*cell)[2]), 30.0, 1e-12);
    EXPECT_NEAR(glm::dot((*cell)[0], (*cell)[1]), 10.0 * 20.0 * -0.5, 1e-10);
    EXPECT_NEAR(glm::dot((*cell)[0], (*cell)[2]), 10.0 * 30.0 * 0.5, 1e-10);
    EXPECT_NEAR(glm::dot((*cell)[1], (*cell)[2]), 0.0, 1e-10);
  }
  // CHARMM's own files hold the shape matrix, also where its entries could be cosines.
  EXPECT_EQ(cell_of({30.0, 0.5, 31.0, -0.25, 0.75, 32.0}, 36), glm::dmat3(30, .5, -.25, .5, 31, .75, -.25, .75, 32));
  EXPECT_EQ(cell_of({30.0, -8.0, 31.0, 9.0, 7.0, 32.0}, 24), glm::dmat3(30, -8, 9, -8, 31, 7, 9, 7, 32));
  for (const std::vector<double>& none :
       {std::vector<double>{0, 0, 0, 0, 0, 0}, {1, 90, 1, 90, 90, 1}, {1, 0, 1, 0, 0, 1}}) {
    EXPECT_FALSE(cell_of(none, 24));
    EXPECT_TRUE(open_bytes(folder, dcd({.cell = none}))->warnings().empty());
  }
  EXPECT_FALSE(cell_of({10, 170, 20, 10, 10, 30}, 24));
  EXPECT_EQ(open_bytes(folder, dcd({.cell = {10, 170, 20, 10, 10, 30}}))->warnings().size(), 1U);
}

TEST(Dcd, SizeOfTheFileCountsFrames) {
  const TemporaryFolder folder;
  const auto trajectory = open_bytes(folder, dcd({.promised = 500}));
  EXPECT_EQ(trajectory->frame_count(), 3U);
  ASSERT_EQ(trajectory->warnings().size(), 1U);
  EXPECT_EQ(trajectory->warnings()[0].text, "its header says 500 frames, but it holds 3; these are used");
}

TEST(Dcd, CutFilesGiveTheirWholeFrames) {
  const TemporaryFolder folder;
  const std::string whole = dcd({});
  const std::size_t frame = 3 * (4 * 4 + 8);
  for (std::size_t cut = 1; cut < whole.size(); ++cut) {
    const std::string bytes = whole.substr(0, whole.size() - cut);
    if (cut > 2 * frame) {
      EXPECT_NE(refusal([&] { open_bytes(folder, bytes); }), "no error") << cut;
      continue;
    }
    const auto trajectory = open_bytes(folder, bytes);
    EXPECT_EQ(trajectory->frame_count(), 3 - (cut + frame - 1) / frame);
    EXPECT_EQ(trajectory->cut_short().empty(), cut % frame == 0) << cut;
    if (cut < frame) {
      EXPECT_EQ(trajectory->cut_short(), "the file ends within frame 2; its 2 whole frames are used");
    }
  }
}

TEST(Dcd, DamageIsNamedWithFrameAndPlace) {
  const TemporaryFolder folder;
  std::string bytes = dcd({});
  const std::size_t frame = 3 * (4 * 4 + 8), second = bytes.size() - 2 * frame;
  bytes[second] = 17;
  const auto trajectory = open_bytes(folder, bytes);
  Frame read;
  trajectory->read(0, read);
  trajectory->read(2, read);
  EXPECT_NE(refusal([&] {
              trajectory->read(1, read);
            }).find("is damaged: the record with x of frame 1 should have 16 bytes, but a marker says 17 (byte 268)"),
            std::string::npos);
  EXPECT_NE(refusal([&] { trajectory->read(3, read); }).find("has no frame 3; it holds 3 frames"), std::string::npos);

  const auto with_count = [](std::uint32_t atoms) {
    std::string damaged = dcd({});
    ByteWriter count(std::endian::little);
    damaged.replace(188, 4, count.put(atoms).bytes());
    return damaged;
  };
  for (const std::uint32_t atoms : {0U, 0xffffffffU, 0x80000000U}) {
    EXPECT_NE(refusal([&] { open_bytes(folder, with_count(atoms)); }).find("its header says"), std::string::npos);
  }
  EXPECT_NE(refusal([&] { open_bytes(folder, with_count(0x7fffffffU)); }).find("not one frame of them fits"),
            std::string::npos);
}

TEST(Dcd, MoreTitlesThanTheirMarkersSayAreRead) {
  // Versions of MDAnalysis wrote three titles between markers of two.
  const TemporaryFolder folder;
  for (const std::endian order : {std::endian::little, std::endian::big}) {
    const std::string plain = dcd({.order = order});
    const auto number = [&](std::uint32_t n) { return ByteWriter(order).put(n).bytes(); };
    const std::string titles = number(164) + number(3) + std::string(240, ' ') + number(164);
    const std::size_t begin = 92, end = plain.find(number(4) + number(4) + number(4), begin);
    ASSERT_NE(end, std::string::npos);
    const auto trajectory = open_bytes(folder, plain.substr(0, begin) + titles + plain.substr(end));
    EXPECT_EQ(trajectory->frame_count(), 3U);
    Frame frame;
    trajectory->read(2, frame);
    EXPECT_EQ(frame.positions[1].y, double{test::coordinate(2, 1, 1)});
    const std::string four = number(164) + number(4) + std::string(240, ' ') + number(164);
    EXPECT_NE(refusal([&] {
                open_bytes(folder, plain.substr(0, begin) + four + plain.substr(end));
              }).find("the markers about its titles disagree"),
              std::string::npos);
  }
}

TEST(Dcd, CoordinatesThatAreNoneAreNamed) {
  const TemporaryFolder folder;
  for (const float wrong : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), -1e6F}) {
    std::string bytes = dcd({});
    bytes.replace(bytes.size() - 8, 4, ByteWriter(std::endian::little).put(wrong).bytes());
    const auto trajectory = open_bytes(folder, bytes);
    Frame frame;
    trajectory->read(1, frame);
    EXPECT_NE(refusal([&] { trajectory->read(2, frame); }).find("frame 2: z of atom 4 is "), std::string::npos);
  }
}

TEST(Dcd, ChangesWhileOpenAreErrors) {
  const TemporaryFolder folder;
  const std::string bytes = dcd({});
  const auto trajectory = open_bytes(folder, bytes);
  Frame frame;
  folder.file("a.dcd", bytes + bytes.substr(bytes.size() - 72));  // A simulation goes on by one frame.
  trajectory->read(2, frame);
  EXPECT_EQ(trajectory->frame_count(), 3U);
  folder.file("a.dcd", dcd({.atoms = 9, .frames = 9}));  // Another simulation writes the file again.
  EXPECT_NE(refusal([&] { trajectory->read(0, frame); }).find("was changed while it was read"), std::string::npos);
  folder.file("a.dcd", "short");
  EXPECT_NE(refusal([&] { trajectory->read(2, frame); }).find("became shorter"), std::string::npos);
}

TEST(Dcd, NameAndContentMustAgree) {
  const TemporaryFolder folder;
  EXPECT_EQ(bare_trajectory_format(folder.file("x.bin", dcd({}))), "DCD");
  EXPECT_EQ(bare_trajectory_format(folder.file("x.txt", "text")), "");
  EXPECT_EQ(open_trajectory(folder.file("x.bin", dcd({})))->format(), "DCD");
  EXPECT_NE(refusal([&] { open_bytes(folder, "ATOM  "); }).find("it does not begin with a record of 84 bytes and CORD"),
            std::string::npos);
  EXPECT_NE(refusal([&] {
              open_trajectory(folder.file("a.xtc", dcd({})));
            }).find("the name says XTC, but the content is DCD"),
            std::string::npos);
  EXPECT_NE(refusal([&] { open_trajectory(folder.file("a.XTC.gz", test::gzipped("\x01"))); }).find("unpack it first"),
            std::string::npos);
  const std::string packed = folder.file("a.mdcrd.bz2", "BZh91AY&SY" + std::string(9, '\0'));
  EXPECT_NE(refusal([&] { open_trajectory(packed); }).find("unpack it first: bzip2 -dk '" + packed), std::string::npos);
  EXPECT_NE(refusal([&] { open_trajectory(folder.file("a.nc", "\x89HDF\r\n\x1a\n")); }).find("is NetCDF-4"),
            std::string::npos);
  EXPECT_NE(refusal([&] { open_trajectory(folder.file("a", "\x89HDF\r\n\x1a\n")); }).find("cannot open it"),
            std::string::npos);
  EXPECT_NE(refusal([&] {
              open_trajectory(folder.file("a.bin", std::string(9, '\0')));
            }).find("in none of the trajectory formats that are read"),
            std::string::npos);
  EXPECT_NE(refusal([&] { open_trajectory("-"); }).find("cannot be a trajectory"), std::string::npos);
  EXPECT_NE(refusal([&] { open_bytes(folder, ""); }).find("is empty"), std::string::npos);
  EXPECT_NE(refusal([&] { open_trajectory(folder.path().string()); }).find("is a folder"), std::string::npos);
}

}  // namespace
}  // namespace meniscus
