// SPDX-License-Identifier: BSD-3-Clause
// The objects of a scene as planes cut them: one object where there are planes, and its caps.
#pragma once

#include <span>

#include "core/camera/camera.h"
#include "core/mesh/section_mesh.h"
#include "core/queries/surface_object.h"
#include "exporters/povray/scene_options.h"

namespace meniscus::povray {

/// Keeps what it makes; without planes it only looks at the objects given, which must outlive it.
class CutObjects {
 public:
  /// camera and options: how fine caps have to be. Throws as section_caps() and merged() do.
  CutObjects(std::span<const SurfaceObject> objects, const SurfaceCut& cut, const Camera& camera,
             const SceneOptions& options);
  CutObjects(const CutObjects&) = delete;
  CutObjects& operator=(const CutObjects&) = delete;

  /// All copies as one object where there are planes: each copy is cut elsewhere.
  std::span<const SurfaceObject> objects() const { return objects_; }
  bool has_caps() const { return cuts_; }
  /// CapMesh::atom: into the atoms of the one object.
  const CapMesh& caps() const { return caps_; }

 private:
  bool cuts_;
  SurfaceObject whole_;
  std::span<const SurfaceObject> objects_;
  CapMesh caps_;
};

}  // namespace meniscus::povray
