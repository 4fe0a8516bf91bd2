// SPDX-License-Identifier: BSD-3-Clause
// Message text: escapes, counts, and progress as people and logs see it.
#include <algorithm>

#include <gtest/gtest.h>

#include "core/base/progress.h"
#include "core/base/text.h"

namespace meniscus {
namespace {

TEST(Text, EscapesWhatWouldSteerATerminal) {
  EXPECT_EQ(escaped("a\x1b[2Jb\nc\x7f"), "a\\x1b[2Jb\\x0ac\\x7f");
  EXPECT_EQ(escaped("1.4 Å"), "1.4 Å");
  EXPECT_EQ(escaped("\u009b2J\u0080\u009f\u00a0\xc2"), "\\xc2\\x9b2J\\xc2\\x80\\xc2\\x9f\u00a0\xc2");
  EXPECT_EQ(in_quotes(std::string(41, 'x')), "'" + std::string(40, 'x') + "...'");
}

TEST(Text, ShortensBeforeItEscapes) {
  EXPECT_EQ(shortened("a\x7f", 2), "a\\x7f");
  EXPECT_EQ(shortened("a\x7f z", 2), "a\\x7f...");
}

TEST(Text, PointsAtCharactersNotIntoThem) {
  EXPECT_EQ(pointed_at("Å = x", 5), "Å = x\n    ^");
  EXPECT_EQ(pointed_at("aÅ", 2), "aÅ\n ^");
  EXPECT_EQ(pointed_at("a\u009b", 2), "a\\xc2\\x9b\n ^");
  const std::string middles(100, '\x80');
  EXPECT_EQ(pointed_at(middles, 60), middles + "\n^");
}

TEST(Text, IsSafeBetweenTagsAndInAttributes) {
  EXPECT_EQ(markup_text("</script> \"a\" & b\x01\n\xc3\xa5"), "&lt;/script&gt; &quot;a&quot; &amp; b\n\xc3\xa5");
}

// The examples of RFC 4648, section 10.
TEST(Text, SpellsBytesInBase64) {
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foo"), "Zm9v");
  EXPECT_EQ(base64("foob"), "Zm9vYg==");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
}

TEST(Text, GroupsDigits) {
  EXPECT_EQ(with_thousands(0), "0");
  EXPECT_EQ(with_thousands(999), "999");
  EXPECT_EQ(with_thousands(1000), "1,000");
  EXPECT_EQ(with_thousands(165175), "165,175");
  EXPECT_EQ(with_thousands(1234567890), "1,234,567,890");
}

TEST(Progress, ReportsStartAndEndAndNeverMoreThanTheTotal) {
  std::vector<std::uint64_t> seen;
  Progress progress([&](const ProgressReport& report) { seen.push_back(report.done); }, "tiles", 3);
  for (int n = 0; n < 5; ++n) progress.advance();
  ASSERT_GE(seen.size(), 2u);
  EXPECT_EQ(seen.front(), 0u);
  EXPECT_EQ(seen.back(), 3u);
}

TEST(Progress, PlainLinesAreFew) {
  std::string text;
  ProgressText plain(false, [&](std::string_view part) { text += part; });
  for (std::uint64_t done = 0; done <= 1000; ++done) plain.report({"tiles", done, 1000});
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 11);
  EXPECT_TRUE(text.ends_with("tiles: 1000 of 1000 (100 %)\n")) << text;
}

TEST(Progress, TheBarEndsItsLine) {
  std::string text;
  ProgressText bar(true, [&](std::string_view part) { text += part; });
  bar.report({"tiles", 1, 2});
  EXPECT_NE(text.find("[###############...............]  50 %"), std::string::npos) << text;
  bar.report({"tiles", 2, 2});
  EXPECT_TRUE(text.ends_with("100 %\n"));
}

TEST(Wrapped, BreaksAtBlanksAndCountsLetters) {
  EXPECT_EQ(wrapped("one two three", 7), "one two\nthree");
  EXPECT_EQ(wrapped("one two three", 6, 2), "one\n  two\n  three");
  EXPECT_EQ(wrapped("ÅÅÅ ÅÅÅ", 7), "ÅÅÅ ÅÅÅ") << "letters, not bytes";
  EXPECT_EQ(wrapped("unbreakable", 4), "unbreakable");
  EXPECT_EQ(wrapped("", 4), "");
}

}  // namespace
}  // namespace meniscus
