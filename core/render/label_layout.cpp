// SPDX-License-Identifier: BSD-3-Clause
// Chooses among places around each anchor, and moves labels that overlap others until none do.
#include "core/render/label_layout.h"

#include <cmath>
#include <limits>
#include <numbers>

namespace meniscus {
namespace {

/// A line from a label to its anchor.
struct Segment {
  glm::dvec2 from, to;
};

double cross(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }

double distance(const glm::dvec2& point, const Segment& line) {
  const glm::dvec2 along = line.to - line.from;
  const double square = glm::dot(along, along);
  const double t = square > 0.0 ? std::clamp(glm::dot(point - line.from, along) / square, 0.0, 1.0) : 0.0;
  return glm::distance(point, line.from + t * along);
}

bool cross(const Segment& a, const Segment& b) {
  const auto sides = [](const Segment& line, const Segment& other) {
    const glm::dvec2 along = line.to - line.from;
    return cross(along, other.from - line.from) * cross(along, other.to - line.from);
  };
  return sides(a, b) < 0.0 && sides(b, a) < 0.0;
}

double distance(const Segment& a, const Segment& b) {
  if (cross(a, b)) return 0.0;
  return std::min({distance(a.from, b), distance(a.to, b), distance(b.from, a), distance(b.to, a)});
}

/// True if a line passes through a box: after clipping at the four sides of the box, part of the line remains.
bool meets(const Segment& line, const PixelBox& box) {
  double begin = 0.0, end = 1.0;
  const glm::dvec2 along = line.to - line.from, low(box.low), high(box.high);
  for (int axis = 0; axis < 2; ++axis) {
    if (along[axis] == 0.0) {
      if (line.from[axis] <= low[axis] || line.from[axis] >= high[axis]) return false;
      continue;
    }
    const double a = (low[axis] - line.from[axis]) / along[axis], b = (high[axis] - line.from[axis]) / along[axis];
    begin = std::max(begin, std::min(a, b));
    end = std::min(end, std::max(a, b));
  }
  return begin < end;
}

/// A possible place of a label.
struct Place {
  PixelBox box;
  Segment line;
  double cost = 0.0;
};

class LabelPlacer {
 public:
  LabelPlacer(std::span<const UnplacedLabel> labels, const LabelGround& ground) : labels_(labels), ground_(ground) {}

  Place place_of(std::size_t label, const PixelBox& box) const {
    return {box, {leader_start(box, labels_[label], ground_), labels_[label].anchor}};
  }

  /// True if a label would overlap or cross anything that was placed before all labels.
  bool is_blocked(std::size_t label, const Place& place) const {
    const int gap = static_cast<int>(std::lround(0.5 * ground_.gap));
    for (const PixelBox& taken : ground_.taken)
      if (taken.grown(gap).meets(place.box) || meets(place.line, taken.grown(gap))) return true;
    const PixelBox around = place.box.grown(static_cast<int>(std::ceil(ground_.dot)));
    for (std::size_t n = 0; n < labels_.size(); ++n) {
      const glm::dvec2 anchor = labels_[n].anchor;
      if (anchor.x > around.low.x && anchor.x < around.high.x && anchor.y > around.low.y && anchor.y < around.high.y)
        return true;
      const double apart = glm::distance(anchor, labels_[label].anchor);
      if (n != label && apart > 0.0 && distance(anchor, place.line) < std::min(1.5 * ground_.dot, 0.7 * apart))
        return true;
    }
    return false;
  }

  bool do_meet(std::size_t one, const Place& a, std::size_t other, const Place& b) const {
    const int gap = static_cast<int>(std::lround(0.5 * ground_.gap));
    if (a.box.grown(gap).meets(b.box.grown(gap))) return true;
    if (meets(a.line, b.box.grown(gap)) || meets(b.line, a.box.grown(gap))) return true;
    // Lines to the same anchor meet there and may do so.
    const double apart = glm::distance(labels_[one].anchor, labels_[other].anchor);
    return apart > 0.0 && distance(a.line, b.line) < std::min(0.75 * ground_.dot, 0.5 * apart);
  }

  /// Returns all places of a label that nothing blocks, the best first.
  std::vector<Place> places(std::size_t label) const {
    std::vector<Place> found;
    const glm::ivec2 extent = labels_[label].extent, first = ground_.room.low, last = ground_.room.high - extent;
    if (last.x < first.x || last.y < first.y) return found;
    const glm::dvec2 anchor = labels_[label].anchor, half = 0.5 * glm::dvec2(extent);
    const auto add = [&](const glm::ivec2& low) {
      const PixelBox box{low, low + extent};
      Place place = place_of(label, box);
      if (is_blocked(label, place)) return;
      place.cost = cost(place);
      found.push_back(place);
    };
    for (const double share : kDistances)
      for (int n = 0; n < kDirections; ++n) {
        const double angle = 2.0 * std::numbers::pi * n / kDirections;
        const glm::dvec2 direction(std::cos(angle), std::sin(angle));
        // The distance from the middle of the box to its rim in this direction.
        const double reach =
            std::min(half.x / std::max(std::abs(direction.x), 1e-9), half.y / std::max(std::abs(direction.y), 1e-9));
        const glm::dvec2 middle = anchor + direction * (reach + ground_.gap + ground_.dot + share * side());
        const glm::ivec2 low(glm::round(middle - half));
        if (glm::clamp(low, first, last) == low) add(low);
      }
    // The left and right sides of the picture have room for many labels.
    for (int y = first.y; y <= last.y; y += extent.y + static_cast<int>(ground_.gap))
      for (const int x : {first.x, last.x}) add({x, y});
    std::ranges::stable_sort(found, {}, &Place::cost);
    return found;
  }

 private:
  static constexpr int kDirections = 24;
  /// Distances of labels from their anchors, as shares of the picture's shorter side.
  static constexpr std::array kDistances{0.03, 0.06, 0.1, 0.14, 0.19, 0.25, 0.32, 0.4, 0.5, 0.62};

  double side() const {
    const glm::ivec2 size = ground_.room.high - ground_.room.low;
    return std::min(size.x, size.y);
  }

  double cost(const Place& place) const {
    const glm::dvec2 out = place.line.to - 0.5 * glm::dvec2(ground_.room.low + ground_.room.high);
    const glm::dvec2 way = place.line.from - place.line.to;
    const double both = glm::length(out) * glm::length(way);
    const double turned = both > 0.0 ? 1.0 - glm::dot(out, way) / both : 1.0;
    return glm::length(way) / side() + 0.5 * ground_.covered(place.box) + 0.1 * turned;
  }

  std::span<const UnplacedLabel> labels_;
  const LabelGround& ground_;
};

/// Moves one label after another to the place with the fewest overlaps. The weight of an overlap grows as long as it
/// persists, so that labels do not move in circles.
class LabelSearch {
 public:
  LabelSearch(const LabelPlacer& placer, std::vector<std::vector<Place>> places)
      : placer_(placer),
        places_(std::move(places)),
        chosen_(places_.size(), 0),
        weight_(places_.size() * places_.size(), 1.0) {}

  bool run() {
    const std::size_t count = places_.size();
    for (std::size_t label = 0; label < count; ++label) choose(label, label);
    const std::size_t most_steps = std::min<std::size_t>(60 * count, 3000);
    for (std::size_t step = 0, next = 0; step < most_steps; ++step) {
      std::size_t meeting = count;
      for (std::size_t n = 0; n < count && meeting == count; ++n)
        if (meets_any((next + n) % count)) meeting = (next + n) % count;
      if (meeting == count) {
        improve();
        return true;
      }
      for (std::size_t other = 0; other < count; ++other)
        if (other != meeting && do_meet(meeting, chosen(meeting), other)) weight(meeting, other) += 1.0;
      choose(meeting, count);
      next = meeting + 1;
    }
    return false;
  }

  std::vector<PixelBox> boxes() const {
    std::vector<PixelBox> boxes;
    for (std::size_t n = 0; n < places_.size(); ++n) boxes.push_back(chosen(n).box);
    return boxes;
  }

 private:
  const Place& chosen(std::size_t label) const { return places_[label][chosen_[label]]; }
  double& weight(std::size_t a, std::size_t b) { return weight_[std::min(a, b) * places_.size() + std::max(a, b)]; }
  bool do_meet(std::size_t label, const Place& place, std::size_t other) const {
    return placer_.do_meet(label, place, other, chosen(other));
  }
  bool meets_any(std::size_t label) const {
    for (std::size_t other = 0; other < places_.size(); ++other)
      if (other != label && do_meet(label, chosen(label), other)) return true;
    return false;
  }

  /// Moves a label to its best place, with regard to the first `count` labels only.
  void choose(std::size_t label, std::size_t count) {
    double least = std::numeric_limits<double>::max();
    std::size_t best = chosen_[label];
    for (std::size_t n = 0; n < places_[label].size(); ++n) {
      const Place& place = places_[label][n];
      double sum = place.cost;
      for (std::size_t other = 0; other < count && sum < least; ++other)
        if (other != label && do_meet(label, place, other)) sum += kMeeting * weight(label, other);
      if (sum >= least) continue;
      least = sum;
      best = n;
    }
    chosen_[label] = best;
  }

  /// Moves labels nearer to their anchors where nothing is in the way.
  void improve() {
    for (int round = 0; round < 3; ++round)
      for (std::size_t label = 0; label < places_.size(); ++label)
        for (std::size_t n = 0; n < chosen_[label]; ++n) {
          const std::size_t before = std::exchange(chosen_[label], n);
          if (!meets_any(label)) break;
          chosen_[label] = before;
        }
  }

  static constexpr double kMeeting = 10.0;
  const LabelPlacer& placer_;
  std::vector<std::vector<Place>> places_;
  std::vector<std::size_t> chosen_;
  std::vector<double> weight_;  ///< weights of pairs of labels
};

}  // namespace

glm::dvec2 leader_start(const PixelBox& box, const UnplacedLabel& label, const LabelGround& ground) {
  const double gap = 0.25 * ground.gap;
  return glm::clamp(label.anchor, glm::dvec2(box.low) - gap, glm::dvec2(box.high) + gap);
}

int count_meetings(std::span<const UnplacedLabel> labels, std::span<const PixelBox> boxes, const LabelGround& ground) {
  const LabelPlacer placer(labels, ground);
  int count = 0;
  for (std::size_t a = 0; a < labels.size(); ++a) {
    count += placer.is_blocked(a, placer.place_of(a, boxes[a]));
    for (std::size_t b = a + 1; b < labels.size(); ++b)
      count += placer.do_meet(a, placer.place_of(a, boxes[a]), b, placer.place_of(b, boxes[b]));
  }
  return count;
}

std::optional<std::vector<PixelBox>> place_labels(std::span<const UnplacedLabel> labels, const LabelGround& ground) {
  const LabelPlacer placer(labels, ground);
  std::vector<std::vector<Place>> places;
  for (std::size_t n = 0; n < labels.size(); ++n) {
    places.push_back(placer.places(n));
    if (places.back().empty()) return std::nullopt;
  }
  LabelSearch search(placer, std::move(places));
  if (!search.run()) return std::nullopt;
  return search.boxes();
}

}  // namespace meniscus
