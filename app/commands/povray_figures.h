// SPDX-License-Identifier: BSD-3-Clause
// Figures as POV-Ray's scenes take them, for single scenes, runs and films.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/math/ball.h"
#include "core/scene/figure.h"
#include "core/scene/scene.h"
#include "exporters/povray/scene_content.h"
#include "exporters/povray/scene_options.h"

namespace meniscus {

/// What the scene asks of all its files.
povray::SceneOptions povray_options(const Scene& scene, Existing existing);

/// Throws UsageError for what no scene for POV-Ray can show.
void check_povray(const Scene& scene);

/// What is drawn beside the surface with looks of its own. keeps_empty: those that show nothing have a place, too.
/// figure must stay.
std::vector<povray::SceneObject> povray_objects(const Figure& figure, const FigureRequest& request,
                                                const Camera& camera, bool keeps_empty);

/// Of the surface.
povray::SurfaceCut povray_cut(const Figure& figure, const FigureRequest& request, const Camera& camera);

/// Of all atoms that are shown, if comments should tell them.
std::vector<std::string> comment_names(const Scene& scene, const Structure& structure);

}  // namespace meniscus
