// SPDX-License-Identifier: BSD-3-Clause
// Lists the formats of mesh files, finds one by its name or ending, and writes a file in it.
#include "exporters/mesh_files/mesh_formats.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>

#include "exporters/mesh_files/writers.h"

namespace meniscus {
namespace {

constexpr auto kFormats = std::to_array<MeshFormat>({
    // word, title, unit, objects, colors, numbers, solid, atoms
    {"stl", "STL, binary", "", false, false, false, false, false, write_stl},
    {"3mf", "3MF", "mm", true, true, false, false, false, write_3mf},
    {"obj", "Wavefront OBJ", "", true, true, false, false, false, write_obj},
    {"off", "OFF", "", false, false, false, false, false, write_off},
    {"glb", "glTF, binary", "m", true, true, true, false, false, write_glb},
    {"vtp", "VTK polygons", "", false, true, true, false, true, write_vtp},
    {"smesh", "TetGen's facets", "", false, false, false, true, false, write_smesh},
    {"dms", "dots of dms", "Å", false, false, false, false, true, write_dms},
    {"ply", "PLY, binary", "", false, true, true, false, false, write_ply},
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
  return mesh_format(ending);
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
  OutputFile file(path, existing);
  format.write(file, mesh);
  file.commit();
}

}  // namespace meniscus
