// SPDX-License-Identifier: BSD-3-Clause
// Several objects in one picture: each is a layer that is cast separately, and all layers are composited along each
// ray.
//
// A closed surface that a plane cuts needs no geometry for its cap: the ray is inside the solid at the plane if it
// leaves the solid at the next point behind the plane.
#pragma once

#include "core/math/ball.h"
#include "core/render/cpu/picture_content.h"
#include "core/render/picture.h"

namespace meniscus {

/// The packed objects of one picture.
class LayerStack final : public PictureContent {
 public:
  /// Packs the objects. placement: that of all objects together. The data that objects point to must outlive the scene.
  LayerStack(std::span<const PictureObject> objects, const PictureFrame& frame, const PackPlacement& placement,
             const Look& look);

  void begin_block(const SceneBlock& block, Interruption& interruption, StageClock& clock) override;
  void cast_tile(std::size_t tile, LaneTile task, const LaneKernels& kernels) override;

  SceneContent content() const override { return content_; }
  HitNames names_of(const ray_cast::Hit& hit, const glm::dvec3& point) const override;
  PickedPoint picked(const ray_cast::Hit& hit) const override;

 private:
  struct Layer {
    const PictureObject* object = nullptr;
    const Surface* surface = nullptr;
    std::uint32_t number = 0;  // index of the object
    bool translucent = false;
    HostPack scene;
    std::vector<glm::vec4> planes;  // relative to the pivot
    CpuTileLists lists;
    std::optional<BallGrid> atoms;  // present if planes cut the surface
    double farthest_atom = 0.0;     // Å, each point of the solid is at most this far from the sphere of some atom
  };

  /// A point of a cap, with its plane.
  struct Cap : LayerHit {
    std::uint32_t plane = 0;
    glm::dvec3 point{0.0};  // Å
  };

  /// The memory of a thread.
  struct Workplace {
    SortedList sorted;
    std::vector<LayerHit> hits;
    std::vector<Cap> caps;
    std::vector<float> farthest;
    std::vector<ClippedRay> clipped;
    std::vector<std::uint32_t> starts, next, order;

    /// Returns the indices of a ray's hits, once they are sorted.
    std::span<std::uint32_t> order_of(std::uint32_t ray) {
      return std::span(order).subspan(starts[ray], starts[ray + 1] - starts[ray]);
    }
  };

  /// The current tile.
  struct TileWork {
    const LaneTile& task;
    const LaneKernels& kernels;
    Workplace& place;
  };

  HitSource source_of(const ray_cast::Hit& hit) const;
  void pack(Layer& layer, const PackPlacement& placement, const Look& look) const;
  void cast_layer(std::uint32_t number, std::size_t tile, const TileWork& work);
  void cut(std::uint32_t number, std::size_t first_hit, const TileWork& work) const;
  static bool begins_inside(const Layer& layer, std::span<const LayerHit> hits, std::span<const std::uint32_t> order);
  static const LayerHit& leaving_hit(std::span<const LayerHit> hits, std::span<const std::uint32_t> order);
  glm::dvec3 cap_point(const LaneTile& task, const LayerHit& cap) const;
  void color_caps(const Layer& layer, std::span<Cap> caps) const;
  static void paint_cap(const Layer& layer, Cap& cap);
  /// The middle of some caps, and the largest distance of a cap from it, Å.
  struct Middle {
    glm::dvec3 point{0.0};
    double reach = 0.0;
  };
  static Middle middle_of(std::span<const Cap> caps);
  using NearAtom = std::pair<double, std::uint32_t>;  // distance of the atom's sphere from the middle, Å
  /// Colours caps. near: atoms in order of distance. reach: the largest distance of a cap from the middle, Å.
  void color_caps(const Layer& layer, std::span<Cap> caps, double reach, std::span<const NearAtom> near) const;
  /// Sorts the hits from first_hit on by ray and distance, nearest first.
  void order_hits(std::size_t first_hit, const TileWork& work) const;
  void put_together(const TileWork& work) const;
  /// Writes the properties of a sample that the look needs in addition to its colour; nullptr: nothing is hit.
  void write(const LaneSamples& samples, std::size_t at, const LayerHit* hit) const;

  PictureFrame frame_;
  PictureBlock block_;
  std::vector<Layer> layers_;  // opaque layers first
  SceneContent content_{.layers = true};
  tbb::enumerable_thread_specific<Workplace> workplaces_;
};

}  // namespace meniscus
