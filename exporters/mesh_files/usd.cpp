// SPDX-License-Identifier: BSD-3-Clause
// Writes USD as text: a mesh for each object, its instances, and a material with looks as variants. A run has samples
// of everything at each frame.
#include <cctype>
#include <limits>
#include <set>

#include <fmt/compile.h>
#include <glm/common.hpp>

#include "core/base/error.h"
#include "core/base/version.h"
#include "core/image/color_space.h"
#include "exporters/mesh_files/writers.h"

namespace meniscus {
namespace {

/// An object in each frame of a run. An entry is nullptr if the frame does not have the object.
struct Prim {
  std::string name;
  std::vector<const FileObject*> frames;

  const FileObject& first() const {
    return **std::ranges::find_if(frames, [](const FileObject* o) { return o != nullptr; });
  }
  bool is_placed_once() const {
    return std::ranges::all_of(frames, [](const FileObject* o) { return !o || o->is_placed_once(); });
  }
  bool is_translucent() const {
    return std::ranges::any_of(frames, [](const FileObject* o) { return o && !o->opacities.empty(); });
  }
};

/// The parameters of the material in one of its variants.
struct MaterialLook {
  std::string_view name;
  float roughness = 0.5f;
  std::string_view more;  ///< one further input of UsdPreviewSurface, or empty
};

/// The looks of a file. The first stands for the material of the file, whose values replace those given here.
constexpr auto kLooks = std::to_array<MaterialLook>({{"figure", 0.5f, ""},
                                                     {"matte", 1.0f, ""},
                                                     {"plastic", 0.25f, "float inputs:clearcoat = 0.5"},
                                                     {"metal", 0.35f, "float inputs:metallic = 1"},
                                                     {"glass", 0.05f, "float inputs:opacity = 0.35"}});

/// Returns a material. Its base color and, if it is translucent, its opacity are primvars of the bound mesh.
std::string material_text(std::string_view name, bool is_translucent) {
  const std::string path = fmt::format("/molecule/looks/{}", name);
  const auto reader = [](std::string_view of, std::string_view type, std::string_view primvar, std::string_view other) {
    return fmt::format(
        "            def Shader \"{0}\"\n            {{\n                uniform token info:id = "
        "\"UsdPrimvarReader_{1}\"\n                string inputs:varname = \"{2}\"\n                {1} "
        "inputs:fallback = {3}\n                {1} outputs:result\n            }}\n",
        of, type, primvar, other);
  };
  std::string text = fmt::format(
      "        def Material \"{0}\"\n        {{\n            token outputs:surface.connect = "
      "<{1}/shader.outputs:surface>\n\n            def Shader \"shader\"\n            {{\n                uniform "
      "token info:id = \"UsdPreviewSurface\"\n                color3f inputs:diffuseColor.connect = "
      "<{1}/color.outputs:result>\n",
      name, path);
  if (is_translucent)
    text += fmt::format("                float inputs:opacity.connect = <{}/opacity.outputs:result>\n", path);
  text += "                token outputs:surface\n            }\n";
  text += reader("color", "float3", "displayColor", "(0.5, 0.5, 0.5)");
  if (is_translucent) text += reader("opacity", "float", "displayOpacity", "1");
  return text + "        }\n";
}

/// Returns the looks as variants. A look changes both materials, but translucent meshes keep their opacity.
std::string looks_text(const FileMaterial& material, bool is_translucent) {
  std::string text = "    variantSet \"look\" = {\n";
  for (const MaterialLook& look : kLooks) {
    const bool is_own = &look == kLooks.begin();
    const float rough = is_own ? material.roughness : look.roughness;
    const std::string more = is_own ? fmt::format("float inputs:ior = {:.4g}", material.ior) : std::string(look.more);
    const auto shader = [&](std::string_view name, std::string_view input) {
      return fmt::format(
          "                over \"{}\" {{\n                    over \"shader\" {{\n                        float "
          "inputs:roughness = {:.3g}\n{}                    }}\n                }}\n",
          name, rough, input.empty() ? "" : fmt::format("                        {}\n", input));
    };
    text += fmt::format("        \"{}\" {{\n            over \"looks\" {{\n{}{}            }}\n        }}\n", look.name,
                        shader("surface", more),
                        is_translucent ? shader("translucent", look.name == "glass" ? "" : more) : "");
  }
  return text + "    }\n";
}

/// Returns an identifier that is not in `taken` yet, and adds it there. It consists of letters, digits and underscores,
/// and does not begin with a digit.
std::string identifier(const std::string& name, std::set<std::string>& taken) {
  std::string word = name;
  std::ranges::replace_if(
      word, [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
  if (word.empty() || std::isdigit(static_cast<unsigned char>(word.front())) != 0) word.insert(0, "_");
  std::string unique = word;
  for (int n = 2; !taken.insert(unique).second; ++n) unique = fmt::format("{}_{}", word, n);
  return unique;
}

/// Returns the objects of all frames. Objects with the same name in several frames are one object.
std::vector<Prim> prims_of(std::span<const MeshFile> frames) {
  std::vector<Prim> prims;
  for (std::size_t f = 0; f < frames.size(); ++f) {
    std::set<std::string> taken{"looks", "prototypes"};
    for (const FileObject& object : frames[f].objects) {
      const std::string name = identifier(object.name, taken);
      auto at = std::ranges::find(prims, name, &Prim::name);
      if (at == prims.end()) at = prims.insert(at, {name, std::vector<const FileObject*>(frames.size())});
      at->frames[f] = &object;
    }
  }
  return prims;
}

template <class Put>
std::string array_text(std::size_t count, const Put& put) {
  return text_of_rows("[", count,
                      [&](std::size_t n, auto out) {
                        if (n > 0) fmt::format_to(out, FMT_COMPILE(", "));
                        put(n, out);
                      }) +
         "]";
}

std::string vectors_text(std::span<const glm::vec3> rows) {
  return array_text(rows.size(), [&](std::size_t n, auto out) {
    fmt::format_to(out, FMT_COMPILE("({}, {}, {})"), rows[n].x, rows[n].y, rows[n].z);
  });
}

std::string extent_text(std::span<const glm::vec3> rows) {
  std::array<glm::vec3, 2> box{};
  if (!rows.empty()) box.fill(rows.front());
  for (const glm::vec3& x : rows) box = {glm::min(box[0], x), glm::max(box[1], x)};
  return vectors_text(box);
}

/// Returns colours as linear light, which displayColor contains.
std::string colors_text(std::span<const std::array<std::uint8_t, 3>> rows) {
  std::array<std::string, 256> of_channel;
  for (std::size_t c = 0; c < of_channel.size(); ++c)
    of_channel[c] = fmt::format("{:.6g}", linear_from_srgb(static_cast<float>(c) / 255.0f));
  return array_text(rows.size(), [&](std::size_t n, auto out) {
    const auto& [red, green, blue] = rows[n];
    fmt::format_to(out, FMT_COMPILE("({}, {}, {})"), of_channel[red], of_channel[green], of_channel[blue]);
  });
}

std::string numbers_text(const std::vector<float>& rows) {
  const std::vector<float> values = zero_for_missing(rows);
  return array_text(values.size(), [&](std::size_t n, auto out) { fmt::format_to(out, FMT_COMPILE("{}"), values[n]); });
}

/// Writes the opacity of each vertex. An object that is translucent only in other frames is opaque here.
std::string opacities_text(const FileObject& object) {
  return array_text(object.positions.size(), [&](std::size_t v, auto out) {
    fmt::format_to(out, FMT_COMPILE("{:.4g}"), object.opacities.empty() ? 1.0f : object.opacities[v]);
  });
}

/// Returns the matrix of a placement. Its rows are the images of the axes and of the origin.
std::string matrix_text(const RigidMotion& place) {
  std::string text = "( ";
  for (int axis = 0; axis < 3; ++axis) {
    const glm::dvec3& to = place.rotation[axis];
    text += fmt::format("({}, {}, {}, 0), ", to.x, to.y, to.z);
  }
  const glm::dvec3& to = place.translation;
  return text + fmt::format("({}, {}, {}, 1) )", to.x, to.y, to.z);
}

std::vector<glm::vec3> per_second(std::vector<glm::vec3> velocities, double frames_per_second) {
  for (glm::vec3& v : velocities) v *= static_cast<float>(frames_per_second);
  return velocities;
}

template <class Sink>
class UsdWriter {
 public:
  UsdWriter(Sink& sink, std::span<const MeshFile> frames, const RunTimes* times)
      : sink_(sink), frames_(frames), times_(times) {}

  void write() {
    const std::vector<Prim> prims = prims_of(frames_);
    const bool is_translucent = std::ranges::any_of(prims, &Prim::is_translucent);
    const std::string range =
        times_ ? fmt::format(
                     "    startTimeCode = {}\n    endTimeCode = {}\n    timeCodesPerSecond = {:g}\n"
                     "    framesPerSecond = {:g}\n",
                     times_->places.front(), times_->places.back(), times_->per_second, times_->per_second)
               : "";
    sink_(
        fmt::format("#usda 1.0\n(\n    defaultPrim = \"molecule\"\n    doc = \"{}\"\n    metersPerUnit = 1\n"
                    "    upAxis = \"Y\"\n{})\n\ndef Xform \"molecule\" (\n    kind = \"component\"\n    variants = {{\n"
                    "        string look = \"{}\"\n    }}\n    prepend variantSets = \"look\"\n)\n{{\n",
                    frames_.front().about, range, kLooks.front().name));
    sink_("    def Scope \"looks\"\n    {\n" + material_text("surface", false) +
          (is_translucent ? material_text("translucent", true) : "") + "    }\n");
    write_prototypes(prims);
    for (const Prim& prim : prims) {
      if (prim.is_placed_once())
        write_mesh(prim, prim.name);
      else
        write_instances(prim);
    }
    sink_(looks_text(frames_.front().material, is_translucent) + "}\n");
  }

 private:
  /// Writes the meshes that several places share, below a prim that programs do not draw.
  void write_prototypes(const std::vector<Prim>& prims) {
    if (std::ranges::all_of(prims, &Prim::is_placed_once)) return;
    sink_("    class Scope \"prototypes\"\n    {\n");
    for (const Prim& prim : prims) {
      if (prim.is_placed_once()) continue;
      sink_(fmt::format("    def Xform \"{}\"\n    {{\n", prim.name));
      write_mesh(prim, "mesh");
      sink_("    }\n");
    }
    sink_("    }\n");
  }

  /// Writes an instance of the prototype per place. Throws RequestError if their number differs between frames.
  void write_instances(const Prim& prim) {
    const std::size_t count = prim.first().places.size();
    if (std::ranges::any_of(prim.frames, [&](const FileObject* o) { return o && o->places.size() != count; }))
      throw RequestError(
          "there are not as many copies in each frame; put # into the name of the file, for one a frame");
    sink_(fmt::format("    def Xform \"{}\"\n    {{\n", prim.name));
    for (std::size_t n = 0; n < count; ++n) {
      sink_(
          fmt::format("      def Xform \"copy_{}\" (\n        instanceable = true\n        prepend references = "
                      "</molecule/prototypes/{}>\n      )\n      {{\n",
                      n + 1, prim.name));
      const auto place_of = [n](const FileObject& o) {
        return matrix_text(n < o.places.size() ? o.places[n] : RigidMotion{});
      };
      const std::string place = place_of(prim.first());
      if (std::ranges::all_of(prim.frames, [&](const FileObject* o) { return !o || place_of(*o) == place; }))
        sink_(fmt::format("        matrix4d xformOp:transform = {}\n", place));
      else
        add(prim, "matrix4d xformOp:transform", "", place_of);
      sink_("        uniform token[] xformOpOrder = [\"xformOp:transform\"]\n      }\n");
    }
    sink_("    }\n");
  }

  void write_mesh(const Prim& prim, const std::string& name) {
    const bool is_translucent = prim.is_translucent();
    sink_(
        fmt::format("    def Mesh \"{}\" (\n        prepend apiSchemas = [\"MaterialBindingAPI\"]\n    )\n    {{\n"
                    "        rel material:binding = </molecule/looks/{}>\n        uniform bool doubleSided = 1\n"
                    "        uniform token subdivisionScheme = \"none\"\n",
                    name, is_translucent ? "translucent" : "surface"));
    add(prim, "float3[] extent", "", [](const FileObject& o) { return extent_text(o.positions); });
    add(prim, "int[] faceVertexCounts", "",
        [](const FileObject& o) { return array_text(o.triangles.size(), [](std::size_t, auto out) { *out = '3'; }); });
    add(prim, "int[] faceVertexIndices", "", [](const FileObject& o) {
      return array_text(o.triangles.size(), [&](std::size_t t, auto out) {
        const auto& [a, b, c] = o.triangles[t];
        fmt::format_to(out, FMT_COMPILE("{}, {}, {}"), a, b, c);
      });
    });
    add(prim, "point3f[] points", "", [](const FileObject& o) { return vectors_text(o.positions); });
    add(prim, "normal3f[] normals", "vertex", [](const FileObject& o) { return vectors_text(o.normals); });
    if (times_ && std::ranges::all_of(prim.frames, [](const FileObject* o) {
          return !o || o->velocities.size() == o->positions.size();
        }))
      add(prim, "vector3f[] velocities", "",
          [&](const FileObject& o) { return vectors_text(per_second(o.velocities, times_->per_second)); });
    add(prim, "color3f[] primvars:displayColor", "vertex", [](const FileObject& o) { return colors_text(o.colors); });
    if (is_translucent) add(prim, "float[] primvars:displayOpacity", "vertex", opacities_text);
    const FileObject& first = prim.first();
    for (std::size_t k = 0; k < first.numbers.size(); ++k)
      add(prim, "float[] primvars:" + first.numbers[k].name, "vertex",
          [&](const FileObject& o) { return o.numbers.empty() ? "[]" : numbers_text(o.numbers[k].values); });
    sink_("    }\n");
  }

  /// Writes an attribute. `text_of` returns its value in a frame, where the object may be missing and has no points.
  template <class TextOf>
  void add(const Prim& prim, const std::string& declared, std::string_view interpolation, const TextOf& text_of) {
    const std::string about = interpolation.empty()
                                  ? "\n"
                                  : fmt::format(" (\n            interpolation = \"{}\"\n        )\n", interpolation);
    if (!times_) {
      sink_(fmt::format("        {} = ", declared));
      sink_(text_of(*prim.frames.front()));
      sink_(about);
      return;
    }
    if (!interpolation.empty()) sink_(fmt::format("        {}{}", declared, about));
    sink_(fmt::format("        {}.timeSamples = {{\n", declared));
    for (std::size_t f = 0; f < prim.frames.size(); ++f) {
      sink_(fmt::format("            {}: ", times_->places[f]));
      sink_(text_of(prim.frames[f] ? *prim.frames[f] : kNothing));
      sink_(",\n");
    }
    sink_("        }\n");
  }

  inline static const FileObject kNothing{};
  Sink& sink_;
  std::span<const MeshFile> frames_;
  const RunTimes* times_;
};

void write_text(OutputFile& file, std::span<const MeshFile> frames, const RunTimes* times) {
  const auto sink = [&](std::string_view text) { file.write(text); };
  UsdWriter(sink, frames, times).write();
}

}  // namespace

std::string usd_text(std::span<const MeshFile> frames, const RunTimes* times) {
  std::string whole;
  const auto sink = [&](std::string_view text) { whole.append(text); };
  UsdWriter(sink, frames, times).write();
  return whole;
}

void write_usda(OutputFile& file, const MeshFile& mesh) { write_text(file, {&mesh, 1}, nullptr); }

void write_usda_run(OutputFile& file, std::span<const MeshFile> frames, const RunTimes& times) {
  write_text(file, frames, &times);
}

}  // namespace meniscus
