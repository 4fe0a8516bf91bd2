// SPDX-License-Identifier: BSD-3-Clause
// Computes how points of a surface move with its atoms: differentiates the conditions that hold a probe.
#include "core/mesh/velocity.h"

#include <map>
#include <numbers>

#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "core/base/error.h"
#include "core/surface/primitives.h"
#include "core/mesh/triangle_mesh.h"

namespace meniscus {
namespace {

/// The normal equations of conditions direction . v = value; a guess determines v where these leave it open.
class LeastSquares {
 public:
  void add(const glm::dvec3& direction, double value, double weight = 1.0) {
    matrix_ += glm::outerProduct(direction, direction) * weight;
    right_ += direction * (value * weight);
  }
  void keep_near(const glm::dvec3& guess, double weight) {
    matrix_ += glm::dmat3(weight);
    right_ += guess * weight;
  }
  glm::dvec3 solve() const { return glm::inverse(matrix_) * right_; }

 private:
  glm::dmat3 matrix_{0.0};
  glm::dvec3 right_{0.0};
};

/// The weight of a guess: it decides what conditions leave open, and changes the rest by less than a part in 10⁹.
constexpr double kOpen = 1e-12;
/// The weight by which vertices at cusps are pulled to the mean of their faces, so that thin wedges do not shoot off.
constexpr double kCuspPull = 1e-5;

glm::dvec3 mean(const std::vector<glm::dvec3>& velocity, std::span<const std::uint32_t> atoms) {
  glm::dvec3 sum(0.0);
  for (const std::uint32_t a : atoms) sum += velocity[a];
  return sum / static_cast<double>(atoms.size());
}

/// Returns the unit direction from the axis of a torus to x.
glm::dvec3 radial(const ToroidalPatch& t, const glm::dvec3& x) {
  const glm::dvec3 offset = x - t.center;
  const glm::dvec3 flat = offset - glm::dot(offset, t.axis) * t.axis;
  const double size = glm::length(flat);
  return size > 0.0 ? flat / size : t.start;  // a tip lies on the axis, where every direction is as good
}

/// Returns the share of the patch's arc, 0 to 1, at which a direction lies; outside of the arc that of the nearer end.
double share_of_arc(const ToroidalPatch& t, const glm::dvec3& direction) {
  constexpr double whole = 2.0 * std::numbers::pi;
  const double angle = std::atan2(glm::dot(direction, glm::cross(t.axis, t.start)), glm::dot(direction, t.start));
  const double ahead = angle < 0.0 ? angle + whole : angle;
  if (ahead <= t.sweep) return ahead / t.sweep;
  return ahead - t.sweep < whole - ahead ? 1.0 : 0.0;
}

}  // namespace

SurfaceVelocity::SurfaceVelocity(const Surface& surface, std::span<const glm::dvec3> atom_velocity)
    : surface_(surface), atom_(atom_velocity.begin(), atom_velocity.end()) {
  if (atom_.size() != surface.atoms.size()) throw Error("surface velocity: not one velocity for each atom");
  for (const ConcavePatch& c : surface.concave) {
    const std::span atoms(surface.contacts.data() + c.first_contact, c.contact_count);
    const glm::dvec3 guess = mean(atom_, atoms);
    LeastSquares conditions;
    for (const std::uint32_t a : atoms) {
      const glm::dvec3 direction = glm::normalize(c.center - surface.atoms[a].center);
      conditions.add(direction, glm::dot(direction, atom_[a] - guess));
    }
    conditions.keep_near(glm::dvec3(0.0), kOpen);
    probe_.push_back(limited(guess + conditions.solve(), atoms));
  }
}

glm::dvec3 SurfaceVelocity::limited(const glm::dvec3& velocity, std::span<const std::uint32_t> atoms) const {
  const glm::dvec3 guess = mean(atom_, atoms);
  const double speed = glm::distance(velocity, guess), most = 2.0 * surface_.probe_radius;
  return speed > most ? guess + (velocity - guess) * (most / speed) : velocity;
}

glm::dvec3 SurfaceVelocity::carried(const ToroidalPatch& t, const glm::dvec3& s) const {
  const Ball &first = surface_.atoms[t.atom[0]], &second = surface_.atoms[t.atom[1]];
  const glm::dvec3 line = second.center - first.center;
  const glm::dvec3 turn = glm::cross(line, atom_[t.atom[1]] - atom_[t.atom[0]]) / glm::dot(line, line);
  return atom_[t.atom[0]] + glm::cross(turn, s - first.center);
}

glm::dvec3 SurfaceVelocity::of_rolling_probe(std::uint32_t toroidal, const glm::dvec3& s) const {
  const ToroidalPatch& t = surface_.toroidal[toroidal];
  const glm::dvec3 outward = radial(t, s), along = glm::cross(t.axis, outward);
  double rolled = 0.0;
  if (!t.free()) {
    std::array<double, 2> at_end{};
    for (int end = 0; end < 2; ++end) {
      const glm::dvec3& probe = surface_.concave[t.probe[end]].center;
      const glm::dvec3 tangent = glm::cross(t.axis, radial(t, probe));
      at_end[end] = glm::dot(tangent, probe_[t.probe[end]] - carried(t, probe));
    }
    rolled = at_end[0] + (at_end[1] - at_end[0]) * share_of_arc(t, outward);
  }
  const glm::dvec3 guess = carried(t, s);
  LeastSquares conditions;
  for (const std::uint32_t a : t.atom) {
    const glm::dvec3 direction = glm::normalize(s - surface_.atoms[a].center);
    conditions.add(direction, glm::dot(direction, atom_[a] - guess));
  }
  conditions.add(along, rolled);
  conditions.keep_near(glm::dvec3(0.0), kOpen);
  return limited(guess + conditions.solve(), t.atom);
}

glm::dvec3 SurfaceVelocity::on_probe(const glm::dvec3& s, const glm::dvec3& velocity,
                                     std::span<const std::uint32_t> atoms, const glm::dvec3& x) const {
  glm::dmat3 matrix(kOpen);
  glm::dvec3 right(0.0);
  for (const std::uint32_t a : atoms) {
    const glm::dvec3 offset = surface_.atoms[a].center - s;
    const double size = glm::length(offset);
    const glm::dvec3 direction = offset / size, change = (atom_[a] - velocity) / size;
    matrix += glm::dmat3(1.0) - glm::outerProduct(direction, direction);
    right += glm::cross(direction, change);
  }
  return velocity + glm::cross(glm::inverse(matrix) * right, x - s);
}

glm::dvec3 SurfaceVelocity::at(PatchKind kind, std::uint32_t patch, const glm::dvec3& x,
                               const glm::dvec3& normal) const {
  if (kind == PatchKind::convex) return atom_[surface_.convex[patch].atom];
  if (kind == PatchKind::concave) {
    const ConcavePatch& c = surface_.concave[patch];
    const std::span atoms(surface_.contacts.data() + c.first_contact, c.contact_count);
    return on_probe(c.center, probe_[patch], atoms, x);
  }
  // A tip of a spindle is touched from many places: the normal tells them apart.
  const ToroidalPatch& t = surface_.toroidal[patch];
  const glm::dvec3 s = t.center + t.radius * radial(t, x + surface_.probe_radius * normal);
  return on_probe(s, of_rolling_probe(patch, s), t.atom, x);
}

namespace {

/// Combines the velocities that the faces at each vertex of a mesh have there.
class VertexVelocities {
 public:
  VertexVelocities(const Surface& surface, const TriangleMesh& mesh, const SurfaceVelocity& velocity)
      : mesh_(mesh), limit_(2.0 * surface.probe_radius), mean_(mesh.positions.size(), glm::dvec3(0.0)) {
    std::vector<std::uint32_t> corners(mesh.positions.size(), 0);
    each_corner([&](std::uint32_t v, std::size_t t, const glm::dvec3& normal, bool) {
      mean_[v] += velocity.at(mesh.kind[t], mesh.patch[t], mesh.positions[v], normal);
      ++corners[v];
    });
    for (std::size_t v = 0; v < mean_.size(); ++v) mean_[v] /= std::max(corners[v], 1u);
    std::map<std::uint32_t, LeastSquares> sharp;
    each_corner([&](std::uint32_t v, std::size_t t, const glm::dvec3& normal, bool is_sharp) {
      if (!is_sharp) return;
      const glm::dvec3 own = velocity.at(mesh.kind[t], mesh.patch[t], mesh.positions[v], normal);
      sharp[v].add(normal, glm::dot(normal, own - mean_[v]), 1.0 / corners[v]);
    });
    for (auto& [v, conditions] : sharp) {
      conditions.keep_near(glm::dvec3(0.0), kCuspPull);
      const glm::dvec3 change = conditions.solve();
      const double size = glm::length(change);
      mean_[v] += size > limit_ ? change * (limit_ / size) : change;
    }
  }
  std::vector<glm::dvec3> take() { return std::move(mean_); }

 private:
  /// Calls visit(vertex, triangle, normal, is_sharp) for each corner of each triangle.
  void each_corner(const auto& visit) const {
    std::size_t next = 0;
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t v = mesh_.triangles[t][k];
        const bool is_sharp = next < mesh_.sharp_corners.size() && mesh_.sharp_corners[next] == 3 * t + k;
        visit(v, t, is_sharp ? mesh_.sharp_corner_normals[next++] : mesh_.normals[v], is_sharp);
      }
    }
  }

  const TriangleMesh& mesh_;
  double limit_;
  std::vector<glm::dvec3> mean_;
};

}  // namespace

std::vector<glm::dvec3> vertex_velocities(const Surface& surface, const TriangleMesh& mesh,
                                          std::span<const glm::dvec3> atom_velocity) {
  return VertexVelocities(surface, mesh, SurfaceVelocity(surface, atom_velocity)).take();
}

}  // namespace meniscus
