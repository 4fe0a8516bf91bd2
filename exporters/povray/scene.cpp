// SPDX-License-Identifier: BSD-3-Clause
// Writes the scene of one surface.
#include "exporters/povray/scene.h"

#include <optional>
#include <utility>

#include <fmt/format.h>

#include "core/base/error.h"

#include "exporters/povray/cap_objects.h"
#include "exporters/povray/geometry.h"
#include "exporters/povray/scene_files.h"
#include "core/base/text.h"
#include "exporters/povray/scene_report.h"
#include "exporters/povray/shape_objects.h"
#include "exporters/povray/volume_map.h"

namespace meniscus::povray {
namespace {

/// One more object, ready to be written.
struct ObjectWriter {
  const SceneObject* object;
  ObjectStyle style;
  std::optional<CutObjects> cut;
  std::optional<Geometry> geometry;  ///< of a surface
};

void include_shapes(const ColoredShapes& shapes, Box& extent) {
  for (const Ball& ball : balls_around(shapes.shapes)) {
    extent.include(ball.center - ball.radius);
    extent.include(ball.center + ball.radius);
  }
}

const VolumePaint* map_of(std::span<const SurfaceObject> objects, std::span<const SceneObject> more) {
  for (const SurfaceObject& object : objects)
    if (object.coloring.volume) return object.coloring.volume.get();
  for (const SceneObject& object : more)
    if (object.surface && object.surface->coloring.volume) return object.surface->coloring.volume.get();
  return nullptr;
}

/// Of all that is shown.
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
  const CutObjects cut(given, options.cut, camera, options);
  const std::span<const SurfaceObject> objects = cut.objects();
  const Box extent = scene_extent(objects, options);
  const glm::dvec3 origin = options.origin ? *options.origin : middle(objects.empty() ? extent : atom_extent(objects));
  ColorTable table;
  Geometry geometry(objects, origin, table, {options.film, 0}, options.cut.planes, options.atom_names);
  const bool has_shapes = options.shapes && !options.shapes->empty();
  if (has_shapes) add_colors(*options.shapes, table);
  if (cut.has_caps()) geometry.add_caps(cut.caps(), objects, options.cut, table);
  std::vector<ObjectWriter> more(options.objects.size());
  SceneParts parts{geometry.primitive_count() > 0, geometry.is_one_item(),
                   geometry.primitive_count() > 0 && cut.has_caps(), has_shapes, false};
  SceneStyle style{&table.colors(), map_of(objects, options.objects)};
  std::size_t primitives = geometry.primitive_count();
  for (std::size_t n = 0; n < more.size(); ++n) {
    ObjectWriter& writer = more[n];
    writer.object = &options.objects[n];
    writer.style.film = writer.object->film;
    if (!writer.object->material.empty()) {
      style.materials.push_back(writer.object->material);
      writer.style.finish = static_cast<std::uint32_t>(style.materials.size());
    }
    ObjectPart part{writer.object->surface != nullptr};
    if (writer.object->shapes) add_colors(*writer.object->shapes, table, writer.style);
    if (writer.object->surface) {
      writer.cut.emplace(std::span(writer.object->surface, 1), writer.object->cut, camera, options);
      writer.geometry.emplace(writer.cut->objects(), origin, table, writer.style, writer.object->cut.planes,
                              options.atom_names);
      if (writer.cut->has_caps())
        writer.geometry->add_caps(writer.cut->caps(), writer.cut->objects(), writer.object->cut, table);
      part.single = writer.geometry->is_one_item() && !writer.cut->has_caps();
      primitives += writer.geometry->primitive_count();
    }
    parts.objects.push_back(part);
  }
  parts.translucent = table.is_translucent();
  if (primitives == 0 && !has_shapes && more.empty())
    throw RequestError("nothing of the surface is shown, so there is no scene to write");

  OutputFolder output(folder, options.existing);
  SceneReport report;
  const auto begin_file = [&](const std::string& ending) -> OutputFile& {
    report.files.push_back(folder / (options.name + ending));
    return output.file(options.name + ending);
  };
  if (parts.surface) geometry.write(begin_file("_geometry.inc"));
  if (parts.caps) geometry.write_caps(begin_file("_caps.inc"), options.cut);
  if (has_shapes) write_shapes(begin_file("_shapes.inc"), *options.shapes, origin, table);
  for (std::size_t n = 0; n < more.size(); ++n) {
    OutputFile& file = begin_file(fmt::format("_object_{}.inc", n + 1));
    const ObjectWriter& writer = more[n];
    if (writer.object->shapes) write_shapes(file, *writer.object->shapes, origin, table, writer.style);
    if (!writer.geometry) continue;
    writer.geometry->write(file);
    if (writer.cut->has_caps()) writer.geometry->write_caps(file, writer.object->cut);
  }
  if (style.map) {
    OutputFile& file = begin_file(std::string(kMapFileEnding));
    write_density(style.map->grid, [&](std::string_view bytes) { file.write(bytes); });
  }
  begin_file("_aov.inc").write(buffer_text(&table.colors(), options, extent, origin));
  begin_file("_style.inc").write(style_text(style, options, origin));
  begin_file(".pov").write(main_text({&camera, 1}, options, origin, parts));
  begin_file(".ini").write(ini_text(options));
  begin_file("_objects.json").write(geometry.names_json(options.colors));
  output.commit();

  report.object_count = primitives;
  report.origin = origin;
  report.notes = notes(objects, geometry, camera);
  report.command = fmt::format("cd {} && povray {}.ini", shell_word(folder.string()), options.name);
  return report;
}

}  // namespace meniscus::povray
