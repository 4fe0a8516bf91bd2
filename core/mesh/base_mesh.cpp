// SPDX-License-Identifier: BSD-3-Clause
// Builds base meshes of each kind, and contracts contact faces of the coarsest mesh to points.
#include "core/mesh/base_mesh.h"

#include <numeric>

#include <tbb/parallel_for.h>

#include "core/base/error.h"
#include "core/mesh/half_edges.h"
#include "core/mesh/tessellate.h"

namespace meniscus {
namespace {

/// Patch-aligned meshes are a scaffold. Their tolerance (Å) follows that of the result within this range.
constexpr double kFinest = 1e-4, kCoarsest = 0.4;
constexpr int kTries = 4;
/// The angle (radian) of arcs that become one edge where contact faces become points.
constexpr double kWideAngle = 1.6;

/// Tessellates the surface, and tries again with a quarter of the tolerance where that fails, kTries times in all.
TriangleMesh patches(const Surface& surface, double tolerance) {
  tolerance = std::clamp(tolerance, kFinest, kCoarsest);
  for (int n = 1;; ++n, tolerance *= 0.25) {
    try {
      return tessellate(surface, {tolerance, false});
    } catch (const OpenSurfaceError&) {
      if (n == kTries) throw;
    }
  }
}

}  // namespace

BaseMesh base_mesh(const Surface& surface, const SurfaceWalk& walk, BaseMeshKind kind, double tolerance) {
  if (kind == BaseMeshKind::contracted) return contracted_mesh(surface, walk, coarse_mesh(surface, walk, kWideAngle));
  BaseMesh base;
  base.mesh = kind == BaseMeshKind::coarse ? coarse_mesh(surface, walk) : patches(surface, tolerance);
  base.vertex_face = vertex_faces(base.mesh);
  return base;
}

// Contraction: where the result would not be a manifold, faces stay as they were.

namespace {

/// The smallest cosine of the angle at a ball's centre between the middle of a contact face and its farthest point:
/// wider faces are not contracted.
constexpr double kWidest = -0.2;

using Triangle = std::array<std::uint32_t, 3>;

/// Contracts contact faces to points, and takes contractions back until the mesh is a manifold of the right topology.
class Contraction {
 public:
  Contraction(const Surface& surface, const SurfaceWalk& walk, const TriangleMesh& coarse)
      : surface_(surface), walk_(walk), coarse_(coarse), disc_of_(coarse.positions.size(), kNone) {}

  BaseMesh run() {
    find_discs();
    do build_triangles();
    while (repair());
    if (!is_sound_) throw OpenSurfaceError("the contracted mesh has another topology");
    return std::move(made_);
  }

 private:
  /// Finds contact faces that can be contracted and the points that they become, and marks their vertices.
  void find_discs() {
    middle_.resize(surface_.faces.size());
    std::vector<std::uint32_t> first(surface_.faces.size() + 1, 0);  // triangles of a face are together
    for (const std::uint32_t f : coarse_.face) ++first[f + 1];
    std::partial_sum(first.begin(), first.end(), first.begin());
    tbb::parallel_for(std::size_t{0}, middle_.size(), [&](std::size_t f) {
      if (first[f] < first[f + 1]) middle_[f] = middle_of(static_cast<std::uint32_t>(f), first[f], first[f + 1]);
    });
    for (std::uint32_t f = 0; f < middle_.size(); ++f) {
      if (!middle_[f]) continue;
      const std::span<const Triangle> own(coarse_.triangles.data() + first[f], first[f + 1] - first[f]);
      const bool is_free = std::all_of(own.begin(), own.end(), [&](const Triangle& t) {
        return std::all_of(t.begin(), t.end(), [&](std::uint32_t v) { return disc_of_[v] == kNone; });
      });
      if (!is_free) continue;
      for (const Triangle& t : own)
        for (const std::uint32_t v : t) disc_of_[v] = f;
    }
  }

  /// Returns the middle of a contact face that is a disc seen from there; nothing for other faces.
  std::optional<glm::dvec3> middle_of(std::uint32_t f, std::uint32_t begin, std::uint32_t end) const {
    const Face& face = surface_.faces[f];
    if (face.kind != PatchKind::convex || face.loop_count != 1) return std::nullopt;
    const Ball& ball = surface_.atoms[surface_.convex[face.patch].atom];
    glm::dvec3 area(0.0);
    for (std::uint32_t t = begin; t < end; ++t) {
      const auto& [a, b, c] = coarse_.triangles[t];
      area += glm::cross(coarse_.positions[b] - coarse_.positions[a], coarse_.positions[c] - coarse_.positions[a]);
    }
    const double size = glm::length(area);
    if (!(size > 0.0)) return std::nullopt;
    const glm::dvec3 out = area / size;
    for (std::uint32_t t = begin; t < end; ++t)
      for (const std::uint32_t v : coarse_.triangles[t])
        if (glm::dot(out, coarse_.positions[v] - ball.center) < kWidest * ball.radius) return std::nullopt;
    const auto at = walk_.below(ball.center + ball.radius * out, f);
    if (!at || at->face != f) return std::nullopt;
    return at->position;
  }

  /// Builds the contracted mesh, in which triangles with two corners in one disc vanish.
  void build_triangles() {
    made_ = {};
    disc_.clear();
    std::vector<std::uint32_t> number(disc_of_.size(), kNone), number_of_disc(surface_.faces.size(), kNone);
    const auto number_of = [&](std::uint32_t v, std::uint32_t face) {
      const std::uint32_t d = disc_of_[v];
      std::uint32_t& n = d == kNone ? number[v] : number_of_disc[d];
      if (n != kNone) return n;
      n = static_cast<std::uint32_t>(disc_.size());
      made_.mesh.positions.push_back(d == kNone ? coarse_.positions[v] : *middle_[d]);
      made_.vertex_face.push_back(d == kNone ? face : d);
      disc_.push_back(d);
      return n;
    };
    const auto same = [&](std::uint32_t v, std::uint32_t w) {
      return v == w || (disc_of_[v] != kNone && disc_of_[v] == disc_of_[w]);
    };
    for (std::size_t t = 0; t < coarse_.triangles.size(); ++t) {
      const auto& [a, b, c] = coarse_.triangles[t];
      if (same(a, b) || same(b, c) || same(c, a)) continue;
      const std::uint32_t f = coarse_.face[t];
      made_.mesh.triangles.push_back({number_of(a, f), number_of(b, f), number_of(c, f)});
      made_.mesh.face.push_back(f);
    }
  }

  /// Restores discs where triangles do not form a single closed fan around a vertex or, if they do everywhere, all
  /// discs of components that have another topology. Returns true if any disc was restored.
  bool repair() {
    is_sound_ = true;
    std::vector<std::uint8_t> restored(surface_.faces.size(), 0);
    std::vector<std::uint8_t> broken(surface_.components.size(), 0);
    const CornerLists corners(made_.mesh.triangles, static_cast<std::uint32_t>(disc_.size()));
    std::vector<std::uint8_t> has_fan(disc_.size());
    tbb::parallel_for(std::uint32_t{0}, static_cast<std::uint32_t>(disc_.size()),
                      [&](std::uint32_t v) { has_fan[v] = is_closed_fan(made_.mesh.triangles, corners.at(v)); });
    for (std::uint32_t v = 0; v < disc_.size(); ++v) {
      if (has_fan[v]) continue;
      is_sound_ = false;
      std::vector<std::uint32_t> neighbor_discs;  // discs at neighbours of the vertex
      for (const std::uint32_t c : corners.at(v))
        for (const std::uint32_t w : made_.mesh.triangles[c / 3])
          if (w != v && disc_[w] != kNone) neighbor_discs.push_back(disc_[w]);
      if (std::any_of(neighbor_discs.begin(), neighbor_discs.end(), [&](std::uint32_t d) { return restored[d] > 0; }))
        continue;
      if (disc_[v] != kNone) {
        restored[disc_[v]] = 1;
      } else if (neighbor_discs.empty()) {
        broken[component_of(v)] = 1;
      } else {
        for (const std::uint32_t d : neighbor_discs) restored[d] = 1;
      }
    }
    if (is_sound_) mark_other_topology(broken);
    bool any = false;
    for (std::uint32_t& disc : disc_of_)
      if (disc != kNone && (restored[disc] || broken[surface_.faces[disc].component])) disc = kNone, any = true;
    return any;
  }

  std::uint32_t component_of(std::uint32_t vertex) const { return surface_.faces[made_.vertex_face[vertex]].component; }

  /// Marks the components with another Euler characteristic V - E + F, where E = 3 F / 2.
  void mark_other_topology(std::vector<std::uint8_t>& broken) {
    std::vector<int> twice(broken.size(), 0);
    for (std::uint32_t v = 0; v < disc_.size(); ++v) twice[component_of(v)] += 2;
    for (const std::uint32_t f : made_.mesh.face) --twice[surface_.faces[f].component];
    for (std::size_t c = 0; c < broken.size(); ++c) {
      broken[c] = twice[c] != 2 * surface_.components[c].euler;
      if (broken[c]) is_sound_ = false;
    }
  }

  const Surface& surface_;
  const SurfaceWalk& walk_;
  const TriangleMesh& coarse_;
  std::vector<std::optional<glm::dvec3>> middle_;  ///< per face: the point that it becomes, if any
  /// Per vertex of the coarse mesh: the contracted face that it belongs to, or kNone.
  std::vector<std::uint32_t> disc_of_;
  std::vector<std::uint32_t> disc_;  ///< per vertex of the new mesh: the contracted face that it was, or kNone
  BaseMesh made_;
  bool is_sound_ = false;
};

}  // namespace

BaseMesh contracted_mesh(const Surface& surface, const SurfaceWalk& walk, const TriangleMesh& coarse) {
  return Contraction(surface, walk, coarse).run();
}

}  // namespace meniscus
