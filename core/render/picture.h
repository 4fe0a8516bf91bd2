// SPDX-License-Identifier: BSD-3-Clause
// A finished picture in memory, a request for one, and the objects that it shows, whatever device makes it.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "core/base/progress.h"
#include "core/math/ball.h"
#include "core/render/look.h"

namespace meniscus {

/// Rows from the top, pixels from the left. All AOV arrays are empty unless they were asked for.
struct Framebuffer {
  glm::ivec2 size{0};
  std::vector<glm::vec4> color;  ///< linear, alpha-premultiplied, alpha = share of the pixel's samples that hit

  /// Distance along the ray from the camera's position (orthographic: from the plane through it), Å; +inf: no hit.
  std::vector<float> z;
  std::vector<glm::vec3> normal;         ///< towards the solvent; 0 where nothing is hit
  std::vector<glm::vec3> position;       ///< Å; 0 where nothing is hit
  std::vector<std::uint32_t> atom;       ///< index into Surface::atoms, or kNone
  std::vector<std::uint32_t> kind;       ///< PatchKind, kShape, kCap, or kNone
  std::vector<std::uint32_t> component;  ///< index into Surface::components, or kNone
  std::vector<std::uint32_t> object;     ///< of several: which one; empty for one
  /// The displacement of the point from this picture to that of the next frame, pixels to the right and upwards; 0
  /// where nothing is hit.
  std::vector<glm::vec2> motion;

  /// The value of RenderSettings::name_seen for what each ray of a pixel meets, ray after ray; kNone where it meets
  /// nothing. Empty unless mattes are requested.
  std::vector<std::uint32_t> seen;

  /// Beyond PatchKind: on a shape beside a surface, on a plane that cuts one.
  static constexpr std::uint32_t kShape = 3, kCap = 4;
};

/// The layers of a picture besides colour.
struct PictureLayers {
  PictureLayers(bool has_aovs = false, bool has_motion = false, int rays_of_seen = 0)
      : aovs(has_aovs), motion(has_motion), rays(rays_of_seen) {}

  bool aovs, motion;
  int rays;  ///< of each pixel in Framebuffer::seen; 0: it is empty
};

/// Returns the layers that a picture has.
inline PictureLayers layers_of(const Framebuffer& picture) {
  return {!picture.z.empty(), !picture.motion.empty(),
          picture.seen.empty() ? 0 : static_cast<int>(picture.seen.size() / picture.color.size())};
}

/// A point that a ray has met.
struct SeenPoint {
  std::uint32_t object = 0, atom = 0;  ///< as StillRenderer::render() has them
  std::uint32_t kind = 0;              ///< as Framebuffer::kind
  std::uint32_t patch = 0;             ///< of that kind, in the tables of a surface; else of no meaning
  glm::dvec3 position{0.0}, normal{0.0, 0.0, 1.0};
};

/// How a picture is made.
struct RenderSettings {
  glm::ivec2 size{1024, 768};  ///< pixels
  int samples = 1;             ///< rays per pixel, the first through its centre
  bool aovs = false;           ///< of render(): fill the AOV arrays too; for drawables with a surface()
  bool mattes = false;         ///< of render(): fill Framebuffer::seen, with name_seen; made on the CPU
  bool motion = false;         ///< of render(), with aovs: fill Framebuffer::motion, with move
  int block_edge = 2048;       ///< of render(): larger pictures are cast in blocks of at most this edge, in pixels
  Look look;                   ///< its background is that of draw(); render() leaves it transparent
  StageTiming timing = StageTiming::rough;
  /// Of render() on the CPU: called now and then on the thread that asked for the picture, with the share of it that is
  /// cast, from 0 to 1; what it throws ends the picture.
  std::function<void(double share)> progress{};
  /// Of render(): takes the picture in bands of whole rows, from the top, so that it is never in memory as a whole;
  /// what render() returns has its size and no pixels. Bands are pictures of their own, of rows from `first_row` on,
  /// and have the same pixels as the whole picture. What it throws ends the picture.
  std::function<void(Framebuffer band, int first_row)> take_band{};
  /// Returns the value of Framebuffer::seen for an atom of an object. Any thread may call it.
  std::function<std::uint32_t(std::uint32_t object, std::uint32_t atom)> name_seen{};
  /// Returns the value of Framebuffer::motion for a point. Any thread may call it.
  std::function<glm::vec2(const SeenPoint& point)> move{};

  PictureLayers layers() const { return {aovs, aovs && motion, mattes ? samples : 0}; }
};

enum class Extent {
  complete,  ///< all of it
  visible,   ///< what can matter for a pixel (theorem 2): the same picture
  paper      ///< what Krone, Dachsbacher & Ertl 2010 select: faces in deep clefts may be missing
};

struct Coloring;
struct Shapes;
struct Surface;

/// What lies behind this plane is cut away: points with dot(normal, x) >= offset.
struct ClipPlane {
  glm::dvec3 normal{0.0, 0.0, 1.0};  ///< of length 1
  double offset = 0.0;               ///< Å
};

/// How the solid looks where a plane cuts it.
struct CapStyle {
  std::optional<glm::vec3> color;  ///< sRGB; nothing: that of the atom whose van der Waals sphere is nearest
  double hatching = 0.0;           ///< Å between dark lines on the cap; 0: none
};

/// Across the lines of hatching, of length √2. With the distance along it in units of CapStyle::hatching, a line begins
/// at each whole number and is kHatchedShare wide; there linear light is kHatchedLight of what it is beside them.
glm::dvec3 hatching_direction(const glm::dvec3& normal);
inline constexpr double kHatchedShare = 0.3;
inline constexpr float kHatchedLight = 0.35f;

/// A surface or shapes with their colours. What it points to must stay until the picture is made.
struct PictureObject {
  const Surface* surface = nullptr;  ///< this one,
  const Shapes* shapes = nullptr;    ///< or this
  /// One colour for each of Surface::atoms; for shapes, for each of Structure::atoms.
  const Coloring* coloring = nullptr;
  /// Kept is what lies before all of them; where they cut there are caps: sections of the solid within.
  std::vector<ClipPlane> clip;
  CapStyle cap;
  /// Where a ray goes along a surface that is seen through, it sees more of it: opacity is that of a thin film.
  bool thickens = false;
  MaterialRequest material;  ///< what differs from the look's
};

/// Returns the objects of a picture of one surface as it is.
inline std::array<PictureObject, 1> whole_surface(const Surface& surface, const Coloring& coloring) {
  std::array<PictureObject, 1> objects;
  objects[0].surface = &surface;
  objects[0].coloring = &coloring;
  return objects;
}

/// True if only layers show it as it is: cut, seen through, or shapes.
bool needs_layers(const PictureObject& object);

/// What encloses them: atoms of surfaces, spheres and ends of cylinders, corners of meshes as balls without size.
std::vector<Ball> enclosing_balls(std::span<const PictureObject> objects);

/// The same without what planes cut away as a whole.
std::vector<Ball> kept_balls(std::span<const PictureObject> objects);

}  // namespace meniscus
