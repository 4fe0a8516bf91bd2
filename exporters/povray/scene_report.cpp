// SPDX-License-Identifier: BSD-3-Clause
// Checks the objects and options of a scene, and composes notes for its report.
#include "exporters/povray/scene_report.h"

#include <algorithm>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "core/base/error.h"

namespace meniscus::povray {
namespace {

constexpr std::size_t kMemoryWarningObjects = 2'000'000;  // about 3.5 GB in POV-Ray 3.7

}  // namespace

Box atom_extent(std::span<const SurfaceObject> objects) {
  Box box;
  for (const SurfaceObject& object : objects)
    for (const RigidMotion& copy : object.copies)
      for (const Ball& b : object.surface.atoms) {
        box.include(copy(b.center) - b.radius);
        box.include(copy(b.center) + b.radius);
      }
  return box;
}

void check(std::span<const SurfaceObject> objects, const SceneOptions& options) {
  const auto allowed = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
  };
  bool name_is_plain = !options.name.empty();
  for (const char c : options.name) name_is_plain = name_is_plain && allowed(c);
  if (!name_is_plain) throw Error("POV-Ray export: a scene's name has only letters, digits, '-' and '_'");
  if (options.width < 1 || options.height < 1) throw Error("POV-Ray export: a picture has at least one pixel");
  for (const SurfaceObject& object : objects)
    if (object.surface.atoms.empty()) throw Error("POV-Ray export: there is no atom");
}

glm::dvec3 middle(const Box& extent) { return glm::round((extent.low + extent.high) * 0.5e3) / 1e3; }

std::vector<std::string> notes(std::span<const SurfaceObject> objects, const Geometry& geometry, const Camera& camera) {
  std::vector<std::string> sentences;
  // Rays of an orthographic camera begin on the plane through it, in POV-Ray as in the ray caster.
  const glm::dvec3 forward = view_basis(camera).forward;
  std::size_t behind = 0, cut_away = 0;
  for (const SurfaceObject& object : objects) {
    for (const RigidMotion& copy : object.copies)
      behind += static_cast<std::size_t>(std::ranges::count_if(object.surface.atoms, [&](const Ball& b) {
        return glm::dot(copy(b.center) - camera.position, forward) < b.radius;
      }));
    for (const ConcavePatch& c : object.surface.concave) cut_away += c.face_count == 0;
  }
  if (camera.projection == Projection::orthographic && behind > 0)
    sentences.push_back(fmt::format("{} atoms reach behind the orthographic camera and are cut off there", behind));
  if (cut_away > 0)
    sentences.push_back(
        fmt::format("{} fixed probes have no object: other probes cut all of their patch away", cut_away));
  const std::size_t primitives = geometry.primitives_in_memory();
  if (primitives > kMemoryWarningObjects)
    sentences.push_back(fmt::format("{} primitives, copies included, need about {} GB of memory in POV-Ray", primitives,
                                    primitives * 18 / 10'000'000));
  return sentences;
}

}  // namespace meniscus::povray
