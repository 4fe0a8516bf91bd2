// SPDX-License-Identifier: BSD-3-Clause
// The colours of chains differ for any colour vision: their least distances by CIEDE2000, as people with normal vision
// and with each kind of dichromacy see them.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <gtest/gtest.h>

#include "core/color/named_colors.h"
#include "core/image/color_space.h"

namespace meniscus {
namespace {

/// Matrices of normal vision, protanopia, deuteranopia and tritanopia, for linear light, row by row: G. M. Machado, M.
/// M. Oliveira and L. A. F. Fernandes, IEEE Trans. Vis. Comput. Graph. 15, 1291 (2009), severity 1.
constexpr std::array<std::array<glm::dvec3, 3>, 4> kVisions{
    {{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}},
     {{{0.152286, 1.052583, -0.204868}, {0.114503, 0.786281, 0.099216}, {-0.003882, -0.048116, 1.051998}}},
     {{{0.367322, 0.860646, -0.227968}, {0.280085, 0.672501, 0.047413}, {-0.011820, 0.042940, 0.968881}}},
     {{{1.255528, -0.076749, -0.178779}, {-0.078411, 0.930809, 0.147602}, {0.004733, 0.691367, 0.303900}}}}};

glm::dvec3 lab_of(const glm::vec3& srgb, const std::array<glm::dvec3, 3>& vision) {
  const glm::dvec3 light(linear_from_srgb(srgb));
  glm::dvec3 seen;
  for (int n = 0; n < 3; ++n) seen[n] = std::clamp(glm::dot(vision[n], light), 0.0, 1.0);
  constexpr std::array<glm::dvec3, 3> kXyz{
      {{0.4124564, 0.3575761, 0.1804375}, {0.2126729, 0.7151522, 0.0721750}, {0.0193339, 0.1191920, 0.9503041}}};
  glm::dvec3 f;
  for (int n = 0; n < 3; ++n) {
    const double share = glm::dot(kXyz[n], seen) / glm::dot(kXyz[n], glm::dvec3(1.0));
    f[n] = share > 216.0 / 24389.0 ? std::cbrt(share) : share * 841.0 / 108.0 + 4.0 / 29.0;
  }
  return {116.0 * f.y - 16.0, 500.0 * (f.x - f.y), 200.0 * (f.y - f.z)};
}

/// Returns the difference of two colours in CIELAB: G. Sharma, W. Wu and E. N. Dalal, Color Res. Appl. 30, 21 (2005).
double ciede2000(const glm::dvec3& one, const glm::dvec3& other) {
  constexpr double kDegree = std::numbers::pi / 180.0;
  const double mean_chroma = 0.5 * (std::hypot(one.y, one.z) + std::hypot(other.y, other.z));
  const double g = 0.5 * (1.0 - std::sqrt(std::pow(mean_chroma, 7) / (std::pow(mean_chroma, 7) + std::pow(25.0, 7))));
  const double a1 = (1.0 + g) * one.y, a2 = (1.0 + g) * other.y;
  const double c1 = std::hypot(a1, one.z), c2 = std::hypot(a2, other.z);
  const auto hue = [&](double a, double b) { return std::fmod(std::atan2(b, a) / kDegree + 360.0, 360.0); };
  const double h1 = hue(a1, one.z), h2 = hue(a2, other.z);
  const double turn = h2 - h1 > 180.0 ? h2 - h1 - 360.0 : h2 - h1 < -180.0 ? h2 - h1 + 360.0 : h2 - h1;
  const double l = 0.5 * (one.x + other.x), c = 0.5 * (c1 + c2), h = std::fmod(h1 + 0.5 * turn + 360.0, 360.0);
  const double t = 1.0 - 0.17 * std::cos((h - 30.0) * kDegree) + 0.24 * std::cos(2.0 * h * kDegree) +
                   0.32 * std::cos((3.0 * h + 6.0) * kDegree) - 0.20 * std::cos((4.0 * h - 63.0) * kDegree);
  const double of_l =
      (other.x - one.x) / (1.0 + 0.015 * (l - 50.0) * (l - 50.0) / std::sqrt(20.0 + (l - 50.0) * (l - 50.0)));
  const double of_c = (c2 - c1) / (1.0 + 0.045 * c);
  const double of_h = 2.0 * std::sqrt(c1 * c2) * std::sin(0.5 * turn * kDegree) / (1.0 + 0.015 * c * t);
  const double rotation = -std::sin(60.0 * std::exp(-std::pow((h - 275.0) / 25.0, 2)) * kDegree) * 2.0 *
                          std::sqrt(std::pow(c, 7) / (std::pow(c, 7) + std::pow(25.0, 7)));
  return std::sqrt(of_l * of_l + of_c * of_c + of_h * of_h + rotation * of_c * of_h);
}

/// Returns the least difference between two of the first `count` chains for any vision.
double least_difference(std::size_t count) {
  double least = 1e9;
  for (const auto& vision : kVisions)
    for (std::size_t n = 0; n < count; ++n)
      for (std::size_t m = 0; m < n; ++m)
        least = std::min(least, ciede2000(lab_of(chain_color(n), vision), lab_of(chain_color(m), vision)));
  return least;
}

TEST(ChainColors, DifferForAnyColorVision) {
  EXPECT_NEAR(ciede2000({50.0, 2.6772, -79.7751}, {50.0, 0.0, -82.7485}), 2.0425, 1e-4) << "row 1 of Sharma's table 1";
  EXPECT_NEAR(ciede2000({22.7233, 20.0904, -46.6940}, {23.0331, 14.9730, -42.5619}), 2.0373, 1e-4) << "another row";
  EXPECT_GE(least_difference(4), 12.5);
  EXPECT_GE(least_difference(6), 12.5);
  EXPECT_GE(least_difference(8), 10.8);
  EXPECT_GE(least_difference(10), 10.8);
}

TEST(ChainColors, AreLightAndRepeatAfterThirty) {
  for (std::size_t n = 0; n < 10; ++n) EXPECT_GT(lab_of(chain_color(n), kVisions[0]).x, 60.0) << n;
  for (std::size_t n = 0; n < 30; ++n) {
    for (std::size_t m = 0; m < n; ++m) EXPECT_NE(chain_color(n), chain_color(m)) << n << " " << m;
    EXPECT_EQ(chain_color(n), chain_color(n + 30));
  }
}

}  // namespace
}  // namespace meniscus
