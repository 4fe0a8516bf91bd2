// SPDX-License-Identifier: BSD-3-Clause
// Scenes that commands read from files, with what their command line says for all, and drafts of scenes.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/options/scene_options.h"

namespace meniscus {

/// What the command line says that holds for each scene, too, as words of `meniscus render`. but: keys of what does
/// not, beside those of the section.
std::vector<std::string> shared_words(const SceneOptions& options, CommandBit bit, std::string_view section,
                                      std::span<const std::string_view> but);

/// The scene of a file or a picture, as `meniscus render --scene FILE words...` takes it. Options that do nothing are
/// not told. Throws as SceneOptions::take() does; UsageError for a scene that is not one of surfaces as colours.
SceneCommand read_scene_file(const std::string& path, std::vector<std::string> words, const Reporting& reporting);

/// The scene as a draft (--draft): in half its width and height, letters and lines with it, by one ray a pixel and
/// without shade by rays. It takes a fraction of the time.
void make_draft(Scene& scene);

}  // namespace meniscus
