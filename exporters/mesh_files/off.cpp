// SPDX-License-Identifier: BSD-3-Clause
// Writes OFF files: a line with counts, then positions, then triangles.
#include <fmt/compile.h>

#include "exporters/mesh_files/text_rows.h"
#include "exporters/mesh_files/writers.h"

namespace meniscus {

void write_off(OutputFile& file, const MeshFile& mesh) {
  const FileObject& object = mesh.objects.front();
  file.write(
      text_of_rows(fmt::format("OFF\n# {}\n{} {} 0\n", mesh.about, object.positions.size(), object.triangles.size()),
                   object.positions.size(), [&](std::size_t v, auto out) {
                     const glm::vec3& x = object.positions[v];
                     fmt::format_to(out, FMT_COMPILE("{} {} {}\n"), x.x, x.y, x.z);
                   }));
  file.write(text_of_rows("", object.triangles.size(), [&](std::size_t t, auto out) {
    const auto& [a, b, c] = object.triangles[t];
    fmt::format_to(out, FMT_COMPILE("3 {} {} {}\n"), a, b, c);
  }));
}

}  // namespace meniscus
