// SPDX-License-Identifier: BSD-3-Clause
// Writes settings, camera, style, buffers and .ini of a scene, and the include for a user's own scene.
#include "exporters/povray/povray_scene.h"

#include <set>

#include "core/base/text.h"
#include "core/base/version.h"
#include "exporters/povray/scene_text.h"
#include "exporters/povray/surface_pieces.h"

namespace meniscus::povray {
namespace {

std::string_view scene_template(std::string_view path) { return template_text(povray_templates(), path); }

/// The declared values of one camera, in the order of kVectorNames and kSizeNames.
struct CameraNumbers {
  std::array<glm::dvec3, 4> vectors;
  std::array<double, 2> sizes;
  bool orthographic;
};
constexpr std::array<std::string_view, 4> kVectorNames{"Meniscus_Right", "Meniscus_Up", "Meniscus_Forward",
                                                       "Meniscus_Eye"};
constexpr std::array<std::string_view, 2> kSizeNames{"Meniscus_Picture_Width", "Meniscus_Picture_Height"};

// POV-Ray takes explicit vectors literally, so the right-handed basis is written unchanged, without a minus sign.
CameraNumbers camera_numbers(const Camera& camera, double aspect, const glm::dvec3& origin) {
  const ViewBasis basis = view_basis(camera);
  const glm::dvec2 half = half_extent(camera, aspect);
  return {{basis.right, basis.up, basis.forward, camera.position - origin},
          {2.0 * half.x, 2.0 * half.y},
          camera.projection == Projection::orthographic};
}

void append_one_camera(SceneText& out, const CameraNumbers& camera) {
  const auto declare = [&](std::string_view name) -> SceneText& {
    return out.literal("#declare ").literal(name).literal(" = ");
  };
  for (std::size_t n = 0; n < kVectorNames.size(); ++n)
    declare(kVectorNames[n]).full_vector(camera.vectors[n]).literal(";\n");
  for (std::size_t n = 0; n < kSizeNames.size(); ++n) declare(kSizeNames[n]).full(camera.sizes[n]).literal(";\n");
  declare("Meniscus_Orthographic").count(camera.orthographic ? 1 : 0).literal(";\n");
}

// Declares the array <name>_List with an element per frame, and <name> as the element of the current frame.
void append_list(SceneText& out, std::string_view name, const auto& of_frames, const auto& append) {
  out.literal("#declare ").literal(name).literal("_List = array[").count(of_frames.size()).literal("] {\n");
  for (std::size_t n = 0; n < of_frames.size(); ++n) {
    append(of_frames[n]);
    out.literal(n + 1 < of_frames.size() ? ",\n" : "\n}\n");
  }
  out.literal("#declare ").literal(name).literal(" = ").literal(name).literal("_List[Meniscus_Place];\n");
}

void append_camera_lists(SceneText& out, const std::vector<CameraNumbers>& cameras) {
  const auto list = [&](std::string_view name, const auto& append) { append_list(out, name, cameras, append); };
  for (std::size_t k = 0; k < kVectorNames.size(); ++k)
    list(kVectorNames[k], [&](const CameraNumbers& camera) { out.full_vector(camera.vectors[k]); });
  for (std::size_t k = 0; k < kSizeNames.size(); ++k)
    list(kSizeNames[k], [&](const CameraNumbers& camera) { out.full(camera.sizes[k]); });
  list("Meniscus_Orthographic", [&](const CameraNumbers& camera) { out.count(camera.orthographic ? 1 : 0); });
}

void append_color(SceneText& out, const glm::vec3& c) { out.literal("srgb ").direction(glm::dvec3(c)); }

void append_looks(SceneText& out, std::span<const FrameLook> looks) {
  if (looks.empty()) return;
  const auto list = [&](std::string_view name, const auto& append) {
    out.literal("#ifndef (").literal(name).literal(")\n");
    append_list(out, name, looks, append);
    out.literal("#end\n");
  };
  out.literal("\n// The look of each frame.\n");
  list("Meniscus_Background", [&](const FrameLook& look) { append_color(out, look.background); });
  list("Meniscus_Shadows", [&](const FrameLook& look) { out.ratio(static_cast<double>(look.shadows)); });
  list("Meniscus_Shadow_Softness",
       [&](const FrameLook& look) { out.ratio(static_cast<double>(look.shadow_softness)); });
}

void append_camera(SceneText& out, std::span<const Camera> cameras, const SceneOptions& options,
                   const glm::dvec3& origin) {
  const double aspect = static_cast<double>(options.width) / options.height;
  out.literal("\n// The camera: axes of the picture and its size 1 Å in front of the eye (orthographic: in Å).\n");
  std::vector<CameraNumbers> numbers;
  for (const Camera& camera : cameras) numbers.push_back(camera_numbers(camera, aspect, origin));
  if (numbers.size() == 1)
    append_one_camera(out, numbers[0]);
  else
    append_camera_lists(out, numbers);
  out.literal("// Declare Meniscus_Fit_Aspect = 1 to render at another ratio of width to height without stretching.\n");
  out.literal("#ifndef (Meniscus_Fit_Aspect) #declare Meniscus_Fit_Aspect = 0; #end\n");
  out.literal("#if (Meniscus_Fit_Aspect = 1)\n  #declare Meniscus_Picture_Width = ");
  out.literal("Meniscus_Picture_Height*image_width/image_height;\n#end\n");
  out.literal("#ifndef (Meniscus_Custom_Camera)\n  camera {\n");
  out.literal("    #if (Meniscus_Orthographic = 1) orthographic #else perspective #end");
  out.literal("\n    location Meniscus_Eye\n    direction Meniscus_Forward\n");
  out.literal(
      "    right Meniscus_Right*Meniscus_Picture_Width\n    up Meniscus_Up*Meniscus_Picture_Height\n  }\n#end\n");
}

// Declares the frames of the run and the name of each frame's include. The template checks that the include exists,
// because POV-Ray's own message about a missing file would not name the frame.
void append_frames(SceneText& out, const SceneOptions& options, const SceneFrames& frames, bool has_surface) {
  out.literal("\n// The frames of the run, by their numbers in the trajectory.\n");
  out.literal("#declare Meniscus_Frame_Count = ").count(frames.numbers.size()).literal(";\n");
  out.literal("#declare Meniscus_Trajectory_Frame = array[").count(frames.numbers.size()).literal("] {");
  for (std::size_t n = 0; n < frames.numbers.size(); ++n)
    out.literal(n == 0 ? "" : n % 16 == 0 ? ",\n" : ",").count(frames.numbers[n]);
  out.literal("};\n#declare Meniscus_Palette = ")
      .count(frames.palette)
      .literal(";  // the includes must have the same\n");
  // Each frame has a file of geometry or, without a surface, a file of colours.
  out.literal(filled(scene_template("frame.inc"), {{"NAME", options.name},
                                                   {"PART", has_surface ? "geometry" : "colors"},
                                                   {"NAMED", has_surface ? "Geometry" : "Colors"}}));
}

std::string colors_of_frame(const SceneOptions& options) {
  return "#include concat(\"" + options.name + "_colors_\", Meniscus_Frame_Name, \".inc\")\n";
}

/// Factors that convert a material of pictures to a finish of POV-Ray. The default material gives the scene's finish.
constexpr double kHighlight = 1.3, kLeastBrilliance = 0.6, kMostBrilliance = 1.2;

// Appends the macro that changes a finish according to the material of an object.
void append_materials(SceneText& out, const std::vector<MaterialRequest>& materials) {
  out.literal(
      "#macro Meniscus_Material_Of(N, Covers)\n  #switch (Meniscus_Material = 4 ? 0 : N)\n    #case (0) #break\n");
  for (std::size_t n = 0; n < materials.size(); ++n) {
    const MaterialRequest& material = materials[n];
    out.literal("    #case (").count(n + 1).literal(")");
    if (material.ambient) out.literal(" ambient ").ratio(*material.ambient);
    if (material.ambient) out.literal(" diffuse ").ratio(1.0 - static_cast<double>(*material.ambient));
    if (material.roughness) {
      const double even = *material.roughness;
      out.literal(" brilliance ").ratio((1.0 - even) * kMostBrilliance + even * kLeastBrilliance);
    }
    if (material.specular) out.literal(" specular Covers*").ratio(kHighlight * static_cast<double>(*material.specular));
    if (material.shininess) out.literal(" roughness ").ratio(1.0 / static_cast<double>(*material.shininess));
    out.literal(" #break\n");
  }
  out.literal("  #end\n#end\n");
}

/// Returns the step from each frame to the next if it is positive and the same for all frames, because POV-Ray itself
/// can render only such runs. Returns nothing otherwise.
std::optional<std::uint64_t> step_of(std::span<const std::uint64_t> frames) {
  const std::uint64_t step = frames.size() > 1 ? frames[1] - frames[0] : 1;
  for (std::size_t n = 1; n < frames.size(); ++n)
    if (frames[n] <= frames[n - 1] || frames[n] - frames[n - 1] != step) return {};
  return step;
}

}  // namespace

std::string main_text(std::span<const Camera> cameras, const SceneOptions& options, const glm::dvec3& origin,
                      const SceneParts& parts, const SceneFrames* frames) {
  SceneText out;
  out.literal("// A solvent-excluded surface, written by Meniscus " MENISCUS_VERSION
              " for POV-Ray 3.7. One unit is 1 Å.\n");
  out.literal("// Render with: povray ").literal(options.name).literal(".ini (in this folder).\n");
  out.literal("// To change something, declare it in a scene of your own and then include this file, for example\n");
  out.literal("//   #version 3.7; #declare Meniscus_Material = 2; #include \"")
      .literal(options.name)
      .literal(".pov\"\n");
  out.literal("// For a scene that is all your own include ").literal(options.name);
  out.literal(".inc instead: it places nothing, and\n// object { Meniscus_Surface } stands where you put it.\n");
  out.literal("// Colours as srgb need assumed_gamma first: write global_settings of your own and declare\n");
  out.literal(
      "// Meniscus_Custom_Settings; likewise Meniscus_Custom_Camera and Meniscus_Custom_Lights.\n#version 3.7;\n");
  out.literal("#ifdef (Meniscus_Own_Scene)\n  #declare Meniscus_Custom_Settings = 1;\n");
  out.literal("  #declare Meniscus_Custom_Camera = 1;\n  #declare Meniscus_Custom_Lights = 1;\n#end\n");
  out.literal("#ifndef (Meniscus_Material) #declare Meniscus_Material = ");
  out.count(static_cast<std::size_t>(options.material))
      .literal("; #end  // 0 opaque, 1 ghost, 2 glass, 3 wax, 4 flat\n");
  out.literal("#ifndef (Meniscus_Buffer) #declare Meniscus_Buffer = 0; #end  // 0 picture; others: see ");
  out.literal(options.name).literal("_aov.inc\n");
  out.literal("#ifndef (Meniscus_Subsurface) #declare Meniscus_Subsurface = 0; #end\n");
  out.literal("#ifndef (Meniscus_Custom_Settings)\nglobal_settings {\n  assumed_gamma 1.0\n");
  out.literal("  #if (Meniscus_Buffer = 4) max_trace_level 256 adc_bailout 0\n");
  // Total reflection traps rays in glass; the limits cut off contributions most of which are below one grey level.
  out.literal("  #else #if (Meniscus_Material = 2) max_trace_level 30 adc_bailout 1/64 #else max_trace_level ");
  // All visible translucent layers are traced: the ray caster stops at the same share of 1/1024.
  out.literal(parts.translucent ? "200 adc_bailout 1/1024" : "12").literal(" #end #end\n");
  out.literal("  #if (Meniscus_Subsurface = 1) mm_per_unit 1 subsurface { samples 50, 20 } #end\n}\n#end\n");
  if (frames) append_frames(out, options, *frames, parts.surface);
  append_camera(out, cameras, options, origin);
  if (frames) append_looks(out, frames->looks);
  const auto include_of = [&](const std::string& part) {
    const std::string name = options.name + "_" + part;
    return frames ? "#include concat(\"" + name + "_\", Meniscus_Frame_Name, \".inc\")"
                  : "#include \"" + name + ".inc\"";
  };
  SceneText shadows, softness;
  shadows.ratio(static_cast<double>(options.shadows));
  softness.ratio(static_cast<double>(options.shadow_softness));
  out.literal(filled(scene_template("main.pov"),
                     {{"NAME", options.name}, {"SHADOWS", shadows.text()}, {"SOFTNESS", softness.text()}}));
  const auto add_surface = [&](bool single, const std::string& geometry, const std::string& caps,
                               const std::string& handle) {
    out.literal(
        filled(scene_template("surface.pov"),
               {{"GROUP", single ? "object" : "union"}, {"GEOMETRY", geometry}, {"CAPS", caps}, {"HANDLE", handle}}));
  };
  if (parts.surface) {
    const std::string geometry = frames ? std::string("#include Meniscus_Geometry") : include_of("geometry");
    add_surface(parts.single && !parts.caps, geometry, parts.caps ? "\n  " + include_of("caps") : "",
                "Meniscus_Surface");
  }
  const auto add_shapes = [&](const std::string& include, const std::string& handle) {
    out.literal("\n#ifdef (Meniscus_Own_Scene) #declare ").literal(handle).literal(" = union { #end\n");
    out.literal(include).literal("\n#ifdef (Meniscus_Own_Scene) } #end\n");
  };
  if (parts.shapes) add_shapes(include_of("shapes"), "Meniscus_Shapes");
  for (std::size_t n = 0; n < parts.objects.size(); ++n) {
    const std::string include = include_of(fmt::format("object_{}", n + 1));
    const std::string handle = fmt::format("Meniscus_Object_{}", n + 1);
    if (parts.objects[n].is_surface)
      add_surface(parts.objects[n].single, include, "", handle);
    else
      add_shapes(include, handle);
  }
  return out.text();
}

std::string colors_text(const std::vector<SceneColor>& colors, const std::optional<ColorKey>& meaning) {
  SceneText out;
  out.literal("#ifndef (Meniscus_Color)\n  #declare Meniscus_Color = array[").count(colors.size());
  out.literal("] {\n");
  for (std::size_t n = 0; n < colors.size(); ++n) {
    out.literal("    ");
    append_color(out, colors[n].color);
    out.literal(n + 1 < colors.size() ? "," : "");
    if (meaning) out.literal(color_comment(*meaning, colors[n]));
    out.literal("\n");
  }
  out.literal("  }\n#end\n");
  const auto list = [&](std::string_view comment, std::string_view name, const auto& append) {
    out.literal("// ").literal(comment).literal("\n#ifndef (").literal(name).literal(")\n  #declare ");
    out.literal(name).literal(" = array[").count(colors.size()).literal("] {");
    for (std::size_t n = 0; n < colors.size(); ++n)
      append(out.literal(n == 0 ? "" : n % 16 == 0 ? ",\n" : ","), colors[n]);
    out.literal("}\n#end\n");
  };
  list("How much of what lies behind a point of each colour it covers.", "Meniscus_Opacity",
       [](SceneText& text, const SceneColor& color) { text.ratio(color.opacity); });
  list("1: as a thin film does, more where the view grazes it.", "Meniscus_Film",
       [](SceneText& text, const SceneColor& color) { text.count(color.film ? 1 : 0); });
  list("1: where the volume map reaches, points have its colours instead.", "Meniscus_By_Map",
       [](SceneText& text, const SceneColor& color) { text.count(color.by_map ? 1 : 0); });
  list("What it is made of: 0 as all, or a number of Meniscus_Material_Of.", "Meniscus_Material_Number",
       [](SceneText& text, const SceneColor& color) { text.count(color.finish); });
  return out.text();
}

std::string style_text(const SceneStyle& style, const SceneOptions& options, const glm::dvec3& origin) {
  SceneText out;
  out.literal(
      "// Colours, lights and materials of the scene. Everything may be declared before this file is included.\n");
  out.literal("#declare Meniscus_Default_Background = ");
  append_color(out, options.background);
  out.literal(";\n").literal(style.colors ? colors_text(*style.colors, options.colors) : colors_of_frame(options));
  append_materials(out, style.materials);
  if (style.map) append_map(out, *style.map, options.name + std::string(kMapFileEnding), origin);
  out.literal(scene_template("style.inc"));
  return out.text();
}

std::string render_command(const SceneOptions& options, std::span<const std::uint64_t> frames) {
  return step_of(frames) ? fmt::format("povray {}.ini", options.name)
                         : fmt::format("povray '{}.ini[film]'", options.name);
}

std::string buffer_text(const std::vector<SceneColor>* colors, const SceneOptions& options, const Box& e,
                        const glm::dvec3& origin) {
  const glm::dvec3 size = e.high - e.low;
  // A cube is used for all axes. It is so wide that no gradient reaches its end.
  const double extent = std::ceil(std::max({size.x, size.y, size.z}) + 1.0);
  SceneText out;
  out.literal("// The surface as numbers instead of colours.\n#declare Meniscus_Low = ");
  out.full_vector(glm::floor((e.low - origin - 0.5) * 1e3) / 1e3).literal(";\n#declare Meniscus_Extent = ");
  out.full(extent).literal(";\n");
  if (!colors) out.literal(colors_of_frame(options));
  out.literal("#declare Meniscus_Color_Count = ");
  if (colors)
    out.count(colors->size());
  else
    out.literal("dimension_size(Meniscus_Color, 1)");
  out.literal(";\n");
  out.literal(scene_template("buffers.inc"));
  return out.text();
}

std::string ini_text(const SceneOptions& options, std::span<const std::uint64_t> frames) {
  SceneText out;
  out.literal("; A solvent-excluded surface. In this folder: povray ").literal(options.name).literal(".ini\n");
  out.literal("; From elsewhere, where no path holds a space: povray FOLDER/").literal(options.name);
  out.literal(".ini +LFOLDER +IFOLDER/").literal(options.name).literal(".pov +OFOLDER/\n");
  out.literal("; The camera is made for this size; another ratio stretches (see Meniscus_Fit_Aspect in the .pov).\n");
  out.literal("Width=").count(static_cast<std::size_t>(options.width)).literal("\nHeight=");
  out.count(static_cast<std::size_t>(options.height)).literal("\n");
  if (!frames.empty()) {
    out.literal(
        "; Frames have their numbers in the trajectory. Of several machines each renders a part: +SF10 +EF19.\n");
    if (!step_of(frames))
      out.literal("; POV-Ray's steps are even, so that all frames of this run are rendered by ")
          .literal(render_command(options, frames))
          .literal("\n");
    // The final frame sets the number of digits in names of pictures; the subset sets the frames that are rendered.
    const auto [first, last] = std::ranges::minmax(frames);
    std::uint64_t final_frame = 99'999;
    while (final_frame < last) final_frame = final_frame * 10 + 9;
    out.literal("Initial_Frame=0\nFinal_Frame=").count(final_frame);
    out.literal("\nSubset_Start_Frame=").count(first).literal("\nSubset_End_Frame=").count(last);
    out.literal("\nFrame_Step=").count(step_of(frames).value_or(1)).literal("\n");
  }
  // POV-Ray appends the number of the frame to the name.
  out.literal(filled(scene_template("settings.ini"), {{"NAME", options.name}, {"PICTURE", frames.empty() ? "" : "_"}}));
  if (!frames.empty())
    out.literal(filled(scene_template("film.ini"), {{"NAME", options.name}, {"COUNT", std::to_string(frames.size())}}));
  return out.text();
}

namespace {

using Names = std::set<std::string_view>;

/// Returns true for the names that the include declares, and for the one that marks a scene of the user's own.
bool is_kept(std::string_view name) {
  return name == "Meniscus_Own_Scene" || name == "Meniscus_Surface" || name == "Meniscus_Shapes" ||
         name.starts_with("Meniscus_Object_");
}

/// Adds the identifiers that follow each occurrence of `word` in `text`.
void add_names(std::string_view text, std::string_view word, Names& names) {
  constexpr std::string_view kLetters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz_0123456789";
  for (std::size_t at = text.find(word); at != std::string_view::npos; at = text.find(word, at)) {
    at += word.size();
    const std::string_view name = text.substr(at, text.find_first_not_of(kLetters, at) - at);
    if (!is_kept(name)) names.insert(name);
  }
}

}  // namespace

std::string own_scene_text(std::string_view name, std::span<const std::string_view> texts, bool maps) {
  const std::string colors = colors_text({}, {});  // each frame of a run may have its own list of colours
  std::vector<std::string_view> all(texts.begin(), texts.end());
  all.insert(all.end(),
             {colors, template_text(povray_templates(), "caps.inc"), template_text(povray_templates(), "shapes.inc")});
  if (maps) all.push_back(template_text(povray_templates(), "map.inc"));
  Names declared, settings;
  for (const std::string_view text : all) {
    add_names(text, "#declare ", declared);
    add_names(text, "#macro ", declared);
    add_names(text, "#ifndef (", settings);
  }
  SceneText out;
  out.literal("// For a scene of your own: declares Meniscus_Surface, and places nothing.\n");
  out.literal("//   #version 3.7;\n//   global_settings { assumed_gamma 1 }\n//   #include \"").literal(name);
  out.literal(".inc\"\n//   object { Meniscus_Surface rotate 30*y }\n");
  out.literal(
      "// What is beside the surface is Meniscus_Shapes, and further objects are Meniscus_Object_1 and so on.\n");
  out.literal(
      "// Each name of the list below may be declared before, and stays as you declared it. All other names are\n");
  out.literal("// taken back at the end: include the file again with other settings, or another surface.\n");
  const auto line = [&](std::string_view test, std::string_view prefix, std::string_view directive,
                        std::string_view symbol) {
    out.literal(test).literal(prefix).literal(symbol).literal(")").literal(directive).literal(symbol);
  };
  for (const std::string_view setting : settings) {
    line("#ifdef (", "", " #local Keeps_", setting);
    out.literal(" = 1; #end\n");
  }
  out.literal("#declare Meniscus_Own_Scene = 1;\n#include \"")
      .literal(name)
      .literal(".pov\"\n#undef Meniscus_Own_Scene\n");
  for (const std::string_view setting : settings) {
    line("#ifndef (", "Keeps_", " #ifdef (", setting);
    out.literal(") #undef ").literal(setting).literal(" #end #end\n");
  }
  for (const std::string_view internal : declared) {
    if (settings.contains(internal)) continue;
    line("#ifdef (", "", " #undef ", internal);
    out.literal(" #end\n");
  }
  return out.text();
}

}  // namespace meniscus::povray
