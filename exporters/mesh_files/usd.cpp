// SPDX-License-Identifier: BSD-3-Clause
// Writes USD as text, a mesh each object: still, or with samples of all of it at each frame of a run.
#include <algorithm>
#include <array>
#include <cctype>
#include <limits>
#include <set>
#include <utility>

#include <fmt/compile.h>
#include <glm/common.hpp>

#include "core/base/version.h"
#include "core/image/color_space.h"
#include "exporters/mesh_files/writers.h"

namespace meniscus {
namespace {

/// An object as it is in each frame; nullptr where it is not there.
struct Prim {
  std::string name;
  std::vector<const FileObject*> frames;
};

/// A letter or underscore, then those and digits; no other of the file has it.
std::string identifier(const std::string& name, std::set<std::string>& taken) {
  std::string word = name;
  std::ranges::replace_if(
      word, [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
  if (word.empty() || std::isdigit(static_cast<unsigned char>(word.front())) != 0) word.insert(0, "_");
  std::string unique = word;
  for (int n = 2; !taken.insert(unique).second; ++n) unique = fmt::format("{}_{}", word, n);
  return unique;
}

/// Objects of the same name are the same object.
std::vector<Prim> prims_of(std::span<const MeshFile> frames) {
  std::vector<Prim> prims;
  for (std::size_t f = 0; f < frames.size(); ++f) {
    std::set<std::string> taken;
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

/// Linear, as displayColor is.
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
  const std::vector<float> values = without_gaps(rows);
  return array_text(values.size(), [&](std::size_t n, auto out) { fmt::format_to(out, FMT_COMPILE("{}"), values[n]); });
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
    const std::string range =
        times_ ? fmt::format(
                     "    startTimeCode = {}\n    endTimeCode = {}\n    timeCodesPerSecond = {:g}\n"
                     "    framesPerSecond = {:g}\n",
                     times_->places.front(), times_->places.back(), times_->per_second, times_->per_second)
               : "";
    sink_(
        fmt::format("#usda 1.0\n(\n    defaultPrim = \"molecule\"\n    doc = \"{}\"\n    metersPerUnit = 1\n"
                    "    upAxis = \"Y\"\n{})\n\ndef Xform \"molecule\" (\n    kind = \"component\"\n)\n{{\n",
                    frames_.front().about, range));
    for (const Prim& prim : prims_of(frames_)) write(prim);
    sink_("}\n");
  }

 private:
  void write(const Prim& prim) {
    sink_(
        fmt::format("    def Mesh \"{}\"\n    {{\n        uniform bool doubleSided = 1\n"
                    "        uniform token subdivisionScheme = \"none\"\n",
                    prim.name));
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
    const FileObject& first = **std::ranges::find_if(prim.frames, [](const FileObject* o) { return o != nullptr; });
    for (std::size_t k = 0; k < first.numbers.size(); ++k)
      add(prim, "float[] primvars:" + first.numbers[k].name, "vertex",
          [&](const FileObject& o) { return o.numbers.empty() ? "[]" : numbers_text(o.numbers[k].values); });
    sink_("    }\n");
  }

  /// One attribute of it; `text_of` gives its value in a frame. An object that is not there has no points.
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
