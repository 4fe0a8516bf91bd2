// SPDX-License-Identifier: BSD-3-Clause
// Pictures of computed surfaces, by the CPU or by GL.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/base/stage_clock.h"
#include "core/color/coloring.h"
#include "core/render/picture.h"
#include "core/render/picture_object.h"

namespace meniscus {

class EglContext;
struct Camera;
struct Surface;
struct SurfaceObject;

/// Makes one picture after another.
class SurfaceRenderer {
 public:
  virtual ~SurfaceRenderer() = default;

  /// A picture on the host, of any size; the same for any block_edge. coloring.atom has one colour per surface.atoms.
  /// Throws InputError for a bad camera; GpuError and CapacityError where GL makes it.
  virtual Framebuffer render(const Surface& surface, const Coloring& coloring, const Camera& camera,
                             const RenderSettings& settings) = 0;

  /// A picture of any objects, cut and seen through as they say; made on the CPU wherever it needs layers or mattes,
  /// or light is traced. Atoms of the AOVs are places in the colouring of their object. objects: at least one. Throws
  /// as render().
  virtual Framebuffer render(std::span<const PictureObject> objects, const Camera& camera,
                             const RenderSettings& settings) = 0;

  /// The same picture as of merged(objects), to the bit, where copies need not be in memory all at once: on the CPU,
  /// which keeps what its pixels show, also for GL. Rays of traced light turn to each copy instead, so that the edges
  /// of shadows may differ by rounding. Atoms and components of the AOVs are those of merged(). objects: at least one,
  /// as merged() wants them. Throws as render().
  virtual Framebuffer render_copies(std::span<const SurfaceObject> objects, const Camera& camera,
                                    const RenderSettings& settings) = 0;

  /// Of the stages of the last picture.
  virtual const std::vector<StageTime>& times() const = 0;
  /// "cpu (2 threads)", or renderer and version of GL.
  virtual std::string device() const = 0;
};

/// On all threads of the CPU, without GL: the same picture to the bit for vectors of any width and for any number of
/// threads, and the picture that GL makes but for the rounding of its arithmetic. most_lanes: vectors no longer than
/// that, of 4, 8, 16 numbers; the machine has them or shorter ones.
std::unique_ptr<SurfaceRenderer> make_cpu_renderer(int most_lanes = 16);

/// In a context that is current and lives longer.
std::unique_ptr<SurfaceRenderer> make_gl_renderer(const EglContext& context);

/// Renderer and version.
std::string gl_words(const EglContext& context);

}  // namespace meniscus
