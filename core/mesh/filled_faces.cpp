// SPDX-License-Identifier: BSD-3-Clause
// Fills faces with triangles in rounds: a rim with chords that cross gets finer samples, and so does the face beyond
// it.
#include "core/mesh/filled_faces.h"

#include <set>
#include <utility>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "core/base/error.h"

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
  if (rim.edges.size() < 3) return {};  // shrunk to a point or to one line
  FaceMesh mesh = fill_outline(std::move(rim), tolerance_of(rule_, surface_, face));
  shrink_lists(mesh);
  return mesh;
}

void FaceFilling::fan(std::uint32_t f, FaceMesh& mesh) const {
  if (!mesh.triangles.empty()) return;
  FaceOutline rim = outline(f);
  if (rim.edges.size() < 3) return;
  if (rim.loop_count > 1) {
    throw OpenSurfaceError(
        fmt::format("the mesh cannot be closed: the borders of face {} cross; give a smaller tolerance", f));
  }
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
    for (auto s = segments.rbegin(); s != segments.rend(); ++s) {  // from the back, so that indices remain valid
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

void shrink_lists(FaceMesh& mesh) {
  mesh.points.shrink_to_fit();
  mesh.triangles.shrink_to_fit();
  mesh.atom.shrink_to_fit();
  mesh.bridges.shrink_to_fit();
}

}  // namespace meniscus
