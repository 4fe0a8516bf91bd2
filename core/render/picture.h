// SPDX-License-Identifier: BSD-3-Clause
// A finished picture in memory, a request for one, and the objects that it shows, for all devices.
#pragma once

#include <array>

#include <glm/vec4.hpp>

#include "core/base/progress.h"
#include "core/math/ball.h"
#include "core/render/look.h"

namespace meniscus {

/// A picture, rows from the top, pixels from the left. All AOV arrays are empty unless requested.
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
  std::vector<std::uint32_t> object;     ///< index of the object if there are several; empty for one
  /// The displacement of the point to its place in the next frame, pixels to the right and upwards; 0 where nothing is
  /// hit.
  std::vector<glm::vec2> motion;

  /// The value of RenderSettings::name_seen for what each ray of a pixel meets, ray after ray; kNone where it meets
  /// nothing. Empty unless mattes are requested.
  std::vector<std::uint32_t> seen;

  /// Values of `kind` in addition to PatchKind: a shape, and a plane that cuts a surface.
  static constexpr std::uint32_t kShape = 3, kCap = 4;
};

/// The layers of a picture in addition to colour.
struct PictureLayers {
  PictureLayers(bool has_aovs = false, bool has_motion = false, int rays_of_seen = 0)
      : aovs(has_aovs), motion(has_motion), rays(rays_of_seen) {}

  bool aovs, motion;  ///< true if there are AOVs (numbers of atoms, depths, ...), and the motion of points
  int rays;           ///< rays per pixel in Framebuffer::seen; 0: it is empty
};

/// Returns the layers that a picture has.
inline PictureLayers layers_of(const Framebuffer& picture) {
  return {!picture.z.empty(), !picture.motion.empty(),
          picture.seen.empty() ? 0 : static_cast<int>(picture.seen.size() / picture.color.size())};
}

/// A point that a ray has met.
struct SeenPoint {
  std::uint32_t object = 0, atom = 0;  ///< see StillRenderer::render()
  std::uint32_t kind = 0;              ///< see Framebuffer::kind
  std::uint32_t patch = 0;             ///< index in the surface's table of that kind; undefined for shapes and caps
  glm::dvec3 position{0.0}, normal{0.0, 0.0, 1.0};
};

/// Settings of a picture. Members for render() have no effect on draw().
struct RenderSettings {
  glm::ivec2 size{1024, 768};  ///< pixels
  int samples = 1;             ///< rays per pixel, the first through its centre
  /// True: the CPU casts further samples only where the first ones are uneven (core/render/cpu/unevenness.h).
  bool adaptive = false;
  bool aovs = false;      ///< render(): fill the AOV arrays, too; for drawables with a surface()
  bool mattes = false;    ///< render(): fill Framebuffer::seen by name_seen; made on the CPU
  bool motion = false;    ///< render(), with aovs: fill Framebuffer::motion by `move`
  int block_edge = 2048;  ///< render(): larger pictures are cast in blocks of at most this edge, pixels
  Look look;              ///< draw() shows its background; render() leaves it transparent
  StageTiming timing = StageTiming::rough;
  /// The function that render() on the CPU calls regularly on the calling thread with the finished share, from 0 to 1.
  /// If it throws, the picture is not finished.
  std::function<void(double share)> progress{};
  /// render() passes the picture to it in bands of whole rows, from the top, so that it is never in memory as a whole.
  /// The picture that render() returns has its size and no pixels. A band is a picture of its own with rows from
  /// `first_row` on; its pixels equal those pixels of the whole picture. If it throws, the picture is not finished.
  std::function<void(Framebuffer band, int first_row)> take_band{};
  /// Returns the value of Framebuffer::seen for an atom of an object. Any thread may call it.
  std::function<std::uint32_t(std::uint32_t object, std::uint32_t atom)> name_seen{};
  /// Returns the value of Framebuffer::motion for a point. Any thread may call it.
  std::function<glm::vec2(const SeenPoint& point)> move{};

  PictureLayers layers() const { return {aovs, aovs && motion, mattes ? samples : 0}; }
};

/// The part of a surface that is computed for a picture.
enum class Extent {
  complete,  ///< the whole surface
  visible,   ///< the part that can affect a pixel (theorem 2): the same picture
  paper      ///< the selection of Krone, Dachsbacher & Ertl 2010: faces in deep clefts may be missing
};

struct Coloring;
struct Shapes;
struct Surface;

/// A plane that cuts away everything behind it: points with dot(normal, x) >= offset.
struct ClipPlane {
  glm::dvec3 normal{0.0, 0.0, 1.0};  ///< unit vector
  double offset = 0.0;               ///< Å
};

/// The appearance of the solid where a plane cuts it.
struct CapStyle {
  std::optional<glm::vec3> color;  ///< sRGB; nothing: the colour of the atom with the nearest van der Waals sphere
  double hatching = 0.0;           ///< distance of dark lines on the cap, Å; 0: none
};

/// Returns the direction across the lines of hatching, of length √2. In units of CapStyle::hatching along it, a line
/// begins at each whole number and is kHatchedShare wide. On a line linear light is multiplied by kHatchedLight.
glm::dvec3 hatching_direction(const glm::dvec3& normal);
inline constexpr double kHatchedShare = 0.3;
inline constexpr float kHatchedLight = 0.35f;

/// A surface or shapes with their colours. The data behind its pointers must exist until the picture is finished.
struct PictureObject {
  const Surface* surface = nullptr;  ///< the surface; nullptr if there are shapes
  const Shapes* shapes = nullptr;    ///< the shapes; nullptr if there is a surface
  /// One colour for each of Surface::atoms, or, for shapes, of Structure::atoms.
  const Coloring* coloring = nullptr;
  /// The part before all of these planes is kept. Where they cut the solid there are caps.
  std::vector<ClipPlane> clip;
  CapStyle cap;
  /// True if the opacity of a transparent surface is that of a thin film, so it is higher where a ray is nearly
  /// tangential.
  bool thickens = false;
  MaterialRequest material;  ///< differences from the look's material
};

/// Returns the objects of a picture of one complete surface.
inline std::array<PictureObject, 1> whole_surface(const Surface& surface, const Coloring& coloring) {
  std::array<PictureObject, 1> objects;
  objects[0].surface = &surface;
  objects[0].coloring = &coloring;
  return objects;
}

/// True if the object can only be drawn by layers: it is cut, transparent, or consists of shapes.
bool needs_layers(const PictureObject& object);

/// Returns balls that enclose the objects: atoms of surfaces, spheres and ends of cylinders, and corners of meshes as
/// balls of radius 0.
std::vector<Ball> enclosing_balls(std::span<const PictureObject> objects);

/// Returns the same balls without those that planes cut away completely.
std::vector<Ball> kept_balls(std::span<const PictureObject> objects);

}  // namespace meniscus
