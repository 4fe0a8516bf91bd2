// SPDX-License-Identifier: BSD-3-Clause
// The host's side of ray casting a block: lists of tiles, a dispatch for each sample, and again for long lists.
#include "core/render/ray_caster.h"

#include "core/base/error.h"
#include "core/gpu/program.h"

namespace meniscus {

/// What the kernel is told.
struct RayCaster::Parameters {
  kernel::RayCastParameters own;
  kernel::BlockView view;
  kernel::DepthSlices slices;
};

bool RayCaster::cast(const GpuScene& scene, const PictureFrame& frame, const PictureBlock& block,
                     const CastSettings& settings) {
  StageClock unused;
  StageClock& clock = settings.clock ? *settings.clock : unused;
  const Look& look = settings.look;
  {
    const GpuStage stage(clock, "tile lists");
    lists_.build(scene, frame, block, settings.counting);
  }
  known_size_ = glm::ivec2(0);
  long_lists_ = false;
  size_ = block.size;
  const std::size_t count = static_cast<std::size_t>(block.size.x) * block.size.y;
  picture_.resize(count * sizeof(glm::vec4));
  hits_.resize(count * sizeof(ray_cast::Hit));
  if (look.has_effects()) {
    sample_colors_.resize(count * sizeof(glm::vec4));
    if (settings.samples > 1) sample_hits_.resize(count * sizeof(ray_cast::Hit));
  }
  Parameters parameters{cast_parameters(scene, look, scene.atom_count, scene.color_by_kind), {}, depth_slices(scene)};
  parameters.own.tiles = lists_.tiles();
  row_texels_.view(scene.rows.buffer);
  const std::size_t invocations = 64 * static_cast<std::size_t>(lists_.tiles().x) * lists_.tiles().y;
  unfinished_.resize((2 + invocations) * sizeof(std::uint32_t));
  unfinished_.fill(0);
  for (int n = 0; n < settings.samples; ++n) {
    if (n > 0 && settings.stop && settings.stop()) return false;
    const CastSample sample{look.has_effects() ? sample_colors_ : picture_,
                            n && look.has_effects() ? sample_hits_ : hits_, n, sample_offset(n)};
    {
      const GpuStage stage(clock, "ray cast");
      const bool add = n > 0 && !look.has_effects();
      if (!add) lists_.clear_empty(block, sample.colors, sample.hits);
      parameters.own.add = add;
      parameters.view = block_view(frame, block, sample.offset);
      cast_sample(scene, sample, parameters, settings.counting);
    }
    if (!look.has_effects()) continue;
    const GpuStage stage(clock, "look");
    look_pass_.add(sample, look, scene, frame, block, picture_);
  }
  if (settings.counting == Counting::now && !long_lists_) known_size_ = size_;
  return true;
}

void RayCaster::ask(Readback& readback) {
  lists_.ask(readback);
  readback.ask(unfinished_, 0, {&longest_, 1});
}

bool RayCaster::settle() {
  if (!lists_.settle() || longest_ > 0) return false;
  known_size_ = size_;
  return true;
}

const Program& RayCaster::program(const GpuScene& scene, bool resumed) {
  ShaderDefines defines;
  if (scene.some_hidden) defines.emplace_back("SOME_HIDDEN", "1");
  if (resumed) defines.emplace_back("RESUMED", "1");
  return programs_.get("gpu_shaders/ray_cast/ray_cast.comp", defines);
}

void RayCaster::cast_sample(const GpuScene& scene, const CastSample& sample, const Parameters& parameters,
                            Counting counting) {
  start(program(scene, false), scene, sample, parameters);
  if (counting == Counting::later) return;
  unfinished_.read(0, &longest_, sizeof longest_);
  long_lists_ |= longest_ > 0;
  if (longest_ > 0) finish_long_lists(longest_, scene, sample, parameters);
}

void RayCaster::start(const Program& program, const GpuScene& scene, const CastSample& sample,
                      const Parameters& parameters) {
  row_texels_.bind(1);
  scene.colors.bind(0);
  sample.colors.bind(1);
  sample.hits.bind(2);
  unfinished_.bind(3);
  program.set(parameters.own);
  program.set(parameters.view, kernel::kBlockViewBinding);
  program.set(parameters.slices, kernel::kDepthSlicesBinding);
  lists_.dispatch(program);
}

// Lists of thousands, as of large molecules in small pictures, are too long for one go of software GL's kernels.
void RayCaster::finish_long_lists(std::uint32_t longest, const GpuScene& scene, const CastSample& sample,
                                  Parameters parameters) {
  constexpr std::uint32_t kFirstPart = 256, kSmallestPart = 4;
  states_.resize(unfinished_.byte_count() * 16);  // four vectors of four words for each word there
  for (std::uint32_t length = kFirstPart; length >= kSmallestPart; length /= 4) {
    const std::uint32_t none[2] = {0, 0};
    unfinished_.write(0, none, sizeof none);
    const std::uint32_t part_count = (longest + length - 1) / length;
    parameters.own.part_length = static_cast<std::int32_t>(length);
    for (std::uint32_t part = 0; part < part_count; ++part) {
      parameters.own.part = static_cast<std::int32_t>(part);
      parameters.own.is_last_part = part + 1 == part_count;
      states_.bind(4);
      start(program(scene, true), scene, sample, parameters);
    }
    if (unfinished_.download<std::uint32_t>(1, sizeof(std::uint32_t)).front() == 0) return;
  }
  throw CapacityError("some rays meet more than this driver's kernels can go through; use another device");
}

}  // namespace meniscus
