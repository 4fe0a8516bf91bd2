// SPDX-License-Identifier: BSD-3-Clause
// Makes the picture of a state, or the tables from which a page casts it. The cache keeps the last picture, surfaces
// while only looks change, and areas once they are known.
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

/// Whose areas are asked for.
struct AtomsInView {
  std::size_t frame = 0;
  std::size_t group = 0;  ///< of several that have surfaces of their own
  SurfaceKind kind = SurfaceKind::ses;
  double probe_radius = 0.0;               ///< Å
  const std::vector<Ball>& balls;          ///< grown by growth_of() the kind
  std::shared_ptr<const Surface> surface;  ///< theirs, complete, if someone has it already
};

/// Exact areas per frame, kind of surface and probe radius, from the complete surface on the CPU in a thread of its
/// own. One is computed at a time; the latest few are kept.
class ExposedAreas {
 public:
  /// Area of the points that take the atom's colour, Å² (AtomAreas::surface). If it is not known yet it is computed:
  /// with `wait` before this returns, else nothing comes back and a later call finds it. If `wanted` is false, an area
  /// is only computed if that is cheap because the surface is there. Throws OpenSurfaceError, CapacityError.
  std::optional<double> of(const AtomsInView& atoms, std::size_t atom, bool wait, bool wanted);
  /// Whether some are being computed, so that asking again will tell more.
  bool computing() const { return pending_.valid(); }

 private:
  using Key = std::tuple<std::size_t, std::size_t, SurfaceKind, double>;
  using Areas = std::vector<double>;

  void keep();

  std::map<Key, Areas> known_;
  std::vector<Key> order_;  ///< of known_, oldest first
  Key pending_key_{};
  std::future<Areas> pending_;
};

/// A picture while something moves, or at rest.
enum class Quality {
  balls,  ///< atoms alone, at once, while their first surface is computed
  draft,  ///< half the size, one ray a pixel, no effects
  plain,  ///< the same in full size
  full    ///< as exported
};

/// Every function gets the state that is shown and its molecule; states are distinguished by their revisions.
class ViewCache {
 public:
  explicit ViewCache(std::unique_ptr<PreviewRenderer> renderer) : renderer_(std::move(renderer)) {}

  /// Hands the renderer what another state has made again. moves: the balls of the surface too.
  void take(const PreviewState& state, const ShownMolecule& molecule, Renewal renewal, bool moves);

  /// Draws, unless this very picture is there already. stop: asked now and then; if true, the picture is given up:
  /// false, and the last one stays. Throws GpuError, CapacityError, OpenSurfaceError; but for the first of them the
  /// cache can go on.
  bool draw(const PreviewState& state, const ShownMolecule& molecule, Quality quality,
            const std::function<bool()>& stop = {});
  /// Is the last picture what draw() would draw?
  bool is_drawn(const PreviewState& state, Quality quality) const {
    return is_drawn(state) && drawn_.quality == quality;
  }
  /// True if the last picture shows the state, in whatever quality.
  bool is_drawn(const PreviewState& state) const { return drawn_.revision == state.revision; }

  /// Whether the first surface takes so long that there should be something to see before.
  bool wants_balls(const PreviewState& state, const ShownMolecule& molecule) const;

  /// The last picture with its legend; see PreviewRenderer::draw().
  std::vector<std::uint8_t> rgba() const;
  glm::ivec2 size() const;
  bool draws_on_cpu() const { return renderer_->draws_on_cpu(); }

  /// What a pixel of the picture at rest shows, drawn again if need be.
  std::optional<PickedPoint> pick(const PreviewState& state, const ShownMolecule& molecule, glm::ivec2 pixel);

  /// Å², of an atom of the surface: see ExposedAreas::of(). wanted: else only if it is known or cheap.
  std::optional<double> exposed_area(const PreviewState& state, const ShownMolecule& molecule, std::uint32_t atom,
                                     bool wait, bool wanted);
  /// Whether asking again will tell more.
  bool computes_areas() const { return areas_.computing(); }

  /// Of the last picture's molecule, without the legend.
  glm::ivec2 molecule_size() const { return shows_balls() ? balls_.size : renderer_->size(); }
  double grown_by() const { return renderer_->grown_by(); }
  double milliseconds() const { return milliseconds_; }
  /// Of the last picture that was not a draft; stages of drafts are not measured.
  const std::vector<StageTime>& stages() const { return stages_; }

 private:
  /// Atoms without their surface: 8 bit sRGB and alpha.
  struct BallPicture {
    glm::ivec2 size{0};
    std::vector<std::uint8_t> rgba;
  };

  bool shows_balls() const { return !balls_.rgba.empty(); }

  /// What the last picture shows.
  struct Drawn {
    std::uint64_t revision = 0;  ///< 0: of no state
    Quality quality = Quality::draft;
    std::shared_ptr<const LegendStrip> legend;
  };

  std::unique_ptr<PreviewRenderer> renderer_;
  ExposedAreas areas_;
  Drawn drawn_;
  BallPicture balls_;         ///< the last picture, if it is of this quality
  bool has_surface_ = false;  ///< some picture showed one
  double milliseconds_ = 0.0;
  std::vector<StageTime> stages_;
};

/// Packs what a state shows as `meniscus export page` packs the same scene, and keeps the complete surface, which
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

  std::vector<Ball> balls_;  ///< of the surface
  SurfaceObject object_;     ///< the surface of the last figure that had one, with its colours
};

}  // namespace meniscus
