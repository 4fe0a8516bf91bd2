// SPDX-License-Identifier: BSD-3-Clause
// The molecule as a state of the preview shows it: the atoms of a frame, their colours, the shapes beside them; and the
// legend, laid out once for a size.
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
  /// Throws as Legend does.
  LegendStrip(const ColorKey& key, glm::ivec2 size, const LegendStyle& style, const glm::vec3& background);

  /// Pixels left for the molecule, at the top left.
  glm::ivec2 molecule_size() const { return molecule_size_; }

  /// The whole picture: 8 bit sRGB and alpha per pixel, rows from the top. molecule: of molecule_size(), or of half of
  /// it in both directions; then the picture is half as large, too.
  std::vector<std::uint8_t> around(std::span<const std::uint8_t> molecule, glm::ivec2 size) const;
  /// Of the picture around a molecule of this size.
  glm::ivec2 whole_size(glm::ivec2 size) const;

 private:
  glm::ivec2 size_, molecule_size_;
  std::vector<std::uint8_t> picture_;  ///< of size_, without a molecule
};

/// Where atoms are at the frames of a trajectory.
struct TrajectoryPositions {
  std::vector<std::uint64_t> numbers;  ///< of the frames in the trajectory; at least one
  /// Å, one per atom of the structure. Throws InputError for a frame that cannot be read.
  std::function<std::vector<glm::dvec3>(std::size_t frame)> positions;
  /// Instead of positions, where frames have other atoms each; else empty. Likewise.
  std::function<Structure(std::size_t frame)> structure{};
};

/// Reads the molecule again as it is at a frame, with the atoms that are drawn beside its surface
/// (FigureRequest::mark_atoms); so they are those that `meniscus render` would draw. Throws InputError.
using ReadShown = std::function<Structure(const FigureRequest& figure, std::size_t frame)>;

/// What another state needs to have made again, from the least to the most; each includes those before it.
enum class Renewal {
  nothing,  ///< only the camera, or what no picture shows
  legend,
  cuts,
  colors,
  shapes,  ///< what is drawn beside the surface
  frame    ///< all of it, for other atoms
};

/// Each model of the structure, which has atoms, is a frame; with a trajectory these are the frames of its one model.
class ShownMolecule {
 public:
  /// At the frame of the state. Throws InputError for a frame that cannot be read, and as color_atoms does.
  ShownMolecule(Structure structure, std::optional<TrajectoryPositions> trajectory, ReadShown read_shown,
                const PreviewState& state);

  /// Becomes that of another state; true if the balls of the surface are others. If this throws, nothing has changed.
  bool become(const PreviewState& state, Renewal renewal);

  const Structure& structure() const { return structure_; }
  bool has_trajectory() const { return trajectory_.has_value(); }
  std::size_t frame_count() const { return trajectory_ ? trajectory_->numbers.size() : models_.size(); }
  bool has_models() const { return models_.size() > 1; }
  /// Returns the number of the model that a frame shows, as the file has it. There must be no trajectory.
  std::int32_t model_of(std::size_t frame) const { return structure_.atoms[models_[frame].atoms.front()].model; }
  /// Of a frame, as its trajectory counts.
  std::uint64_t number_of(std::size_t frame) const { return trajectory_ ? trajectory_->numbers[frame] : frame; }

  /// Of the frame, into structure().atoms.
  const std::vector<std::uint32_t>& atoms() const { return models_[trajectory_ ? 0 : frame_].atoms; }
  /// Theirs, grown by growth_of() the kind of surface.
  const std::vector<Ball>& balls() const { return balls_; }
  /// The same, or what cameras see of all copies.
  const std::vector<Ball>& framing_balls() const { return framing_balls_.empty() ? balls_ : framing_balls_; }
  /// Their colours, and which of them are hidden.
  Coloring coloring(const PreviewFigure& figure) const;
  /// Which of them have a patch that the figure outlines: empty if it outlines none. Of areas with a least one the
  /// complete surface is computed for it, on the CPU. Throws OpenSurfaceError, CapacityError.
  std::vector<bool> patch_marks(const PreviewFigure& figure) const;
  /// The atoms of the frame alone.
  Structure frame_structure() const;
  /// What pictures of it are annotated by: the same with the atoms beside its surface, if there are any.
  Structure annotated_structure() const { return marked_ ? *marked_ : frame_structure(); }

  /// Beside the surface; nullptr: nothing.
  const std::shared_ptr<const FigureExtras>& extras() const { return extras_; }
  /// An atom of a picture, of which those beside the surface come last.
  const Atom& atom_in_view(std::uint32_t atom) const;
  std::vector<Atom> atoms_in_view() const;

  /// What the figure's colours mean, of all models.
  ColorKey key(const PreviewFigure& figure) const;
  /// nullptr: none.
  const std::shared_ptr<const LegendStrip>& legend() const { return legend_; }
  /// Why there is none though it is wanted; else empty.
  const std::string& legend_fault() const { return legend_fault_; }
  /// Pixels that the legend leaves for the molecule.
  glm::ivec2 picture_size(const PreviewState& state) const { return legend_ ? legend_->molecule_size() : state.size; }
  /// Width of these / their height.
  double aspect(const PreviewState& state) const;

  /// A camera that shows everything, all frames of a trajectory too. What is beside the surface does not turn it.
  Camera overview(const PreviewState& state) const;
  /// How many atoms of the surface the figure shows. Throws RequestError if it is none.
  std::size_t count_shown(const PreviewFigure& figure) const;
  /// The planes of the figure's cuts, at this frame. Throws RequestError for a cut by atoms that selects none.
  std::vector<ClipPlane> planes(const PreviewFigure& figure) const;
  /// Of cuts of the surface: a sentence for each that cuts nothing or leaves nothing.
  std::vector<std::string> ineffective_among(std::span<const Cut> cuts, const PreviewFigure& figure) const;

 private:
  /// What of a figure is made of its molecule.
  struct Made {
    std::optional<Coloring> coloring;         ///< of all atoms of the structure; nothing: as it is
    std::shared_ptr<const Structure> marked;  ///< the frame with the atoms beside its surface; nullptr: none are drawn
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
  std::vector<Ball> sampled_;  ///< of frames all over the trajectory, for a view of all
  std::size_t frame_ = 0;
  double growth_ = 0.0;  ///< of balls_, Å
  std::vector<Ball> balls_, framing_balls_;
  Coloring coloring_;  ///< of all atoms of the structure
  std::shared_ptr<const Structure> marked_;
  std::shared_ptr<const FigureExtras> extras_;
  std::shared_ptr<const LegendStrip> legend_;
  std::string legend_fault_;
};

/// The camera keys of a state, by the numbers of their frames.
std::vector<CameraKey> camera_keys(const ShownMolecule& molecule, const PreviewState& state);

/// Those of the surface's atoms, and around what is drawn beside them.
std::vector<Ball> balls_in_view(const ShownMolecule& molecule);

/// Throws InputError if a probe would touch two copies that are to be apart. reach: with which none does, Å.
void require_copies_apart(const Structure& structure, const PreviewState& state, double reach);

}  // namespace meniscus
