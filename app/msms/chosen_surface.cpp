// SPDX-License-Identifier: BSD-3-Clause
// Selects component 0, all components, or the component that touches some spheres.
#include "app/msms/chosen_surface.h"

#include <algorithm>
#include <numeric>
#include <span>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/error.h"
#include "core/mesh/tessellate.h"
#include "core/surface/reduced_surface_engine.h"
#include "core/surface/compute_surface.h"
#include "core/base/stage_clock.h"

namespace meniscus::msms {
namespace {

constexpr std::size_t kMostAreas = std::size_t{1} << 26;  // a gigabyte, and as much text
constexpr int kAttempts = 16;
constexpr double kShorter = 0.9;

/// Returns the atoms that a face touches.
std::vector<std::uint32_t> touched_atoms(const Surface& surface, const Face& face) {
  if (face.kind == PatchKind::convex) return {surface.convex[face.patch].atom};
  if (face.kind == PatchKind::toroidal) {
    const auto& atoms = surface.toroidal[face.patch].atom;
    return {atoms.begin(), atoms.end()};
  }
  const ConcavePatch& patch = surface.concave[face.patch];
  const auto contacts = std::span(surface.contacts).subspan(patch.first_contact, patch.contact_count);
  return {contacts.begin(), contacts.end()};
}

}  // namespace

ChosenSurface::ChosenSurface(const Arguments& arguments, const Spheres& spheres) : density_(arguments.density) {
  const auto engine = make_cpu_engine();
  StageClock unused;
  computed_ = compute_component_surface(*engine, spheres.balls, arguments.probe_radius, unused);
  require_closed(computed_.surface);
  if (!arguments.cavity_atoms.empty()) {
    chosen_ = {component_touching(arguments.cavity_atoms, spheres)};
  } else {
    chosen_.resize(arguments.all_components ? computed_.components.count : 1);
    std::iota(chosen_.begin(), chosen_.end(), 0u);
  }
}

// Prefers a cavity, because an atom of its wall may touch the outside as well.
std::uint32_t ChosenSurface::component_touching(const std::vector<std::uint32_t>& numbers,
                                                const Spheres& spheres) const {
  std::vector<std::uint32_t> wanted;
  for (std::uint32_t a = 0; a < spheres.rows.of_atom.size(); ++a)
    if (std::ranges::find(numbers, spheres.rows.of_atom[a]) != numbers.end()) wanted.push_back(a);
  const std::vector<ReducedComponentSize> all = sizes_of(computed_.surface, computed_.components);
  std::optional<std::uint32_t> outer, cavity;
  for (std::size_t f = 0; f < computed_.surface.faces.size(); ++f) {
    const std::vector<std::uint32_t> touched = touched_atoms(computed_.surface, computed_.surface.faces[f]);
    const bool has_all = std::ranges::all_of(
        wanted, [&](std::uint32_t atom) { return std::ranges::find(touched, atom) != touched.end(); });
    if (!has_all) continue;
    const std::uint32_t component = computed_.components.of_face[f];
    std::optional<std::uint32_t>& best = all[component].volume < 0 ? cavity : outer;
    best = std::min(best.value_or(component), component);
  }
  const bool known = wanted.size() == numbers.size();
  if (!known || (!cavity && !outer))
    throw InputError(
        spheres.rows.file, 0,
        fmt::format("find_first_rs_face: no position of the probe touches the spheres {} of -one_cavity; they "
                    "are numbered from 0 to {}",
                    fmt::join(numbers, ", "), spheres.rows.count - 1));
  return cavity ? *cavity : *outer;
}

std::vector<ReducedComponentSize> ChosenSurface::sizes() const {
  const std::vector<ReducedComponentSize> all = sizes_of(computed_.surface, computed_.components);
  std::vector<ReducedComponentSize> chosen;
  for (const std::uint32_t component : chosen_) chosen.push_back(all[component]);
  return chosen;
}

std::vector<AtomAreas> ChosenSurface::areas() const {
  if (chosen_.size() * computed_.surface.atoms.size() > kMostAreas)
    throw CapacityError(fmt::format(
        "the areas of {} spheres in {} components are too many for one table; leave -af or -all_components out",
        computed_.surface.atoms.size(), chosen_.size()));
  // All other components form one group, after the selected ones.
  const auto others = static_cast<std::uint32_t>(chosen_.size());
  std::vector<std::uint32_t> group(computed_.components.count, others);
  for (std::uint32_t n = 0; n < chosen_.size(); ++n) group[chosen_[n]] = n;
  std::vector<std::uint32_t> group_of_face;
  for (const std::uint32_t component : computed_.components.of_face) group_of_face.push_back(group[component]);
  std::vector<AtomAreas> areas = atom_areas(computed_.surface, group_of_face, others + 1);
  areas.pop_back();
  return areas;
}

// Long edges may cut a face's rim short, or cross it; slightly shorter ones do not.
void ChosenSurface::triangulate() {
  MeshOptions options;
  options.split_colors = false;
  options.edge = msms_edge(density_);
  for (int attempt = 1;; ++attempt, options.edge *= kShorter) {
    try {
      mesh_ = tessellate(computed_.surface, options);
      numbered_.emplace(computed_.surface, mesh_, computed_.components);
      return;
    } catch (const OpenSurfaceError&) {
      if (attempt == kAttempts) throw;
    }
  }
}

MsmsMesh ChosenSurface::mesh(std::size_t n) { return numbered_->of(chosen_[n]); }

}  // namespace meniscus::msms
