// SPDX-License-Identifier: BSD-3-Clause
// Runs the circles kernel, once in each precision, and grows what it appends to.
#include "core/reduced_surface/gpu/gpu_circles.h"

#include <algorithm>
#include <array>
#include <utility>

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
  arcs.clear();
  arcs.make_room();
  stats_ = {};
}

void GpuCircles::expose(const BallBatch& batch, StageClock& clock) {
  stats_.pairs += batch.pair_count;
  if (batch.pair_count == 0) return;
  {
    const GpuStage stage(clock, "circles");
    relative_texels_.view(neighbors_.relative);
    run(batch, false, neighbors_.pairs, batch.pair_count, doubtful_);
  }
  if (doubtful_.count() == 0) return;
  const GpuStage stage(clock, "doubtful circles");
  stats_.decided_in_double += doubtful_.count();
  run(batch, true, doubtful_.buffer, doubtful_.count(), still_doubtful_);
  if (still_doubtful_.count() == 0) return;
  stats_.decided_in_quadruple += still_doubtful_.count();
  decide_on_host(batch, still_doubtful_.buffer.download<glm::uvec2>(still_doubtful_.count()));
}

void GpuCircles::run(const BallBatch& batch, bool in_double, const Buffer& circles, std::uint32_t circle_count,
                     AppendList& doubtful) {
  ShaderDefines defines = neighbors_.list_defines();
  if (in_double) defines.emplace_back("DOUBLE_PRECISION", "1");
  const Program& program = programs_.get("gpu_shaders/reduced_surface/circles.comp", defines);
  doubtful.clear();
  std::array<std::uint32_t, 2> counts{};  // arcs, doubtful circles
  append_all({&arcs, &doubtful}, counters_, counts, [&] {
    circles.bind(0);
    neighbors_.first.bind(1);
    neighbors_.labels.bind(2);
    if (in_double)
      atoms.bind(3);
    else
      relative_texels_.bind(0);
    arcs.buffer.bind(4);
    doubtful.buffer.bind(5);
    counters_.bind(6);
    neighbors_.balls.bind(7);
    neighbors_.bind_listed();
    program.set(kernel::CircleParameters{.first_entry = batch.first,
                                         .circle_count = circle_count,
                                         .arc_capacity = arcs.capacity(),
                                         .doubtful_capacity = doubtful.capacity()});
    program.dispatch(group_count(circle_count));
  });
}

// Double left these in doubt (ties): Contour decides them in quadruple precision.
void GpuCircles::decide_on_host(const BallBatch& batch, std::vector<glm::uvec2> circles) {
  std::ranges::sort(circles, {}, [](const glm::uvec2& circle) { return std::pair(circle.x, circle.y); });
  std::vector<RsArc> found;
  Contour contour;
  Blockers blockers;
  NeighborList near;
  for (const glm::uvec2& circle : circles) {
    if (near.labels.empty() || near.entry != circle.x) {
      near = neighbors_.list_of(batch, circle.x);
      blockers.restart(weights_[near.ball]);
      for (const std::uint32_t n : near.labels)
        blockers.add(host_atoms_[n].center - host_atoms_[near.ball].center, weights_[n], n);
    }
    const std::uint32_t i = near.ball, place = circle.y - near.first, j = near.labels[place];
    contour.expose(host_atoms_[j].center - host_atoms_[i].center, weights_[j], blockers, place);
    if (contour.whole()) found.push_back({i, j, kNone, kNone});
    for (const ExposedArc& arc : contour.arcs()) found.push_back({i, j, arc.begin_by, arc.end_by});
  }
  arcs.append(std::span<const RsArc>(found));
}

}  // namespace meniscus
