// SPDX-License-Identifier: BSD-3-Clause
// Runs the kernels of gpu_shaders/reduced_surface in order and sorts what they append.
#include "core/surface/gpu/pipeline.h"

#include <algorithm>
#include <array>
#include <optional>

#include <tbb/parallel_sort.h>

#include "core/base/error.h"
#include "core/gpu/gpu_stage.h"
#include "core/gpu/kernel_parameters.h"
#include "core/surface/surface.h"

namespace meniscus {

SurfacePipeline::SurfacePipeline()
    : neighbors_(programs_), circles_(programs_, neighbors_), cusp_tracer_(make_gpu_cusp_tracer(programs_)) {}
SurfacePipeline::~SurfacePipeline() = default;

Surface SurfacePipeline::run(std::span<const Ball> atoms, double probe_radius) {
  const ReducedSurface rs = reduce(atoms, probe_radius);
  return assemble_surface(atoms, probe_radius, rs, &clock_, cusp_tracer_.get());
}

ReducedSurface SurfacePipeline::reduce(std::span<const Ball> atoms, double probe_radius) {
  clock_.restart();
  ReducedSurface rs;
  if (atoms.empty()) return rs;
  {
    const GpuStage stage(clock_, "grid");
    upload(atoms, probe_radius);
  }
  std::optional<GpuStage> listing(std::in_place, clock_, "neighbors");
  neighbors_.for_each_batch([&](const BallBatch& batch) {
    neighbors_.list_pairs(batch);
    list_lone_atoms(batch);
    listing.reset();
    circles_.expose(batch, clock_);
    listing.emplace(clock_, "neighbors");
  });
  listing.reset();
  // Some atom is exposed, whatever the atoms: with arcs, or as a whole.
  if (circles_.arcs.count() == 0 && lone_atoms_.count() == 0)
    throw GpuError("the GPU finds no surface at all, which cannot be; run again, or on another --device");
  const auto stage = clock_.stage("sort arcs");
  rs.arcs = circles_.arcs.buffer.download<RsArc>(circles_.arcs.count());
  tbb::parallel_sort(rs.arcs.begin(), rs.arcs.end());
  rs.lone_atoms = lone_atoms_.buffer.download<std::uint32_t>(lone_atoms_.count());
  std::sort(rs.lone_atoms.begin(), rs.lone_atoms.end());
  return rs;
}

void SurfacePipeline::upload(std::span<const Ball> atoms, double probe_radius) {
  weights_ = decision_weights(atoms, probe_radius);
  std::vector<glm::dvec3> centers(atoms.size());
  std::vector<double> radii(atoms.size());
  for (std::size_t a = 0; a < atoms.size(); ++a) {
    centers[a] = atoms[a].center;
    radii[a] = atoms[a].radius + probe_radius;
  }
  circles_.upload(atoms, weights_);
  circles_.restart();
  neighbors_.upload(centers, radii, swallowed_atoms(atoms));
  lone_atoms_.clear();
}

void SurfacePipeline::list_lone_atoms(const BallBatch& batch) {
  const Program& program = programs_.get("gpu_shaders/reduced_surface/lone_atoms.comp", neighbors_.list_defines());
  std::array<std::uint32_t, 1> counts{};
  append_all({&lone_atoms_}, counters_, counts, [&] {
    circles_.atoms.bind(0);
    neighbors_.balls_low.bind(1);
    neighbors_.first.bind(2);
    neighbors_.labels.bind(3);
    lone_atoms_.buffer.bind(4);
    counters_.bind(5);
    neighbors_.bind_listed();
    program.set(kernel::LoneAtomParameters{
        .first_entry = batch.first, .entry_count = batch.count, .capacity = lone_atoms_.capacity()});
    program.dispatch(group_count(batch.count));
  });
}

}  // namespace meniscus
