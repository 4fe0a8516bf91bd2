// SPDX-License-Identifier: BSD-3-Clause
// A folder with a POV-Ray 3.7 scene of surfaces: the analytic patches themselves, never triangles.
#pragma once

#include <filesystem>
#include <span>

#include "core/camera/camera.h"
#include "core/queries/surface_object.h"
#include "exporters/povray/povray_options.h"

namespace meniscus::povray {

/// Writes <name>.ini, <name>.pov, <name>.inc, <name>_style.inc, <name>_aov.inc, <name>_geometry.inc,
/// <name>_objects.json and, if there are shapes, caps, more objects or a volume map, <name>_shapes.inc,
/// <name>_caps.inc, <name>_object_1.inc, ... and <name>_map.df3 into `folder`, all or none. given: the objects of the
/// surface; empty if the surface is not shown. One unit is 1 Å; coordinates are relative to options.origin. The camera
/// shows the same pixels as that of the ray caster. Each object with its copies is a union object_1, object_2, ...;
/// their names in the molecule are in the .json only. A surface that planes cut is a single object. Points of hidden
/// atoms are left out. Throws OutputError if a file exists or is not writable, and Error if nothing is shown, a name or
/// size is invalid, or a number is not finite.
SceneReport write_scene(std::span<const SurfaceObject> given, const Camera& camera, const SceneOptions& options,
                        const std::filesystem::path& folder);

}  // namespace meniscus::povray
