// SPDX-License-Identifier: BSD-3-Clause
// From a scene and its figure to the page that shows them.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/camera/camera.h"
#include "core/color/coloring.h"
#include "core/render/look.h"
#include "core/render/picture.h"
#include "core/scene/figure.h"
#include "core/scene/scene.h"
#include "core/structure/structure.h"
#include "core/surface/primitives.h"
#include "exporters/page/page_file.h"

namespace meniscus::page {

/// Makes a file of a picture for readers whose browser cannot draw the figure.
using EncodeStill = std::function<StillPicture(const Framebuffer& drawn, const Look& look)>;

/// As PNG: larger than JPEG, but made without a library for it.
StillPicture png_still(const Framebuffer& drawn, const Look& look);

/// Before anything is computed. Throws RequestError for what a page cannot show though the scene has it.
void check_scene(const Scene& scene);

/// The page of a figure. scene: what the figure was made of, its selections settled. Throws as page_text() and
/// picture_objects() do.
std::string scene_page(const Scene& scene, Figure figure, const Camera& camera, std::vector<PageView> views,
                       const EncodeStill& encode);

/// The page of a scene, as `meniscus export page` makes it but for its still picture, a PNG. scene: complete(). On the
/// CPU. Throws RequestError as check_scene() does and for a run of frames, else what reading and computing throw.
std::string scene_page(const Scene& scene);

/// The page of a surface that no scene made, with the look of one. colors: a colour an atom. structure: names the atoms
/// that readers pick, in the same order, and has other colours for them; nullptr: they are counted.
std::string surface_page(const Surface& surface, const Coloring& colors, const Structure* structure, const Scene& look,
                         const Camera& camera, const EncodeStill& encode);

}  // namespace meniscus::page
