// SPDX-License-Identifier: BSD-3-Clause
// Writes the scene of one surface.
#include "exporters/povray/scene.h"

#include <fmt/format.h>

#include "exporters/povray/cut_objects.h"
#include "exporters/povray/geometry.h"
#include "exporters/povray/scene_files.h"
#include "core/base/text.h"
#include "exporters/povray/scene_report.h"

namespace meniscus::povray {

SceneReport write_scene(std::span<const SurfaceObject> given, const Camera& camera, const SceneOptions& options,
                        const std::filesystem::path& folder) {
  check(given, options);
  const CutObjects cut(given, options.cut, camera, options);
  const std::span<const SurfaceObject> objects = cut.objects();
  Box extent = atom_extent(objects);
  const glm::dvec3 origin = options.origin ? *options.origin : middle(extent);
  Geometry geometry(objects, origin, {}, options.shapes, options.cut.planes);
  if (cut.has_caps()) geometry.add_caps(cut.caps(), objects, options.cut);
  if (geometry.has_shapes()) {
    for (const Ball& ball : balls_around(options.shapes->shapes)) {
      extent.include(ball.center - ball.radius);
      extent.include(ball.center + ball.radius);
    }
  }

  OutputFolder output(folder, options.existing);
  SceneReport report;
  const auto begin_file = [&](const std::string& ending) -> OutputFile& {
    report.files.push_back(folder / (options.name + ending));
    return output.file(options.name + ending);
  };
  geometry.write(begin_file("_geometry.inc"));
  if (cut.has_caps()) geometry.write_caps(begin_file("_caps.inc"), options.cut);
  if (geometry.has_shapes()) geometry.write_shapes(begin_file("_shapes.inc"));
  begin_file("_aov.inc").write(buffer_text(geometry.colors().size(), extent, origin));
  begin_file("_style.inc").write(style_text(geometry.colors(), options));
  begin_file(".pov").write(
      main_text({&camera, 1}, options, origin,
                {geometry.is_one_item(), cut.has_caps(), geometry.has_shapes(), geometry.is_translucent()}));
  begin_file(".ini").write(ini_text(options));
  begin_file("_objects.json").write(geometry.names_json(options.colors));
  output.commit();

  report.object_count = geometry.primitive_count();
  report.origin = origin;
  report.notes = notes(objects, geometry, camera);
  report.command = fmt::format("cd {} && povray {}.ini", shell_word(folder.string()), options.name);
  return report;
}

}  // namespace meniscus::povray
