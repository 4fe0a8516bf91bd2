// SPDX-License-Identifier: BSD-3-Clause
// Properties of the look: light, material, shade, lines, and fading into the background; and of the legend and the
// annotations in a picture.

#include <array>

#include <fmt/format.h>

#include "core/properties/presets.h"
#include "core/properties/properties.h"

namespace meniscus {
namespace {

constexpr unsigned kShared = in_scene | in_bundle;
constexpr unsigned kLook = kShared | live;
constexpr std::string_view kLight = "Light", kLines = "Lines";

constexpr auto kTable = std::to_array<Property>({
    word("look.preset", "--preset", "WORD", "").initially("publication").in(kLight, kLook | in_short_help),
    text("look.light", "--light", "X,Y,Z", "Direction towards the lamp, as X,Y,Z: right, up, to the viewer")
        .initially("-0.45,0.65,0.75")
        .in(kLight, kLook),
    number("look.light_strength", "--light-strength", "F", "Strength of the lamp, 0 to 10")
        .from(0, 10)
        .initially("1")
        .slider("Lamp", 2)
        .in(kLight, kLook),
    number("look.ambient", "--ambient", "F",
           "Share of light that comes evenly from all sides, 0 to 1. With 1, colours are exactly those given")
        .from(0, 1)
        .in(kLight, kLook | of_objects),
    number("look.roughness", "--roughness", "F",
           "Roughness of the material, from 0 (wax, darker at edges) to 1 (chalk)")
        .from(0, 1)
        .in(kLight, kLook | of_objects),
    number("look.specular", "--specular", "F", "Strength of highlights, 0 (none) to 1")
        .from(0, 1)
        .in(kLight, kLook | of_objects),
    number("look.shininess", "--shininess", "F", "Specular exponent, 1 to 1000; larger gives smaller highlights")
        .from(1, 1000)
        .in(kLight, kLook | of_objects),
    number("look.ambient_occlusion", "--ambient-occlusion", "F",
           "Shade in pockets and clefts, 0 (none) to 1. Everything drawn casts shade; transparent parts cast less")
        .from(0, 1)
        .slider("Shade", 1)
        .in(kLight, kLook | in_short_help),
    number("look.ambient_occlusion_radius", "--ambient-occlusion-radius", "Å",
           "Largest distance in Å at which @ambient-occlusion-rays@ finds shade")
        .from(0.1, 1000)
        .in(kLight, kLook),
    number("look.ambient_occlusion_rays", "--ambient-occlusion-rays", "N",
           "Rays per pixel for shade and shadows, such as 64: exact, but slow. 0: maps, which are fast")
        .from(0, 4096)
        .initially("0")
        .in(kLight, kLook),
    number("look.shadows", "--shadows", "F",
           "Darkness of shadows that the lamp casts, 0 (none) to 1. Transparent parts cast less")
        .from(0, 1)
        .slider("Shadows", 1)
        .in(kLight, kLook | in_short_help),
    number("look.shadow_softness", "--shadow-softness", "DEGREES",
           "Half the angle at which the lamp is seen, 0 (sharp shadows, by rays) to 45")
        .from(0, 45)
        .in(kLight, kLook),
    text("look.silhouettes", "--silhouettes", "WIDTH",
         "Width of black outlines: pixels, 0.5pt or 0.2mm; 0: no lines. They surround everything in front, and "
         "separate chains")
        .from(0, 16)
        .slider("Lines", 6)
        .in(kLines, kLook | in_short_help),
    text("look.outer_lines", "--outer-lines", "WIDTH", "Width of the outline around the whole molecule")
        .from(0, 16)
        .initially("@silhouettes@")
        .in(kLines, kLook | rare),
    text("look.inner_lines", "--inner-lines", "WIDTH", "Width of lines where one part is in front of another")
        .from(0, 16)
        .initially("@silhouettes@")
        .in(kLines, kLook | rare),
    text("look.part_lines", "--part-lines", "WIDTH", "Width of lines where chains meet")
        .from(0, 16)
        .initially("@silhouettes@")
        .in(kLines, kLook | rare),
    text("look.patch_lines", "--patch-lines", "WIDTH", "Width of the lines around @patches@; 0: no lines")
        .from(0, 16)
        .initially("2.5 pixels of a picture of 960, wider in larger ones")
        .in(kLines, kLook),
    text("look.patch_line_color", "--patch-line-color", "COLOR", "Colour of the lines around @patches@")
        .initially("black")
        .in(kLines, kLook),
    number("look.depth_cue", "--depth-cue", "F",
           "Fade of the farthest atoms into the background, 0 to 1. A transparent background counts as white. "
           "Presets do not fade if the background is transparent, colours show numbers, the surface is transparent, or "
           "with @look-into@")
        .from(0, 1)
        .slider("Depth", 1)
        .in(kLight, kLook),
    flag("look.linear_alpha", "--linear-alpha",
         "Make transparent edges for programs that blend in linear light. Without it .png and .tif pictures look "
         "right on a page")
        .in("Picture", kLook | rare),
    text("look.material", "--material", "WORD", "Material of the surface").in(kLight, kShared),
    flag("look.comments", "--comments", "Write a comment before each patch: its kind and its atoms")
        .in("Output", kShared),
    word("povray.material", "--material", "WORD",
         "First material: opaque, ghost, glass, wax or flat. The scene contains all of them")
        .one_of("opaque|ghost|glass|wax|flat")
        .initially("opaque")
        .in(kLight),
    word("path_tracers.material", "--material", "WORD",
         "Material of the surface: matte, plastic, glass or wax. Shapes are matte")
        .one_of("matte|plastic|glass|wax")
        .initially("matte")
        .in(kLight),
});

}  // namespace

std::span<const Property> look_properties() {
  static std::string words, help;
  static const std::vector<Property> table = [] {
    for (const Preset& preset : kPresets) {
      words += fmt::format("{}{}", words.empty() ? "" : "|", preset.word);
      help += fmt::format("{}{}: {}", help.empty() ? "Look by one word, such as ghost, pocket or ribbon. " : "; ",
                          preset.word, preset.sentence);
    }
    help +=
        ". meniscus looks FILE draws them all. Other options change single values of a look. Where colours show "
        "numbers, light changes only their lightness";
    std::vector<Property> rows(kTable.begin(), kTable.end());
    rows.front() = rows.front().one_of(words).with<&Property::help>(std::string_view(help));
    return rows;
  }();
  return table;
}

namespace {

constexpr std::string_view kLegend = "Legend", kLabels = "Labels";

constexpr auto kAnnotationTable = std::to_array<Property>({
    flag("legend.shown", "--legend", "Show a legend of the colours, at the right or, in tall pictures, below")
        .with<&Property::label>("Legend")
        .in(kLegend, kShared | live | in_short_help),
    new_file("legend.file", "--legend-file", "FILE", "Write the legend as a separate picture").in(kLegend, in_scene),
    text("legend.title", "--legend-title", "TEXT", "Title of the legend; '' for none")
        .initially("by the colours")
        .in(kLegend, kShared | live),
    text("legend.size", "--legend-size", "SIZE", "Height of the letters: pixels, 8pt or 3mm")
        .from(6, 1000)
        .initially("as @letter-size@, or a thirtieth of the shorter side")
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
        .initially("as @letter-size@")
        .in(kLabels, kShared)
        .needs("annotations.labels"),
    text("annotations.scale_bar_size", "--scale-bar-size", "SIZE", "Height of the letters of the scale bar")
        .from(6, 1000)
        .initially("as @letter-size@")
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
         "Write TEXT next to these atoms, with a line to their centre. Repeatable")
        .in(kLabels, kShared | live | repeatable | in_short_help),
    flag("annotations.lengths", "--hide-lengths", "Write no lengths next to dashed lines")
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

std::span<const Property> annotation_properties() { return kAnnotationTable; }

}  // namespace meniscus
