// SPDX-License-Identifier: BSD-3-Clause
// What a page shows, or what it shows at one frame of a run; and what its script reads: descriptions as JSON and tables
// of records, deflated and written as text.
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

/// zlib's format (RFC 1950).
std::string deflated(std::string_view bytes);
std::string deflated(const nlohmann::json& description);
/// Returns a description as text, in UTF-8 whatever the encoding of its names.
std::string text_of(const nlohmann::json& description);

/// The form of a packed table.
enum class Packing {
  deflated,  ///< the first bytes of all records come first, then the second ones, and so on: what is alike in them lies
             ///< together, and deflates well
  plain      ///< the records as they are
};

struct PageTable {
  std::string name;
  std::size_t stride = 0;  ///< bytes of a record
  std::string packed;
};

PageTable packed_table(std::string_view name, std::span<const std::byte> bytes, std::size_t stride, Packing packing);
/// T: of whole words, without padding.
template <typename T>
PageTable page_table(std::string_view name, const std::vector<T>& records, Packing packing) {
  return packed_table(name, std::as_bytes(std::span(records)), sizeof(T), packing);
}

/// Parts, each deflated by itself, so that a page unpacks what it shows. Those that are equal are held once.
class PageData {
 public:
  /// Its number, by which the page finds it.
  std::size_t add(std::string packed);
  std::size_t size() const { return size_; }  ///< bytes

  /// How many parts there are, and how long each is, in four bytes each, lowest first; then the parts: `first`, and the
  /// others, which are numbered from 1.
  std::string bytes(const std::string& first) const;

 private:
  std::map<std::string, std::size_t> numbers_;
  std::vector<const std::string*> parts_;
  std::size_t size_ = 0;
};

/// Bytes as printable text: 13 bits as two of 91 characters, none of which means anything in HTML, in lines. A fifth
/// longer than the bytes, where base64 is a third longer.
std::string text_of_bytes(std::string_view bytes);

/// Colours that readers can choose instead of the figure's own.
struct PageScheme {
  std::string name;                                ///< "chain", ...
  ColorKey key;                                    ///< what they mean
  std::vector<glm::vec3> colors;                   ///< sRGB: of the surface's atoms, then of those beside it
  std::optional<std::array<glm::vec3, 3>> kind{};  ///< Coloring::kind
  std::optional<Look> look{};                      ///< instead of the figure's
};

/// A view that readers choose by its name.
struct PageView {
  std::string name;
  Camera camera;
  std::vector<ClipPlane> clip{};  ///< cut the surface then, and no others do
  float opacity = 1.0f;           ///< of the surface, times that of its atoms
  bool looks_inside = false;      ///< as for hues_of()
};

/// What stands beside the surface that planes cut and readers see through: it is opaque and whole. Surfaces have the
/// same probe, or none.
struct PageObject {
  const SurfaceObject* surface = nullptr;  ///< this one,
  const ColoredShapes* shapes = nullptr;   ///< or these
  bool has_own_colors = false;             ///< whatever scheme is chosen
};

/// A picture's file.
struct StillPicture {
  std::string type;  ///< "image/jpeg"
  std::vector<std::uint8_t> bytes;
};

/// What a page shows, or what it shows at one frame of a run. Texts may come from files; what is pointed to must stay
/// until the page is written.
struct PageFigure {
  std::string title;
  std::string description;  ///< a sentence or two, for those who do not see the picture
  std::vector<std::pair<std::string, std::string>> facts{};  ///< rows of its table
  const SurfaceObject* surface = nullptr;                    ///< where it stands, one copy; nullptr: none
  bool has_own_colors = false;                               ///< as in PageObject
  std::vector<ClipPlane> clip{};                             ///< cut it, at first
  CapStyle cap{};                                            ///< where they do
  bool thickens = false;                                     ///< PictureObject::thickens
  std::vector<PageObject> extras{};                          ///< drawn in addition to the surface
  std::span<const Atom> atoms{};  ///< SurfaceObject::atom and those of shapes are places here
  Camera camera;                  ///< at first
  std::vector<PageView> views{};  ///< beside the first one
  std::span<const PlaceLabel> labels{};
  glm::ivec2 size{0};  ///< of the picture that the look was made for, pixels
  Look look;
  bool fades_always = false;  ///< into the distance; else not where readers look inside or see through the surface
  std::string scheme;         ///< the name of its colours
  std::vector<PageScheme> more_schemes{};
  ColorKey key;                        ///< what its colours mean
  StillPicture still;                  ///< for readers without WebGL 2; empty: none
  std::string moment;                  ///< which frame it is, such as "frame 3", "2.500 ns"
  std::optional<glm::dvec3> origin{};  ///< from where the records count, Å: of a run one; nothing: in its middle
};

inline constexpr std::size_t kMostPlanes = 8;

}  // namespace meniscus::page
