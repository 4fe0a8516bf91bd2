// SPDX-License-Identifier: BSD-3-Clause
// Checks that hold for a frame of any format.
#include "core/trajectory/trajectory.h"

#include <charconv>
#include <cmath>
#include <string>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/text/parse_number.h"

namespace meniscus {
namespace {

void check_positions(const Frame& frame, std::uint64_t number, const std::string& path) {
  for (std::size_t n = 0; n < frame.positions.size(); ++n) {
    for (int axis = 0; axis < 3; ++axis) {
      const double coordinate = frame.positions[n][axis];
      if (std::abs(coordinate) <= kLargestCoordinate) continue;  // false for NaN
      throw InputError(path, 0,
                       fmt::format("frame {}: {} of atom {} is {}; a simulation that blew up writes such frames: leave "
                                   "them out by --frames",
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
  if (number >= frame_count_) {
    throw InputError(path_, 0,
                     fmt::format("has no frame {}; it holds {} {}, counted from 0", number,
                                 with_thousands(frame_count_), frame_count_ == 1 ? "frame" : "frames"));
  }
  frame.cell.reset();
  frame.time.reset();
  frame.step.reset();
  read_unchecked(number, frame);
  if (frame.positions.size() != atom_count_) {
    throw InputError(path_, 0,
                     fmt::format("frame {} holds {} atoms, the first frame {}", number,
                                 with_thousands(frame.positions.size()), with_thousands(atom_count_)));
  }
  check_positions(frame, number, path_);
  if (frame.time) frame.time = with_fewest_digits(*frame.time, time_precision_);
}

}  // namespace meniscus
