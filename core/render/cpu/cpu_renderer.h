// SPDX-License-Identifier: BSD-3-Clause
// Pictures of computed surfaces and shapes made by the CPU alone, for files and for previews.
#pragma once

#include "core/base/progress.h"
#include "core/render/cpu/lane_kernels.h"
#include "core/render/cpu/occluders.h"
#include "core/render/cpu/picture_content.h"
#include "core/render/cpu/unevenness.h"
#include "core/render/cpu/visible_copies.h"
#include "core/render/light_maps.h"
#include "core/render/picture.h"
#include "core/render/picture_block.h"

namespace meniscus {

/// Makes pictures one after another on all threads of the CPU. A picture is the same to the bit for vectors of any
/// width and for any number of threads, and equals GL's picture except for the rounding of arithmetic.
class CpuRenderer {
 public:
  /// Chooses the widest kernels with at most most_lanes (4, 8 or 16) numbers per vector that the machine can run.
  /// patches_together: see VisibleCopies.
  explicit CpuRenderer(int most_lanes = 16, std::size_t patches_together = VisibleCopies::kPatchesTogether)
      : kernels_(widest_kernels(most_lanes)), patches_together_(patches_together) {}

  /// Returns a picture as StillRenderer::render() does.
  Framebuffer render(std::span<const PictureObject> objects, const Camera& camera, const RenderSettings& settings) {
    return render(*pack(objects, camera, settings), settings);
  }
  /// Returns a picture as StillRenderer::render_copies() does.
  Framebuffer render_copies(std::span<const SurfaceObject> objects, const Camera& camera,
                            const RenderSettings& settings) {
    return render(*pack_copies(objects, camera, settings), settings);
  }

  /// Draws a finished picture over the look's background, which stays available as rgba(). `stop` is called regularly
  /// on this thread; if it returns true, drawing stops: draw() returns false, rgba() keeps the previous picture, and
  /// pick() finds nothing. Throws what render() throws.
  bool draw(std::span<const PictureObject> objects, const Camera& camera, const RenderSettings& settings,
            const std::function<bool()>& stop = {}) {
    return draw(pack(objects, camera, settings), settings, stop);
  }
  /// Draws copies in the same way. A picked point has its object, its copy and the atom in that copy.
  bool draw_copies(std::span<const SurfaceObject> objects, const Camera& camera, const RenderSettings& settings,
                   const std::function<bool()>& stop = {}) {
    return draw(pack_copies(objects, camera, settings), settings, stop);
  }

  /// Returns the last drawn picture, 8 bit sRGB and alpha (255) per pixel, rows from the top.
  const std::vector<std::uint8_t>& rgba() const { return rgba_; }
  glm::ivec2 size() const { return size_; }
  /// Returns the point that a pixel (column, row from the top) of the last drawn picture shows; nothing where no ray
  /// hit anything.
  std::optional<PickedPoint> pick(glm::ivec2 pixel) const;

  /// Returns the times of the stages of the last picture.
  const std::vector<StageTime>& times() const { return clock_.times(); }
  /// Returns the name of the device: "cpu (2 threads)".
  static std::string device();

 private:
  /// One sample of each pixel of a block, and an element after the last for everything outside. Tiles without
  /// primitives are never written, so they are initialised once for all samples.
  struct BlockSamples {
    std::vector<glm::vec4> color, over;
    std::vector<float> depth, normal[3], mark;
    std::vector<float> sky_seen, lamp_seen;  ///< LaneLook::sky_seen and lamp_seen
    std::vector<float> shade_depth;  ///< depth of the sample whose visibility this is, if several samples share it
    std::vector<float> shade_size;   ///< LaneLook::shade_size

    void resize(std::size_t pixel_count, bool has_marks, bool has_layers);
    LaneSamples lanes(bool has_visibility);
  };

  /// The requested results of a block.
  struct BlockTask {
    PictureContent& scene;
    SceneBlock at;
    const RenderSettings& settings;
    bool hits = false;  ///< true: hits are requested, too
    /// The renderer calls this function after each sample, when the sample's hits are complete. Without it the hits
    /// of the first sample are kept.
    std::function<void(int sample)> after_sample{};

    std::size_t pixel_count() const { return static_cast<std::size_t>(at.block.size.x) * at.block.size.y; }
  };

  std::shared_ptr<PictureContent> pack(std::span<const PictureObject> objects, const Camera& camera,
                                       const RenderSettings& settings);
  std::shared_ptr<PictureContent> pack_copies(std::span<const SurfaceObject> objects, const Camera& camera,
                                              const RenderSettings& settings);
  void begin(const Camera& camera, const RenderSettings& settings);
  void place(std::span<const PictureObject> objects, const Camera& camera, glm::ivec2 size);
  template <typename Object>
  void trace_light(std::span<const Object> objects, const RenderSettings& settings);
  const LaneLight* light() const { return occluders_ ? occluders_->light() : nullptr; }

  Framebuffer render(PictureContent& scene, const RenderSettings& settings);
  bool draw(std::shared_ptr<PictureContent> scene, const RenderSettings& settings, const std::function<bool()>& stop);
  void cast(const BlockTask& task, Interruption& interruption);
  void resize_samples(const BlockTask& task);
  void cast_samples(int first, int count, const BlockTask& task, Interruption& interruption);
  void apply_look(int sample, const BlockTask& task, Interruption& interruption);
  void find_shade(BlockSamples& samples, int sample, const Look& look, LaneLook& task, Interruption& interruption);
  void apply_front_look(int sample, LaneLook task, const Look& look, Interruption& interruption);
  void present(const RenderSettings& settings);

  const LaneKernels& kernels_;
  const std::size_t patches_together_;
  StageClock clock_;
  PictureFrame frame_;                  // frame of the current or last drawn picture
  PackPlacement placement_;             // placement of the current picture
  LightMaps light_maps_;                // maps of the current picture, if its look needs them
  std::optional<Occluders> occluders_;  // occluders of the current picture, if its light is traced
  const std::shared_ptr<SurfaceContent> surface_ = std::make_shared<SurfaceContent>();  // content of one surface
  bool nothing_is_thin_ = false;      // true: nothing in the current picture fits between the centres of pixels
  std::optional<Unevenness> uneven_;  // unevenness of the current block, known after its first sample
  std::vector<glm::vec4> sums_;
  std::vector<ray_cast::Hit> hits_;
  BlockSamples samples_, front_;       // front_: for pictures with transparent parts
  std::vector<glm::vec4> front_sums_;  // finished colours of front_
  std::vector<float> front_ink_;       // share of front_ that lines cover
  std::vector<std::uint8_t> rgba_;
  glm::ivec2 size_{0};  // size of rgba_
  std::shared_ptr<const PictureContent>
      drawn_;  // the scene of rgba_, which hits_ belong to; nullptr: hits_ are invalid
};

}  // namespace meniscus
