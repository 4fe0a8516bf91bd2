// SPDX-License-Identifier: BSD-3-Clause
// Looks by one word: the light of a picture, and what is drawn in it.
#pragma once

#include <algorithm>
#include <span>
#include <string_view>

namespace meniscus {

/// The value of a property, as the text of its option. "%" is the place that the preset looks at.
struct PresetSetting {
  std::string_view key, text;
};

/// A look by one word. A scene has its settings unless the user chose other values.
struct Preset {
  std::string_view word, sentence;            ///< the sentence says what is seen, for the help
  std::span<const PresetSetting> settings{};  ///< empty: a light alone
  std::string_view light = "publication";     ///< the word of the light that a preset with settings has
  std::string_view needs{};                   ///< atoms that it needs, whose first place it looks at; empty: none

  bool sets(std::string_view key) const {
    return std::ranges::find(settings, key, &PresetSetting::key) != settings.end();
  }
};

inline constexpr PresetSetting kGhostSettings[] = {
    {"surface.opacity", "0.15"}, {"surface.film_opacity", "true"}, {"figure.tube", "polymer"}};

// David Goodsell draws each chain in one tone, and tints what is charged.
inline constexpr PresetSetting kGoodsellSettings[] = {
    {"surface.kind", "vdw"},
    {"surface.color", "chain"},
    {"surface.color", "resname ASP GLU and name OD1 OD2 OE1 OE2=#d4735e:acids"},
    {"surface.color", "resname LYS ARG and name NZ NH1 NH2=#5f7fc4:bases"},
    {"surface.color", "nucleic and name P OP1 OP2 OP3 O1P O2P=#dd8452:phosphates"},
    {"look.shadows", "0.4"},
    {"look.shadow_softness", "8"}};

inline constexpr PresetSetting kPocketSettings[] = {
    {"surface.color", "#c4ccd6"},
    {"surface.color", "%=element-cpk"},
    {"surface.color", "element C and (%)=#45a878:ligand"},
    {"surface.opacity", "0.3"},
    {"surface.film_opacity", "true"},
    {"surface.clip", "before %"},
    {"figure.sticks", "%"},
    {"figure.hydrogen_bonds", "(%) to polymer"},
    {"figure.object", R"({"representation": "sticks", "selection": "byres (within 3.6 of (%)) and noh", )"
                      R"("color": "chain-element", "radius": 0.12})"},
    {"camera.view", "open"},
    {"camera.zoom_to", "%"}};

inline constexpr PresetSetting kRibbonSettings[] = {{"surface.shown", "true"}, {"figure.tube", "polymer"}};

/// All presets, in the order of LookPreset (core/render/look.h) and of the looks in core/scene/scene_values.h.
inline constexpr Preset kPresets[] = {
    {"publication", "shade, thin lines, colours as given"},
    {"cover", "studio light, highlights"},
    {"flat", "constant colours and lines"},
    {"soft", "matt, no lines"},
    {"classic", "studio light alone"},
    {"ghost", "the fold inside a transparent surface", kGhostSettings, "publication", "polymer"},
    {"goodsell", "atoms in flat colours of chains, with outlines and shadows", kGoodsellSettings, "flat"},
    {"pocket", "a ligand in its pocket, with its neighbours and hydrogen bonds", kPocketSettings, "publication",
     "ligand and not glycan"},
    {"ribbon", "the fold without a surface", kRibbonSettings, "publication", "polymer"},
};

}  // namespace meniscus
