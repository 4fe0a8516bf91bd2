// SPDX-License-Identifier: BSD-3-Clause
// Pockets through the C interface have the program's numbers, and wrong arguments are refused.
#include <array>
#include <cmath>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/c_api/c_objects.h"
#include "tests/support/run_program.h"

namespace meniscus {
namespace {

using namespace test;

using PocketsOf = std::unique_ptr<meniscus_pockets, decltype(&meniscus_pockets_release)>;

meniscus_pocket_options default_pocket_options() {
  meniscus_pocket_options options{};
  options.size = sizeof options;
  EXPECT_EQ(meniscus_default_pocket_options(&options), MENISCUS_OK);
  return options;
}

template <typename Row>
std::vector<Row> rows_of(const PocketsOf& pockets, meniscus_pockets_table_id table) {
  meniscus_array array{};
  EXPECT_EQ(meniscus_pockets_table(pockets.get(), table, &array), MENISCUS_OK) << meniscus_last_error();
  EXPECT_EQ(array.stride, sizeof(Row));
  const auto* const first = static_cast<const Row*>(array.data);
  return {first, first + array.count};
}

template <typename Row>
std::vector<Row> part(const std::vector<Row>& rows, std::uint32_t first, std::uint32_t count) {
  return {rows.begin() + first, rows.begin() + first + count};
}

TEST(CPockets, AreThoseOfTheProgramToTheLastDigit) {
  const testing::Balls balls = testing::enterotoxin();
  std::string lines;
  for (const Ball& b : balls) lines += fmt::format("{} {} {} {}\n", b.center.x, b.center.y, b.center.z, b.radius);
  const TemporaryFolder folder;
  const ProgramResult program =
      run_program(test::meniscus_program(), {"pockets", "-q", "--device", "cpu", "--ligand", "none", "--large-probe",
                                             "3.5", "--min-volume", "60", "--json", folder.file("t.xyzr", lines)});
  ASSERT_EQ(program.exit_code, 0) << program.err;
  const auto told = nlohmann::json::parse(program.out).at("pockets");
  ASSERT_GT(told.size(), 3u);

  const Computer made = computer();
  PocketsOf pockets(nullptr, meniscus_pockets_release);
  {
    const SurfaceOf surface = computed(made.get(), balls);
    meniscus_pocket_options options = default_pocket_options();
    options.large_probe_radius = 3.5;
    options.min_volume = 60.0;
    meniscus_pockets* found = nullptr;
    ASSERT_EQ(meniscus_surface_pockets(surface.get(), &options, &found), MENISCUS_OK) << meniscus_last_error();
    pockets.reset(found);
  }  // Pockets outlive the surface.
  const auto rows = rows_of<meniscus_pocket>(pockets, MENISCUS_POCKETS);
  const auto mouths = rows_of<double>(pockets, MENISCUS_POCKET_MOUTHS);
  const auto atoms = rows_of<std::uint32_t>(pockets, MENISCUS_POCKET_ATOMS);
  const auto probes = rows_of<std::array<double, 3>>(pockets, MENISCUS_POCKET_PROBES);
  ASSERT_EQ(rows.size(), told.size());
  for (std::size_t n = 0; n < rows.size(); ++n) {
    const meniscus_pocket& row = rows[n];
    EXPECT_EQ(row.volume, told[n]["volume"].get<double>());
    EXPECT_EQ(row.volume_excess, told[n]["volume_excess_at_most"].get<double>());
    EXPECT_EQ(row.area, told[n]["area"].get<double>());
    EXPECT_EQ(row.area - row.mouth_area, told[n]["wall_area"].get<double>());
    EXPECT_EQ(row.depth, told[n]["depth"].get<double>());
    EXPECT_EQ(std::vector<double>(row.middle, row.middle + 3), told[n]["middle"].get<std::vector<double>>());
    EXPECT_EQ(part(mouths, row.first_mouth, row.mouth_count), told[n]["mouth_areas"].get<std::vector<double>>());
    EXPECT_EQ(part(atoms, row.first_atom, row.atom_count), told[n]["atoms"].get<std::vector<std::uint32_t>>());
    double sum = 0.0;
    for (const auto& probe : part(probes, row.first_probe, row.probe_count)) sum += probe[0];
    EXPECT_NEAR(sum / row.probe_count, row.middle[0], 1e-9);
  }
  EXPECT_EQ(rows.back().first_probe + rows.back().probe_count, probes.size());
}

TEST(CPockets, RefuseWhatMakesNoSense) {
  const testing::Balls balls = testing::two_atoms(4.0);
  const Computer made = computer();
  const SurfaceOf surface = computed(made.get(), balls);
  meniscus_pockets* const before = reinterpret_cast<meniscus_pockets*>(1);
  meniscus_pockets* pockets = before;
  const auto refused = [&](const char* words, auto change) {
    meniscus_pocket_options options = default_pocket_options();
    change(options);
    const meniscus_status status = meniscus_surface_pockets(surface.get(), &options, &pockets);
    EXPECT_NE(std::strstr(meniscus_last_error(), words), nullptr) << meniscus_last_error();
    return status;
  };
  EXPECT_EQ(refused("has to be above the probe's 1.4 Å", [](auto& o) { o.large_probe_radius = 1.4; }), MENISCUS_INPUT);
  EXPECT_EQ(refused("large_probe_radius", [](auto& o) { o.large_probe_radius = 101.0; }), MENISCUS_INPUT);
  EXPECT_EQ(refused("trim is -1 Å", [](auto& o) { o.trim = -1.0; }), MENISCUS_INPUT);
  EXPECT_EQ(refused("min_volume", [](auto& o) { o.min_volume = std::nan(""); }), MENISCUS_INPUT);
  EXPECT_EQ(refused("mouth_tolerance", [](auto& o) { o.mouth_tolerance = 0.0; }), MENISCUS_INPUT);
  EXPECT_EQ(refused("meniscus_pocket_options.size", [](auto& o) { o.size = 0; }), MENISCUS_USAGE);
  EXPECT_EQ(pockets, before);
  EXPECT_EQ(meniscus_surface_pockets(nullptr, nullptr, &pockets), MENISCUS_USAGE);
  EXPECT_EQ(meniscus_surface_pockets(surface.get(), nullptr, nullptr), MENISCUS_USAGE);
  meniscus_options accessible = default_options();
  accessible.kind = MENISCUS_SAS;
  const Computer other = computer(accessible);
  EXPECT_EQ(meniscus_surface_pockets(computed(other.get(), balls).get(), nullptr, &pockets), MENISCUS_USAGE);
  accessible.kind = MENISCUS_VDW;
  const Computer without = computer(accessible);
  EXPECT_EQ(meniscus_surface_pockets(computed(without.get(), balls).get(), nullptr, &pockets), MENISCUS_USAGE);
  // A surface without pockets has tables without rows.
  ASSERT_EQ(meniscus_surface_pockets(surface.get(), nullptr, &pockets), MENISCUS_OK) << meniscus_last_error();
  const PocketsOf none(pockets, meniscus_pockets_release);
  EXPECT_TRUE(rows_of<meniscus_pocket>(none, MENISCUS_POCKETS).empty());
  meniscus_array array{};
  EXPECT_EQ(meniscus_pockets_table(none.get(), meniscus_pockets_table_id{4}, &array), MENISCUS_USAGE);
  EXPECT_EQ(meniscus_pockets_table(none.get(), MENISCUS_POCKETS, nullptr), MENISCUS_USAGE);
  EXPECT_EQ(meniscus_pockets_table(nullptr, MENISCUS_POCKETS, &array), MENISCUS_USAGE);
}

}  // namespace
}  // namespace meniscus
