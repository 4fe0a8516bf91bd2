// SPDX-License-Identifier: BSD-3-Clause
// A folder with a POV-Ray 3.7 scene of surfaces: the analytic patches themselves, never triangles; the text of its
// files except the geometry: main file, style, buffers, .ini, and the include for a user's own scene; and one scene for
// a run of frames: one geometry include per frame, everything else once; and the film of its pictures.
#pragma once

#include <list>

#include "core/base/output_file.h"
#include "core/camera/camera.h"
#include "core/color/color_maps.h"
#include "core/math/box.h"
#include "core/queries/surface_object.h"
#include "exporters/povray/scene_text.h"
#include "exporters/povray/surface_pieces.h"

namespace meniscus::povray {

/// The look of one frame, in addition to its camera.
struct FrameLook {
  glm::vec3 background{1.0f};    ///< SceneOptions::background
  float shadows = 0.0f;          ///< SceneOptions::shadows
  float shadow_softness = 0.0f;  ///< SceneOptions::shadow_softness
};

/// The frames of a scene.
struct SceneFrames {
  std::vector<std::uint64_t> numbers;  ///< frame numbers of the trajectory, in the order of the scene
  std::uint32_t palette = 0;           ///< checksum that distinguishes colours and origin from those of other runs
  std::span<const FrameLook> looks;    ///< one per frame; empty if all frames have the look of the options
};

/// The properties of the file of one further object that the main file needs.
struct ObjectPart {
  bool is_surface = false;  ///< true for patches, which share an interior; false for shapes
  bool single = false;      ///< true if the geometry of a surface is one item
};

/// The properties of the other files that the main file needs.
struct SceneParts {
  bool surface = true;       ///< true if there is geometry of the surface
  bool single = false;       ///< true if that geometry is one item
  bool caps = false;         ///< true if there is a file of caps, or one per frame
  bool shapes = false;       ///< true if there is a file of shapes, or one per frame
  bool translucent = false;  ///< true if the opacity of some colour is less than 1
  std::vector<ObjectPart> objects = {};
};

/// The content of the style file.
struct SceneStyle {
  const std::vector<SceneColor>* colors = nullptr;  ///< nullptr: each frame has a file with colours of its own
  const VolumePaint* map = nullptr;                 ///< the map of colours with SceneColor::by_map, or nullptr
  std::vector<MaterialRequest> materials = {};      ///< objects' materials: SceneColor::finish n is the n-th, from 1
};

/// Returns the text of <name>.pov. cameras: one, or one per frame. frames: nullptr for a single surface.
std::string main_text(std::span<const Camera> cameras, const SceneOptions& options, const glm::dvec3& origin,
                      const SceneParts& parts, const SceneFrames* frames = nullptr);
/// Returns the text of <name>_style.inc. origin: the origin of the scene's coordinates, in Å.
std::string style_text(const SceneStyle& style, const SceneOptions& options, const glm::dvec3& origin);
/// Returns lists with an entry for each colour. meaning: the key whose names become comments.
std::string colors_text(const std::vector<SceneColor>& colors, const std::optional<ColorKey>& meaning);
/// Returns the text of <name>_aov.inc. colors: SceneStyle::colors. e: the box of everything shown, in Å.
std::string buffer_text(const std::vector<SceneColor>* colors, const SceneOptions& options, const Box& e,
                        const glm::dvec3& origin);
/// Returns the text of <name>.ini. frames: the frame numbers of the run; empty for a single surface.
std::string ini_text(const SceneOptions& options, std::span<const std::uint64_t> frames = {});
/// Returns the command that renders all frames, for a POSIX shell in the folder of the scene.
std::string render_command(const SceneOptions& options, std::span<const std::uint64_t> frames);

/// Returns the text of <name>.inc, which includes <name>.pov. It declares Meniscus_Surface, Meniscus_Shapes,
/// Meniscus_Object_1, ... as far as the scene has them, and places nothing. Names that were declared before it stay as
/// they were; all other names are undefined at its end. texts: the text of <name>.pov and of the files it includes,
/// except the templates for caps, shapes and maps and the lists of colours, which are always searched for names. maps:
/// true if each frame of a run may have a volume map.
std::string own_scene_text(std::string_view name, std::span<const std::string_view> texts, bool maps = false);

/// The things that a picture shows. All of them must live until the picture is written.
struct Shown {
  std::span<const SurfaceObject> surface;  ///< the objects of the surface; empty if it is not shown
  SurfaceCut cut;                          ///< planes that cut the surface
  const ColoredShapes* shapes = nullptr;   ///< shapes in addition to the surface; may be nullptr
  std::span<const SceneObject> objects;    ///< further objects in addition to the surface
  std::span<const std::string> names;      ///< names of atoms (SceneOptions::atom_names)
  std::optional<bool> film = {};           ///< SceneOptions::film for the surface; empty: that of the options
};

/// Returns the materials of objects, in the order of SceneColor::finish.
std::vector<MaterialRequest> materials_of(std::span<const SceneObject> objects);

/// The geometry of one picture. It refers to the arguments of its constructor, which must outlive it.
class SceneContent {
 public:
  /// Adds all colours to `table`, after those that it has. origin: the origin of the scene's coordinates, in Å. Throws
  /// what section_caps() and merged() throw.
  SceneContent(const Shown& shown, const Camera& camera, const SceneOptions& options, const glm::dvec3& origin,
               ColorTable& table);
  SceneContent(const SceneContent&) = delete;
  SceneContent& operator=(const SceneContent&) = delete;

  /// Returns the geometry of the surface.
  const Geometry& geometry() const { return geometry_; }
  std::span<const SurfaceObject> objects() const { return cut_.objects(); }
  bool has_caps() const { return cut_.has_caps(); }
  bool has_shapes() const { return shown_.shapes && !shown_.shapes->empty(); }
  /// Returns the volume map that colours points, or nullptr if there is none.
  const VolumePaint* map() const;
  /// Returns a description of each further object, in order.
  std::vector<ObjectPart> parts() const;
  /// Returns the number of primitives of the surface and of all further objects.
  std::size_t primitive_count() const;

  /// A function that creates the file for a part, such as "geometry", "caps", "shapes" or "object_1".
  using BeginFile = std::function<OutputFile&(const std::string& part)>;
  /// Writes the files that the main file includes according to `parts`. head: see Geometry::write().
  void write(const SceneParts& parts, const BeginFile& begin_file, std::string_view head = {}) const;

 private:
  /// A further object, which is a surface or shapes.
  struct Further {
    const SceneObject* object = nullptr;
    ObjectStyle style;
    std::optional<CutObjects> cut;
    std::optional<Geometry> geometry;
  };
  void add(const SceneObject& object, const Camera& camera, const SceneOptions& options);

  Shown shown_;
  glm::dvec3 origin_;
  ColorTable& table_;
  CutObjects cut_;
  Geometry geometry_;
  std::list<Further> further_;
  std::uint32_t finishes_ = 0;
};

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
  /// A background and shadows per frame, which replace the options' values; empty: the values of the options.
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
