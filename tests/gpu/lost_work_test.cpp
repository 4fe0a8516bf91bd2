// SPDX-License-Identifier: BSD-3-Clause
// A GPU that drops work, runs out of memory or is reset at any call: an error or the same result, never another one.
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/gpu/buffer.h"
#include "core/gpu/egl_context.h"
#include "core/gpu/kernel_parameters.h"
#include "core/gpu/program.h"
#include "core/gpu/work_proof.h"
#include "core/render/ray_caster.h"
#include "core/queries/compare.h"
#include "core/surface/gpu/pipeline.h"
#include "core/visible_surface/frame_renderer.h"
#include "tests/gpu/gl_faults.h"
#include "tests/support/molecules.h"

namespace meniscus::testing {
namespace {

using Kind = GlFault::Kind;

constexpr glm::ivec2 kSize{40, 30};

/// Some way to a result; empty: it is the one expected.
using Job = std::function<std::string()>;

/// What a job makes of a fault: its error, or how its result differs.
struct Outcome {
  bool gpu_error = false, capacity_error = false;
  std::string different;
};

Outcome outcome_of(const Job& job, GlFault fault) {
  plan(fault);
  Outcome outcome;
  try {
    outcome.different = job();
  } catch (const GpuError&) {
    outcome.gpu_error = true;
  } catch (const CapacityError&) {
    outcome.capacity_error = true;
  }
  return outcome;
}

class LostWork : public ::testing::Test {
 protected:
  void SetUp() override {
    plan({});
    // Something of everything; the lattice has ties, which single precision leaves in doubt.
    atoms_ = gas_case(7).balls;
    for (const Ball& ball : translated(lattice(2, 2, 2, 3.0), {40, 0, 0})) atoms_.push_back(ball);
    coloring_.atom.assign(atoms_.size(), {0.9f, 0.5f, 0.1f});
    request_.camera = frame_camera(atoms_, 4.0 / 3.0);
    request_.size = kSize;
    request_.samples = 2;
  }
  void TearDown() override { plan({}); }

  /// The reduced surface and all that is made of it.
  Job surface_job(SurfacePipeline& pipeline) {
    const Surface expected = pipeline.run(atoms_, kWater);
    return [this, &pipeline, expected] {
      const auto found = differences(expected, pipeline.run(atoms_, kWater));
      return found.empty() ? std::string() : found.front();
    };
  }

  /// The picture that the preview shows, made of what the view needs.
  Job view_job(std::optional<FrameRenderer>& renderer, Extent extent, bool effects) {
    request_.extent = extent;
    request_.look.ambient_occlusion = effects ? 0.8f : 0.0f;
    request_.look.silhouettes = effects ? 2.0f : 0.0f;
    const auto draw = [this, &renderer, request = request_] {
      renderer->set_atoms(atoms_);
      renderer->set_coloring(coloring_);
      renderer->render(request);
      return renderer->rgba();
    };
    return [draw, expected = draw()] { return draw() == expected ? std::string() : std::string("another picture"); };
  }

  /// The picture of a surface that the host has, with all that is known about its pixels.
  Job picture_job(RayCaster& caster, const Surface& surface) {
    const auto draw = [this, &caster, &surface] {
      RenderSettings settings;
      settings.size = kSize;
      settings.samples = 2;
      settings.aovs = true;
      return caster.render(surface, coloring_, request_.camera, settings);
    };
    return [draw, expected = draw()] {
      const Framebuffer found = draw();
      const bool same = found.color == expected.color && found.z == expected.z && found.atom == expected.atom;
      return same ? std::string() : std::string("another picture");
    };
  }

  /// Runs the job as it is, then with the fault at every call that it makes.
  void survives(const Job& job) {
    EXPECT_EQ(outcome_of(job, {}).different, "");
    const std::uint32_t dispatches = dispatches_seen(), questions = error_questions_seen();
    EXPECT_GT(dispatches, 5u);
    int found_out = 0;
    for (const auto& [kind, count] : {std::pair{Kind::drop_from, dispatches},
                                      {Kind::drop_one, dispatches},
                                      {Kind::reset, questions},
                                      {Kind::out_of_memory, questions}}) {
      for (std::uint32_t n = 0; n < count; ++n) {
        const Outcome outcome = outcome_of(job, {kind, n});
        EXPECT_EQ(outcome.different, "") << static_cast<int>(kind) << " at " << n << " of " << count;
        EXPECT_EQ(outcome.capacity_error && kind != Kind::out_of_memory, false) << "a misleading error at " << n;
        const bool lost = kind == Kind::reset && error_questions_seen() > n;
        EXPECT_LE(lost, outcome.gpu_error) << "a lost context unnoticed at " << n;
        found_out += outcome.gpu_error;
        plan({});
        WorkProof::current().settle();  // as a new context would have it
      }
    }
    EXPECT_GT(found_out, static_cast<int>(dispatches));
    EXPECT_EQ(outcome_of(job, {}).different, "") << "nothing of a fault stays";
  }

  Balls atoms_;
  Coloring coloring_;
  FrameRequest request_;
  EglContext context_;
};

TEST_F(LostWork, Surface) {
  SurfacePipeline pipeline;
  survives(surface_job(pipeline));
  EXPECT_GT(pipeline.stats().decided_in_double, 0u);
}

TEST_F(LostWork, VisibleView) {
  std::optional<FrameRenderer> renderer(std::in_place);
  survives(view_job(renderer, Extent::visible, false));
}

TEST_F(LostWork, CompleteViewWithEffects) {
  std::optional<FrameRenderer> renderer(std::in_place);
  survives(view_job(renderer, Extent::complete, true));
}

TEST_F(LostWork, ViewOfThePaper) {
  std::optional<FrameRenderer> renderer(std::in_place);
  survives(view_job(renderer, Extent::paper, false));
}

TEST_F(LostWork, PictureOfASurface) {
  SurfacePipeline pipeline;
  const Surface surface = pipeline.run(atoms_, kWater);
  RayCaster caster;
  survives(picture_job(caster, surface));
}

// Between two looks at the GPU nothing but dispatches whose groups the GPU counts, more of them than the account holds.
TEST_F(LostWork, OfGroupsThatTheGpuCounts) {
  const Program program("gpu_shaders/test_support/scale.comp");
  Buffer words(128 * sizeof(std::uint32_t)), surplus(sizeof(std::uint32_t));
  const Buffer counts{std::span<const std::uint32_t>(std::vector<std::uint32_t>{2, 1, 1})};
  const auto run = [&](std::uint32_t times) {
    words.bind(0);
    surplus.bind(1);
    program.set(kernel::ScaleParameters{.count = 128, .offset = 1});
    for (std::uint32_t n = 0; n < times; ++n) program.dispatch_indirect(counts, 0);
    WorkProof::current().verify();
  };
  words.fill(0);
  surplus.fill(0);
  WorkProof::current().verify();
  for (const std::uint32_t times : {1u, 2u, 63u, 64u, 65u, 200u}) {
    EXPECT_NO_THROW(run(times)) << times;
    for (const std::uint32_t lost : {0u, times / 2, times - 1}) {
      plan({Kind::drop_one, lost});
      EXPECT_THROW(run(times), GpuError) << lost << " of " << times;
      plan({});
      WorkProof::current().settle();
    }
  }
}

TEST_F(LostWork, AnAccountThatCannotBeReadProvesNothing) {
  const Program program("gpu_shaders/test_support/scale.comp");
  Buffer words(128 * sizeof(std::uint32_t)), surplus(sizeof(std::uint32_t));
  const Buffer counts{std::span<const std::uint32_t>(std::vector<std::uint32_t>{2, 1, 1})};
  words.bind(0);
  surplus.bind(1);
  program.set(kernel::ScaleParameters{.count = 128, .offset = 1});
  for (const bool indirect : {false, true}) {
    WorkProof::current().verify();
    indirect ? program.dispatch_indirect(counts, 0) : program.dispatch(2);
    plan({Kind::no_reads});
    EXPECT_THROW(WorkProof::current().verify(), GpuError);
    plan({});
    EXPECT_EQ(WorkProof::current().settle().finished, 2u);
  }
}

TEST_F(LostWork, FreshBuffersMayHoldAnything) {
  SurfacePipeline clean;
  const Surface expected = clean.run(atoms_, kWater);
  std::optional<FrameRenderer> renderer(std::in_place);
  std::vector<Job> views;
  for (const Extent extent : {Extent::visible, Extent::paper}) views.push_back(view_job(renderer, extent, true));
  for (const std::uint32_t word : {0xffffffffu, 0xdeadbeefu, 0x7fc00000u, 0x3f800000u}) {  // third: NaN, last: 1.0f
    SCOPED_TRACE(word);
    plan({Kind::poison, word});
    SurfacePipeline pipeline;
    EXPECT_TRUE(differences(expected, pipeline.run(atoms_, kWater)).empty());
    for (const Job& view : views) {
      renderer.emplace();
      EXPECT_EQ(view(), "");
    }
  }
}

}  // namespace
}  // namespace meniscus::testing
