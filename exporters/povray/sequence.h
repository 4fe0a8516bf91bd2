// SPDX-License-Identifier: BSD-3-Clause
// A folder with one POV-Ray scene for a run of frames: one geometry include per frame, everything else once.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "core/camera/camera.h"
#include "core/color/color_maps.h"
#include "core/math/box.h"
#include "exporters/povray/palette.h"
#include "exporters/povray/scene.h"
#include "exporters/povray/scene_content.h"
#include "exporters/povray/scene_files.h"
#include "exporters/povray/story.h"

namespace meniscus::povray {

/// What all frames of a run share. Every process that makes some of them must be given the same.
struct Run {
  std::vector<std::uint64_t> frames;  ///< of the trajectory, each once; POV-Ray's frames have these numbers
  std::vector<Camera> cameras;        ///< one for all, or one a frame; of one projection
  /// All that may occur, in the order of the style file; nothing: they change, and each frame has a file of its own.
  std::optional<std::vector<SceneColor>> colors;
  Box extent;                                   ///< Å: around all that is shown at all frames
  bool surface = true;                          ///< shown; else `colors` must be nothing
  bool shapes = false;                          ///< every frame has a file of those beside the surface
  bool caps = false;                            ///< the surface is cut by planes in every frame
  bool translucent = false;                     ///< some colour of some frame may be seen through
  std::vector<ObjectPart> objects = {};         ///< further ones, of every frame: what each is
  std::vector<MaterialRequest> materials = {};  ///< theirs (SceneStyle::materials)
  std::shared_ptr<const VolumePaint> map = {};  ///< of the colours that are by one, the same in all frames
  bool maps_change = false;                     ///< each frame has a file of its own; then so must colours
  std::vector<FrameLook> looks = {};            ///< one a frame; none: all are as the options say
};

class SequenceScene {
 public:
  /// options.origin: nothing: the middle of the run's box. Throws Error (no frame, bad name or size, cameras of another
  /// number).
  SequenceScene(Run run, SceneOptions options, std::filesystem::path folder);
  /// The same of a film, whose frames are added one by one, numbered from 1. run: without frames and cameras.
  struct Film {};
  SequenceScene(Film, Run run, SceneOptions options, std::filesystem::path folder);
  /// The place of the new frame.
  std::size_t add_frame(const Camera& camera, const FrameLook& look);

  /// Writes <name>.ini, <name>.pov, <name>.inc, <name>_style.inc, <name>_aov.inc, <name>_objects.json (the frames, and
  /// what the colours mean), and of a volume map <name>_map.df3. Files that are there with just this content stay; the
  /// others are written, all or none. Throws OutputError.
  /// film: adds <name>_story.pov and <name>_story.ini; nullptr: no film.
  SceneReport write_shared(const Story* film = nullptr) const;

  /// Writes <name>_geometry_#####.inc, numbered by the frame of the trajectory, and where the surface is several
  /// objects <name>_objects_#####.json; with shapes <name>_shapes_#####.inc, with caps <name>_caps_#####.inc, with
  /// further objects <name>_object_1_#####.inc, ..., with colours of its own <name>_colors_#####.inc, with a map of its
  /// own <name>_map_#####.df3. Each may show nothing. place: in the run, from 0. shown: all that the run has. Throws
  /// what write_scene throws, and Error for a colour that is not the run's.
  SceneReport write_frame(std::size_t place, const Shown& shown) const;

 private:
  SceneParts parts() const;

  Run run_;
  SceneOptions options_;
  std::filesystem::path folder_;
  glm::dvec3 origin_;
  std::uint32_t palette_;  ///< of origin and colours, if all frames share them: scene and includes must agree on them
};

}  // namespace meniscus::povray
