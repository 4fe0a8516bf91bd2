// SPDX-License-Identifier: BSD-3-Clause
// XTC, TRR and Amber NetCDF: what is read from good files in any order, and what is said of cut and hostile ones.
#include <algorithm>
#include <limits>

#include <gtest/gtest.h>

#include "core/trajectory/formats/trajectory_formats.h"
#include "tests/support/run_program.h"
#include "tests/trajectory/byte_writer.h"
#include "tests/trajectory/samples.h"
#include "core/trajectory/trajectory.h"

namespace meniscus {
namespace {

using test::AmberSample;
using test::ByteWriter;
using test::refusal;
using test::TemporaryFolder;
using test::TrrSample;
using test::XtcSample;

void expect_xtc_frame(Trajectory& trajectory, const XtcSample& sample, std::uint32_t number) {
  Frame frame;
  trajectory.read(number, frame);
  ASSERT_EQ(frame.positions.size(), sample.atoms);
  for (std::uint32_t atom = 0; atom < sample.atoms; ++atom) {
    for (int axis = 0; axis < 3; ++axis) {
      const double steps = test::xtc_step(sample, number, atom, axis);
      const double expected = sample.atoms > 9 ? 10.0 * steps / sample.precision
                                               : 10.0 * double{static_cast<float>(steps) / sample.precision};
      EXPECT_EQ(frame.positions[atom][axis], expected) << number << ' ' << atom;
    }
  }
  EXPECT_EQ(frame.step, 10 * number);
  EXPECT_EQ(frame.time, 0.5 * number);
  EXPECT_EQ(frame.cell, glm::dmat3(30, 0, 0, 5, 40, 0, -10, 2.5, 50));
}

TEST(Xtc, PackedAndPlainAtomsInAnyOrder) {
  const TemporaryFolder folder;
  for (const XtcSample& sample :
       {XtcSample{}, XtcSample{.atoms = 9}, XtcSample{.atoms = 3}, XtcSample{.magic = 2023},
        XtcSample{.spread = 100000}, XtcSample{.spread = 900'000}, XtcSample{.precision = 100.0F, .spread = 9},
        XtcSample{.precision = 1e7F, .spread = 20'000'000}}) {
    const auto trajectory = open_trajectory(folder.file("a.xtc", test::xtc(sample)));
    EXPECT_EQ(trajectory->format(), "XTC");
    ASSERT_EQ(trajectory->frame_count(), sample.frames);
    for (const std::uint32_t number : {2U, 0U, 1U, 2U}) expect_xtc_frame(*trajectory, sample, number);
  }
}

/// Returns the place of the second frame in the XTC sample.
std::size_t second_frame() { return test::xtc({.frames = 1}).size(); }

/// Returns the XTC sample with a number put into the header of its second frame.
template <typename Number>
std::string hostile(std::size_t place, Number number) {
  std::string bytes = test::xtc({});
  return bytes.replace(second_frame() + place, sizeof number, ByteWriter(std::endian::big).put(number).bytes());
}

TEST(Xtc, HostileHeadersEndInErrorsWithFrameAndPlace) {
  const TemporaryFolder folder;
  const auto message = [&](const std::string& bytes) {
    return refusal([&] {
      const auto trajectory = open_trajectory(folder.file("a.xtc", bytes));
      EXPECT_EQ(trajectory->cut_short(), "");
      Frame frame;
      trajectory->read(0, frame);
      trajectory->read(2, frame);
      trajectory->read(1, frame);
    });
  };
  const auto expect = [&](const std::string& bytes, const std::string& words) {
    EXPECT_NE(message(bytes).find(words), std::string::npos) << message(bytes);
  };
  const std::string place = "frame 1 at byte " + std::to_string(second_frame());
  expect(hostile(56, 0.0F), place + " has the precision 0");
  expect(hostile(56, std::numeric_limits<float>::quiet_NaN()), place + " has the precision nan");
  expect(hostile(56, -1000.0F), place + " has the precision -1000");
  expect(hostile(60, 0x7fffffff), place + " has coordinates x from 2147483647 to ");
  expect(hostile(84, 74), place + " has the class 74 of small differences");
  expect(hostile(84, -1), place + " has the class -1 of small differences");
  expect(hostile(84, 8), place + " is damaged at atom 1: class 8 of differences");
  expect(hostile(84, 72), place + " is damaged: atom 3 lies outside of the extent");
}

TEST(Xtc, TooFewBitsAreNoticed) {
  const TemporaryFolder folder;
  std::string bytes = test::xtc({.frames = 1});
  bytes.replace(88, 4, ByteWriter(std::endian::big).put(20).bytes());
  const auto trajectory = open_trajectory(folder.file("a.xtc", bytes.substr(0, 92 + 20)));
  Frame frame;
  EXPECT_NE(refusal([&] { trajectory->read(0, frame); }).find("frame 0 at byte 0 has too few bits: they end at atom"),
            std::string::npos);
}

TEST(Xtc, OverwrittenBitsAreNoticed) {
  const TemporaryFolder folder;
  const std::string whole = test::xtc({.atoms = 300, .frames = 1});
  int noticed = 0;
  constexpr int kTrials = 200;
  for (int trial = 0; trial < kTrials; ++trial) {
    std::string bytes = whole;
    const std::size_t place = 92 + static_cast<std::size_t>(trial * 7919) % (whole.size() - 100);
    bytes.replace(place, 4, trial % 2 == 0 ? std::string(4, '\0') : std::string(4, '\xff'));
    const auto trajectory = open_trajectory(folder.file("a.xtc", bytes));
    Frame frame;
    const std::string message = refusal([&] { trajectory->read(0, frame); });
    noticed += message.find("frame 0 at byte 0 ") != std::string::npos;
  }
  EXPECT_GT(noticed, kTrials / 3);  // Some damage stays unnoticed, for the format has no checksum.
}

TEST(Xtc, HeadersThatLeadNowhereEndTheTrajectory) {
  const TemporaryFolder folder;
  const auto ending = [&](const std::string& bytes) {
    const auto trajectory = open_trajectory(folder.file("a.xtc", bytes));
    EXPECT_EQ(trajectory->frame_count(), 1U);
    return trajectory->cut_short();
  };
  const std::string place = "frame 1 at byte " + std::to_string(second_frame());
  EXPECT_EQ(ending(hostile(0, 1996)), place + " begins with 1996, not with 1995 or 2023; the frame before it is used");
  EXPECT_NE(ending(hostile(4, -1)).find(place + " has -1 atoms"), std::string::npos);
  EXPECT_NE(ending(hostile(4, 0)).find(place + " has 0 atoms"), std::string::npos);
  EXPECT_NE(ending(hostile(4, 0x80000000U)).find(place + " has -2147483648 atoms"), std::string::npos);
  EXPECT_NE(ending(hostile(52, 13)).find(place + " says 12 atoms first, then 13"), std::string::npos);
  EXPECT_NE(ending(hostile(88, 0x80000000U)).find("bytes of packed coordinates for 12 atoms"), std::string::npos);
  EXPECT_EQ(ending(hostile(88, 0x7fffffff)), "the file ends within frame 1; its 1 whole frame is used");
  EXPECT_NE(refusal([&] {
              open_trajectory(folder.file("b.xtc", hostile(4, -1).substr(second_frame())));
            }).find("frame 0 at byte 0 has -1 atoms"),
            std::string::npos);
}

/// Cuts a file everywhere: whole frames are read as before, and a warning reports the cut. ends: where frames end.
void expect_cuts(const std::string& name, const std::string& bytes, const std::vector<std::size_t>& ends) {
  const TemporaryFolder folder;
  const auto whole = open_trajectory(folder.file("whole-" + name, bytes));
  for (std::size_t length = 0; length < bytes.size(); ++length) {
    const std::string path = folder.file(name, bytes.substr(0, length));
    const auto frames = static_cast<std::uint64_t>(std::upper_bound(ends.begin(), ends.end(), length) - ends.begin());
    if (frames == 0) {
      EXPECT_NE(refusal([&] { open_trajectory(path); }), "no error") << length;
      continue;
    }
    const auto cut = open_trajectory(path);
    ASSERT_EQ(cut->frame_count(), frames) << length;
    Frame expected, frame;
    whole->read(frames - 1, expected);
    cut->read(frames - 1, frame);
    EXPECT_EQ(frame.positions, expected.positions);
    EXPECT_EQ(frame.cell, expected.cell);
    // NetCDF's header states the number of frames.
    const bool seems_whole = name != "a.nc" && length == ends[frames - 1];
    EXPECT_EQ(cut->cut_short().empty(), seems_whole) << length;
  }
}

TEST(Xtc, CutFilesGiveTheirWholeFrames) {
  expect_cuts("a.xtc", test::xtc({}), {second_frame(), test::xtc({.frames = 2}).size(), test::xtc({}).size()});
}

TEST(Trr, CutFilesGiveTheirWholeFrames) {
  const std::size_t frame = test::trr({.frames = 1}).size();
  expect_cuts("a.trr", test::trr({}), {frame, 2 * frame, 3 * frame});
}

TEST(AmberNetcdf, CutFilesGiveTheirWholeFrames) {
  const std::size_t header = test::amber_netcdf({.frames = 0}).size(), frame = 4 + 5 * 12 + 24;
  expect_cuts("a.nc", test::amber_netcdf({}), {header + frame, header + 2 * frame, header + 3 * frame});
}

TEST(Trr, BothPrecisionsAndFramesWithoutPositions) {
  const TemporaryFolder folder;
  for (const bool doubles : {false, true}) {
    const TrrSample sample{.doubles = doubles, .without_positions = 1};
    const auto trajectory = open_trajectory(folder.file("a.trr", test::trr(sample)));
    EXPECT_EQ(trajectory->format(), "TRR");
    ASSERT_EQ(trajectory->frame_count(), 2U);
    Frame frame;
    for (const std::uint32_t number : {1U, 0U, 1U}) {
      trajectory->read(number, frame);
      EXPECT_EQ(frame.step, 20 * number);
      EXPECT_EQ(frame.time, 1.0 * number);
      EXPECT_EQ(frame.cell, glm::dmat3(30, 0, 0, 5, 40, 0, -10, 2.5, 50));
      for (std::uint32_t atom = 0; atom < sample.atoms; ++atom) {
        for (int axis = 0; axis < 3; ++axis)
          EXPECT_EQ(frame.positions[atom][axis], 10.0 * double{test::coordinate(2 * number, atom, axis)});
      }
    }
  }
  const auto none = [&] { open_trajectory(folder.file("b.trr", test::trr({.frames = 1, .without_positions = 0}))); };
  EXPECT_NE(refusal(none).find("holds no complete frame with positions"), std::string::npos);
}

TEST(Trr, TitlesOfOtherProgramsMayHaveAnyLength) {
  // cpptraj wrote its own name until 2016.
  const TemporaryFolder folder;
  using std::string_literals::operator""s;
  const std::string plain = test::trr({.frames = 1}), tag = "\0\0\0\x0d\0\0\0\x0cGMX_trn_file"s;
  ASSERT_EQ(plain.substr(4, tag.size()), tag);
  const auto with = [&](const std::string& other) { return plain.substr(0, 4) + other + plain.substr(4 + tag.size()); };
  Frame frame, same;
  open_trajectory(folder.file("a.trr", plain))->read(0, same);
  open_trajectory(folder.file("b.trr", with("\0\0\0\x1b\0\0\0\x1a"
                                            "Cpptraj generated TRR file\0\0"s)))
      ->read(0, frame);
  EXPECT_EQ(frame.positions, same.positions);
  EXPECT_EQ(frame.time, same.time);
  EXPECT_NE(refusal([&] {
              open_trajectory(folder.file("c.trr", with("\0\0\0\x0d\0\0\xff\x0cGMX_trn_file"s)));
            }).find("has a title of 65292 letters"),
            std::string::npos);
}

TEST(AmberNetcdf, EveryVersionInAnyOrder) {
  const TemporaryFolder folder;
  for (const char version : {1, 2, 5}) {
    const AmberSample sample{.version = version};
    const auto trajectory = open_trajectory(folder.file("a.nc", test::amber_netcdf(sample)));
    EXPECT_EQ(trajectory->format(), "Amber NetCDF");
    ASSERT_EQ(trajectory->frame_count(), 3U);
    Frame frame;
    for (const std::uint32_t number : {2U, 0U, 1U}) {
      trajectory->read(number, frame);
      EXPECT_EQ(frame.time, 0.5 + number);
      EXPECT_EQ(frame.cell, glm::dmat3(10, 0, 0, 0, 20, 0, 0, 0, 30));
      for (std::uint32_t atom = 0; atom < sample.atoms; ++atom) {
        for (int axis = 0; axis < 3; ++axis)
          EXPECT_EQ(frame.positions[atom][axis], test::coordinate(number, atom, axis));
      }
    }
  }
}

TEST(AmberNetcdf, OtherNetcdfIsNamed) {
  const TemporaryFolder folder;
  std::string bytes = test::amber_netcdf({});
  bytes.replace(bytes.find("AMBER"), 5, "CF-1 ");
  EXPECT_NE(refusal([&] { open_trajectory(folder.file("a.nc", bytes)); }).find("not by the convention of Amber"),
            std::string::npos);
}

}  // namespace
}  // namespace meniscus
