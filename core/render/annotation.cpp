// SPDX-License-Identifier: BSD-3-Clause
// Places texts and lines in a picture, and blends them into its pixels according to coverage.
#include "core/render/annotation.h"

#include <iterator>
#include <limits>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/camera/camera.h"
#include "core/render/label_layout.h"

namespace meniscus {
namespace {

/// A range of whole rows of a picture.
struct RowRange {
  int first, end;

  bool meet(int low, int high) const { return low < end && high >= first; }
};

/// The coverage in [0, 1] of some rows of pixels by letters and lines. Places are pixels of the whole picture.
class InkMask {
 public:
  InkMask(int width, const RowRange& rows)
      : rows_(rows), size_(width, rows.end - rows.first), shares_(static_cast<std::size_t>(size_.x) * size_.y, 0.0f) {}

  void text(const Font& font, const std::string& text, glm::ivec2 place) {
    const int reach = 2 * font.height();  // the part of letters above and below
    if (rows_.meet(place.y - reach, place.y + reach))
      font.draw(text, place - glm::ivec2(0, rows_.first), shares_, size_);
  }

  /// Adds a line. share: the coverage of each pixel inside the line. Where lines overlap, the larger share counts.
  void line(const glm::dvec2& from, const glm::dvec2& to, double width, double share) {
    const double margin = 0.5 * width + 1.0;
    const glm::ivec2 low = glm::max(glm::ivec2(glm::floor(glm::min(from, to) - margin)), glm::ivec2(0, rows_.first));
    const glm::ivec2 high =
        glm::min(glm::ivec2(glm::ceil(glm::max(from, to) + margin)), glm::ivec2(size_.x, rows_.end) - 1);
    const glm::dvec2 along = to - from;
    const double square = std::max(glm::dot(along, along), 1e-12);
    for (int y = low.y; y <= high.y; ++y)
      for (int x = low.x; x <= high.x; ++x) {
        const glm::dvec2 here = glm::dvec2(x, y) + 0.5 - from;
        const double t = std::clamp(glm::dot(here, along) / square, 0.0, 1.0);
        cover(x, y,
              static_cast<float>(share * std::clamp(0.5 * width + 0.5 - glm::length(here - t * along), 0.0, 1.0)));
      }
  }

  void box(glm::ivec2 low, glm::ivec2 high) {
    for (int y = std::max(low.y, rows_.first); y < std::min(high.y, rows_.end); ++y)
      for (int x = std::max(low.x, 0); x < std::min(high.x, size_.x); ++x) cover(x, y, 1.0f);
  }

  /// Draws the mask in the colour `ink` over those rows of the picture that it covers, and a rim of another colour
  /// around it where the picture is already covered. The mask must contain all rows of the picture within rim_width of
  /// these rows.
  void lay_over(Framebuffer& picture, int first_row, const glm::vec3& ink, const glm::vec3& rim, int rim_width) const {
    const std::vector<float> rims = thickened(rim_width);
    const std::size_t before = index(0, first_row);
    for (std::size_t n = 0; n < picture.color.size(); ++n) {
      const float rim_share = rims[before + n], ink_share = shares_[before + n];
      if (rim_share == 0.0f) continue;
      glm::vec4& pixel = picture.color[n];
      const float share = rim_share * pixel.w;
      pixel = glm::vec4(rim * share, share) + (1.0f - share) * pixel;
      pixel = glm::vec4(ink * ink_share, ink_share) + (1.0f - ink_share) * pixel;
    }
  }

 private:
  std::size_t index(int x, int y) const { return static_cast<std::size_t>(y - rows_.first) * size_.x + x; }

  void cover(int x, int y, float share) {
    float& covered = shares_[index(x, y)];
    covered = std::max(covered, std::clamp(share, 0.0f, 1.0f));
  }

  /// Returns the mask thickened by `width` pixels: each pixel gets the largest coverage around it, which decreases
  /// towards the edge of the rim.
  std::vector<float> thickened(int width) const {
    std::vector<float> result = shares_;
    for (int y = rows_.first; y < rows_.end; ++y)
      for (int x = 0; x < size_.x; ++x) {
        const float share = shares_[index(x, y)];
        if (share == 0.0f) continue;
        for (int v = std::max(y - width, rows_.first); v <= std::min(y + width, rows_.end - 1); ++v)
          for (int u = std::max(x - width, 0); u <= std::min(x + width, size_.x - 1); ++u) {
            const float distance = std::hypot(static_cast<float>(u - x), static_cast<float>(v - y));
            float& there = result[index(u, v)];
            there = std::max(there, share * std::clamp(static_cast<float>(width) + 0.5f - distance, 0.0f, 1.0f));
          }
      }
    return result;
  }

  RowRange rows_;
  glm::ivec2 size_;
  std::vector<float> shares_;
};

/// A coarse grid of cells that shows where the molecule is in the picture.
class CoveredGround {
 public:
  CoveredGround(const std::vector<glm::vec4>& atoms, const Camera& camera, glm::ivec2 molecule_size, int top)
      : cell_(std::max(2, std::min(molecule_size.x, molecule_size.y) / 120)),
        size_((molecule_size + glm::ivec2(cell_ - 1)) / cell_),
        top_(top),
        cells_(static_cast<std::size_t>(size_.x) * size_.y, false) {
    const glm::dvec3 right = view_basis(camera).right;
    for (const glm::vec4& atom : atoms) {
      const glm::dvec3 center(atom);
      const auto middle = place_in_picture(camera, molecule_size, center);
      const auto rim = place_in_picture(camera, molecule_size, center + static_cast<double>(atom.w) * right);
      if (middle && rim) cover(*middle / static_cast<double>(cell_), glm::distance(*middle, *rim) / cell_);
    }
  }

  /// Returns the share of a box that the molecule covers.
  double operator()(const PixelBox& box) const {
    int covered = 0, all = 0;
    for (int y = (box.low.y - top_) / cell_; y <= (box.high.y - top_) / cell_; ++y)
      for (int x = box.low.x / cell_; x <= box.high.x / cell_; ++x) {
        ++all;
        covered += x >= 0 && y >= 0 && x < size_.x && y < size_.y && cells_[index(x, y)];
      }
    return static_cast<double>(covered) / all;
  }

 private:
  std::size_t index(int x, int y) const { return static_cast<std::size_t>(y) * size_.x + x; }

  void cover(const glm::dvec2& middle, double radius) {
    const glm::dvec2 first = glm::max(middle - radius, glm::dvec2(0.0));
    const glm::dvec2 last = glm::min(middle + radius, glm::dvec2(size_) - 1.0);
    for (int y = static_cast<int>(first.y); y <= static_cast<int>(std::floor(last.y)); ++y)
      for (int x = static_cast<int>(first.x); x <= static_cast<int>(std::floor(last.x)); ++x)
        if (glm::distance(glm::dvec2(x, y) + 0.5, middle) <= radius + 0.5) cells_[index(x, y)] = true;
  }

  int cell_;  // size of a cell, pixels
  glm::ivec2 size_;
  int top_;
  std::vector<bool> cells_;
};

constexpr std::size_t kNotDrawn = std::numeric_limits<std::size_t>::max();  ///< index of a label without a mark

/// Places texts in the corners, and labels next to the places that they name.
class Writer {
 public:
  Writer(const glm::ivec2& size, const Strips& strips, const LetterStyle& style, const Camera& camera, FontShelf& fonts)
      : camera_(camera),
        size_(size),
        strips_(strips),
        molecule_size_(size - glm::ivec2(0, strips.top + strips.bottom)),
        style_(style),
        heights_(style, size),
        fonts_(fonts) {}

  const LetterHeights& heights() const { return heights_; }
  std::vector<InkStroke> strokes() { return std::move(strokes_); }
  std::vector<StrokeGroup> groups() { return std::move(groups_); }
  std::vector<std::size_t> marks() { return std::move(marks_); }

  void panel(const std::string& text) {
    begin("panel-letter");
    const int height = heights_.panel;
    write({text, {from_border(height / 2), panel_row(heights_, style_)}, height, Weight::bold});
  }

  /// Writes the title between the letter of the panel and the time, in smaller letters if the room is too small.
  void title(const std::string& text) {
    begin("title");
    int left = from_border(heights_.usual / 2), right = size_.x - left;
    for (const PixelBox& box : taken_) {
      const int margin = heights_.usual;
      if (2 * box.low.x < size_.x)
        left = std::max(left, box.high.x + margin);
      else
        right = std::min(right, box.low.x - margin);
    }
    int height = heights_.title;
    while (height > kLeastTitle && fonts_.at(height).width(text) > right - left) --height;
    const int width = fonts_.at(height).width(text);
    if (width > right - left)
      throw RequestError(
          message("@title@: {} is {} pixels long, but there is room for {}; use a shorter title or a wider picture",
                  in_quotes(text), width, right - left));
    write({text, {std::clamp((size_.x - width) / 2, left, right - width), panel_row(heights_, style_)}, height});
  }

  void time(const std::string& text) {
    begin("time");
    const int em = heights_.usual, row = std::max(em, style_.border + em / 2);
    write({text, {size_.x - from_border(em) - fonts_.at(em).width(text), row}, em});
  }

  void scale_bar(const std::optional<double>& asked) {
    begin("scale-bar");
    const double unit = angstroms_per_pixel(camera_, molecule_size_);
    const double length = asked.value_or(round_length(0.25 * size_.x * unit));
    const int em = heights_.scale_bar, edge = from_border(em), thickness = std::max(2, em / 5),
              pixels = static_cast<int>(std::lround(length / unit));
    if (pixels < 1 || pixels > size_.x - 2 * edge)
      throw RequestError(
          message("@scale-bar@: {:g} Å would be {} pixels in a picture that is {} wide; give another length", length,
                  pixels, size_.x));
    const PixelBox bar{{edge, size_.y - edge - thickness}, {edge + pixels, size_.y - edge}};
    strokes_.emplace_back(bar);
    const std::string text = fmt::format("{:g} Å", length);
    const int left = std::max(edge, edge + (pixels - fonts_.at(em).width(text)) / 2);
    write({text, {left, bar.low.y - em}, em});
    taken_.push_back(bar);
  }

  /// Draws the curve. Its smallest and largest values are written to its left, the present value above it.
  void curve(const Curve& curve) {
    begin("curve");
    const auto ends = std::ranges::minmax(curve.values);
    const double least = ends.min, greatest = ends.max;
    const double range = greatest - least, em = heights_.usual, line = std::max(1.0, em / 12.0);
    const int decimals = range > 0.0 ? std::clamp(static_cast<int>(std::ceil(2.0 - std::log10(range))), 0, 9) : 3;
    const auto number = [&](double value) { return fmt::format("{:.{}f}", value, decimals); };
    const int edge = from_border(heights_.usual);
    const glm::dvec2 high(size_.x - edge, size_.y - edge),
        low(high.x - 0.3 * size_.x, high.y - curve_height(heights_, size_));
    const auto place = [&](std::size_t n) {
      const double across =
          curve.values.size() > 1 ? static_cast<double>(n) / static_cast<double>(curve.values.size() - 1) : 0.5;
      const double up = range > 0.0 ? (curve.values[n] - least) / range : 0.5;
      return glm::dvec2(low.x + across * (high.x - low.x), high.y - up * (high.y - low.y));
    };
    draw_line({low.x, low.y}, {low.x, high.y}, line, 0.5);
    draw_line({low.x, high.y}, {high.x, high.y}, line, 0.5);
    for (std::size_t n = 1; n < curve.values.size(); ++n)
      draw_line(place(n - 1), place(n), n <= curve.now ? 1.8 * line : line, n <= curve.now ? 1.0 : 0.45);
    draw_line(place(curve.now), place(curve.now), 0.5 * em);
    const Font &font = fonts_.at(heights_.usual), &small = fonts_.at(heights_.small);
    const int row = heights_.usual, left = static_cast<int>(low.x), right = static_cast<int>(high.x),
              above = static_cast<int>(low.y - em);
    const auto width = [&](double value) { return font.width(number(value)); };
    // The width reserved for the number is constant, so the title does not move from frame to frame.
    const int widest = std::max({width(least), width(greatest), width(curve.values[curve.now])});
    write({curve.title, {right - widest - row / 2 - font.width(curve.title), above}, row});
    write({number(curve.values[curve.now]), {right - width(curve.values[curve.now]), above}, row});
    for (const double end : {least, greatest}) {
      const std::string text = number(end);
      const double y = end == greatest ? low.y : high.y;
      write({text, {left - small.height() / 2 - small.width(text), static_cast<int>(y)}, small.height()});
    }
    taken_.push_back({glm::ivec2(low), glm::ivec2(high)});
  }

  /// Adds the labels of places that are visible in the picture. If the user set no size, letters shrink until the
  /// labels fit. Returns false if they do not fit at any size.
  bool labels(const std::vector<PlaceLabel>& labels, const std::vector<glm::vec4>& atoms) {
    begin("labels");
    std::vector<const PlaceLabel*> shown;
    std::vector<UnplacedLabel> unplaced;
    for (const PlaceLabel& label : labels) {
      const std::optional<glm::dvec2> seen = place_of(label.position);
      if (!seen || label.is_length()) continue;
      shown.push_back(&label);
      unplaced.push_back({*seen, {}});
    }
    marks_.assign(labels.size(), kNotDrawn);
    if (shown.empty()) return true;
    LabelGround ground;
    ground.taken = taken_;
    ground.covered = CoveredGround(atoms, camera_, molecule_size_, strips_.top);
    constexpr int kSmallest = 8;  // pixels
    const bool is_chosen = style_.labels || style_.all;
    for (int em = heights_.labels; em >= (is_chosen ? heights_.labels : kSmallest);
         em = std::min(em - 1, 9 * em / 10)) {
      const double width = label_line(em);
      // The border of the picture is as far as letters are high, that of a strip with its own margin need not be.
      const int edge = from_border(em);
      const auto margin = [&](int strip) { return strip > 0 ? strip + em / 4 : edge; };
      ground.room = {{edge, margin(strips_.top)}, {size_.x - edge, size_.y - margin(strips_.bottom)}};
      ground.gap = 0.5 * em;
      ground.dot = 2.0 * width;
      for (std::size_t n = 0; n < shown.size(); ++n)
        unplaced[n].extent = {fonts_.at(em).width(shown[n]->text), em + em / 4};
      const std::optional<std::vector<PixelBox>> boxes = place_labels(unplaced, ground);
      if (!boxes) continue;
      for (std::size_t n = 0; n < shown.size(); ++n) {
        const PixelBox& box = (*boxes)[n];
        draw_line(leader_start(box, unplaced[n], ground), unplaced[n].anchor, width);
        marks_[static_cast<std::size_t>(shown[n] - labels.data())] = strokes_.size();
        draw_line(unplaced[n].anchor, unplaced[n].anchor, 4.0 * width);
        write({shown[n]->text, {box.low.x, (box.low.y + box.high.y) / 2}, em});
      }
      return true;
    }
    return false;
  }

  /// Writes the lengths of dashed lines next to their middles. A length is left out if both places for it are taken.
  void lengths(const std::vector<PlaceLabel>& labels) {
    const int em = std::max(kLeastTitle, 3 * heights_.labels / 4);
    const PixelBox room{{0, strips_.top}, {size_.x, size_.y - strips_.bottom}};
    for (std::size_t n = 0; n < labels.size(); ++n) {
      const std::optional<glm::dvec2> middle = place_of(labels[n].position),
                                      end = place_of(labels[n].position + labels[n].along);
      if (!labels[n].is_length() || !middle || !end || *middle == *end) continue;
      const glm::dvec2 way = *end - *middle, half = 0.5 * glm::dvec2(fonts_.at(em).width(labels[n].text), em);
      const glm::dvec2 across = glm::normalize(glm::dvec2(way.y, -way.x)) * (way.x < 0.0 ? -1.0 : 1.0);
      for (const double side : {1.0, -1.0}) {
        const glm::dvec2 place = *middle + side * (glm::dot(glm::abs(across), half) + 0.4 * em) * across;
        const PixelBox box = PixelBox{glm::ivec2(place - half), glm::ivec2(place + half)}.grown(em / 6);
        const auto meets = [&](const PixelBox& taken) { return taken.meets(box); };
        if (marks_[n] != kNotDrawn || glm::max(box.low, room.low) != box.low ||
            glm::min(box.high, room.high) != box.high || std::ranges::any_of(taken_, meets))
          continue;
        marks_[n] = strokes_.size();
        write({labels[n].text, glm::ivec2(place.x - half.x, place.y), em});
      }
    }
  }

  static constexpr int kLeastTitle = 8;  // pixels, the smallest title
  /// Returns the row of the middles of the panel's letter and the title.
  static int panel_row(const LetterHeights& heights, const LetterStyle& style) {
    return std::max(heights.panel, style.border + heights.panel / 2);
  }
  static double curve_height(const LetterHeights& heights, glm::ivec2 size) {
    return std::max(3.0 * heights.usual, 0.1 * size.y);
  }
  static double label_line(int em) { return std::max(1.0, em / 14.0); }

 private:
  /// Returns the distance of a text or bar from the border: `usual`, or more on paper.
  int from_border(int usual) const { return std::max(usual, style_.border); }
  void begin(std::string_view group) { groups_.push_back({group, strokes_.size()}); }

  /// Returns the pixel of a point; nothing if the picture does not have it.
  std::optional<glm::dvec2> place_of(const glm::dvec3& point) const {
    const std::optional<glm::dvec2> seen = place_in_picture(camera_, molecule_size_, point);
    if (!seen || seen->x < 0.0 || seen->y < 0.0 || seen->x > molecule_size_.x || seen->y > molecule_size_.y) return {};
    return *seen + glm::dvec2(0.0, strips_.top);
  }

  void draw_line(const glm::dvec2& from, const glm::dvec2& to, double width, double share = 1.0) {
    strokes_.emplace_back(InkLine{from, to, width, share});
  }

  void write(InkText text) {
    const int half = text.height / 2;
    taken_.push_back(
        {text.place - glm::ivec2(0, half), text.place + glm::ivec2(fonts_.of(text).width(text.text), half)});
    strokes_.emplace_back(std::move(text));
  }

  const Camera& camera_;
  const glm::ivec2 size_;
  const Strips strips_;
  const glm::ivec2 molecule_size_;
  const LetterStyle& style_;
  const LetterHeights heights_;
  FontShelf& fonts_;
  std::vector<InkStroke> strokes_;
  std::vector<StrokeGroup> groups_;
  std::vector<std::size_t> marks_;
  std::vector<PixelBox> taken_;
};

}  // namespace

double angstroms_per_pixel(const Camera& camera, glm::ivec2 size) {
  if (camera.projection == Projection::orthographic) return camera.height / size.y;
  const double angle = camera.vertical_fov * std::numbers::pi / 180.0;
  return 2.0 * std::tan(0.5 * angle) * glm::distance(camera.position, camera.target) / size.y;
}

std::optional<glm::dvec2> place_in_picture(const Camera& camera, glm::ivec2 size, const glm::dvec3& point) {
  const ViewBasis basis = view_basis(camera);
  const glm::dvec3 to = point - camera.position;
  const double depth = glm::dot(to, basis.forward);
  double unit = angstroms_per_pixel(camera, size);
  if (camera.projection == Projection::perspective) {
    if (depth <= 1e-9) return {};
    unit *= depth / glm::distance(camera.position, camera.target);
  }
  return 0.5 * glm::dvec2(size) + glm::dvec2(glm::dot(to, basis.right), -glm::dot(to, basis.up)) / unit;
}

double round_length(double most) {
  const double power = std::pow(10.0, std::floor(std::log10(most)));
  for (const double factor : {5.0, 2.0})
    if (factor * power <= most) return factor * power;
  return power;
}

Strips strips_for(const StripContents& contents, const LetterStyle& letters, glm::ivec2 size) {
  const LetterHeights heights(letters, size);
  Strips strips;
  if (contents.time) strips.top = std::max(2 * heights.usual, letters.border + 3 * heights.usual / 2);
  if (contents.panel || contents.title)
    strips.top = std::max(strips.top, Writer::panel_row(heights, letters) + 3 * heights.panel / 5);
  if (contents.curve)
    strips.bottom = static_cast<int>(Writer::curve_height(heights, size)) + 2 * heights.usual +
                    std::max(heights.usual, letters.border);
  const bool is_room_left = 2 * (size.y - strips.top - strips.bottom) >= size.y;
  return is_room_left ? strips : Strips{};
}

StripContents strip_contents(const Annotations& annotations) {
  return {!annotations.panel.empty(), !annotations.title.empty(), !annotations.time.empty(),
          annotations.curve.has_value()};
}

AnnotationLayer::AnnotationLayer(const Annotations& annotations, const Camera& camera, glm::ivec2 picture_size,
                                 const std::optional<glm::vec3>& background, const Strips& strips)
    : inks_(inks_on(background, annotations.letters.color)), height_(picture_size.y), fonts_(annotations.letters.font) {
  if (!annotations.any()) return;
  Writer writer(picture_size, strips, annotations.letters, camera, fonts_);
  if (!annotations.panel.empty()) writer.panel(annotations.panel);
  if (!annotations.time.empty()) writer.time(annotations.time);
  if (!annotations.title.empty()) writer.title(annotations.title);
  if (annotations.curve) writer.curve(*annotations.curve);
  if (annotations.scale_bar) writer.scale_bar(annotations.bar_length);
  lacks_labels_ = !writer.labels(annotations.labels, annotations.atoms);
  if (lacks_labels_ && annotations.labels_must_fit)
    throw RequestError(
        message("@label@: {} x {} pixels have no room for all labels without overlaps; use fewer or shorter labels, "
                "smaller letters (@label-size@), or a larger picture",
                picture_size.x, picture_size.y));
  writer.lengths(annotations.labels);
  strokes_ = writer.strokes();
  groups_ = writer.groups();
  marks_ = writer.marks();
  hollow(annotations.labels);
  rim_width_ = std::max(1, writer.heights().usual / 9);
}

void AnnotationLayer::hollow(std::span<const PlaceLabel> labels) {
  constexpr int kSides = 24;
  for (std::size_t n = 0; n < marks_.size(); ++n) {
    if (!labels[n].is_hidden || marks_[n] == kNotDrawn) continue;
    if (labels[n].is_length()) {
      std::get<InkText>(strokes_[marks_[n]]).text.clear();
      continue;
    }
    InkLine &line = std::get<InkLine>(strokes_[marks_[n] - 1]), &mark = std::get<InkLine>(strokes_[marks_[n]]);
    const glm::dvec2 middle = mark.from, along = line.to - line.from;
    const double radius = 0.75 * mark.width;
    if (glm::length(along) > radius) line.to -= radius * glm::normalize(along);
    const auto corner = [&](int side) {
      const double angle = 2.0 * std::numbers::pi * side / kSides;
      return middle + radius * glm::dvec2(std::cos(angle), std::sin(angle));
    };
    mark = {corner(0), corner(1), line.width};
    for (int side = 1; side < kSides; ++side)
      strokes_.emplace_back(InkLine{corner(side), corner(side + 1), std::get<InkLine>(strokes_[marks_[n]]).width});
    marks_[n] = kNotDrawn;
  }
}

std::string_view AnnotationLayer::group_of(std::size_t stroke) const {
  const auto next = std::ranges::find_if(groups_, [stroke](const StrokeGroup& group) { return group.first > stroke; });
  return std::prev(next)->name;
}

void AnnotationLayer::lay_over(Framebuffer& rows, int first_row) const {
  if (strokes_.empty()) return;
  InkMask mask(rows.size.x,
               {std::max(first_row - rim_width_, 0), std::min(first_row + rows.size.y + rim_width_, height_)});
  for (const InkStroke& stroke : strokes_) {
    if (const auto* const text = std::get_if<InkText>(&stroke))
      mask.text(fonts_.of(*text), text->text, text->place);
    else if (const auto* const line = std::get_if<InkLine>(&stroke))
      mask.line(line->from, line->to, line->width, line->share);
    else if (const auto* const box = std::get_if<PixelBox>(&stroke))
      mask.box(box->low, box->high);
  }
  mask.lay_over(rows, first_row, linear_from_srgb(inks_.ink), linear_from_srgb(inks_.rim), rim_width_);
}

bool annotate(Framebuffer& picture, const Annotations& annotations, const Camera& camera,
              const std::optional<glm::vec3>& background, const Strips& strips) {
  const AnnotationLayer written(annotations, camera, picture.size, background, strips);
  written.lay_over(picture, 0);
  return !written.lacks_labels();
}

}  // namespace meniscus
