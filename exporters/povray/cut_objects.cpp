// SPDX-License-Identifier: BSD-3-Clause
// Makes caps while objects are apart, and then one object of all.
#include "exporters/povray/cut_objects.h"

#include <vector>

#include "core/queries/combine.h"
#include "exporters/povray/cap_objects.h"

namespace meniscus::povray {

CutObjects::CutObjects(std::span<const SurfaceObject> objects, const SurfaceCut& cut, const Camera& camera,
                       const SceneOptions& options)
    : cuts_(!cut.planes.empty() && !objects.empty()), objects_(objects) {
  if (!cuts_) return;
  caps_ = make_caps(objects, cut, camera, options.width, options.height);
  whole_ = merged({objects.begin(), objects.end()});
  objects_ = {&whole_, 1};
}

}  // namespace meniscus::povray
