// SPDX-License-Identifier: BSD-3-Clause
// Compares neighbouring pixels of the first sample.
#include "core/render/cpu/unevenness.h"

#include <tbb/parallel_for.h>

#include "core/render/cpu/lane_kernels.h"

namespace meniscus {
namespace {

/// The greatest second difference of three pixels in a row that is even, in displayed values from 0 to 1. In between
/// colours are nearly linear, and the mean over a pixel is the value at its centre.
constexpr float kMostBend = 4.0f / 255.0f;
constexpr int kPadding = 16;  // the widest packet

constexpr int kRows = kBundleEdge + 2;

/// The pixels of a row of bundles and around it, approximately as they are displayed: the square roots of linear
/// values.
struct DisplayedRows {
  std::vector<float> rows[kRows];  // four numbers per pixel; the first and the last pixel are repeated

  void load(std::span<const glm::vec4> pixels, glm::ivec2 size, int first_row) {
    for (int n = 0; n < kRows; ++n) {
      const int y = std::clamp(first_row - 1 + n, 0, size.y - 1);
      std::vector<float>& row = rows[n];
      row.resize(4 * (static_cast<std::size_t>(size.x) + 2));
      const float* const linear = &pixels[static_cast<std::size_t>(y) * size.x].x;
      for (int i = 0; i < 4 * size.x; ++i) row[i + 4] = std::sqrt(std::max(linear[i], 0.0f));
      std::copy_n(row.begin() + 4, 4, row.begin());
      std::copy_n(row.end() - 8, 4, row.end() - 4);
    }
  }
};

/// Returns true if one of `count` numbers differs too much from its neighbours. above, row, below: the first number in
/// three rows, with four numbers before it and four after the last.
[[gnu::always_inline]] inline bool is_uneven(const float* above, const float* row, const float* below, int count) {
  int uneven = 0;
  const auto compare = [&](float a, float middle, float b) { uneven |= std::abs(a + b - 2.0f * middle) > kMostBend; };
  for (int i = 0; i < count; ++i) {
    compare(row[i - 4], row[i], row[i + 4]);
    compare(above[i], row[i], below[i]);
    compare(above[i - 4], row[i], below[i + 4]);
    compare(above[i + 4], row[i], below[i - 4]);
  }
  return uneven != 0;
}

}  // namespace

void Unevenness::find(std::span<const glm::vec4> first, glm::ivec2 size) {
  size_ = size;
  counts_.assign(first.size() + kPadding, 0.0f);
  tbb::parallel_for(0, (size.y + kBundleEdge - 1) / kBundleEdge, [&](int n) {
    thread_local DisplayedRows displayed;
    const int top = n * kBundleEdge, bottom = std::min(top + kBundleEdge, size.y);
    displayed.load(first, size, top);
    for (int left = 0; left < size.x; left += kBundleEdge) {
      const int width = std::min(kBundleEdge, size.x - left);
      const auto row_is_uneven = [&](int y) {
        const auto row = [&](int above) { return displayed.rows[y - top + above].data() + 4 * (left + 1); };
        return width == kBundleEdge ? is_uneven(row(0), row(1), row(2), 4 * kBundleEdge)
                                    : is_uneven(row(0), row(1), row(2), 4 * width);
      };
      bool uneven = false;
      for (int y = top; y < bottom && !uneven; ++y) uneven = row_is_uneven(y);
      if (!uneven) continue;
      for (int y = top; y < bottom; ++y)
        std::fill_n(counts_.begin() + static_cast<std::ptrdiff_t>(y) * size.x + left, width, 1.0f);
    }
  });
}

bool Unevenness::is_even(glm::ivec2 first, glm::ivec2 end) const {
  end = glm::ivec2(std::min(end.x, size_.x), std::min(end.y, size_.y));
  for (int y = first.y; y < end.y; y += kBundleEdge)
    for (int x = first.x; x < end.x; x += kBundleEdge)
      if (counts_[static_cast<std::size_t>(y) * size_.x + x] != 0.0f) return false;
  return true;
}

}  // namespace meniscus
