// SPDX-License-Identifier: BSD-3-Clause
// Which primitives may show in which tile: the exact extent of each bounding sphere in the picture.
#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>

#include "core/render/ray_cast_scene.h"

namespace meniscus {
namespace {

struct Range {
  double low = -std::numeric_limits<double>::max(), high = std::numeric_limits<double>::max();
};

/// Slopes x/z of the two lines through the origin that touch the circle around (x, z), z > radius.
Range tangent_slopes(double x, double z, double radius) {
  if (z <= radius) return {};
  const double denominator = (z - radius) * (z + radius);
  const double root = radius * std::sqrt(x * x + denominator);
  return {(x * z - root) / denominator, (x * z + root) / denominator};
}

/// Tiles [low, high) along one axis.
struct TileRange {
  int low = 0, high = 0;
};

TileRange tile_range(Range pixels, int tile_count) {
  // A pixel's samples reach to its borders, and rounding may move a ray: half a pixel more on each side is plenty.
  const double low = std::floor((pixels.low - 0.5) / kTileEdge), high = std::floor((pixels.high + 0.5) / kTileEdge);
  return {static_cast<int>(std::clamp(low, 0.0, static_cast<double>(tile_count))),
          static_cast<int>(std::clamp(high + 1.0, 0.0, static_cast<double>(tile_count)))};
}

struct TileRectangle {
  TileRange x, y;
};

/// Finds the rectangle of tiles that the bound of a primitive may touch.
class BoundProjector {
 public:
  BoundProjector(const PictureFrame& frame, glm::ivec2 block_origin, glm::ivec2 tiles)
      : frame_(frame),
        tiles_(tiles),
        origin_(0.5 * frame.size.x - block_origin.x, 0.5 * frame.size.y - block_origin.y),
        scale_(1.0 / frame.pixel_size) {}

  TileRectangle operator()(const ray_cast::Primitive& primitive) const {
    const glm::dvec3 center(primitive.bound.x, primitive.bound.y, primitive.bound.z);
    const double radius = primitive.bound.w;
    const double x = glm::dot(center, frame_.basis.right), y = -glm::dot(center, frame_.basis.up);
    if (frame_.camera.projection == Projection::orthographic)
      return place({x - radius, x + radius}, {y - radius, y + radius}, scale_);
    const double z = frame_.eye_distance + glm::dot(center, frame_.basis.forward);
    return place(tangent_slopes(x, z, radius), tangent_slopes(y, z, radius), scale_ * frame_.eye_distance);
  }

 private:
  TileRectangle place(Range x, Range y, double scale) const {
    return {tile_range({origin_.x + x.low * scale, origin_.x + x.high * scale}, tiles_.x),
            tile_range({origin_.y + y.low * scale, origin_.y + y.high * scale}, tiles_.y)};
  }

  const PictureFrame& frame_;
  glm::ivec2 tiles_;
  glm::dvec2 origin_;  // the picture's centre in pixels of the block
  double scale_;       // pixels per Å on the plane through the pivot
};

}  // namespace

TileLists bin_primitives(const RayCastScene& scene, const PictureFrame& frame, glm::ivec2 block_origin,
                         glm::ivec2 block_size) {
  TileLists lists;
  lists.tiles = (block_size + (kTileEdge - 1)) / kTileEdge;
  const BoundProjector project(frame, block_origin, lists.tiles);
  std::vector<TileRectangle> rectangles;
  rectangles.reserve(scene.primitives.size());
  lists.first_entry.assign(static_cast<std::size_t>(lists.tiles.x) * lists.tiles.y + 1, 0);
  for (const auto& primitive : scene.primitives) {
    const TileRectangle r = rectangles.emplace_back(project(primitive));
    for (int y = r.y.low; y < r.y.high; ++y)
      for (int x = r.x.low; x < r.x.high; ++x) ++lists.first_entry[static_cast<std::size_t>(y) * lists.tiles.x + x + 1];
  }
  for (std::size_t i = 1; i < lists.first_entry.size(); ++i) lists.first_entry[i] += lists.first_entry[i - 1];
  lists.entries.resize(lists.first_entry.back());
  // Primitives come nearest first, so every tile's list is sorted as it fills.
  std::vector<std::uint32_t> next(lists.first_entry.begin(), lists.first_entry.end() - 1);
  for (std::uint32_t i = 0; i < rectangles.size(); ++i) {
    const TileRectangle& r = rectangles[i];
    for (int y = r.y.low; y < r.y.high; ++y)
      for (int x = r.x.low; x < r.x.high; ++x)
        lists.entries[next[static_cast<std::size_t>(y) * lists.tiles.x + x]++] = i;
  }
  return lists;
}

}  // namespace meniscus
