// SPDX-License-Identifier: BSD-3-Clause
// A grey surface under one lamp, for tests of shadows and of shade.
#pragma once

#include <cstring>
#include <vector>

#include "core/queries/surface_object.h"
#include "core/render/cpu/cpu_renderer.h"
#include "core/surface/compute_surface.h"
#include "tests/support/molecules.h"

namespace meniscus {

inline constexpr glm::vec3 kGrey(0.8f);

/// A grey surface seen through the centres of pixels, under a sharp lamp that gives all of its light.
struct Subject {
  Surface surface;
  Coloring coloring;
  Camera camera;
  RenderSettings settings;
  std::vector<PictureObject> objects;

  explicit Subject(const testing::Balls& balls, double probe_radius = 1.4)
      : surface(compute_surface_cpu(balls, probe_radius)), camera(frame_camera(surface.atoms, 4.0 / 3.0)) {
    coloring.atom.assign(surface.atoms.size(), kGrey);
    settings.size = {160, 120};
    settings.aovs = true;
    settings.look.material = {.ambient = 1.0f, .roughness = 0.0f, .specular = 0.0f};
    settings.look.shadows = 1.0f;
    PictureObject& object = objects.emplace_back();
    object.surface = &surface;
    object.coloring = &coloring;
  }
  Subject(const Subject&) = delete;
  Subject& operator=(const Subject&) = delete;

  Framebuffer picture() const { return CpuRenderer().render(objects, camera, settings); }
  glm::dvec3 lamp() const {
    const ViewBasis basis = view_basis(camera);
    const glm::dvec3 l = glm::normalize(glm::dvec3(settings.look.light_direction));
    return basis.right * l.x + basis.up * l.y - basis.forward * l.z;
  }
};

/// Returns whether two pictures have the same colours to the last bit.
inline bool same_bits(const Framebuffer& a, const Framebuffer& b) {
  return a.color.size() == b.color.size() &&
         std::memcmp(a.color.data(), b.color.data(), a.color.size() * sizeof a.color[0]) == 0;
}

}  // namespace meniscus
