// SPDX-License-Identifier: BSD-3-Clause
// Finds the pockets of a surface, and returns them as tables.

#include "core/pockets/pockets.h"
#include "core/surface/compute_surface.h"
#include "exporters/bindings/c/c_calls.h"
#include "exporters/bindings/c/c_surface.h"

/// The object behind the handle of pockets: the tables, with the rows of one pocket after the other.
struct meniscus_pockets : meniscus::c_api::Counted {
  std::vector<meniscus_pocket> pockets;
  std::vector<double> mouths;
  std::vector<std::uint32_t> atoms;
  std::vector<glm::dvec3> probes;
};

namespace meniscus::c_api {
namespace {

const meniscus_pocket_options kDefaultPocketOptions{sizeof(meniscus_pocket_options), PocketRequest{}.large_probe_radius,
                                                    PocketRequest{}.trim, PocketRequest{}.min_volume,
                                                    PocketRequest{}.tolerance};

/// Returns the request for pockets. Refuses a surface without a probe, and impossible options.
PocketRequest request_of(const FinishedSurface& finished, const meniscus_pocket_options* given) {
  if (finished.kind != SurfaceKind::ses || !(finished.probe_radius > 0.0))
    refuse(MENISCUS_USAGE, "pockets need a probe above 0 and a surface of MENISCUS_SES");
  const meniscus_pocket_options options = read_options(given, kDefaultPocketOptions, "meniscus_pocket_options");
  check_number("pockets.large_probe", "large_probe_radius", options.large_probe_radius, "Å");
  check_number("pockets.trim", "trim", options.trim, "Å");
  check_number("pockets.min_volume", "min_volume", options.min_volume, "Å³");
  check_number("pockets.mouth_tolerance", "mouth_tolerance", options.mouth_tolerance, "Å");
  if (options.large_probe_radius <= finished.probe_radius)
    refuse(MENISCUS_INPUT, "large_probe_radius is {} Å; it has to be above the probe's {} Å",
           options.large_probe_radius, finished.probe_radius);
  return {finished.probe_radius, options.large_probe_radius, options.trim, options.mouth_tolerance, options.min_volume};
}

/// Appends rows, and returns the index of the first one.
template <typename Row>
std::uint32_t append(std::vector<Row>& all, const std::vector<Row>& more) {
  const auto first = static_cast<std::uint32_t>(all.size());
  all.insert(all.end(), more.begin(), more.end());
  return first;
}

std::unique_ptr<meniscus_pockets> rows_of(const Pockets& found) {
  auto rows = std::make_unique<meniscus_pockets>();
  for (const Pocket& pocket : found.pockets) {
    const glm::dvec3 middle = pocket.cavity.middle();
    meniscus_pocket& row = rows->pockets.emplace_back();
    row.volume = pocket.cavity.volume;
    row.volume_excess = found.volume_excess(pocket);
    row.area = pocket.cavity.area;
    row.mouth_area = pocket.mouth_area();
    row.depth = pocket.depth;
    for (int axis = 0; axis < 3; ++axis) row.middle[axis] = middle[axis];
    row.first_mouth = append(rows->mouths, pocket.mouth_areas);
    row.mouth_count = static_cast<std::uint32_t>(pocket.mouth_areas.size());
    row.first_atom = append(rows->atoms, pocket.cavity.atoms);
    row.atom_count = static_cast<std::uint32_t>(pocket.cavity.atoms.size());
    row.first_probe = append(rows->probes, pocket.cavity.probes);
    row.probe_count = static_cast<std::uint32_t>(pocket.cavity.probes.size());
  }
  return rows;
}

meniscus_array find_table(const meniscus_pockets& pockets, std::int32_t table) {
  switch (table) {
    case MENISCUS_POCKETS:
      return table_of(pockets.pockets);
    case MENISCUS_POCKET_MOUTHS:
      return table_of(pockets.mouths);
    case MENISCUS_POCKET_ATOMS:
      return table_of(pockets.atoms);
    case MENISCUS_POCKET_PROBES:
      return table_of(pockets.probes);
    default:
      refuse(MENISCUS_USAGE, "pockets have no table {}", table);
  }
}

}  // namespace
}  // namespace meniscus::c_api

meniscus_status meniscus_default_pocket_options(meniscus_pocket_options* options) {
  using namespace meniscus::c_api;
  return guarded([&] { write_struct(options, kDefaultPocketOptions, "meniscus_pocket_options"); });
}

meniscus_status meniscus_surface_pockets(const meniscus_surface* surface, const meniscus_pocket_options* options,
                                         meniscus_pockets** pockets) {
  using namespace meniscus::c_api;
  return guarded([&] {
    require(surface, "surface");
    require(pockets, "pockets");
    const std::shared_ptr<const FinishedSurface> of = surface->finished;
    const meniscus::PocketRequest request = request_of(*of, options);
    run_on_threads(of->threads, [&] {
      *pockets = rows_of(find_pockets(of->surface.atoms, request, meniscus::compute_surface_cpu)).release();
    });
  });
}

meniscus_pockets* meniscus_pockets_retain(meniscus_pockets* pockets) { return meniscus::c_api::retain(pockets); }
void meniscus_pockets_release(meniscus_pockets* pockets) { meniscus::c_api::release(pockets); }

meniscus_status meniscus_pockets_table(const meniscus_pockets* pockets, meniscus_pockets_table_id table,
                                       meniscus_array* array) {
  using namespace meniscus::c_api;
  return guarded([&] {
    require(pockets, "pockets");
    require(array, "array");
    *array = find_table(*pockets, table);
  });
}
