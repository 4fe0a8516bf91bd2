// SPDX-License-Identifier: BSD-3-Clause
// Puts a scene together: settings and camera, style, buffers, geometry.
#include "exporters/povray/scene.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "core/base/error.h"
#include "exporters/povray/geometry.h"
#include "exporters/povray/scene_templates.h"
#include "exporters/povray/scene_text.h"

namespace meniscus::povray {
namespace {

constexpr std::size_t kMemoryWarningObjects = 2'000'000;  // about 3.5 GB in POV-Ray 3.7

struct Extent {
  glm::dvec3 low{1e300}, high{-1e300};
};

Extent atom_extent(std::span<const SurfaceObject> objects) {
  Extent e;
  for (const SurfaceObject& object : objects)
    for (const RigidMotion& copy : object.copies)
      for (const Ball& b : object.surface.atoms) {
        e.low = glm::min(e.low, copy(b.center) - b.radius);
        e.high = glm::max(e.high, copy(b.center) + b.radius);
      }
  return e;
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

std::string filled(std::string_view text, const std::string& name, std::string_view group) {
  std::string result(text);
  const auto replace_all = [&](std::string_view mark, std::string_view by) {
    for (std::size_t at = result.find(mark); at != std::string::npos; at = result.find(mark, at + by.size()))
      result.replace(at, mark.size(), by);
  };
  replace_all("@NAME@", name);
  replace_all("@GROUP@", group);
  return result;
}

// POV-Ray takes explicit vectors literally, so the right-handed basis goes in as it is, without a minus sign.
void append_camera(SceneText& out, const Camera& camera, const SceneOptions& options, const glm::dvec3& origin) {
  const ViewBasis basis = view_basis(camera);
  const double aspect = static_cast<double>(options.width) / options.height;
  const glm::dvec2 half = half_extent(camera, aspect);
  const auto declare = [&](std::string_view name, const glm::dvec3& v) {
    out.literal("#declare ").literal(name).literal(" = ").full_vector(v).literal(";\n");
  };
  out.literal("\n// The camera: axes of the picture and its size 1 Å in front of the eye (orthographic: in Å).\n");
  declare("Meniscus_Right", basis.right);
  declare("Meniscus_Up", basis.up);
  declare("Meniscus_Forward", basis.forward);
  declare("Meniscus_Eye", camera.position - origin);
  out.literal("#declare Meniscus_Picture_Width = ").full(2.0 * half.x).literal(";\n");
  out.literal("#declare Meniscus_Picture_Height = ").full(2.0 * half.y).literal(";\n");
  out.literal("// Declare Meniscus_Fit_Aspect = 1 to render at another ratio of width to height without stretching.\n");
  out.literal("#ifndef (Meniscus_Fit_Aspect) #declare Meniscus_Fit_Aspect = 0; #end\n");
  out.literal("#if (Meniscus_Fit_Aspect = 1)\n  #declare Meniscus_Picture_Width = ");
  out.literal("Meniscus_Picture_Height*image_width/image_height;\n#end\n");
  out.literal("#ifndef (Meniscus_Custom_Camera)\n  camera {\n    ");
  out.literal(camera.projection == Projection::perspective ? "perspective" : "orthographic");
  out.literal("\n    location Meniscus_Eye\n    direction Meniscus_Forward\n");
  out.literal(
      "    right Meniscus_Right*Meniscus_Picture_Width\n    up Meniscus_Up*Meniscus_Picture_Height\n  }\n#end\n");
}

std::string main_text(const Camera& camera, const SceneOptions& options, const glm::dvec3& origin, bool single) {
  SceneText out;
  out.literal("// A solvent-excluded surface, written by Meniscus " MENISCUS_VERSION
              " for POV-Ray 3.7. One unit is 1 Å.\n");
  out.literal("// Render with: povray ").literal(options.name).literal(".ini (in this folder).\n");
  out.literal("// To change something, declare it in a scene of your own and then include this file, for example\n");
  out.literal("//   #version 3.7; #declare Meniscus_Material = 2; #include \"")
      .literal(options.name)
      .literal(".pov\"\n");
  out.literal("// Colours as srgb need assumed_gamma first: write global_settings of your own and declare\n");
  out.literal(
      "// Meniscus_Custom_Settings; likewise Meniscus_Custom_Camera and Meniscus_Custom_Lights.\n#version 3.7;\n");
  out.literal("#ifndef (Meniscus_Material) #declare Meniscus_Material = ");
  out.count(static_cast<std::size_t>(options.material)).literal("; #end  // 0 opaque, 1 ghost, 2 glass, 3 wax\n");
  out.literal("#ifndef (Meniscus_Buffer) #declare Meniscus_Buffer = 0; #end  // 0 picture; others: see ");
  out.literal(options.name).literal("_aov.inc\n");
  out.literal("#ifndef (Meniscus_Subsurface) #declare Meniscus_Subsurface = 0; #end\n");
  out.literal("#ifndef (Meniscus_Custom_Settings)\nglobal_settings {\n  assumed_gamma 1.0\n");
  out.literal("  #if (Meniscus_Buffer = 4) max_trace_level 200 adc_bailout 0 #else max_trace_level 12 #end\n");
  out.literal("  #if (Meniscus_Subsurface = 1) mm_per_unit 1 subsurface { samples 50, 20 } #end\n}\n#end\n");
  append_camera(out, camera, options, origin);
  out.literal(filled(kMainTemplate, options.name, single ? "object" : "union"));
  return out.text();
}

void append_color(SceneText& out, const glm::vec3& c) { out.literal("srgb ").direction(glm::dvec3(c)); }

std::string style_text(const std::vector<glm::vec3>& colors, const SceneOptions& options) {
  SceneText out;
  out.literal(
      "// Colours, lights and materials of the scene. Everything may be declared before this file is included.\n");
  out.literal("#declare Meniscus_Default_Background = ");
  append_color(out, options.background);
  out.literal(";\n#ifndef (Meniscus_Color)\n  #declare Meniscus_Color = array[").count(colors.size());
  out.literal("] {\n");
  for (std::size_t n = 0; n < colors.size(); ++n) {
    out.literal("    ");
    append_color(out, colors[n]);
    out.literal(n + 1 < colors.size() ? ",\n" : "\n");
  }
  out.literal("  }\n#end\n").literal(kStyleTemplate);
  return out.text();
}

std::string buffer_text(std::size_t color_count, const Extent& e, const glm::dvec3& origin) {
  const glm::dvec3 size = e.high - e.low;
  // One cube for all axes, wide enough that no gradient reaches its own end.
  const double extent = std::ceil(std::max({size.x, size.y, size.z}) + 1.0);
  SceneText out;
  out.literal("// The surface as numbers instead of colours.\n#declare Meniscus_Low = ");
  out.full_vector(glm::floor((e.low - origin - 0.5) * 1e3) / 1e3).literal(";\n#declare Meniscus_Extent = ");
  out.full(extent).literal(";\n#declare Meniscus_Color_Count = ").count(color_count).literal(";\n");
  out.literal(kBufferTemplate);
  return out.text();
}

std::string ini_text(const SceneOptions& options) {
  SceneText out;
  out.literal("; A solvent-excluded surface. In this folder: povray ").literal(options.name).literal(".ini\n");
  out.literal("; From elsewhere, where no path holds a space: povray FOLDER/").literal(options.name);
  out.literal(".ini +LFOLDER +IFOLDER/").literal(options.name).literal(".pov +OFOLDER/\n");
  out.literal("; The camera is made for this size; another ratio stretches (see Meniscus_Fit_Aspect in the .pov).\n");
  out.literal("Width=").count(static_cast<std::size_t>(options.width)).literal("\nHeight=");
  out.count(static_cast<std::size_t>(options.height)).literal("\n");
  out.literal(filled(kIniTemplate, options.name, ""));
  return out.text();
}

std::vector<std::string> notes(std::span<const SurfaceObject> objects, const Geometry& geometry, const Camera& camera) {
  std::vector<std::string> sentences;
  // Rays begin on the plane through an orthographic camera, here as in the ray caster.
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
  const std::size_t held = geometry.primitives_in_memory();
  if (held > kMemoryWarningObjects)
    sentences.push_back(fmt::format("{} primitives, copies included, need about {} GB of memory in POV-Ray", held,
                                    held * 18 / 10'000'000));
  return sentences;
}

// One word of a POSIX shell, whatever the text holds.
std::string shell_quoted(const std::string& text) {
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

}  // namespace

SceneReport write_scene(std::span<const SurfaceObject> objects, const Camera& camera, const SceneOptions& options,
                        const std::filesystem::path& folder) {
  check(objects, options);
  const Extent extent = atom_extent(objects);
  const glm::dvec3 origin = glm::round((extent.low + extent.high) * 0.5e3) / 1e3;
  const Geometry geometry(objects, origin);

  OutputFolder output(folder, options.existing);
  SceneReport report;
  const auto begin_file = [&](const std::string& ending) -> OutputFile& {
    report.files.push_back(folder / (options.name + ending));
    return output.file(options.name + ending);
  };
  geometry.write(begin_file("_geometry.inc"));
  begin_file("_aov.inc").write(buffer_text(geometry.colors().size(), extent, origin));
  begin_file("_style.inc").write(style_text(geometry.colors(), options));
  begin_file(".pov").write(main_text(camera, options, origin, geometry.is_one_item()));
  begin_file(".ini").write(ini_text(options));
  begin_file("_objects.json").write(geometry.names_json(options.colors));
  output.commit();

  report.object_count = geometry.primitive_count();
  report.origin = origin;
  report.notes = notes(objects, geometry, camera);
  report.command = fmt::format("cd {} && povray {}.ini", shell_quoted(folder.string()), options.name);
  return report;
}

}  // namespace meniscus::povray
