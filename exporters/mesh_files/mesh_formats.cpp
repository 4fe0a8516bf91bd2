// SPDX-License-Identifier: BSD-3-Clause
// Lists the formats of mesh files, finds one by its name or ending, and writes a file in it.
#include "exporters/mesh_files/mesh_formats.h"

#include <cctype>

#include "core/base/system_file.h"
#include "exporters/mesh_files/writers.h"

namespace meniscus {
namespace {

template <class T>
void append(std::vector<T>& to, const std::vector<T>& more) {
  to.insert(to.end(), more.begin(), more.end());
}

/// Joins objects into one that has the name of the first.
FileObject joined(std::vector<FileObject> objects) {
  FileObject whole = std::move(objects.front());
  whole.triangle_colors.clear();  // colours of vertices remain, which all formats with colours support
  for (std::size_t n = 1; n < objects.size(); ++n) {
    FileObject& next = objects[n];
    const auto first = static_cast<std::uint32_t>(whole.positions.size());
    append(whole.positions, next.positions);
    append(whole.normals, next.normals);
    append(whole.colors, next.colors);
    append(whole.atom, next.atom);
    append(whole.kind, next.kind);
    append(whole.component, next.component);
    for (const auto& [a, b, c] : next.triangles) whole.triangles.push_back({first + a, first + b, first + c});
    for (std::size_t k = 0; k < whole.numbers.size(); ++k) append(whole.numbers[k].values, next.numbers[k].values);
    whole.is_cavity = whole.is_cavity && next.is_cavity;
    next = {};
  }
  return whole;
}

constexpr auto kFormats = std::to_array<MeshFormat>({
    // word, title, unit, objects, colors, numbers, solid, atoms, places, opacity
    {"stl", "STL, binary", "", false, false, false, false, false, false, false, write_stl},
    {"3mf", "3MF", "mm", true, true, false, false, false, true, false, write_3mf},
    {"obj", "Wavefront OBJ", "", true, true, false, false, false, false, false, write_obj},
    {"off", "OFF", "", false, false, false, false, false, false, false, write_off},
    {"glb", "glTF, binary", "m", true, true, true, false, false, true, true, write_glb},
    {"vtp", "VTK polygons", "", false, true, true, false, true, false, false, write_vtp},
    {"smesh", "TetGen's facets", "", false, false, false, true, false, false, false, write_smesh},
    {"dms", "dots of dms", "Å", false, false, false, false, true, false, false, write_dms},
    {"ply", "PLY, binary", "", false, true, true, false, false, false, false, write_ply},
    {"ply-ascii", "PLY, text", "", false, true, true, false, false, false, false, write_ascii_ply},
    {"py", "script for PyMOL", "", true, true, false, false, false, false, false, write_pymol_script},
    {"usda", "USD, text", "m", true, true, true, false, false, true, true, write_usda, write_usda_run},
    {"usdz", "USD, archive", "m", true, true, true, false, false, true, true, write_usdz, write_usdz_run},
});

}  // namespace

std::span<const MeshFormat> mesh_formats() { return kFormats; }

const MeshFormat* mesh_format(std::string_view word) {
  const auto* const at = std::ranges::find(kFormats, word, &MeshFormat::word);
  return at == kFormats.end() ? nullptr : &*at;
}

const MeshFormat* mesh_format_of_path(std::string_view path) {
  const std::size_t dot = path.rfind('.');
  if (dot == std::string_view::npos) return nullptr;
  std::string ending(path.substr(dot + 1));
  std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return mesh_format(ending == "usd" ? "usda" : ending);  // a .usd file may be text; readers inspect its content
}

std::string mesh_format_words() {
  std::string words;
  for (const MeshFormat& format : kFormats) words.append(words.empty() ? "" : ", ").append(format.word);
  return words;
}

void write_mesh_file(const MeshFormat& format, const std::string& path, Existing existing, MeshFile mesh) {
  if (!format.objects && mesh.objects.size() > 1) {
    FileObject whole = joined(std::move(mesh.objects));
    mesh.objects.clear();
    mesh.objects.push_back(std::move(whole));
  }
  OutputFile file(path_of_text(path), existing);
  format.write(file, mesh);
  file.commit();
}

void write_mesh_run(const MeshFormat& format, const std::string& path, Existing existing,
                    std::span<const MeshFile> frames, const RunTimes& times) {
  OutputFile file(path_of_text(path), existing);
  format.write_run(file, frames, times);
  file.commit();
}

}  // namespace meniscus
