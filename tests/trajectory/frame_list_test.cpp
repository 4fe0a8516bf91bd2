// SPDX-License-Identifier: BSD-3-Clause
// Lists of frames in every correct and every wrong form.
#include "core/trajectory/frame_list.h"

#include <random>

#include <gtest/gtest.h>

#include "core/base/error.h"

namespace meniscus {
namespace {

using Frames = std::vector<std::uint64_t>;

Frames parse(std::string_view text, std::uint64_t count = 300) { return parse_frame_list("--frames", text, count); }

std::string complaint(std::string_view text, std::uint64_t count = 300) {
  try {
    parse(text, count);
  } catch (const RequestError& error) {
    return error.what();
  }
  return "none";
}

TEST(FrameList, EveryForm) {
  EXPECT_EQ(parse("all", 3), (Frames{0, 1, 2}));
  EXPECT_EQ(parse("7"), (Frames{7}));
  EXPECT_EQ(parse("0-3"), (Frames{0, 1, 2, 3}));
  EXPECT_EQ(parse("0-9:4"), (Frames{0, 4, 8}));
  EXPECT_EQ(parse("297-"), (Frames{297, 298, 299}));
  EXPECT_EQ(parse("290-:5"), (Frames{290, 295}));
  EXPECT_EQ(parse("250,0-99:50"), (Frames{250, 0, 50}));
  EXPECT_EQ(parse("5-5"), (Frames{5}));
  EXPECT_EQ(parse("0-299:18446744073709551615"), (Frames{0}));
}

TEST(FrameList, FromTheEnd) {
  EXPECT_EQ(parse("last"), (Frames{299}));
  EXPECT_EQ(parse("-1"), (Frames{299}));
  EXPECT_EQ(parse("-3-"), (Frames{297, 298, 299}));
  EXPECT_EQ(parse("-3--2"), (Frames{297, 298}));
  EXPECT_EQ(parse("290-last:5"), (Frames{290, 295}));
  EXPECT_EQ(parse("0,-300--299:1,last", 900), (Frames{0, 600, 601, 899}));
  EXPECT_EQ(parse_frame("--reference", "last", 5), 4u);
  EXPECT_EQ(parse_frame("--reference", "-5", 5), 0u);
  EXPECT_EQ(parse_frame("--reference", "2", 5), 2u);
  for (const char* text : {"0-1", "all", "5", "-6", "", "0,0"})
    EXPECT_THROW(parse_frame("--reference", text, 5), RequestError) << text;
}

TEST(FrameList, SaysWhatIsWrong) {
  for (const char* text : {"", "x", "1,", ",1", "-", "-0", "-301", "--3", "last5", "lost", "1-2-3", "1:2:3", "0x10",
                           "1 ", "18446744073709551616"})
    EXPECT_NE(complaint(text), "none") << text;
  EXPECT_EQ(complaint("-301"), "--frames: '-301' names frame -301, but from the end frames count from -1 to -300");
  EXPECT_EQ(complaint("5-2"), "--frames: '5-2' runs backwards from 5 to 2");
  EXPECT_EQ(complaint("0-9:0"), "--frames: '0-9:0' has a step of 0");
  EXPECT_EQ(complaint("300"), "--frames: '300' asks for frame 300; there are 300, 0 to 299");
  EXPECT_EQ(complaint("0-1000000000"), "--frames: '0-1000000000' asks for frame 1000000000; there are 300, 0 to 299");
  EXPECT_EQ(complaint("1-4,3"), "--frames: '1-4,3' has frame 3 twice");
}

TEST(FrameList, WrittenAndReadAgain) {
  std::mt19937 random(5);
  for (int round = 0; round < 2000; ++round) {
    Frames frames;
    std::uint64_t next = random() % 3;
    const std::size_t count = 1 + random() % 12;
    while (frames.size() < count) {
      frames.push_back(next);
      next += 1 + random() % (round % 2 ? 2 : 6);
    }
    EXPECT_EQ(parse(frame_list_text(frames)), frames) << frame_list_text(frames);
  }
  EXPECT_EQ(frame_list_text({0, 1, 2, 3, 10, 20, 30, 250}), "0-3,10-30:10,250");
  EXPECT_EQ(frame_list_text({9, 3, 4}), "9,3-4");
}

}  // namespace
}  // namespace meniscus
