// SPDX-License-Identifier: BSD-3-Clause
// Annotations of a finished picture: the panel's letter, a scale bar, labels, the time of a frame.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "core/render/lettering.h"
#include "core/render/picture.h"

namespace meniscus {

struct Camera;

/// A name, beside the place that a line leads to.
struct PlaceLabel {
  std::string text;
  glm::dvec3 position{0.0};  ///< Å
  bool is_hidden = false;    ///< behind what the picture shows: its mark is hollow
};

/// Numbers of a run of frames, one of which this picture is.
struct Curve {
  std::string title;           ///< what they are, and their unit
  std::vector<double> values;  ///< of the frames in their order, at least one, finite
  std::size_t now = 0;         ///< whose is this picture's
};

/// Texts are drawn as they are given, so they are the user's and never a molecule file's; empty ones are not drawn.
struct Annotations {
  std::string panel;                 ///< at the top left
  std::string title;                 ///< at the top, in the middle
  std::string time;                  ///< at the top right
  bool scale_bar = false;            ///< at the bottom left
  std::optional<double> bar_length;  ///< Å, > 0; nothing: a round number, at most a quarter of what the picture shows
  std::vector<PlaceLabel> labels;
  bool labels_must_fit = true;  ///< else they are left out of a picture that has no room for them
  std::optional<Curve>
      curve;  ///< at the bottom right, a third of the picture wide: faint from now on, with a mark at now
  std::vector<glm::vec4> atoms;  ///< their centres and radii, Å; labels keep clear of them where they can
  LetterStyle letters;

  bool any() const {
    return !panel.empty() || !title.empty() || !time.empty() || scale_bar || !labels.empty() || curve;
  }
};

/// Å between two pixels of a picture: of an orthographic camera everywhere, of a perspective one where it looks at.
double angstroms_per_pixel(const Camera& camera, glm::ivec2 size);

/// The pixel that shows a point, from the top left of the picture; nothing if it is not before a perspective camera.
std::optional<glm::dvec2> place_in_picture(const Camera& camera, glm::ivec2 size, const glm::dvec3& point);

/// The largest of 1, 2 and 5 times a power of ten that is not above `most`, > 0.
double round_length(double most);

/// Rows above and below the molecule that are kept for what is written there.
struct Strips {
  int top = 0, bottom = 0;
};

/// What needs such rows: the letter of a panel, the title and the time above the molecule, a curve below it.
struct StripContents {
  bool panel = false, title = false, time = false, curve = false;
};

/// For a picture of this size, without its legend. None where they would take more than half of it: then what they are
/// for is written over the molecule.
Strips strips_for(const StripContents& contents, const LetterStyle& letters, glm::ivec2 size);
StripContents strip_contents(const Annotations& annotations);

/// What is to be written into a picture of the molecule, which `camera` made, and into the strips around it. Unless
/// the style says otherwise letters are a twenty-fifth of its shorter side high, that of the panel more. They are dark
/// or light as the background needs, dark where there is none, and have a rim where the molecule is behind them.
class AnnotationLayer {
 public:
  /// picture_size: with the strips. Throws RequestError when there is no font, the bar or the title is longer than the
  /// picture, or labels that must fit have no room in which they neither overlap nor cross.
  AnnotationLayer(const Annotations& annotations, const Camera& camera, glm::ivec2 picture_size,
                  const std::optional<glm::vec3>& background, const Strips& strips = {});

  /// Writes into some whole rows of the picture, of which `first_row` is the first: as into the whole picture.
  void lay_over(Framebuffer& rows, int first_row) const;

  /// Makes the marks of hidden labels hollow. labels: those of the constructor.
  void hollow(std::span<const PlaceLabel> labels);

  /// Are there labels, and no room for them?
  bool lacks_labels() const { return lacks_labels_; }

  /// All of it, in pixels of the picture; its colours, sRGB; and how far the rim reaches.
  std::span<const InkStroke> strokes() const { return strokes_; }
  const Inks& inks() const { return inks_; }
  int rim_width() const { return rim_width_; }

 private:
  std::vector<InkStroke> strokes_;
  std::vector<std::size_t> marks_;  ///< of each label its mark, which is a stroke after its line; 0: it is not shown
  Inks inks_;
  int height_, rim_width_ = 1;
  bool lacks_labels_ = false;
  mutable FontShelf fonts_;
};

/// Writes into a whole picture. False: without its labels, which need not fit and have no room.
bool annotate(Framebuffer& picture, const Annotations& annotations, const Camera& camera,
              const std::optional<glm::vec3>& background, const Strips& strips = {});

}  // namespace meniscus
