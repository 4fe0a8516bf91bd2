// SPDX-License-Identifier: BSD-3-Clause
// Finds what a block of a picture shows of many copies of surfaces, without holding all of them in memory.
//
// First the atoms are drawn, as balls that no ray goes through. Then patches that may show in front of them are moved
// and packed, copy after copy from front to back; when there are many they are cast, and whatever no ray shows is
// dropped again. A picture does not depend on primitives that it does not show, so it is that of all copies, to the
// bit.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec4.hpp>

#include "core/math/double_geometry.h"
#include "core/queries/surface_object.h"
#include "core/render/cpu/picture_scene.h"
#include "core/render/cpu/ray_depths.h"

namespace meniscus {

/// The balls of every copy, in the order of merged(); of `objects`, which must stay as long as they.
std::vector<BallGroup> ball_groups(std::span<const SurfaceObject> objects);

/// A copy, and where its atoms are among those of a scene or of all copies.
struct CopyPlace {
  std::uint32_t object = 0;  ///< which of the objects
  std::uint32_t copy = 0;    ///< which of SurfaceObject::copies
  std::uint32_t first_atom = 0;
};

/// Which of them has the atom of a scene; they are by first_atom, and the first has 0.
std::size_t place_of(std::span<const CopyPlace> places, std::uint32_t atom);

/// A scene of copies that holds what a block shows of them, and perhaps a little more.
class VisibleCopies final : public OpaqueScene {
 public:
  /// Patches of the copies that are looked at together, unless one has more. An eighth of that is packed before it is
  /// cast.
  static constexpr std::size_t kPatchesTogether = std::size_t{1} << 21;

  /// objects: of one probe radius, all coloured by kind, alike, or none; they must stay while the scene is cast.
  /// placement: of all copies.
  VisibleCopies(std::span<const SurfaceObject> objects, const PictureFrame& frame, const ScenePlacement& placement,
                const Look& look, const LaneKernels& kernels, std::size_t patches_together = kPatchesTogether);

  void begin_block(const SceneBlock& block, Interruption& interruption, StageClock& clock) override;
  /// Returns the names that the hit has in the tables of merged().
  HitNames names_of(const ray_cast::Hit& hit, const glm::dvec3& point) const override;
  std::uint32_t atom_of(const ray_cast::Hit& hit) const override;
  PickedPoint picked(const ray_cast::Hit& hit) const override;

  /// Returns how many copies of the block were looked at patch by patch.
  std::size_t moved() const { return moved_; }

 private:
  /// A copy, and what of it does not depend on a block.
  struct Copy : CopyPlace {        // first_atom: among those of all copies
    std::uint32_t first_part = 0;  // likewise
    std::uint32_t first_component = 0;
    glm::vec4 bound{0.0f};  // as Primitive::bound
    float nearest = 0.0f;   // as Primitive::nearest
  };

  /// Patches that are together, and a ball around them at home.
  struct Cluster {
    std::size_t first = 0, count = 0;  // of Home::patches
    geometry::PatchBound bound{};
  };

  /// What all copies of an object have in common.
  struct Home {
    geometry::PatchBound bound{};
    std::vector<BoundedPatch> patches;  // cluster by cluster
    std::vector<Cluster> clusters;
    bool opaque = false;  // and whole: what is in an atom's ball is behind the surface
  };

  static Home home_of(const SurfaceObject& object);
  geometry::SeenBound see(const Copy& copy, const geometry::PatchBound& at_home) const;
  bool may_show(const geometry::SeenBound& seen) const;
  bool hides_others(const Copy& copy) const;
  void draw_atoms(Interruption& interruption);
  void add_copies(std::uint32_t object, Copy& next);
  std::size_t patch_count(const Copy& copy) const;
  std::vector<const Copy*> next_batch(std::size_t& next) const;
  RayCastScene seen_part(const Copy& copy) const;
  void add(const Copy& copy, RayCastScene part);
  void find(Interruption& interruption);
  void connect();
  void cast_from(std::size_t first_new);
  void note_tile(std::size_t tile);
  void note_hits(const LaneTile& tile, const kernel::BlockView& view, std::span<double> farthest);

  std::span<const SurfaceObject> objects_;
  const ScenePlacement placement_;
  const Look look_;
  const LaneKernels& kernels_;
  const std::size_t patches_together_;
  std::vector<std::vector<glm::vec4>> colors_;  // of objects
  std::vector<Home> homes_;                     // likewise
  std::vector<Copy> copies_;                    // from front to back
  bool some_hidden_ = false;
  std::size_t moved_ = 0;

  // Of the block at work.
  PictureFrame frame_;  // of the picture or of its shade map
  PictureBlock block_;
  int samples_ = 0;
  std::vector<ray_cast::Hit> hits_;  // of one sample
  RayDepths depths_;
  std::vector<std::atomic<std::uint8_t>> shown_;  // primitives that stay
  std::vector<CopyPlace> places_;                 // of the scene
  std::vector<const Copy*> placed_;               // likewise
};

}  // namespace meniscus
