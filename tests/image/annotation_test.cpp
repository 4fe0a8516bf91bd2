// SPDX-License-Identifier: BSD-3-Clause
// Writing in pictures is in its place, and a bar has its stated length.
#include "core/render/annotation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/camera/camera.h"
#include "core/render/lettering.h"

namespace meniscus {
namespace {

constexpr glm::ivec2 kSize(400, 300);
const Camera kOrthographic{{0, 0, 50}, {0, 0, 0}, {0, 1, 0}, Projection::orthographic, 30.0, 30.0};  // 0.1 Å a pixel
const Camera kPerspective{{0, 0, 50}, {0, 0, 0}, {0, 1, 0}, Projection::perspective, 30.0, 1.0};

Framebuffer empty_picture() {
  Framebuffer picture;
  picture.size = kSize;
  picture.color.assign(static_cast<std::size_t>(kSize.x) * kSize.y, glm::vec4(0.0f));
  return picture;
}

Framebuffer written(const Annotations& annotations, const Camera& camera = kOrthographic) {
  Framebuffer picture = empty_picture();
  annotate(picture, annotations, camera, glm::vec3(1.0f));
  return picture;
}

/// Returns the low and high corner of drawn pixels within a part of the picture; nothing drawn: high is 0.
glm::ivec4 extent(const Framebuffer& picture, glm::ivec2 low = glm::ivec2(0), glm::ivec2 high = kSize) {
  glm::ivec4 found(kSize, 0, 0);
  for (int y = low.y; y < high.y; ++y)
    for (int x = low.x; x < high.x; ++x)
      if (picture.color[static_cast<std::size_t>(y) * kSize.x + x].w > 0.5f)
        found = {std::min(found.x, x), std::min(found.y, y), std::max(found.z, x + 1), std::max(found.w, y + 1)};
  return found;
}

TEST(Annotations, NothingAskedIsNothingDrawn) {
  EXPECT_EQ(extent(written({})).z, 0);
  EXPECT_FALSE(Annotations{}.any());
}

TEST(Annotations, LettersNeedNoFontOfTheSystem) {
  ASSERT_EQ(built_in_fonts().size(), 2u) << "fonts-liberation2 was missing when this was built";
  for (const Weight weight : {Weight::regular, Weight::bold}) {
    const std::string file = Font(20, weight).letters("A").front().font->file;
    const std::string name = weight == Weight::bold ? "LiberationSans-Bold.ttf" : "LiberationSans-Regular.ttf";
    EXPECT_EQ(file, "built-in:" + name);
    const auto found = std::ranges::find(built_in_fonts(), name, &BuiltInFont::name);
    ASSERT_NE(found, built_in_fonts().end());
    EXPECT_EQ(font_bytes(file), found->bytes);
    EXPECT_TRUE(found->bytes.starts_with(std::string_view("\0\1\0\0", 4)));  // TrueType
  }
}

TEST(Annotations, PlacesAreThoseThatTheCameraShows) {
  for (const Camera& camera : {kOrthographic, kPerspective}) {
    const glm::dvec2 middle = *place_in_picture(camera, kSize, {0, 0, 0});
    EXPECT_NEAR(middle.x, 200.0, 1e-9);
    EXPECT_NEAR(middle.y, 150.0, 1e-9);
    const double unit = angstroms_per_pixel(camera, kSize);
    const glm::dvec2 place = *place_in_picture(camera, kSize, {100.0 * unit, 40.0 * unit, 0});
    EXPECT_NEAR(place.x, 300.0, 1e-9);
    EXPECT_NEAR(place.y, 110.0, 1e-9);
  }
  EXPECT_DOUBLE_EQ(angstroms_per_pixel(kOrthographic, kSize), 0.1);
  // The upper edge of a perspective picture is half its angle above the middle; nearer things are larger.
  const double half = 50.0 * std::tan(15.0 * 3.14159265358979 / 180.0);
  EXPECT_NEAR(place_in_picture(kPerspective, kSize, {0, half, 0})->y, 0.0, 1e-9);
  EXPECT_NEAR(place_in_picture(kPerspective, kSize, {0, 0.5 * half, 25})->y, 0.0, 1e-9);
  EXPECT_FALSE(place_in_picture(kPerspective, kSize, {0, 0, 51}));
}

TEST(Annotations, LengthsOfBarsAreRound) {
  for (const auto& [most, expected] :
       {std::pair{1.0, 1.0}, {1.99, 1.0}, {2.0, 2.0}, {4.9, 2.0}, {5.0, 5.0}, {9.99, 5.0}, {37.0, 20.0}, {0.3, 0.2}})
    EXPECT_NEAR(round_length(most), expected, 1e-12) << most;
}

TEST(Annotations, ABarIsAsLongAsItSays) {
  for (const double length : {5.0, 12.0}) {
    Annotations bar;
    bar.scale_bar = true;
    bar.bar_length = length;
    const glm::ivec4 found = extent(written(bar), {0, 283}, kSize);  // the part below its text
    EXPECT_NEAR(found.z - found.x, 10.0 * length, 1.0);
    EXPECT_LT(found.x, 20);
    EXPECT_LT(found.w, 300);
  }
  Annotations bar;
  bar.scale_bar = true;  // The bar is a quarter of 40 Å.
  const glm::ivec4 found = extent(written(bar), {0, 283}, kSize);
  EXPECT_NEAR(found.z - found.x, 100.0, 1.0);
  for (const double length : {1000.0, 0.01}) {
    bar.bar_length = length;
    EXPECT_THROW(written(bar), RequestError);
  }
}

TEST(Annotations, PanelAndTimeStandInTheirCorners) {
  Annotations panel, time;
  panel.panel = "A";
  time.time = "1.250 ns";
  const glm::ivec4 letter = extent(written(panel)), clock = extent(written(time));
  EXPECT_LT(letter.z, 60);
  EXPECT_LT(letter.w, 60);
  EXPECT_GT(letter.w, 10);
  EXPECT_GT(clock.x, 250);
  EXPECT_LT(clock.z, 400);
  EXPECT_LT(clock.w, 40);
}

TEST(Annotations, LabelsLeadToTheirPlacesAndDoNotMeet) {
  Annotations one;
  one.labels = {{"Ser 48", {5.0, 5.0, 0.0}}};
  const Framebuffer picture = written(one);
  EXPECT_GT(picture.color[static_cast<std::size_t>(100) * kSize.x + 250].w, 0.9f) << "a dot where it points";
  const glm::ivec4 found = extent(picture);
  EXPECT_GT(found.z, 255) << "its text is farther out";
  EXPECT_LT(found.y, 95);
  // Both of two labels at one place are written, so that more is covered.
  const auto covered = [](const Framebuffer& of) {
    double sum = 0.0;
    for (const glm::vec4& pixel : of.color) sum += pixel.w;
    return sum;
  };
  Annotations two = one;
  two.labels.push_back(one.labels.front());
  EXPECT_GT(covered(written(two)), 1.7 * covered(picture));
  // A label outside of the picture is left out.
  one.labels = {{"far", {500.0, 0.0, 0.0}}};
  EXPECT_EQ(extent(written(one)).z, 0);
}

TEST(Annotations, LabelsKeepALetterFromTheBorder) {
  Annotations corners;
  for (const double x : {-18.0, 18.0})
    for (const double y : {-13.0, 13.0}) corners.labels.push_back({"Ser 48", {x, y, 0.0}});
  const AnnotationLayer layer(corners, kOrthographic, kSize, std::nullopt);
  int texts = 0;
  for (const InkStroke& stroke : layer.strokes())
    if (const auto* const text = std::get_if<InkText>(&stroke)) {
      ++texts;
      EXPECT_GE(text->place.x, text->height);
      EXPECT_LE(text->place.x + layer.font_of(*text).width(text->text), kSize.x - text->height);
      EXPECT_GE(text->place.y - text->height / 2, text->height);
      EXPECT_LE(text->place.y + text->height / 2, kSize.y - text->height);
    }
  EXPECT_EQ(texts, 4);
}

TEST(Annotations, LabelsThatHaveNoRoomAreRefusedOrLeftOut) {
  Annotations crowd;
  crowd.scale_bar = true;
  const glm::ivec4 bar = extent(written(crowd));
  for (int n = 0; n < 40; ++n) crowd.labels.push_back({"a label that is as long as the picture", {5.0, 0.1 * n, 0.0}});
  EXPECT_THROW(written(crowd), RequestError);
  crowd.labels_must_fit = false;
  EXPECT_EQ(extent(written(crowd)), bar) << "the bar alone";
}

TEST(Annotations, LengthsAreNextToTheirLinesUnlessHiddenOrInTheWay) {
  Annotations one;
  one.labels = {{"2.9 Å", {0.0, 0.0, 0.0}, false, {3.0, 0.0, 0.0}}};
  const glm::ivec4 across = extent(written(one));
  EXPECT_NEAR(0.5 * (across.x + across.z), 0.5 * kSize.x, 4.0) << "above the middle of the line";
  EXPECT_LT(across.w, kSize.y / 2);
  EXPECT_GT(across.y, kSize.y / 2 - 40);
  one.labels.front().along = {0.0, 3.0, 0.0};
  const glm::ivec4 upright = extent(written(one));
  EXPECT_NEAR(0.5 * (upright.y + upright.w), 0.5 * kSize.y, 4.0);
  EXPECT_TRUE(upright.x > kSize.x / 2 || upright.z < kSize.x / 2);
  // The second label is on the other side, and there is no place for a third.
  const auto covered = [&] {
    double sum = 0.0;
    for (const glm::vec4& pixel : written(one).color) sum += pixel.w;
    return sum;
  };
  const double once = covered();
  one.labels.push_back(one.labels.front());
  const double twice = covered();
  EXPECT_NEAR(twice, 2.0 * once, 0.01 * once);
  one.labels.push_back(one.labels.front());
  EXPECT_EQ(covered(), twice);
  for (PlaceLabel& label : one.labels) label.is_hidden = true;
  EXPECT_EQ(covered(), 0.0);
  // A label keeps its place, and hidden lengths leave its mark alone.
  one.labels.insert(one.labels.begin(), {"Ser 48", {5.0, 5.0, 0.0}});
  Annotations label;
  label.labels = {one.labels.front()};
  EXPECT_EQ(written(one).color, written(label).color);
}

TEST(Annotations, ACurveHasItsMarkWhereThePictureIs) {
  Annotations run;
  // The largest share of the pixel or of one above or below it counts.
  const auto share = [&](std::size_t now, glm::ivec2 place) {
    run.curve->now = now;
    const Framebuffer picture = written(run);
    float most = 0.0f;
    for (int y = place.y - 1; y <= place.y + 1; ++y)
      most = std::max(most, picture.color[static_cast<std::size_t>(y) * kSize.x + place.x].w);
    return most;
  };
  run.curve = Curve{"volume", {10, 20, 30, 40, 50}, 0};
  // The curve goes from (268, 288), its least point at the left, to (388, 252).
  const glm::ivec2 places[] = {{268, 287}, {298, 279}, {328, 270}, {358, 261}, {387, 252}};
  for (std::size_t now = 0; now < 5; ++now)
    for (std::size_t n = 0; n < 5; ++n) {
      const float found = share(now, places[n]);
      if (n <= now)
        EXPECT_GT(found, 0.9f) << now << " " << n;
      else
        EXPECT_LT(found, 0.7f) << now << " " << n;
      EXPECT_GT(found, 0.25f) << "what is to come is there, too";
    }
  // The mark is wider than the curve.
  EXPECT_GT(share(2, {328, 272}), 0.9f);
  EXPECT_LT(share(4, {328, 274}), 0.1f);
  const glm::ivec4 found = extent(written(run));
  EXPECT_GT(found.x, 230);
  EXPECT_GT(found.y, 225);
  EXPECT_LT(found.z, 400);
  EXPECT_LT(found.w, 300);
  run.curve = Curve{"flat", {7, 7, 7}, 1};
  EXPECT_GT(share(1, {328, 270}), 0.9f);
  run.curve = Curve{"one", {7}, 0};
  EXPECT_GT(share(0, {328, 270}), 0.9f);
}

TEST(Annotations, PanelTimeAndCurveHaveStripsOfTheirOwn) {
  Annotations all;
  all.panel = "a";
  all.time = "1.250 ns";
  all.curve = Curve{"volume", {10, 20, 30}, 1};
  const Strips strips = strips_for(strip_contents(all), {}, kSize);
  EXPECT_GT(strips.top, 12);
  EXPECT_LT(strips.top + strips.bottom, 150);
  Framebuffer picture = empty_picture();
  annotate(picture, all, kOrthographic, glm::vec3(1.0f), strips);
  EXPECT_EQ(extent(picture, {0, strips.top}, {kSize.x, kSize.y - strips.bottom}).z, 0)
      << "the molecule's rows are clear";
  EXPECT_GT(extent(picture, {0, 0}, {kSize.x, strips.top}).z, 0);
  EXPECT_GT(extent(picture, {0, kSize.y - strips.bottom}, kSize).z, 0);
  EXPECT_EQ(strips_for({}, {}, kSize).top, 0);
  LetterStyle large;
  large.all = 90;
  EXPECT_EQ(strips_for(strip_contents(all), large, kSize).top, 0) << "the molecule would have less than half";
}

TEST(Annotations, EachKindOfLettersHasItsSize) {
  Annotations texts;
  texts.panel = "H";
  texts.scale_bar = true;
  const auto heights = [&] {
    const Framebuffer picture = written(texts);
    const glm::ivec4 panel = extent(picture, {0, 0}, {200, 150}), bar = extent(picture, {0, 150}, kSize);
    return glm::ivec2(panel.w - panel.y, bar.w - bar.y);
  };
  const glm::ivec2 usual = heights();
  texts.letters.panel = 40;
  EXPECT_GT(heights().x, usual.x + 8);
  EXPECT_EQ(heights().y, usual.y);
  texts.letters.scale_bar = 24;
  EXPECT_GT(heights().y, usual.y + 8);
  texts.letters = {};
  texts.letters.all = 30;
  EXPECT_GT(heights().x, usual.x);
  EXPECT_GT(heights().y, usual.y);
  const LetterHeights own(LetterStyle{{}, 10, 12, 14, 16}, kSize);
  EXPECT_EQ((std::array{own.usual, own.labels, own.scale_bar, own.panel}), (std::array{10, 12, 14, 16}));
}

TEST(Annotations, InkIsAsAskedAndElseSuitsThePaper) {
  const glm::vec3 white(1.0f), black(0.0f), blue(0.0f, 0.0f, 1.0f);
  EXPECT_GT(inks_on(black, {}).ink.x, 0.9f);
  EXPECT_LT(inks_on(white, {}).ink.x, 0.1f);
  EXPECT_LT(inks_on({}, {}).ink.x, 0.1f);
  EXPECT_EQ(inks_on({}, white).ink, white);
  EXPECT_EQ(inks_on({}, white).rim, black);
  EXPECT_EQ(inks_on(black, blue).rim, white);
}

TEST(Annotations, LettersHaveARimBeforeTheMoleculeOnly) {
  Annotations panel;
  panel.panel = "A";
  Framebuffer covered = empty_picture(), clear = empty_picture();
  for (glm::vec4& pixel : covered.color) pixel = {0.2f, 0.0f, 0.0f, 1.0f};
  annotate(covered, panel, kOrthographic, std::nullopt);
  annotate(clear, panel, kOrthographic, std::nullopt);
  int white = 0;
  for (std::size_t n = 0; n < covered.color.size(); ++n) {
    white += covered.color[n].y > 0.4f;  // A rim of one pixel covers half of it.
    EXPECT_NEAR(covered.color[n].w, 1.0f, 1e-5f);
    EXPECT_LE(clear.color[n].x, 0.02f) << "dark alone";
  }
  EXPECT_GT(white, 10);
}

}  // namespace
}  // namespace meniscus
