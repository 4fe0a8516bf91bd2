// SPDX-License-Identifier: BSD-3-Clause
// Checks what goes into a scene, gathers its colours in one order, and writes its folder.
#include "exporters/povray/povray_scene.h"

#include "core/base/error.h"
#include "core/base/text.h"
#include "exporters/povray/povray_files.h"
#include "exporters/povray/scene_shapes.h"
#include "exporters/povray/scene_text.h"
#include "exporters/povray/surface_pieces.h"

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

namespace {

void include_shapes(const ColoredShapes& shapes, Box& extent) {
  for (const Ball& ball : balls_around(shapes.shapes)) {
    extent.include(ball.center - ball.radius);
    extent.include(ball.center + ball.radius);
  }
}

/// Returns the box of everything that the scene shows.
Box scene_extent(std::span<const SurfaceObject> objects, const SceneOptions& options) {
  Box extent = atom_extent(objects);
  if (options.shapes) include_shapes(*options.shapes, extent);
  for (const SceneObject& object : options.objects) {
    if (object.surface) {
      const Box box = atom_extent({object.surface, 1});
      extent.include(box.low);
      extent.include(box.high);
    }
    if (object.shapes) include_shapes(*object.shapes, extent);
  }
  return extent;
}

}  // namespace

SceneReport write_scene(std::span<const SurfaceObject> given, const Camera& camera, const SceneOptions& options,
                        const std::filesystem::path& folder) {
  check(given, options);
  const Box extent = scene_extent(given, options);
  const glm::dvec3 origin = options.origin ? *options.origin : middle(given.empty() ? extent : atom_extent(given));
  ColorTable table;
  const Shown shown{given, options.cut, options.shapes, options.objects, options.atom_names};
  const SceneContent content(shown, camera, options, origin, table);
  const Geometry& geometry = content.geometry();
  const bool has_surface = geometry.primitive_count() > 0;
  const SceneParts parts{has_surface,          geometry.is_one_item(), has_surface && content.has_caps(),
                         content.has_shapes(), table.is_translucent(), content.parts()};
  if (content.primitive_count() == 0 && !content.has_shapes() && options.objects.empty())
    throw RequestError("no part of the surface is shown, so there is no scene to write");

  OutputFolder output(folder, options.existing);
  SceneReport report;
  const auto begin_file = [&](const std::string& ending) -> OutputFile& {
    report.files.push_back(folder / (options.name + ending));
    return output.file(options.name + ending);
  };
  content.write(parts,
                [&](const std::string& part) -> OutputFile& { return begin_file(fmt::format("_{}.inc", part)); });
  const SceneStyle style{&table.colors(), content.map(), materials_of(options.objects)};
  if (style.map) {
    OutputFile& file = begin_file(std::string(kMapFileEnding));
    write_density(style.map->grid, [&](std::string_view bytes) { file.write(bytes); });
  }
  const std::string buffers = buffer_text(&table.colors(), options, extent, origin);
  const std::string styles = style_text(style, options, origin);
  const std::string main = main_text({&camera, 1}, options, origin, parts);
  begin_file("_aov.inc").write(buffers);
  begin_file("_style.inc").write(styles);
  begin_file(".pov").write(main);
  begin_file(".inc").write(own_scene_text(options.name, std::array<std::string_view, 3>{main, styles, buffers}));
  begin_file(".ini").write(ini_text(options));
  begin_file("_objects.json").write(geometry.names_json(options.colors));
  output.commit();

  report.object_count = content.primitive_count();
  report.origin = origin;
  report.notes = notes(content.objects(), geometry, camera);
  report.command = fmt::format("cd {} && povray {}.ini", shell_word(folder.string()), options.name);
  return report;
}

}  // namespace meniscus::povray
