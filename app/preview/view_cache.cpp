// SPDX-License-Identifier: BSD-3-Clause
// The renderer of a preview, its last picture, and the areas of its surfaces.
#include "app/preview/view_cache.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include <glm/common.hpp>

#include "app/preview/look_json.h"

namespace meniscus {

void ViewCache::take(const PreviewState& state, const ShownMolecule& molecule, Renewal renewal, bool moves) {
  if (moves) renderer_->set_atoms(molecule.balls());
  if (renewal >= Renewal::colors) renderer_->set_coloring(molecule.coloring(state));
  if (renewal >= Renewal::cuts) renderer_->set_figure(state.figure, molecule.beside());
}

bool ViewCache::draw(const PreviewState& state, const ShownMolecule& molecule, Quality quality,
                     const std::function<bool()>& stop) {
  if (is_drawn(state, quality)) return true;
  drawn_.revision = 0;
  const auto begin = std::chrono::steady_clock::now();
  const glm::ivec2 size = molecule.picture_size(state);
  RenderSettings settings;
  settings.size = quality == Quality::draft ? glm::max(size / 2, glm::ivec2(1)) : size;
  settings.samples = quality == Quality::full ? state.samples : 1;
  settings.look = quality == Quality::full ? state.full_look() : without_effects(state.full_look());
  settings.timing = quality == Quality::draft ? StageTiming::rough : StageTiming::exact;
  if (!renderer_->draw(rolling_probe(state.kind, state.probe_radius), state.camera, settings, stop)) return false;
  if (quality != Quality::draft || stages_.empty()) stages_ = renderer_->times();
  milliseconds_ = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
  drawn_ = {state.revision, quality, molecule.legend()};
  return true;
}

std::vector<std::uint8_t> ViewCache::rgba() const {
  std::vector<std::uint8_t> molecule = renderer_->rgba();
  return drawn_.legend ? drawn_.legend->around(molecule, renderer_->size()) : molecule;
}

glm::ivec2 ViewCache::size() const {
  return drawn_.legend ? drawn_.legend->whole_size(renderer_->size()) : renderer_->size();
}

std::optional<PickedPoint> ViewCache::pick(const PreviewState& state, const ShownMolecule& molecule, glm::ivec2 pixel) {
  if (drawn_.revision != state.revision || drawn_.quality == Quality::draft) draw(state, molecule, Quality::plain);
  const glm::ivec2 shown = renderer_->size();
  return pixel.x < shown.x && pixel.y < shown.y ? renderer_->pick(pixel) : std::nullopt;
}

std::optional<double> ViewCache::exposed_area(const PreviewState& state, const ShownMolecule& molecule,
                                              std::uint32_t atom, bool wait, bool wanted) {
  const auto area = [&](const AtomsInView& atoms, std::size_t place) {
    return wanted ? areas_.of(atoms, place, wait) : areas_.if_cheap(atoms, place);
  };
  const std::vector<Instances>& copies = molecule.structure().instances;
  if (copies.empty())
    return area({state.frame, 0, state.kind, state.probe_radius, molecule.balls(), renderer_->surface()}, atom);
  // Copies of a group are as if it were alone.
  std::size_t group = 0;
  while (!std::ranges::binary_search(copies[group].atoms, atom)) ++group;
  const std::vector<std::uint32_t>& atoms = copies[group].atoms;
  std::vector<Ball> balls;
  balls.reserve(atoms.size());
  for (const std::uint32_t a : atoms) balls.push_back(molecule.balls()[a]);
  const auto place = static_cast<std::size_t>(std::ranges::lower_bound(atoms, atom) - atoms.begin());
  return area({state.frame, group, state.kind, state.probe_radius, balls, nullptr}, place);
}

}  // namespace meniscus
