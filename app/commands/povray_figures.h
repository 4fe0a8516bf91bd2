// SPDX-License-Identifier: BSD-3-Clause
// Figures in the form of POV-Ray's scenes, for single scenes, runs and films.
#pragma once

#include "app/options/property_options.h"
#include "core/math/ball.h"
#include "core/scene/figure.h"
#include "core/scene/scene.h"
#include "exporters/povray/povray_scene.h"
#include "exporters/povray/scene_text.h"

namespace meniscus {

/// Returns the properties of `meniscus export povray`.
TakenProperties povray_properties();

/// Returns the options that all files of the scene share.
povray::SceneOptions povray_options(const Scene& scene, Existing existing);

/// Throws UsageError for settings that no scene for POV-Ray can show.
void check_povray(const Scene& scene);

/// Returns the objects drawn in addition to the surface that have materials of their own. keeps_empty: objects that
/// show nothing have an entry, too. figure must stay valid.
std::vector<povray::SceneObject> povray_objects(const Figure& figure, const FigureRequest& request,
                                                const Camera& camera, bool keeps_empty);

/// Returns the cut of the surface.
povray::SurfaceCut povray_cut(const Figure& figure, const FigureRequest& request, const Camera& camera);

/// Returns the names of all shown atoms, if comments are to contain them.
std::vector<std::string> comment_names(const Scene& scene, const Structure& structure);

}  // namespace meniscus
