// SPDX-License-Identifier: BSD-3-Clause
// Declares the inner loops of pictures on the CPU, compiled for vectors of several widths, and their data.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#if defined(__x86_64__)
#include <immintrin.h>
#endif

#include "core/gpu/kernel_records.h"
#include "core/render/gpu_scene.h"

namespace meniscus {

struct VolumePaint;

/// Colours of points by a volume map, from outside of the kernels: what is seen only is asked.
struct PointPaint {
  const VolumePaint* map = nullptr;           ///< nullptr: colours are those of atoms
  glm::dvec3 pivot{0.0};                      ///< Å: where positions count from
  const std::uint8_t* keeps_color = nullptr;  ///< of atoms: whether they have their own
};

/// Linear, for a point of this atom. x: Å from the pivot; normal: towards the solvent.
glm::vec3 painted(const PointPaint& paint, std::uint32_t atom, const glm::vec4& atom_color, const glm::vec3& x,
                  const glm::vec3& normal);

/// A box of a tree over the primitives of an object; low and high are relative to the pivot.
struct OccluderBox {
  glm::vec3 low;
  std::uint32_t first;  ///< of a leaf: in LaneOccluder::order; else its second child, for the first one follows it
  glm::vec3 high;
  std::uint32_t count;  ///< of a leaf's primitives; 0: it has two children
};

struct LaneOccluder;

/// Where light comes from, and what may keep it away. Directions are towards the light, of length 1, in the molecule's
/// axes; each sample of a pixel takes those that follow the last sample's.
struct LaneLight {
  const LaneOccluder* occluders = nullptr;
  int occluder_count = 0;
  const glm::vec3* lamp = nullptr;  ///< over the disc of the key light
  int lamp_rays = 0;                ///< of a sample; 0: it casts no shadows
  float shadow = 0.0f;              ///< how dark those are, 0 to 1
  const glm::vec3* sky = nullptr;   ///< over the whole sphere
  int sky_rays = 0;                 ///< of a sample; 0: nobody asks what is seen of the sky
  float sky_reach = 0.0f;           ///< Å: what is farther away covers nothing
  float lift = 0.0f;                ///< Å by which rays begin above the surface
};

/// What a tile's rays are traced through; see gpu_shaders/ray_cast/records.glsl.
struct LaneScene {
  const ray_cast::Primitive* primitives = nullptr;
  const glm::vec4* rows = nullptr;
  const glm::vec4* colors = nullptr;  ///< linear, alpha: opacity, 0 if hidden; of atoms, then of kinds
  const float* marks = nullptr;       ///< of atoms: Coloring::line_marks(), or nullptr
  bool some_hidden = false;
  PointPaint paint;
  kernel::RayCastParameters params{};
  kernel::BlockView view{};          ///< but for its sample_offset
  const LaneLight* light = nullptr;  ///< nullptr: light goes through everything
};

/// All of one object that keeps light away: what is opaque. Its scene is seen by nobody.
struct LaneOccluder {
  LaneScene scene;
  const OccluderBox* boxes = nullptr;    ///< the first is around all; nullptr: there is nothing
  const std::uint32_t* order = nullptr;  ///< of its primitives
  const glm::vec4* planes = nullptr;     ///< as LayerTask::planes
  int plane_count = 0;
  glm::mat3 turn{1.0f};  ///< of a point x of the picture, turn * x + shift is where it is in the object's own place
  glm::vec3 shift{0.0f};
  bool is_solid = false;   ///< where planes cut it there are caps
  bool is_opaque = false;  ///< all of it
};

/// A tile's primitives by rising Primitive::nearest; each array goes on for kListPadding entries that no ray meets.
struct LaneList {
  static constexpr int kListPadding = 16;
  int count = 0;
  const float* x = nullptr;  ///< of their bounds
  const float* y = nullptr;
  const float* z = nullptr;
  const float* radius = nullptr;
  const float* nearest = nullptr;
  const std::uint32_t* primitive = nullptr;
};

/// What is known of one sample of each pixel of a block, row by row.
struct LaneSamples {
  glm::vec4* color = nullptr;   ///< linear, premultiplied
  float* depth = nullptr;       ///< along the view axis, Å; kernel::kNothing where nothing is met
  float* normal[3] = {};        ///< towards the solvent, in the molecule's axes
  float* visibility = nullptr;  ///< what it sees of the sky, by rays; nullptr: LaneLight::sky_rays is 0
  float* mark = nullptr;        ///< LaneScene::marks of what is met, else 0; nullptr if there are none
  glm::vec4* over = nullptr;    ///< what is seen through before all of this, premultiplied; nullptr: nothing
};

/// Some samples of a tile's pixels.
struct LaneTile {
  static constexpr int kMostSamples = 4;
  static constexpr int kMostRays = kMostSamples * kernel::kTileEdge * kernel::kTileEdge;
  /// Of a pixel's sample.
  static constexpr std::uint32_t ray_number(int sample, int x, int y) {
    return static_cast<std::uint32_t>((sample * kernel::kTileEdge + y) * kernel::kTileEdge + x);
  }
  glm::ivec2 origin{0};              ///< in the block, pixels
  int first_sample = 0;              ///< of all that the pixels get
  int sample_count = 1;              ///< 1 to kMostSamples
  glm::vec2 offset[kMostSamples]{};  ///< of the samples from the pixels' centres
  LaneList list;

  glm::vec4* sums = nullptr;      ///< of the block: gets the samples' sum added; or nullptr
  ray_cast::Hit* hits = nullptr;  ///< of the block: gets those of the first sample; or nullptr
  LaneSamples samples;            ///< of the block, for one sample; its pointers may be nullptr all together
  /// Likewise, of layers: the first thing along each ray that is not quite transparent. Where that lets light through,
  /// `color` is its own, not premultiplied, and its opacity; else 0.
  LaneSamples front;
};

/// A point where a ray meets something: what layers are made of.
struct LayerHit {
  float t = 0.0f;
  std::uint32_t ray = 0;        ///< of the tile: LaneTile::ray_number()
  std::uint32_t layer = 0;      ///< for the host, which sets it
  std::uint32_t primitive = 0;  ///< kOnPlane where a plane cuts the layer
  std::uint32_t atom = 0;
  float facing = 0.0f;      ///< normal . direction of the ray: it goes into the solid where this is negative
  float depth = 0.0f;       ///< along the view axis, Å
  glm::vec4 color{0.0f};    ///< lit, linear, not premultiplied; alpha: opacity
  glm::vec3 normal{0.0f};   ///< towards the solvent
  float visibility = 1.0f;  ///< LaneSamples::visibility
};

/// Room for hits; the kernels ask for more of it.
struct LayerHits {
  LayerHit* hits = nullptr;
  std::uint32_t count = 0, capacity = 0;
  void (*grow)(LayerHits& full) = nullptr;
};

/// Where a ray of a tile goes into the half-spaces of its layer and out of them; `out` <= `in`: it stays outside.
struct ClippedRay {
  float in = 0.0f, out = 0.0f;
  std::uint32_t in_plane = kNoPlane, out_plane = kNoPlane;  ///< of LayerTask::planes
  static constexpr std::uint32_t kNoPlane = ~0u;            ///< the camera; far away
};

/// How a layer is cast: a scene whose solids are cut by planes, or seen through.
struct LayerTask {
  const glm::vec4* planes = nullptr;  ///< kept is where dot(xyz, x) < w, relative to the pivot
  int plane_count = 0;
  bool all = false;                 ///< every hit; else the nearest of each ray
  bool has_caps = false;            ///< where a ray meets its solid from inside behind a plane, that is not seen
  bool thickens = false;            ///< opacity grows where a ray goes along the surface, as in a thin film
  const float* farthest = nullptr;  ///< for each ray of the tile, what may still be seen; nullptr: everything
  ClippedRay* clipped = nullptr;    ///< gets, for each ray of the tile, where its planes cut it
};

/// What a look makes of one sample of each pixel of a block. Arrays of pixels, those of `samples` too, have one more
/// after the last: it stands for whatever lies outside.
struct LaneLook {
  kernel::BlockView view{};
  kernel::OcclusionParameters occlusion{};
  kernel::FinishParameters finish{};
  LaneSamples samples;
  const float* shade_map = nullptr;    ///< depths of the whole picture, for occlude_row
  const float* shade_depth = nullptr;  ///< of the sample whose visibility this is
  float* shade_size = nullptr;         ///< of a pixel at that depth, Å
  float* visibility = nullptr;
  glm::vec4* sums = nullptr;  ///< gets the finished colours added
  float* ink = nullptr;       ///< gets the share of each pixel that lines cover; or nullptr
};

/// The kernels for one width.
struct LaneKernels {
  int lanes;
  void (*cast_tile)(const LaneScene& scene, const LaneTile& tile);
  /// Adds what the tile's rays meet to `hits`, in any order; the tile's own arrays are left alone.
  void (*cast_layer)(const LaneScene& scene, const LaneTile& tile, const LayerTask& task, LayerHits& hits);
  /// Lights points on planes, whose t, ray, normal and colour are given; sets their depth.
  void (*light_points)(const LaneScene& scene, const LaneTile& tile, LayerHit* points, std::uint32_t count);
  /// What points, relative to the pivot, see of light.sky, all of it; normals towards the solvent.
  void (*see_sky)(const LaneLight& light, const glm::vec3* points, const glm::vec3* normals, float* seen,
                  std::uint32_t count);
  void (*measure_row)(const LaneLook& look, int y);  ///< what pixels measure at their shade's depth, into shade_size
  void (*occlude_row)(const LaneLook& look, int y);  ///< what hits see of the sky, into visibility
  void (*finish_row)(const LaneLook& look, int y);   ///< needs the visibility and size of two rows around
};

/// For 4, 8 (AVX2) and 16 (AVX-512) lanes; nullptr where this processor cannot run them.
const LaneKernels* kernels_of_4_lanes();
const LaneKernels* kernels_of_8_lanes();
const LaneKernels* kernels_of_16_lanes();

/// The widest that this processor can run, of those with at most so many lanes.
const LaneKernels& widest_kernels(int most_lanes);

}  // namespace meniscus
