// SPDX-License-Identifier: BSD-3-Clause
// Numbers vertices, triangles and faces like MSMS 2.6, and writes them column by column.
#include "exporters/msms/msms_files.h"

#include <fmt/compile.h>
#include <tbb/blocked_range.h>

#include "core/base/version.h"
#include "core/mesh/triangle_mesh.h"
#include "core/mesh/weld.h"
#include "exporters/mesh_files/writers.h"

namespace meniscus {
namespace {

/// The edge (Å) of a mesh with one vertex per Å². A mesh of equilateral triangles with edge h has 2/(sqrt(3) h²)
/// vertices per area. Pieces of such lattices between borders with vertices of their own have 20 % more.
const double kEdgeAtDensityOne = 1.1 * std::sqrt(2.0 / std::sqrt(3.0));

MsmsFaceKind kind_of(const Face& face) {
  constexpr MsmsFaceKind kKinds[] = {MsmsFaceKind::contact, MsmsFaceKind::toric, MsmsFaceKind::reentrant};
  return kKinds[static_cast<std::size_t>(face.kind)];
}

/// Returns the level of vertices inside a face (MsmsVertex::level), the last column of .vert files.
std::uint8_t level_inside(MsmsFaceKind kind) {
  return kind == MsmsFaceKind::contact ? 1 : kind == MsmsFaceKind::reentrant ? 3 : 2;
}

}  // namespace

void weld_for_files(MsmsMesh& made) {
  std::vector<glm::dvec3> positions;
  for (const MsmsVertex& v : made.vertices) positions.push_back(v.position);
  std::vector<std::array<std::uint32_t, 3>> corners;
  for (const MsmsTriangle& t : made.triangles) corners.push_back(t.corner);
  const Welding welding = weld_short_edges(positions, corners, kMsmsStep);
  std::vector<std::uint32_t> place(positions.size());
  std::uint32_t next = 0;
  for (std::uint32_t v = 0; v < place.size(); ++v) {
    place[v] = next;
    if (welding.into[v] == v) made.vertices[next++] = made.vertices[v];
  }
  made.vertices.resize(next);
  std::size_t kept = 0;
  for (std::size_t t = 0; t < corners.size(); ++t) {
    if (welding.removed[t]) continue;
    made.triangles[kept] = made.triangles[t];
    for (std::size_t k = 0; k < 3; ++k) made.triangles[kept].corner[k] = place[corners[t][k]];
    ++kept;
  }
  made.triangles.resize(kept);
}

/// Numbers the vertices, triangles and faces of all components.
class MsmsMeshes::Numbering {
 public:
  Numbering(const Surface& surface, const TriangleMesh& mesh, const ReducedComponents& components)
      : s_(surface), mesh_(mesh), components_(components), place_(mesh.positions.size(), kNone) {
    number_faces();
    sort_triangles();
    find_closest_atoms();
  }

  MsmsMesh of(std::uint32_t component) {
    MsmsMesh made;
    std::vector<std::uint32_t> used;
    for (std::uint32_t n = first_[component]; n < first_[component + 1]; ++n) {
      const std::uint32_t t = triangles_[n];
      const std::uint32_t f = mesh_.face[t];
      made.triangles.push_back({mesh_.triangles[t], kind_of(s_.faces[f]), number_[f]});
      for (const std::uint32_t v : mesh_.triangles[t])
        if (place_[v] == kNone) {
          used.push_back(v);
          place_[v] = 0;
        }
    }
    std::ranges::sort(used);
    for (const std::uint32_t v : used) {
      place_[v] = static_cast<std::uint32_t>(made.vertices.size());
      made.vertices.push_back(vertex(v));
    }
    for (MsmsTriangle& t : made.triangles) {
      for (std::uint32_t& corner : t.corner) {
        corner = place_[corner];
        MsmsVertex& v = made.vertices[corner];
        if (v.face == kInside) v.level = level_inside(t.kind);
      }
    }
    for (const std::uint32_t v : used) place_[v] = kNone;
    weld_for_files(made);
    set_faces(made);
    return made;
  }

 private:
  static bool is_contact(const Face& face) { return face.kind == PatchKind::convex; }

  // Numbers the faces of each component from 1, contact faces last.
  void number_faces() {
    number_.assign(s_.faces.size(), 0);
    std::vector<std::uint32_t> next(components_.count, 0);
    for (const bool contact : {false, true})
      for (std::size_t f = 0; f < s_.faces.size(); ++f)
        if (is_contact(s_.faces[f]) == contact) number_[f] = ++next[components_.of_face[f]];
  }

  // Sorts the triangles by component, then by face.
  void sort_triangles() {
    first_.assign(components_.count + 1, 0);
    for (const std::uint32_t f : mesh_.face) ++first_[components_.of_face[f] + 1];
    for (std::size_t c = 1; c < first_.size(); ++c) first_[c] += first_[c - 1];
    triangles_.resize(mesh_.triangles.size());
    std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
    for (const bool contact : {false, true})
      for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t)
        if (const std::uint32_t f = mesh_.face[t]; is_contact(s_.faces[f]) == contact)
          triangles_[next[components_.of_face[f]]++] = t;
    for (std::uint32_t c = 0; c < components_.count; ++c)
      std::stable_sort(
          triangles_.begin() + first_[c], triangles_.begin() + first_[c + 1],
          [&](std::uint32_t x, std::uint32_t y) { return number_[mesh_.face[x]] < number_[mesh_.face[y]]; });
  }

  // Finds the closest sphere of each vertex, first among the atoms that its faces touch. A vertex of a contact face
  // lies on the sphere of that face, even if rounding makes another sphere closer.
  void find_closest_atoms() {
    atom_of_vertex_.assign(mesh_.positions.size(), 0);
    std::vector<double> distance(mesh_.positions.size(), std::numeric_limits<double>::infinity());
    std::vector<std::uint32_t> touched;
    std::uint32_t known = kNone;
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
      const std::uint32_t f = mesh_.face[t];
      if (f != known) list_touched(s_.faces[known = f], touched);
      for (const std::uint32_t v : mesh_.triangles[t])
        for (const std::uint32_t atom : touched) {
          const double d = glm::distance(mesh_.positions[v], s_.atoms[atom].center) - s_.atoms[atom].radius;
          if (d >= distance[v] - kSame) continue;
          distance[v] = d;
          atom_of_vertex_[v] = atom;
        }
    }
    search_nearby_atoms(distance);
  }

  // Continues the search among all atoms near a vertex. Close to a third atom that only a neighbouring face touches, a
  // vertex between two atoms may be closest to that one.
  void search_nearby_atoms(std::vector<double>& distance) {
    double largest = 0;
    for (const Ball& atom : s_.atoms) largest = std::max(largest, atom.radius);
    const BallGrid grid(s_.atoms, largest + s_.probe_radius);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, distance.size(), 256), [&](const auto& range) {
      for (std::size_t v = range.begin(); v != range.end(); ++v) {
        if (distance[v] < kOnSphere) continue;
        grid.for_each_near(mesh_.positions[v], distance[v] + largest, [&](std::uint32_t atom) {
          const double d = glm::distance(mesh_.positions[v], s_.atoms[atom].center) - s_.atoms[atom].radius;
          const bool closer = d < distance[v] - kSame || (d < distance[v] + kSame && atom < atom_of_vertex_[v]);
          if (!closer) return;
          distance[v] = std::min(d, distance[v]);
          atom_of_vertex_[v] = atom;
        });
      }
    });
  }

  void list_touched(const Face& face, std::vector<std::uint32_t>& touched) const {
    touched.clear();
    if (face.kind == PatchKind::convex) touched.push_back(s_.convex[face.patch].atom);
    if (face.kind == PatchKind::toroidal)
      touched.assign(s_.toroidal[face.patch].atom.begin(), s_.toroidal[face.patch].atom.end());
    if (face.kind == PatchKind::concave) {
      const ConcavePatch& patch = s_.concave[face.patch];
      const auto contacts = std::span(s_.contacts).subspan(patch.first_contact, patch.contact_count);
      touched.assign(contacts.begin(), contacts.end());
    }
  }

  // Returns a vertex without the number of its face, and with the level 2 of vertices that are not inside a face.
  MsmsVertex vertex(std::uint32_t v) const {
    const bool corner = v < mesh_.corner_count, on_edge = v < mesh_.corner_count + mesh_.border_point_count;
    return {mesh_.positions[v], mesh_.normals[v], corner ? 0 : on_edge ? kOnEdge : kInside, atom_of_vertex_[v], 2};
  }

  // Sets the faces of vertices from the remaining triangles, because welding may have removed all triangles of a face.
  static void set_faces(MsmsMesh& made) {
    std::vector<bool> is_set(made.vertices.size(), false);
    for (const MsmsTriangle& t : made.triangles)
      for (const std::uint32_t v : t.corner) {
        if (is_set[v]) continue;
        is_set[v] = true;
        made.vertices[v].face *= static_cast<std::int32_t>(t.face);
      }
  }

  static constexpr std::int32_t kOnEdge = -1, kInside = 1;  // factors of the number of the face
  static constexpr double kOnSphere = 1e-6;                 // a vertex nearer to a sphere is on it, Å
  static constexpr double kSame = 1e-9;  // distances that differ by less are equal, so the first atom counts, Å

  const Surface& s_;
  const TriangleMesh& mesh_;
  const ReducedComponents& components_;
  std::vector<std::uint32_t> number_;     // number of each face of the surface
  std::vector<std::uint32_t> triangles_;  // triangles of the mesh, component by component
  std::vector<std::uint32_t> first_;      // index into triangles_ for each component, and the end
  std::vector<std::uint32_t> atom_of_vertex_;
  std::vector<std::uint32_t> place_;  // index of each vertex in the current component; kNone for all others
};

MsmsMeshes::MsmsMeshes(const Surface& surface, const TriangleMesh& mesh, const ReducedComponents& components)
    : numbering_(std::make_unique<Numbering>(surface, mesh, components)) {}
MsmsMeshes::~MsmsMeshes() = default;

MsmsMesh MsmsMeshes::of(std::uint32_t component) { return numbering_->of(component); }

double msms_edge(double density) { return kEdgeAtDensityOne / std::sqrt(density); }

namespace {

/// The first line of NanoShaper's files, without the date, so that equal input gives equal files.
constexpr const char* kNanoShaper =
    "# File created by NanoShaper version 1.5 (meniscus-nanoshaper " MENISCUS_VERSION ")\n";

/// Returns 0 for numbers that round to zero at three decimals: some readers cannot read "-0.000".
double unsigned_zero(double x) { return std::abs(x) < 0.0005 ? 0.0 : x; }

std::string header_text(const char* what, const char* counted, std::size_t count, const MsmsSpheres& spheres,
                        const MsmsHeader& header) {
  if (!header.wanted) return {};
  if (header.of_nanoshaper) return fmt::format("{}{}\n{}\n", kNanoShaper, counted, count);
  return fmt::format(
      "# MSMS solvent excluded surface {} for {}\n{:7} #sphere density probe_r\n{:7d} {:7d} {:5.2f} {:5.2f}\n", what,
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
                        if (header.of_nanoshaper) *out = ' ';
                        if (!spheres.names.empty()) fmt::format_to(out, FMT_COMPILE(" {}"), spheres.names[sphere]);
                        *out = '\n';
                      });
}

std::string face_text(const MsmsMesh& mesh, const MsmsSpheres& spheres, const MsmsHeader& header) {
  return text_of_rows(header_text("faces", "#faces", mesh.triangles.size(), spheres, header), mesh.triangles.size(),
                      [&](std::size_t n, auto out) {
                        const MsmsTriangle& t = mesh.triangles[n];
                        fmt::format_to(out, FMT_COMPILE("{:6d} {:6d} {:6d} {:2d} {:6d}\n"), t.corner[0] + 1,
                                       t.corner[1] + 1, t.corner[2] + 1, static_cast<int>(t.kind), t.face);
                      });
}

std::string off_text(const MsmsMesh& mesh) {
  std::string text =
      text_of_rows(fmt::format("OFF\n{}\n{} {} 0\n", kNanoShaper, mesh.vertices.size(), mesh.triangles.size()),
                   mesh.vertices.size(), [&](std::size_t n, auto out) {
                     const glm::dvec3& x = mesh.vertices[n].position;
                     fmt::format_to(out, FMT_COMPILE("{:.3f} {:.3f} {:.3f}\n"), unsigned_zero(x.x), unsigned_zero(x.y),
                                    unsigned_zero(x.z));
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
