// SPDX-License-Identifier: BSD-3-Clause
// Objects of the C interface that let go of themselves, for tests.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <meniscus/meniscus.h>

#include "tests/support/molecules.h"

namespace meniscus::test {

struct Release {
  void operator()(meniscus_computer* computer) const { meniscus_computer_release(computer); }
  void operator()(meniscus_structure* structure) const { meniscus_structure_release(structure); }
  void operator()(meniscus_surface* surface) const { meniscus_surface_release(surface); }
  void operator()(meniscus_pockets* pockets) const { meniscus_pockets_release(pockets); }
  void operator()(meniscus_mesh* mesh) const { meniscus_mesh_release(mesh); }
  void operator()(meniscus_renderer* renderer) const { meniscus_renderer_release(renderer); }
  void operator()(meniscus_scene* scene) const { meniscus_scene_release(scene); }
  void operator()(meniscus_page* page) const { meniscus_page_release(page); }
};
using Computer = std::unique_ptr<meniscus_computer, Release>;
using StructureOf = std::unique_ptr<meniscus_structure, Release>;
using SurfaceOf = std::unique_ptr<meniscus_surface, Release>;
using Pockets = std::unique_ptr<meniscus_pockets, Release>;
using Mesh = std::unique_ptr<meniscus_mesh, Release>;
using Renderer = std::unique_ptr<meniscus_renderer, Release>;
using SceneOf = std::unique_ptr<meniscus_scene, Release>;
using PageOf = std::unique_ptr<meniscus_page, Release>;

inline meniscus_options default_options() {
  meniscus_options options{};
  options.size = sizeof options;
  EXPECT_EQ(meniscus_default_options(&options), MENISCUS_OK);
  return options;
}

inline Computer computer(const meniscus_options& options = default_options()) {
  meniscus_computer* made = nullptr;
  EXPECT_EQ(meniscus_computer_new(&options, &made), MENISCUS_OK) << meniscus_last_error();
  return Computer(made);
}

inline Renderer renderer(meniscus_device device) {
  meniscus_renderer* made = nullptr;
  EXPECT_EQ(meniscus_renderer_new(device, &made), MENISCUS_OK) << meniscus_last_error();
  return Renderer(made);
}

/// Makes a scene with these values.
inline SceneOf scene_with(const std::vector<std::pair<const char*, const char*>>& values) {
  meniscus_scene* made = nullptr;
  EXPECT_EQ(meniscus_scene_new(&made), MENISCUS_OK) << meniscus_last_error();
  for (const auto& [name, value] : values)
    EXPECT_EQ(meniscus_scene_set(made, name, value), MENISCUS_OK) << meniscus_last_error();
  return SceneOf(made);
}

/// Reads a file by meniscus_read().
inline StructureOf structure_of(const std::string& path, const meniscus_read_options* options = nullptr) {
  meniscus_structure* made = nullptr;
  EXPECT_EQ(meniscus_read(path.c_str(), options, &made), MENISCUS_OK) << meniscus_last_error();
  return StructureOf(made);
}

/// Passes the balls from memory: rows of x, y, z, radius.
inline meniscus_atoms atoms_of(const testing::Balls& balls) {
  meniscus_atoms atoms{};
  atoms.size = sizeof atoms;
  atoms.count = balls.size();
  if (balls.empty()) return atoms;
  atoms.positions = &balls[0].center;
  atoms.radii = &balls[0].radius;
  atoms.positions_stride = atoms.radii_stride = sizeof(Ball);
  return atoms;
}

inline SurfaceOf computed(meniscus_computer* computer, const testing::Balls& balls) {
  const meniscus_atoms atoms = atoms_of(balls);
  meniscus_surface* surface = nullptr;
  EXPECT_EQ(meniscus_compute(computer, &atoms, &surface), MENISCUS_OK) << meniscus_last_error();
  return SurfaceOf(surface);
}

inline meniscus_summary summary_of(const SurfaceOf& surface) {
  meniscus_summary summary{};
  summary.size = sizeof summary;
  EXPECT_EQ(meniscus_surface_summary(surface.get(), &summary), MENISCUS_OK) << meniscus_last_error();
  return summary;
}

/// Copies a table's rows.
template <typename Row>
std::vector<Row> rows_of(const SurfaceOf& surface, meniscus_surface_table_id table) {
  meniscus_array array{};
  EXPECT_EQ(meniscus_surface_table(surface.get(), table, &array), MENISCUS_OK) << meniscus_last_error();
  EXPECT_EQ(array.stride, sizeof(Row));
  const auto* const first = static_cast<const Row*>(array.data);
  return {first, first + array.count};
}

}  // namespace meniscus::test
