// SPDX-License-Identifier: BSD-3-Clause
// Holds how far the rays of a block can see, and decides what may be visible within that distance.
#include "core/render/cpu/visible_copies.h"

namespace meniscus {
namespace {

constexpr float kInfinite = std::numeric_limits<float>::infinity();
constexpr std::size_t kMostRays = std::size_t{1} << 26;
constexpr double kInto = 0.02;  // Å, balls are drawn this much smaller, which is far more than the rounding of rays

float rounded_up(double depth) { return static_cast<float>(depth + 1e-6 * std::abs(depth)); }

/// Returns a bound of the rounding errors of the ray caster and of this file at this distance, Å.
double room_at(double distance) { return 1e-4 + 1e-6 * distance; }

void lower(float& depth, float to) {
  const std::atomic_ref<float> shared(depth);
  float known = shared.load(std::memory_order_relaxed);
  while (to < known && !shared.compare_exchange_weak(known, to, std::memory_order_relaxed)) {
  }
}

}  // namespace

void RayDepths::begin(const PictureBlock& block, int samples) {
  block_ = block;
  samples_ = samples;
  pixels_ = tile_list_parameters(frame_, block, 0);
  pixels_.pixels_per_angstrom *= static_cast<float>(kTileEdge);
  pixels_.block_center *= static_cast<float>(kTileEdge);
  pixels_.tiles = block.size;
  const auto count = static_cast<std::size_t>(block.size.x) * block.size.y;
  const std::size_t rays = count * static_cast<std::size_t>(samples);
  rays_.assign(rays <= kMostRays ? rays : 0, kInfinite);
  levels_.clear();
  for (glm::ivec2 size = block.size;; size = (size + 1) / 2) {
    levels_.push_back({size, std::vector<float>(static_cast<std::size_t>(size.x) * size.y, kInfinite)});
    if (size.x <= 1 && size.y <= 1) break;
  }
}

/// Returns the point, right and up in Å, where the ray intersects the plane of the pivot.
glm::dvec2 RayDepths::on_pivot_plane(glm::ivec2 pixel, glm::dvec2 offset) const {
  const glm::dvec2 from_middle = glm::dvec2(block_.origin + pixel) + 0.5 - 0.5 * glm::dvec2(frame_.size) + offset;
  return glm::dvec2(from_middle.x, -from_middle.y) * frame_.pixel_size;
}

/// Returns the squared distance of a point (right, up and forward from the camera) to the ray through a point of the
/// pivot's plane.
double RayDepths::squared_distance(const glm::dvec3& point, const glm::dvec2& through) const {
  if (frame_.camera.projection == Projection::orthographic) {
    const glm::dvec2 aside = glm::dvec2(point) - through;
    return glm::dot(aside, aside);
  }
  const glm::dvec3 direction(through, frame_.eye_distance);
  const glm::dvec3 across = glm::cross(point, direction);  // more accurate than Pythagoras, which cancels digits
  return glm::dot(across, across) / glm::dot(direction, direction);
}

void RayDepths::add_ball(const Ball& ball) {
  const double radius = ball.radius - kInto;
  if (radius <= 0.0) return;
  const glm::dvec3 from_pivot = ball.center - frame_.pivot;
  const glm::ivec4 pixels = TileFootprints(pixels_).of(glm::vec4(glm::vec3(from_pivot), static_cast<float>(radius)));
  if (pixels.x >= pixels.y || pixels.z >= pixels.w) return;
  constexpr int kLarge = 64;  // pixels
  if (rays_.empty() || (pixels.y - pixels.x) * (pixels.w - pixels.z) >= kLarge)
    add_to_pixels(ball.center, radius, pixels);
  else
    add_to_rays(ball.center, radius, pixels);
}

/// Draws a ball into pixels that it covers completely, wherever their samples are.
void RayDepths::add_to_pixels(const glm::dvec3& center, double radius, const glm::ivec4& pixels) {
  constexpr double kHalfDiagonal = 0.7072;  // pixels
  const bool orthographic = frame_.camera.projection == Projection::orthographic;
  const glm::dvec3 from = center - frame_.camera.position;
  const glm::dvec3 v{glm::dot(from, frame_.basis.right), glm::dot(from, frame_.basis.up),
                     glm::dot(from, frame_.basis.forward)};
  const double far = orthographic ? v.z : glm::length(v);
  const double spread = kHalfDiagonal * frame_.pixel_size * (orthographic ? 1.0 : far / frame_.eye_distance);
  for (int row = pixels.z; row < pixels.w; ++row)
    for (int column = pixels.x; column < pixels.y; ++column) {
      const glm::dvec2 through = on_pivot_plane({column, row}, glm::dvec2(0.0));
      const double across = std::sqrt(squared_distance(v, through)) + spread;
      const double room = radius * radius - across * across;
      const double enters = room > 0.0 ? far - std::sqrt(room) : 0.0;
      if (enters > 0.0) lower(levels_.front().depths[at({column, row})], rounded_up(enters + room_at(enters)));
    }
}

void RayDepths::add_to_rays(const glm::dvec3& center, double radius, const glm::ivec4& pixels) {
  const bool orthographic = frame_.camera.projection == Projection::orthographic;
  const glm::dvec3 from = center - frame_.camera.position;
  const glm::dvec3 v{glm::dot(from, frame_.basis.right), glm::dot(from, frame_.basis.up),
                     glm::dot(from, frame_.basis.forward)};
  for (int row = pixels.z; row < pixels.w; ++row)
    for (int column = pixels.x; column < pixels.y; ++column)
      for (int sample = 0; sample < samples_; ++sample) {
        const glm::dvec2 through = on_pivot_plane({column, row}, glm::dvec2(sample_offset(sample)));
        const double room = radius * radius - squared_distance(v, through);
        if (room <= 0.0) continue;
        const glm::dvec3 direction(through, frame_.eye_distance);
        const double along = orthographic ? v.z : glm::dot(v, direction) / glm::length(direction);
        const double enters = along - std::sqrt(room);
        if (enters <= 0.0) continue;
        lower(rays_[at({column, row}) * static_cast<std::size_t>(samples_) + static_cast<std::size_t>(sample)],
              rounded_up(enters + room_at(enters)));
      }
}

void RayDepths::limit(glm::ivec2 pixel, double depth) {
  float& known = levels_.front().depths[at(pixel)];
  known = std::min(known, rounded_up(depth));
}

void RayDepths::gather() {
  Level& pixels = levels_.front();
  if (!rays_.empty())
    tbb::parallel_for(0, block_.size.y, [&](int y) {
      for (int x = 0; x < block_.size.x; ++x) {
        const std::size_t pixel = at({x, y});
        const auto first = rays_.begin() + static_cast<std::ptrdiff_t>(pixel * static_cast<std::size_t>(samples_));
        pixels.depths[pixel] = std::min(pixels.depths[pixel], *std::max_element(first, first + samples_));
      }
    });
  for (std::size_t n = 1; n < levels_.size(); ++n) {
    const Level& fine = levels_[n - 1];
    Level& coarse = levels_[n];
    for (int y = 0; y < coarse.size.y; ++y)
      for (int x = 0; x < coarse.size.x; ++x) {
        float farthest = -kInfinite;
        for (int row = 2 * y; row < std::min(2 * y + 2, fine.size.y); ++row)
          for (int column = 2 * x; column < std::min(2 * x + 2, fine.size.x); ++column)
            farthest = std::max(farthest, fine.depths[static_cast<std::size_t>(row) * fine.size.x + column]);
        coarse.depths[static_cast<std::size_t>(y) * coarse.size.x + x] = farthest;
      }
  }
}

bool RayDepths::may_show(const glm::vec4& bound, float nearest) const {
  const glm::ivec4 pixels = TileFootprints(pixels_).of(bound);
  if (pixels.x >= pixels.y || pixels.z >= pixels.w) return false;
  constexpr int kMostTested = 16;  // rays
  if ((pixels.y - pixels.x) * (pixels.w - pixels.z) * samples_ <= kMostTested) return meets_ray(bound, pixels, nearest);
  const glm::ivec2 low(pixels.x, pixels.z), last(pixels.y - 1, pixels.w - 1);
  int level = 0;
  while ((last.x >> level) - (low.x >> level) > 1 || (last.y >> level) - (low.y >> level) > 1) ++level;
  for (int y = low.y >> level; y <= last.y >> level; ++y)
    for (int x = low.x >> level; x <= last.x >> level; ++x)
      if (may_show(level, {x, y}, pixels, nearest)) return true;
  return false;
}

bool RayDepths::may_show(int level, glm::ivec2 cell, const glm::ivec4& pixels, float nearest) const {
  const Level& here = levels_[static_cast<std::size_t>(level)];
  if (nearest > here.depths[static_cast<std::size_t>(cell.y) * here.size.x + cell.x]) return false;
  if (level == 0) return true;
  for (int y = 2 * cell.y; y < 2 * cell.y + 2; ++y)
    for (int x = 2 * cell.x; x < 2 * cell.x + 2; ++x) {
      const glm::ivec2 low = glm::ivec2(x, y) << (level - 1), past = glm::ivec2(x + 1, y + 1) << (level - 1);
      if (low.x >= pixels.y || past.x <= pixels.x || low.y >= pixels.w || past.y <= pixels.z) continue;
      if (may_show(level - 1, {x, y}, pixels, nearest)) return true;
    }
  return false;
}

bool RayDepths::meets_ray(const glm::vec4& bound, const glm::ivec4& pixels, float nearest) const {
  const glm::dvec3 center(bound);
  const glm::dvec3 v{glm::dot(center, frame_.basis.right), glm::dot(center, frame_.basis.up),
                     frame_.eye_distance + glm::dot(center, frame_.basis.forward)};
  const double reach = bound.w + room_at(std::abs(v.x) + std::abs(v.y) + std::abs(v.z));
  for (int row = pixels.z; row < pixels.w; ++row)
    for (int column = pixels.x; column < pixels.y; ++column) {
      if (nearest > levels_.front().depths[at({column, row})]) continue;
      for (int sample = 0; sample < samples_; ++sample)
        if (squared_distance(v, on_pivot_plane({column, row}, glm::dvec2(sample_offset(sample)))) <= reach * reach)
          return true;
    }
  return false;
}

}  // namespace meniscus
