// SPDX-License-Identifier: BSD-3-Clause
// Maps of what is drawn as the sky and the lamp see it, from which pictures get their shade and soft shadows.
#pragma once

#include "core/gpu/kernel_records.h"
#include "core/render/look.h"
#include "core/render/picture.h"
#include "core/render/ray_cast_pack.h"

namespace meniscus {

struct Shapes;
struct SurfaceObject;

/// The finest texels of a kind of maps, Å, and the edge of the largest maps, texels.
struct LightMapSize {
  double finest_texel;
  int largest_edge;
};
inline constexpr LightMapSize kSkyMapSize{0.4, 384}, kLampMapSize{0.35, 768};
inline constexpr int kLightMapMargin = 3;       ///< empty texels around everything
inline constexpr double kLightMapStep = 0.3;    ///< largest distance between the balls of a stick or a mesh, Å
inline constexpr double kMeshBallRadius = 0.1;  ///< Å; the balls of a mesh touch it from inside, also in thin plates

/// Returns a point of the R2 sequence (Roberts 2018) in the square [0, 1)².
glm::dvec2 r2_point(std::size_t index);

/// Returns unit vectors towards `count` places on the look's lamp. basis: axes of the camera, with which it moves.
std::vector<glm::dvec3> lamp_directions(const Look& look, const ViewBasis& basis, std::size_t count);

/// The maps of gpu_shaders/look/light_maps.glsl. Surfaces block light as the balls of their atoms. Hidden and cut parts
/// do not block light. A blocker of a share of the light is drawn in that share of the maps.
class LightMaps {
 public:
  /// Begins a picture without objects.
  void begin() { groups_.clear(); }
  /// Adds an object.
  void add(const PictureObject& object);
  /// Adds each copy of a surface.
  void add(const SurfaceObject& object);
  /// Adds the balls of a surface. blocking: the share of the light that each ball blocks, in [0, 1].
  void add(std::span<const Ball> balls, const std::vector<float>& blocking);

  /// Makes the maps of everything that was added. Maps of the sky are kept as long as the objects do not change.
  /// basis: axes of the camera, with which the lamp moves.
  void make(const Look& look, const ViewBasis& basis);

  /// Returns the maps one after another, for light_texel(); empty unless the look needs maps.
  const std::vector<float>& texels() const { return texels_; }
  /// Returns the places of the maps in a picture.
  kernel::LightMapParameters parameters(const PictureFrame& frame) const;

 private:
  /// A ball and the share of the light that it blocks, above 0.
  struct Blocker : Ball {
    float share;
  };
  /// Blockers that the same planes cut.
  struct Group {
    std::vector<Blocker> balls;
    std::vector<ClipPlane> planes;

    bool has_planes_of(const Group& other) const;
  };
  /// The axes of a map.
  struct View {
    glm::dvec3 right, up, axis;
  };
  /// The place of a map, and of the one that looks the other way.
  struct Raster {
    double texel;        // Å
    int edge;            // texels
    double least_share;  // least share of the light that a ball in these maps blocks
    float* along;        // texels
    float* against;      // nullptr: none
  };

  static View view_along(const glm::dvec3& axis);
  static bool same(const Group& a, const Group& b);
  static void add_shapes(const Shapes& shapes, const std::vector<float>& blocking, std::vector<Blocker>& balls);
  /// Orders the balls by their places. By rounding, the share that edges cover of a texel depends on the order of
  /// drawing, and a saved scene may have another order of objects.
  void put_in_order();
  void place_sky(int axes);
  void draw(const View& view, const Raster& raster) const;

  std::vector<Group> groups_, drawn_;                ///< groups of this picture, and of the maps of the sky
  glm::dvec3 middle_{0.0};                           ///< middle of all balls, Å
  std::vector<View> views_;                          ///< views along the sky's axes, then from the lamp's places
  int sky_axes_ = 0, sky_edge_ = 0, lamp_edge_ = 0;  ///< edges: texels
  double sky_texel_ = 1.0, lamp_texel_ = 1.0;        ///< Å
  std::vector<float> texels_;
};

}  // namespace meniscus
