// SPDX-License-Identifier: BSD-3-Clause
// Collects the colours of everything that a picture shows, in one order, and writes it file by file.
#include "exporters/povray/povray_scene.h"

#include <fmt/format.h>

#include "exporters/povray/shape_objects.h"

namespace meniscus::povray {

std::vector<MaterialRequest> materials_of(std::span<const SceneObject> objects) {
  std::vector<MaterialRequest> materials;
  for (const SceneObject& object : objects)
    if (!object.material.empty()) materials.push_back(object.material);
  return materials;
}

SceneContent::SceneContent(const Shown& shown, const Camera& camera, const SceneOptions& options,
                           const glm::dvec3& origin, ColorTable& table)
    : shown_(shown),
      origin_(origin),
      table_(table),
      cut_(shown.surface, shown_.cut, camera, options),
      geometry_(cut_.objects(), origin, table, {shown.film.value_or(options.film), 0}, shown_.cut.planes, shown.names) {
  if (has_shapes()) add_colors(*shown.shapes, table);
  if (cut_.has_caps()) geometry_.add_caps(cut_.caps(), cut_.objects(), shown_.cut, table);
  for (const SceneObject& object : shown.objects) add(object, camera, options);
}

void SceneContent::add(const SceneObject& object, const Camera& camera, const SceneOptions& options) {
  Further& further = further_.emplace_back();
  further.object = &object;
  further.style.film = object.film;
  if (!object.material.empty()) further.style.finish = ++finishes_;
  if (object.shapes) add_colors(*object.shapes, table_, further.style);
  if (!object.surface) return;
  further.cut.emplace(std::span(object.surface, 1), object.cut, camera, options);
  further.geometry.emplace(further.cut->objects(), origin_, table_, further.style, object.cut.planes, shown_.names);
  if (further.cut->has_caps())
    further.geometry->add_caps(further.cut->caps(), further.cut->objects(), object.cut, table_);
}

const VolumePaint* SceneContent::map() const {
  for (const SurfaceObject& object : cut_.objects())
    if (object.coloring.volume) return object.coloring.volume.get();
  for (const SceneObject& object : shown_.objects)
    if (object.surface && object.surface->coloring.volume) return object.surface->coloring.volume.get();
  return nullptr;
}

std::vector<ObjectPart> SceneContent::parts() const {
  std::vector<ObjectPart> parts;
  for (const Further& further : further_)
    parts.push_back({further.object->surface != nullptr,
                     further.geometry && further.geometry->is_one_item() && !further.cut->has_caps()});
  return parts;
}

std::size_t SceneContent::primitive_count() const {
  std::size_t count = geometry_.primitive_count();
  for (const Further& further : further_)
    if (further.geometry) count += further.geometry->primitive_count();
  return count;
}

void SceneContent::write(const SceneParts& parts, const BeginFile& begin_file, std::string_view head) const {
  if (parts.surface) geometry_.write(begin_file("geometry"), head);
  if (parts.caps) geometry_.write_caps(begin_file("caps"), shown_.cut);
  if (parts.shapes) write_shapes(begin_file("shapes"), *shown_.shapes, origin_, table_);
  std::size_t number = 0;
  for (const Further& further : further_) {
    OutputFile& file = begin_file(fmt::format("object_{}", ++number));
    if (further.object->shapes) write_shapes(file, *further.object->shapes, origin_, table_, further.style);
    if (!further.geometry) continue;
    further.geometry->write(file);
    if (further.cut->has_caps()) further.geometry->write_caps(file, further.object->cut);
  }
}

}  // namespace meniscus::povray
