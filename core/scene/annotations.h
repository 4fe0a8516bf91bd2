// SPDX-License-Identifier: BSD-3-Clause
// The annotations that a scene asks for: its legend, a panel's letter, a scale bar, labels, the time.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/render/annotation.h"
#include "core/render/legend.h"
#include "core/structure/selection/selection.h"
#include "core/structure/structure.h"

namespace meniscus {

/// Text beside the middle of some atoms.
struct LabelRequest {
  Selection atoms;
  std::string text;
};

struct LegendRequest {
  bool within = false;  ///< the picture
  std::string file;     ///< alone, there; or empty
  LegendStyle style;

  bool asked() const { return within || !file.empty(); }
};

struct AnnotationRequest {
  std::string panel, title;
  bool scale_bar = false, time_stamp = false;
  std::optional<double> bar_length;  ///< Å
  std::vector<LabelRequest> labels;
  std::string curve, curve_column;  ///< the file and a name in it; empty: none, the first
  LetterStyle letters;
};

/// The style of a legend whose picture has these letters.
LegendStyle legend_style(const LegendStyle& asked, const LetterStyle& letters);

/// What is above and below the molecule in pictures of a run, or of one molecule.
StripContents strip_contents(const AnnotationRequest& request, bool is_run);

/// "auto" or a length in Å. Throws RequestError.
void parse_scale_bar(const std::string& text, AnnotationRequest& request);
/// Reads "EXPR=TEXT", parted where the selection ends (selection_and_text). Throws RequestError, SelectionError.
LabelRequest parse_label(std::string_view text);

/// The numbers of the curve for the frames of a run, given by their numbers in the trajectory; nothing if there is
/// none. Throws InputError.
std::optional<Curve> curve_of(const AnnotationRequest& request, std::span<const std::uint64_t> frames);

/// What is written into a picture of the structure; no time. Throws InputError for a label of no atoms.
Annotations annotations_of(const AnnotationRequest& request, const Structure& structure);

/// Of a frame: its time, or its number where the trajectory has no times. longest: of the run, ps, which chooses the
/// unit: ps below 1 ns, ns below 1 µs, else µs.
std::string time_text(const std::optional<double>& picoseconds, std::uint64_t frame, double longest);

}  // namespace meniscus
