// SPDX-License-Identifier: BSD-3-Clause
// A folder with one POV-Ray scene for a run of frames: one geometry include per frame, everything else once; and the
// film of its pictures.
#pragma once

#include "core/camera/camera.h"
#include "core/color/color_maps.h"
#include "core/math/box.h"
#include "exporters/povray/povray_files.h"
#include "exporters/povray/povray_options.h"
#include "exporters/povray/povray_scene.h"
#include "exporters/povray/scene_text.h"

namespace meniscus::povray {

/// A picture of the film: a frame of the scene, or two of them blended in linear light.
struct StoryPicture {
  std::uint64_t first = 0;   ///< number of the first frame
  std::uint64_t second = 0;  ///< number of the second frame; 0 if there is none
  double share = 0.0;        ///< weight of the second frame, in [0, 1]
};

/// The pictures of a film in order.
struct Story {
  std::vector<StoryPicture> pictures;
  double rate = 25.0;  ///< pictures per second
};

/// The properties that all frames of a run share. Every process that writes some of the frames must use the same run.
struct Run {
  /// Frame numbers of the trajectory, each once; POV-Ray's frames have the same numbers.
  std::vector<std::uint64_t> frames;
  std::vector<Camera> cameras;  ///< one for all frames, or one per frame; all of one projection
  /// All colours that may occur. Geometry refers to them by their place in this list, which is the order of the style
  /// file. Any order is valid. Nothing if colours change from frame to frame; then each frame has a file of colours.
  std::optional<std::vector<SceneColor>> colors;
  Box extent;                            ///< box of everything that is shown in any frame, Å
  bool surface = true;                   ///< true if the surface is shown; if false, `colors` must be empty
  bool shapes = false;                   ///< true if every frame has a file of shapes
  bool caps = false;                     ///< true if planes cut the surface in every frame
  bool translucent = false;              ///< true if the opacity of some colour may be less than 1 in some frame
  std::vector<ObjectPart> objects = {};  ///< the further objects that every frame has
  /// The material of each object, by SceneColor::finish: number n is the n-th, from 1.
  std::vector<MaterialRequest> materials = {};
  std::shared_ptr<const VolumePaint> map = {};  ///< the volume map that colours points in all frames, or nullptr
  bool maps_change = false;  ///< true if each frame has a map of its own; `colors` must be empty then
  /// One per frame, with a background and shadows that replace the values of the options. Empty if all frames have the
  /// values of the options.
  std::vector<FrameLook> looks = {};
};

/// Writes a run of frames as one scene.
class SequenceScene {
 public:
  /// If options.origin is empty, the origin is the middle of run.extent. The folder is made by the first write. Throws
  /// Error if there is no frame, if the name or size in the options is invalid, or if the number of cameras is neither
  /// 1 nor that of the frames.
  SequenceScene(Run run, SceneOptions options, std::filesystem::path folder);
  /// Marks the constructor for a film. Frames are added one by one by add_frame(), and are numbered from 1.
  struct Film {};
  /// Makes a film from a run without frames and cameras. run.extent must be known: it decides the origin as above.
  /// Throws Error if the name or size in the options is invalid.
  SequenceScene(Film, Run run, SceneOptions options, std::filesystem::path folder);
  /// Adds a frame to a film and returns its place in the run, from 0.
  std::size_t add_frame(const Camera& camera, const FrameLook& look);

  /// Writes the files that all frames share: <name>.ini, <name>.pov, <name>.inc, <name>_style.inc, <name>_aov.inc,
  /// <name>_objects.json (the frames and the meaning of the colours), and <name>_map.df3 if the run has a volume map. A
  /// file that exists with exactly this content stays; the others are written, all or none. For a film it must be
  /// called after the last add_frame(). `film` adds <name>_story.pov and <name>_story.ini; nullptr adds nothing.
  /// Returns the written files, the origin and the command that renders them. Throws OutputError.
  SceneReport write_shared(const Story* film = nullptr) const;

  /// Writes <name>_geometry_#####.inc, numbered by the frame of the trajectory. Existing files are replaced or refused
  /// as options.existing says. A surface of several objects adds <name>_objects_#####.json; shapes add
  /// <name>_shapes_#####.inc; caps add <name>_caps_#####.inc; further objects add <name>_object_1_#####.inc, ...;
  /// colours of the frame's own add <name>_colors_#####.inc; a map of the frame's own adds <name>_map_#####.df3. All
  /// files that the run declares are written, even if this frame shows nothing of them. `place` is the index in the
  /// run, from 0. `shown` must have everything that the run declares. Frames may be written in any order, also by
  /// several processes with the same run. Throws what write_scene() throws, and Error for a colour that is not in
  /// Run::colors.
  SceneReport write_frame(std::size_t place, const Shown& shown) const;

 private:
  SceneParts parts() const;

  Run run_;
  SceneOptions options_;
  std::filesystem::path folder_;
  glm::dvec3 origin_;
  std::uint32_t palette_;  ///< checksum of the origin and the shared colours, on which scene and includes must agree
};

}  // namespace meniscus::povray
