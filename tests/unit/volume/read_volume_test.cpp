// SPDX-License-Identifier: BSD-3-Clause
// Volume maps: a linear field is read back exactly from every format, skewed and turned; errors name the line.
#include <bit>
#include <cmath>
#include <cstring>
#include <random>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/volume/volume_grid.h"
#include "tests/support/run_program.h"

namespace meniscus {
namespace {

/// Returns a linear field, which trilinear sampling gives back exactly but for the rounding of values to floats.
double field(const glm::dvec3& x) { return 0.5 + 0.25 * x.x - 0.75 * x.y + 1.5 * x.z; }

glm::dvec3 point_of(const VolumeFrame& frame, std::size_t i, std::size_t j, std::size_t k) {
  return frame.origin + frame.step * glm::dvec3(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k));
}

/// Returns the field's values, the last axis fastest.
std::vector<float> values_of(const VolumeFrame& frame) {
  std::vector<float> values;
  for (std::size_t i = 0; i < frame.size[0]; ++i)
    for (std::size_t j = 0; j < frame.size[1]; ++j)
      for (std::size_t k = 0; k < frame.size[2]; ++k)
        values.push_back(static_cast<float>(field(point_of(frame, i, j, k))));
  return values;
}

std::string text_of(const std::vector<float>& values) {
  std::string text;
  for (std::size_t n = 0; n < values.size(); ++n) text += fmt::format("{:e}{}", values[n], n % 3 == 2 ? "\n" : " ");
  return text + "\n";
}

/// Compares ten thousand random points of its box, all corners, and points outside.
void expect_field(const VolumeGrid& grid, const VolumeFrame& frame) {
  for (std::size_t axis = 0; axis < 3; ++axis) ASSERT_EQ(grid.frame().size[axis], frame.size[axis]);
  const glm::dvec3 last(frame.size[0] - 1.0, frame.size[1] - 1.0, frame.size[2] - 1.0);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> share(0.001, 0.999);
  for (int n = 0; n < 10'000; ++n) {
    const glm::dvec3 x = frame.origin + frame.step * (last * glm::dvec3(share(random), share(random), share(random)));
    ASSERT_NEAR(grid.sample(x), field(x), 1e-4);
  }
  EXPECT_NEAR(grid.sample(frame.origin + frame.step * (0.9999 * last)), field(frame.origin + frame.step * last), 0.05);
  for (int axis = 0; axis < 3; ++axis) {
    glm::dvec3 before = 0.5 * last, behind = before;
    before[axis] = -0.01;
    behind[axis] = last[axis] + 0.01;
    EXPECT_TRUE(std::isnan(grid.sample(frame.origin + frame.step * before)));
    EXPECT_TRUE(std::isnan(grid.sample(frame.origin + frame.step * behind)));
  }
  EXPECT_TRUE(std::isnan(grid.sample(glm::dvec3(std::nan("")))));
}

VolumeFrame some_frame() {
  VolumeFrame frame;
  frame.size = {3, 4, 5};
  frame.origin = {-1.5, 2.0, 0.25};
  frame.step = glm::dmat3(glm::dvec3(0.5, 0.0, 0.0), glm::dvec3(0.1, 0.75, 0.0), glm::dvec3(-0.2, 0.1, 1.25));
  return frame;
}

std::string dx_text(const VolumeFrame& f, const std::string& values) {
  std::string text = fmt::format(
      "# Data from 3.4.1\n#\n# POTENTIAL (kT/e)\n#\nobject 1 class gridpositions counts {} {} {}\norigin {} {} {}\n",
      f.size[0], f.size[1], f.size[2], f.origin.x, f.origin.y, f.origin.z);
  for (int axis = 0; axis < 3; ++axis)
    text += fmt::format("delta {} {} {}\n", f.step[axis].x, f.step[axis].y, f.step[axis].z);
  text += fmt::format(
      "object 2 class gridconnections counts {0} {1} {2}\n"
      "object 3 class array type double rank 0 items {3} data follows\n",
      f.size[0], f.size[1], f.size[2], f.count());
  return text + values + "attribute \"dep\" string \"positions\"\nobject \"regular\" class field\n";
}

std::string cube_text(const VolumeFrame& f, const std::string& values, double unit, int sign) {
  std::string text =
      fmt::format("a title\nanother\n 1 {} {} {} 1\n", f.origin.x / unit, f.origin.y / unit, f.origin.z / unit);
  for (int axis = 0; axis < 3; ++axis)
    text += fmt::format("{} {:.12f} {:.12f} {:.12f}\n", sign * static_cast<int>(f.size[axis]), f.step[axis].x / unit,
                        f.step[axis].y / unit, f.step[axis].z / unit);
  return text + "8 8.0 0.0 0.0 0.0\n" + values;
}

struct Ccp4Wish {
  int mode = 2;
  std::array<int, 3> axis_of{2, 0, 1};  ///< axes along columns, rows and sections
  bool swapped = false;
  bool by_origin = false;
  std::size_t extended = 0;
};

/// Returns a box of 90° cells of 0.5, 0.75 and 1 Å.
VolumeFrame ccp4_frame() {
  VolumeFrame frame;
  frame.size = {4, 3, 5};
  frame.step = glm::dmat3(glm::dvec3(0.5, 0, 0), glm::dvec3(0, 0.75, 0), glm::dvec3(0, 0, 1));
  frame.origin = frame.step * glm::dvec3(-2.0, 3.0, 1.0);
  return frame;
}

/// scale: values are whole numbers in modes 0, 1 and 6.
std::string ccp4_bytes(const Ccp4Wish& wish, const VolumeFrame& frame, const std::vector<float>& values) {
  std::string bytes(1024 + wish.extended, '\0');
  const auto put = [&](std::size_t at, auto number) {
    char raw[sizeof number];
    std::memcpy(raw, &number, sizeof number);
    if (at + sizeof number > bytes.size()) bytes.resize(at + sizeof number);
    for (std::size_t n = 0; n < sizeof number; ++n) bytes[at + n] = raw[wish.swapped ? sizeof number - 1 - n : n];
  };
  const auto word = [&](std::size_t number, auto value) { put(4 * (number - 1), value); };
  const std::array<int, 3> start{-2, 3, 1};
  for (std::size_t n = 0; n < 3; ++n) {
    const auto axis = static_cast<std::size_t>(wish.axis_of[n]);
    word(1 + n, static_cast<std::int32_t>(frame.size[axis]));
    word(5 + n, wish.by_origin ? 0 : start[axis]);
    word(17 + n, wish.axis_of[n] + 1);
    word(8 + n, std::int32_t{10});
    word(11 + n, static_cast<float>(10.0 * frame.step[static_cast<int>(n)][static_cast<int>(n)]));
    word(14 + n, 90.0F);
    if (wish.by_origin) word(50 + n, static_cast<float>(frame.origin[static_cast<int>(n)]));
  }
  word(4, wish.mode);
  word(24, static_cast<std::int32_t>(wish.extended));
  std::memcpy(&bytes[208], "MAP ", 4);
  bytes[212] = (std::endian::native == std::endian::little) != wish.swapped ? 0x44 : 0x11;
  std::array<std::size_t, 3> at{};
  std::size_t place = bytes.size();
  const auto size = [&](std::size_t n) { return frame.size[static_cast<std::size_t>(wish.axis_of[n])]; };
  for (std::size_t s = 0; s < size(2); ++s)
    for (std::size_t r = 0; r < size(1); ++r)
      for (std::size_t c = 0; c < size(0); ++c) {
        at[static_cast<std::size_t>(wish.axis_of[0])] = c;
        at[static_cast<std::size_t>(wish.axis_of[1])] = r;
        at[static_cast<std::size_t>(wish.axis_of[2])] = s;
        const float value = values[(at[0] * frame.size[1] + at[1]) * frame.size[2] + at[2]];
        if (wish.mode == 0) put(place, static_cast<std::int8_t>(value));
        if (wish.mode == 1) put(place, static_cast<std::int16_t>(value));
        if (wish.mode == 2) put(place, value);
        if (wish.mode == 6) put(place, static_cast<std::uint16_t>(value));
        place = bytes.size();
      }
  return bytes;
}

class Volume : public ::testing::Test {
 protected:
  VolumeGrid read(const std::string& bytes) { return read_volume(folder_.file("map", bytes)); }
  std::string complaint(const std::string& bytes) {
    try {
      read(bytes);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  }
  test::TemporaryFolder folder_;
};

TEST_F(Volume, DxOfASkewedGrid) {
  const VolumeFrame frame = some_frame();
  const VolumeGrid grid = read(dx_text(frame, text_of(values_of(frame))));
  expect_field(grid, frame);
  EXPECT_EQ(grid.title, "electrostatic potential");
  EXPECT_EQ(grid.unit, "kT/e");
}

TEST_F(Volume, CubeInBohrAndInAngstroms) {
  const VolumeFrame frame = some_frame();
  expect_field(read(cube_text(frame, text_of(values_of(frame)), 0.529177210903, 1)), frame);
  expect_field(read(cube_text(frame, text_of(values_of(frame)), 1.0, -1)), frame);
}

TEST_F(Volume, Ccp4OfAnyOrderOfAxesAndBytes) {
  const VolumeFrame frame = ccp4_frame();
  for (const std::array<int, 3>& axes : {std::array{0, 1, 2}, std::array{2, 0, 1}, std::array{1, 0, 2}})
    for (const bool swapped : {false, true})
      for (const bool by_origin : {false, true})
        expect_field(read(ccp4_bytes({2, axes, swapped, by_origin, 80}, frame, values_of(frame))), frame);
}

TEST_F(Volume, Ccp4OfWholeNumbers) {
  const VolumeFrame frame = ccp4_frame();
  std::vector<float> values;
  for (std::size_t n = 0; n < frame.count(); ++n) values.push_back(static_cast<float>(n % 100));
  for (const int mode : {0, 1, 6})
    for (const bool swapped : {false, true})
      EXPECT_EQ(read(ccp4_bytes({mode, {2, 0, 1}, swapped, false, 0}, frame, values)).values(), values) << mode;
  std::vector<float> negative = values, large = values;
  negative[5] = -100.0F;
  large[5] = 60'000.0F;
  EXPECT_EQ(read(ccp4_bytes({0, {0, 1, 2}, true, false, 0}, frame, negative)).values(), negative);
  EXPECT_EQ(read(ccp4_bytes({6, {0, 1, 2}, true, false, 0}, frame, large)).values(), large);
}

TEST_F(Volume, Ccp4OfAnObliqueCell) {
  std::string bytes = ccp4_bytes({2, {0, 1, 2}, false, false, 0}, ccp4_frame(), values_of(ccp4_frame()));
  const float angles[3] = {80.0F, 95.0F, 110.0F};
  std::memcpy(&bytes[52], angles, sizeof angles);
  const glm::dmat3 step = read(bytes).frame().step;
  const double lengths[3] = {0.5, 0.75, 1.0};
  for (int n = 0; n < 3; ++n) {
    EXPECT_NEAR(glm::length(step[n]), lengths[n], 1e-7);
    const glm::dvec3 &a = step[(n + 1) % 3], &b = step[(n + 2) % 3];
    EXPECT_NEAR(std::acos(glm::dot(a, b) / glm::length(a) / glm::length(b)) * 180 / M_PI, angles[n], 1e-5);
  }
  EXPECT_EQ(step[0].y, 0.0);
}

TEST_F(Volume, FaultsAreNamed) {
  const VolumeFrame frame = some_frame();
  const std::string values = text_of(values_of(frame)), dx = dx_text(frame, values);
  const auto changed = [](std::string text, const std::string& from, const std::string& to) {
    return text.replace(text.find(from), from.size(), to);
  };
  const std::string map = ccp4_bytes({}, ccp4_frame(), values_of(ccp4_frame()));
  const auto with_word = [&](std::size_t number, std::int32_t value) {
    std::string bytes = map;
    std::memcpy(&bytes[4 * (number - 1)], &value, 4);
    return bytes;
  };
  std::vector<float> infinite = values_of(ccp4_frame());
  infinite[7] = INFINITY;
  const std::pair<std::string, const char*> cases[] = {
      {"hello\n", "is not one of the volume maps that are read"},
      {"object 1 class gridpositions counts 3 4 5\n", "ends without an array of values"},
      {changed(dx, "counts 3 4 5", "counts 3 4"), "map:5: gridpositions end with 'counts' and three"},
      {changed(dx, "counts 3 4 5", "counts 3 1 5"), "a grid has at least two along each axis"},
      {changed(dx, "counts 3 4 5", "counts 99999 99999 99999"), "more than this program reads"},
      {changed(dx, "items 60", "items 61"), "map:11: 'items' and a number should say 60 values"},
      {changed(dx, "delta -0.2", "delta -0.2x"), "map:9: 'delta' is followed by three numbers"},
      {changed(dx, "delta -0.2 0.1 1.25", "delta 0.1 0.75 0"), "lie in one plane"},
      {changed(dx, "delta -0.2 0.1 1.25\n", ""), "before the grid's counts and its three 'delta'"},
      {changed(dx, "data follows", "data file x"), "do not follow as text"},
      {dx_text(frame, "1 2 x\n" + values), "map:12: 'x' was found in place of value 3 of 60"},
      {dx_text(frame, "1 2 nan\n" + values), "map:12: 'nan' was found in place of value 3 of 60"},
      {dx_text(frame, values.substr(0, values.size() / 2)), "was found in place of value"},
      {dx.substr(0, dx.find("follows") + 8) + "1 2\n", "more than the 4 bytes after it can hold"},
      {dx_text(frame, changed(values, "\n", " 7 ")), "holds more than the 60 values"},
      {cube_text(frame, values.substr(0, 700), 1.0, -1), "is the file cut short?"},
      {changed(cube_text(frame, values, 1.0, -1), "-4 ", "4 "), "some numbers of points are negative"},
      {changed(cube_text(frame, values, 1.0, 1), " 1\n", " 2\n"), "several values per point"},
      {std::string("a\0b\0c", 5), "is binary, but has no stamp"},
      {map.substr(0, 900), "is cut short: a header of a CCP4 map has 1,024 bytes"},
      {map.substr(0, map.size() - 1), "is cut short: 60 values of 4 bytes"},
      {with_word(1, -5), "a grid has at least two along each axis"},
      {with_word(2, 1 << 30), "more than this program reads"},
      {with_word(4, 4), "has values of mode 4"},
      {with_word(8, 0), "has 0 intervals"},
      {with_word(17, 1), "each of 1, 2, 3 must appear once"},
      {with_word(24, -1), "is cut short"},
      {with_word(54, 0), "machine stamp"},
      {ccp4_bytes({}, ccp4_frame(), infinite), "holds inf as value 8, which is not finite"},
  };
  for (const auto& [bytes, reason] : cases) {
    const std::string said = complaint(bytes);
    EXPECT_NE(said.find(reason), std::string::npos) << reason << ": " << said;
  }
}

}  // namespace
}  // namespace meniscus
