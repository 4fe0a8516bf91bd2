// SPDX-License-Identifier: BSD-3-Clause
// Scenes that commands read from files, with the options that their command line sets for all, and drafts of scenes.
#pragma once

#include "app/options/scene_options.h"

namespace meniscus {

/// Returns the options of the command line that hold for each scene, too, as words of `meniscus render`. but: keys of
/// those that do not.
std::vector<std::string> shared_words(const SceneOptions& options, std::span<const std::string_view> but);

/// Reads the scene of a file or a picture, as `meniscus render --scene FILE words...` does. Options without effect are
/// not reported. Throws like SceneOptions::take(); UsageError for a scene that does not show surfaces.
SceneCommand read_scene_file(const std::string& path, std::vector<std::string> words, const Reporting& reporting);

/// Turns the scene into a draft (--draft): half its width and height, with letters and lines, one ray per pixel and no
/// traced shade. It takes a fraction of the time.
void make_draft(Scene& scene);

}  // namespace meniscus
