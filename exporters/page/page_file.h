// SPDX-License-Identifier: BSD-3-Clause
// A page of one file that casts the exact patches of a figure in its reader's browser, and fetches nothing.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>

#include "core/base/text.h"
#include "core/camera/camera.h"
#include "core/color/color_key.h"
#include "core/queries/colored_shapes.h"
#include "core/queries/surface_object.h"
#include "core/render/annotation.h"
#include "core/render/look.h"
#include "core/render/picture_object.h"
#include "core/structure/structure.h"
#include "exporters/page/page_data.h"

namespace meniscus::page {

/// Colours that readers can choose instead of the figure's own.
struct PageScheme {
  std::string name;                                ///< "chain", ...
  ColorKey key;                                    ///< what they mean
  std::vector<glm::vec3> colors;                   ///< sRGB: of the surface's atoms, then of those that shapes name
  std::optional<std::array<glm::vec3, 3>> kind{};  ///< Coloring::kind
};

/// A view that readers choose by its name.
struct PageView {
  std::string name;
  Camera camera;
  std::vector<ClipPlane> clip{};  ///< cut the surface then, and no others do
  float opacity = 1.0f;           ///< of the surface, times that of its atoms
  bool looks_inside = false;      ///< as for hues_of()
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
  std::vector<ClipPlane> clip{};                             ///< cut it, at first
  CapStyle cap{};                                            ///< where they do
  bool thickens = false;                                     ///< PictureObject::thickens
  const ColoredShapes* shapes = nullptr;                     ///< of atoms; nullptr: none
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

/// A figure that needs nothing else any more.
struct PackedFrame {
  nlohmann::json description;
  std::vector<PageTable> tables;
  std::string moment;
  std::vector<Filling> texts;  ///< of page.html
};

/// clip: at most kMostPlanes each. Throws CapacityError for a figure of more records than textures of 2048 x 8192
/// texels hold.
PackedFrame pack_frame(const PageFigure& figure);

/// Puts a page together. The same frames give the same text.
class PageWriter {
 public:
  /// In the order of the run. The first one is what readers see first, and has what belongs to all: title,
  /// description, facts, look, camera, names of views and of schemes.
  void add(PackedFrame frame);

  std::size_t frame_count() const { return frames_.size(); }
  std::size_t bytes() const;  ///< of the text, within a few thousand
  std::string text() const;   ///< of one frame at least

 private:
  PageData data_;
  PackedFrame first_;
  std::size_t described_ = 0;  ///< bytes of its description
  std::vector<std::string> moments_;
  std::vector<std::size_t> frames_;  ///< parts of the data: descriptions of what differs from the first
};

/// The page of one figure.
std::string page_text(const PageFigure& figure);

}  // namespace meniscus::page
