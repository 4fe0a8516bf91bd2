// SPDX-License-Identifier: BSD-3-Clause
// Makes the picture of a state, or the tables from which a page casts it. The cache keeps the last picture, surfaces
// while only looks change, and areas that are known.
#pragma once

#include <future>
#include <tuple>

#include "app/preview/shown_molecule.h"
#include "core/queries/surface_object.h"
#include "core/scene/renderers.h"
#include "core/scene/surface_computer.h"
#include "core/surface/primitives.h"

namespace meniscus {

namespace page {
struct PackedFrame;
}

/// The atoms whose areas are requested.
struct AtomsInView {
  std::size_t frame = 0;
  std::size_t group = 0;  ///< index of the group, if several groups have separate surfaces
  SurfaceKind kind = SurfaceKind::ses;
  double probe_radius = 0.0;               ///< Å
  const std::vector<Ball>& balls;          ///< grown by growth_of() the kind
  std::shared_ptr<const Surface> surface;  ///< their complete surface, if it is known already
};

/// Exact areas per frame, kind of surface and probe radius, from the complete surface, which is computed on the CPU in
/// a separate thread, one at a time. The latest few are kept.
class ExposedAreas {
 public:
  /// Returns the area in Å² of the points that take the atom's colour (AtomAreas::surface). An unknown area is
  /// computed: with `wait` before this returns, else a later call finds it. Without `wanted` this happens only if it is
  /// cheap because the surface is there. Throws OpenSurfaceError, CapacityError.
  std::optional<double> of(const AtomsInView& atoms, std::size_t atom, bool wait, bool wanted);
  /// Returns true if areas are being computed, so that a later call may find more of them.
  bool computing() const { return pending_.valid(); }

 private:
  using Key = std::tuple<std::size_t, std::size_t, SurfaceKind, double>;
  using Areas = std::vector<double>;

  void keep();

  std::map<Key, Areas> known_;
  std::vector<Key> order_;  ///< keys of known_, oldest first
  Key pending_key_{};
  std::future<Areas> pending_;
};

/// The qualities of pictures, from a draft while something moves to the picture at rest.
enum class Quality {
  balls,  ///< atoms alone, at once, while their first surface is computed
  draft,  ///< half the size, one ray per pixel, no effects
  plain,  ///< the draft in full size
  full    ///< the quality of exported pictures
};

/// A cache whose functions get the present state and its molecule; it distinguishes states by their revisions.
class ViewCache {
 public:
  explicit ViewCache(std::unique_ptr<PreviewRenderer> renderer) : renderer_(std::move(renderer)) {}

  /// Gives the renderer the parts that another state has made again. moves: the balls of the surface change, too.
  void take(const PreviewState& state, const ShownMolecule& molecule, Renewal renewal, bool moves);

  /// Draws the picture unless it is drawn already. stop: called now and then; if it returns true, the picture is given
  /// up, the last one stays, and the result is false. Throws GpuError, after which the cache cannot go on,
  /// CapacityError, OpenSurfaceError.
  bool draw(const PreviewState& state, const ShownMolecule& molecule, Quality quality,
            const std::function<bool()>& stop = {});
  /// Returns true if the last picture is the one that draw() would draw.
  bool is_drawn(const PreviewState& state, Quality quality) const {
    return is_drawn(state) && drawn_.quality == quality;
  }
  /// Returns true if the last picture shows the state, in any quality.
  bool is_drawn(const PreviewState& state) const { return drawn_.revision == state.revision; }

  /// Returns true if the first surface takes so long that atoms should be shown before.
  bool wants_balls(const PreviewState& state, const ShownMolecule& molecule) const;

  /// Returns the last picture with its legend; see PreviewRenderer::draw().
  std::vector<std::uint8_t> rgba() const;
  glm::ivec2 size() const;
  bool draws_on_cpu() const { return renderer_->draws_on_cpu(); }

  /// Returns what a pixel of the picture at rest shows; the picture is drawn again if necessary.
  std::optional<PickedPoint> pick(const PreviewState& state, const ShownMolecule& molecule, glm::ivec2 pixel);

  /// Returns the exposed area of an atom in Å²: see ExposedAreas::of().
  std::optional<double> exposed_area(const PreviewState& state, const ShownMolecule& molecule, std::uint32_t atom,
                                     bool wait, bool wanted);
  /// Returns true if a later call of exposed_area() may find more.
  bool computes_areas() const { return areas_.computing(); }

  /// Returns the size of the last picture's molecule, without the legend.
  glm::ivec2 molecule_size() const { return shows_balls() ? balls_.size : renderer_->size(); }
  double grown_by() const { return renderer_->grown_by(); }
  double milliseconds() const { return milliseconds_; }
  /// Returns the stages of the last picture that was not a draft; stages of drafts are not measured.
  const std::vector<StageTime>& stages() const { return stages_; }

 private:
  /// A picture of atoms without their surface: 8 bit sRGB and alpha.
  struct BallPicture {
    glm::ivec2 size{0};
    std::vector<std::uint8_t> rgba;
  };

  bool shows_balls() const { return !balls_.rgba.empty(); }

  /// The state and quality of the last picture.
  struct Drawn {
    std::uint64_t revision = 0;  ///< revision of the drawn state; 0 before the first picture
    Quality quality = Quality::draft;
    std::shared_ptr<const LegendStrip> legend;
  };

  std::unique_ptr<PreviewRenderer> renderer_;
  ExposedAreas areas_;
  Drawn drawn_;
  BallPicture balls_;         ///< the last picture, if its quality is Quality::balls
  bool has_surface_ = false;  ///< true after a picture has shown a surface
  double milliseconds_ = 0.0;
  std::vector<StageTime> stages_;
};

/// Packs the figure of a state as `meniscus export page` packs the same scene, and keeps the complete surface, which
/// depends on the atoms and the probe alone. Used by one thread.
class FigureTables {
 public:
  /// Returns the frame, packed plainly, with the colours of the figure and no others. stop: called before each stage of
  /// a surface and after the last one; if it returns true, the figure is given up and the result is nullptr. Throws
  /// RequestError with a plain sentence if pages cannot show the figure, and OpenSurfaceError and CapacityError.
  std::shared_ptr<const page::PackedFrame> packed(const PreviewState& state, const ShownMolecule& molecule,
                                                  const std::function<bool()>& stop);

 private:
  bool compute(const PreviewState& state, const ShownMolecule& molecule, const std::function<bool()>& stop);
  void color(const Structure& structure, const PreviewState& state, const ShownMolecule& molecule);

  std::vector<Ball> balls_;  ///< balls of the surface
  SurfaceObject object_;     ///< the surface of the last figure that had one, with its colours
};

}  // namespace meniscus
