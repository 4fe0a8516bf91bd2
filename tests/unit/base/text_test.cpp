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
  EXPECT_EQ(escaped("\u009b2J\u0080\u009f\u00a0\xc2"), "\\xc2\\x9b2J\\xc2\\x80\\xc2\\x9f\u00a0\\xc2");
  EXPECT_EQ(in_quotes(std::string(41, 'x')), "'" + std::string(40, 'x') + "...'");
}

TEST(Text, EscapesMarksOfDirectionAndSeparatorsOfLines) {
  EXPECT_EQ(escaped("a\u202eb\u2028"), "a\\xe2\\x80\\xaeb\\xe2\\x80\\xa8");
  for (const std::string_view mark : {"\u061c", "\u200e", "\u200f", "\u2029", "\u202a", "\u2066", "\u2069"})
    EXPECT_EQ(escaped(mark).substr(0, 2), "\\x") << escaped(mark);
  for (const std::string_view letter : {"א", "\u2027", "\u202f", "\u2065", "\u206a", "–", "𝒜"})
    EXPECT_EQ(escaped(letter), letter);
}

TEST(Text, EscapesBytesThatAreNotUtf8) {
  EXPECT_EQ(escaped("a\xff\n"), "a\\xff\\x0a");
  EXPECT_EQ(escaped("\xe2\x82z"), "\\xe2\\x82z");
  for (const std::string_view bad :
       {"\xc0\xaf", "\xe0\x80\xaf", "\xed\xa0\x80", "\xf0\x8f\xbf\xbf", "\xf4\x90\x80\x80", "\x80"}) {
    EXPECT_FALSE(is_utf8(bad)) << escaped(bad);
    EXPECT_EQ(escaped(bad).size(), 4 * bad.size()) << escaped(bad);
  }
  EXPECT_TRUE(is_utf8("Åא€𝒜\x7f"));
}

TEST(Text, ShortensBeforeItEscapes) {
  EXPECT_EQ(shortened("a\x7f", 2), "a\\x7f");
  EXPECT_EQ(shortened("a\x7f z", 2), "a\\x7f...");
  EXPECT_EQ(shortened("a€b", 3), "a...");
}

TEST(Text, PointsAtCharactersNotIntoThem) {
  EXPECT_EQ(pointed_at("Å = x", 5), "Å = x\n    ^");
  EXPECT_EQ(pointed_at("aÅ", 2), "aÅ\n ^");
  EXPECT_EQ(pointed_at("a\u009b", 2), "a\\xc2\\x9b\n ^");
  const std::string middles(100, '\x80');
  EXPECT_EQ(pointed_at(middles, 60), escaped(middles) + "\n^");
}

TEST(Text, IsSafeBetweenTagsAndInAttributes) {
  EXPECT_EQ(markup_text("</script> \"a\" & b\x01\u202e\n\xc3\xa5\xff"),
            "&lt;/script&gt; &quot;a&quot; &amp; b\n\xc3\xa5\ufffd");
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
