// SPDX-License-Identifier: BSD-3-Clause
// Writes the scene of one surface.
#include "exporters/povray/scene.h"

#include <array>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "core/base/error.h"

#include "core/base/text.h"
#include "exporters/povray/own_scene.h"
#include "exporters/povray/povray_files.h"
#include "exporters/povray/povray_scene.h"
#include "exporters/povray/scene_report.h"
#include "exporters/povray/volume_map.h"

namespace meniscus::povray {
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
