// SPDX-License-Identifier: BSD-3-Clause
// Coordinates of the test molecules.
#include "tests/export/povray/molecules.h"

#include <array>
#include <cmath>
#include <fstream>
#include <numbers>
#include <random>
#include <stdexcept>

#include <glm/geometric.hpp>

namespace meniscus::testing {
namespace {

constexpr double kCarbon = 1.7;

// No edge of any patch stays parallel to an axis.
Molecule tilted(Molecule m) {
  const glm::dvec3 x = glm::normalize(glm::dvec3(0.8, 0.5, -0.33)), y = glm::normalize(glm::cross(x, {0.1, 0.3, 1.0}));
  for (Ball& b : m.balls)
    b.center = glm::dvec3(0.3, -0.2, 0.1) + b.center.x * x + b.center.y * y + b.center.z * glm::cross(x, y);
  return m;
}

}  // namespace

Molecule one_atom() { return {"one_atom", {{{0.3, 0.2, 0.1}, kCarbon}}}; }

Molecule free_torus() { return {"free_torus", {{{-2, 0.1, 0}, kCarbon}, {{1.9, 0.3, 0.5}, 1.5}}}; }

Molecule free_spindle() {
  const double half = std::sqrt((kCarbon + kWaterProbe) * (kCarbon + kWaterProbe) - 1.0);
  return {"free_spindle", {{{-half, 0, 0}, kCarbon}, {{half, 0, 0}, kCarbon}}};
}

Molecule three_atoms() {
  return tilted({"three_atoms", {{{0, 0, 0}, kCarbon}, {{3.5, 0, 0}, kCarbon}, {{1.6, 3.1, 0}, 1.55}}});
}

Molecule wide_arc() { return {"wide_arc", {{{-2, 0, 0}, kCarbon}, {{2, 0, 0}, kCarbon}, {{0.1, 4.2, 0.2}, 1.55}}}; }

Molecule cut_probes() {
  return tilted({"cut_probes", {{{-2.8, 0, 0}, kCarbon}, {{2.8, 0, 0}, kCarbon}, {{0, 2, 0}, kCarbon}}});
}

Molecule square() {
  Molecule m{"square", {}};
  for (const double x : {-1.9, 1.9})
    for (const double y : {-1.9, 1.9}) m.balls.push_back({{x, y, 0}, kCarbon});
  return m;
}

Molecule blob(int atom_count, unsigned seed) {
  std::mt19937 random(seed);
  const auto uniform = [&] { return static_cast<double>(random()) / 4294967295.0; };
  const double size = 2.4 * std::cbrt(static_cast<double>(atom_count));
  Molecule m{"blob" + std::to_string(atom_count), {}};
  while (m.balls.size() < static_cast<std::size_t>(atom_count)) {
    const glm::dvec3 p = 2.0 * glm::dvec3(uniform(), uniform(), uniform()) - 1.0;
    if (glm::length(p) <= 1.0) m.balls.push_back({p * size, 1.2 + 0.6 * uniform()});
  }
  return m;
}

Molecule fullerene() {
  // Vertices of the truncated icosahedron of edge 2: even permutations of three corners with all signs.
  constexpr double kGolden = std::numbers::phi;
  const std::array<glm::dvec3, 3> corners{
      {{0, 1, 3 * kGolden}, {1, 2 + kGolden, 2 * kGolden}, {kGolden, 2, 2 * kGolden + 1}}};
  Molecule m{"fullerene", {}};
  for (const glm::dvec3& c : corners)
    for (int turn = 0; turn < 3; ++turn)
      for (int signs = 0; signs < 8; ++signs) {
        if (c.x == 0.0 && (signs & 1)) continue;
        const glm::dvec3 p((signs & 1 ? -1 : 1) * c.x, (signs & 2 ? -1 : 1) * c.y, (signs & 4 ? -1 : 1) * c.z);
        m.balls.push_back({0.71 * glm::dvec3(p[turn], p[(turn + 1) % 3], p[(turn + 2) % 3]), kCarbon});
      }
  return m;
}

std::vector<Molecule> small_molecules() {
  return {one_atom(),   free_torus(), free_spindle(), three_atoms(), wide_arc(),
          cut_probes(), square(),     blob(12, 3),    fullerene()};
}

Molecule pdb_molecule(const std::string& name, const std::string& path) {
  Molecule m{name, {}};
  std::ifstream file(path);
  for (std::string line; std::getline(file, line) && line.rfind("ENDMDL", 0) != 0;) {
    if (line.rfind("ATOM  ", 0) != 0 || (line[16] != ' ' && line[16] != 'A')) continue;
    const char element = line[13];
    if (element == 'H' || line[12] == 'H') continue;
    const double radius = element == 'C' ? 1.7 : element == 'N' ? 1.55 : element == 'O' ? 1.52 : 1.8;
    m.balls.push_back(
        {{std::stod(line.substr(30, 8)), std::stod(line.substr(38, 8)), std::stod(line.substr(46, 8))}, radius});
  }
  return m;
}

Molecule ubiquitin() { return pdb_molecule("1ubq", "/usr/share/freesasa/test-data/1ubq.pdb"); }

Molecule enterotoxin() { return pdb_molecule("1tii", "/usr/share/pymol/data/demo/1tii.pdb"); }

Coloring turning_colors(std::size_t atom_count, int color_count) {
  const std::array<glm::vec3, 3> palette{{{0.9f, 0.3f, 0.2f}, {0.2f, 0.5f, 0.9f}, {0.9f, 0.8f, 0.3f}}};
  Coloring c;
  for (std::size_t a = 0; a < atom_count; ++a) c.atom.push_back(palette[static_cast<int>(a) % color_count]);
  return c;
}

}  // namespace meniscus::testing
