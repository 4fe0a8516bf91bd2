// SPDX-License-Identifier: BSD-3-Clause
// Writes .vert, .face and .area files as columns of text.
#include "exporters/msms/msms_files.h"

#include <cmath>

#include <fmt/compile.h>
#include <fmt/format.h>

#include "core/base/constants.h"
#include "exporters/mesh_files/writers.h"

namespace meniscus {
namespace {

/// Without the sign of what rounds to nothing, which some readers take for a field of its own.
double unsigned_zero(double x) { return std::abs(x) < 0.0005 ? 0.0 : x; }

std::string header_text(const char* what, const char* counted, std::size_t count, const MsmsSpheres& spheres,
                        const MsmsHeader& header) {
  if (!header.wanted) return {};
  return fmt::format(
      "# MSMS solvent excluded surface {} for {}\n{} #sphere density probe_r\n{:7d} {:7d} {:5.2f} {:5.2f}\n", what,
      spheres.file, counted, count, spheres.count, header.density, header.probe_radius);
}

}  // namespace

std::string vert_text(const MsmsMesh& mesh, const MsmsSpheres& spheres, const MsmsHeader& header) {
  return text_of_rows(header_text("vertices", "#vertex", mesh.vertices.size(), spheres, header), mesh.vertices.size(),
                      [&](std::size_t n, auto out) {
                        const MsmsVertex& v = mesh.vertices[n];
                        const std::uint32_t sphere = spheres.of_atom[v.atom];
                        for (const glm::dvec3& x : {v.position, v.normal})
                          fmt::format_to(out, FMT_COMPILE("{:9.3f} {:9.3f} {:9.3f} "), unsigned_zero(x.x),
                                         unsigned_zero(x.y), unsigned_zero(x.z));
                        fmt::format_to(out, FMT_COMPILE("{:7d} {:7d} {:2d}"), v.face, sphere + 1, v.level);
                        if (!spheres.names.empty()) fmt::format_to(out, FMT_COMPILE(" {}"), spheres.names[sphere]);
                        *out = '\n';
                      });
}

std::string face_text(const MsmsMesh& mesh, const MsmsSpheres& spheres, const MsmsHeader& header) {
  return text_of_rows(header_text("faces", "#faces ", mesh.triangles.size(), spheres, header), mesh.triangles.size(),
                      [&](std::size_t n, auto out) {
                        const MsmsTriangle& t = mesh.triangles[n];
                        fmt::format_to(out, FMT_COMPILE("{:6d} {:6d} {:6d} {:2d} {:6d}\n"), t.corner[0] + 1,
                                       t.corner[1] + 1, t.corner[2] + 1, static_cast<int>(t.kind), t.face);
                      });
}

std::string off_text(const MsmsMesh& mesh) {
  std::string text = text_of_rows(fmt::format("OFF\n{} {} 0\n", mesh.vertices.size(), mesh.triangles.size()),
                                  mesh.vertices.size(), [&](std::size_t n, auto out) {
                                    const glm::dvec3& x = mesh.vertices[n].position;
                                    fmt::format_to(out, FMT_COMPILE("{:.3f} {:.3f} {:.3f}\n"), unsigned_zero(x.x),
                                                   unsigned_zero(x.y), unsigned_zero(x.z));
                                  });
  return text_of_rows(std::move(text), mesh.triangles.size(), [&](std::size_t n, auto out) {
    const auto& [a, b, c] = mesh.triangles[n].corner;
    fmt::format_to(out, FMT_COMPILE("3 {} {} {}\n"), a, b, c);
  });
}

std::string area_text(std::span<const AtomAreas> areas, const MsmsSpheres& spheres) {
  std::string titles = "Atom#";
  for (std::size_t c = 0; c < areas.size(); ++c) titles += fmt::format("    ses_{0}    sas_{0}", c);
  std::vector<std::uint32_t> atom_of_sphere(spheres.count, kNone);
  for (std::uint32_t a = 0; a < spheres.of_atom.size(); ++a) atom_of_sphere[spheres.of_atom[a]] = a;
  return text_of_rows(titles + "\n", spheres.count, [&](std::size_t n, auto out) {
    const std::uint32_t atom = atom_of_sphere[n];
    fmt::format_to(out, FMT_COMPILE("{:5d}"), n);
    for (const AtomAreas& component : areas)
      fmt::format_to(out, FMT_COMPILE(" {:8.3f} {:8.3f}"), atom == kNone ? 0.0 : unsigned_zero(component.surface[atom]),
                     atom == kNone ? 0.0 : unsigned_zero(component.accessible[atom]));
    if (!spheres.names.empty()) fmt::format_to(out, FMT_COMPILE(" {}"), spheres.names[n]);
    *out = '\n';
  });
}

}  // namespace meniscus
