// SPDX-License-Identifier: BSD-3-Clause
// Checks and opens trajectories, joins several into one, and computes boxes from edges and angles.
#include "core/trajectory/trajectory.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/base/text_file.h"

namespace meniscus {

std::optional<glm::dmat3> cell_of_cosines(const glm::dvec3& edges, const glm::dvec3& cosines) {
  if (!(edges.x > 0.0 && edges.y > 0.0 && edges.z > 0.0)) return std::nullopt;
  const double sine = std::sqrt(1.0 - cosines.z * cosines.z);
  const double x = cosines.y, y = (cosines.x - cosines.y * cosines.z) / sine;
  const double height = std::sqrt(1.0 - x * x - y * y);  // NaN if the angles do not fit together
  return cell_of_vectors(glm::dmat3(glm::dvec3(edges.x, 0.0, 0.0), edges.y * glm::dvec3(cosines.z, sine, 0.0),
                                    edges.z * glm::dvec3(x, y, height)));
}

std::optional<glm::dmat3> cell_of_angles(const glm::dvec3& edges, const glm::dvec3& degrees) {
  glm::dvec3 cosines;
  for (int n = 0; n < 3; ++n) {
    if (!(degrees[n] > 0.0 && degrees[n] < 180.0)) return std::nullopt;
    // The sine of the complement is used, because the cosine of pi/2 is not zero in double precision.
    cosines[n] = std::sin((90.0 - degrees[n]) * (std::numbers::pi / 180.0));
  }
  return cell_of_cosines(edges, cosines);
}

std::optional<glm::dmat3> cell_of_vectors(const glm::dmat3& vectors) {
  const double volume = std::abs(glm::determinant(vectors));
  if (!(volume > 0.0) || !std::isfinite(volume)) return std::nullopt;
  return vectors;
}

namespace {

void check_positions(const Frame& frame, std::uint64_t number, const std::string& path) {
  for (std::size_t n = 0; n < frame.positions.size(); ++n) {
    for (int axis = 0; axis < 3; ++axis) {
      const double coordinate = frame.positions[n][axis];
      if (std::abs(coordinate) <= kLargestCoordinate) continue;  // the comparison is false for NaN
      throw InputError(
          path, 0,
          message(
              "frame {}: {} of atom {} is {}; a simulation that blew up writes such frames: leave them out by @frames@",
              number, "xyz"[axis], n + 1, coordinate));
    }
  }
}

}  // namespace

std::string cut_short_sentence(std::uint64_t whole_frames) {
  return fmt::format("the file ends within frame {}; its {} whole {} used", whole_frames, with_thousands(whole_frames),
                     whole_frames == 1 ? "frame is" : "frames are");
}

double Trajectory::with_fewest_digits(double number, double precision) {
  constexpr int kMostDigits = 17;
  for (int digits = 1; digits < kMostDigits; ++digits) {
    const std::string text = fmt::format("{:.{}e}", number, digits - 1);
    double rounded = 0.0;
    std::from_chars(text.data(), text.data() + text.size(), rounded);
    if (std::abs(rounded - number) <= precision * std::abs(number)) return rounded;
  }
  return number;
}

void Trajectory::read(std::uint64_t number, Frame& frame) {
  if (number >= frame_count_)
    throw InputError(path_, 0, "has no frame {}; it holds {} {}, counted from 0", number, with_thousands(frame_count_),
                     frame_count_ == 1 ? "frame" : "frames");
  frame.cell.reset();
  frame.time.reset();
  frame.step.reset();
  read_unchecked(number, frame);
  if (frame.positions.size() != atom_count_)
    throw InputError(path_, 0, "frame {} holds {} atoms, the first frame {}", number,
                     with_thousands(frame.positions.size()), with_thousands(atom_count_));
  check_positions(frame, number, path_);
  if (frame.time) frame.time = with_fewest_digits(*frame.time, time_precision_);
}

JoinedFrames::JoinedFrames(std::vector<std::unique_ptr<Trajectory>> parts)
    : Trajectory(parts.front()->path(), parts.front()->format()), parts_(std::move(parts)) {
  if (parts_.size() > 1) path_ += fmt::format(" and {} more", parts_.size() - 1);
  atom_count_ = parts_.front()->atom_count();
  for (std::size_t n = 0; n < parts_.size(); ++n) {
    const Trajectory& part = *parts_[n];
    if (part.atom_count() != atom_count_) {
      throw InputError(part.path(), 0,
                       "its frames have {} atoms, but frames of {} have {}; all trajectories need the same number",
                       with_thousands(part.atom_count()), parts_.front()->path(), with_thousands(atom_count_));
    }
    begin_.push_back(frame_count_);
    frame_count_ += part.frame_count();
    for (const Warning& warning : part.warnings())
      warnings_.emplace_back(part.path() + ": " + warning.text, warning.details);
    if (!part.cut_short().empty())
      cut_short_ += fmt::format("{}{}: {}", cut_short_.empty() ? "" : "; ", part.path(), part.cut_short());
    if (n > 0) warn_of_overlap(n);
  }
}

void JoinedFrames::warn_of_overlap(std::size_t part) {
  Frame last, first;
  try {
    parts_[part - 1]->read(parts_[part - 1]->frame_count() - 1, last);
    parts_[part]->read(0, first);
  } catch (const InputError&) {
    return;  // reading this frame later reports the error
  }
  if (!last.time || !first.time || *first.time > *last.time) return;
  warnings_.emplace_back(fmt::format("{} begins at {} ps, and {} ends at {} ps; no frame is left out",
                                     parts_[part]->path(), *first.time, parts_[part - 1]->path(), *last.time));
}

void JoinedFrames::read_unchecked(std::uint64_t number, Frame& frame) {
  const auto next = std::ranges::upper_bound(begin_, number);
  const auto part = static_cast<std::size_t>(next - begin_.begin()) - 1;
  parts_[part]->read(number - begin_[part], frame);
}

}  // namespace meniscus
