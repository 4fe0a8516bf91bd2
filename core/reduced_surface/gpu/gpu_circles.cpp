// SPDX-License-Identifier: BSD-3-Clause
// Runs the circles kernel, once in each precision, and grows what it appends to.
#include "core/reduced_surface/gpu/gpu_circles.h"

#include <algorithm>

#include <glm/vec4.hpp>

#include "core/gpu/gpu_stage.h"
#include "core/gpu/kernel_parameters.h"
#include "core/reduced_surface/contour/contour.h"

namespace meniscus {

void GpuCircles::upload(std::span<const Ball> host_atoms, std::span<const double> weights) {
  host_atoms_ = host_atoms;
  weights_ = weights;
  std::vector<glm::dvec4> exact(host_atoms.size());
  for (std::size_t a = 0; a < host_atoms.size(); ++a) exact[a] = glm::dvec4(host_atoms[a].center, weights[a]);
  atoms.upload(exact);
}

void GpuCircles::restart() {
  arc_count_ = 0;
  stats_ = {};
  arcs.resize(arc_capacity_ * sizeof(RsArc));
}

void GpuCircles::expose(const BallBatch& batch, StageClock& clock) {
  stats_.pairs += batch.pair_count;
  if (batch.pair_count == 0) return;
  std::uint32_t doubtful_count = 0;
  {
    const GpuStage stage(clock, "circles");
    relative_texels_.view(neighbors_.relative);
    doubtful_count = run(batch, false, neighbors_.pairs, batch.pair_count, doubtful_);
  }
  if (doubtful_count == 0) return;
  const GpuStage stage(clock, "doubtful circles");
  stats_.decided_in_double += doubtful_count;
  doubtful_count = run(batch, true, doubtful_, doubtful_count, still_doubtful_);
  if (doubtful_count == 0) return;
  stats_.decided_on_host += doubtful_count;
  decide_on_host(batch, still_doubtful_.download<glm::uvec2>(doubtful_count));
}

std::uint32_t GpuCircles::run(const BallBatch& batch, bool in_double, const Buffer& circles, std::uint32_t circle_count,
                              Buffer& doubtful) {
  ShaderDefines defines = neighbors_.list_defines();
  if (in_double) defines.emplace_back("DOUBLE_PRECISION", "1");
  const Program& program = programs_.get("gpu_shaders/reduced_surface/circles.comp", defines);
  for (;;) {
    std::uint32_t counts[2] = {arc_count_, 0};  // arcs, doubtful circles
    doubtful.resize(doubtful_capacity_ * sizeof(glm::uvec2));
    counters_.resize(sizeof counts);
    counters_.write(0, counts, sizeof counts);
    circles.bind(0);
    neighbors_.first.bind(1);
    neighbors_.labels.bind(2);
    if (in_double)
      atoms.bind(3);
    else
      relative_texels_.bind(0);
    arcs.bind(4);
    doubtful.bind(5);
    counters_.bind(6);
    neighbors_.balls.bind(7);
    neighbors_.bind_listed();
    program.set(kernel::CircleParameters{.first_entry = batch.first,
                                         .circle_count = circle_count,
                                         .arc_capacity = arc_capacity_,
                                         .doubtful_capacity = doubtful_capacity_});
    program.dispatch(group_count(circle_count));
    counters_.read(0, counts, sizeof counts);
    if (counts[0] <= arc_capacity_ && counts[1] <= doubtful_capacity_) {
      arc_count_ = counts[0];
      return counts[1];
    }
    if (counts[0] > arc_capacity_) {
      arc_capacity_ = counts[0] + counts[0] / 4;
      arcs.grow(arc_capacity_ * sizeof(RsArc));
    }
    doubtful_capacity_ = std::max(doubtful_capacity_, counts[1] + counts[1] / 4);
  }
}

// Double left these in doubt (ties): Contour decides them in quadruple precision.
void GpuCircles::decide_on_host(const BallBatch& batch, std::span<const glm::uvec2> circles) {
  const auto first = neighbors_.first.download<std::uint32_t>(batch.count + 1);
  const auto labels = neighbors_.labels.download<std::uint32_t>(batch.neighbor_count);
  std::vector<RsArc> found;
  Contour contour;
  Blockers blockers;
  for (const glm::uvec2& circle : circles) {
    const std::uint32_t entry = circle.x - batch.first, i = neighbors_.ball_of(circle.x), j = labels[circle.y];
    blockers.restart(weights_[i]);
    for (std::uint32_t n = first[entry]; n < first[entry + 1]; ++n)
      blockers.add(host_atoms_[labels[n]].center - host_atoms_[i].center, weights_[labels[n]], labels[n]);
    contour.expose(host_atoms_[j].center - host_atoms_[i].center, weights_[j], blockers, circle.y - first[entry]);
    if (contour.whole()) found.push_back({i, j, kNone, kNone});
    for (const ExposedArc& arc : contour.arcs()) found.push_back({i, j, arc.begin_by, arc.end_by});
  }
  const std::size_t count = arc_count_ + found.size();
  if (count > arc_capacity_) {
    arc_capacity_ = static_cast<std::uint32_t>(count + count / 4);
    arcs.grow(arc_capacity_ * sizeof(RsArc));
  }
  arcs.write(arc_count_ * sizeof(RsArc), found.data(), found.size() * sizeof(RsArc));
  arc_count_ = static_cast<std::uint32_t>(count);
}

}  // namespace meniscus
