// SPDX-License-Identifier: BSD-3-Clause
// Writes OBJ files: for each object its vertices, their normals, and triangles that count both from the beginning of
// the file.
#include <algorithm>
#include <cctype>

#include <fmt/compile.h>

#include "exporters/mesh_files/text_rows.h"
#include "exporters/mesh_files/writers.h"

namespace meniscus {
namespace {

/// Names end at blanks, and other programs take some signs for their own.
std::string plain_name(const std::string& name) {
  std::string plain = name;
  std::ranges::replace_if(
      plain, [](unsigned char c) { return std::isalnum(c) == 0 && c != '-' && c != '.'; }, '_');
  return plain;
}

}  // namespace

void write_obj(OutputFile& file, const MeshFile& mesh) {
  file.write(fmt::format("# {}\n", mesh.about));
  std::size_t first = 1;
  for (const FileObject& object : mesh.objects) {
    file.write(text_of_rows(fmt::format("o {}\n", plain_name(object.name)), object.positions.size(),
                            [&](std::size_t v, auto out) {
                              const glm::vec3& x = object.positions[v];
                              const auto& [red, green, blue] = object.colors[v];
                              fmt::format_to(out, FMT_COMPILE("v {} {} {} {:.4f} {:.4f} {:.4f}\n"), x.x, x.y, x.z,
                                             red / 255.0, green / 255.0, blue / 255.0);
                            }));
    file.write(text_of_rows("", object.normals.size(), [&](std::size_t v, auto out) {
      const glm::vec3& n = object.normals[v];
      fmt::format_to(out, FMT_COMPILE("vn {:.6g} {:.6g} {:.6g}\n"), n.x, n.y, n.z);
    }));
    file.write(text_of_rows("s 1\n", object.triangles.size(), [&](std::size_t t, auto out) {
      const auto& [a, b, c] = object.triangles[t];
      fmt::format_to(out, FMT_COMPILE("f {0}//{0} {1}//{1} {2}//{2}\n"), first + a, first + b, first + c);
    }));
    first += object.positions.size();
  }
}

}  // namespace meniscus
