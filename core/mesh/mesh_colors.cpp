// SPDX-License-Identifier: BSD-3-Clause
// Finds the atom, and so the colour, of each triangle, vertex and point of a mesh and of its caps, the curvature around
// its vertices, and the part of the sky that they see.
#include "core/mesh/mesh_colors.h"

#include <numbers>
#include <tuple>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "core/base/error.h"
#include "core/color/color_maps.h"
#include "core/mesh/triangle_mesh.h"
#include "core/render/cpu/occluders.h"
#include "core/surface/walks.h"

namespace meniscus {

glm::vec3 triangle_color(const TriangleMesh& mesh, const Coloring& coloring, std::size_t triangle) {
  if (coloring.kind) return (*coloring.kind)[static_cast<std::size_t>(mesh.kind[triangle])];
  return coloring.atom[mesh.atom[triangle]];
}

std::vector<glm::vec3> vertex_colors(const TriangleMesh& mesh, const Coloring& coloring) {
  std::vector<glm::vec3> sum(mesh.positions.size(), glm::vec3(0.0f));
  std::vector<float> count(mesh.positions.size(), 0.0f);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const glm::vec3 color = triangle_color(mesh, coloring, t);
    for (const std::uint32_t v : mesh.triangles[t]) {
      sum[v] += color;
      count[v] += 1.0f;
    }
  }
  for (std::size_t v = 0; v < sum.size(); ++v) sum[v] /= std::max(count[v], 1.0f);
  if (!coloring.volume) return sum;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    if (coloring.by_volume(mesh.atom[t]))
      for (const std::uint32_t v : mesh.triangles[t])
        sum[v] = coloring.volume->color(mesh.positions[v], mesh.normals[v]);
  return sum;
}

std::vector<float> vertex_map_values(const TriangleMesh& mesh, const VolumePaint& volume) {
  std::vector<float> values;
  values.reserve(mesh.positions.size());
  for (std::size_t v = 0; v < mesh.positions.size(); ++v)
    values.push_back(static_cast<float>(volume.value(mesh.positions[v], mesh.normals[v])));
  return values;
}

std::vector<std::uint32_t> vertex_atoms(const TriangleMesh& mesh) {
  std::vector<std::uint32_t> atom(mesh.positions.size(), kNone);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (const std::uint32_t v : mesh.triangles[t]) atom[v] = std::min(atom[v], mesh.atom[t]);
  }
  return atom;
}

glm::dvec3 mesh_origin(const TriangleMesh& mesh) {
  if (mesh.positions.empty()) return glm::dvec3(0.0);
  glm::dvec3 low = mesh.positions.front(), high = low;
  for (const glm::dvec3& x : mesh.positions) {
    low = glm::min(low, x);
    high = glm::max(high, x);
  }
  return glm::round(0.5 * (low + high));
}

std::vector<ContactDirection> contact_directions(const Surface& surface, const ConcavePatch& patch) {
  std::vector<ContactDirection> contacts;
  for (std::uint32_t i = 0; i < patch.contact_count; ++i) {
    const std::uint32_t atom = surface.contacts[patch.first_contact + i];
    contacts.push_back({atom, glm::normalize(surface.atoms[atom].center - patch.center)});
  }
  return contacts;
}

std::vector<ContactDirection> contact_directions(const Surface& surface, const ToroidalPatch& patch,
                                                 const glm::dvec3& probe) {
  std::vector<ContactDirection> contacts;
  for (std::uint32_t atom : patch.atom) {
    contacts.push_back({atom, glm::normalize(surface.atoms[atom].center - probe)});
  }
  return contacts;
}

double tube_angle(const ToroidalPatch& patch, const glm::dvec3& position) {
  const glm::dvec3 from_center = position - patch.center;
  const double height = glm::dot(from_center, patch.axis);
  const double distance = glm::length(from_center - height * patch.axis);
  return std::atan2(height, patch.radius - distance);
}

std::array<double, 2> contact_angles(const Surface& surface, const ToroidalPatch& patch) {
  std::array<double, 2> angles{};
  for (int i = 0; i < 2; ++i) {
    const double height = glm::dot(surface.atoms[patch.atom[i]].center - patch.center, patch.axis);
    angles[i] = std::atan2(height, patch.radius);
  }
  return angles;
}

std::vector<double> color_changes(const std::vector<ContactDirection>& contacts, const glm::dvec3& probe,
                                  const Border& border) {
  const glm::dvec3 third = glm::cross(border.axis, border.start);
  auto nearest = [&](double t) {
    const glm::dvec3 x = arc_point(border, t) - probe;
    std::size_t best = 0;
    for (std::size_t i = 1; i < contacts.size(); ++i) {
      if (glm::dot(contacts[i].direction, x) > glm::dot(contacts[best].direction, x)) best = i;
    }
    return best;
  };
  std::vector<double> roots;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    for (std::size_t j = i + 1; j < contacts.size(); ++j) {
      // The contacts i and j are equally near where a + b cos t + c sin t = 0.
      const glm::dvec3 difference = contacts[i].direction - contacts[j].direction;
      const double a = glm::dot(difference, border.center - probe);
      const double b = border.radius * glm::dot(difference, border.start);
      const double c = border.radius * glm::dot(difference, third);
      const double size = std::hypot(b, c);
      if (!(size > std::abs(a))) continue;
      const double middle = std::atan2(c, b), half = std::acos(-a / size);
      for (double t : {middle - half, middle + half}) {
        t = std::fmod(t, 2.0 * std::numbers::pi);
        if (t < 0.0) t += 2.0 * std::numbers::pi;
        if (t > 0.0 && t < border.sweep) roots.push_back(t);
      }
    }
  }
  std::sort(roots.begin(), roots.end());
  // Equidistances with different nearest contacts on their two sides are kept.
  std::vector<double> changes;
  double before = 0.0;
  for (std::size_t i = 0; i < roots.size(); ++i) {
    const double after = i + 1 < roots.size() ? roots[i + 1] : border.sweep;
    if (nearest(0.5 * (before + roots[i])) != nearest(0.5 * (roots[i] + after))) changes.push_back(roots[i]);
    before = roots[i];
  }
  return changes;
}

namespace {

constexpr double kNextAtoms = 1.0;  // Å beyond the nearest atom within which others are searched for

}  // namespace

CapAtoms::CapAtoms(std::vector<Ball> atoms, double probe_radius, std::vector<std::uint32_t> part)
    : atoms_(std::move(atoms)), part_(std::move(part)), probe_radius_(probe_radius), grid_(atoms_, [this] {
        for (const Ball& ball : atoms_) largest_ = std::max(largest_, ball.radius);
        return largest_ + probe_radius_ + kNextAtoms;
      }()) {
  if (atoms_.empty() || part_.size() != atoms_.size())
    throw Error("caps: the number of atoms and that of their parts differ");
  has_parts_ = std::ranges::any_of(part_, [this](std::uint32_t p) { return p != part_[0]; });
}

double CapAtoms::distance(std::uint32_t atom, const glm::dvec3& point) const {
  return glm::distance(point, atoms_[atom].center) - atoms_[atom].radius;
}

CapAtoms::Nearest CapAtoms::nearest(const glm::dvec3& point) const {
  // Atoms that the search misses are farther than `reach`.
  for (double reach = largest_ + probe_radius_ + kNextAtoms;; reach *= 2.0) {
    Nearest best;
    best.distance = std::numeric_limits<double>::infinity();
    grid_.for_each_near(point, reach, [&](std::uint32_t a) {
      const double d = distance(a, point);
      if (std::tie(d, a) >= std::tie(best.distance, best.atom)) return;
      best.distance = d;
      best.atom = a;
    });
    if (best.atom == kNone || best.distance > reach - largest_) continue;
    best.gap = reach - largest_ - best.distance;
    if (has_parts_)
      grid_.for_each_near(point, reach, [&](std::uint32_t a) {
        if (part_[a] != part_[best.atom]) best.gap = std::min(best.gap, distance(a, point) - best.distance);
      });
    return best;
  }
}

namespace {

/// Integrals over the part of the mesh that belongs to a vertex.
struct Measure {
  double area = 0.0, mean = 0.0, gaussian = 0.0;
};

/// Measures the curvature at each vertex of a mesh, and averages these measures.
class Smoothing {
 public:
  explicit Smoothing(const TriangleMesh& mesh) : mesh_(mesh), measures_(mesh.positions.size()) {
    link_edges();
    for (Measure& m : measures_) m.gaussian = 2.0 * std::numbers::pi;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) measure(t);
  }

  /// Returns the mean curvature within `radius` of a vertex. `seen` and `queue` are scratch memory of the caller.
  Curvature average_around(std::uint32_t vertex, double radius, std::vector<std::uint32_t>& seen,
                           std::vector<std::uint32_t>& queue) const {
    Measure sum;
    queue.assign(1, vertex);
    seen[vertex] = vertex;
    for (std::size_t n = 0; n < queue.size(); ++n) {
      const Measure& m = measures_[queue[n]];
      sum.area += m.area;
      sum.mean += m.mean;
      sum.gaussian += m.gaussian;
      for (std::uint32_t i = first_[queue[n]]; i < first_[queue[n] + 1]; ++i) {
        const std::uint32_t next = end_[i].vertex;
        if (seen[next] == vertex || glm::distance(mesh_.positions[next], mesh_.positions[vertex]) > radius) continue;
        seen[next] = vertex;
        queue.push_back(next);
      }
    }
    return {sum.mean / sum.area, sum.gaussian / sum.area};
  }

 private:
  /// An edge that leaves a vertex, and the triangle on its left.
  struct End {
    std::uint32_t vertex, triangle;
  };

  void link_edges() {
    first_.assign(mesh_.positions.size() + 1, 0);
    for (const auto& t : mesh_.triangles)
      for (const std::uint32_t v : t) ++first_[v];
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    end_.resize(first_.back());
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t)
      for (int k = 0; k < 3; ++k) end_[--first_[mesh_.triangles[t][k]]] = {mesh_.triangles[t][(k + 1) % 3], t};
  }

  glm::dvec3 cross(std::size_t t) const {
    const auto& [a, b, c] = mesh_.triangles[t];
    const auto& x = mesh_.positions;
    return glm::cross(x[b] - x[a], x[c] - x[a]);
  }

  /// Returns the triangle on the other side of an edge, or kNone.
  std::uint32_t triangle_across(std::uint32_t from, std::uint32_t to) const {
    for (std::uint32_t i = first_[to]; i < first_[to + 1]; ++i)
      if (end_[i].vertex == from) return end_[i].triangle;
    return kNone;
  }

  void measure(std::size_t t) {
    const glm::dvec3 normal = cross(t);
    const double twice_area = glm::length(normal);
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t a = mesh_.triangles[t][k], b = mesh_.triangles[t][(k + 1) % 3],
                          c = mesh_.triangles[t][(k + 2) % 3];
      const glm::dvec3 &x = mesh_.positions[a], along = mesh_.positions[b] - x;
      measures_[a].area += twice_area / 6.0;
      measures_[a].gaussian -= std::atan2(twice_area, glm::dot(along, mesh_.positions[c] - x));
      const std::uint32_t other = triangle_across(a, b);
      if (a > b || other == kNone) continue;
      // Half the angle times the length is the integral of the mean curvature; each end has half of it.
      const glm::dvec3 beyond = cross(other), direction = along / std::max(glm::length(along), 1e-300);
      const double angle = std::atan2(glm::dot(direction, glm::cross(normal, beyond)), glm::dot(normal, beyond));
      for (const std::uint32_t v : {a, b}) measures_[v].mean += 0.25 * angle * glm::length(along);
    }
  }

  const TriangleMesh& mesh_;
  std::vector<std::uint32_t> first_;  // per vertex: the start of its edges in end_, followed by their end
  std::vector<End> end_;
  std::vector<Measure> measures_;
};

}  // namespace

std::vector<Curvature> smoothed_curvatures(const TriangleMesh& mesh, double radius) {
  const Smoothing smoothing(mesh);
  std::vector<Curvature> smoothed(mesh.positions.size());
  struct Scratch {
    std::vector<std::uint32_t> seen, queue;
  };
  tbb::enumerable_thread_specific<Scratch> scratches([&] { return Scratch{std::vector(smoothed.size(), kNone), {}}; });
  tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, static_cast<std::uint32_t>(smoothed.size()), 256),
                    [&](const auto& range) {
                      Scratch& scratch = scratches.local();
                      for (std::uint32_t v = range.begin(); v != range.end(); ++v)
                        smoothed[v] = smoothing.average_around(v, radius, scratch.seen, scratch.queue);
                    });
  return smoothed;
}

std::vector<float> vertex_open_sky(const Surface& surface, const TriangleMesh& mesh) {
  return sky_visibility(surface, {mesh.positions, mesh.normals});
}

std::vector<double> atom_open_sky(const Surface& surface, const TriangleMesh& mesh) {
  const std::vector<float> seen = vertex_open_sky(surface, mesh);
  std::vector<double> means(surface.atoms.size(), 0.0), areas = means;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    const glm::dvec3 &from = mesh.positions[a], side = mesh.positions[b] - from, other = mesh.positions[c] - from;
    const double area = glm::length(glm::cross(side, other));
    means[mesh.atom[t]] += area * static_cast<double>(seen[a] + seen[b] + seen[c]) / 3.0;
    areas[mesh.atom[t]] += area;
  }
  for (std::size_t n = 0; n < means.size(); ++n)
    if (areas[n] > 0.0) means[n] /= areas[n];
  return means;
}

}  // namespace meniscus
