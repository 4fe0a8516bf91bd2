// SPDX-License-Identifier: BSD-3-Clause
// A GPU that drops work, runs out of memory or is reset at any call: an error or the same result, never a wrong one.
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/color/coloring.h"
#include "core/gpu/buffer.h"
#include "core/gpu/egl_context.h"
#include "core/gpu/kernel_records.h"
#include "core/gpu/program.h"
#include "core/gpu/work_proof.h"
#include "core/queries/surface_object.h"
#include "core/render/gl_renderer.h"
#include "core/surface/compute_surface.h"
#include "core/visible_surface/view_pipeline.h"
#include "tests/gpu/gl_faults.h"
#include "tests/support/molecules.h"

namespace meniscus::testing {
namespace {

using Kind = GlFault::Kind;

constexpr glm::ivec2 kSize{40, 30};

/// Atoms and what draws them.
struct View {
  ViewPipeline surface;
  GlRenderer renderer;
};

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
    camera_ = frame_camera(atoms_, 4.0 / 3.0);
    settings_.size = kSize;
    settings_.samples = 2;
  }
  void TearDown() override { plan({}); }

  Surface surface_by(ReducedSurfaceEngine& engine) {
    StageClock clock;
    return attempt_surface(engine, atoms_, kWater, clock);
  }

  /// The reduced surface and all that is made of it.
  Job surface_job(ReducedSurfaceEngine& engine) {
    const Surface expected = surface_by(engine);
    return [this, &engine, expected] {
      const auto found = differences(expected, surface_by(engine));
      return found.empty() ? std::string() : found.front();
    };
  }

  /// The picture that the preview shows, made of what the view needs.
  Job view_job(std::optional<View>& view, Extent extent, bool effects) {
    settings_.look.ambient_occlusion = effects ? 0.8f : 0.0f;
    settings_.look.silhouettes = effects ? 2.0f : 0.0f;
    const auto draw = [this, &view, extent, settings = settings_] {
      view->surface.set_atoms(atoms_);
      view->surface.set_coloring(coloring_);
      view->surface.set_surface(kWater, extent);
      view->renderer.draw(view->surface, camera_, settings);
      return view->renderer.rgba();
    };
    return [draw, expected = draw()] { return draw() == expected ? std::string() : std::string("another picture"); };
  }

  /// The picture of a surface that the host has, with all that is known about its pixels.
  Job picture_job(GlRenderer& renderer, const Surface& surface) {
    const auto draw = [this, &renderer, &surface] {
      RenderSettings settings = settings_;
      settings.aovs = true;
      return renderer.render(surface, coloring_, camera_, settings);
    };
    return [draw, expected = draw()] {
      const Framebuffer found = draw();
      const bool same = found.color == expected.color && found.z == expected.z && found.atom == expected.atom;
      return same ? std::string() : std::string("another picture");
    };
  }

  /// Runs the job as it is, then with the fault at every call that it makes. steady: each time behind one without a
  /// fault, so that it trusts in sizes.
  void survives(const Job& job, bool steady = false) {
    EXPECT_EQ(outcome_of(job, {}).different, "");
    const std::uint32_t dispatches = calls_seen().dispatches, questions = calls_seen().error_questions;
    EXPECT_GT(dispatches, 5u);
    int found_out = 0;
    for (const auto& [kind, count] : {std::pair{Kind::drop_from, dispatches},
                                      {Kind::drop_one, dispatches},
                                      {Kind::reset, questions},
                                      {Kind::out_of_memory, questions}}) {
      for (std::uint32_t n = 0; n < count; ++n) {
        if (steady) job();
        const Outcome outcome = outcome_of(job, {kind, n});
        EXPECT_EQ(outcome.different, "") << static_cast<int>(kind) << " at " << n << " of " << count;
        EXPECT_EQ(outcome.capacity_error && kind != Kind::out_of_memory, false) << "a misleading error at " << n;
        const bool lost = kind == Kind::reset && calls_seen().error_questions > n;
        EXPECT_LE(lost, outcome.gpu_error) << "a lost context unnoticed at " << n;
        found_out += outcome.gpu_error;
        plan({});
        WorkProof::current().resync();  // as a new context would have it
      }
    }
    EXPECT_GT(found_out, static_cast<int>(dispatches));
    EXPECT_EQ(outcome_of(job, {}).different, "") << "nothing of a fault stays";
  }

  Balls atoms_;
  Coloring coloring_;
  Camera camera_;
  RenderSettings settings_;
  EglContext context_;
};

TEST_F(LostWork, Surface) {
  const auto engine = make_gpu_engine(context_);
  survives(surface_job(*engine));
  EXPECT_GT(engine->stats().decided_in_double, 0u);
}

TEST_F(LostWork, VisibleView) {
  std::optional<View> view(std::in_place);
  survives(view_job(view, Extent::visible, false));
}

TEST_F(LostWork, CompleteViewWithEffects) {
  std::optional<View> view(std::in_place);
  survives(view_job(view, Extent::complete, true));
}

TEST_F(LostWork, SteadyView) {
  atoms_ = ubiquitin();
  atoms_.resize(200);
  coloring_.atom.resize(atoms_.size());
  for (const Extent extent : {Extent::visible, Extent::complete}) {
    std::optional<View> view(std::in_place);
    view->surface.set_counting(Counting::later);
    view->renderer.set_counting(Counting::later);
    const Job job = view_job(view, extent, extent == Extent::complete);
    job();
    plan({});
    job();
    EXPECT_LE(calls_seen().reads, 2u) << "the picture's end, and the picture: a frame that trusts";
    survives(job, true);
  }
}

TEST_F(LostWork, ViewOfThePaper) {
  std::optional<View> view(std::in_place);
  survives(view_job(view, Extent::paper, false));
}

TEST_F(LostWork, PictureOfASurface) {
  const Surface surface = surface_by(*make_gpu_engine(context_));
  GlRenderer renderer;
  survives(picture_job(renderer, surface));
}

// Only whoever asks for exact times waits for the GPU between stages; whatever is waited for, nothing is missed
// (above).
TEST_F(LostWork, NobodyWaitsButForExactTimes) {
  const auto engine = make_gpu_engine(context_);
  View view;
  view.surface.set_atoms(atoms_);
  view.surface.set_coloring(coloring_);
  const auto waits = [&](StageTiming timing) {
    plan({});
    StageClock clock(timing);
    const Surface surface = attempt_surface(*engine, atoms_, kWater, clock);
    settings_.timing = timing;
    view.renderer.draw(view.surface, camera_, settings_);
    view.renderer.render(surface, coloring_, camera_, settings_);
    return calls_seen().finishes;
  };
  EXPECT_EQ(waits(StageTiming::rough), 0u);
  EXPECT_GT(waits(StageTiming::exact), 20u);
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
      WorkProof::current().resync();
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
    EXPECT_EQ(WorkProof::current().resync().finished, 2u);
  }
}

TEST_F(LostWork, FreshBuffersMayHoldAnything) {
  const Surface expected = surface_by(*make_gpu_engine(context_));
  std::optional<View> view(std::in_place);
  std::vector<Job> jobs;
  for (const Extent extent : {Extent::visible, Extent::paper}) jobs.push_back(view_job(view, extent, true));
  for (const std::uint32_t word : {0xffffffffu, 0xdeadbeefu, 0x7fc00000u, 0x3f800000u}) {  // third: NaN, last: 1.0f
    SCOPED_TRACE(word);
    plan({Kind::poison, word});
    EXPECT_TRUE(differences(expected, surface_by(*make_gpu_engine(context_))).empty());
    for (const Job& job : jobs) {
      view.emplace();
      EXPECT_EQ(job(), "");
    }
  }
}

}  // namespace
}  // namespace meniscus::testing
