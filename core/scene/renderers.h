// SPDX-License-Identifier: BSD-3-Clause
// The two kinds of renderer: one draws finished surfaces into still pictures, the other finds and draws the parts that
// each view of a preview needs. Also the choice of the device of pictures.
#pragma once

#include "core/base/progress.h"
#include "core/gpu/egl_context.h"
#include "core/math/ball.h"
#include "core/render/cpu/cpu_renderer.h"
#include "core/render/picture.h"
#include "core/render/picture_block.h"
#include "core/scene/surface_computer.h"

namespace meniscus {

struct FigureExtras;
struct FigureRequest;

/// Draws computed surfaces and shapes into pictures in memory, one after another, for files. This one draws on the CPU.
class StillRenderer {
 public:
  /// most_lanes: as in CpuRenderer.
  explicit StillRenderer(int most_lanes = 16) : cpu_(most_lanes) {}
  virtual ~StillRenderer() = default;

  /// Returns a picture of objects of any kind and size, with their cuts and opacities; it does not depend on
  /// block_edge. objects: at least one. Each colouring has one colour per atom of its object; atoms of the AOVs are
  /// places in it. Throws InputError for a bad camera; GpuError and CapacityError for pictures made on GL.
  virtual Framebuffer render(std::span<const PictureObject> objects, const Camera& camera,
                             const RenderSettings& settings) {
    return cpu_.render(objects, camera, settings);
  }
  /// Returns the picture of merged(objects), equal to the last bit, without having all copies in memory at once: only
  /// the parts that its pixels show are kept. Rays of traced light are turned to each copy instead, so that the edges
  /// of shadows may differ by rounding. Atoms and components of the AOVs are places in merged(). objects: at least one,
  /// as merged() requires them. Throws what render() throws.
  virtual Framebuffer render_copies(std::span<const SurfaceObject> objects, const Camera& camera,
                                    const RenderSettings& settings) {
    return cpu_.render_copies(objects, camera, settings);
  }

  /// Returns the times of the stages of the last picture.
  virtual const std::vector<StageTime>& times() const { return cpu_.times(); }
  /// Returns the name of the device of the last picture: "cpu (2 threads)", or renderer and version of GL.
  virtual std::string device() const { return CpuRenderer::device(); }

 private:
  CpuRenderer cpu_;
};

/// Returns a renderer that draws whole surfaces on GL, and pictures with layers, copies, mattes or traced light on the
/// CPU. context: must be current, and outlive the renderer.
std::unique_ptr<StillRenderer> make_gl_still_renderer(const EglContext& context);

/// Finds the parts of the solvent-excluded surface of some atoms that a view needs, draws them, and keeps the last
/// picture: for previews. Used by one thread.
class PreviewRenderer {
 public:
  virtual ~PreviewRenderer() = default;

  /// Sets the van der Waals balls of one frame, Å; at least one.
  virtual void set_atoms(std::vector<Ball> atoms) = 0;
  /// Sets one colour per atom. Must be called after set_atoms() with another number of atoms, before the next picture.
  virtual void set_coloring(const Coloring& coloring) = 0;

  /// Sets cuts, opacities, hidden atoms, and everything drawn in addition to the surface (nullptr: nothing). Such views
  /// are cast on the CPU, whichever device draws the others.
  virtual void set_figure(const FigureRequest& request, std::shared_ptr<const FigureExtras> extras) = 0;

  /// Draws a finished picture over the look's background. probe_radius: Å, >= 0. stop: called now and then on this
  /// thread, also between the stages of a surface; if it returns true, the picture is given up: draw() returns false,
  /// the picture before stays, and nothing can be picked. Throws GpuError, CapacityError, OpenSurfaceError, InputError
  /// for a bad camera, RequestError if nothing is shown.
  virtual bool draw(double probe_radius, const Camera& camera, const RenderSettings& settings,
                    const std::function<bool()>& stop = {}) = 0;

  /// Returns the last drawn picture: 8 bit sRGB and alpha (255) per pixel, rows from the top.
  virtual std::vector<std::uint8_t> rgba() const = 0;
  virtual glm::ivec2 size() const = 0;
  /// Returns the point that a pixel of the last drawn picture shows; nothing if the pixel shows background. pixel:
  /// column, row from the top. Its object is 0 for the surface, with its atoms; 1 for the shapes drawn in addition, 2 +
  /// n for the n-th of FigureExtras::objects, whose atoms are places in shown_atoms(). For copies see
  /// make_cpu_copies_renderer().
  virtual std::optional<PickedPoint> pick(glm::ivec2 pixel) const = 0;

  /// Returns the complete surface of the atoms if the renderer draws it; else nullptr.
  virtual std::shared_ptr<const Surface> surface() const { return nullptr; }
  /// Returns the largest growth of a radius in the last picture, Å, by which ties are decided; usually 0.
  virtual double grown_by() const = 0;
  /// True if the CPU casts the picture of the next draw().
  virtual bool draws_on_cpu() const = 0;
  /// Returns the times of the stages of the last picture.
  virtual const std::vector<StageTime>& times() const = 0;
};

/// Returns a renderer of the part of the surface that each view shows, which GL finds for every picture (ViewPipeline).
/// It needs a current GL context for its whole life.
std::unique_ptr<PreviewRenderer> make_gl_preview_renderer();

/// Returns a renderer of the complete surface, which the CPU computes once for all views of the same atoms and probe.
std::unique_ptr<PreviewRenderer> make_cpu_preview_renderer();

/// Returns a renderer that computes one surface for each group of atoms, as if it were alone, and draws its copies; the
/// CPU never has all copies in memory. set_atoms(), set_coloring() and pick() refer to the atoms of one copy, by the
/// indices in `copies`.
std::unique_ptr<PreviewRenderer> make_cpu_copies_renderer(std::vector<Instances> copies);

/// Returns a renderer that gives another one the atoms of all copies. No probe may touch two copies at once
/// (closest_contact); then its pictures are equal to the pictures of make_cpu_copies_renderer().
std::unique_ptr<PreviewRenderer> make_placed_atoms_renderer(std::vector<Instances> copies,
                                                            std::unique_ptr<PreviewRenderer> renderer);

/// The device of pictures of computed surfaces: the CPU, or GL in a context of its own.
class PictureDevice {
 public:
  /// The automatic choice is a hardware GPU if there is one, else the CPU, which is faster than software GL. Throws
  /// GpuError if the user chose GL and it is not available.
  explicit PictureDevice(const SurfaceRequest& request);

  StillRenderer& renderer() { return *renderer_; }
  /// Returns the context, which is current on this thread; nullptr if pictures are made on the CPU.
  const EglContext* context() const { return context_ ? &*context_ : nullptr; }

 private:
  void find_gl(DeviceChoice choice);

  ThreadLimit thread_limit_;
  std::optional<EglContext> context_;
  std::unique_ptr<StillRenderer> renderer_;
};

}  // namespace meniscus
