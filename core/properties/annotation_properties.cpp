// SPDX-License-Identifier: BSD-3-Clause
// Properties of the legend and of the annotations in a picture.
#include <array>

#include "core/properties/properties.h"

namespace meniscus {
namespace {

constexpr unsigned kShared = in_scene | in_bundle;
constexpr std::string_view kLegend = "Legend", kLabels = "Labels";

constexpr auto kTable = std::to_array<Property>({
    flag("legend.shown", "--legend", "Show a legend of the colours, at the right or, in tall pictures, below")
        .with<&Property::label>("Legend")
        .in(kLegend, kShared | live | in_short_help),
    new_file("legend.file", "--legend-file", "FILE", "Write the legend as a separate picture").in(kLegend, in_scene),
    text("legend.title", "--legend-title", "TEXT", "Title of the legend; '' for none")
        .initially("by the colours")
        .in(kLegend, kShared | live),
    text("legend.size", "--legend-size", "SIZE", "Height of the letters: pixels, 8pt or 3mm")
        .from(6, 1000)
        .initially("that of @letter-size@, or a thirtieth of the shorter side")
        .in(kLegend, kShared | live),
    text("legend.names", "--legend-name", "ENTRY=TEXT",
         "Write TEXT instead of an entry of the legend, as in 'A=Alpha' for chain A. Repeatable")
        .in(kLegend, kShared | live | repeatable),
    word("legend.place", "--legend-place", "WORD", "Place of the legend: auto, right or below")
        .one_of("auto|right|below")
        .initially("auto")
        .in(kLegend, kShared | live | rare),

    text("annotations.panel", "--panel", "TEXT", "Letter of the panel, such as a, at the top left")
        .in(kLabels, kShared | live | in_short_help),
    text("annotations.title", "--title", "TEXT", "Title of the picture, at the top")
        .in(kLabels, kShared | live | in_short_help),
    text("annotations.scale_bar", "--scale-bar", "Å",
         "Draw a scale bar of this length, or of a round one (auto). With a perspective camera it is true at the "
         "camera's target")
        .proposes("auto")
        .initially("auto")
        .in(kLabels, kShared | live | value_optional | in_short_help),
    text("annotations.letter_size", "--letter-size", "SIZE",
         "Height of all letters that have no size of their own: pixels, 8pt or 3mm")
        .from(6, 1000)
        .initially("by the size of the picture")
        .in(kLabels, kShared | live | in_short_help),
    text("annotations.font", "--font", "NAME", "Font of all letters: an installed family, such as DejaVu Sans")
        .initially("Liberation Sans, else DejaVu Sans")
        .in(kLabels, kShared | live),
    file("annotations.font_file", "--font-file", "FILE", "Font of all letters: a .ttf or .otf file")
        .in(kLabels, kShared)
        .excludes("annotations.font"),
    text("annotations.label_size", "--label-size", "SIZE", "Height of the letters of labels")
        .from(6, 1000)
        .initially("that of @letter-size@")
        .in(kLabels, kShared)
        .needs("annotations.labels"),
    text("annotations.scale_bar_size", "--scale-bar-size", "SIZE", "Height of the letters of the scale bar")
        .from(6, 1000)
        .initially("that of @letter-size@")
        .in(kLabels, kShared)
        .needs("annotations.scale_bar"),
    text("annotations.panel_size", "--panel-size", "SIZE", "Height of the letter of the panel")
        .from(6, 1000)
        .initially("1.5 times @letter-size@")
        .in(kLabels, kShared)
        .needs("annotations.panel"),
    text("annotations.letter_color", "--letter-color", "COLOR",
         "Colour of letters, lines and bars: auto, or a colour. auto: dark or light, as @background@ needs; dark "
         "if it is transparent")
        .proposes("auto|white|black")
        .initially("auto")
        .in(kLabels, kShared | live),
    text("annotations.labels", "--label", "EXPR=TEXT",
         "Write TEXT at these atoms, with a line to their centre. Repeatable")
        .in(kLabels, kShared | live | repeatable | in_short_help),
    flag("annotations.lengths", "--hide-lengths", "Write no lengths beside dashed lines")
        .in(kLabels, kShared | live | negated),
    flag("annotations.time_stamp", "--time-stamp", "Write the time of each frame in ps, ns or µs, or else its number")
        .in(kLabels, kShared),
    file("annotations.curve", "--curve", "FILE.csv",
         "Draw a curve of the run from a CSV table, with a mark at each frame. Such tables are written by "
         "@csv-series@ of meniscus surface")
        .in(kLabels, kShared),
    text("annotations.curve_column", "--curve-column", "NAME", "Column of the table to draw")
        .initially("the first after the time")
        .in(kLabels, kShared | rare)
        .needs("annotations.curve"),
});

}  // namespace

std::span<const Property> annotation_properties() { return kTable; }

}  // namespace meniscus
