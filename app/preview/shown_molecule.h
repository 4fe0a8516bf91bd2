// SPDX-License-Identifier: BSD-3-Clause
// The molecule as a state of the preview shows it: the atoms of a frame, their colours, the shapes next to them, and
// the legend, laid out once for a size.
#pragma once

#include "app/preview/preview_state.h"
#include "core/camera/camera.h"
#include "core/color/coloring.h"
#include "core/render/legend.h"
#include "core/scene/figure.h"
#include "core/structure/structure.h"

namespace meniscus {

class LegendStrip {
 public:
  /// Lays the legend out. Throws the errors of Legend.
  LegendStrip(const ColorKey& key, glm::ivec2 size, const LegendStyle& style, const glm::vec3& background);

  /// Returns the size in pixels that is left for the molecule, at the top left.
  glm::ivec2 molecule_size() const { return molecule_size_; }

  /// Returns the whole picture: 8 bit sRGB and alpha per pixel, rows from the top. molecule: its picture of
  /// molecule_size(), or half as large in both directions, which makes the whole picture half as large.
  std::vector<std::uint8_t> around(std::span<const std::uint8_t> molecule, glm::ivec2 size) const;
  /// Returns the size of the whole picture around a picture of the molecule of this size.
  glm::ivec2 whole_size(glm::ivec2 size) const;

 private:
  glm::ivec2 size_, molecule_size_;
  std::vector<std::uint8_t> picture_;  ///< the legend in an image of size_, without a molecule
};

/// The positions of atoms at the frames of a trajectory.
struct TrajectoryPositions {
  std::vector<std::uint64_t> numbers;  ///< the frames' numbers in the trajectory; at least one
  /// Returns the position of each atom of the structure in Å. Throws InputError for a frame that cannot be read.
  std::function<std::vector<glm::dvec3>(std::size_t frame)> positions;
  /// Replaces positions if each frame has other atoms; else empty. Throws InputError for a frame that cannot be read.
  std::function<Structure(std::size_t frame)> structure{};
};

/// Reads the molecule again as it is at a frame, with the atoms that are drawn next to its surface
/// (FigureRequest::mark_atoms); `meniscus render` draws the same atoms. Throws InputError.
using ReadShown = std::function<Structure(const FigureRequest& figure, std::size_t frame)>;

/// The parts that another state needs to have made again, from the least to the most; each includes those before it.
enum class Renewal {
  nothing,  ///< only the camera changes, or nothing that a picture shows
  legend,
  cuts,
  colors,
  shapes,  ///< the shapes next to the surface
  frame    ///< everything, for other atoms
};

/// A structure whose models are its frames; with a trajectory, its only model has the trajectory's frames.
class ShownMolecule {
 public:
  /// Shows the frame of the state. Throws InputError for a frame that cannot be read, and the errors of color_atoms.
  ShownMolecule(Structure structure, std::optional<TrajectoryPositions> trajectory, ReadShown read_shown,
                const PreviewState& state);

  /// Takes another state; returns true if the balls of the surface change. If this throws, nothing has changed.
  bool become(const PreviewState& state, Renewal renewal);

  const Structure& structure() const { return structure_; }
  bool has_trajectory() const { return trajectory_.has_value(); }
  std::size_t frame_count() const { return trajectory_ ? trajectory_->numbers.size() : models_.size(); }
  bool has_models() const { return models_.size() > 1; }
  /// Returns the number of the model that a frame shows, as the file has it. There must be no trajectory.
  std::int32_t model_of(std::size_t frame) const { return structure_.atoms[models_[frame].atoms.front()].model; }
  /// Returns the index of a frame as its trajectory counts it.
  std::uint64_t number_of(std::size_t frame) const { return trajectory_ ? trajectory_->numbers[frame] : frame; }

  /// Returns the atoms of the frame, as indices into structure().atoms.
  const std::vector<std::uint32_t>& atoms() const { return models_[trajectory_ ? 0 : frame_].atoms; }
  /// Returns the balls of atoms(), grown by growth_of() the kind of surface.
  const std::vector<Ball>& balls() const { return balls_; }
  /// Returns the balls that a camera must show: the balls of the farthest copies, or balls() without copies.
  const std::vector<Ball>& framing_balls() const { return framing_balls_.empty() ? balls_ : framing_balls_; }
  /// Returns the colours of atoms(), and which of them are hidden.
  Coloring coloring(const PreviewFigure& figure) const;
  /// Returns which of atoms() have a patch that the figure outlines; empty if it outlines none. A least area of patches
  /// makes this compute the complete surface on the CPU. Throws OpenSurfaceError, CapacityError.
  std::vector<bool> patch_marks(const PreviewFigure& figure) const;
  /// Returns the atoms of the frame alone.
  Structure frame_structure() const;
  /// Returns the structure that annotates pictures: the frame with the atoms next to its surface, if any.
  Structure annotated_structure() const { return marked_ ? *marked_ : frame_structure(); }

  /// Returns the objects next to the surface; nullptr if there are none.
  const std::shared_ptr<const FigureExtras>& extras() const { return extras_; }
  /// Returns an atom of the picture; atoms next to the surface have the last indices.
  const Atom& atom_in_view(std::uint32_t atom) const;
  std::vector<Atom> atoms_in_view() const;

  /// Returns what the figure's colours mean, in all models.
  ColorKey key(const PreviewFigure& figure) const;
  /// Returns the legend; nullptr if there is none.
  const std::shared_ptr<const LegendStrip>& legend() const { return legend_; }
  /// Returns why a legend that is wanted cannot be shown; else empty.
  const std::string& legend_fault() const { return legend_fault_; }
  /// Returns the size in pixels that the legend leaves for the molecule.
  glm::ivec2 picture_size(const PreviewState& state) const { return legend_ ? legend_->molecule_size() : state.size; }
  /// Returns width / height of picture_size().
  double aspect(const PreviewState& state) const;

  /// Returns a camera that shows everything, in all frames of a trajectory. Objects next to the surface do not turn it.
  Camera overview(const PreviewState& state) const;
  /// Returns how many atoms of the surface the figure shows. Throws RequestError if there are none.
  std::size_t count_shown(const PreviewFigure& figure) const;
  /// Returns the planes of the figure's cuts at this frame. Throws RequestError for a cut by atoms that selects none.
  std::vector<ClipPlane> planes(const PreviewFigure& figure) const;
  /// Returns a sentence for each cut of the surface that cuts nothing or leaves nothing.
  std::vector<std::string> ineffective_among(std::span<const Cut> cuts, const PreviewFigure& figure) const;

 private:
  /// The parts of a figure that are made from its molecule.
  struct Made {
    std::optional<Coloring> coloring;         ///< colours of all atoms of the structure; nothing: unchanged
    std::shared_ptr<const Structure> marked;  ///< the frame with the atoms next to its surface; nullptr: none are drawn
    std::shared_ptr<const FigureExtras> extras;
  };

  Made made_at(const PreviewState& state);
  Made made(const PreviewFigure& figure, Renewal renewal, std::size_t frame) const;
  std::vector<bool> part_shown(const PreviewFigure& figure, const Structure* marked) const;
  void place_balls(const PreviewFigure& figure);
  void lay_out_legend(const PreviewState& state);

  Structure structure_;
  std::vector<AtomGroup> models_;
  std::optional<TrajectoryPositions> trajectory_;
  ReadShown read_shown_;
  std::vector<Ball> sampled_;  ///< balls of frames all over the trajectory, for a camera that shows all
  std::size_t frame_ = 0;
  double growth_ = 0.0;  ///< growth of balls_ in Å
  std::vector<Ball> balls_, framing_balls_;
  Coloring coloring_;  ///< colours of all atoms of the structure
  std::shared_ptr<const Structure> marked_;
  std::shared_ptr<const FigureExtras> extras_;
  std::shared_ptr<const LegendStrip> legend_;
  std::string legend_fault_;
};

/// Returns the camera keys of a state, by the numbers of their frames.
std::vector<CameraKey> camera_keys(const ShownMolecule& molecule, const PreviewState& state);

/// Returns the balls of the surface's atoms, and balls around the objects next to the surface.
std::vector<Ball> balls_in_view(const ShownMolecule& molecule);

/// Throws InputError if a probe would touch two copies that must be apart. reach: least distance without contact, Å.
void require_copies_apart(const Structure& structure, const PreviewState& state, double reach);

}  // namespace meniscus
