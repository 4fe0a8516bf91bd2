// SPDX-License-Identifier: BSD-3-Clause
// Prints frames of a trajectory as they are read, every number in full: `frame_dump FILE [--index FOLDER] [NUMBER...]`.
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <vector>

#include "core/trajectory/formats/trajectory_formats.h"
#include "core/camera/camera.h"
#include "core/trajectory/trajectory.h"

namespace {

void print(const meniscus::Frame& frame, std::uint64_t number) {
  std::printf("frame %llu", static_cast<unsigned long long>(number));
  if (frame.time) std::printf(" time %.17g", *frame.time);
  if (frame.step) std::printf(" step %lld", static_cast<long long>(*frame.step));
  std::printf("\n");
  if (frame.cell) {
    std::printf("cell");
    for (int n = 0; n < 9; ++n) std::printf(" %.17g", (*frame.cell)[n / 3][n % 3]);
    std::printf("\n");
  }
  for (const glm::dvec3& p : frame.positions) std::printf("%.17g %.17g %.17g\n", p.x, p.y, p.z);
}

}  // namespace

int main(int count, char** arguments) {
  try {
    meniscus::TrajectoryOptions options;
    int next = 2;
    for (; count > next + 1 && std::strncmp(arguments[next], "--", 2) == 0; next += 2) {
      const char* value = arguments[next + 1];
      if (std::strcmp(arguments[next], "--index") == 0) options.index_folder = value;
      if (std::strcmp(arguments[next], "--atoms") == 0)
        options.atoms = [value] { return std::strtoull(value, nullptr, 10); };
    }
    const auto trajectory = meniscus::open_trajectory(count > 1 ? arguments[1] : "", options);
    std::printf("format %s atoms %zu frames %llu\n", trajectory->format().c_str(), trajectory->atom_count(),
                static_cast<unsigned long long>(trajectory->frame_count()));
    for (const meniscus::Warning& warning : trajectory->warnings()) std::printf("warning %s\n", warning.text.c_str());
    if (!trajectory->cut_short().empty()) std::printf("cut %s\n", trajectory->cut_short().c_str());
    std::vector<std::uint64_t> numbers;
    for (; next < count; ++next) numbers.push_back(std::strtoull(arguments[next], nullptr, 10));
    if (numbers.empty())
      for (std::uint64_t n = 0; n < trajectory->frame_count(); ++n) numbers.push_back(n);
    meniscus::Frame frame;
    for (const std::uint64_t number : numbers) {
      trajectory->read(number, frame);
      print(frame, number);
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
