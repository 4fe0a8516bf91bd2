// SPDX-License-Identifier: BSD-3-Clause
// Legends: their place at every size, their parts, transparency, and difficult names.
#include "core/render/legend.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

#include "core/base/error.h"
#include "core/image/color_space.h"
#include "core/base/constants.h"

namespace meniscus {
namespace {

ColorKey numbers(double low, double high, std::size_t missing = 0) {
  ColorScale scale;
  scale.title = "B-factor";
  scale.unit = "Å²";
  scale.range = {low, high};
  scale.missing = missing;
  scale.missing_color = glm::vec3(0.5f);
  return {"", scale, {}};
}

ColorKey classes(std::size_t count) {
  ColorKey key{"chain", {}, {}};
  for (std::size_t n = 0; n < count; ++n)
    key.classes.push_back({"chain " + std::to_string(n), glm::vec3(0.0f, 1.0f, 0.0f)});
  return key;
}

/// Returns a molecule that fills all of its part of the picture with half-transparent red.
Framebuffer molecule(glm::ivec2 size, bool aovs) {
  Framebuffer picture;
  picture.size = size;
  const std::size_t count = static_cast<std::size_t>(size.x) * size.y;
  picture.color.assign(count, {0.5f, 0.0f, 0.0f, 0.5f});
  if (!aovs) return picture;
  picture.z.assign(count, 1.0f);
  picture.normal.assign(count, glm::vec3(1.0f));
  picture.position.assign(count, glm::vec3(1.0f));
  picture.atom.assign(count, 3);
  picture.kind.assign(count, 1);
  picture.component.assign(count, 0);
  return picture;
}

Framebuffer with_legend(const ColorKey& key, glm::ivec2 size, const std::optional<glm::vec3>& background) {
  const Legend legend(key, size);
  return legend.add_to(molecule(legend.molecule_size(), false), background);
}

bool same(const glm::vec4& a, const glm::vec4& b) { return glm::all(glm::lessThan(glm::abs(a - b), glm::vec4(1e-4f))); }

std::size_t count(const Framebuffer& picture, const glm::vec4& color) {
  std::size_t found = 0;
  for (const glm::vec4& pixel : picture.color) found += same(pixel, color);
  return found;
}

const glm::vec4 kRed(0.5f, 0.0f, 0.0f, 0.5f);

TEST(Legend, NeverCoversTheMoleculeAndFitsAtEverySize) {
  for (const glm::ivec2 size :
       {glm::ivec2(200, 150), {200, 200}, {200, 300}, {800, 600}, {600, 800}, {1920, 400}, {3840, 2160}}) {
    for (const ColorKey& key : {numbers(-1.5, 97.25, 12), classes(2), classes(300)}) {
      const Legend legend(key, size);
      const glm::ivec2 left = legend.molecule_size();
      EXPECT_TRUE(size.x >= size.y ? left.x < size.x && left.y == size.y : left.x == size.x && left.y < size.y);
      EXPECT_GE(3 * left.x * left.y, size.x * size.y);
      const Framebuffer picture = legend.add_to(molecule(left, false), glm::vec3(1.0f));
      ASSERT_EQ(picture.size, size);
      EXPECT_EQ(count(picture, kRed), static_cast<std::size_t>(left.x) * left.y);
      std::size_t drawn = 0, on_rim = 0;
      for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x) {
          if (x < left.x && y < left.y) continue;
          const bool ink = picture.color[static_cast<std::size_t>(y) * size.x + x].w > 0.0f;
          drawn += ink;
          on_rim += ink && (x == size.x - 1 || y == size.y - 1 || y == 0);  // It may be cut off.
        }
      EXPECT_GT(drawn, 100u);
      EXPECT_EQ(on_rim, 0u) << size.x << " " << size.y;
    }
  }
}

TEST(Legend, ASizeWithoutRoomIsRefused) {
  for (const glm::ivec2 size : {glm::ivec2(60, 40), {40, 60}, {500, 60}, {1, 1}}) {
    EXPECT_THROW(Legend(numbers(0.0, 1.0), size), RequestError);
  }
}

TEST(Legend, TheBarRunsThroughTheMapFromBelow) {
  const Framebuffer picture = with_legend(numbers(0.0, 10.0), {800, 600}, glm::vec3(1.0f));
  // Some column of the strip holds both ends of the map and its middle, the low end below.
  const auto row_of = [&](double t) {
    const glm::vec4 color(linear_from_srgb(mapped_color(ColorMap::viridis, t)), 1.0f);
    for (std::size_t n = 0; n < picture.color.size(); ++n)
      if (glm::length(picture.color[n] - color) < 0.01f) return static_cast<int>(n) / 800;
    return -1;
  };
  EXPECT_GT(row_of(0.0), row_of(0.5));
  EXPECT_GT(row_of(0.5), row_of(1.0));
  EXPECT_GT(row_of(1.0), 0);
}

TEST(Legend, BothEndsOfABarHaveTheirNumbers) {
  for (const glm::ivec2 size : {glm::ivec2(800, 600), {600, 800}, {1920, 400}, {300, 200}, {400, 600}}) {
    for (const auto& [low, high] : {std::pair(-5.0, 5.0), {11.37, 114.7}, {0.0, 1e-6}, {-0.01234, -0.0123}}) {
      const Legend legend(numbers(low, high), size);
      const auto place_of = [&](double number) {
        const std::string text = fmt::format("{:.4g}", number);
        const auto found = std::ranges::find(legend.texts(), text, &LegendText::text);
        EXPECT_NE(found, legend.texts().end()) << text;
        return found == legend.texts().end() ? glm::ivec2(0) : found->place;
      };
      ASSERT_EQ(legend.boxes().size(), 1u);
      const LegendBox& bar = legend.boxes().front();
      const int em = std::max(9, std::min(size.x, size.y) / 30);
      if (size.x >= size.y) {
        EXPECT_EQ(place_of(low).y, bar.high.y);
        EXPECT_EQ(place_of(high).y, bar.low.y);
      } else {
        EXPECT_LT(place_of(low).x, bar.low.x + em);
        EXPECT_GT(place_of(high).x, bar.high.x - 8 * em);
      }
      // No text runs into another.
      const Font font(em);
      for (const LegendText& a : legend.texts())
        for (const LegendText& b : legend.texts()) {
          if (&a == &b) continue;
          const bool beside =
              a.place.x + font.width(a.text) <= b.place.x || b.place.x + font.width(b.text) <= a.place.x;
          EXPECT_TRUE(beside || std::abs(a.place.y - b.place.y) >= em) << a.text << " " << b.text;
        }
    }
  }
}

TEST(Legend, AMapOfStepsIsABoxAClass) {
  ColorKey key = numbers(1.0, 9.0);
  key.scale->map = ColorMap::consurf;
  for (const glm::ivec2 size : {glm::ivec2(800, 600), {600, 800}}) {
    const Legend legend(key, size);
    ASSERT_EQ(legend.boxes().size(), 9u);
    for (std::size_t n = 0; n < 9; ++n) {
      const LegendBox& box = legend.boxes()[n];
      EXPECT_EQ(box.colors, std::vector<glm::vec3>{mapped_color(ColorMap::consurf, static_cast<double>(n) / 8.0)});
      const auto text = std::ranges::find(legend.texts(), std::to_string(n + 1), &LegendText::text);
      ASSERT_NE(text, legend.texts().end());
      if (size.x > size.y) {
        EXPECT_TRUE(box.low.y <= text->place.y && text->place.y <= box.high.y);
        EXPECT_NEAR(box.high.y - box.low.y, (legend.boxes()[0].high.y - legend.boxes()[8].low.y) / 9.0, 1.0);
      }
    }
  }
  // Both ends have words, wherever the bar lies; all numbers have room where it is upright.
  key.scale->ends = {"variable", "conserved"};
  for (const glm::ivec2 size : {glm::ivec2(800, 600), {600, 800}}) {
    const Legend legend(key, size);
    EXPECT_EQ(std::ranges::count(legend.texts(), "1 variable", &LegendText::text), 1);
    EXPECT_EQ(std::ranges::count(legend.texts(), "9 conserved", &LegendText::text), 1);
    EXPECT_EQ(std::ranges::count(legend.texts(), "8", &LegendText::text), size.x > size.y ? 1 : 0);
  }
  ColorKey smooth = numbers(0.0, 1.0);
  smooth.scale->ends = {"N", "C"};
  const Legend words(smooth, {800, 600});
  EXPECT_EQ(words.texts().size(), 3u) << "the title and both ends";
  // A number between two classes has the colour of one of them.
  EXPECT_EQ(key.scale->color(3.4), key.scale->color(3.0));
  EXPECT_EQ(key.scale->color(3.6), key.scale->color(4.0));
}

TEST(Legend, SwatchesHaveTheColoursAndMissingNumbersOne) {
  EXPECT_GT(count(with_legend(classes(3), {800, 600}, glm::vec3(1.0f)), {0.0f, 1.0f, 0.0f, 1.0f}), 3u * 20u * 20u - 1u);
  const glm::vec4 gray(linear_from_srgb(glm::vec3(0.5f)), 1.0f);
  EXPECT_GT(count(with_legend(numbers(0.0, 1.0, 5), {800, 600}, glm::vec3(1.0f)), gray), 399u);
  EXPECT_EQ(count(with_legend(numbers(0.0, 1.0, 0), {800, 600}, glm::vec3(1.0f)), gray), 0u);
}

TEST(Legend, LettersSuitTheBackground) {
  const glm::vec4 dark(linear_from_srgb(glm::vec3(0.07f)), 1.0f), light(linear_from_srgb(glm::vec3(0.95f)), 1.0f);
  const ColorKey key = classes(3);
  const auto pixels = [&](const std::optional<glm::vec3>& background, const glm::vec4& ink) {
    return count(with_legend(key, {800, 600}, background), ink);
  };
  for (const glm::vec3& pale : {glm::vec3(1.0f), glm::vec3(0.5f), glm::vec3(1.0f, 1.0f, 0.0f)}) {
    EXPECT_GT(pixels(pale, dark), 200u);
    EXPECT_EQ(pixels(pale, light), 0u);
  }
  for (const glm::vec3& deep : {glm::vec3(0.0f), glm::vec3(0.3f), glm::vec3(0.0f, 0.0f, 1.0f)}) {
    EXPECT_GT(pixels(deep, light), 200u);
    EXPECT_EQ(pixels(deep, dark), 0u);
  }
  // A transparent picture has dark letters, clear pixels elsewhere, and premultiplied colours.
  const Framebuffer clear = with_legend(key, {800, 600}, std::nullopt);
  EXPECT_GT(count(clear, dark), 200u);
  EXPECT_EQ(count(clear, glm::vec4(1.0f)), 0u);
  EXPECT_GT(count(clear, glm::vec4(0.0f)), 800u * 600u / 20u);
  for (const glm::vec4& pixel : clear.color) {
    EXPECT_LE(std::max({pixel.x, pixel.y, pixel.z}), pixel.w + 1e-5f);
    EXPECT_LE(pixel.w, 1.0f + 1e-5f);
  }
}

TEST(Legend, TheStripIsAMissInEveryAov) {
  const Legend legend(classes(2), {400, 300});
  const Framebuffer picture = legend.add_to(molecule(legend.molecule_size(), true), std::nullopt);
  ASSERT_EQ(picture.z.size(), 400u * 300u);
  for (int y = 0; y < 300; ++y)
    for (int x = 0; x < 400; ++x) {
      const std::size_t at = static_cast<std::size_t>(y) * 400 + x;
      const bool inside = x < legend.molecule_size().x;
      ASSERT_EQ(std::isfinite(picture.z[at]), inside);
      ASSERT_EQ(picture.atom[at], inside ? 3u : kNone);
      ASSERT_EQ(picture.component[at], inside ? 0u : kNone);
      ASSERT_EQ(picture.kind[at], inside ? 1u : kNone);
      ASSERT_EQ(picture.normal[at], glm::vec3(inside ? 1.0f : 0.0f));
      ASSERT_EQ(picture.position[at], glm::vec3(inside ? 1.0f : 0.0f));
    }
}

TEST(Legend, NamesFromFilesAreBoundAndHarmless) {
  EXPECT_EQ(drawable("A"), "A");
  EXPECT_EQ(drawable("  "), "(blank)");
  EXPECT_EQ(drawable(""), "(blank)");
  EXPECT_EQ(drawable("a\x1b[2J\n"), "a\\x1b[2J\\x0a");
  EXPECT_EQ(drawable("Å²≤"), "Å²≤");
  EXPECT_EQ(drawable("\xff\xc3"), "\\xff\\xc3");
  EXPECT_EQ(drawable("\xe2\x82z\u202e"), "\\xe2\\x82z\\xe2\\x80\\xae");
  EXPECT_EQ(drawable(std::string(25, 'x')), std::string(24, 'x') + "…");
  ColorKey wild = classes(40);
  for (ColorClass& entry : wild.classes) entry.name = std::string(10000, '\x01');
  EXPECT_EQ(with_legend(wild, {800, 600}, std::nullopt).size, glm::ivec2(800, 600));
}

TEST(Legend, RoundNumbers) {
  EXPECT_EQ(round_numbers(0.0, 10.0, 5), (std::vector<double>{2.0, 4.0, 6.0, 8.0}));
  EXPECT_EQ(round_numbers(-4.5, 4.5, 5), (std::vector<double>{-4.0, -2.0, 0.0, 2.0, 4.0}));
  EXPECT_EQ(round_numbers(3.0, 3.0, 5), std::vector<double>{});
  EXPECT_EQ(round_numbers(0.0, 1.0, 0), std::vector<double>{});
  EXPECT_LE(round_numbers(1e17, 1e17 + 32.0, 5).size(), 6u);
  for (const double scale : {1e-12, 1.0, 3.7, 1e9}) {
    const std::vector<double> found = round_numbers(-scale, 1.3 * scale, 5);
    EXPECT_GE(found.size(), 2u);
    EXPECT_LE(found.size(), 5u);
  }
}

/// Returns the drawn pixels: low x, low y, high x, high y.
glm::ivec4 extent(const Framebuffer& picture) {
  glm::ivec4 found(picture.size, 0, 0);
  for (int n = 0; n < static_cast<int>(picture.color.size()); ++n) {
    if (picture.color[n].w == 0.0f) continue;
    const int x = n % picture.size.x, y = n / picture.size.x;
    found = {std::min(found.x, x), std::min(found.y, y), std::max(found.z, x + 1), std::max(found.w, y + 1)};
  }
  return found;
}

TEST(Legend, TitleSizeAndPlaceAreAsAsked) {
  const ColorKey key = classes(3);
  using Place = LegendStyle::Place;
  const Legend usual(key, {800, 600}), large(key, {800, 600}, {{}, 40, Place::automatic});
  EXPECT_LT(large.molecule_size().x, usual.molecule_size().x);
  const Legend below(key, {800, 600}, {{}, {}, Place::below}), right(key, {600, 800}, {{}, {}, Place::right});
  EXPECT_EQ(below.molecule_size().x, 800);
  EXPECT_LT(below.molecule_size().y, 600);
  EXPECT_LT(right.molecule_size().x, 600);
  EXPECT_EQ(right.molecule_size().y, 800);
  const Framebuffer titled = Legend(key, {800, 600}, {"of one's own", {}, Place::right}).alone({});
  const Framebuffer untitled = Legend(key, {800, 600}, {"", {}, Place::right}).alone({});
  EXPECT_GT(titled.size.y, untitled.size.y + 20);
}

TEST(Legend, AloneItIsAsLargeAsWhatItSays) {
  for (const ColorKey& key : {numbers(-1.5, 97.25, 12), classes(2)}) {
    const Framebuffer alone = Legend(key, {800, 600}).alone({});
    const glm::ivec4 drawn = extent(alone);
    EXPECT_EQ(glm::ivec2(drawn.x, drawn.y), glm::ivec2(10));  // half of the letters' 20 pixels
    EXPECT_EQ(alone.size - glm::ivec2(drawn.z, drawn.w), glm::ivec2(10));
    EXPECT_LT(alone.size.x, 400);
  }
  EXPECT_TRUE(Legend({"", {}, {}}, {800, 600}).alone({}).color.empty());
}

TEST(Legend, ChainsStandByName) {
  ColorKey key{"chain", {}, {}};
  const glm::vec3 red(1.0f, 0.0f, 0.0f), green(0.0f, 1.0f, 0.0f), blue(0.0f, 0.0f, 1.0f);
  key.classes = {{"B10", red}, {"B2", green}, {"A", blue}};
  const Framebuffer picture = with_legend(key, {800, 600}, glm::vec3(1.0f));
  const auto row_of = [&](const glm::vec3& color) {
    for (std::size_t n = 0; n < picture.color.size(); ++n)
      if (same(picture.color[n], glm::vec4(color, 1.0f))) return static_cast<int>(n) / 800;
    return -1;
  };
  EXPECT_LT(row_of(blue), row_of(green));
  EXPECT_LT(row_of(green), row_of(red));
  EXPECT_GE(row_of(blue), 0);
}

bool has_entry(const Legend& legend, const std::string& text) {
  return std::ranges::find(legend.texts(), text, &LegendText::text) != legend.texts().end();
}

TEST(Legend, ManyEntriesStandInColumnsBeforeAnyIsDropped) {
  for (const glm::ivec2 size : {glm::ivec2(1280, 960), {800, 600}, {472, 354}, {600, 800}, {2400, 1800}}) {
    const Legend legend(classes(21), size);
    for (int n = 0; n < 21; ++n) EXPECT_TRUE(has_entry(legend, fmt::format("chain {}", n))) << size.x << " " << n;
    EXPECT_EQ(legend.boxes().size(), 21u);
    EXPECT_GE(2 * legend.molecule_size().x * legend.molecule_size().y, size.x * size.y);
    for (const LegendText& a : legend.texts())
      for (const LegendText& b : legend.texts())
        if (&a != &b && std::abs(a.place.y - b.place.y) < legend.font().height()) {
          EXPECT_TRUE(a.place.x + legend.font().width(a.text) < b.place.x ||
                      b.place.x + legend.font().width(b.text) < a.place.x)
              << a.text << " " << b.text;
        }
  }
  EXPECT_TRUE(has_entry(Legend(classes(3), {800, 600}), "chain 2"));
}

TEST(Legend, TinyPicturesHaveSmallLetters) {
  for (const glm::ivec2 size : {glm::ivec2(160, 120), {120, 160}, {100, 100}})
    for (const ColorKey& key : {numbers(-1.5, 97.25, 12), classes(5)}) {
      const Legend legend(key, size);
      EXPECT_LE(legend.font().height(), 9);
      EXPECT_GE(3 * legend.molecule_size().x * legend.molecule_size().y, size.x * size.y);
    }
  try {
    Legend(classes(3), {40, 30});
    FAIL();
  } catch (const RequestError& error) {
    EXPECT_NE(std::string(error.what()).find("legend-file"), std::string::npos) << error.what();
  }
}

TEST(Legend, EntriesAreCalledAsAUserSays) {
  LegendStyle style;
  style.names = {"chain 1=Gαs", "chain 2=x=y"};
  const Legend legend(classes(3), {800, 600}, style);
  for (const char* text : {"chain 0", "Gαs", "x=y"}) EXPECT_TRUE(has_entry(legend, text)) << text;
  EXPECT_FALSE(has_entry(legend, "chain 1"));
  style.names = {"chain 7=no"};
  EXPECT_THROW(Legend(classes(3), {800, 600}, style), RequestError);
}

TEST(Legend, LettersHaveTheColourAskedFor) {
  LegendStyle style;
  style.color = glm::vec3(1.0f);
  const Legend legend(classes(3), {800, 600}, style);
  EXPECT_GT(count(legend.add_to(molecule(legend.molecule_size(), false), std::nullopt), glm::vec4(1.0f)), 200u);
}

TEST(Legend, NumbersBeyondAnEndAreSaidThere) {
  const auto ticks = [](double low, double high, std::vector<double> values) {
    ColorKey key = numbers(low, high);
    key.scale->value = std::move(values);
    return with_legend(key, {800, 600}, glm::vec3(1.0f));
  };
  const Framebuffer plain = ticks(4.0, 114.9, {4.0, 114.9});
  EXPECT_FALSE(plain.color == ticks(4.0, 114.9, {4.0, 200.0}).color) << "beyond the end";
  EXPECT_FALSE(ticks(0.0, 100.0, {}).color == ticks(0.5, 100.5, {}).color);
}

TEST(Legend, LettersOfEveryAlphabetDiffer) {
  const Font font(32);
  const auto pixels = [&](std::string_view text) {
    std::vector<float> mask(100 * 60, 0.0f);
    font.draw(text, {10, 30}, mask, {100, 60});
    return mask;
  };
  EXPECT_NE(pixels("Å"), pixels("A"));
  EXPECT_NE(pixels("²"), pixels("2"));
  EXPECT_NE(pixels("é"), pixels(")"));
  EXPECT_NE(pixels("≤"), pixels("≥"));
  EXPECT_GT(font.width("WW"), font.width("W"));
}

}  // namespace
}  // namespace meniscus
