// SPDX-License-Identifier: BSD-3-Clause
// Runs the kernels of gpu_shaders/reduced_surface in order and sorts what they append.
#include "core/surface/pipeline.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <epoxy/gl.h>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>
#include <tbb/parallel_sort.h>

#include "core/surface/contour.h"
#include "core/surface/surface.h"

namespace meniscus {

SurfacePipeline::SurfacePipeline() : neighbors_(programs_), cusp_tracer_(make_gpu_cusp_tracer(programs_)) {}
SurfacePipeline::~SurfacePipeline() = default;

Surface SurfacePipeline::run(std::span<const Ball> atoms, double probe_radius) {
  const ReducedSurface rs = reduce(atoms, probe_radius);
  return assemble_surface(atoms, probe_radius, rs, &clock_, cusp_tracer_.get());
}

ReducedSurface SurfacePipeline::reduce(std::span<const Ball> atoms, double probe_radius) {
  clock_.restart();
  stats_ = {};
  atoms_ = atoms;
  ReducedSurface rs;
  if (atoms.empty()) return rs;
  {
    const auto stage = clock_.stage("grid");
    weights_ = decision_weights(atoms, probe_radius);
    swallowed_ = swallowed_atoms(atoms);
    std::vector<glm::dvec3> centers(atoms.size());
    std::vector<double> radii(atoms.size());
    std::vector<glm::dvec4> exact(atoms.size());
    for (std::size_t a = 0; a < atoms.size(); ++a) {
      centers[a] = atoms[a].center;
      radii[a] = atoms[a].radius + probe_radius;
      exact[a] = glm::dvec4(atoms[a].center, weights_[a]);
    }
    atoms_double_.upload(exact);
    neighbors_.upload(centers, radii, swallowed_);
    glFinish();
  }
  std::optional<StageClock::Stage> listing(std::in_place, clock_, "neighbors");
  neighbors_.for_each_batch([&](const BallBatch& batch) {
    neighbors_.list_pairs(batch);
    glFinish();
    listing.reset();
    stats_.pairs += batch.pair_count;
    expose_circles(batch, rs);
    collect_lone_atoms(batch, rs);
    listing.emplace(clock_, "neighbors");
  });
  listing.reset();
  const auto stage = clock_.stage("sort arcs");
  tbb::parallel_sort(rs.arcs.begin(), rs.arcs.end());
  return rs;
}

// In single precision over all pairs, then in double over those left in doubt; what still is goes to the host.
void SurfacePipeline::expose_circles(const BallBatch& batch, ReducedSurface& rs) {
  if (batch.pair_count == 0) return;
  {
    const auto stage = clock_.stage("circles");
    relative_texels_.view(neighbors_.relative);
    run_circles(batch, false, neighbors_.pairs, batch.pair_count, doubtful_, rs);
  }
  if (doubtful_count_ == 0) return;
  const auto stage = clock_.stage("doubtful circles");
  stats_.decided_in_double += doubtful_count_;
  run_circles(batch, true, doubtful_, doubtful_count_, still_doubtful_, rs);
  if (doubtful_count_ == 0) return;
  stats_.decided_on_host += doubtful_count_;
  decide_on_host(batch, still_doubtful_.download<glm::uvec2>(doubtful_count_), rs);
}

void SurfacePipeline::run_circles(const BallBatch& batch, bool in_double, const Buffer& circles,
                                  std::uint32_t circle_count, Buffer& doubtful, ReducedSurface& rs) {
  std::uint32_t counts[2] = {0, 0};  // arcs, doubtful circles
  ShaderDefines defines;
  if (in_double) defines.emplace_back("DOUBLE_PRECISION", "1");
  const Program& program = programs_.get("gpu_shaders/reduced_surface/circles.comp", defines);
  for (;;) {
    arcs_.resize(arc_capacity_ * sizeof(RsArc));
    doubtful.resize(doubtful_capacity_ * sizeof(glm::uvec2));
    counters_.resize(sizeof counts);
    counters_.fill(0);
    circles.bind(0);
    neighbors_.first.bind(1);
    neighbors_.labels.bind(2);
    if (in_double)
      atoms_double_.bind(3);
    else
      relative_texels_.bind(0);
    arcs_.bind(4);
    doubtful.bind(5);
    counters_.bind(6);
    neighbors_.balls.bind(7);
    program.set("first_entry", batch.first);
    program.set("circle_count", circle_count);
    program.set("arc_capacity", arc_capacity_);
    program.set("doubtful_capacity", doubtful_capacity_);
    program.dispatch(group_count(circle_count));
    counters_.read(0, counts, sizeof counts);
    if (counts[0] <= arc_capacity_ && counts[1] <= doubtful_capacity_) break;
    arc_capacity_ = std::max(arc_capacity_, counts[0] + counts[0] / 4);
    doubtful_capacity_ = std::max(doubtful_capacity_, counts[1] + counts[1] / 4);
  }
  static_assert(sizeof(RsArc) == sizeof(glm::uvec4));
  const std::size_t first = rs.arcs.size();
  rs.arcs.resize(first + counts[0]);
  arcs_.download(std::span<RsArc>(rs.arcs.data() + first, counts[0]));
  doubtful_count_ = counts[1];
}

// Double left these in doubt (ties): Contour decides them in quadruple precision.
void SurfacePipeline::decide_on_host(const BallBatch& batch, std::span<const glm::uvec2> circles, ReducedSurface& rs) {
  const auto first = neighbors_.first.download<std::uint32_t>(batch.count + 1);
  const auto labels = neighbors_.labels.download<std::uint32_t>(batch.neighbor_count);
  Contour contour;
  Blockers blockers;
  for (const glm::uvec2& circle : circles) {
    const std::uint32_t i = circle.x, j = labels[circle.y], entry = i - batch.first;
    blockers.restart(weights_[i]);
    for (std::uint32_t n = first[entry]; n < first[entry + 1]; ++n)
      blockers.add(atoms_[labels[n]].center - atoms_[i].center, weights_[labels[n]], labels[n]);
    contour.expose(atoms_[j].center - atoms_[i].center, weights_[j], blockers, circle.y - first[entry]);
    if (contour.whole()) rs.arcs.push_back({i, j, kNone, kNone});
    for (const ExposedArc& arc : contour.arcs()) rs.arcs.push_back({i, j, arc.begin_by, arc.end_by});
  }
}

// The kernel lists neighbours generously; only balls that really overlap keep an atom from being alone.
void SurfacePipeline::collect_lone_atoms(const BallBatch& batch, ReducedSurface& rs) {
  const auto first = neighbors_.first.download<std::uint32_t>(batch.count + 1);
  const auto labels = neighbors_.labels.download<std::uint32_t>(batch.neighbor_count);
  for (std::uint32_t entry = 0; entry < batch.count; ++entry) {
    const std::uint32_t a = batch.first + entry;
    if (swallowed_[a]) continue;
    const bool lone = std::none_of(labels.begin() + first[entry], labels.begin() + first[entry + 1], [&](auto n) {
      const double sum = std::sqrt(weights_[a]) + std::sqrt(weights_[n]);
      const glm::dvec3 d = atoms_[n].center - atoms_[a].center;
      return glm::dot(d, d) < sum * sum;
    });
    if (lone) rs.lone_atoms.push_back(a);
  }
}

}  // namespace meniscus
