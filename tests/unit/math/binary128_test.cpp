// SPDX-License-Identifier: BSD-3-Clause
// Quadruple precision in integers has the bits of the compiler's own.
#include "core/math/quad_geometry.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace meniscus {
namespace {

#if defined(__SIZEOF_FLOAT128__)
__extension__ typedef __float128 Quad;

std::uint64_t bits(double number) { return std::bit_cast<std::uint64_t>(number); }

/// A number in both kinds, made by the same operations.
struct Pair {
  Binary128 ours;
  Quad theirs;
};

// A double-double holds 106 bits of the 113 at least, and the product of two such parts all.
Binary128 ours(Quad a) {
  Binary128 sum = 0.0;
  for (int part = 0; part < 4; ++part) {
    const auto high = static_cast<double>(a);
    sum = sum + high;
    if (!std::isfinite(high)) return sum;
    a -= high;
  }
  return sum;
}

void expect_equal(const Pair& a, const char* what) {
  const Binary128 converted = ours(a.theirs);
  const bool nan = a.theirs != a.theirs;
  EXPECT_TRUE(nan ? a.ours != a.ours : a.ours == converted)
      << what << ": " << static_cast<double>(a.ours) << " and " << static_cast<double>(a.theirs) << ", apart by "
      << static_cast<double>(a.ours - converted);
  const auto x = static_cast<double>(a.ours), y = static_cast<double>(a.theirs);
  EXPECT_TRUE(nan ? std::isnan(x) : bits(x) == bits(y)) << what << " as double: " << x << ", " << y;
}

/// Draws numbers of many kinds: short and long ones, neighbors of powers of two, equal and opposite ones.
class Numbers {
 public:
  Pair next() {
    const double a = simple(), b = simple() * std::ldexp(1.0, -static_cast<int>(engine_() % 120));
    Pair made{Binary128(a) + b, Quad(a) + Quad(b)};
    if (engine_() % 8 == 0) made = {made.ours * made.ours, made.theirs * made.theirs};
    if (engine_() % 4 == 0 && !made_.empty()) made = made_[engine_() % made_.size()];
    if (engine_() % 4 == 0) made = {-made.ours, -made.theirs};
    if (made_.size() < 1000) made_.push_back(made);
    return made;
  }

 private:
  double simple() {
    const int exponent = static_cast<int>(engine_() % 60) - 30;
    switch (engine_() % 5) {
      case 0:
        return static_cast<double>(engine_() % 16) - 8.0;
      case 1:
        return std::ldexp(1.0, exponent);
      case 2:
        return std::nextafter(std::ldexp(1.0, exponent), engine_() % 2 ? 0.0 : 1e30);
      default:
        return std::ldexp(std::uniform_real_distribution(-1.0, 1.0)(engine_), exponent);
    }
  }

  std::mt19937_64 engine_{7};
  std::vector<Pair> made_;
};

TEST(Binary128, EveryOperationHasTheBitsOfTheCompilersOwn) {
  Numbers numbers;
  for (int n = 0; n < 400000; ++n) {
    const Pair a = numbers.next(), b = numbers.next();
    expect_equal({a.ours + b.ours, a.theirs + b.theirs}, "sum");
    expect_equal({a.ours - b.ours, a.theirs - b.theirs}, "difference");
    expect_equal({a.ours * b.ours, a.theirs * b.theirs}, "product");
    expect_equal({a.ours / b.ours, a.theirs / b.theirs}, "quotient");
    ASSERT_EQ(a.ours < b.ours, a.theirs < b.theirs);
    ASSERT_EQ(a.ours >= b.ours, a.theirs >= b.theirs);
    ASSERT_EQ(a.ours == b.ours, a.theirs == b.theirs);
    if (HasFailure()) FAIL() << "in round " << n;
  }
}

TEST(Binary128, DoublesOfTheWholeRangeComeBack) {
  std::mt19937_64 engine(3);
  for (int n = 0; n < 200000; ++n) {
    auto value = std::bit_cast<double>(engine());
    if (n % 4 == 0) value = std::ldexp(value, -1070);  // subnormal
    if (std::isnan(value)) continue;
    const auto back = static_cast<double>(Binary128(value));
    ASSERT_EQ(bits(back), bits(value)) << value;
    // A third of it has many digits, also where doubles are subnormal.
    const auto third = static_cast<double>(Binary128(value) / 3), expected = static_cast<double>(Quad(value) / 3);
    ASSERT_EQ(bits(third), bits(expected)) << value;
  }
}

TEST(Binary128, InfinitiesAndTheLike) {
  const double infinity = std::numeric_limits<double>::infinity();
  const double values[] = {0.0, -0.0, 1.0, -3.0, infinity, -infinity, std::nan("")};
  for (const double x : values)
    for (const double y : values) {
      const Pair a{x, Quad(x)}, b{y, Quad(y)};
      expect_equal({a.ours + b.ours, a.theirs + b.theirs}, "sum");
      expect_equal({a.ours * b.ours, a.theirs * b.theirs}, "product");
      expect_equal({a.ours / b.ours, a.theirs / b.theirs}, "quotient");
      EXPECT_EQ(a.ours < b.ours, a.theirs < b.theirs);
      EXPECT_EQ(a.ours <= b.ours, a.theirs <= b.theirs);
    }
}
#endif

}  // namespace
}  // namespace meniscus
