// SPDX-License-Identifier: BSD-3-Clause
// Computes the selection and its context together, and finds the selection's atoms again.
#include "core/scene/context_areas.h"

#include <unordered_map>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/scene/surface_objects.h"

namespace meniscus {
namespace {

void check(const MoleculeRequest& request) {
  if (!request.reading.selection)
    throw RequestError(message("@context@ needs @select@: the atoms whose area is measured in the presence of others"));
  if (request.file == "-")
    throw RequestError(message("@context@ reads the file twice; standard input can be read only once"));
  if (!request.reading.assembly.empty()) throw RequestError(message("@context@ and @assembly@ cannot be combined"));
}

}  // namespace

MoleculeRequest with_context(const MoleculeRequest& request, const Selection& context) {
  check(request);
  MoleculeRequest together = request;
  together.reading.selection = either(*request.reading.selection, context);
  return together;
}

ContextAreas context_areas(const MoleculeRequest& request, const Structure& structure, const Molecule& molecule,
                           const std::vector<AreaColumn>& alone, SurfaceComputer& computer) {
  const std::vector<SurfaceObject> objects =
      surface_objects(structure, {.groups = {}, .components = false, .cavities = request.division.cavities}, computer);
  const std::vector<AreaColumn> all = area_columns(structure, objects, request.surface.kind);

  std::unordered_map<std::uint32_t, std::size_t> row;  // row by place in the file
  for (std::size_t a = 0; a < structure.atoms.size(); ++a) row[structure.atoms[a].index] = a;
  ContextAreas result;
  result.atoms = structure.atoms.size() - molecule.structure.atoms.size();
  for (std::size_t c = 0; c < alone.size(); ++c) {
    AreaColumn in_context{alone[c].name + "_in_context", {}, 0.0};
    AreaColumn buried{alone[c].name + "_buried", {}, 0.0};
    for (std::size_t a = 0; a < molecule.structure.atoms.size(); ++a) {
      in_context.values.push_back(all[c].values[row.at(molecule.structure.atoms[a].index)]);
      buried.values.push_back(alone[c].values[a] - in_context.values.back());
      in_context.total += in_context.values.back();
      buried.total += buried.values.back();
    }
    result.columns.push_back(std::move(in_context));
    result.columns.push_back(std::move(buried));
  }
  return result;
}

}  // namespace meniscus
