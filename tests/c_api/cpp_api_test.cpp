// SPDX-License-Identifier: BSD-3-Clause
// The C++ header over the C interface: closed forms through every class, errors as exceptions, ownership.
#include <cmath>
#include <filesystem>
#include <iterator>
#include <numbers>
#include <numeric>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <unistd.h>

#include <meniscus/meniscus.hpp>

#include "core/base/version.h"

namespace {

using meniscus::Ball;
using meniscus::Computer;
using meniscus::Surface;
using meniscus::Vector;
using std::numbers::pi;

const std::vector<Ball> kOneBall = {{{1.0, 2.0, 3.0}, 2.0}};

double sum(std::span<const double> values) { return std::accumulate(values.begin(), values.end(), 0.0); }

// Two balls of the same radius lie so near that their saddle does not reach its axis.
struct Pair {
  double radius = 2.0, apart = 4.4, probe = 1.4;
  std::vector<Ball> balls = {{{0.0, 0.0, 0.0}, radius}, {{apart, 0.0, 0.0}, radius}};
  double half_angle = std::asin(apart / 2 / (radius + probe));
  double major = std::sqrt((radius + probe) * (radius + probe) - apart * apart / 4);

  double contact_area() const { return 2 * pi * radius * radius * (1 + std::sin(half_angle)); }  // of one ball
  double saddle_area() const { return 4 * pi * probe * (major * half_angle - probe * std::sin(half_angle)); }
  double cap_height() const { return radius - apart / 2; }
};

TEST(CppApi, OneBallIsASphere) {
  const Surface surface = Computer().compute({kOneBall});
  EXPECT_NEAR(surface.area(), 16 * pi, 1e-12);
  EXPECT_NEAR(surface.volume(), 32 * pi / 3, 1e-12);
  EXPECT_EQ(surface.summary().atoms, 1U);
  ASSERT_EQ(surface.components().size(), 1U);
  EXPECT_EQ(surface.components()[0].euler, 2);
  EXPECT_EQ(surface.atoms()[0].center[2], 3.0);
  EXPECT_NEAR(sum(surface.atom_sas_areas()), 4 * pi * 3.4 * 3.4, 1e-11);
}

TEST(CppApi, TwoBallsAndTheirSaddle) {
  const Pair pair;
  ASSERT_GT(pair.major, pair.probe);
  const Surface surface = Computer().compute({pair.balls});
  const double expected = 2 * pair.contact_area() + pair.saddle_area();
  EXPECT_NEAR(surface.area(), expected, 1e-11);
  EXPECT_NEAR(sum(surface.atom_areas()), expected, 1e-11);
  EXPECT_NEAR(surface.atom_areas()[0], expected / 2, 1e-11);

  ASSERT_EQ(surface.toroidal().size(), 1U);
  EXPECT_NEAR(surface.toroidal()[0].radius, pair.major, 1e-12);
  EXPECT_NEAR(surface.toroidal()[0].sweep, 2 * pi, 1e-12);
  EXPECT_EQ(surface.convex().size(), 2U);
  EXPECT_TRUE(surface.concave().empty());
  double faces = 0.0;
  for (const meniscus_face& face : surface.faces()) faces += face.area;
  EXPECT_NEAR(faces, expected, 1e-11);
  EXPECT_EQ(surface.borders().size(), 2U);
  EXPECT_EQ(surface.half_borders().size(), 4U);
  EXPECT_EQ(surface.loops().size(), 4U);
  EXPECT_EQ(surface.planes().size(), 2U);
  EXPECT_TRUE(surface.vertices().empty() && surface.contacts().empty() && surface.cuts().empty());
}

TEST(CppApi, OptionsChooseTheSurface) {
  Pair pair;
  pair.apart = 3.0;
  pair.balls[1].center[0] = 3.0;
  meniscus::Options options;
  EXPECT_EQ(options.probe_radius, 1.4);
  options.kind = MENISCUS_VDW;
  const double caps = 2 * 2 * pi * pair.radius * pair.cap_height();
  EXPECT_NEAR(Computer(options).compute({pair.balls}).area(), 2 * 16 * pi - caps, 1e-11);
  options.kind = MENISCUS_SAS;
  options.probe_radius = 0.5;
  const Surface accessible = Computer(options).compute({pair.balls});
  EXPECT_NEAR(accessible.area(), 2 * 25 * pi - 2 * 2 * pi * 2.5 * (2.5 - 1.5), 1e-11);
  EXPECT_EQ(accessible.atoms()[1].radius, 2.5);
  EXPECT_THROW(accessible.atom_sas_areas(), meniscus::UsageError);
}

TEST(CppApi, TakesDoublesFloatsAndBalls) {
  const std::vector<double> xyz = {0, 0, 0, 4.5, 0, 0}, radii = {2, 1.5};
  const std::vector<float> xyz_float(xyz.begin(), xyz.end()), radii_float(radii.begin(), radii.end());
  const std::vector<Ball> balls = {{{0, 0, 0}, 2}, {{4.5, 0, 0}, 1.5}};
  const Computer computer;
  const double area = computer.compute({xyz, radii}).area();
  EXPECT_EQ(computer.compute({xyz_float, radii_float}).area(), area);
  EXPECT_EQ(computer.compute({balls}).area(), area);
  const std::vector<double> one = {1.5}, both = {1.5, 1.5};
  EXPECT_EQ(computer.compute({xyz, one}).area(), computer.compute({xyz, both}).area());
}

TEST(CppApi, Gradients) {
  const std::vector<double> xyz = {0, 0, 0, 3, 0, 0}, radii = {1.7};
  const Surface surface = Computer().compute({xyz, radii});
  const std::vector<Vector> plain = surface.gradient(MENISCUS_GRADIENT_SAS_AREA),
                            weighted = surface.gradient(MENISCUS_GRADIENT_SAS_AREA, std::vector<double>{3, 3});
  EXPECT_NEAR(plain.at(1)[0], 2 * 3.14159265358979 * 3.1, 1e-9);
  EXPECT_NEAR(weighted.at(1)[0], 3 * plain.at(1)[0], 1e-9);
  EXPECT_THROW(surface.gradient(MENISCUS_GRADIENT_SAS_AREA, std::vector<double>{1}), meniscus::UsageError);
}

TEST(CppApi, Pockets) {
  // Atoms make a hollow ball that is open at one pole.
  std::vector<double> xyz;
  constexpr int kAtoms = 400;
  for (int n = 0; n < kAtoms - 12; ++n) {
    const double height = (2.0 * n + 1.0) / kAtoms - 1.0, turn = 2.399963 * n, width = std::sqrt(1 - height * height);
    xyz.insert(xyz.end(), {9 * width * std::cos(turn), 9 * width * std::sin(turn), 9 * height});
  }
  meniscus::PocketOptions options;
  options.min_volume = 5.0;
  const meniscus::Pockets pockets = Computer().compute({xyz, std::vector<double>{1.7}}).pockets(options);
  ASSERT_EQ(pockets.rows().size(), 1u);
  const meniscus_pocket& pocket = pockets.rows()[0];
  EXPECT_EQ(pocket.mouth_count, 1u);
  EXPECT_NEAR(pocket.volume, 1600.0, 300.0);  // volume of a ball of at least 7.3 Å, without a cap
  ASSERT_EQ(pockets.mouth_areas().size(), 1u);
  EXPECT_EQ(pockets.mouth_areas()[0], pocket.mouth_area);
  EXPECT_EQ(pockets.atoms().size(), pocket.atom_count);
  ASSERT_EQ(pockets.probes().size(), pocket.probe_count);
  for (const Vector& probe : pockets.probes())
    EXPECT_LT(std::hypot(probe[0], probe[1], probe[2]), 9.0 - 1.4);  // All probes are inside.
  options.large_probe_radius = 1.0;
  EXPECT_THROW(Computer().compute({xyz, std::vector<double>{1.7}}).pockets(options), meniscus::InputError);
}

TEST(CppApi, DistancesAndFeet) {
  const Surface surface = Computer().compute({kOneBall});
  const std::vector<Vector> points = {{1, 2, 8}, {1, 2, 3.5}};
  const std::vector<double> distances = surface.distance(points);
  EXPECT_NEAR(distances.at(0), 3.0, 1e-12);
  EXPECT_NEAR(distances.at(1), -1.5, 1e-12);
  const Surface::Nearest found = surface.nearest(points);
  EXPECT_EQ(found.distances, distances);
  EXPECT_NEAR(found.feet.at(1)[2], 5.0, 1e-12);
  EXPECT_TRUE(surface.distance({}).empty() && surface.nearest({}).feet.empty());
}

TEST(CppApi, AMeshIsClosedAndOutlivesItsSurface) {
  meniscus::MeshOptions options;
  options.tolerance = 0.05;
  const meniscus::Mesh mesh = Computer().compute({kOneBall}).mesh(options);
  const std::size_t triangles = mesh.triangles().size();
  EXPECT_EQ(mesh.positions().size(), 2 + triangles / 2);  // Euler's formula gives this count.
  for (const Vector& p : mesh.positions()) EXPECT_NEAR(std::hypot(p[0] - 1, p[1] - 2, p[2] - 3), 2.0, 1e-9);
  EXPECT_EQ(mesh.normals().size(), mesh.positions().size());
  for (const std::size_t size :
       {mesh.triangle_atoms().size(), mesh.triangle_kinds().size(), mesh.triangle_faces().size(),
        mesh.triangle_patches().size(), mesh.triangle_components().size()})
    EXPECT_EQ(size, triangles);
  EXPECT_EQ(mesh.triangle_kinds()[0], MENISCUS_KIND_CONVEX);
  EXPECT_TRUE(mesh.sharp_corners().empty() && mesh.sharp_normals().empty());
  meniscus::MeshFile file;
  file.format = "off";
  const std::string path = ::testing::TempDir() + "cpp_api_test_" + std::to_string(::getpid()) + ".mesh";
  mesh.save(path, file);
  EXPECT_THROW(mesh.save(path, file), meniscus::OutputError);
  EXPECT_THROW(mesh.save(path), meniscus::UsageError);  // The name's ending tells no format.
  EXPECT_TRUE(std::filesystem::remove(path));
  EXPECT_GT(Computer().compute({kOneBall}).mesh().positions().size(), mesh.positions().size());  // 0.01 Å
}

TEST(CppApi, ErrorsAreExceptionsWithTheLibrarysText) {
  const Computer computer;
  const std::vector<double> xyz = {0, 0, 0, 4, 0, 0}, wrong = {1.0, -1.0}, three = {1, 1, 1};
  try {
    computer.compute({xyz, wrong});
    FAIL() << "a radius below 0";
  } catch (const meniscus::InputError& error) {
    EXPECT_EQ(error.status(), MENISCUS_INPUT);
    EXPECT_NE(std::string(error.what()).find("radius of atom 1 is -1"), std::string::npos) << error.what();
  }
  EXPECT_THROW(computer.compute({xyz, three}), meniscus::UsageError);
  EXPECT_THROW(computer.compute({wrong, three}), meniscus::UsageError);
  EXPECT_THROW(computer.compute({std::span<const Ball>()}), meniscus::InputError);
  EXPECT_THROW(meniscus::radius_of(119), meniscus::InputError);
  EXPECT_THROW(meniscus::check(MENISCUS_NOT_CLOSED), meniscus::NotClosedError);
  EXPECT_THROW(meniscus::check(MENISCUS_CAPACITY), meniscus::CapacityError);
  EXPECT_THROW(meniscus::check(MENISCUS_INTERNAL), meniscus::InternalError);
  EXPECT_THROW(meniscus::check(MENISCUS_NO_GPU), meniscus::GpuError);
  EXPECT_THROW(meniscus::check(static_cast<meniscus_status>(6)), meniscus::Error);
}

TEST(CppApi, TheNextFrameIsComputedInPlaceAndAFailedOneLeavesTheLast) {
  const Computer computer;
  std::vector<Ball> balls = kOneBall;
  Surface surface = computer.compute({balls});
  const meniscus_surface* const before = surface.get();
  balls[0].radius = 3.0;
  computer.recompute({balls}, surface);
  EXPECT_EQ(surface.get(), before);
  EXPECT_NEAR(surface.area(), 36 * pi, 1e-11);
  balls[0].radius = -3.0;
  EXPECT_THROW(computer.recompute({balls}, surface), meniscus::InputError);
  EXPECT_NEAR(surface.area(), 36 * pi, 1e-11);
}

TEST(CppApi, OwnersMoveAndDoNotCopy) {
  static_assert(!std::is_copy_constructible_v<Surface> && std::is_nothrow_move_constructible_v<Surface>);
  static_assert(!std::is_copy_constructible_v<Computer> && std::is_nothrow_move_constructible_v<Computer>);
  static_assert(!std::is_copy_constructible_v<meniscus::Mesh> && !std::is_copy_constructible_v<meniscus::Renderer>);
  Surface first = Computer().compute({kOneBall});
  const std::span<const double> areas = first.atom_areas();
  Surface second = std::move(first);
  // NOLINTBEGIN(bugprone-use-after-move,clang-analyzer-cplusplus.Move): moved objects are under test
  EXPECT_EQ(first.get(), nullptr);
  EXPECT_THROW(first.area(), meniscus::UsageError);
  // NOLINTEND(bugprone-use-after-move,clang-analyzer-cplusplus.Move)
  EXPECT_EQ(second.atom_areas().data(), areas.data());
}

TEST(CppApi, RowsMayBeLongerThanThisHeaderKnows) {
  struct Longer {
    meniscus_loop loop;
    double of_a_newer_library;
  };
  const std::vector<Longer> table = {{{1, 2}, 0.5}, {{3, 4}, 0.5}, {{5, 6}, 0.5}};
  const meniscus::Rows<meniscus_loop> rows({table.data(), table.size(), sizeof(Longer)});
  EXPECT_EQ(rows[2].half_border_count, 6U);
  std::uint32_t firsts = 0;
  for (const meniscus_loop& row : rows) firsts = 10 * firsts + row.first_half_border;
  EXPECT_EQ(firsts, 135U);
  EXPECT_EQ(std::next(rows.begin())->first_half_border, 3U);
}

TEST(CppApi, RadiiByElement) {
  EXPECT_EQ(meniscus::element_of("zn"), 30);
  EXPECT_EQ(meniscus::radius_of(6).radius, 1.70);
  EXPECT_EQ(std::string(meniscus::radius_of(0).source), "no published value");
  EXPECT_EQ(meniscus::version(), MENISCUS_VERSION);
}

}  // namespace
