// SPDX-License-Identifier: BSD-3-Clause
// A block of a picture: the parameters for casting it, what its rays hit, and the picture put together from such
// blocks.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "core/base/constants.h"
#include "core/gpu/kernel_records.h"
#include "core/render/gpu_scene.h"
#include "core/render/look.h"
#include "core/render/picture.h"
#include "core/render/ray_cast_scene.h"
#include "core/surface/primitives.h"

namespace meniscus {

enum class PatchKind : std::uint8_t;
struct Border;
struct Face;
struct Surface;

/// A point on a ray.
struct HitPoint {
  double z = 0.0;            ///< distance from the camera's position (orthographic: from the plane through it), Å
  glm::dvec3 position{0.0};  ///< Å
};

/// pixel: column, row from the top, of the whole picture; t: ray_cast::Hit::t.
HitPoint hit_point(const PictureFrame& frame, glm::ivec2 pixel, float t);

/// What the ray through the centre of a pixel hits.
struct PickedPoint {
  std::uint32_t atom = kNone;     ///< index into the atoms of the object
  std::optional<PatchKind> kind;  ///< nothing: it is not a patch, but a cap or a shape
  glm::dvec3 position{0.0};       ///< Å
  std::uint32_t object = 0;       ///< of those that are drawn; of copies: whose
  std::uint32_t copy = 0;         ///< which of them
};

/// Looks at a surface that must outlive it. One patch may have faces in several components (an atom between the outside
/// and a cavity); then the face whose border arcs are nearest to the point decides.
class ComponentLookup {
 public:
  explicit ComponentLookup(const Surface& surface) : surface_(surface) {}

  /// Index into Surface::components; kNone for a patch without faces. point: Å, on the patch.
  std::uint32_t at(PatchKind kind, std::uint32_t patch, const glm::dvec3& point) const;

 private:
  double squared_distance(const Face& face, const glm::dvec3& point) const;

  const Surface& surface_;
};

/// Squared distance of a point to an arc, Å².
double squared_distance(const Border& border, const glm::dvec3& point);

using kernel::kTileEdge;

/// A part of a picture, in pixels; the origin is a multiple of kTileEdge.
struct PictureBlock {
  glm::ivec2 origin{0}, size{0};
};

/// Columns and rows of tiles.
inline glm::ivec2 tile_counts(const PictureBlock& block) { return (block.size + (kTileEdge - 1)) / kTileEdge; }

/// Returns the first pixel of a tile within its block. Tiles count row by row.
inline glm::ivec2 tile_origin(const PictureBlock& block, std::size_t tile) {
  const int number = static_cast<int>(tile), columns = tile_counts(block).x;
  return kTileEdge * glm::ivec2(number % columns, number / columns);
}

/// The whole picture as the map of depths sees it that shade is found from (gpu_shaders/look/occlusion.glsl).
PictureFrame shade_map_frame(const PictureFrame& frame);

/// Whether a block of a picture has that map among its own depths: its first sample's are those of the whole picture.
bool holds_shade_map(const PictureBlock& block, glm::ivec2 picture_size);

/// Whether such a map has to be made before the blocks of a picture, of which `first` is the first.
inline bool needs_shade_map(const PictureBlock& first, const RenderSettings& settings) {
  return settings.look.ambient_occlusion > 0.0f && !settings.look.traces_sky() &&
         !holds_shade_map(first, settings.size);
}

/// Where sample `index` lies in its pixel, in pixels from the centre: the R2 sequence (Roberts 2018), centre first.
glm::vec2 sample_offset(int index);

/// Of the first of so many samples of a pixel shade is found, the others take it: it hardly differs among them.
inline constexpr int kSamplesOfShade = 3;
inline int shade_sample(int sample) { return sample - sample % kSamplesOfShade; }

/// The block as a sample of each of its pixels sees it.
kernel::BlockView block_view(const PictureFrame& frame, const PictureBlock& block, const glm::vec2& sample_offset);

/// For lists of tiles that nothing bounds.
kernel::TileListParameters tile_list_parameters(const PictureFrame& frame, const PictureBlock& block,
                                                std::uint32_t primitive_count);

/// Of the first sample; without tiles.
kernel::RayCastParameters cast_parameters(const ScenePlacement& scene, const Look& look, std::uint32_t atom_count,
                                          bool color_by_kind);

/// Of sample `sample` of each pixel.
kernel::OcclusionParameters occlusion_parameters(const Look& look, glm::ivec2 picture_size, int sample);
kernel::FinishParameters finish_parameters(const Look& look, const ScenePlacement& scene, glm::ivec2 picture_size,
                                           int sample, bool has_marks);

/// A picture in blocks of at most `edge` pixels, which are multiples of kTileEdge.
std::vector<PictureBlock> picture_blocks(glm::ivec2 size, glm::ivec2 edge);

/// `inner` and the neighbours that its colours depend on, as far as there are any.
PictureBlock with_neighbors(const PictureBlock& inner, int reach, glm::ivec2 picture_size);

/// What Hit::primitive counts.
struct HitSource {
  const Surface* surface = nullptr;  ///< whose patches they are; nullptr: shapes
  std::span<const ray_cast::Primitive> primitives;
};

/// Indices of what a ray has met.
struct HitNames {
  std::uint32_t atom = kNone, component = kNone;  ///< into the tables of what Hit::object says
  std::uint32_t kind = kNone;                     ///< as Framebuffer::kind
  std::uint32_t patch = kNone;                    ///< as SeenPoint::patch
};

/// Tells them for a hit of some primitive, at a point, Å; on any thread.
using NameHit = std::function<HitNames(const ray_cast::Hit& hit, const glm::dvec3& point)>;
/// Tells HitNames::atom alone.
using NameAtom = std::function<std::uint32_t(const ray_cast::Hit& hit)>;

/// Returns the names of a hit of this source at a point, Å.
HitNames names_of(const HitSource& source, const ray_cast::Hit& hit, const glm::dvec3& point);

/// Takes the inner parts of blocks, and hands over the bands of pictures that are taken so. What it is made of must
/// stay until the picture is taken.
class PictureCollector {
 public:
  /// names: for settings.aovs; else not asked. several: there is more than one Hit::object.
  /// name_atom: for settings.mattes, where atoms are not Hit::atom.
  PictureCollector(const PictureFrame& frame, const RenderSettings& settings, NameHit names, bool several = false,
                   NameAtom name_atom = {});

  /// Of at most `edge` pixels, a multiple of kTileEdge: those to be cast, in this order. Of a picture that is taken in
  /// bands they are as high as these, and lower the wider it is.
  std::vector<PictureBlock> blocks(int edge);

  /// sums: of the samples of each of the block's pixels, linear and premultiplied; hits: through their centres.
  void add_colors(const PictureBlock& inner, const PictureBlock& block, std::span<const glm::vec4> sums);
  void add_hits(const PictureBlock& inner, const PictureBlock& block, std::span<const ray_cast::Hit> hits);
  /// Stores what the rays of one sample of each pixel meet. hits: one for each pixel of the block.
  void add_seen(const PictureBlock& inner, const PictureBlock& block, std::span<const ray_cast::Hit> hits, int sample);

  /// Nothing more comes of one of blocks().
  void end_block(const PictureBlock& block);

  /// Without pixels if the bands have them.
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
  int first_row_ = 0;    // of what picture_ holds
  Framebuffer picture_;  // or the band at work
};

}  // namespace meniscus
