// SPDX-License-Identifier: BSD-3-Clause
// A page of one file that casts the exact patches of a figure in its reader's browser, and fetches nothing.
#pragma once

#include <set>

#include <nlohmann/json.hpp>

#include "core/base/text.h"
#include "exporters/page/page_data.h"

namespace meniscus::page {

/// A figure that needs nothing else any more.
struct PackedFrame {
  std::shared_ptr<nlohmann::json> description;
  std::vector<PageTable> tables;
  std::string moment;
  std::vector<Filling> texts;  ///< of page.html
};

/// clip: at most kMostPlanes each. Throws CapacityError for a figure of more records than textures of 2048 x 8192
/// texels hold.
PackedFrame pack_frame(const PageFigure& figure, Packing packing = Packing::deflated);

/// Returns a frame that was packed plainly, for a page that is open: PageData::bytes() of which nothing is deflated.
/// Its description has the part, the stride and the digest of each table, and of the names of atoms, which are JSON.
/// known: digests of what the page has already; the part of these is null. A page that has none gets the shaders, too.
std::string bytes_for_page(const PackedFrame& frame, const std::set<std::string>& known);

/// Puts a page together. The same frames give the same text.
class PageWriter {
 public:
  /// In the order of the run. The first one is what readers see first, and has what belongs to all: title,
  /// description, facts, look, camera, names of views and of schemes.
  void add(PackedFrame frame);

  std::size_t frame_count() const { return frames_.size(); }
  std::size_t bytes() const;  ///< of the text, within a few thousand
  /// Returns the page, which has one frame at least. scene: the text of the scene that the page shows; may be empty.
  std::string text(const std::string& scene = {}) const;

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
