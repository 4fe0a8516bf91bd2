// SPDX-License-Identifier: BSD-3-Clause
// Properties of the legend and of what is written into a picture.
#include <array>

#include "core/properties/tables.h"

namespace meniscus {
namespace {

constexpr unsigned kShared = in_scene | in_bundle;
constexpr std::string_view kLegend = "Legend", kLabels = "Labels";

constexpr auto kTable = of_commands(
    for_render | for_preview,
    std::to_array<Property>({
        flag("legend.shown", "--legend",
             "Explain the colours at the right (of tall pictures: below); the molecule is framed beside the legend")
            .in(kLegend, kShared | live)
            .in_short_help(),
        new_file("legend.file", "--legend-file", "FILE", "Write the legend as a picture of its own")
            .in(kLegend, in_scene)
            .of(for_render),
        text("legend.title", "--legend-title", "TEXT", "Title of the legend; '' for none")
            .initially("by the colours")
            .in(kLegend, kShared | live),
        text("legend.size", "--legend-size", "SIZE", "Height of its letters: pixels, 8pt or 3mm")
            .from(6, 1000)
            .initially("a thirtieth of the shorter side")
            .in(kLegend, kShared | live),
        word("legend.place", "--legend-place", "WORD", "Place of the legend: auto, right or below")
            .one_of("auto|right|below")
            .initially("auto")
            .in(kLegend, kShared | live | rare),

        text("annotations.panel", "--panel", "TEXT", "Letter of the panel, at the top left")
            .in(kLabels, kShared)
            .in_short_help(),
        text("annotations.scale_bar", "--scale-bar", "Å",
             "Scale bar of this length in Å at the bottom left, or of a round length (auto); with a perspective camera "
             "it is true at the camera's target")
            .proposes("auto")
            .initially("auto")
            .in(kLabels, kShared | value_optional)
            .in_short_help(),
        text("annotations.labels", "--label", "EXPR=TEXT",
             "Write TEXT beside the middle of these atoms, with a line to it, in front of everything. Repeatable")
            .in(kLabels, kShared | repeatable)
            .in_short_help(),
        flag("annotations.time_stamp", "--time-stamp",
             "Write the time of each frame in ns at the top right, or its number where there are no times")
            .in(kLabels, kShared)
            .of(for_render),
        file("annotations.curve", "--curve", "FILE.csv",
             "Draw numbers of the run (from surface --csv-series) as a curve at the bottom right, with a mark at each "
             "frame")
            .in(kLabels, kShared)
            .of(for_render),
        text("annotations.curve_column", "--curve-column", "NAME", "Column of --curve")
            .initially("the first after the time")
            .in(kLabels, kShared | rare)
            .of(for_render)
            .needs("annotations.curve"),
    }));

}  // namespace

std::span<const Property> annotation_properties() { return kTable; }

}  // namespace meniscus
