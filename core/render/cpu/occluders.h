// SPDX-License-Identifier: BSD-3-Clause
// What in a picture keeps light away, packed for the rays that find out, and the directions of those rays.
#pragma once

#include <cstdint>
#include <deque>
#include <span>
#include <vector>

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "core/render/cpu/host_scene.h"
#include "core/render/picture_object.h"

namespace meniscus {

struct RigidMotion;
struct SurfaceObject;

/// Surfaces and shapes as rays towards the light meet them, wherever the camera is. What is hidden, cut away or seen
/// through keeps no light away.
class Occluders {
 public:
  /// pivot: that of the picture. slack: of all its objects.
  Occluders(const glm::dvec3& pivot, float slack) : pivot_(pivot), slack_(slack) {}

  /// What it points to must stay until the last picture.
  void add(const PictureObject& object);
  /// Each copy of the surface, which is in memory once.
  void add(const SurfaceObject& object);

  /// Directions for so many samples of a pixel. basis: of the camera, which the lamp stands beside.
  void aim(const Look& look, const ViewBasis& basis, int samples);

  /// All that keeps light away, and rays towards these directions alone, however far they go; both must stay.
  LaneLight towards(std::span<const glm::vec3> sky) const;

  /// For LaneScene::light; valid until something is added.
  const LaneLight* light() const { return &light_; }

 private:
  /// An object, packed.
  struct Packed {
    HostScene scene;
    std::vector<OccluderBox> boxes;
    std::vector<std::uint32_t> order;
    std::vector<glm::vec4> planes;
  };

  LaneOccluder pack(const PictureObject& object);

  const glm::dvec3 pivot_;
  const float slack_;
  std::deque<Packed> packed_;
  std::vector<LaneOccluder> occluders_;
  std::vector<glm::vec3> lamp_, sky_;
  LaneLight light_;
};

/// So many directions over the whole sphere, of length 1, which differ from those of any other `first`, and are spread
/// evenly together with those that follow: the R2 sequence (Roberts 2018) on the equal-area cylinder (Lambert 1772).
std::vector<glm::vec3> sky_directions(std::size_t first, std::size_t count);

}  // namespace meniscus
