// SPDX-License-Identifier: BSD-3-Clause
// Runs the kernels that find exposed arcs, batch by batch of atoms, and decides doubtful circles on the host.
#include "core/reduced_surface/gpu/gpu_arcs.h"

#include "core/reduced_surface/contour/contour.h"

namespace meniscus {

void GpuCircles::upload(std::span<const Ball> host_atoms, std::span<const double> weights, double roundoff) {
  roundoff_ = roundoff;
  host_atoms_ = host_atoms;
  weights_ = weights;
  exact_.resize(host_atoms.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, exact_.size(), 4096), [&](const auto& range) {
    for (std::size_t a = range.begin(); a != range.end(); ++a) exact_[a] = glm::dvec4(host_atoms[a].center, weights[a]);
  });
  atoms.upload(exact_);
}

void GpuCircles::restart() {
  arcs.clear();
  arcs.make_room();
  stats_ = {};
}

void GpuCircles::expose(const BallBatch& batch, StageClock& clock) {
  stats_.pairs += batch.pair_count;
  if (batch.pair_count == 0) return;
  doubtful_.clear();
  still_doubtful_.clear();
  {
    const GpuStage stage(clock, "circles");
    run(batch, false, batch.pair_count);
  }
  if (doubtful_.count() == 0) return;
  const GpuStage stage(clock, "doubtful circles");
  stats_.decided_in_double += doubtful_.count();
  run(batch, true, doubtful_.count());
  if (still_doubtful_.count() == 0) return;
  stats_.decided_in_quadruple += still_doubtful_.count();
  decide_on_host(batch, still_doubtful_.buffer.download<glm::uvec2>(still_doubtful_.count()));
}

void GpuCircles::expose_later(const BallBatch& batch, StageClock& clock) {
  still_doubtful_.clear();
  still_doubtful_.make_room();
  append_later({&arcs, &doubtful_}, counters_, counts_, [&] {
    const GpuStage stage(clock, "circles");
    start(batch, false, batch.pair_count);
  });
  const GpuStage stage(clock, "doubtful circles");
  start(batch, true, doubtful_.capacity());
}

void GpuCircles::request_counts(Readback& readback) { readback.request(counters_, 0, counts_); }

bool GpuCircles::take_counts(const BallBatch& batch) {
  stats_ = {batch.pair_count, counts_[1], counts_[2], 0};
  return take_list_counts({&arcs, &doubtful_}, counts_) && counts_[2] == 0;
}

void GpuCircles::upload_count() {
  const std::uint32_t count = arcs.count();
  counters_.resize(sizeof counts_);
  counters_.write(0, &count, sizeof count);
}

void GpuCircles::run(const BallBatch& batch, bool in_double, std::uint32_t circle_count) {
  const auto start_it = [&] { start(batch, in_double, circle_count); };
  if (in_double)
    append_all({&arcs, &doubtful_, &still_doubtful_}, counters_, counts_, start_it);
  else
    append_all({&arcs, &doubtful_}, counters_, counts_, start_it);
}

void GpuCircles::start(const BallBatch& batch, bool in_double, std::uint32_t circle_count) {
  ShaderDefines defines = neighbors_.list_defines();
  if (in_double) defines.emplace_back("DOUBLE_PRECISION", "1");
  const Program& program = programs_.get("gpu_shaders/reduced_surface/circles.comp", defines);
  const AppendList& doubtful = in_double ? still_doubtful_ : doubtful_;
  (in_double ? doubtful_.buffer : neighbors_.pairs).bind(0);
  neighbors_.first.bind(1);
  neighbors_.labels.bind(2);
  if (in_double) {
    atoms.bind(3);
  } else {
    neighbors_.pair_first.bind(3);
    relative_texels_.view(neighbors_.relative);
    relative_texels_.bind(0);
  }
  arcs.buffer.bind(4);
  doubtful.buffer.bind(5);
  counters_.bind(6);
  neighbors_.balls.bind(7);
  neighbors_.bind_listed();
  program.set(kernel::CircleParameters{.doubt = roundoff_,
                                       .first_entry = batch.first,
                                       .entry_count = batch.count,
                                       .circle_count = circle_count,
                                       .list_limit = neighbors_.list_limit(),
                                       .arc_capacity = arcs.capacity(),
                                       .doubtful_capacity = doubtful.capacity()});
  program.dispatch(group_count(circle_count));
}

// Decides the circles that double leaves in doubt (ties), in quadruple precision by Contour.
void GpuCircles::decide_on_host(const BallBatch& batch, std::vector<glm::uvec2> circles) {
  std::ranges::sort(circles, {}, [](const glm::uvec2& circle) { return std::pair(circle.x, circle.y); });
  std::vector<RsArc> found;
  Contour contour(std::max(roundoff_, geometry::kUnitRoundoff));
  TieWatch ties;
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
    ties.compare(contour, blockers, place, i, [](std::uint32_t label) { return label; });
    if (contour.whole()) found.push_back({i, j, kNone, kNone});
    for (const ExposedArc& arc : contour.arcs()) found.push_back({i, j, arc.begin_by, arc.end_by});
  }
  stats_.ties += ties.ties();
  arcs.append(std::span<const RsArc>(found));
}

void GpuArcs::upload(std::span<const Ball> atoms, const std::vector<bool>& swallowed, double probe_radius,
                     bool watch_ties) {
  weights_ = decision_weights(atoms, probe_radius);
  circles.upload(atoms, weights_, watch_ties ? growth_as_roundoff(weights_) : 0.0);
  if (atoms.empty()) return neighbors.adopt(0, {});
  BallExtent box = extent_of(atoms);
  box.largest_radius += probe_radius;
  neighbors.upload(static_cast<std::uint32_t>(atoms.size()), box, swallowed, [&](std::uint32_t a) {
    return Ball{atoms[a].center, atoms[a].radius + probe_radius};
  });
}

void GpuArcs::find(StageClock& clock) {
  neighbors.count_lists(Counting::now);
  circles.restart();
  std::optional<GpuStage> listing(std::in_place, clock, "neighbors");
  neighbors.for_each_batch([&](const BallBatch& batch) {
    neighbors.list_pairs(batch);
    listing.reset();
    circles.expose(batch, clock);
    listing.emplace(clock, "neighbors");
  });
  circles.upload_count();
}

void GpuArcs::find_later(StageClock& clock) {
  neighbors.count_lists(Counting::later);
  neighbors.for_each_batch([&](const BallBatch& batch) {
    neighbors.list_pairs(batch);
    circles.expose_later(batch, clock);
  });
}

void GpuArcs::request_counts(Readback& readback) {
  neighbors.request_counts(readback);
  circles.request_counts(readback);
}

bool GpuArcs::take_counts() { return neighbors.take_counts() && circles.take_counts(neighbors.known()); }

}  // namespace meniscus
