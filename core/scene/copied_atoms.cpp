// SPDX-License-Identifier: BSD-3-Clause
// Lists groups, copies and atoms in one order.
#include "core/scene/copied_atoms.h"

namespace meniscus {
namespace {

constexpr std::size_t kMostListed = 1'000'000;

/// Returns the atoms among these whose balls reach farthest in one of 124 directions, ascending.
std::vector<std::uint32_t> farthest_atoms(std::span<const Ball> balls, std::span<const std::uint32_t> atoms) {
  std::vector<std::uint32_t> farthest;
  constexpr int kSteps = 2;
  for (int x = -kSteps; x <= kSteps; ++x)
    for (int y = -kSteps; y <= kSteps; ++y)
      for (int z = -kSteps; z <= kSteps; ++z) {
        if (x == 0 && y == 0 && z == 0) continue;
        const glm::dvec3 direction = glm::normalize(glm::dvec3(x, y, z));
        farthest.push_back(*std::ranges::max_element(
            atoms, {}, [&](std::uint32_t a) { return glm::dot(direction, balls[a].center) + balls[a].radius; }));
      }
  std::ranges::sort(farthest);
  farthest.erase(std::unique(farthest.begin(), farthest.end()), farthest.end());
  return farthest;
}

}  // namespace

std::size_t placed_count(std::span<const Instances> copies) {
  std::size_t count = 0;
  for (const Instances& group : copies) count += group.atoms.size() * group.motions.size();
  return count;
}

std::vector<CopiedAtom> placed_atoms(std::span<const Instances> copies) {
  std::vector<CopiedAtom> placed;
  placed.reserve(placed_count(copies));
  for (const Instances& group : copies)
    for (std::uint32_t copy = 0; copy < group.motions.size(); ++copy)
      for (const std::uint32_t atom : group.atoms) placed.push_back({atom, copy});
  return placed;
}

std::vector<Ball> placed_balls(std::span<const Ball> balls, std::span<const Instances> copies) {
  std::vector<Ball> placed;
  placed.reserve(placed_count(copies));
  for (const Instances& group : copies)
    for (const RigidMotion& motion : group.motions)
      for (const std::uint32_t atom : group.atoms) placed.push_back({motion(balls[atom].center), balls[atom].radius});
  return placed;
}

Coloring coloring_of(const Coloring& coloring, std::span<const std::uint32_t> atoms) {
  Coloring of;
  of.kind = coloring.kind;
  for (const std::uint32_t atom : atoms) {
    of.atom.push_back(coloring.atom[atom]);
    if (!coloring.hidden.empty()) of.hidden.push_back(coloring.hidden[atom]);
    if (!coloring.opacity.empty()) of.opacity.push_back(coloring.opacity[atom]);
    if (!coloring.in_patch.empty()) of.in_patch.push_back(coloring.in_patch[atom]);
    if (!coloring.part.empty()) of.part.push_back(coloring.part[atom]);
  }
  return of;
}

std::vector<Ball> standing_balls(const Structure& structure, const std::vector<bool>& picked) {
  const std::vector<Ball> balls = balls_of(structure);
  const auto is_out = [&picked](std::uint32_t atom) { return !picked.empty() && !picked[atom]; };
  if (!structure.instances.empty()) {
    std::vector<Instances> copies = structure.instances;
    for (Instances& group : copies) std::erase_if(group.atoms, is_out);
    std::erase_if(copies, [](const Instances& group) { return group.atoms.empty(); });
    return reaching_balls(balls, copies);
  }
  std::vector<Ball> standing;
  for (std::uint32_t a = 0; a < balls.size(); ++a)
    if (!is_out(a)) standing.push_back(balls[a]);
  return standing;
}

std::vector<Ball> reaching_balls(std::span<const Ball> balls, std::span<const Instances> copies) {
  if (placed_count(copies) <= kMostListed) return placed_balls(balls, copies);
  std::vector<Instances> outer(copies.begin(), copies.end());
  for (Instances& group : outer) group.atoms = farthest_atoms(balls, group.atoms);
  return placed_balls(balls, outer);
}

}  // namespace meniscus
