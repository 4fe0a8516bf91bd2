// SPDX-License-Identifier: BSD-3-Clause
// Text in POV-Ray's scene language: templates, numbers, vectors, and the colours of a scene: distinct colours with
// their pieces of patches, comments that name them, and volume maps; with the options of a scene, and the report of
// what was written.
#pragma once

#include <tuple>

#include "core/base/output_file.h"
#include "core/base/text.h"
#include "core/color/color_key.h"
#include "core/color/color_maps.h"
#include "core/color/coloring.h"
#include "core/queries/surface_object.h"
#include "core/render/look.h"
#include "core/render/picture.h"
#include "core/surface/primitives.h"

namespace meniscus {

/// Returns the templates of scenes, with the marks that are replaced in each:
///  main.pov      settings and lights, after the camera: NAME of the scene, SHADOWS, SOFTNESS;
///  surface.pov   a surface: GROUP ("union" or "object"), GEOMETRY and CAPS (#include statements for their files), and
///                HANDLE, the name it gets in a user's own scene;
///  map.inc       functions and colours of a volume map: FILE and the numbers that append_map() gives;
///  caps.inc      definitions before caps: DARK, the light of hatching;
///  shapes.inc    definitions before shapes;
///  frame.inc     the choice of a frame's include, after the list of frames of a run: NAME, PART, NAMED;
///  style.inc     lights and materials, after the colours;
///  buffers.inc   the buffers, after the extent of the molecule;
///  settings.ini  settings after the sizes: NAME, and PICTURE, the text between the name and the number of a picture;
///  film.ini      settings of a run, after settings.ini: NAME, COUNT of frames;
///  story.pov, story.ini  a film (povray_scene.h): NAME, WIDTH, HEIGHT, COUNT, RATE.
std::span<const TemplateFile> povray_templates();

}  // namespace meniscus

namespace meniscus::povray {

/// The materials of a surface in POV-Ray.
enum class Material {
  opaque,
  ghost,  ///< translucent; only the sides that face the viewer are drawn
  glass,  ///< refracts as one solid
  wax,    ///< light scatters below the surface
  flat    ///< unlit colours
};

/// The planes that cut a surface, and the style of the caps.
struct SurfaceCut {
  std::vector<ClipPlane> planes;  ///< empty if the surface is not cut
  CapStyle style;
};

/// A further object of a scene: a surface or shapes, with its own cut and material. The objects that it points to must
/// live until the scene is written.
struct SceneObject {
  const SurfaceObject* surface = nullptr;  ///< a surface that is neither copied nor moved, or nullptr
  const ColoredShapes* shapes = nullptr;   ///< shapes, or nullptr; exactly one of the two pointers is set
  SurfaceCut cut;                          ///< planes that cut the surface
  bool film = false;                       ///< PictureObject::thickens
  MaterialRequest material;                ///< differences from the material of the scene
};

/// The settings of a POV-Ray scene.
struct SceneOptions {
  std::string name = "surface";           ///< begins all file names; letters, digits, '-' and '_' only
  int width = 1280, height = 960;         ///< pixels
  Material material = Material::opaque;   ///< the scene's default; every scene holds all of them
  glm::vec3 background{1.0f};             ///< sRGB
  float shadows = 0.0f;                   ///< Look::shadows
  float shadow_softness = 0.0f;           ///< Look::shadow_softness
  Existing existing = Existing::refuse;   ///< the action if a file exists
  std::optional<glm::dvec3> origin;       ///< origin of the scene's coordinates, Å; empty: the middle of all atoms
  const ColoredShapes* shapes = nullptr;  ///< shapes in addition to the surface; no file if nullptr or empty
  std::vector<SceneObject> objects;       ///< further objects in addition to the surface
  SurfaceCut cut;                         ///< planes that cut the surface; a run uses the style only
  bool film = false;                      ///< true if a translucent surface is denser at grazing angles
  std::optional<ColorKey> colors;         ///< the meaning of the colours, for <name>_objects.json and for comments
  /// Empty, or a name for each of the atoms that SurfaceObject::atom refers to. Pieces then have comments with their
  /// kind and atoms. In a run, each frame has names of its own (Shown::names). Names may come from a molecule file; a
  /// name that is not harmless (harmless_name()) is left out.
  std::vector<std::string> atom_names;
};

/// A report of the written files, and of things that could not be written.
struct SceneReport {
  std::vector<std::filesystem::path> files;  ///< paths of the written files
  std::size_t object_count = 0;  ///< number of primitives without copies; a patch of several colours counts more often
  std::vector<std::string> notes;  ///< sentences about things left out or slow; empty if everything is shown
  glm::dvec3 origin{0.0};          ///< scene coordinates + origin = molecule coordinates
  std::string command;             ///< for a POSIX shell: renders the picture from any folder
};

/// Collects scene text. Numbers are written independently of the locale, in fixed notation, without trailing zeros.
/// Every member throws Error for a number that is not finite, so that a scene never contains nan or inf.
class SceneText {
 public:
  /// Appends a piece of the scene language. Text from molecule files must not be passed, except as comments made by
  /// color_comment() and piece_comment().
  SceneText& literal(std::string_view text);
  /// Appends a length in Å, rounded to 1e-6.
  SceneText& length(double value);
  /// Appends a component of a unit vector, a colour or a ratio, rounded to 1e-7.
  SceneText& ratio(double value);
  /// Appends a number with all digits of a double.
  SceneText& full(double value);
  SceneText& count(std::size_t value);
  SceneText& point(const glm::dvec3& p);        ///< <x,y,z> as lengths
  SceneText& direction(const glm::dvec3& d);    ///< <x,y,z> as ratios
  SceneText& full_vector(const glm::dvec3& v);  ///< <x,y,z> with all digits
  /// Appends `plane{...}` whose inside is dot(normal, x) <= offset. The offset is adapted to the rounded normal, so
  /// that the error of the written plane is smallest near `anchor`, however far that is from the origin.
  SceneText& plane(const Plane& p, const glm::dvec3& anchor);

  const std::string& text() const { return text_; }
  void clear() { text_.clear(); }

 private:
  SceneText& fixed(double value, int decimals);
  std::string text_;
};

/// The shown part of one patch that has one colour.
struct ColoredPiece {
  PatchKind kind = PatchKind::convex;
  std::uint32_t color = 0;  ///< index into ColorTable::colors()
  std::uint32_t part = 0;   ///< the piece belongs to the atoms with this number in Palette::atom_part
  std::uint32_t patch = 0;  ///< index into the patch table of its kind
  bool by_map = false;      ///< SceneColor::by_map of its colour
};

/// A colour of a scene together with its opacity and its finish. Two colours are the same if all members are.
struct SceneColor {
  glm::vec3 color{0.0f};     ///< sRGB
  float opacity = 1.0f;      ///< in [0, 1]
  bool by_map = false;       ///< true if points have the colours of the scene's volume map wherever it has values
  bool film = false;         ///< true if it is denser at grazing angles; has an effect for opacities below 1 only
  std::uint32_t finish = 0;  ///< 0: the finish of the scene; n: the n-th material of objects, from 1
};

/// The distinct colours of a scene.
class ColorTable {
 public:
  /// Returns the number of a colour, from 0 in order of first use, and adds the colour if it is new.
  std::uint32_t number(SceneColor color);
  /// Returns each colour once, in the order of the numbers.
  const std::vector<SceneColor>& colors() const { return colors_; }
  /// Returns true if the opacity of some colour is less than 1.
  bool is_translucent() const;

 private:
  std::map<std::tuple<float, float, float, float, bool, bool, std::uint32_t>, std::uint32_t> number_;
  std::vector<SceneColor> colors_;
};

/// The properties that all colours of one object of a scene share.
struct ObjectStyle {
  bool film = false;         ///< SceneColor::film
  std::uint32_t finish = 0;  ///< SceneColor::finish
};

/// Returns the colour of an atom's points. `color` replaces it, and a volume map then does not apply.
SceneColor scene_color(const Coloring& coloring, std::uint32_t atom, const ObjectStyle& style,
                       const std::optional<glm::vec3>& color = {});

/// All pieces of one surface in the order in which they are written: by kind, then colour, then patch.
struct Palette {
  /// The part of each atom; kNone if it is hidden. Patches are cut between atoms of different parts.
  std::vector<std::uint32_t> atom_part;
  std::vector<ColoredPiece> pieces;
};

/// Returns the pieces of a surface and adds their colours to `table`. Patches without a face, toroidal and concave
/// patches for a probe of radius 0, and parts of hidden atoms have no piece. Throws Error if the coloring does not have
/// one colour per atom.
Palette make_palette(const Surface& surface, const Coloring& coloring, ColorTable& table,
                     const ObjectStyle& style = {});

/// Returns the names of a colour in the key as a comment, such as "  // chain A, C", with at most five names. The
/// result is empty if the colour has no harmless name.
std::string color_comment(const ColorKey& key, const SceneColor& color);

/// Returns a line with the kind of a piece and its atoms: "// toroidal A ARG 34 CA; A ARG 34 CB". atoms: indices into
/// `names`. A name that is not harmless becomes "?".
std::string piece_comment(PatchKind kind, std::span<const std::uint32_t> atoms, std::span<const std::string> names);

/// The end of the map file's name, after the name of the scene.
inline constexpr std::string_view kMapFileEnding = "_map.df3";

/// Writes the values as a density file (df3) of POV-Ray: integers of 32 bits that span the range from the least value
/// to the greatest. Fewer bits would not do, because potentials inside molecules are far greater than the range of
/// colours. Throws RequestError for more than 65,535 points along an axis, the most that the format can count.
void write_density(const VolumeGrid& grid, const std::function<void(std::string_view)>& write);

/// Appends the colours of the map and the function Meniscus_Map(x,y,z), which returns 0 outside of the map and a place
/// in the colours inside it. file: the name of the file that write_density() wrote. origin: the origin of the scene's
/// coordinates, in Å.
void append_map(SceneText& out, const VolumePaint& paint, std::string_view file, const glm::dvec3& origin);

}  // namespace meniscus::povray
