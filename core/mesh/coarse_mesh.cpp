// SPDX-License-Identifier: BSD-3-Clause
// Builds the coarsest mesh of a surface from polygons of border samples; only those that are not simple are
// triangulated in a plane.
#include "core/mesh/base_mesh.h"

#include <numeric>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "core/base/error.h"
#include "core/mesh/border_samples.h"
#include "core/mesh/tessellate.h"
#include "core/surface/walks.h"

namespace meniscus {
namespace {

/// An edge length (Å) longer than any face of a molecule permits, so that the angles of EdgeRule decide.
constexpr double kAnyEdge = 10.0;
/// The largest angle (radian) of a segment on an arc next to faces that are not simple.
constexpr double kFineAngle = 1.2;
/// The cosine of the largest angle (1.9 radian), at the sphere's centre, between the middle of a fan and its rim.
constexpr double kWidestFan = -0.32;
/// The most corners of a saddle that becomes a fan: longer ones bend too much.
constexpr std::size_t kMostSaddleCorners = 6;

using FaceCorners = std::vector<BorderPoint>;

/// Cuts each face of a surface into as few triangles as possible.
class CoarseMeshing {
 public:
  CoarseMeshing(const Surface& surface, const SurfaceWalk& walk, double angle)
      : surface_(surface),
        walk_(walk),
        rule_(MeshOptions{0.4, false, kAnyEdge}, false),
        samples_(surface, rule_.with_angle(angle), false),
        filling_(surface, rule_, samples_),
        parts_(surface.faces.size()),
        has_wide_arcs_(angle > kFineAngle),
        is_finer_(surface.faces.size(), false),
        filled_(surface.faces.size()) {}

  TriangleMesh run() {
    std::vector<std::uint32_t> todo(parts_.size());
    std::iota(todo.begin(), todo.end(), 0u);
    samples_.take_split();
    while (true) {
      std::vector<std::uint32_t> hard = plan(todo);
      if (hard.empty()) break;
      todo = hard;
      if (!has_wide_arcs_ || !sample_finer(hard)) {
        for (const std::uint32_t f : hard) parts_[f].cut = Cut::filled;
        filling_.fill(std::move(hard), filled_);
      }
      for (const std::uint32_t b : samples_.take_split())
        todo.insert(todo.end(), surface_.borders[b].face.begin(), surface_.borders[b].face.end());
      std::sort(todo.begin(), todo.end());
      todo.erase(std::unique(todo.begin(), todo.end()), todo.end());
    }
    number_vertices();
    put_faces();
    return std::move(mesh_);
  }

 private:
  enum class Cut : std::uint8_t { none, triangle, diagonal, fan, filled };
  /// The way in which a face is cut, and the places where its rows begin.
  struct Part {
    Cut cut = Cut::none;
    std::uint8_t diagonal = 0;  ///< the corner that the diagonal begins at
    /// Number of corners; first own vertex and first triangle in the mesh.
    std::uint32_t corners = 0, vertex = 0, triangle = 0;
    glm::dvec3 middle{0.0};  ///< middle of a fan
  };

  /// Returns the corners of a face with one loop; the face lies on their left.
  FaceCorners corners_of(const Face& face) const {
    FaceCorners corners;
    for (const HalfBorder half : half_borders_of(surface_, loops_of(surface_, face)[0])) {
      const std::uint32_t border = border_of(half), n = samples_.segment_count(border);
      for (std::uint32_t k = 0; k < n; ++k) corners.push_back(samples_.point(border, is_backwards(half) ? n - k : k));
    }
    return corners;
  }

  /// Decides how these faces are cut; returns those that have to be filled and are not filled yet.
  std::vector<std::uint32_t> plan(const std::vector<std::uint32_t>& faces) {
    std::vector<std::uint8_t> hard(faces.size(), 0);
    tbb::parallel_for(std::size_t{0}, faces.size(), [&](std::size_t n) {
      if (parts_[faces[n]].cut == Cut::filled) return;
      const auto part = simple_part(faces[n]);
      hard[n] = !part;
      if (part) parts_[faces[n]] = *part;
    });
    std::vector<std::uint32_t> found;
    for (std::size_t n = 0; n < hard.size(); ++n)
      if (hard[n]) found.push_back(faces[n]);
    return found;
  }

  /// Halves the long segments around faces that are not simple polygons; returns false if that was done before.
  bool sample_finer(const std::vector<std::uint32_t>& hard) {
    bool any = false;
    for (const std::uint32_t f : hard) {
      if (is_finer_[f]) continue;
      is_finer_[f] = any = true;
      for_each_half_border(surface_, surface_.faces[f], [&](HalfBorder half) {
        const std::uint32_t b = border_of(half);
        for (std::uint32_t k = samples_.segment_count(b); k-- > 0;)
          if (samples_.parameter(b, k + 1) - samples_.parameter(b, k) > kFineAngle) samples_.split(b, k);
      });
    }
    return any;
  }

  /// Returns how a face that is a simple polygon is cut; nothing for other faces.
  std::optional<Part> simple_part(std::uint32_t f) const {
    const Face& face = surface_.faces[f];
    if (face.loop_count != 1 || face.tip != kNone) return std::nullopt;
    const FaceCorners corners = corners_of(face);
    Part part;
    part.corners = static_cast<std::uint32_t>(corners.size());
    if (corners.size() < 3) return part;  // the face has shrunk to a point or to one line
    if (corners.size() == 3) {
      part.cut = Cut::triangle;
      return part;
    }
    FaceCorners sorted = corners;
    std::sort(sorted.begin(), sorted.end());
    if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end()) return std::nullopt;
    std::vector<glm::dvec3> at;
    for (const BorderPoint& point : corners) at.push_back(samples_.position(point));
    if (face.kind != PatchKind::toroidal) return sphere_fan(f, part, at);
    if (corners.size() == 4) {
      part.cut = Cut::diagonal;
      part.diagonal = glm::distance(at[0], at[2]) <= glm::distance(at[1], at[3]) ? 0 : 1;
      return part;
    }
    return saddle_fan(f, part, at);
  }

  /// Cuts a face on a sphere as a fan. Seen from the centre, the fan must turn around its middle, a point of the face.
  std::optional<Part> sphere_fan(std::uint32_t f, Part part, std::vector<glm::dvec3>& at) const {
    const Face& face = surface_.faces[f];
    const bool convex = face.kind == PatchKind::convex;
    const Ball sphere = convex ? surface_.atoms[surface_.convex[face.patch].atom]
                               : Ball{surface_.concave[face.patch].center, surface_.probe_radius};
    glm::dvec3 area(0.0);  // vector area inside the rim, which points to its middle
    for (glm::dvec3& x : at) x = (x - sphere.center) / sphere.radius;
    for (std::size_t k = 0; k < at.size(); ++k) area += glm::cross(at[k], at[(k + 1) % at.size()]);
    if (!convex) area = -area;
    const double size = glm::length(area);
    if (!(size > 0.0)) return std::nullopt;
    const glm::dvec3 middle = area / size;
    for (std::size_t k = 0; k < at.size(); ++k) {
      const double turn = glm::dot(middle, glm::cross(at[k], at[(k + 1) % at.size()]));
      if (!((convex ? turn : -turn) > 0.0) || glm::dot(middle, at[k]) < kWidestFan) return std::nullopt;
    }
    return with_middle(f, part, sphere.center + sphere.radius * middle);
  }
  /// Cuts a saddle as a fan about the mean of its corners.
  std::optional<Part> saddle_fan(std::uint32_t f, Part part, const std::vector<glm::dvec3>& at) const {
    if (at.size() > kMostSaddleCorners) return std::nullopt;
    glm::dvec3 sum(0.0);
    for (const glm::dvec3& x : at) sum += x;
    return with_middle(f, part, sum / static_cast<double>(at.size()));
  }
  /// Makes the point of the surface below x the middle of a fan; returns nothing if that point is not on the face.
  std::optional<Part> with_middle(std::uint32_t f, Part part, const glm::dvec3& x) const {
    const auto on = walk_.below(x, f);
    if (!on || on->face != f) return std::nullopt;
    part.cut = Cut::fan;
    part.middle = on->position;
    return part;
  }

  /// Numbers the vertices of the surface that are used, then the border samples; put_faces() numbers each face's own.
  void number_vertices() {
    vertex_number_.assign(surface_.vertices.size(), kNone);
    border_number_.resize(surface_.borders.size());
    for (std::uint32_t b = 0; b < surface_.borders.size(); ++b) {
      const std::uint32_t n = samples_.segment_count(b);
      for (std::uint32_t k = 0; k < n; ++k)
        for (const BorderPoint& end : {samples_.point(b, k), samples_.point(b, k + 1)})
          if (end.border == kNone) number_vertex(end.index);
    }
    for (const Face& face : surface_.faces)
      if (face.tip != kNone) number_vertex(samples_.representative(face.tip));
    for (std::uint32_t b = 0; b < surface_.borders.size(); ++b) {
      const std::uint32_t n = samples_.segment_count(b);
      const bool ring = surface_.borders[b].vertex[0] == kNone;
      const auto next = static_cast<std::uint32_t>(mesh_.positions.size());
      border_number_[b] = ring ? next : next - 1;  // sample 1 of an arc is its first inner point
      for (std::uint32_t k = ring ? 0 : 1; k < n; ++k) mesh_.positions.push_back(samples_.position(b, k));
    }
  }
  void number_vertex(std::uint32_t vertex) {
    if (vertex_number_[vertex] != kNone) return;
    vertex_number_[vertex] = static_cast<std::uint32_t>(mesh_.positions.size());
    mesh_.positions.push_back(surface_.vertices[vertex]);
  }
  std::uint32_t number(const BorderPoint& name) const {
    return name.border == kNone ? vertex_number_[name.index] : border_number_[name.border] + name.index;
  }

  void put_faces() {
    auto vertices = static_cast<std::uint32_t>(mesh_.positions.size());
    std::uint32_t triangles = 0;
    for (std::uint32_t f = 0; f < parts_.size(); ++f) {
      Part& part = parts_[f];
      part.triangle = triangles;
      part.vertex = vertices;
      if (part.cut == Cut::filled) {
        split_doubled_edges(filled_[f]);
        triangles += static_cast<std::uint32_t>(filled_[f].triangles.size());
        vertices += own_vertices(filled_[f]);
      } else if (part.corners >= 3) {
        triangles += part.corners - (part.cut == Cut::fan ? 0 : 2);
        vertices += part.cut == Cut::fan;
      }
    }
    mesh_.positions.resize(vertices);
    mesh_.triangles.resize(triangles);
    mesh_.face.resize(triangles);
    tbb::parallel_for(std::size_t{0}, parts_.size(), [&](std::size_t f) { put_face(static_cast<std::uint32_t>(f)); });
  }
  /// Returns the number of each seam point among the face's own vertices.
  static std::map<std::uint32_t, std::uint32_t> seam_of(const FaceMesh& mesh) {
    std::map<std::uint32_t, std::uint32_t> seam;
    for (const BorderPoint& name : mesh.rim)
      if (name.border == kSeam) seam.try_emplace(name.index, static_cast<std::uint32_t>(seam.size()));
    return seam;
  }
  static std::uint32_t own_vertices(const FaceMesh& mesh) {
    return static_cast<std::uint32_t>(mesh.points.size() - mesh.rim.size() + seam_of(mesh).size());
  }

  void put_face(std::uint32_t f) {
    const Part& part = parts_[f];
    if (part.cut == Cut::none) return;
    if (part.cut == Cut::filled) return put_filled(f);
    std::vector<std::uint32_t> v;
    for (const BorderPoint& point : corners_of(surface_.faces[f])) v.push_back(number(point));
    const std::size_t n = v.size();
    std::uint32_t row = part.triangle;
    const auto put = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
      mesh_.face[row] = f;
      mesh_.triangles[row++] = {a, b, c};
    };
    if (part.cut == Cut::fan) {
      mesh_.positions[part.vertex] = part.middle;
      for (std::size_t k = 0; k < n; ++k) put(v[k], v[(k + 1) % n], part.vertex);
    } else {
      const std::size_t d = part.diagonal;
      put(v[d], v[d + 1], v[d + 2]);
      if (n == 4) put(v[d + 2], v[(d + 3) % 4], v[d]);
    }
  }
  void put_filled(std::uint32_t f) {
    const FaceMesh& mesh = filled_[f];
    const auto seam = seam_of(mesh);
    const auto rim = static_cast<std::uint32_t>(mesh.rim.size());
    std::vector<std::uint32_t> v(mesh.points.size());
    for (std::uint32_t i = 0; i < v.size(); ++i) {
      const bool inner = i >= rim, is_on_seam = !inner && mesh.rim[i].border == kSeam;
      if (inner) v[i] = parts_[f].vertex + static_cast<std::uint32_t>(seam.size()) + i - rim;
      if (is_on_seam) v[i] = parts_[f].vertex + seam.at(mesh.rim[i].index);
      if (inner || is_on_seam) mesh_.positions[v[i]] = mesh.points[i].position;
      if (!inner && !is_on_seam) v[i] = number(mesh.rim[i]);
    }
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const auto& [a, b, c] = mesh.triangles[t];
      mesh_.triangles[parts_[f].triangle + t] = {v[a], v[b], v[c]};
      mesh_.face[parts_[f].triangle + t] = f;
    }
  }

  const Surface& surface_;
  const SurfaceWalk& walk_;
  const EdgeRule rule_;
  BorderSamples samples_;
  FaceFilling filling_;
  std::vector<Part> parts_;     ///< per face
  bool has_wide_arcs_;          ///< true if arcs of one edge may span more than those next to faces that are not simple
  std::vector<bool> is_finer_;  ///< per face: true if its borders are sampled as finely as borders of filled faces
  std::vector<FaceMesh> filled_;  ///< per face: its triangles if it was filled
  std::vector<std::uint32_t> vertex_number_, border_number_;
  TriangleMesh mesh_;
};

/// Throws OpenSurfaceError unless each vertex has a triangle and each component has the V - E + F of the surface. The
/// component of a triangle is that of its face.
void check_euler(const Surface& surface, const TriangleMesh& mesh) {
  std::vector<int> twice(surface.components.size(), 0);  // 2 (V - E + F), where E = 3 F / 2 since the mesh is closed
  std::vector<std::uint8_t> seen(mesh.positions.size(), 0);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    int& sum = twice[surface.faces[mesh.face[t]].component];
    --sum;
    for (const std::uint32_t v : mesh.triangles[t])
      if (!std::exchange(seen[v], 1)) sum += 2;
  }
  if (std::find(seen.begin(), seen.end(), 0) != seen.end())
    throw OpenSurfaceError("the coarsest mesh has points without triangles");
  for (std::size_t c = 0; c < twice.size(); ++c)
    if (twice[c] != 2 * surface.components[c].euler)
      throw OpenSurfaceError("the coarsest mesh of component {} has another topology", c);
}

}  // namespace

TriangleMesh coarse_mesh(const Surface& surface, const SurfaceWalk& walk, double angle) {
  TriangleMesh mesh = CoarseMeshing(surface, walk, angle).run();
  check_euler(surface, mesh);
  return mesh;
}

}  // namespace meniscus
