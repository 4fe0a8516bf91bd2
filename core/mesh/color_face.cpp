// SPDX-License-Identifier: BSD-3-Clause
// Gives triangles their atom and cuts them where the nearest contact changes, so that colours end along edges.
#include <map>
#include <span>

#include "core/mesh/mesh_colors.h"
#include "core/mesh/face_mesh.h"

namespace meniscus {
namespace {

/// Scores closer than this are a tie: border samples lie on colour lines up to rounding.
constexpr double kTie = 1e-9;
constexpr int kMostPasses = 8;

/// Cuts the triangles of one face along its colour lines.
class ColorCutter {
 public:
  /// `scores` has one score for each contact at each point; the contact with the largest score wins there.
  ColorCutter(FaceMesh& mesh, std::size_t contacts, std::vector<double> scores)
      : mesh_(mesh), contacts_(contacts), scores_(std::move(scores)) {
    for (const auto& edge : mesh.rim_edges)
      rim_edges_.emplace_back(std::min(edge[0], edge[1]), std::max(edge[0], edge[1]));
    std::ranges::sort(rim_edges_);
  }

  /// Cuts triangles until every one has a single winner: cutting an edge may reveal a third contact on the rest of it.
  void run() {
    for (int pass = 0; pass < kMostPasses; ++pass) {
      const auto old = std::move(mesh_.triangles);
      mesh_.triangles.clear();
      mesh_.triangles.reserve(old.size());
      crossings_.clear();
      for (const auto& t : old) cut(t);
      if (mesh_.triangles.size() == old.size()) return;
    }
  }

 private:
  std::span<const double> scores(std::uint32_t vertex) const {
    return std::span(scores_).subspan(contacts_ * vertex, contacts_);
  }
  bool wins(std::uint32_t vertex, std::size_t contact) const {
    const std::span<const double> s = scores(vertex);
    return s[contact] >= *std::max_element(s.begin(), s.end()) - kTie;
  }
  /// Returns a contact that wins at all of these vertices, and so between them, because scores are linear.
  std::optional<std::size_t> shared_winner(std::initializer_list<std::uint32_t> vertices) const {
    for (std::size_t c = 0; c < contacts_; ++c) {
      if (std::all_of(vertices.begin(), vertices.end(), [&](std::uint32_t v) { return wins(v, c); })) return c;
    }
    return std::nullopt;
  }
  /// Adds the point with these weights at three vertices; the tied contacts get the same score there.
  std::uint32_t add(const std::array<std::uint32_t, 3>& v, const std::array<double, 3>& weight,
                    std::initializer_list<std::size_t> tied) {
    const auto index = static_cast<std::uint32_t>(mesh_.points.size());
    scores_.resize(scores_.size() + contacts_, 0.0);
    const std::span<double> sum = std::span(scores_).last(contacts_);
    for (int k = 0; k < 3; ++k) {
      for (std::size_t c = 0; c < contacts_; ++c) sum[c] += weight[k] * scores(v[k])[c];
    }
    double best = sum[*tied.begin()];
    for (std::size_t c : tied) best = std::max(best, sum[c]);
    for (std::size_t c : tied) sum[c] = best;  // they are equal except for rounding
    mesh_.points.push_back(
        mesh_.domain->between({&mesh_.points[v[0]], &mesh_.points[v[1]], &mesh_.points[v[2]]}, weight));
    return index;
  }
  /// Returns the first point of an edge where another contact overtakes; the two triangles of the edge share it.
  std::uint32_t crossing(std::uint32_t a, std::uint32_t b) {
    if (a > b) std::swap(a, b);
    const auto [at, fresh] = crossings_.try_emplace({a, b}, 0);
    if (fresh) {
      const std::span<const double> from = scores(a), to = scores(b);
      std::size_t first = 0;  // the contact that wins just after a; it wins at a, too
      for (std::size_t c = 1; c < from.size(); ++c) {
        if (wins(a, c) && (!wins(a, first) || to[c] > to[first])) first = c;
      }
      double share = 2.0;
      std::size_t next = first;
      for (std::size_t c = 0; c < from.size(); ++c) {
        const double lead = std::max(from[first] - from[c], 0.0), gain = (to[c] - to[first]) + lead;
        if (to[c] <= to[first] || lead / gain >= share) continue;
        share = lead / gain;
        next = c;
      }
      at->second = add({a, b, b}, {1.0 - share, share, 0.0}, {first, next});
    }
    return at->second;
  }
  /// Returns the weights of the point of a triangle where three contacts are equally near.
  std::array<double, 3> junction(const std::array<std::uint32_t, 3>& t, std::size_t a, std::size_t b,
                                 std::size_t c) const {
    std::array<glm::dvec2, 3> lead;
    for (int k = 0; k < 3; ++k) {
      const std::span<const double> s = scores(t[k]);
      lead[k] = {s[a] - s[b], s[a] - s[c]};
    }
    auto cross = [](const glm::dvec2& u, const glm::dvec2& v) { return u.x * v.y - u.y * v.x; };
    const std::array<double, 3> weight{cross(lead[1], lead[2]), cross(lead[2], lead[0]), cross(lead[0], lead[1])};
    const double sum = weight[0] + weight[1] + weight[2];
    if (sum == 0.0 || *std::min_element(weight.begin(), weight.end()) * sum < 0.0) return {1.0 / 3, 1.0 / 3, 1.0 / 3};
    return {weight[0] / sum, weight[1] / sum, weight[2] / sum};
  }

  /// Cuts a triangle without crossed edges: if no contact wins everywhere, three of them meet inside.
  void cut_at_junction(const std::array<std::uint32_t, 3>& t) {
    const auto a = shared_winner({t[0], t[1]}), b = shared_winner({t[1], t[2]}), c = shared_winner({t[2], t[0]});
    auto& out = mesh_.triangles;
    if (!a || !b || !c || *a == *b || *b == *c || *c == *a || shared_winner({t[0], t[1], t[2]})) {
      out.push_back(t);
      return;
    }
    const std::uint32_t middle = add(t, junction(t, *a, *b, *c), {*a, *b, *c});
    for (int k = 0; k < 3; ++k) out.push_back({t[k], t[(k + 1) % 3], middle});
  }

  void cut(const std::array<std::uint32_t, 3>& t) {
    std::array<bool, 3> crossed{};  // edge k from t[k] to t[k+1]
    int count = 0;
    for (int k = 0; k < 3; ++k) {
      const int a = static_cast<int>(t[k]), b = static_cast<int>(t[(k + 1) % 3]);
      crossed[k] = !shared_winner({t[k], t[(k + 1) % 3]}) && !is_on_rim(std::min(a, b), std::max(a, b));
      count += crossed[k];
    }
    auto& out = mesh_.triangles;
    if (count == 0) {
      cut_at_junction(t);
    } else if (count == 1) {
      const int k = crossed[0] ? 0 : crossed[1] ? 1 : 2;
      const std::uint32_t a = t[k], b = t[(k + 1) % 3], c = t[(k + 2) % 3], m = crossing(a, b);
      out.push_back({a, m, c});
      out.push_back({m, b, c});
    } else if (count == 2) {
      const int k = !crossed[0] ? 2 : !crossed[1] ? 0 : 1;  // the corner between the two crossed edges
      const std::uint32_t a = t[k], b = t[(k + 1) % 3], c = t[(k + 2) % 3];
      const std::uint32_t m = crossing(a, b), n = crossing(c, a);
      out.push_back({a, m, n});
      out.push_back({m, b, n});
      out.push_back({n, b, c});
    } else {
      const std::uint32_t m0 = crossing(t[0], t[1]), m1 = crossing(t[1], t[2]), m2 = crossing(t[2], t[0]);
      out.push_back({t[0], m0, m2});
      out.push_back({m0, t[1], m1});
      out.push_back({m2, m1, t[2]});
      out.push_back({m0, m1, m2});
    }
  }

  bool is_on_rim(int a, int b) const { return std::ranges::binary_search(rim_edges_, std::pair(a, b)); }

  FaceMesh& mesh_;
  std::size_t contacts_;
  std::vector<double> scores_;
  std::vector<std::pair<int, int>> rim_edges_;  ///< sorted edges that other faces share, and that are never cut
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> crossings_;
};

void color_concave(const Surface& surface, const ConcavePatch& patch, FaceMesh& mesh, bool split) {
  const auto contacts = contact_directions(surface, patch);
  auto score = [&](const glm::dvec3& x, std::size_t c) {
    return glm::dot(contacts[c].direction, x - patch.center) / surface.probe_radius;
  };
  if (split) {
    std::vector<double> scores;
    for (const FacePoint& p : mesh.points)
      for (std::size_t c = 0; c < contacts.size(); ++c) scores.push_back(score(p.position, c));
    ColorCutter(mesh, contacts.size(), std::move(scores)).run();
  }
  mesh.atom.reserve(mesh.triangles.size());
  for (const auto& t : mesh.triangles) {
    const glm::dvec3 middle =
        (mesh.points[t[0]].position + mesh.points[t[1]].position + mesh.points[t[2]].position) / 3.0;
    std::size_t best = 0;
    for (std::size_t c = 1; c < contacts.size(); ++c) {
      if (score(middle, c) > score(middle, best)) best = c;
    }
    mesh.atom.push_back(contacts[best].atom);
  }
}

void color_torus(const Surface& surface, const ToroidalPatch& patch, FaceMesh& mesh, bool split) {
  const auto angles = contact_angles(surface, patch);
  const double middle = 0.5 * (angles[0] + angles[1]);
  if (split) {
    std::vector<double> scores;
    for (const FacePoint& p : mesh.points) scores.insert(scores.end(), {middle - p.angles.y, p.angles.y - middle});
    ColorCutter(mesh, 2, std::move(scores)).run();
  }
  mesh.atom.reserve(mesh.triangles.size());
  for (const auto& t : mesh.triangles) {
    const double tube = (mesh.points[t[0]].angles.y + mesh.points[t[1]].angles.y + mesh.points[t[2]].angles.y) / 3.0;
    mesh.atom.push_back(patch.atom[tube < middle ? 0 : 1]);
  }
}

}  // namespace

void color_face(const Surface& surface, const Face& face, FaceMesh& mesh, bool split) {
  if (face.kind == PatchKind::convex) {
    mesh.atom.assign(mesh.triangles.size(), surface.convex[face.patch].atom);
  } else if (face.kind == PatchKind::toroidal) {
    color_torus(surface, surface.toroidal[face.patch], mesh, split);
  } else {
    color_concave(surface, surface.concave[face.patch], mesh, split);
  }
}

}  // namespace meniscus
