// SPDX-License-Identifier: BSD-3-Clause
// Pictures of computed surfaces made by the CPU alone, for files and for previews that ask what a pixel shows.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <tbb/enumerable_thread_specific.h>

#include "core/render/cpu/host_scene.h"
#include "core/render/cpu/lane_kernels.h"
#include "core/render/cpu/layered_scene.h"
#include "core/render/cpu/occluders.h"
#include "core/render/cpu/visible_copies.h"
#include "core/render/hit_point.h"
#include "core/render/surface_renderer.h"

namespace meniscus {

class Interruption;
class PictureCollector;

/// Makes one picture after another; see make_cpu_renderer().
class CpuRenderer final : public SurfaceRenderer {
 public:
  /// patches_together: of VisibleCopies.
  explicit CpuRenderer(int most_lanes = 16, std::size_t patches_together = VisibleCopies::kPatchesTogether)
      : kernels_(widest_kernels(most_lanes)), patches_together_(patches_together) {}

  Framebuffer render(const Surface& surface, const Coloring& coloring, const Camera& camera,
                     const RenderSettings& settings) override;
  Framebuffer render(std::span<const PictureObject> objects, const Camera& camera,
                     const RenderSettings& settings) override;
  Framebuffer render_copies(std::span<const SurfaceObject> objects, const Camera& camera,
                            const RenderSettings& settings) override;

  /// A finished picture over the look's background, which stays as rgba(). stop: asked now and then on this thread; if
  /// true, the picture is given up: false, rgba() is the one before, and there is nothing to pick. Throws as render().
  bool draw(const Surface& surface, const Coloring& coloring, const Camera& camera, const RenderSettings& settings,
            const std::function<bool()>& stop = {});
  /// The same of several objects, or of one that is cut or seen through.
  bool draw(std::span<const PictureObject> objects, const Camera& camera, const RenderSettings& settings,
            const std::function<bool()>& stop = {});

  /// The same of copies, as render_copies() makes them. What is picked tells its object, copy and atom.
  bool draw_copies(std::span<const SurfaceObject> objects, const Camera& camera, const RenderSettings& settings,
                   const std::function<bool()>& stop = {});

  /// The last drawn picture, 8 bit sRGB and alpha (255) per pixel, rows from the top.
  const std::vector<std::uint8_t>& rgba() const { return rgba_; }
  glm::ivec2 size() const { return size_; }
  /// pixel of the last drawn picture: column, row from the top. Nothing where nothing is hit.
  std::optional<PickedPoint> pick(glm::ivec2 pixel) const;

  const std::vector<StageTime>& times() const override { return clock_.times(); }
  std::string device() const override;

 private:
  /// One sample of each pixel of a block and, after the last, of what lies outside. Tiles that list nothing are never
  /// written, so that one beginning does for all samples.
  struct BlockSamples {
    std::vector<glm::vec4> color, over;
    std::vector<float> depth, normal[3], mark, visibility;
    std::vector<float> shade_depth;  ///< depth of the sample whose visibility it is, if several share it
    std::vector<float> shade_size;   ///< LaneLook::shade_size

    void resize(std::size_t pixel_count, bool has_marks, bool has_layers);
    LaneSamples lanes(bool has_visibility);
  };

  /// What is made of a block.
  struct BlockTask {
    const PictureFrame& frame;
    PictureBlock block;
    const RenderSettings& settings;
    bool hits;                       ///< wanted too
    LayeredScene* layers = nullptr;  ///< what it shows; nullptr: scene_
    /// Called behind each sample, whose hits are there then; empty: hits are those of the first.
    std::function<void(int sample)> after_sample{};
  };

  void begin(const Camera& camera, const RenderSettings& settings);
  ScenePlacement place(std::span<const PictureObject> objects, const Camera& camera, const RenderSettings& settings);
  /// What the light of the picture meets, once its frame is known; nothing where the look traces no light.
  template <typename Object>
  void trace_light(std::span<const Object> objects, float slack, const RenderSettings& settings);
  const LaneLight* light() const { return occluders_ ? occluders_->light() : nullptr; }
  void pack(const Surface& surface, const Coloring& coloring, const Camera& camera, const RenderSettings& settings);
  ScenePlacement place_copies(std::span<const SurfaceObject> objects, const Camera& camera,
                              const RenderSettings& settings);
  void cast_shade_map_of_copies(std::span<const SurfaceObject> objects, const ScenePlacement& placement,
                                const RenderSettings& settings, Interruption& interruption);
  void start_block(const PictureFrame& frame, const PictureBlock& block, LayeredScene* layers);
  void cast_shade_map(const PictureFrame& map, const RenderSettings& settings, Interruption& interruption,
                      LayeredScene* layers = nullptr);
  void cast(const BlockTask& task, Interruption& interruption);
  /// Casts a block of a picture for a file, and hands over its inner part.
  void cast_into(PictureCollector& collector, const PictureBlock& inner, BlockTask task, Interruption& interruption);
  void cast_samples(int first, int count, const BlockTask& task, Interruption& interruption);
  void cast_tile(std::size_t tile, LaneTile task);
  void look_at(int sample, const RenderSettings& settings, bool has_marks, bool has_front, Interruption& interruption);
  /// Sets what a sample's shade is made of; finds it, if the sample has its own.
  void find_shade(BlockSamples& samples, int sample, const Look& look, LaneLook& task, Interruption& interruption);
  /// Finishes what is seen through and first along its ray: its shade, air and lines go into samples_.over, each as
  /// opaque as it is.
  void look_at_front(int sample, LaneLook task, const RenderSettings& settings, Interruption& interruption);
  void present(const RenderSettings& settings);

  const LaneKernels& kernels_;
  const std::size_t patches_together_;
  StageClock clock_;
  PictureFrame frame_;                  // of the picture at work, and when it is drawn, of that
  HostScene scene_;                     // likewise; of copies, what its last block shows
  std::optional<Occluders> occluders_;  // of the picture at work, if its light is traced
  CpuTileLists lists_;
  tbb::enumerable_thread_specific<SortedList> sorted_;
  std::vector<glm::vec4> sums_;
  std::vector<ray_cast::Hit> hits_;
  BlockSamples samples_, front_;                    // front_: of pictures in which something is seen through
  std::vector<glm::vec4> front_sums_;               // of front_, finished
  std::vector<float> front_ink_;                    // share of it that lines cover
  std::vector<float> shade_map_, front_shade_map_;  // depths of the whole picture, and after the last that of nothing
  std::vector<std::uint8_t> rgba_;
  glm::ivec2 size_{0};                  // of rgba_
  bool drawn_ = false;                  // scene_ and hits_ are those of rgba_
  std::vector<CopyPlace> places_;       // in scene_, if copies are drawn; else empty
  std::optional<LayeredScene> layers_;  // of rgba_, if it has any: what its hits mean
};

}  // namespace meniscus
