// SPDX-License-Identifier: BSD-3-Clause
// Triangulates faces in rounds, joins them to a closed mesh in five steps, and checks areas and volumes by such meshes.
#include "core/mesh/tessellate.h"

#include <bit>
#include <set>
#include <tuple>
#include <unordered_map>

#ifdef __GLIBC__
#include <malloc.h>
#endif

#include <tbb/parallel_for.h>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/mesh/compare_mesh.h"
#include "core/surface/compute_surface.h"

namespace meniscus {
namespace {

/// The most rounds in which rims that cross themselves are sampled more finely before a face is given up.
constexpr int kUntanglingRounds = 24;

}  // namespace

FaceFilling::FaceFilling(const Surface& surface, const EdgeRule& rule, BorderSamples& samples)
    : surface_(surface), rule_(rule), samples_(samples), is_requested_(surface.faces.size(), false) {}

void FaceFilling::make_lattices(const std::vector<std::uint32_t>& faces) {
  for (const std::uint32_t f : faces) {
    const Face& face = surface_.faces[f];
    if (face.kind == PatchKind::toroidal) continue;
    const int n = frequency(face);
    if (!lattices_.contains(n)) lattices_[n] = sphere_lattice(n);
  }
}

FaceOutline FaceFilling::outline(std::uint32_t f) const {
  const Face& face = surface_.faces[f];
  if (face.kind == PatchKind::toroidal) return torus_outline(surface_, face, samples_, rule_);
  return sphere_outline(surface_, face, samples_, lattices_.at(frequency(face)), edge(face));
}

FaceMesh FaceFilling::filled(std::uint32_t f) const {
  const Face& face = surface_.faces[f];
  if (face.loop_count == 0) return whole_sphere(surface_, face, lattices_.at(frequency(face)));
  FaceOutline rim = outline(f);
  if (rim.edges.size() < 3) return {};  // the face has shrunk to a point or to one line
  return fill_outline(std::move(rim), tolerance_of(rule_, surface_, face));
}

void FaceFilling::fan(std::uint32_t f, FaceMesh& mesh) const {
  if (!mesh.triangles.empty()) return;
  FaceOutline rim = outline(f);
  if (rim.edges.size() < 3) return;
  if (rim.loop_count > 1)
    throw OpenSurfaceError("the mesh cannot be closed: the borders of face {} cross; give a smaller tolerance", f);
  mesh = fan_outline(std::move(rim));
}

void FaceFilling::fill(std::vector<std::uint32_t> todo, std::vector<FaceMesh>& meshes) {
  make_lattices(todo);
  for (const std::uint32_t f : todo) is_requested_[f] = true;
  for (int round = 0; round < kUntanglingRounds && !todo.empty(); ++round) {
    tbb::parallel_for(std::size_t{0}, todo.size(), [&](std::size_t i) { meshes[todo[i]] = filled(todo[i]); });
    std::set<std::pair<std::uint32_t, std::uint32_t>> segments;
    for (std::uint32_t f : todo) {
      for (const Segment& s : meshes[f].too_coarse) segments.insert({s.border, s.index});
    }
    std::set<std::uint32_t> dirty;
    for (auto s = segments.rbegin(); s != segments.rend(); ++s) {  // the last ones first, so that indices remain valid
      samples_.split(s->first, s->second);
      for (std::uint32_t f : surface_.borders[s->first].face)
        if (is_requested_[f]) dirty.insert(f);
    }
    todo.assign(dirty.begin(), dirty.end());
  }
  tbb::parallel_for(std::size_t{0}, meshes.size(), [&](std::size_t f) {
    if (is_requested_[f]) fan(static_cast<std::uint32_t>(f), meshes[f]);
  });
}

namespace {

/// The distance between the seam names of two faces: more than the points of any seam.
constexpr std::uint32_t kSeamNames = 1024;
/// Normals of neighbouring faces that differ by more than this (radian) make a sharp vertex.
constexpr double kSharpAngle = 1e-4;
/// The number of faces with rows that are made at the same time.
constexpr std::uint32_t kFacesTogether = 1 << 12;
/// The number of times that freed memory is returned, and the least number of faces between two: each walks the heap.
constexpr std::uint32_t kTimesFreed = 16, kFacesFreed = 1 << 14;

/// Returns the memory of small blocks that were freed to the system; otherwise the allocator keeps it.
void return_free_memory() {
#ifdef __GLIBC__
  malloc_trim(0);
#endif
}

/// Meshes all faces of a surface between shared border samples.
class Tessellation {
 public:
  Tessellation(const Surface& surface, const MeshOptions& options)
      : surface_(surface),
        options_(options),
        rule_(options),
        samples_(std::in_place, surface, rule_, options.split_colors),
        faces_(surface.faces.size()) {}

  TriangleMesh run() {
    fill_faces();
    tbb::parallel_for(std::size_t{0}, faces_.size(), [&](std::size_t f) { split_doubled_edges(faces_[f]); });
    split_shared_edges();
    tbb::parallel_for(std::size_t{0}, faces_.size(), [&](std::size_t f) {
      color_face(surface_, surface_.faces[f], faces_[f], options_.split_colors);
      faces_[f].rim_edges = {};
      faces_[f].bridges = {};
      faces_[f].points.shrink_to_fit();
      faces_[f].triangles.shrink_to_fit();
    });
    number_vertices();
    add_sharp_edges();
    samples_.reset();
    return_free_memory();
    find_shared_normals();
    for_each_chunk([&](std::uint32_t first, std::uint32_t last) { append_faces(first, last); });
    mesh_.tolerance = options_.edge > 0.0 ? largest_tolerance() : options_.tolerance;
    return std::move(mesh_);
  }

 private:
  double largest_tolerance() const {
    double largest = 0;
    for (const Face& face : surface_.faces) largest = std::max(largest, tolerance_of(rule_, surface_, face));
    return largest;
  }
  void fill_faces() {
    std::vector<std::uint32_t> all(faces_.size());
    std::iota(all.begin(), all.end(), 0u);
    FaceFilling(surface_, rule_, *samples_).fill(std::move(all), faces_);
  }

  /// True if an edge of a rim has an end inside a seam.
  bool is_on_seam(const FaceMesh& mesh, const std::array<int, 2>& edge) const {
    return mesh.rim[edge[0]].border == kSeam || mesh.rim[edge[1]].border == kSeam;
  }
  /// An edge between two rim points: the inner edge `index` of a face, or with face kNone an edge of a rim.
  struct Bridge {
    BorderPoint a, b;
    std::uint32_t face;
    std::uint32_t index;
    auto key() const { return std::tie(a, b); }
    std::size_t hash() const {
      std::uint64_t sum = 0;
      for (const std::uint32_t part : {a.border, a.index, b.border, b.index}) sum = (sum ^ part) * 0x9e3779b97f4a7c15u;
      return sum >> 32;
    }
  };
  template <typename Visit>
  void for_each_bridge(const Visit& visit) const {
    auto add = [&](std::uint32_t f, int u, int w, std::uint32_t face, std::uint32_t index) {
      BorderPoint a = faces_[f].rim[u], b = faces_[f].rim[w];
      for (BorderPoint* p : {&a, &b}) {
        if (p->border == kSeam) p->index += kSeamNames * f;  // names on seams are unique only within a face
      }
      visit(Bridge{std::min(a, b), std::max(a, b), face, index});
    };
    for (std::uint32_t f = 0; f < faces_.size(); ++f) {
      for (std::uint32_t i = 0; i < faces_[f].bridges.size(); ++i) {
        const auto [u, w] = faces_[f].bridges[i];
        add(f, u, w, f, i);
      }
      for (const auto& edge : faces_[f].rim_edges) {
        if (is_on_seam(faces_[f], edge)) add(f, edge[0], edge[1], kNone, 0);
      }
    }
    for (std::uint32_t b = 0; b < surface_.borders.size(); ++b) {
      for (std::uint32_t k = 0; k < samples_->segment_count(b); ++k) {
        const auto p = samples_->point(b, k), q = samples_->point(b, k + 1);
        visit(Bridge{std::min(p, q), std::max(p, q), kNone, 0});
      }
    }
  }

  /// Splits inner edges that two faces draw between the same two rim points, so that each gets a vertex of its own.
  /// They are few, so only bridges that share a place in a table by their names are sorted.
  void split_shared_edges() {
    std::vector<std::uint8_t> count(std::bit_ceil(16 * faces_.size() + 64), 0);
    const auto place = [&](const Bridge& bridge) { return bridge.hash() & (count.size() - 1); };
    for_each_bridge([&](const Bridge& bridge) {
      std::uint8_t& here = count[place(bridge)];
      if (here < 2) ++here;
    });
    std::vector<Bridge> bridges;
    for_each_bridge([&](const Bridge& bridge) {
      if (count[place(bridge)] > 1) bridges.push_back(bridge);
    });
    std::sort(bridges.begin(), bridges.end(), [](const Bridge& x, const Bridge& y) {
      return std::tie(x.a, x.b, x.face, x.index) < std::tie(y.a, y.b, y.face, y.index);
    });
    for (std::size_t i = 0; i < bridges.size(); ++i) {
      const bool doubled = (i > 0 && bridges[i - 1].key() == bridges[i].key()) ||
                           (i + 1 < bridges.size() && bridges[i + 1].key() == bridges[i].key());
      if (!doubled || bridges[i].face == kNone) continue;
      FaceMesh& mesh = faces_[bridges[i].face];
      const auto [u, w] = mesh.bridges[bridges[i].index];
      split_edge(mesh, u, w);
    }
  }

  /// Numbers the vertices: the used vertices of the surface, then border samples, then each face's own.
  void number_vertices() {
    std::uint32_t next = 0;
    vertex_number_.assign(surface_.vertices.size(), kNone);
    for (const FaceMesh& mesh : faces_) {
      for (const BorderPoint& name : mesh.rim) {
        if (name.border == kNone && vertex_number_[name.index] == kNone) {
          vertex_number_[name.index] = next++;
          mesh_.positions.push_back(surface_.vertices[name.index]);
        }
      }
    }
    mesh_.corner_count = next;
    border_number_.resize(surface_.borders.size());
    for (std::uint32_t b = 0; b < surface_.borders.size(); ++b) {
      const std::uint32_t n = samples_->segment_count(b);
      const bool ring = surface_.borders[b].vertex[0] == kNone;
      border_number_[b] = ring ? next : next - 1;  // sample 1 of an arc is its first inner point
      for (std::uint32_t k = ring ? 0 : 1; k < n; ++k, ++next) mesh_.positions.push_back(samples_->position(b, k));
    }
    mesh_.border_point_count = next - mesh_.corner_count;
    reserve_rows();
  }

  /// Returns the number of vertices that no other face has.
  static std::uint32_t own_vertex_count(const FaceMesh& mesh) {
    std::set<std::uint32_t> seam;
    for (const BorderPoint& name : mesh.rim)
      if (name.border == kSeam) seam.insert(name.index);
    return static_cast<std::uint32_t>(mesh.points.size() - mesh.rim.size() + seam.size());
  }
  void reserve_rows() {
    std::size_t vertices = mesh_.positions.size(), triangles = 0;
    for (const FaceMesh& mesh : faces_) {
      vertices += own_vertex_count(mesh);
      triangles += mesh.triangles.size();
    }
    mesh_.positions.reserve(vertices);
    mesh_.normals.reserve(vertices);
    mesh_.triangles.reserve(triangles);
    mesh_.kind.reserve(triangles);
    for (std::vector<std::uint32_t>* column : {&mesh_.face, &mesh_.patch, &mesh_.component, &mesh_.atom})
      column->reserve(triangles);
  }
  /// Calls work(first, last) for ranges of faces, in order.
  template <typename Work>
  void for_each_chunk(const Work& work) const {
    const auto count = static_cast<std::uint32_t>(faces_.size());
    for (std::uint32_t first = 0; first < count; first += kFacesTogether)
      work(first, std::min(first + kFacesTogether, count));
  }
  std::uint32_t number(const BorderPoint& name) const {
    return name.border == kNone ? vertex_number_[name.index] : border_number_[name.border] + name.index;
  }

  /// True if corner v of a face's triangles is a vertex that other faces have, too.
  static bool is_shared(const FaceMesh& part, std::uint32_t v) {
    return v < part.rim.size() && part.rim[v].border != kSeam;
  }
  static glm::dvec3 corner_normal(const FaceMesh& part, std::size_t triangle, int k) {
    const auto& v = part.triangles[triangle];
    return part.domain->corner_normal(part.points[v[k]], part.points[v[(k + 1) % 3]], part.points[v[(k + 2) % 3]]);
  }

  /// Calls visit(triangle, corner, vertex) for the corners of a face's triangles at shared vertices.
  template <typename Visit>
  void for_each_shared_corner(const FaceMesh& part, const Visit& visit) const {
    for (std::size_t t = 0; t < part.triangles.size(); ++t)
      for (int k = 0; k < 3; ++k) {
        const std::uint32_t v = part.triangles[t][k];
        if (is_shared(part, v)) visit(t, k, number(part.rim[v]));
      }
  }

  /// Calls note(vertex, normal) for the corners at shared vertices for which wanted(vertex) is true, face after face.
  /// once_a_face: each face is called once for a sample inside a border, because its corners share one normal there.
  template <typename Wanted, typename Note>
  void for_each_shared_normal(bool once_a_face, const Wanted& wanted, const Note& note) const {
    for_each_chunk([&](std::uint32_t first, std::uint32_t last) {
      std::vector<std::vector<std::pair<std::uint32_t, glm::dvec3>>> normals(last - first);
      tbb::parallel_for(first, last, [&](std::uint32_t f) {
        const FaceMesh& part = faces_[f];
        std::vector<char> noted(part.rim.size(), 0);
        for_each_shared_corner(part, [&](std::size_t t, int k, std::uint32_t vertex) {
          const std::uint32_t v = part.triangles[t][k];
          if (noted[v] || !wanted(vertex)) return;
          noted[v] = once_a_face && part.rim[v].border != kNone;
          normals[f - first].emplace_back(vertex, corner_normal(part, t, k));
        });
      });
      for (const auto& of_face : normals)
        for (const auto& [vertex, normal] : of_face) note(vertex, normal);
    });
  }

  /// Computes the normal of each shared vertex: that of the first corner or, if faces do not agree, the mean of all
  /// corners. Few vertices are sharp, so a second pass sums up the normals of these alone.
  void find_shared_normals() {
    std::vector<glm::dvec3>& normals = mesh_.normals;
    normals.resize(mesh_.positions.size(), glm::dvec3(0.0));
    sharp_.resize(normals.size(), false);
    for_each_shared_normal(
        true, [](std::uint32_t) { return true; },
        [&](std::uint32_t vertex, const glm::dvec3& n) {
          if (normals[vertex] == glm::dvec3(0.0)) normals[vertex] = n;
          if (glm::distance(normals[vertex], n) > kSharpAngle) sharp_[vertex] = true;
        });
    std::unordered_map<std::uint32_t, glm::dvec3> sums;
    for_each_shared_normal(
        false, [&](std::uint32_t vertex) { return sharp_[vertex]; },
        [&](std::uint32_t vertex, const glm::dvec3& n) { sums.try_emplace(vertex, 0.0).first->second += n; });
    for (const auto& [vertex, sum] : sums)
      if (const double size = glm::length(sum); size > 1e-6) normals[vertex] = sum / size;
  }

  /// The first rows of a face.
  struct FacePlace {
    std::uint32_t vertex = 0, triangle = 0;
  };
  /// Corners at vertices without a single normal.
  struct SharpCorners {
    std::vector<std::uint32_t> corners;
    std::vector<glm::dvec3> normals;
  };

  /// Moves the rows of faces into the mesh and frees them: keeping both would need twice the memory.
  void append_faces(std::uint32_t first, std::uint32_t last) {
    std::vector<FacePlace> places;
    FacePlace next{static_cast<std::uint32_t>(mesh_.positions.size()),
                   static_cast<std::uint32_t>(mesh_.triangles.size())};
    for (std::uint32_t f = first; f < last; ++f) {
      places.push_back(next);
      next.vertex += own_vertex_count(faces_[f]);
      next.triangle += static_cast<std::uint32_t>(faces_[f].triangles.size());
    }
    mesh_.positions.resize(next.vertex);
    mesh_.normals.resize(next.vertex);
    mesh_.triangles.resize(next.triangle);
    mesh_.kind.resize(next.triangle);
    for (std::vector<std::uint32_t>* column : {&mesh_.face, &mesh_.patch, &mesh_.component, &mesh_.atom})
      column->resize(next.triangle);
    std::vector<SharpCorners> sharp(last - first);
    tbb::parallel_for(first, last, [&](std::uint32_t f) {
      put_face(f, places[f - first], sharp[f - first]);
      faces_[f] = {};
    });
    for (const SharpCorners& some : sharp) {
      mesh_.sharp_corners.insert(mesh_.sharp_corners.end(), some.corners.begin(), some.corners.end());
      mesh_.sharp_corner_normals.insert(mesh_.sharp_corner_normals.end(), some.normals.begin(), some.normals.end());
    }
    const std::uint32_t freed = std::max(kFacesFreed, static_cast<std::uint32_t>(faces_.size()) / kTimesFreed);
    if (last / freed != first / freed) return_free_memory();
  }
  void put_face(std::uint32_t f, const FacePlace& place, SharpCorners& sharp) {
    const FaceMesh& part = faces_[f];
    const Face& face = surface_.faces[f];
    const std::vector<std::uint32_t> index = put_vertices(part, place.vertex);
    for (std::size_t t = 0; t < part.triangles.size(); ++t) {
      const auto& v = part.triangles[t];
      const std::size_t row = place.triangle + t;
      mesh_.triangles[row] = {index[v[0]], index[v[1]], index[v[2]]};
      mesh_.face[row] = f;
      mesh_.kind[row] = face.kind;
      mesh_.patch[row] = face.patch;
      mesh_.component[row] = face.component;
      mesh_.atom[row] = part.atom[t];
    }
    for_each_shared_corner(part, [&](std::size_t t, int k, std::uint32_t vertex) {
      if (!sharp_[vertex]) return;
      sharp.corners.push_back(static_cast<std::uint32_t>(3 * (place.triangle + t) + k));
      sharp.normals.push_back(corner_normal(part, t, k));
    });
  }
  /// Adds the face's own vertices; returns the number of each of its points.
  std::vector<std::uint32_t> put_vertices(const FaceMesh& part, std::uint32_t next) {
    std::vector<std::uint32_t> index(part.points.size());
    std::map<std::uint32_t, std::uint32_t> seam;
    auto own = [&](std::size_t i) {
      mesh_.positions[next] = part.points[i].position;
      mesh_.normals[next] = part.domain->normal(part.points[i]);
      return next++;
    };
    for (std::size_t i = 0; i < index.size(); ++i) {
      if (i >= part.rim.size()) {
        index[i] = own(i);
      } else if (part.rim[i].border == kSeam) {
        const auto [at, fresh] = seam.try_emplace(part.rim[i].index, 0);
        if (fresh) at->second = own(i);
        index[i] = at->second;
      } else {
        index[i] = number(part.rim[i]);
      }
    }
    return index;
  }

  void add_sharp_edges() {
    for (std::uint32_t b = 0; b < surface_.borders.size(); ++b) {
      if (surface_.borders[b].kind != BorderKind::cusp) continue;
      for (std::uint32_t k = 0; k < samples_->segment_count(b); ++k) {
        mesh_.sharp_edges.push_back({number(samples_->point(b, k)), number(samples_->point(b, k + 1))});
      }
    }
  }

  const Surface& surface_;
  const MeshOptions& options_;
  const EdgeRule rule_;
  std::optional<BorderSamples> samples_;  // reset once vertices are numbered
  std::vector<FaceMesh> faces_;
  TriangleMesh mesh_;
  std::vector<std::uint32_t> vertex_number_, border_number_;
  std::vector<bool> sharp_;  ///< per shared vertex: true if it has no single normal
};

}  // namespace

TriangleMesh tessellate(const Surface& surface, const MeshOptions& options) {
  require_borders(surface);
  if (!(options.tolerance > 0.0) || !std::isfinite(options.tolerance))
    throw Error("mesh tolerance: {} Å; give a number above 0", options.tolerance);
  if (!(options.edge >= 0.0) || !std::isfinite(options.edge))
    throw Error("mesh edges: {} Å; give a number above 0, or 0 for those of the tolerance", options.edge);
  TriangleMesh mesh = Tessellation(surface, options).run();
  return_free_memory();
  if (!mesh.triangles.empty() && !measure(mesh).closed)
    throw OpenSurfaceError("the mesh at {} Å is not closed; give another tolerance", mesh.tolerance);
  if (const std::vector<std::string> found = differences(surface, mesh); !found.empty())
    throw OpenSurfaceError("the mesh at {} Å does not match the surface: {}; give another tolerance", mesh.tolerance,
                           found.front());
  return mesh;
}

namespace {

constexpr std::array kTolerances{0.1, 0.03, 0.01};  // Å; each is tried after the coarser ones have failed

}  // namespace

void check_by_mesh(const Surface& surface) {
  for (const double tolerance : kTolerances) {
    try {
      tessellate(surface, {tolerance, false});
      return;
    } catch (const OpenSurfaceError& error) {
      if (tolerance == kTolerances.back()) throw OpenSurfaceError(message("@verify@: {}", error.what()));
    }
  }
}

}  // namespace meniscus
