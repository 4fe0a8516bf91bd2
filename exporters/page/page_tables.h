// SPDX-License-Identifier: BSD-3-Clause
// The records of a page's figure: primitives and their numbers, colours, marks, and the balls of atoms. The rows of
// patches are differences from rows predicted from the atoms, which deflate to half the size.
#pragma once

#include "core/render/ray_cast_pack.h"
#include "exporters/page/page_data.h"

namespace meniscus::page {

/// Coordinates (Å) and parts of unit vectors are multiples of this step, so that they take less room.
inline constexpr float kRounding = 1.0f / (1 << 17);
/// The coarser step of numbers that affect only colours: borders between atoms, and fading with depth.
inline constexpr float kColorRounding = 1.0f / (1 << 13);

using RowWords = std::array<std::uint32_t, 4>;

/// Returns the rows of a scene, whose numbers are rounded, sorted by their kind and their index in a primitive. Words
/// are bits of numbers minus bits of predicted numbers, with the sign in the lowest bit. balls: centre and radius of
/// each atom, zeros if an atom has none. probe: Å. restored_rows() in data.js is the inverse.
std::vector<RowWords> row_differences(const RayCastPack& scene, std::vector<glm::vec4> balls, double probe);

/// Returns true if planes cut the surface in any view.
bool has_cuts(const PageFigure& figure);

/// The tables of a figure. Atoms of the surface are numbered first, then atoms next to it.
class Tables {
 public:
  /// Throws CapacityError if the figure exceeds the size of textures.
  explicit Tables(const PageFigure& figure);

  const glm::dvec3& origin() const { return frame_.pivot; }  ///< origin of the records, Å
  double probe() const { return probe_; }  ///< the radius of the probe of all surfaces that have one, Å
  const PackPlacement& placement() const { return placement_; }
  std::uint32_t atom_count() const { return static_cast<std::uint32_t>(shown_.size()); }
  bool color_by_kind() const { return kind_.has_value(); }
  bool some_hidden() const { return some_hidden_; }
  bool has_marks() const;
  /// Returns the parameters of a volume map for painted.glsl, without its table; null if there is no map.
  nlohmann::json map() const;

  /// Returns, for each surface, the number of its first ball, the number of its first atom, and how many it has.
  const std::vector<std::array<std::size_t, 3>>& surfaces() const { return surfaces_; }

  std::vector<PageTable> packed(Packing packing) const;

 private:
  void find_surfaces(std::span<const PictureObject> objects);
  void check_size(std::size_t texels, const char* what) const;
  void add_surface(const SurfaceObject& object, bool whole, std::uint32_t place);
  void add_shapes(const ColoredShapes& shapes);
  void add_records(RayCastPack more, std::uint32_t place);
  void add_atoms(const Coloring& coloring, std::span<const std::uint32_t> shown);
  void round_tables();
  std::vector<glm::vec4> balls_of_atoms() const;
  void add_map();

  const PageFigure& figure_;
  const double probe_;
  PictureFrame frame_;
  PackPlacement placement_;
  RayCastPack scene_;
  std::vector<glm::vec4> colors_, balls_;
  std::vector<std::uint32_t> marks_, shown_;
  std::vector<std::uint32_t> map_;  ///< the table of painted.glsl, floats as bits
  std::vector<std::array<std::size_t, 3>> surfaces_;
  std::size_t map_atoms_ = 0, map_values_ = 0;
  std::shared_ptr<const VolumePaint> paint_;      ///< the volume map
  std::vector<std::uint32_t> has_color_;          ///< per atom: 0 if the map colours it
  std::optional<std::array<glm::vec3, 3>> kind_;  ///< Coloring::kind
  bool some_hidden_ = false;
};

}  // namespace meniscus::page
