// SPDX-License-Identifier: BSD-3-Clause
// The one loop over batches of atoms.
#include "core/reduced_surface/gpu/gpu_arcs.h"

#include <optional>

#include "core/gpu/gpu_stage.h"
#include "core/reduced_surface/reduced_surface.h"

namespace meniscus {

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
  circles.tell_count();
}

void GpuArcs::find_later(StageClock& clock) {
  neighbors.count_lists(Counting::later);
  neighbors.for_each_batch([&](const BallBatch& batch) {
    neighbors.list_pairs(batch);
    circles.expose_later(batch, clock);
  });
}

void GpuArcs::ask(Readback& readback) {
  neighbors.ask(readback);
  circles.ask(readback);
}

bool GpuArcs::settle() { return neighbors.settle() && circles.settle(neighbors.known()); }

}  // namespace meniscus
