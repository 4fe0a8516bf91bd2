// SPDX-License-Identifier: BSD-3-Clause
// Writes TetGen's four lists: points, facets with the number of their component, holes, regions. All count from 1.
#include <fmt/compile.h>

#include "exporters/mesh_files/text_rows.h"
#include "exporters/mesh_files/writers.h"

namespace meniscus {

void write_smesh(OutputFile& file, const MeshFile& mesh) {
  const FileObject& object = mesh.objects.front();
  file.write(text_of_rows(fmt::format("# {}\n{} 3 0 0\n", mesh.about, object.positions.size()), object.positions.size(),
                          [&](std::size_t v, auto out) {
                            const glm::vec3& x = object.positions[v];
                            fmt::format_to(out, FMT_COMPILE("{} {} {} {}\n"), v + 1, x.x, x.y, x.z);
                          }));
  file.write(text_of_rows(
      fmt::format("{} 1\n", object.triangles.size()), object.triangles.size(), [&](std::size_t t, auto out) {
        const auto& [a, b, c] = object.triangles[t];
        fmt::format_to(out, FMT_COMPILE("3 {} {} {} {}\n"), a + 1, b + 1, c + 1, object.component[t] + 1);
      }));
  std::string points = fmt::format("# a point in each cavity\n{}\n", mesh.cavities.size());
  std::size_t n = 0;
  for (const auto& [x, component] : mesh.cavities) points += fmt::format("{} {} {} {}\n", ++n, x.x, x.y, x.z);
  points += fmt::format("# a point in each solid, with the number of its component\n{}\n", mesh.solids.size());
  n = 0;
  for (const auto& [x, component] : mesh.solids)
    points += fmt::format("{} {} {} {} {}\n", ++n, x.x, x.y, x.z, component + 1);
  file.write(points);
}

}  // namespace meniscus
