// SPDX-License-Identifier: BSD-3-Clause
// Lists of frames, for trajectories of several lengths.
#include <algorithm>
#include <set>

#include "core/base/error.h"
#include "core/trajectory/frame_list.h"
#include "tests/fuzz/target.h"

namespace meniscus::fuzz {
namespace {

void check(std::string_view text, std::uint64_t count) {
  try {
    const std::vector<std::uint64_t> frames = parse_frame_list("--frames", text, count);
    require(!frames.empty() && std::ranges::max(frames) < count, "a list names frames that are there");
    require(std::set(frames.begin(), frames.end()).size() == frames.size(), "no frame comes twice");
    require(parse_frame_list("--frames", frame_list_text(frames), count) == frames, "a list written is read as it was");
  } catch (const RequestError& error) {
    require_clear(error);
  }
}

void run_frame_list(std::string_view bytes) {
  for (const std::uint64_t count : {1, 100, 20'000}) check(bytes, count);
}

const Registration registered_frame_list{"frame_list", run_frame_list};

}  // namespace
}  // namespace meniscus::fuzz
