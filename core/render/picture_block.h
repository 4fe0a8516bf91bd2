// SPDX-License-Identifier: BSD-3-Clause
// A block of a picture: the parameters for casting it, what its rays hit, and the assembly of such blocks to the
// picture.
#pragma once

#include "core/base/constants.h"
#include "core/gpu/kernel_records.h"
#include "core/render/gpu_pack.h"
#include "core/render/look.h"
#include "core/render/picture.h"
#include "core/render/ray_cast_pack.h"
#include "core/surface/primitives.h"

namespace meniscus {

enum class PatchKind : std::uint8_t;

/// A point on a ray.
struct HitPoint {
  double z = 0.0;            ///< distance from the camera's position (orthographic: from the plane through it), Å
  glm::dvec3 position{0.0};  ///< Å
};

/// Returns the point at t (ray_cast::Hit::t) on the ray of a pixel of the whole picture (column, row from the top).
HitPoint hit_point(const PictureFrame& frame, glm::ivec2 pixel, float t);

/// The point that the ray through the centre of a pixel hits.
struct PickedPoint {
  std::uint32_t atom = kNone;     ///< index into the atoms of the object
  std::optional<PatchKind> kind;  ///< nothing for a cap or a shape
  glm::dvec3 position{0.0};       ///< Å
  std::uint32_t object = 0;       ///< index of the object among the drawn objects
  std::uint32_t copy = 0;         ///< index of the copy of the object
};

/// Finds the components of points on a surface, which must outlive it. A patch may have faces in several components (an
/// atom between the outside and a cavity); then the face with the border arc nearest to the point decides.
class ComponentLookup {
 public:
  explicit ComponentLookup(const Surface& surface) : surface_(surface) {}

  /// Returns an index into Surface::components; kNone for a patch without faces. point: Å, on the patch.
  std::uint32_t at(PatchKind kind, std::uint32_t patch, const glm::dvec3& point) const;

 private:
  double squared_distance(const Face& face, const glm::dvec3& point) const;

  const Surface& surface_;
};

/// Returns the squared distance of a point to an arc, Å².
double squared_distance(const Border& border, const glm::dvec3& point);

using kernel::kTileEdge;

/// A part of a picture, in pixels. Its origin is a multiple of kTileEdge.
struct PictureBlock {
  glm::ivec2 origin{0}, size{0};
};

/// Returns the numbers of columns and rows of tiles.
inline glm::ivec2 tile_counts(const PictureBlock& block) { return (block.size + (kTileEdge - 1)) / kTileEdge; }

/// Returns the first pixel of a tile within its block. Tiles are numbered row by row.
inline glm::ivec2 tile_origin(const PictureBlock& block, std::size_t tile) {
  const int number = static_cast<int>(tile), columns = tile_counts(block).x;
  return kTileEdge * glm::ivec2(number % columns, number / columns);
}

/// Returns the place of sample `index` in its pixel, in pixels from the centre: the R2 sequence (Roberts 2018), centre
/// first.
glm::vec2 sample_offset(int index);

/// Returns the view of a block by one sample of each of its pixels.
kernel::BlockView block_view(const PictureFrame& frame, const PictureBlock& block, const glm::vec2& sample_offset);

/// Returns the parameters for tile lists of unlimited depth.
kernel::TileListParameters tile_list_parameters(const PictureFrame& frame, const PictureBlock& block,
                                                std::uint32_t primitive_count);

/// Returns the parameters for the first sample, without tiles.
kernel::RayCastParameters cast_parameters(const PackPlacement& scene, const Look& look, std::uint32_t atom_count,
                                          bool color_by_kind);

/// Returns the parameters for the sample with number `sample` of each pixel.
kernel::FinishParameters finish_parameters(const Look& look, const PackPlacement& scene, glm::ivec2 picture_size,
                                           int sample, bool has_marks);

/// Returns the blocks of a picture, of at most `edge` pixels, which are multiples of kTileEdge.
std::vector<PictureBlock> picture_blocks(glm::ivec2 size, glm::ivec2 edge);

/// Returns `inner` extended by the neighbouring pixels within `reach` that its colours depend on and that the picture
/// has.
PictureBlock with_neighbors(const PictureBlock& inner, int reach, glm::ivec2 picture_size);

/// The source of the indices Hit::primitive.
struct HitSource {
  const Surface* surface = nullptr;  ///< the surface that has the patches; nullptr: shapes
  std::span<const ray_cast::Primitive> primitives;
};

/// The indices of the point that a ray hit.
struct HitNames {
  std::uint32_t atom = kNone, component = kNone;  ///< indices in the tables of Hit::object
  std::uint32_t kind = kNone;                     ///< see Framebuffer::kind
  std::uint32_t patch = kNone;                    ///< see SeenPoint::patch
};

/// Returns the names of a hit of some primitive at a point, Å. Any thread may call it.
using NameHit = std::function<HitNames(const ray_cast::Hit& hit, const glm::dvec3& point)>;
/// Returns HitNames::atom of a hit alone.
using NameAtom = std::function<std::uint32_t(const ray_cast::Hit& hit)>;

/// Returns the names of a hit of this source at a point, Å.
HitNames names_of(const HitSource& source, const ray_cast::Hit& hit, const glm::dvec3& point);

/// Collects the inner parts of blocks in a picture, and passes on the bands of pictures that are taken in bands. The
/// constructor's arguments must exist until the picture is taken.
class PictureCollector {
 public:
  /// Begins an empty picture. names: for settings.aovs; not called otherwise. several: true if there is more than one
  /// Hit::object. name_atom: for settings.mattes, where atoms are not Hit::atom.
  PictureCollector(const PictureFrame& frame, const RenderSettings& settings, NameHit names, bool several = false,
                   NameAtom name_atom = {});

  /// Returns the blocks to be cast, in order, of at most `edge` pixels, a multiple of kTileEdge. In a picture that is
  /// taken in bands, bands are as high as these blocks, and lower for wider pictures.
  std::vector<PictureBlock> blocks(int edge);

  /// Adds colours. sums: the sum of the samples of each of the block's pixels, linear and premultiplied.
  void add_colors(const PictureBlock& inner, const PictureBlock& block, std::span<const glm::vec4> sums);
  void add_hits(const PictureBlock& inner, const PictureBlock& block, std::span<const ray_cast::Hit> hits);
  /// Stores the hits of the rays of one sample of each pixel. hits: one for each pixel of the block.
  void add_seen(const PictureBlock& inner, const PictureBlock& block, std::span<const ray_cast::Hit> hits, int sample);

  /// Marks one of blocks() as finished.
  void end_block(const PictureBlock& block);

  /// Returns the picture, without pixels if the bands have them.
  Framebuffer take() { return std::move(picture_); }

 private:
  void begin_rows(int first, int count_of_rows);
  void copy_hit(const ray_cast::Hit& hit, std::size_t at);

  const PictureFrame& frame_;
  const RenderSettings& settings_;
  const float per_sample_;
  const NameHit names_;
  const NameAtom name_atom_;
  const bool several_;
  int first_row_ = 0;    // first row that picture_ has
  Framebuffer picture_;  // or the current band
};

}  // namespace meniscus
