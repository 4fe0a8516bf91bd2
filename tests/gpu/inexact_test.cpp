// SPDX-License-Identifier: BSD-3-Clause
// GPUs with less exact arithmetic than the CPU's find the very same surface, or the difference is noticed.
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/base/progress.h"
#include "core/gpu/egl_context.h"
#include "core/queries/surface_object.h"
#include "core/reduced_surface/reduced_surface.h"
#include "core/surface/compute_surface.h"
#include "tests/gpu/inexact_shaders.h"
#include "tests/support/molecules.h"

namespace meniscus::testing {
namespace {

class InexactGpu : public ::testing::Test {
 protected:
  void TearDown() override { compile_exactly(); }

  /// Returns the names of molecules whose surface is not the CPU's.
  std::vector<std::string> different(const std::vector<NamedBalls>& molecules) {
    const auto engine = make_gpu_engine(context_);
    StageClock clock;
    std::vector<std::string> names;
    for (const auto& [name, balls, probe_radius] : molecules) {
      const Surface expected = assemble_surface(balls, probe_radius, enumerate_reduced_surface(balls, probe_radius));
      try {
        const Surface found = attempt_surface(*engine, balls, probe_radius, clock);
        if (!found.certificate.closed || !differences(expected, found).empty()) names.push_back(name);
      } catch (const Error&) {
        names.push_back(name);
      }
    }
    return names;
  }

  EglContext context_;
};

// GLSL allows 2.5 units for quotients and 4.5 for roots; scalar products are sums of a few roundings.
TEST_F(InexactGpu, FindsTheSameSurface) {
  compile_inexactly(5, 5);
  std::vector<NamedBalls> molecules = degenerate_molecules();
  molecules.push_back({"ubiquitin", ubiquitin()});
  for (std::uint32_t n = 0; n < 30; ++n) {
    const GasCase gas = gas_case(n);
    molecules.push_back({"gas " + std::to_string(n), gas.balls, gas.probe_radius});
  }
  EXPECT_EQ(different(molecules), std::vector<std::string>());
}

TEST_F(InexactGpu, IsSeenWhereItGoesTooFar) {
  // Decisions that double precision takes by less than the growth of weights go to the host: single precision shows it.
  compile_inexactly(1u << 20, 5);
  EXPECT_FALSE(different(degenerate_molecules()).empty()) << "the test above sees nothing";
}

}  // namespace
}  // namespace meniscus::testing
