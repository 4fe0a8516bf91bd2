// SPDX-License-Identifier: BSD-3-Clause
// GL calls of a steady frame have budgets, for frames of moving atoms once sizes have settled.
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <functional>
#include <iostream>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/color/coloring.h"
#include "core/gpu/egl_context.h"
#include "core/gpu/work_proof.h"
#include "core/render/gl_renderer.h"
#include "core/surface/compute_surface.h"
#include "core/visible_surface/view_pipeline.h"
#include "tests/gpu/gl_faults.h"
#include "tests/support/molecules.h"

namespace meniscus::testing {
namespace {

using Kind = GlFault::Kind;

std::string row(const std::string& name, const GlCalls& calls) {
  return fmt::format("{:28} {:10} {:8} {:5} {:13} {:7} {:7} {:8}\n", name, calls.dispatches, calls.finishes,
                     calls.reads, calls.waiting_reads, calls.uploads, calls.buffers_changed, calls.textures_changed);
}

class FrameCalls : public ::testing::Test {
 protected:
  void SetUp() override {
    plan({});
    atoms_ = enterotoxin();
    camera_ = frame_camera(atoms_, 4.0 / 3.0);
    coloring_.atom.assign(atoms_.size(), {0.9f, 0.5f, 0.1f});
    settings_.size = {320, 240};
    std::cout << fmt::format("{:28} {:>10} {:>8} {:>5} {:>13} {:>7} {:>7} {:>8}\n", "frame", "dispatches", "finishes",
                             "reads", "waiting reads", "uploads", "buffers", "textures");
  }
  void TearDown() override { plan({}); }

  /// Returns all atoms on their way, for frame `n` of a trajectory.
  Balls moved(int n) const {
    Balls balls = atoms_;
    for (std::size_t a = 0; a < balls.size(); ++a)
      balls[a].center += 0.02 * n * glm::dvec3(std::sin(1.0 * a), std::sin(2.0 * a), std::sin(3.0 * a));
    return balls;
  }

  /// Returns the calls of the last of some frames, none of which compiled or remade anything.
  GlCalls steady(const std::string& name, const std::function<void(const Balls&)>& frame) {
    for (int n = 0; n < 3; ++n) frame(moved(n));
    plan({});
    frame(moved(3));
    const GlCalls calls = calls_seen();
    std::cout << row(name, calls);
    EXPECT_EQ(calls.finishes, 0u);
    EXPECT_EQ(calls.shaders_compiled, 0u);
    EXPECT_EQ(calls.uniforms_looked_up, 0u);
    return calls;
  }

  GlCalls steady_view(const std::string& name, Extent extent) {
    ViewPipeline view;
    GlRenderer renderer;
    view.set_counting(Counting::later);
    renderer.set_counting(Counting::later);
    view.set_atoms(moved(0));
    view.set_coloring(coloring_);
    view.set_surface(kWater, extent);
    return steady(name, [&](const Balls& atoms) {
      view.set_atoms(atoms);
      renderer.draw(view, camera_, settings_);
    });
  }

  Balls atoms_;
  Coloring coloring_;
  Camera camera_;
  RenderSettings settings_;
  EglContext context_;
};

TEST_F(FrameCalls, VisibleView) {
  const GlCalls calls = steady_view("visible", Extent::visible);
  EXPECT_LE(calls.reads, 1u);
  EXPECT_EQ(calls.buffers_changed, 0u);
  EXPECT_EQ(calls.textures_changed, 0u);
}

TEST_F(FrameCalls, CompleteView) {
  const GlCalls calls = steady_view("complete", Extent::complete);
  EXPECT_LE(calls.reads, 1u);
  EXPECT_EQ(calls.buffers_changed, 0u);
  EXPECT_EQ(calls.textures_changed, 0u);
}

TEST_F(FrameCalls, ViewWithEffects) {
  settings_.samples = 4;
  settings_.look.ambient_occlusion = 0.8f;
  settings_.look.silhouettes = 2.0f;
  const GlCalls calls = steady_view("complete, 4 samples, shaded", Extent::complete);
  EXPECT_LE(calls.reads, 1u);
  EXPECT_EQ(calls.buffers_changed, 0u);
  EXPECT_EQ(calls.textures_changed, 0u);
}

// Frames trust in the sizes of earlier frames, both where that is right and where it is wrong.
TEST_F(FrameCalls, TrustChangesNoPicture) {
  settings_.size = {160, 120};
  for (const Extent extent : {Extent::visible, Extent::complete}) {
    ViewPipeline view;
    GlRenderer renderer;
    view.set_counting(Counting::later);
    renderer.set_counting(Counting::later);
    std::uint32_t repeated = 0, dispatches = 0;
    for (int n = 0; n < 12; ++n) {
      Balls balls = moved(n);
      for (Ball& ball : balls)
        if (n % 4 == 2) ball.center *= n % 8 == 2 ? 0.8 : 1.6;  // Crowds grow, or everything scatters.
      Camera camera = camera_;
      if (n % 3 == 1) camera.position += 0.5 * (camera.target - camera.position);
      view.set_atoms(balls);
      view.set_coloring(coloring_);
      view.set_surface(kWater, extent);
      plan({});
      renderer.draw(view, camera, settings_);
      if (n == 0) dispatches = calls_seen().dispatches;
      repeated += calls_seen().dispatches > 3 * dispatches / 2;
      ViewPipeline fresh;
      GlRenderer other;
      fresh.set_atoms(balls);
      fresh.set_coloring(coloring_);
      fresh.set_surface(kWater, extent);
      other.draw(fresh, camera, settings_);
      EXPECT_EQ(renderer.rgba(), other.rgba()) << n;
      EXPECT_EQ(view.stats().primitives, fresh.stats().primitives) << n;
      EXPECT_EQ(view.stats().arcs, fresh.stats().arcs) << n;
      EXPECT_EQ(view.stats().probes, fresh.stats().probes) << n;
      EXPECT_EQ(view.stats().kept_atoms, fresh.stats().kept_atoms) << n;
      EXPECT_EQ(view.stats().circles.pairs, fresh.stats().circles.pairs) << n;
    }
    EXPECT_GT(repeated, 0u) << "no frame was too large for the sizes of the one before";
    EXPECT_LE(repeated, 9u) << "frames are made twice for nothing";
  }
}

/// Returns the least milliseconds that `frame` takes the host while all dispatches are dropped.
double host_milliseconds(const std::function<void(int)>& frame) {
  double least = 1e9;
  for (int n = 0; n < 9; ++n) {
    const auto start = std::chrono::steady_clock::now();
    frame(n);
    const std::chrono::duration<double, std::milli> spent = std::chrono::steady_clock::now() - start;
    least = std::min(least, spent.count());
  }
  return least;
}

// The budgets suit a machine under load: they are several times the usual time.
TEST_F(FrameCalls, HostsPartOfAFrame) {
  Balls block = lattice(70, 70, 70, 2.4);  // 343,000 atoms
  for (std::size_t a = 0; a < block.size(); ++a) {
    block[a].center += 0.4 * glm::dvec3(std::sin(1.0 * a), std::sin(2.0 * a), std::sin(3.0 * a));
    block[a].radius = std::array{1.7, 1.55, 1.52, 1.2}[a % 4];
  }
  for (const Balls& crowd : {atoms_, block}) {
    Coloring coloring;
    coloring.atom.assign(crowd.size(), {0.9f, 0.5f, 0.1f});
    camera_ = frame_camera(crowd, 4.0 / 3.0);
    ViewPipeline view;
    GlRenderer renderer;
    view.set_counting(Counting::later);
    renderer.set_counting(Counting::later);
    view.set_atoms(crowd);
    view.set_coloring(coloring);
    plan({});
    for (int n = 0; n < 2; ++n) renderer.draw(view, camera_, settings_);
    plan({Kind::idle});
    const double still = host_milliseconds([&](int n) {
      Camera camera = camera_;
      camera.position.x += 0.01 * n;
      renderer.draw(view, camera, settings_);
    });
    std::vector<Balls> frames(9, crowd);
    const double moving = host_milliseconds([&](int n) {
      view.set_atoms(std::move(frames[n]));
      renderer.draw(view, camera_, settings_);
    });
    std::cout << fmt::format("{} atoms: host {:.3f} ms where they stay, {:.3f} ms where they move\n", crowd.size(),
                             still, moving);
    const auto count = static_cast<double>(crowd.size());
    EXPECT_LT(still, 2.0 + 1e-4 * count);
    EXPECT_LT(moving, 5.0 + 6e-4 * count);
    plan({});
    WorkProof::current().resync();
  }
}

// The result comes to the host, which computes a part of it.
TEST_F(FrameCalls, ReducedSurface) {
  const auto engine = make_gpu_engine(context_);
  const GlCalls calls = steady("reduced surface", [&](const Balls& atoms) {
    StageClock clock;
    engine->reduce(atoms, kWater, clock);
  });
  EXPECT_LE(calls.waiting_reads, 4u);
  EXPECT_EQ(calls.buffers_changed, 0u);
  EXPECT_EQ(calls.textures_changed, 0u);
}

}  // namespace
}  // namespace meniscus::testing
