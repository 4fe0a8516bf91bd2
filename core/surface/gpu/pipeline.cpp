// SPDX-License-Identifier: BSD-3-Clause
// Runs the kernels of gpu_shaders/reduced_surface in order and sorts what they append.
#include "core/surface/gpu/pipeline.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <epoxy/gl.h>
#include <glm/geometric.hpp>
#include <tbb/parallel_sort.h>

#include "core/base/error.h"
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
  atoms_ = atoms;
  ReducedSurface rs;
  if (atoms.empty()) return rs;
  {
    const auto stage = clock_.stage("grid");
    weights_ = decision_weights(atoms, probe_radius);
    swallowed_ = swallowed_atoms(atoms);
    std::vector<glm::dvec3> centers(atoms.size());
    std::vector<double> radii(atoms.size());
    for (std::size_t a = 0; a < atoms.size(); ++a) {
      centers[a] = atoms[a].center;
      radii[a] = atoms[a].radius + probe_radius;
    }
    circles_.upload(atoms, weights_);
    circles_.restart();
    neighbors_.upload(centers, radii, swallowed_);
    glFinish();
  }
  std::optional<StageClock::Stage> listing(std::in_place, clock_, "neighbors");
  neighbors_.for_each_batch([&](const BallBatch& batch) {
    neighbors_.list_pairs(batch);
    glFinish();
    listing.reset();
    circles_.expose(batch, clock_);
    collect_lone_atoms(batch, rs);
    listing.emplace(clock_, "neighbors");
  });
  listing.reset();
  // Some atom is exposed, whatever the atoms: with arcs, or as a whole.
  if (circles_.arc_count() == 0 && rs.lone_atoms.empty())
    throw GpuError("the GPU finds no surface at all, which cannot be; run again, or on another --device");
  const auto stage = clock_.stage("sort arcs");
  rs.arcs.resize(circles_.arc_count());
  circles_.arcs.download(std::span<RsArc>(rs.arcs));
  tbb::parallel_sort(rs.arcs.begin(), rs.arcs.end());
  return rs;
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
