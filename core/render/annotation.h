// SPDX-License-Identifier: BSD-3-Clause
// Annotations of a finished picture: the panel's letter, a title, a scale bar, labels, a curve, and the time of a
// frame.
#pragma once

#include "core/render/lettering.h"
#include "core/render/picture.h"

namespace meniscus {

struct Camera;

/// A text that names a place, and the point that its line leads to; or the length of a dashed line, which is written
/// next to the line's middle, without a mark.
struct PlaceLabel {
  std::string text;
  glm::dvec3 position{0.0};  ///< Å
  bool is_hidden = false;    ///< true if something hides the place: its mark is hollow, or a length is not written
  glm::dvec3 along{0.0};     ///< for a length: vector from the line's middle to its end, Å; 0 for others

  bool is_length() const { return along != glm::dvec3(0.0); }
};

/// A curve of numbers, one for each frame of a run.
struct Curve {
  std::string title;           ///< name and unit of the numbers
  std::vector<double> values;  ///< one finite number per frame, in order; at least one
  std::size_t now = 0;         ///< index of the frame that this picture shows
};

/// The texts and marks of a picture. Texts are drawn as they are given, so they must come from the user and never from
/// a molecule file. Empty texts are not drawn.
struct Annotations {
  std::string panel;                 ///< letter at the top left
  std::string title;                 ///< title at the top, in the middle
  std::string time;                  ///< time at the top right
  bool scale_bar = false;            ///< true: there is a scale bar at the bottom left
  std::optional<double> bar_length;  ///< Å, > 0; nothing: a round number, at most a quarter of the picture's width
  std::vector<PlaceLabel> labels;
  bool labels_must_fit = true;  ///< false: labels are left out of a picture without room for them
  std::optional<Curve>
      curve;  ///< curve at the bottom right, a third of the picture's width; faint after `now`, which has a mark
  std::vector<glm::vec4> atoms;  ///< centres and radii of the atoms, Å, which labels avoid where possible
  LetterStyle letters;

  bool any() const {
    return !panel.empty() || !title.empty() || !time.empty() || scale_bar || !labels.empty() || curve;
  }
};

/// Returns the distance in Å between neighbouring pixels. It is constant for an orthographic camera; for a perspective
/// camera it is the distance at the target.
double angstroms_per_pixel(const Camera& camera, glm::ivec2 size);

/// Returns the pixel, counted from the top left, that shows a point; nothing if the point is behind a perspective
/// camera.
std::optional<glm::dvec2> place_in_picture(const Camera& camera, glm::ivec2 size, const glm::dvec3& point);

/// Returns the largest of 1, 2 and 5 times a power of ten that is at most `most`, > 0.
double round_length(double most);

/// The numbers of rows above and below the molecule that are reserved for texts.
struct Strips {
  int top = 0, bottom = 0;
};

/// The annotations that need such rows: the letter of the panel, the title and the time above the molecule, and the
/// curve below it.
struct StripContents {
  bool panel = false, title = false, time = false, curve = false;
};

/// Returns the strips of a picture of this size (without its legend). If they would take more than half of it, both are
/// 0, and texts are written over the molecule.
Strips strips_for(const StripContents& contents, const LetterStyle& letters, glm::ivec2 size);
StripContents strip_contents(const Annotations& annotations);

/// Strokes that belong together: the stroke of index `first` and the following ones, up to the next group.
struct StrokeGroup {
  std::string_view name;
  std::size_t first;
};

/// The annotations of a picture that `camera` made of a molecule, and of the strips around it. Unless the style sets
/// their heights, letters are 1/25 of the picture's shorter side, and the panel's letter is larger. Letters are dark or
/// light, depending on the background, and dark without a background. They have a rim where the molecule is behind
/// them.
class AnnotationLayer {
 public:
  /// Places everything in a picture of this size, which includes the strips. Throws RequestError if there is no font,
  /// if the bar or the title is longer than the picture, or if labels must fit and cannot be placed without overlaps
  /// and crossings.
  AnnotationLayer(const Annotations& annotations, const Camera& camera, glm::ivec2 picture_size,
                  const std::optional<glm::vec3>& background, const Strips& strips = {});

  /// Draws the annotations' part of some whole rows of the picture. first_row: number of the first row in the picture.
  void lay_over(Framebuffer& rows, int first_row) const;

  /// Makes the marks of hidden labels hollow, and removes hidden lengths. labels: the constructor's labels, with
  /// is_hidden set.
  void hollow(std::span<const PlaceLabel> labels);

  /// True if there are labels but no room for them.
  bool lacks_labels() const { return lacks_labels_; }

  /// Returns all strokes, in pixels of the picture; their colours, sRGB; and the width of the rim.
  std::span<const InkStroke> strokes() const { return strokes_; }
  /// Returns the name of the group that the stroke of this index belongs to: "title", "labels" and so on.
  std::string_view group_of(std::size_t stroke) const;
  const Font& font_of(const InkText& text) const { return fonts_.of(text); }
  const Inks& inks() const { return inks_; }
  int rim_width() const { return rim_width_; }

 private:
  std::vector<InkStroke> strokes_;
  std::vector<StrokeGroup> groups_;
  /// The index of each label's mark, which is the stroke after its line, or of a length; the greatest number if there
  /// is none.
  std::vector<std::size_t> marks_;
  Inks inks_;
  int height_, rim_width_ = 1;
  bool lacks_labels_ = false;
  mutable FontShelf fonts_;
};

/// Annotates a whole picture. Returns false if labels that need not fit were left out because there is no room.
bool annotate(Framebuffer& picture, const Annotations& annotations, const Camera& camera,
              const std::optional<glm::vec3>& background, const Strips& strips = {});

}  // namespace meniscus
