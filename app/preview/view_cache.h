// SPDX-License-Identifier: BSD-3-Clause
// From a state to its picture: the last one is kept, and surfaces while only looks change.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include <glm/vec2.hpp>

#include "app/preview/exposed_areas.h"
#include "app/preview/shown_molecule.h"
#include "core/scene/view_renderer.h"

namespace meniscus {

/// A picture while something moves, or at rest.
enum class Quality {
  draft,  ///< half the size, one ray a pixel, no effects
  plain,  ///< the same in full size
  full    ///< as exported
};

/// Every function gets the state that is shown and its molecule; states are told apart by their revisions.
class ViewCache {
 public:
  explicit ViewCache(std::unique_ptr<ViewRenderer> renderer) : renderer_(std::move(renderer)) {}

  /// Hands the renderer what another state has made anew. moves: the balls of the surface too.
  void take(const PreviewState& state, const ShownMolecule& molecule, Renewal renewal, bool moves);

  /// Draws, unless this very picture is there already. stop: asked now and then; if true, the picture is given up:
  /// false, and the last one stays. Throws GpuError, CapacityError, OpenSurfaceError; but for the first of them the
  /// cache can go on.
  bool draw(const PreviewState& state, const ShownMolecule& molecule, Quality quality,
            const std::function<bool()>& stop = {});
  /// Is the last picture what draw() would draw?
  bool is_drawn(const PreviewState& state, Quality quality) const {
    return drawn_.revision == state.revision && drawn_.quality == quality;
  }

  /// The last picture with its legend; see ViewRenderer::draw().
  std::vector<std::uint8_t> rgba() const;
  /// Of GL; 0: the picture is rgba() alone.
  std::uint32_t texture() const { return drawn_.legend ? 0 : renderer_->texture(); }
  glm::ivec2 size() const;
  bool draws_on_cpu() const { return renderer_->draws_on_cpu(); }

  /// What a pixel of the picture at rest shows, drawn anew if need be.
  std::optional<PickedPoint> pick(const PreviewState& state, const ShownMolecule& molecule, glm::ivec2 pixel);

  /// Å², of an atom of the surface: see ExposedAreas::of(). wanted: else only if it is known or cheap.
  std::optional<double> exposed_area(const PreviewState& state, const ShownMolecule& molecule, std::uint32_t atom,
                                     bool wait, bool wanted);
  /// Whether asking again will tell more.
  bool computes_areas() const { return areas_.computing(); }

  /// Of the last picture's molecule, without the legend.
  glm::ivec2 molecule_size() const { return renderer_->size(); }
  double milliseconds() const { return milliseconds_; }
  /// Of the last picture that was no draft: nobody waits for the stages of those.
  const std::vector<StageTime>& stages() const { return stages_; }

 private:
  /// What the last picture shows.
  struct Drawn {
    std::uint64_t revision = 0;  ///< 0: of no state
    Quality quality = Quality::draft;
    std::shared_ptr<const LegendStrip> legend;
  };

  std::unique_ptr<ViewRenderer> renderer_;
  ExposedAreas areas_;
  Drawn drawn_;
  double milliseconds_ = 0.0;
  std::vector<StageTime> stages_;
};

}  // namespace meniscus
