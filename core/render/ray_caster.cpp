// SPDX-License-Identifier: BSD-3-Clause
// Runs the kernels that list primitives by tile, cast rays, finish samples and make a texture of the picture.
#include "core/render/ray_caster.h"

#include <epoxy/gl.h>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/color/coloring.h"
#include "core/gpu/context_description.h"
#include "core/image/color_space.h"

namespace meniscus {

void LookPass::add(const CastSample& sample, const Look& look, const GpuPack& scene, const PictureFrame& frame,
                   const PictureBlock& block, const Buffer& picture) {
  const std::size_t count = static_cast<std::size_t>(block.size.x) * block.size.y;
  depths_.resize(count * sizeof(float));
  shade_.resize(count * sizeof(glm::vec4));
  const bool has_marks = scene.marks.byte_count() > 0;
  marks_.resize(has_marks ? count * sizeof(std::uint32_t) : 0);
  const kernel::BlockView view = block_view(frame, block, sample.offset);
  const auto run = [&](const Program& program, const auto& parameters) {
    program.set(parameters);
    program.set(view, kernel::kBlockViewBinding);
    program.dispatch_2d((static_cast<std::uint32_t>(block.size.x) + 7) / 8,
                        (static_cast<std::uint32_t>(block.size.y) + 7) / 8);
  };
  TexelBuffer& hit_texels = sample.index == 0 ? first_hit_texels_ : hit_texels_;
  hit_texels.view(sample.hits);
  hit_texels.bind(0);
  atom_mark_texels_.view(scene.marks);
  atom_mark_texels_.bind(2);
  depths_.bind(0);
  marks_.bind(1);
  run(programs_.get("gpu_shaders/look/depth.comp"), kernel::DepthParameters{.has_marks = has_marks});
  depth_texels_.view(depths_);
  depth_texels_.bind(1);
  if (look.has_shade() && sample.index == 0) {
    light_texels_.bind(2);
    shade_.bind(0);
    run(programs_.get("gpu_shaders/look/light_maps.comp"), light_maps_.parameters(frame));
  }
  ShaderDefines effects;
  if (look.has_shade()) effects.emplace_back("SHADE", "1");
  if (look.widest_line() > 0.0f) effects.emplace_back("SILHOUETTES", "1");
  shade_texels_.view(shade_);
  shade_texels_.bind(2);
  mark_texels_.view(marks_);
  mark_texels_.bind(3);
  sample.colors.bind(0);
  picture.bind(1);
  run(programs_.get("gpu_shaders/look/finish.comp", effects),
      finish_parameters(look, scene, frame.size, sample.index, has_marks));
}

void LookPass::make_light_maps(std::span<const Ball> atoms, const GpuPack& scene, const Look& look,
                               const ViewBasis& basis) {
  if (!look.has_shade()) return;
  light_maps_.begin();
  light_maps_.add(atoms, scene.blocks_light);
  light_maps_.make(look, basis);
  light_map_.upload(light_maps_.texels());
  light_texels_.view(light_map_);
}

Presenter::~Presenter() {
  if (texture_) glDeleteTextures(1, &texture_);
}

void Presenter::present(const Buffer& picture, glm::ivec2 size, int sample_count, const glm::vec3& background) {
  if (size != size_) {
    if (texture_) glDeleteTextures(1, &texture_);
    texture_ = 0;
    glCreateTextures(GL_TEXTURE_2D, 1, &texture_);
    glTextureStorage2D(texture_, 1, GL_RGBA8, size.x, size.y);
    check_gl("making the picture's texture");
    size_ = size;
  }
  picture.bind(0);
  glBindImageTexture(0, texture_, 0, GL_FALSE, 0, GL_WRITE_ONLY, GL_RGBA8);
  program_.set(kernel::PresentParameters{
      .background = linear_from_srgb(background), .per_sample = 1.0f / static_cast<float>(sample_count), .size = size});
  program_.dispatch_2d((static_cast<std::uint32_t>(size.x) + 7) / 8, (static_cast<std::uint32_t>(size.y) + 7) / 8);
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT | GL_FRAMEBUFFER_BARRIER_BIT);
}

std::vector<std::uint8_t> Presenter::rgba() const {
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(size_.x) * size_.y * 4);
  if (texture_)
    glGetTextureImage(texture_, 0, GL_RGBA, GL_UNSIGNED_BYTE, static_cast<GLsizei>(bytes.size()), bytes.data());
  check_gl("downloading the picture");
  WorkProof::current().verify();
  return bytes;
}

void upload_coloring(const Coloring& coloring, GpuPack& scene) {
  scene.atom_count = static_cast<std::uint32_t>(coloring.atom.size());
  scene.color_by_kind = coloring.kind.has_value();
  scene.some_hidden = coloring.hides_some();
  scene.blocks_light = coloring.blocking();
  scene.colors.upload(linear_colors(coloring));
  scene.marks.upload(coloring.line_marks());
}

kernel::DepthSlices depth_slices(const GpuPack& scene) {
  const float thickness = (scene.last_depth - scene.first_depth) / static_cast<float>(kSliceCount);
  return {.first_depth = scene.first_depth, .slices_per_angstrom = thickness > 0.0f ? 1.0f / thickness : 0.0f};
}

std::uint32_t TileLists::slot_count() const {
  return static_cast<std::uint32_t>(tiles_.x) * static_cast<std::uint32_t>(tiles_.y) * kSlotsPerTile;
}

void TileLists::build(const GpuPack& scene, const PictureFrame& frame, const PictureBlock& block, Counting counting) {
  tiles_ = (block.size + (kTileEdge - 1)) / kTileEdge;
  counts_.resize((slot_count() + 1) * sizeof(std::uint32_t));
  counts_.fill(0);
  entries_.resize(0);
  primitive_texels_.view(scene.primitives.buffer);
  run(0, scene, frame, block);
  if (counting == Counting::later) {
    trusted_ = known_ + known_ / 8 + 64;
    scan_(counts_, slot_count(), trusted_);
  } else {
    scan_(counts_, slot_count());
    Readback readback;
    request_counts(readback);
    readback.read();
    trusted_ = known_ = counted_;
  }
  entries_.resize(trusted_ * sizeof(std::uint32_t));
  run(1, scene, frame, block);
  slot_texels_.view(counts_);
  entry_texels_.view(entries_);
  split_tiles();
}

void TileLists::request_counts(Readback& readback) {
  readback.request(counts_, slot_count() * sizeof(std::uint32_t), {&counted_, 1});
}

bool TileLists::take_counts() {
  if (counted_ >= trusted_) return false;
  known_ = counted_;
  return true;
}

void TileLists::run(int pass, const GpuPack& scene, const PictureFrame& frame, const PictureBlock& block) {
  const Program& program = programs_.get("gpu_shaders/ray_cast/tile_lists.comp", {{"PASS", std::to_string(pass)}});
  primitive_texels_.bind(0);
  counts_.bind(0);
  entries_.bind(1);
  // The bounds of the picture's tiles do not apply to its map of shade, which has fewer tiles.
  const glm::ivec2 all_tiles = tile_counts({{0, 0}, frame.size});
  const bool bounded =
      scene.tile_depths.byte_count() == sizeof(float) * static_cast<std::size_t>(all_tiles.x) * all_tiles.y;
  (bounded ? scene.tile_depths : counts_).bind(2);  // a buffer must be bound in any case
  kernel::TileListParameters parameters = tile_list_parameters(frame, block, scene.primitives.most());
  parameters.bounded = bounded;
  parameters.entry_capacity = trusted_;
  scene.counters.bind(3);
  program.set(parameters);
  program.set(depth_slices(scene), kernel::kDepthSlicesBinding);
  program.dispatch(group_count(scene.primitives.most()));
}

void TileLists::split_tiles() {
  const auto tile_count = static_cast<std::uint32_t>(tiles_.x * tiles_.y);
  tile_order_.resize(tile_count * sizeof(std::uint32_t));
  dispatches_.upload(std::vector<std::uint32_t>{0, 1, 1, 0, 0, 1, 1, 0});
  slot_texels_.bind(0);
  tile_order_.bind(0);
  dispatches_.bind(1);
  const Program& program = programs_.get("gpu_shaders/ray_cast/split_tiles.comp");
  program.set(kernel::SplitTilesParameters{.tile_count = tile_count});
  program.dispatch(group_count(tile_count));
  order_texels_.view(tile_order_);
}

void TileLists::dispatch(const Program& ray_cast) const {
  primitive_texels_.bind(0);
  slot_texels_.bind(2);
  entry_texels_.bind(3);
  order_texels_.bind(4);
  ray_cast.dispatch_indirect(dispatches_);
}

void TileLists::clear_empty(const PictureBlock& block, const Buffer& picture, const Buffer& hits) const {
  order_texels_.bind(0);
  picture.bind(1);
  hits.bind(2);
  const Program& program = programs_.get("gpu_shaders/ray_cast/empty_tiles.comp");
  program.set(kernel::EmptyTilesParameters{.size = block.size, .tiles = tiles_});
  program.dispatch_indirect(dispatches_, 4 * sizeof(std::uint32_t));
}

/// The parameters of the kernel.
struct RayCaster::Parameters {
  kernel::RayCastParameters own;
  kernel::BlockView view;
  kernel::DepthSlices slices;
};

bool RayCaster::cast(const GpuPack& scene, const PictureFrame& frame, const PictureBlock& block,
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

void RayCaster::request_counts(Readback& readback) {
  lists_.request_counts(readback);
  readback.request(unfinished_, 0, {&longest_, 1});
}

bool RayCaster::take_counts() {
  if (!lists_.take_counts() || longest_ > 0) return false;
  known_size_ = size_;
  return true;
}

const Program& RayCaster::program(const GpuPack& scene, bool resumed) {
  ShaderDefines defines;
  if (scene.some_hidden) defines.emplace_back("SOME_HIDDEN", "1");
  if (resumed) defines.emplace_back("RESUMED", "1");
  return programs_.get("gpu_shaders/ray_cast/ray_cast.comp", defines);
}

void RayCaster::cast_sample(const GpuPack& scene, const CastSample& sample, const Parameters& parameters,
                            Counting counting) {
  start(program(scene, false), scene, sample, parameters);
  if (counting == Counting::later) return;
  unfinished_.read(0, &longest_, sizeof longest_);
  long_lists_ |= longest_ > 0;
  if (longest_ > 0) finish_long_lists(longest_, scene, sample, parameters);
}

void RayCaster::start(const Program& program, const GpuPack& scene, const CastSample& sample,
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

// Lists of thousands of primitives, as for large molecules in small pictures, are too long for a single dispatch of
// software GL's kernels.
void RayCaster::finish_long_lists(std::uint32_t longest, const GpuPack& scene, const CastSample& sample,
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
  throw CapacityError(
      message("some rays meet more patches than this driver's kernels can process; use another @device@"));
}

}  // namespace meniscus
