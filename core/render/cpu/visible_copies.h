// SPDX-License-Identifier: BSD-3-Clause
// Finds the visible parts of many copies of surfaces in a block of a picture, without holding all copies in memory, and
// how far the rays of a block can see.
//
// First the atoms are drawn, as balls that no ray passes through. Then patches that may be visible in front of them are
// moved and packed, copy after copy from front to back. When there are many, they are cast, and patches that no ray
// shows are dropped. A picture does not depend on primitives that it does not show, so it equals the picture of all
// copies, to the bit.
#pragma once

#include "core/math/ball.h"
#include "core/math/double_geometry.h"
#include "core/queries/surface_object.h"
#include "core/render/cpu/picture_content.h"
#include "core/render/picture_block.h"

namespace meniscus {

/// A depth for each pixel of a block, beyond which none of its samples shows anything: Å from the camera (orthographic:
/// from its plane). Initially all are infinite.
class RayDepths {
 public:
  /// Uses the frame of a picture, which is read at the start of each block and must outlive this object.
  explicit RayDepths(const PictureFrame& frame) : frame_(frame) {}

  void begin(const PictureBlock& block, int samples);

  /// Adds a ball inside an opaque solid that does not contain the camera: rays that enter the ball well have hit the
  /// solid before. Several threads may call it at once. It takes effect with the next gather().
  void add_ball(const Ball& ball);
  /// Declares that no sample of this pixel of the block sees farther. It takes effect with the next gather().
  void limit(glm::ivec2 pixel, double depth);
  void gather();

  /// Returns false only if nothing within a bound (Primitive::bound) that begins there (Primitive::nearest) can be
  /// visible.
  bool may_show(const glm::vec4& bound, float nearest) const;

 private:
  glm::dvec2 on_pivot_plane(glm::ivec2 pixel, glm::dvec2 offset) const;
  double squared_distance(const glm::dvec3& point, const glm::dvec2& through) const;
  void add_to_pixels(const glm::dvec3& center, double radius, const glm::ivec4& pixels);
  void add_to_rays(const glm::dvec3& center, double radius, const glm::ivec4& pixels);
  bool may_show(int level, glm::ivec2 cell, const glm::ivec4& pixels, float nearest) const;
  bool meets_ray(const glm::vec4& bound, const glm::ivec4& pixels, float nearest) const;
  std::size_t at(glm::ivec2 pixel) const { return static_cast<std::size_t>(pixel.y) * block_.size.x + pixel.x; }

  /// The farthest depth of each square of 2^n x 2^n pixels.
  struct Level {
    glm::ivec2 size{0};
    std::vector<float> depths;
  };

  const PictureFrame& frame_;
  PictureBlock block_;
  int samples_ = 0;
  kernel::TileListParameters pixels_{};  // parameters of tiles of one pixel
  std::vector<float> rays_;              // depth of each sample, pixel by pixel; empty if there are too many
  std::vector<Level> levels_;            // the first has single pixels
};

/// Returns the balls of every copy, in the order of merged(). They refer to `objects`, which must outlive them.
std::vector<BallGroup> ball_groups(std::span<const SurfaceObject> objects);

/// A copy, and the place of its atoms in a scene or among the atoms of all copies.
struct CopyPlace {
  std::uint32_t object = 0;  ///< index of the object
  std::uint32_t copy = 0;    ///< index in SurfaceObject::copies
  std::uint32_t first_atom = 0;
};

/// Returns the index of the place that has the atom of a scene. Places are sorted by first_atom; the first has 0.
std::size_t place_of(std::span<const CopyPlace> places, std::uint32_t atom);

/// A scene of copies that contains everything that a block shows of them, and possibly more.
class VisibleCopies final : public OpaqueScene {
 public:
  /// The number of patches of the copies that are processed together, unless a single copy has more. They are cast
  /// after each eighth of this number has been packed.
  static constexpr std::size_t kPatchesTogether = std::size_t{1} << 21;

  /// Sorts the copies from front to back. objects: all have the same probe radius, and either all are coloured by kind
  /// in the same way or none is. They must exist while the scene is cast. placement: of all copies.
  VisibleCopies(std::span<const SurfaceObject> objects, const PictureFrame& frame, const PackPlacement& placement,
                const Look& look, const LaneKernels& kernels, std::size_t patches_together = kPatchesTogether);

  void begin_block(const SceneBlock& block, Interruption& interruption, StageClock& clock) override;
  /// Returns the names that the hit has in the tables of merged().
  HitNames names_of(const ray_cast::Hit& hit, const glm::dvec3& point) const override;
  std::uint32_t atom_of(const ray_cast::Hit& hit) const override;
  PickedPoint picked(const ray_cast::Hit& hit) const override;

  /// Returns the number of copies of the block that were tested patch by patch.
  std::size_t moved() const { return moved_; }

 private:
  /// A copy, and its properties that do not depend on a block.
  struct Copy : CopyPlace {        // first_atom: among the atoms of all copies
    std::uint32_t first_part = 0;  // first of its parts among the parts of all copies
    std::uint32_t first_component = 0;
    glm::vec4 bound{0.0f};  // see Primitive::bound
    float nearest = 0.0f;   // see Primitive::nearest
  };

  /// Patches that are close together, and a ball around them before the copy's motion.
  struct Cluster {
    std::size_t first = 0, count = 0;  // range in Home::patches
    geometry::PatchBound bound{};
  };

  /// The common properties of all copies of an object.
  struct Home {
    geometry::PatchBound bound{};
    std::vector<BoundedPatch> patches;  // cluster by cluster
    std::vector<Cluster> clusters;
    bool opaque = false;  // opaque and complete: everything in an atom's ball is behind the surface
  };

  static Home home_of(const SurfaceObject& object);
  geometry::SeenBound see(const Copy& copy, const geometry::PatchBound& at_home) const;
  bool may_show(const geometry::SeenBound& seen) const;
  bool hides_others(const Copy& copy) const;
  void draw_atoms(Interruption& interruption);
  void add_copies(std::uint32_t object, Copy& next);
  std::size_t patch_count(const Copy& copy) const;
  std::vector<const Copy*> next_batch(std::size_t& next) const;
  RayCastPack seen_part(const Copy& copy) const;
  void add(const Copy& copy, RayCastPack part);
  void find(Interruption& interruption);
  void connect();
  void cast_from(std::size_t first_new);
  void note_tile(std::size_t tile);
  void note_hits(const LaneTile& tile, const kernel::BlockView& view, std::span<double> farthest);

  std::span<const SurfaceObject> objects_;
  const PackPlacement placement_;
  const Look look_;
  const LaneKernels& kernels_;
  const std::size_t patches_together_;
  std::vector<std::vector<glm::vec4>> colors_;  // one for each object
  std::vector<Home> homes_;                     // one for each object
  std::vector<Copy> copies_;                    // sorted from front to back
  bool some_hidden_ = false;
  std::size_t moved_ = 0;

  // The members that follow belong to the current block.
  PictureFrame frame_;  // frame of the picture or of its shade map
  PictureBlock block_;
  int samples_ = 0;
  std::vector<ray_cast::Hit> hits_;  // hits of one sample
  RayDepths depths_;
  std::vector<std::atomic<std::uint8_t>> shown_;  // 1 for primitives that are kept
  std::vector<CopyPlace> places_;                 // places of the copies in the scene
  std::vector<const Copy*> placed_;               // these copies
};

}  // namespace meniscus
