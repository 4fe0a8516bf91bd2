// SPDX-License-Identifier: BSD-3-Clause
// What a steady frame asks of GL, call by call: budgets for frames of moving atoms once sizes have settled.
#include <cmath>
#include <functional>
#include <iostream>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/gpu/egl_context.h"
#include "core/render/renderer.h"
#include "core/surface/gpu/gpu_engine.h"
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

  /// All atoms on their way, as frame `n` of a trajectory.
  Balls moved(int n) const {
    Balls balls = atoms_;
    for (std::size_t a = 0; a < balls.size(); ++a)
      balls[a].center += 0.02 * n * glm::dvec3(std::sin(1.0 * a), std::sin(2.0 * a), std::sin(3.0 * a));
    return balls;
  }

  /// The calls of the last of some frames, none of which found anything compiled or made anew.
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
    Renderer renderer;
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
  EXPECT_LE(calls.waiting_reads, 15u);
  EXPECT_EQ(calls.buffers_changed, 0u);
  EXPECT_EQ(calls.textures_changed, 0u);
}

TEST_F(FrameCalls, CompleteView) {
  const GlCalls calls = steady_view("complete", Extent::complete);
  EXPECT_LE(calls.waiting_reads, 15u);
  EXPECT_EQ(calls.buffers_changed, 0u);
  EXPECT_EQ(calls.textures_changed, 0u);
}

TEST_F(FrameCalls, ViewWithEffects) {
  settings_.samples = 4;
  settings_.look.ambient_occlusion = 0.8f;
  settings_.look.silhouettes = 2.0f;
  const GlCalls calls = steady_view("complete, 4 samples, shaded", Extent::complete);
  EXPECT_LE(calls.waiting_reads, 15u);
  EXPECT_EQ(calls.buffers_changed, 0u);
  EXPECT_EQ(calls.textures_changed, 0u);
}

// Its result comes to the host, which has a part in it.
TEST_F(FrameCalls, ReducedSurface) {
  const auto engine = make_gpu_engine(context_);
  const GlCalls calls = steady("reduced surface", [&](const Balls& atoms) {
    StageClock clock;
    engine->reduce(atoms, kWater, clock);
  });
  EXPECT_LE(calls.waiting_reads, 15u);
  EXPECT_EQ(calls.buffers_changed, 0u);
  EXPECT_EQ(calls.textures_changed, 0u);
}

}  // namespace
}  // namespace meniscus::testing
