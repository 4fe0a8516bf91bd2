// SPDX-License-Identifier: BSD-3-Clause
// The table.
#include "app/options/scene_keys.h"

#include <array>

namespace meniscus {
namespace {

using V = SceneValue;

constexpr auto kSceneKeys = std::to_array<SceneKey>({
    {"molecule", "file", "FILE", V::path},
    {"molecule", "model", "--model", V::text},
    {"molecule", "altloc", "--altloc", V::text},
    {"molecule", "select", "--select", V::text},
    {"molecule", "keep_water", "--keep-water", V::flag},
    {"molecule", "keep_ions", "--keep-ions", V::flag},
    {"molecule", "unknown_element", "--unknown-element", V::text},
    {"molecule", "hydrogens", "--hydrogens", V::text},
    {"molecule", "radii", "--radii", V::text},
    {"molecule", "radii_file", "--radii-file", V::paths},
    {"molecule", "radius", "--radius", V::list},
    {"molecule", "assembly", "--assembly", V::text},
    {"molecule", "instances", "--instances", V::text},

    {"frames", "trajectory", "--trajectory", V::paths},
    {"frames", "trajectory_atoms", "--trajectory-atoms", V::text},
    {"frames", "trust_atom_order", "--trust-atom-order", V::flag},
    {"frames", "frames", "--frames", V::text},
    {"frames", "stride", "--stride", V::text},
    {"frames", "begin", "--begin", V::text},
    {"frames", "end", "--end", V::text},
    {"frames", "repeat", "--repeat", V::text},
    {"frames", "select_once", "--select-once", V::flag},
    {"frames", "whole", "--whole", V::text_or_flag},
    {"frames", "superpose", "--superpose", V::text},
    {"frames", "center", "--center", V::text},
    {"frames", "reference", "--reference", V::text},
    {"frames", "smooth", "--smooth", V::text},
    {"frames", "fps", "--fps", V::text},
    {"frames", "codec", "--codec", V::text},
    {"frames", "crf", "--crf", V::text},
    {"frames", "bits", "--bits", V::text},
    {"frames", "chroma", "--chroma", V::text},

    {"surface", "shown", "--hide-surface", V::negated, true},
    {"surface", "interface", "--interface", V::text, true},
    {"surface", "kind", "--surface", V::text, true, "ses"},
    {"surface", "probe", "--probe", V::text},
    {"surface", "show", "--show", V::text},
    {"surface", "by", "--by", V::text, true},
    {"surface", "cavities", "--cavities", V::text, true, "keep"},
    {"surface", "color", "--color", V::list, true},
    {"surface", "color_by_file", "--color-by-file", V::path, true},
    {"surface", "color_column", "--color-column", V::text, true},
    {"surface", "color_map_file", "--color-map-file", V::path, true},
    {"surface", "map_offset", "--map-offset", V::text, true},
    {"surface", "map", "--map", V::text, true},
    {"surface", "map_file", "--map-file", V::path, true},
    {"surface", "color_range", "--color-range", V::text, true},
    {"surface", "missing_color", "--missing-color", V::text, true},
    {"surface", "color_title", "--color-title", V::text},
    {"surface", "color_unit", "--color-unit", V::text},
    {"surface", "opacity", "--opacity", V::list, true},
    {"surface", "film_opacity", "--film-opacity", V::flag, true},
    {"surface", "clip", "--clip", V::list, true},
    {"surface", "cap_color", "--cap-color", V::text, true},
    {"surface", "cap_hatching", "--cap-hatching", V::text, true},

    {"shapes", "stick_radius", "--stick-radius", V::text, true},
    {"shapes", "tube_radius", "--tube-radius", V::text, true},

    {"look", "preset", "--preset", V::text},
    {"look", "light", "--light", V::text},
    {"look", "light_strength", "--light-strength", V::text},
    {"look", "ambient", "--ambient", V::text},
    {"look", "roughness", "--roughness", V::text},
    {"look", "specular", "--specular", V::text},
    {"look", "shininess", "--shininess", V::text},
    {"look", "ambient_occlusion", "--ambient-occlusion", V::text},
    {"look", "ambient_occlusion_radius", "--ambient-occlusion-radius", V::text},
    {"look", "silhouettes", "--silhouettes", V::text},
    {"look", "outer_lines", "--outer-lines", V::text},
    {"look", "inner_lines", "--inner-lines", V::text},
    {"look", "part_lines", "--part-lines", V::text},
    {"look", "depth_cue", "--depth-cue", V::text},
    {"look", "linear_alpha", "--linear-alpha", V::flag},
    {"look", "material", "--material", V::text},
    {"look", "comments", "--comments", V::flag},

    {"camera", "from", "--camera", V::camera},
    {"camera", "projection", "--projection", V::text},
    {"camera", "view", "--view", V::text},
    {"camera", "turn", "--turn", V::list},
    {"camera", "zoom_to", "--zoom-to", V::text},
    {"camera", "path", "--camera-path", V::path},
    {"camera", "turntable", "--turntable", V::text},
    {"camera", "follow", "--follow", V::text},

    {"image", "size", "--size", V::text},
    {"image", "width", "--width", V::text},
    {"image", "height", "--height", V::text},
    {"image", "dpi", "--dpi", V::text},
    {"image", "samples", "--samples", V::text},
    {"image", "background", "--background", V::text},
    {"image", "aovs", "--aovs", V::flag},
    {"image", "extent", "--extent", V::text},

    {"legend", "shown", "--legend", V::flag},
    {"legend", "file", "--legend-file", V::path},
    {"legend", "title", "--legend-title", V::text},
    {"legend", "size", "--legend-size", V::text},
    {"legend", "place", "--legend-place", V::text},

    {"annotations", "panel", "--panel", V::text},
    {"annotations", "scale_bar", "--scale-bar", V::text_or_flag},
    {"annotations", "labels", "--label", V::list},
    {"annotations", "time_stamp", "--time-stamp", V::flag},
    {"annotations", "curve", "--curve", V::path},
    {"annotations", "curve_column", "--curve-column", V::text},

    {"mesh", "tolerance", "--tolerance", V::text},
    {"mesh", "tolerance_pixels", "--tolerance-pixels", V::text},
    {"mesh", "density", "--density", V::text},
    {"mesh", "even", "--even", V::flag},
    {"mesh", "format", "--format", V::text},
    {"mesh", "attributes", "--attributes", V::text},
    {"mesh", "unit", "--unit", V::text},
    {"mesh", "scale", "--scale", V::text},

    {"output", "file", "-o", V::path},
});

}  // namespace

std::span<const SceneKey> scene_keys() { return kSceneKeys; }

}  // namespace meniscus
