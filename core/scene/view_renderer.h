// SPDX-License-Identifier: BSD-3-Clause
// Draws atoms in one view after another, on any device: the pictures of a preview.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include <glm/vec2.hpp>

#include "core/base/stage_clock.h"
#include "core/camera/camera.h"
#include "core/color/coloring.h"
#include "core/render/hit_point.h"
#include "core/render/picture.h"
#include "core/structure/structure.h"
#include "core/scene/figure.h"
#include "core/surface/primitives.h"

namespace meniscus {

/// Finds what a view needs of the solvent-excluded surface, draws it, and keeps the last picture. Used by one thread.
class ViewRenderer {
 public:
  virtual ~ViewRenderer() = default;

  /// Van der Waals balls, Å, of one frame; there must be one.
  virtual void set_atoms(std::vector<Ball> atoms) = 0;
  /// One colour per atom; to be set after atoms of another number and before the next picture.
  virtual void set_coloring(const Coloring& coloring) = 0;

  /// What is cut, seen through, hidden and shown beside the surface (nullptr: nothing). Such views are cast on the CPU
  /// whatever draws the others.
  virtual void set_figure(const FigureRequest& request, std::shared_ptr<const BesideSurface> beside) = 0;

  /// A finished picture over the look's background. probe_radius: Å, >= 0. stop: asked now and then on this thread,
  /// also between the stages of a surface; if true, the picture is given up: false, the one before stays, and there is
  /// nothing to pick. Throws GpuError, CapacityError, OpenSurfaceError, InputError for a bad camera, RequestError where
  /// nothing is shown.
  virtual bool draw(double probe_radius, const Camera& camera, const RenderSettings& settings,
                    const std::function<bool()>& stop = {}) = 0;

  /// The last drawn picture, 8 bit sRGB and alpha (255) per pixel, rows from the top.
  virtual std::vector<std::uint8_t> rgba() const = 0;
  /// The same as a GL texture (GL_RGBA8, sRGB values, first row on top) that lives until the next draw; 0: none.
  virtual std::uint32_t texture() const = 0;
  virtual glm::ivec2 size() const = 0;
  /// pixel of the last drawn picture: column, row from the top. Nothing where nothing is hit. object: 0 the surface,
  /// with its atoms; 1 the shapes beside it, 2 + n the n-th of BesideSurface::objects, whose atoms are places in
  /// shown_atoms(). Of copies: see make_cpu_copies_renderer().
  virtual std::optional<PickedPoint> pick(glm::ivec2 pixel) const = 0;

  /// The complete surface of the atoms, if that is what is drawn; else nullptr.
  virtual std::shared_ptr<const Surface> surface() const = 0;
  /// Å by which radii were grown at most for the last picture to tell ties apart; 0 as a rule.
  virtual double grown_by() const = 0;
  /// Is the picture that the next draw makes cast on the CPU?
  virtual bool draws_on_cpu() const = 0;
  /// Of the stages of the last picture.
  virtual const std::vector<StageTime>& times() const = 0;
};

/// By the part of the surface that each view shows, which GL finds for every picture (ViewPipeline). Needs a current GL
/// context for its whole life.
std::unique_ptr<ViewRenderer> make_gl_view_renderer();

/// By the complete surface, which the CPU computes once for all views of the same atoms and probe. Needs no GL.
std::unique_ptr<ViewRenderer> make_cpu_view_renderer();

/// By one surface for each group of atoms, as if it were alone, wherever its copies are; the CPU never has all copies
/// in memory. set_atoms(), set_coloring() and pick() are about the atoms of one copy; copies name them by index.
std::unique_ptr<ViewRenderer> make_cpu_copies_renderer(std::vector<Instances> copies);

/// The same by another renderer of atoms, which gets those of all copies as atoms like all others. No probe may touch
/// two copies at once (closest_contact); then there is no difference.
std::unique_ptr<ViewRenderer> make_placed_atoms_renderer(std::vector<Instances> copies,
                                                         std::unique_ptr<ViewRenderer> renderer);

}  // namespace meniscus
