// SPDX-License-Identifier: BSD-3-Clause
// The object behind the handle of a mesh.
#pragma once

#include <memory>

#include "core/mesh/mesh_objects.h"
#include "core/mesh/triangle_mesh.h"
#include "exporters/bindings/c/counted.h"
#include "exporters/bindings/c/c_surface.h"

struct meniscus_mesh : meniscus::c_api::Counted {
  std::shared_ptr<const meniscus::c_api::FinishedSurface> of;
  meniscus::MeshFineness fineness;
  meniscus::FineMesh made;
};
