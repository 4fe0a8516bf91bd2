// SPDX-License-Identifier: BSD-3-Clause
// The content of a page, or of one frame of a run, and the data that the page's script reads: descriptions as JSON and
// tables of records, deflated and written as text.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "core/camera/camera.h"
#include "core/color/color_key.h"
#include "core/queries/surface_object.h"
#include "core/render/annotation.h"
#include "core/render/look.h"
#include "core/render/picture.h"
#include "core/structure/structure.h"

namespace meniscus::page {

/// Return data in zlib's format (RFC 1950).
std::string deflated(std::string_view bytes);
std::string deflated(const nlohmann::json& description);
/// Returns a description as text in UTF-8, whatever the encoding of its names.
std::string text_of(const nlohmann::json& description);

/// The form of a packed table.
enum class Packing {
  deflated,  ///< the first bytes of all records, then the second bytes and so on: similar bytes are together and
             ///< deflate well
  plain      ///< the records unchanged
};

struct PageTable {
  std::string name;
  std::size_t stride = 0;  ///< bytes of a record
  std::string packed;
};

PageTable packed_table(std::string_view name, std::span<const std::byte> bytes, std::size_t stride, Packing packing);
/// Returns a table. T: consists of 4-byte words, without padding.
template <typename T>
PageTable page_table(std::string_view name, const std::vector<T>& records, Packing packing) {
  return packed_table(name, std::as_bytes(std::span(records)), sizeof(T), packing);
}

/// Parts, deflated separately, so that a page unpacks only those that it shows. Equal parts are stored once.
class PageData {
 public:
  /// Adds a part and returns its number, by which the page finds it.
  std::size_t add(std::string packed);
  std::size_t size() const { return size_; }  ///< bytes

  /// Returns the number of parts and the length of each in four bytes, lowest first, and then the parts: `first`, and
  /// the others, which are numbered from 1.
  std::string bytes(const std::string& first) const;

 private:
  std::map<std::string, std::size_t> numbers_;
  std::vector<const std::string*> parts_;
  std::size_t size_ = 0;
};

/// Returns bytes as printable text in lines: 13 bits become two of 91 characters that have no meaning in HTML. The text
/// is a fifth longer than the bytes; base64 is a third longer.
std::string text_of_bytes(std::string_view bytes);

/// Colours that readers can choose instead of the figure's.
struct PageScheme {
  std::string name;                                ///< "chain", ...
  ColorKey key;                                    ///< the meaning of the colours
  std::vector<glm::vec3> colors;                   ///< sRGB: surface atoms, then atoms next to the surface
  std::optional<std::array<glm::vec3, 3>> kind{};  ///< Coloring::kind
  std::optional<Look> look{};                      ///< replaces the figure's look
};

/// A view that readers can choose by its name.
struct PageView {
  std::string name;
  Camera camera;
  std::vector<ClipPlane> clip{};  ///< planes that cut the surface in this view, and no others
  float opacity = 1.0f;           ///< factor of the opacity of the surface's atoms
  bool looks_inside = false;      ///< see hues_of()
};

/// An object in addition to the surface, which planes may cut; the object is opaque and complete. Surfaces have the
/// same probe, or none.
struct PageObject {
  const SurfaceObject* surface = nullptr;  ///< a surface,
  const ColoredShapes* shapes = nullptr;   ///< or shapes
  bool has_own_colors = false;             ///< true if colour schemes do not change it
};

/// The file of a picture.
struct StillPicture {
  std::string type;  ///< "image/jpeg"
  std::vector<std::uint8_t> bytes;
};

/// The content of a page at one frame. Texts may come from files; pointers must stay valid until it is written.
struct PageFigure {
  std::string title;
  std::string description;  ///< a sentence or two, for readers who cannot see the picture
  std::vector<std::pair<std::string, std::string>> facts{};  ///< rows of the page's table
  const SurfaceObject* surface = nullptr;                    ///< one copy in its final place; nullptr: no surface
  bool has_own_colors = false;                               ///< see PageObject
  std::vector<ClipPlane> clip{};                             ///< planes that cut it at first
  CapStyle cap{};                                            ///< caps at these planes
  bool thickens = false;                                     ///< PictureObject::thickens
  std::vector<PageObject> extras{};                          ///< drawn in addition to the surface
  std::span<const Atom> atoms{};  ///< SurfaceObject::atom and the atoms of shapes are indices into these
  Camera camera;                  ///< the first camera
  std::vector<PageView> views{};  ///< views in addition to the first one
  std::span<const PlaceLabel> labels{};
  glm::ivec2 size{0};  ///< size in pixels of the picture for which the look was made
  Look look;
  bool fades_always = false;  ///< depth cue everywhere; false: not where readers look inside or through the surface
  std::string scheme;         ///< the name of the colour scheme
  std::vector<PageScheme> more_schemes{};
  ColorKey key;                        ///< the meaning of its colours
  StillPicture still;                  ///< for readers without WebGL 2; empty: no picture
  std::string moment;                  ///< name of the frame, such as "frame 3", "2.500 ns"
  std::optional<glm::dvec3> origin{};  ///< origin of the records, Å; the same in a run; nothing: the middle
};

inline constexpr std::size_t kMostPlanes = 8;

}  // namespace meniscus::page
