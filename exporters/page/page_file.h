// SPDX-License-Identifier: BSD-3-Clause
// Makes a page of one file that casts the exact patches of a figure in the reader's browser, and fetches nothing.
#pragma once

#include <set>

#include <nlohmann/json.hpp>

#include "core/base/text.h"
#include "exporters/page/page_data.h"

namespace meniscus::page {

/// A packed figure, which depends on no other object.
struct PackedFrame {
  std::shared_ptr<nlohmann::json> description;
  std::vector<PageTable> tables;
  std::string moment;
  std::vector<Filling> texts;  ///< texts for page.html
};

/// Packs a figure. Each view may have at most kMostPlanes planes. Throws CapacityError if the figure has more records
/// than textures of 2048 x 8192 texels can hold.
PackedFrame pack_frame(const PageFigure& figure, Packing packing = Packing::deflated);

/// Returns a frame that was packed plainly, for an open page: PageData::bytes() with parts that are not deflated. Its
/// description has the part, the stride and the digest of each table, and of the names of atoms, which are JSON. known:
/// digests of tables that the page has; their part is null. A page without any gets the shaders, too.
std::string bytes_for_page(const PackedFrame& frame, const std::set<std::string>& known);

/// Writes a page from frames. The same frames give the same text.
class PageWriter {
 public:
  /// Adds a frame in the order of the run. The first one is shown first, and has the data of the whole page: title,
  /// description, facts, look, camera, names of views and of schemes.
  void add(PackedFrame frame);

  std::size_t frame_count() const { return frames_.size(); }
  std::size_t bytes() const;  ///< length of the text, to within a few thousand bytes
  /// Returns the page, which has at least one frame. scene: the text of the scene that the page shows; may be empty.
  std::string text(const std::string& scene = {}) const;

 private:
  PageData data_;
  PackedFrame first_;
  std::size_t described_ = 0;  ///< bytes of the first description
  std::vector<std::string> moments_;
  std::vector<std::size_t> frames_;  ///< parts with the differences of each frame from the first
};

/// Returns the page of one figure.
std::string page_text(const PageFigure& figure);

}  // namespace meniscus::page
