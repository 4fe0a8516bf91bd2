// SPDX-License-Identifier: BSD-3-Clause
// Separates ligands from a structure, and maps the numbers of its atoms back.
#include "core/scene/molecule_pockets.h"

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/pockets/pockets.h"

namespace meniscus {
namespace {

SurfaceRequest with_probe(SurfaceRequest computing, double probe_radius) {
  computing.kind = SurfaceKind::ses;
  computing.probe_radius = probe_radius;
  computing.planes = ClipPlanes::listed;  // because parts are cut out by planes
  return computing;
}

void renumber(std::vector<std::uint32_t>& atoms, const std::vector<std::uint32_t>& number) {
  for (std::uint32_t& a : atoms)
    if (a != kNone) a = number[a];
}

std::vector<LeftOutResidue> residues_of(const Structure& structure, const std::vector<bool>& left_out,
                                        const Pockets& found) {
  const PocketLocator pocket_of(found);
  std::vector<LeftOutResidue> residues;
  for (std::uint32_t a = 0; a < left_out.size(); ++a) {
    if (!left_out[a]) continue;
    const Atom& atom = structure.atoms[a];
    if (residues.empty() || structure.atoms[residues.back().first_atom].residue != atom.residue)
      residues.push_back({a, 0, std::vector<std::size_t>(found.pockets.size(), 0)});
    ++residues.back().atoms;
    if (const auto pocket = pocket_of(atom.position)) ++residues.back().in_pocket[*pocket];
  }
  return residues;
}

}  // namespace

PocketComputer::PocketComputer(SurfaceRequest computing, const PocketRequest& request)
    : request_(request),
      small_(with_probe(computing, request.probe_radius)),
      large_(with_probe(computing, request.large_probe_radius)) {}

MoleculePockets PocketComputer::compute(const Structure& structure, const std::vector<bool>& left_out) {
  std::vector<Ball> balls;
  std::vector<std::uint32_t> number;
  for (std::uint32_t a = 0; a < structure.atoms.size(); ++a) {
    if (!left_out.empty() && left_out[a]) continue;
    balls.push_back({structure.atoms[a].position, structure.atoms[a].radius});
    number.push_back(a);
  }
  if (balls.empty()) throw RequestError(fmt::format("{}: no atoms are left to form pockets", structure.file));
  MoleculePockets result;
  result.atom_count = balls.size();
  result.found = find_pockets(balls, request_, [this](std::span<const Ball> atoms, double probe_radius) {
    return (probe_radius == request_.large_probe_radius ? large_ : small_).compute(atoms);
  });
  for (Pocket& pocket : result.found.pockets) {
    renumber(pocket.cavity.atoms, number);
    renumber(pocket.atom, number);
  }
  result.left_out = residues_of(structure, left_out, result.found);
  return result;
}

}  // namespace meniscus
