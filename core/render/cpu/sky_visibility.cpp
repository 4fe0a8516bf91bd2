// SPDX-License-Identifier: BSD-3-Clause
// Casts rays from points towards the sky, packet by packet, on all threads.
#include "core/render/cpu/sky_visibility.h"

#include <algorithm>
#include <cassert>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "core/render/cpu/occluders.h"

namespace meniscus {

std::vector<float> sky_visibility(const Surface& surface, const SkyPoints& points,
                                  std::span<const glm::vec3> directions) {
  assert(points.positions.size() == points.normals.size());
  std::vector<float> seen(points.positions.size(), 1.0f);
  if (surface.atoms.empty()) return seen;
  PictureFrame frame;
  for (const Ball& ball : surface.atoms) frame.pivot += ball.center / static_cast<double>(surface.atoms.size());
  Coloring grey;
  grey.atom.assign(surface.atoms.size(), glm::vec3(1.0f));
  Occluders occluders(frame.pivot, patch_slack(surface.atoms, surface.probe_radius, frame));
  occluders.add(whole_surface(surface, grey)[0]);
  const std::vector<glm::vec3> usual = directions.empty() ? sky_directions(0, 2 * kSkyRays) : std::vector<glm::vec3>();
  if (directions.empty()) directions = usual;
  const LaneLight light = occluders.towards(directions);
  const LaneKernels& kernels = widest_kernels(16);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, seen.size(), 256), [&](const auto& range) {
    std::vector<glm::vec3> positions, normals;
    for (std::size_t n = range.begin(); n < range.end(); ++n) {
      positions.emplace_back(points.positions[n] - frame.pivot);
      normals.emplace_back(points.normals[n]);
    }
    kernels.see_sky(light, positions.data(), normals.data(), &seen[range.begin()],
                    static_cast<std::uint32_t>(range.size()));
  });
  return seen;
}

}  // namespace meniscus
