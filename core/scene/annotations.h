// SPDX-License-Identifier: BSD-3-Clause
// The annotations of a scene: its legend, a panel letter, a scale bar, labels, the time.
#pragma once

#include "core/render/annotation.h"
#include "core/render/legend.h"
#include "core/structure/selection/selection.h"
#include "core/structure/structure.h"

namespace meniscus {

/// A text next to the middle of some atoms.
struct LabelRequest {
  Selection atoms;
  std::string text;
};

struct LegendRequest {
  bool within = false;  ///< true if the legend is drawn within the picture
  std::string file;     ///< path of a file with the legend alone; empty: none
  LegendStyle style;

  bool is_requested() const { return within || !file.empty(); }
};

/// The requested texts and marks of a picture, except for the legend.
struct AnnotationRequest {
  std::string panel, title;  ///< the letter of a panel, and a title; empty: none
  bool scale_bar = false, time_stamp = false;
  std::optional<double> bar_length;  ///< Å; empty: chosen automatically
  std::vector<LabelRequest> labels;
  bool hides_lengths = false;       ///< true: dashed lines have no lengths
  std::string curve, curve_column;  ///< path of the file and name of a column; empty: no curve, the first column
  LetterStyle letters;
};

/// Returns the style of a legend in a picture whose letters have this style.
LegendStyle legend_style(const LegendStyle& requested, const LetterStyle& letters);

/// Returns the contents of the strips above and below the molecule, in pictures of a run or of one molecule.
StripContents strip_contents(const AnnotationRequest& request, bool is_run);

/// Reads "auto" or a length in Å into the request. Throws RequestError.
void parse_scale_bar(const std::string& text, AnnotationRequest& request);
/// Reads "EXPR=TEXT", divided where the selection ends (selection_and_text). Throws RequestError, SelectionError.
LabelRequest parse_label(std::string_view text);

/// Returns the numbers of the curve for frames of a run, which are given by their numbers in the trajectory. Returns
/// nothing if there is no curve. Throws InputError.
std::optional<Curve> curve_of(const AnnotationRequest& request, std::span<const std::uint64_t> frames);

/// Returns the texts and marks in a picture of the structure, without the time. `lengths` are the labels of its
/// dashed lines; they follow the requested labels. Throws InputError for a label that selects no atoms.
Annotations annotations_of(const AnnotationRequest& request, const Structure& structure,
                           std::span<const PlaceLabel> lengths = {});

/// Returns the time of a frame as text, or its number if the trajectory has no times. longest: the longest time of the
/// run, ps, which sets the unit: ps below 1 ns, ns below 1 µs, else µs.
std::string time_text(const std::optional<double>& picoseconds, std::uint64_t frame, double longest);

}  // namespace meniscus
