// SPDX-License-Identifier: BSD-3-Clause
// Declares the inner loops of pictures on the CPU, compiled for vectors of several widths, their data, and which wide
// instructions this processor has.
#pragma once

#include <bit>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#if defined(__x86_64__)
#include <cpuid.h>
#include <immintrin.h>
#endif

#include "core/gpu/kernel_records.h"
#include "core/render/gpu_pack.h"

namespace meniscus {

struct VolumePaint;

/// Colours points by a volume map. It is called from the kernels, for visible points only, and is compiled outside of
/// them.
struct PointPaint {
  const VolumePaint* map = nullptr;           ///< nullptr: points have the colours of atoms
  glm::dvec3 pivot{0.0};                      ///< Å, the origin of positions
  const std::uint8_t* keeps_color = nullptr;  ///< 1 for each atom that keeps its own colour
};

/// Returns the linear colour of a point of this atom. x: Å from the pivot; normal: towards the solvent.
glm::vec3 painted(const PointPaint& paint, std::uint32_t atom, const glm::vec4& atom_color, const glm::vec3& x,
                  const glm::vec3& normal);

/// A box of a tree over the primitives of an object; low and high are relative to the pivot.
struct OccluderBox {
  glm::vec3 low;
  /// The first index in LaneOccluder::order for a leaf; else the second child, because the first one follows.
  std::uint32_t first;
  glm::vec3 high;
  std::uint32_t count;  ///< number of a leaf's primitives; 0: the box has two children
};

struct LaneOccluder;

/// The light of a scene and its occluders. Directions are unit vectors towards the light in the molecule's axes. Each
/// sample of a pixel takes the directions that follow the previous sample's directions.
struct LaneLight {
  const LaneOccluder* occluders = nullptr;
  int occluder_count = 0;
  const glm::vec3* lamp = nullptr;  ///< directions over the disc of the key light
  int lamp_rays = 0;                ///< rays per sample; 0: the lamp casts no shadows
  float shadow = 0.0f;              ///< darkness of shadows, 0 to 1
  const glm::vec3* sky = nullptr;   ///< directions over the whole sphere
  int sky_rays = 0;                 ///< rays per sample; 0: visibility of the sky is not computed
  float sky_reach = 0.0f;           ///< Å, farther occluders are ignored
  float lift = 0.0f;                ///< Å, distance of the rays' origins from the surface
};

/// The scene that a tile's rays are traced through; see gpu_shaders/ray_cast/records.glsl.
struct LanePack {
  const ray_cast::Primitive* primitives = nullptr;
  const glm::vec4* rows = nullptr;
  const glm::vec4* colors = nullptr;  ///< linear, alpha: opacity, 0 if hidden; one for each atom, then for each kind
  const float* marks = nullptr;       ///< Coloring::line_marks() of atoms, or nullptr
  bool some_hidden = false;
  PointPaint paint;
  kernel::RayCastParameters params{};
  kernel::BlockView view{};          ///< its sample_offset is not used
  const LaneLight* light = nullptr;  ///< nullptr: light passes through everything
};

/// The opaque parts of one object, which block light. The scene of an occluder is not visible.
struct LaneOccluder {
  LanePack scene;
  const OccluderBox* boxes = nullptr;    ///< the first contains all others; nullptr: there are no primitives
  const std::uint32_t* order = nullptr;  ///< indices of its primitives
  const glm::vec4* planes = nullptr;     ///< see LayerTask::planes
  int plane_count = 0;
  glm::mat3 turn{1.0f};  ///< turn * x + shift is the place, in the object's own axes, of a point x of the picture
  glm::vec3 shift{0.0f};
  bool is_solid = false;   ///< true: where planes cut it there are caps
  bool is_opaque = false;  ///< true: all of it is opaque
};

/// A tile's primitives by increasing Primitive::nearest. Each array is followed by kListPadding entries that no ray
/// hits.
struct LaneList {
  static constexpr int kListPadding = 16;
  int count = 0;
  const float* x = nullptr;  ///< x of the centres of their bounds
  const float* y = nullptr;
  const float* z = nullptr;
  const float* radius = nullptr;
  const float* nearest = nullptr;
  const std::uint32_t* primitive = nullptr;
};

/// The properties of one sample of each pixel of a block, row by row.
struct LaneSamples {
  glm::vec4* color = nullptr;   ///< linear, premultiplied
  float* depth = nullptr;       ///< depth along the view axis, Å; kernel::kNothing where nothing is hit
  float* normal[3] = {};        ///< towards the solvent, in the molecule's axes
  float* visibility = nullptr;  ///< the share of the sky that it sees, from rays; nullptr: LaneLight::sky_rays is 0
  float* mark = nullptr;        ///< LanePack::marks of the hit atom, otherwise 0; nullptr if there are none
  glm::vec4* over = nullptr;    ///< transparent parts in front of the rest, premultiplied; nullptr: none
};

inline constexpr int kBundleEdge = 4;  ///< pixels; rays are cast in bundles of 4 x 4 pixels

/// Some samples of a tile's pixels.
struct LaneTile {
  static constexpr int kMostSamples = 4;
  static constexpr int kMostRays = kMostSamples * kernel::kTileEdge * kernel::kTileEdge;
  /// Returns the number of the ray of a pixel's sample.
  static constexpr std::uint32_t ray_number(int sample, int x, int y) {
    return static_cast<std::uint32_t>((sample * kernel::kTileEdge + y) * kernel::kTileEdge + x);
  }
  glm::ivec2 origin{0};              ///< place in the block, pixels
  int first_sample = 0;              ///< number of the first sample among all samples of a pixel
  int sample_count = 1;              ///< 1 to kMostSamples
  glm::vec2 offset[kMostSamples]{};  ///< offsets of samples from the pixels' centres
  LaneList list;
  const float* counts = nullptr;  ///< as Unevenness::counts(); bundles with 0 are not cast; nullptr: all are

  glm::vec4* sums = nullptr;      ///< pixels of the block, to which the sum of samples is added; or nullptr
  ray_cast::Hit* hits = nullptr;  ///< pixels of the block, which get the hits of the first sample; or nullptr
  LaneSamples samples;            ///< pixels of the block, for one sample; all of its pointers may be nullptr
  /// The samples of the first point along each ray that is not completely transparent. If it is partly transparent,
  /// `color` has its own colour, not premultiplied, and its opacity; otherwise `color` is 0.
  LaneSamples front;
};

/// A point where a ray hits something; the elements of layers.
struct LayerHit {
  float t = 0.0f;
  std::uint32_t ray = 0;        ///< number in the tile: LaneTile::ray_number()
  std::uint32_t layer = 0;      ///< set by the host, for its own use
  std::uint32_t primitive = 0;  ///< kOnPlane where a plane cuts the layer
  std::uint32_t atom = 0;
  float facing = 0.0f;      ///< dot(normal, direction of the ray): negative where the ray enters the solid
  float depth = 0.0f;       ///< depth along the view axis, Å
  glm::vec4 color{0.0f};    ///< lit colour, linear, not premultiplied; alpha: opacity
  glm::vec3 normal{0.0f};   ///< towards the solvent
  float visibility = 1.0f;  ///< LaneSamples::visibility
};

/// Memory for hits, which the kernels extend as needed.
struct LayerHits {
  LayerHit* hits = nullptr;
  std::uint32_t count = 0, capacity = 0;
  void (*grow)(LayerHits& full) = nullptr;
};

/// The interval of a ray of a tile in the half-spaces of its layer; if `out` <= `in` it is empty.
struct ClippedRay {
  float in = 0.0f, out = 0.0f;
  std::uint32_t in_plane = kNoPlane, out_plane = kNoPlane;  ///< indices in LayerTask::planes
  static constexpr std::uint32_t kNoPlane = ~0u;            ///< the camera, or infinity
};

/// The settings for casting a layer, which is a scene whose solids planes cut or that is transparent.
struct LayerTask {
  const glm::vec4* planes = nullptr;  ///< points with dot(xyz, x) < w, relative to the pivot, are kept
  int plane_count = 0;
  bool all = false;                 ///< true: every hit; false: the nearest hit of each ray
  bool has_caps = false;            ///< true: the inner side of a solid behind a plane is not visible
  bool thickens = false;            ///< true: opacity is that of a thin film, higher where a ray is nearly tangential
  const float* farthest = nullptr;  ///< greatest visible distance on each ray of the tile; nullptr: no limit
  ClippedRay* clipped = nullptr;    ///< receives the interval that the planes leave of each ray of the tile
};

/// The input and output of a look for one sample of each pixel of a block. Arrays of pixels, also in `samples`, have an
/// additional element at the end, which represents everything outside.
struct LaneLook {
  kernel::BlockView view{};
  const kernel::LightMapParameters* maps = nullptr;
  kernel::FinishParameters finish{};
  LaneSamples samples;
  const float* light_maps = nullptr;   ///< LightMaps::texels(), for occlude_square
  const float* shade_depth = nullptr;  ///< depths of the sample whose visibility this is
  float* shade_size = nullptr;         ///< size of a pixel at that depth, Å
  float* sky_seen = nullptr;           ///< shares of the sky and of the lamp that pixels see
  float* lamp_seen = nullptr;
  const float* counts = nullptr;  ///< as Unevenness::counts(); pixels with 0 are not finished; nullptr: all are
  glm::vec4* sums = nullptr;      ///< the finished colours are added to it
  float* ink = nullptr;           ///< receives the share of each pixel that lines cover; or nullptr
};

inline constexpr int kShadeEdge = 64;  ///< pixels; the shade of squares is computed together

/// The kernels for one width.
struct LaneKernels {
  int lanes;
  void (*cast_tile)(const LanePack& scene, const LaneTile& tile);
  /// Appends the points that the tile's rays hit to `hits`, in any order. The tile's own arrays do not change.
  void (*cast_layer)(const LanePack& scene, const LaneTile& tile, const LayerTask& task, LayerHits& hits);
  /// Lights points on planes, with t, ray, normal and colour given, and sets their depths.
  void (*light_points)(const LanePack& scene, const LaneTile& tile, LayerHit* points, std::uint32_t count);
  /// Computes the visible share of all of light.sky for points relative to the pivot; normals are towards the solvent.
  void (*see_sky)(const LaneLight& light, const glm::vec3* points, const glm::vec3* normals, float* seen,
                  std::uint32_t count);
  void (*measure_row)(const LaneLook& look, int y);  ///< writes pixel sizes at the shade's depth to shade_size
  /// Writes sky_seen and lamp_seen of a square of kShadeEdge, where there are maps for them.
  void (*occlude_square)(const LaneLook& look, glm::ivec2 corner);
  void (*finish_row)(const LaneLook& look, int y);  ///< reads the visibility and size of two rows around
};

/// Returns the kernels for 4, 8 (AVX2) and 16 (AVX-512) lanes; nullptr if this processor cannot run them.
const LaneKernels* kernels_of_4_lanes();
const LaneKernels* kernels_of_8_lanes();
const LaneKernels* kernels_of_16_lanes();

/// Returns the widest kernels with at most most_lanes lanes that this processor can run.
const LaneKernels& widest_kernels(int most_lanes);

#if defined(__x86_64__)
// The wide instructions of this processor are found here, because not every compiler's runtime has
// __builtin_cpu_supports().

/// Bits of EBX in leaf 7 of CPUID (Intel, Software Developer's Manual, volume 2A).
inline constexpr unsigned kAvx2 = 1u << 5;
inline constexpr unsigned kAvx512 = 1u << 16 | 1u << 17 | 1u << 30 | 1u << 31;  // F, DQ, BW and VL

/// True if the processor has all of them, and the system saves these registers of threads (`registers`: bits of XCR0).
inline bool processor_has(unsigned wanted, unsigned registers) {
  unsigned a = 0, b = 0, c = 0, d = 0;
  constexpr unsigned kOsSavesVectors = 1u << 27;  // OSXSAVE
  if (!__get_cpuid(1, &a, &b, &c, &d) || !(c & kOsSavesVectors)) return false;
  std::uint32_t kept = 0, upper = 0;
  __asm__ volatile("xgetbv" : "=a"(kept), "=d"(upper) : "c"(0));
  return (kept & registers) == registers && __get_cpuid_count(7, 0, &a, &b, &c, &d) && (b & wanted) == wanted;
}

inline bool processor_has_avx2() { return processor_has(kAvx2, 0x06); }      // registers of 128 and 256 bits
inline bool processor_has_avx512() { return processor_has(kAvx512, 0xe6); }  // registers of 512 bits and masks, too
#endif

}  // namespace meniscus
