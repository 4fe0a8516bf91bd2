// SPDX-License-Identifier: BSD-3-Clause
// Runs the kernels of gpu_shaders/reduced_surface in order and sorts what they append.
#include "core/surface/pipeline.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>
#include <epoxy/gl.h>
#include <tbb/parallel_sort.h>

#include "core/gpu/limits.h"
#include "core/surface/contour.h"

namespace meniscus {
namespace {

constexpr std::uint32_t kGroupSize = 64;     // local_size_x of every kernel
constexpr std::uint32_t kScanChunk = 512;    // words per invocation of the scan
constexpr std::uint32_t kLargestBatch = 1 << 16;  // atoms; their lists then stay near 50 MB and in reach of caches

// So that a stage's wall-clock time is its own.
void wait_for_gpu() { glFinish(); }

std::size_t groups(std::size_t invocations) { return (invocations + kGroupSize - 1) / kGroupSize; }

}  // namespace

struct SurfacePipeline::Buffers {
  Buffer atoms, atoms_low, atoms_double;
  Buffer cell_first, rank, cell_atoms, totals;
  Buffer neighbor_first, neighbor_balls, neighbor_labels;
  Buffer pair_first, pairs;
  Buffer arcs, doubtful, still_doubtful, counters;
  std::uint32_t arc_capacity = 1 << 14;
  std::uint32_t doubtful_capacity = 1 << 12;
};

SurfacePipeline::SurfacePipeline() : buffers_(std::make_unique<Buffers>()) {}
SurfacePipeline::~SurfacePipeline() = default;

ReducedSurface SurfacePipeline::reduce(std::span<const Ball> atoms, double probe_radius) {
  clock_.restart();
  stats_ = {};
  ReducedSurface rs;
  if (atoms.empty()) return rs;
  upload_atoms(atoms, probe_radius);
  build_grid();
  Batch batch;
  batch.atom_count = std::min<std::uint32_t>(kLargestBatch, static_cast<std::uint32_t>(atoms.size()));
  while (batch.first_atom < atoms.size()) {
    count_neighbors(batch);
    if (batch.neighbor_count * sizeof(glm::vec4) > block_bytes_ && batch.atom_count > 1) {
      batch.atom_count = (batch.atom_count + 1) / 2;
      continue;
    }
    list_neighbors(batch);
    list_pairs(batch);
    expose_circles(batch, rs);
    collect_lone_atoms(batch, rs);
    batch.first_atom += batch.atom_count;
    batch.atom_count = std::min<std::uint32_t>(batch.atom_count, static_cast<std::uint32_t>(atoms.size()) - batch.first_atom);
  }
  const auto stage = clock_.stage("sort arcs");
  tbb::parallel_sort(rs.arcs.begin(), rs.arcs.end());
  return rs;
}

const Program& SurfacePipeline::kernel(const char* name, int pass, bool in_double) {
  ShaderDefines defines;
  if (pass >= 0) defines.emplace_back("PASS", std::to_string(pass));
  if (in_double) defines.emplace_back("DOUBLE_PRECISION", "1");
  return programs_.get(std::string("gpu_shaders/") + name + ".comp", defines);
}

// Positions go up twice: in double as they are, and as two floats each from the molecule's middle, whose difference
// is exact to single precision anywhere.
void SurfacePipeline::upload_atoms(std::span<const Ball> atoms, double probe_radius) {
  atoms_ = atoms;
  block_bytes_ = query_gpu_limits().storage_block_bytes;
  weights_ = decision_weights(atoms, probe_radius);
  swallowed_ = swallowed_atoms(atoms, probe_radius);
  glm::dvec3 low = atoms[0].center, high = low;
  double largest = 0;
  for (const Ball& b : atoms) {
    low = glm::min(low, b.center);
    high = glm::max(high, b.center);
    largest = std::max(largest, b.radius + probe_radius);
  }
  const glm::dvec3 middle = 0.5 * (low + high);
  std::vector<glm::vec4> coarse(atoms.size()), fine(atoms.size());
  std::vector<glm::dvec4> exact(atoms.size());
  for (std::size_t a = 0; a < atoms.size(); ++a) {
    const glm::dvec3 d = atoms[a].center - middle;
    coarse[a] = glm::vec4(glm::vec3(d), static_cast<float>(atoms[a].radius + probe_radius));
    fine[a] = glm::vec4(glm::vec3(d - glm::dvec3(glm::vec3(coarse[a]))), swallowed_[a] ? 1.0f : 0.0f);
    exact[a] = glm::dvec4(atoms[a].center, weights_[a]);
  }
  buffers_->atoms.upload(coarse);
  buffers_->atoms_low.upload(fine);
  buffers_->atoms_double.upload(exact);

  largest_radius_ = static_cast<float>(largest) * 1.00001f;
  double spacing = largest_radius_;
  const glm::dvec3 extent = high - low;
  const auto cells = [&] {
    return (std::floor(extent.x / spacing) + 1) * (std::floor(extent.y / spacing) + 1) *
           (std::floor(extent.z / spacing) + 1);
  };
  while (cells() > 4.0 * static_cast<double>(atoms.size()) + 64) spacing *= 1.25;
  grid_low_ = glm::vec4(glm::vec3(low - middle), static_cast<float>(1 / spacing));
  grid_size_ = glm::vec4(glm::vec3(glm::floor(extent / spacing) + 1.0), 0.0f);
  cell_count_ = static_cast<std::uint32_t>(grid_size_.x * grid_size_.y * grid_size_.z);
}

void SurfacePipeline::build_grid() {
  const auto stage = clock_.stage("grid");
  Buffers& b = *buffers_;
  const auto count = static_cast<std::uint32_t>(atoms_.size());
  b.cell_first.resize((cell_count_ + 1) * sizeof(std::uint32_t));
  b.cell_first.fill(0);
  b.rank.resize(count * sizeof(std::uint32_t));
  b.cell_atoms.resize(count * sizeof(std::uint32_t));
  for (int pass = 0; pass < 2; ++pass) {
    b.atoms.bind(0);
    b.cell_first.bind(1);
    b.rank.bind(2);
    b.cell_atoms.bind(3);
    const Program& program = kernel("reduced_surface/grid", pass);
    program.set("atom_count", count);
    program.set("grid_low", grid_low_);
    program.set("grid_size", grid_size_);
    program.dispatch(groups(count));
    if (pass == 0) scan(b.cell_first, cell_count_);
  }
}

void SurfacePipeline::run_neighbors(const Batch& batch, int pass) {
  Buffers& b = *buffers_;
  b.atoms.bind(0);
  b.atoms_low.bind(1);
  b.cell_first.bind(2);
  b.cell_atoms.bind(3);
  b.neighbor_first.bind(4);
  b.pair_first.bind(5);
  b.neighbor_balls.bind(6);
  b.neighbor_labels.bind(7);
  const Program& program = kernel("reduced_surface/neighbors", pass);
  program.set("first_atom", batch.first_atom);
  program.set("atom_count", batch.atom_count);
  program.set("largest_radius", largest_radius_);
  program.set("grid_low", grid_low_);
  program.set("grid_size", grid_size_);
  program.dispatch(groups(batch.atom_count));
}

void SurfacePipeline::count_neighbors(Batch& batch) {
  const auto stage = clock_.stage("neighbors");
  Buffers& b = *buffers_;
  b.neighbor_first.resize((batch.atom_count + 1) * sizeof(std::uint32_t));
  b.pair_first.resize((batch.atom_count + 1) * sizeof(std::uint32_t));
  b.neighbor_balls.resize(sizeof(glm::vec4));
  b.neighbor_labels.resize(sizeof(std::uint32_t));
  run_neighbors(batch, 0);
  scan(b.neighbor_first, batch.atom_count);
  scan(b.pair_first, batch.atom_count);
  const std::size_t total = batch.atom_count * sizeof(std::uint32_t);
  b.neighbor_first.read(total, &batch.neighbor_count, sizeof batch.neighbor_count);
  b.pair_first.read(total, &batch.pair_count, sizeof batch.pair_count);
}

void SurfacePipeline::list_neighbors(const Batch& batch) {
  const auto stage = clock_.stage("neighbors");
  buffers_->neighbor_balls.resize(std::max(1u, batch.neighbor_count) * sizeof(glm::vec4));
  buffers_->neighbor_labels.resize(std::max(1u, batch.neighbor_count) * sizeof(std::uint32_t));
  run_neighbors(batch, 1);
  wait_for_gpu();
}

void SurfacePipeline::list_pairs(const Batch& batch) {
  const auto stage = clock_.stage("pairs");
  Buffers& b = *buffers_;
  stats_.pairs += batch.pair_count;
  b.pairs.resize(std::max(1u, batch.pair_count) * sizeof(glm::uvec2));
  b.neighbor_first.bind(0);
  b.neighbor_labels.bind(1);
  b.pair_first.bind(2);
  b.pairs.bind(3);
  const Program& program = kernel("reduced_surface/pairs");
  program.set("first_atom", batch.first_atom);
  program.set("atom_count", batch.atom_count);
  program.dispatch(groups(batch.atom_count));
  wait_for_gpu();
}

void SurfacePipeline::expose_circles(const Batch& batch, ReducedSurface& rs) {
  Buffers& b = *buffers_;
  std::uint32_t counts[2] = {0, 0};  // arcs, doubtful circles
  // In single precision over all pairs, then in double over those left in doubt; what still is goes to the host.
  const auto run = [&](bool in_double, const Buffer& circles, std::uint32_t circle_count, Buffer& doubtful) {
    for (;;) {
      b.arcs.resize(b.arc_capacity * sizeof(glm::uvec4));
      doubtful.resize(b.doubtful_capacity * sizeof(glm::uvec2));
      b.counters.resize(sizeof counts);
      b.counters.fill(0);
      circles.bind(0);
      b.neighbor_first.bind(1);
      b.neighbor_labels.bind(2);
      (in_double ? b.atoms_double : b.neighbor_balls).bind(3);
      b.arcs.bind(4);
      doubtful.bind(5);
      b.counters.bind(6);
      b.atoms.bind(7);
      const Program& program = kernel("reduced_surface/circles", -1, in_double);
      program.set("first_atom", batch.first_atom);
      program.set("circle_count", circle_count);
      program.set("arc_capacity", b.arc_capacity);
      program.set("doubtful_capacity", b.doubtful_capacity);
      program.dispatch(groups(circle_count));
      b.counters.read(0, counts, sizeof counts);
      if (counts[0] <= b.arc_capacity && counts[1] <= b.doubtful_capacity) break;
      b.arc_capacity = std::max(b.arc_capacity, counts[0] + counts[0] / 4);
      b.doubtful_capacity = std::max(b.doubtful_capacity, counts[1] + counts[1] / 4);
    }
    const std::size_t first = rs.arcs.size();
    rs.arcs.resize(first + counts[0]);
    static_assert(sizeof(RsArc) == sizeof(glm::uvec4));
    b.arcs.download(std::span<RsArc>(rs.arcs.data() + first, counts[0]));
  };
  {
    const auto stage = clock_.stage("circles");
    if (batch.pair_count) run(false, b.pairs, batch.pair_count, b.doubtful);
  }
  const std::uint32_t in_doubt = counts[1];
  stats_.decided_in_double += in_doubt;
  if (in_doubt) {
    std::uint32_t on_host = 0;
    {
      const auto stage = clock_.stage("doubtful circles");
      run(true, b.doubtful, in_doubt, b.still_doubtful);
      on_host = counts[1];
    }
    stats_.decided_on_host += on_host;
    if (on_host) decide_on_host(batch, b.still_doubtful.download<glm::uvec2>(on_host), rs);
  }
}

// Double left these in doubt (ties): Contour decides them in quadruple precision.
void SurfacePipeline::decide_on_host(const Batch& batch, std::span<const glm::uvec2> circles, ReducedSurface& rs) {
  Buffers& b = *buffers_;
  const auto first = b.neighbor_first.download<std::uint32_t>(batch.atom_count + 1);
  const auto labels = b.neighbor_labels.download<std::uint32_t>(batch.neighbor_count);
  Contour contour;
  std::vector<Blocker> blockers;
  for (const glm::uvec2& circle : circles) {
    const std::uint32_t i = circle.x, j = labels[circle.y];
    blockers.clear();
    const std::uint32_t entry = i - batch.first_atom;
    for (std::uint32_t n = first[entry]; n < first[entry + 1]; ++n)
      if (labels[n] != j)
        blockers.push_back({atoms_[labels[n]].center - atoms_[i].center, weights_[labels[n]], labels[n]});
    contour.expose(atoms_[j].center - atoms_[i].center, weights_[i], weights_[j], blockers, blockers.size());
    if (contour.whole()) rs.arcs.push_back({i, j, kNone, kNone});
    for (const ExposedArc& arc : contour.arcs()) rs.arcs.push_back({i, j, arc.begin_by, arc.end_by});
  }
}

void SurfacePipeline::collect_lone_atoms(const Batch& batch, ReducedSurface& rs) {
  const auto first = buffers_->neighbor_first.download<std::uint32_t>(batch.atom_count + 1);
  const auto labels = buffers_->neighbor_labels.download<std::uint32_t>(batch.neighbor_count);
  for (std::uint32_t entry = 0; entry < batch.atom_count; ++entry) {
    const std::uint32_t a = batch.first_atom + entry;
    if (swallowed_[a]) continue;
    // The kernel lists generously; only balls that really overlap count.
    const bool lone = std::none_of(labels.begin() + first[entry], labels.begin() + first[entry + 1], [&](std::uint32_t n) {
      const double sum = std::sqrt(weights_[a]) + std::sqrt(weights_[n]);
      const glm::dvec3 d = atoms_[n].center - atoms_[a].center;
      return glm::dot(d, d) < sum * sum;
    });
    if (lone) rs.lone_atoms.push_back(a);
  }
}

void SurfacePipeline::scan(Buffer& words, std::uint32_t count) {
  const std::uint32_t chunks = (count + kScanChunk - 1) / kScanChunk;
  buffers_->totals.resize(std::max(1u, chunks) * sizeof(std::uint32_t));
  for (int pass = 0; pass < 3; ++pass) {
    words.bind(0);
    buffers_->totals.bind(1);
    const Program& program = kernel("parallel/scan", pass);
    program.set("count", count);
    program.set("chunk_length", kScanChunk);
    program.dispatch(pass == 1 ? 1 : groups(chunks));
  }
}

}  // namespace meniscus
