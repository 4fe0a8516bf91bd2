// SPDX-License-Identifier: BSD-3-Clause
// How far what a picture shows moves in it until the next frame of its run.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "core/camera/camera.h"
#include "core/mesh/velocity.h"
#include "core/render/picture.h"

namespace meniscus {

struct SurfaceObject;

/// The motion of a figure from one frame to the next.
struct FigureMotion {
  std::vector<glm::dvec3> atoms;  ///< of shown_atoms(): to where each is then, Å
  Camera camera;                  ///< by which that frame is seen
};

/// The ways of merged(objects).surface.atoms. atoms: those of shown_atoms().
std::vector<glm::dvec3> placed_ways(std::span<const SurfaceObject> objects, std::span<const glm::dvec3> atoms);

/// The points of one picture. Points of a surface move as SurfaceVelocity says, those of shapes and caps as their atom.
class PointMotion {
 public:
  /// motion: must stay.
  PointMotion(const FigureMotion& motion, const Camera& camera, glm::ivec2 size)
      : motion_(motion), camera_(camera), size_(size) {}

  /// The next object of the picture: a surface with the ways of its atoms, or shapes. It must stay.
  void add(const Surface& surface, std::span<const glm::dvec3> atoms);
  void add_shapes() { objects_.emplace_back(); }

  /// Returns the motion of a point in pixels, to the right and upwards.
  glm::vec2 at(const SeenPoint& point) const;

 private:
  struct Object {
    std::vector<glm::dvec3> atoms;
    std::vector<SurfaceVelocity> surface;  // one, or none
  };

  const FigureMotion& motion_;
  const Camera camera_;
  const glm::dvec2 size_;
  std::vector<Object> objects_;
};

}  // namespace meniscus
