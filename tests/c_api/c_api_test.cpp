// SPDX-License-Identifier: BSD-3-Clause
// The C interface: numbers, closed forms, refusals, structs of other versions, ownership.
#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>
#include <numeric>
#include <string>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/surface/compute_surface.h"
#include "tests/c_api/c_objects.h"
#include "tests/support/run_program.h"
#include "tests/support/sphere_tracer.h"

namespace meniscus {
namespace {

using namespace test;
using std::numbers::pi;

double sum(const std::vector<double>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

TEST(CApi, GivesTheNumbersOfTheProgramToTheLastDigit) {
  const testing::Balls balls = testing::enterotoxin();
  std::string lines;
  for (const Ball& b : balls) lines += fmt::format("{} {} {} {}\n", b.center.x, b.center.y, b.center.z, b.radius);
  const TemporaryFolder folder;
  const ProgramResult program = run_program(
      test::meniscus_program(), {"surface", "-q", "--device", "cpu", "--json", folder.file("t.xyzr", lines)});
  ASSERT_EQ(program.exit_code, 0) << program.err;
  const auto json = nlohmann::json::parse(program.out);

  const Computer made = computer();
  const SurfaceOf surface = computed(made.get(), balls);
  const meniscus_summary summary = summary_of(surface);
  EXPECT_EQ(summary.area, json.at("area").get<double>());
  EXPECT_EQ(summary.volume, json.at("volume").get<double>());
  EXPECT_EQ(summary.atoms, balls.size());
  EXPECT_EQ(std::string(summary.device).substr(0, 3), "cpu");
}

TEST(CApi, ShowsEveryTableOfTheSurface) {
  const testing::Balls balls = testing::ubiquitin();
  const Surface direct = compute_surface_cpu(balls, 1.4);
  const Computer made = computer();
  const SurfaceOf surface = computed(made.get(), balls);
  const meniscus_summary summary = summary_of(surface);
  const SurfaceCounts counts = direct.counts();
  EXPECT_EQ(summary.area, direct.area);
  EXPECT_EQ(summary.convex, counts.convex);
  EXPECT_EQ(summary.toroidal, counts.toroidal);
  EXPECT_EQ(summary.concave, counts.concave);
  EXPECT_EQ(summary.fixed_probes, counts.fixed_probes);
  EXPECT_EQ(summary.arcs, counts.arcs);
  EXPECT_EQ(summary.spindle, counts.spindle);
  EXPECT_EQ(summary.faces, direct.faces.size());
  EXPECT_EQ(summary.components, direct.components.size());

  const auto components = rows_of<meniscus_component>(surface, MENISCUS_COMPONENTS);
  ASSERT_EQ(components.size(), direct.components.size());
  double volume = 0.0;
  for (const meniscus_component& component : components) volume += component.volume;
  EXPECT_NEAR(volume, summary.volume, 1e-9);
  EXPECT_EQ(components[0].kind, MENISCUS_OUTER);

  EXPECT_EQ(rows_of<meniscus_convex>(surface, MENISCUS_CONVEX).size(), direct.convex.size());
  const auto toroidal = rows_of<meniscus_toroidal>(surface, MENISCUS_TOROIDAL);
  ASSERT_EQ(toroidal.size(), direct.toroidal.size());
  EXPECT_EQ(toroidal.back().sweep, direct.toroidal.back().sweep);
  EXPECT_EQ(toroidal.back().axis[2], direct.toroidal.back().axis.z);
  EXPECT_EQ(toroidal.back().face_count, direct.toroidal.back().face_count);
  const auto concave = rows_of<meniscus_concave>(surface, MENISCUS_CONCAVE);
  ASSERT_EQ(concave.size(), direct.concave.size());
  EXPECT_EQ(concave.back().first_face, direct.concave.back().first_face);
  EXPECT_EQ(rows_of<meniscus_plane>(surface, MENISCUS_PLANES).size(), direct.planes.size());
  EXPECT_EQ(rows_of<std::uint32_t>(surface, MENISCUS_CONTACTS), direct.contacts);
  EXPECT_EQ(rows_of<std::uint32_t>(surface, MENISCUS_CUTS), direct.cuts);
  EXPECT_EQ(rows_of<glm::dvec3>(surface, MENISCUS_VERTICES), direct.vertices);
  const auto borders = rows_of<meniscus_border>(surface, MENISCUS_BORDERS);
  ASSERT_EQ(borders.size(), direct.borders.size());
  EXPECT_EQ(borders.back().face[1], direct.borders.back().face[1]);
  EXPECT_EQ(rows_of<std::uint32_t>(surface, MENISCUS_HALF_BORDERS), direct.half_borders);
  EXPECT_EQ(rows_of<meniscus_loop>(surface, MENISCUS_LOOPS).size(), direct.loops.size());
  double area = 0.0;
  for (const meniscus_face& face : rows_of<meniscus_face>(surface, MENISCUS_FACES)) area += face.area;
  EXPECT_NEAR(area, summary.area, 1e-9);
  EXPECT_EQ(rows_of<meniscus_ball>(surface, MENISCUS_ATOMS).size(), balls.size());
  EXPECT_NEAR(sum(rows_of<double>(surface, MENISCUS_ATOM_AREAS)), summary.area, 1e-6);
}

TEST(CApi, OneSphereIsOneSphere) {
  const testing::Balls one{{{1.0, 2.0, 3.0}, 1.7}};
  for (const meniscus_kind kind : {MENISCUS_SES, MENISCUS_SAS, MENISCUS_VDW}) {
    meniscus_options options = default_options();
    options.kind = kind;
    const Computer made = computer(options);
    const SurfaceOf surface = computed(made.get(), one);
    const double radius = kind == MENISCUS_SAS ? 1.7 + 1.4 : 1.7;
    EXPECT_NEAR(summary_of(surface).area, 4 * pi * radius * radius, 1e-11);
    EXPECT_NEAR(summary_of(surface).volume, 4 * pi / 3 * std::pow(radius, 3), 1e-11);
    meniscus_array array{};
    EXPECT_EQ(meniscus_surface_table(surface.get(), MENISCUS_ATOM_SAS_AREAS, &array),
              kind == MENISCUS_SES ? MENISCUS_OK : MENISCUS_USAGE);
    if (kind == MENISCUS_SES) {
      EXPECT_NEAR(*static_cast<const double*>(array.data), 4 * pi * 3.1 * 3.1, 1e-11);
    }
  }
}

// docs/explanation/theory.md has the closed form.
TEST(CApi, TwoSpheresAreTheirClosedForm) {
  const double r = 1.7, p = 1.4, d = 4.0, R = r + p, T = std::sqrt(R * R - d * d / 4), phi = std::asin(d / (2 * R));
  const Computer made = computer();
  const SurfaceOf surface = computed(made.get(), testing::two_atoms(d));
  const double expected = 4 * pi * r * r * (1 + std::sin(phi)) + 2 * pi * p * (2 * phi * T - 2 * p * std::sin(phi));
  EXPECT_NEAR(summary_of(surface).area, expected, 1e-11);
  EXPECT_NEAR(sum(rows_of<double>(surface, MENISCUS_ATOM_SAS_AREAS)), 4 * pi * R * R * (1 + std::sin(phi)), 1e-11);
  EXPECT_EQ(summary_of(surface).free_edges, 1u);
}

TEST(CApi, TheNextFrameIsComputedInPlaceUnlessItIsHeld) {
  const testing::Balls first = testing::two_atoms(4.0), second = testing::collinear(5, 1.5);
  const Computer made = computer();
  const Computer other = computer();
  SurfaceOf surface = computed(made.get(), first);
  const double area_of_first = summary_of(surface).area;
  const meniscus_atoms atoms = atoms_of(second);

  meniscus_surface* const before = surface.get();
  meniscus_surface* handle = surface.release();
  EXPECT_EQ(meniscus_recompute(made.get(), &atoms, &handle), MENISCUS_OK);
  EXPECT_EQ(handle, before);
  surface.reset(handle);
  const double area_of_second = summary_of(surface).area;
  EXPECT_EQ(area_of_second, compute_surface_cpu(second, 1.4).area);

  const SurfaceOf held(meniscus_surface_retain(surface.get()));
  const meniscus_atoms again = atoms_of(first);
  handle = surface.release();
  EXPECT_EQ(meniscus_recompute(other.get(), &again, &handle), MENISCUS_OK);
  EXPECT_NE(handle, held.get());
  surface.reset(handle);
  EXPECT_EQ(summary_of(surface).area, area_of_first);
  EXPECT_EQ(summary_of(held).area, area_of_second);
}

TEST(CApi, ReadsFloatsAndStridesAndOneRadiusForAll) {
  struct Row {
    char name[4];
    float x, y, z;
  };
  const std::vector<Row> rows{{"A", 0.0f, 0.0f, 0.0f}, {"B", 1.5f, 0.25f, 0.0f}, {"C", 3.0f, 0.0f, 0.5f}};
  const float radius = 1.75f;
  meniscus_atoms atoms{};
  atoms.size = sizeof atoms;
  atoms.count = rows.size();
  atoms.positions = &rows[0].x;
  atoms.positions_stride = sizeof(Row);
  atoms.positions_type = atoms.radii_type = MENISCUS_FLOAT;
  atoms.radii = &radius;
  atoms.equal_radii = 1;
  const Computer made = computer();
  meniscus_surface* surface = nullptr;
  ASSERT_EQ(meniscus_compute(made.get(), &atoms, &surface), MENISCUS_OK) << meniscus_last_error();
  const SurfaceOf owned(surface);
  const testing::Balls same{{{0.0, 0.0, 0.0}, 1.75}, {{1.5, 0.25, 0.0}, 1.75}, {{3.0, 0.0, 0.5}, 1.75}};
  EXPECT_EQ(summary_of(owned).area, compute_surface_cpu(same, 1.4).area);
}

struct BadAtoms {
  const char* what;
  void (*spoil)(testing::Balls&, meniscus_atoms&);
  meniscus_status status;
  const char* text;
};

constexpr double kInfinity = std::numeric_limits<double>::infinity();

const BadAtoms kBadAtoms[] = {
    {"NaN", [](auto& b, auto&) { b[2].center.y = std::nan(""); }, MENISCUS_INPUT, "y of atom 2 is nan"},
    {"infinity", [](auto& b, auto&) { b[1].center.z = -kInfinity; }, MENISCUS_INPUT, "z of atom 1 is -inf"},
    {"far away", [](auto& b, auto&) { b[0].center.x = 2e5; }, MENISCUS_INPUT, "x of atom 0 is 200000"},
    {"negative radius", [](auto& b, auto&) { b[3].radius = -1.5; }, MENISCUS_INPUT, "radius of atom 3 is -1.5"},
    {"no radius", [](auto& b, auto&) { b[3].radius = 0.0; }, MENISCUS_INPUT, "radius of atom 3 is 0"},
    {"NaN radius", [](auto& b, auto&) { b[0].radius = std::nan(""); }, MENISCUS_INPUT, "radius of atom 0 is nan"},
    {"huge radius", [](auto& b, auto&) { b[0].radius = 1e4; }, MENISCUS_INPUT, "radius of atom 0 is 10000"},
    {"no atoms", [](auto&, auto& a) { a.count = 0; }, MENISCUS_INPUT, "no atoms"},
    {"too many", [](auto&, auto& a) { a.count = ~std::size_t{0}; }, MENISCUS_CAPACITY, "18446744073709551615 atoms"},
    {"no positions", [](auto&, auto& a) { a.positions = nullptr; }, MENISCUS_USAGE, "positions is NULL"},
    {"no radii", [](auto&, auto& a) { a.radii = nullptr; }, MENISCUS_USAGE, "radii is NULL"},
    {"short rows", [](auto&, auto& a) { a.positions_stride = 8; }, MENISCUS_USAGE, "positions_stride is 8"},
    {"crooked rows", [](auto&, auto& a) { a.positions_stride = 33; }, MENISCUS_USAGE, "positions_stride is 33"},
    {"unknown type", [](auto&, auto& a) { a.radii_type = meniscus_number_type{7}; }, MENISCUS_USAGE, "radii_type is 7"},
    {"no size", [](auto&, auto& a) { a.size = 0; }, MENISCUS_USAGE, "meniscus_atoms.size is 0"},
};

TEST(CApi, RefusesBadAtomsByIndexAndValueAndKeepsTheSurface) {
  const Computer made = computer();
  SurfaceOf surface = computed(made.get(), testing::collinear(5, 1.5));
  const double area = summary_of(surface).area;
  for (const BadAtoms& bad : kBadAtoms) {
    SCOPED_TRACE(bad.what);
    testing::Balls balls = testing::collinear(5, 1.5);
    meniscus_atoms atoms = atoms_of(balls);
    bad.spoil(balls, atoms);
    meniscus_surface* handle = surface.get();
    EXPECT_EQ(meniscus_compute(made.get(), &atoms, &handle), bad.status);
    EXPECT_EQ(handle, surface.get());
    EXPECT_EQ(meniscus_recompute(made.get(), &atoms, &handle), bad.status);
    EXPECT_EQ(handle, surface.get());
    EXPECT_NE(std::string(meniscus_last_error()).find(bad.text), std::string::npos) << meniscus_last_error();
    EXPECT_EQ(summary_of(surface).area, area);
  }
}

TEST(CApi, RefusesBadOptions) {
  const auto refused = [](auto change) {
    meniscus_options options = default_options();
    change(options);
    meniscus_computer* made = nullptr;
    const meniscus_status status = meniscus_computer_new(&options, &made);
    EXPECT_EQ(made, nullptr);
    return status;
  };
  EXPECT_EQ(refused([](auto& o) { o.probe_radius = std::nan(""); }), MENISCUS_INPUT);
  EXPECT_EQ(refused([](auto& o) { o.probe_radius = -1.4; }), MENISCUS_INPUT);
  EXPECT_NE(std::strstr(meniscus_last_error(), "probe_radius: -1.4 Å is negative"), nullptr) << meniscus_last_error();
  EXPECT_EQ(refused([](auto& o) { o.probe_radius = 1e-4; }), MENISCUS_INPUT);
  EXPECT_EQ(refused([](auto& o) { o.probe_radius = kInfinity; }), MENISCUS_INPUT);
  // A struct of zeros but for its size would mean a surface without a probe.
  for (const meniscus_kind kind : {MENISCUS_SES, MENISCUS_SAS}) {
    const auto zeros = [kind](auto& o) { o = {sizeof o, 0.0, kind, MENISCUS_CPU, 0, 0}; };
    EXPECT_EQ(refused(zeros), MENISCUS_INPUT);
    EXPECT_NE(std::strstr(meniscus_last_error(),
                          "probe_radius is 0; set it (MENISCUS_OPTIONS_INIT has 1.4 Å), or "
                          "choose MENISCUS_VDW"),
              nullptr)
        << meniscus_last_error();
  }
  meniscus_options without = default_options();
  without.kind = MENISCUS_VDW;
  without.probe_radius = 0.0;
  EXPECT_TRUE(computer(without));
  EXPECT_EQ(refused([](auto& o) { o.kind = meniscus_kind{3}; }), MENISCUS_USAGE);
  EXPECT_EQ(refused([](auto& o) { o.device = meniscus_device{-1}; }), MENISCUS_USAGE);
  EXPECT_EQ(refused([](auto& o) { o.threads = -1; }), MENISCUS_USAGE);
  EXPECT_EQ(meniscus_computer_new(nullptr, nullptr), MENISCUS_USAGE);
}

TEST(CApi, GradientsOfWhatHasThem) {
  const testing::Balls balls = testing::two_atoms(4.0);
  const Computer made = computer();
  const SurfaceOf surface = computed(made.get(), balls);
  double gradient[6], weighted[6];
  const double step = 1e-4, accessible = testing::kCarbon + 1.4;
  const SurfaceOf nearer = computed(made.get(), testing::two_atoms(4.0 - step));
  const SurfaceOf farther = computed(made.get(), testing::two_atoms(4.0 + step));
  const meniscus_summary less = summary_of(nearer), more = summary_of(farther);
  // The accessible surface has two caps of height R + d / 2 on either side: 2 pi R and pi (R^2 - d^2 / 4).
  const double along_axis[] = {(more.area - less.area) / (2 * step), (more.volume - less.volume) / (2 * step),
                               2 * pi * accessible, pi * (accessible * accessible - 4.0)};
  for (const meniscus_quantity quantity :
       {MENISCUS_GRADIENT_AREA, MENISCUS_GRADIENT_VOLUME, MENISCUS_GRADIENT_SAS_AREA, MENISCUS_GRADIENT_SAS_VOLUME}) {
    ASSERT_EQ(meniscus_surface_gradient(surface.get(), quantity, nullptr, gradient), MENISCUS_OK);
    EXPECT_NEAR(gradient[3], along_axis[quantity], 1e-6) << quantity;
    EXPECT_NEAR(gradient[0], -gradient[3], 1e-12);
  }
  const double weights[2] = {2.0, 2.0}, wrong[2] = {1.0, std::nan("")};
  ASSERT_EQ(meniscus_surface_gradient(surface.get(), MENISCUS_GRADIENT_SAS_AREA, nullptr, gradient), MENISCUS_OK);
  ASSERT_EQ(meniscus_surface_gradient(surface.get(), MENISCUS_GRADIENT_SAS_AREA, weights, weighted), MENISCUS_OK);
  EXPECT_NEAR(weighted[3], 2 * gradient[3], 1e-12);
  EXPECT_EQ(meniscus_surface_gradient(surface.get(), MENISCUS_GRADIENT_SAS_AREA, wrong, weighted), MENISCUS_INPUT);
  EXPECT_EQ(meniscus_surface_gradient(surface.get(), MENISCUS_GRADIENT_AREA, weights, weighted), MENISCUS_USAGE);
  EXPECT_EQ(meniscus_surface_gradient(surface.get(), meniscus_quantity{4}, nullptr, weighted), MENISCUS_USAGE);
  EXPECT_EQ(meniscus_surface_gradient(surface.get(), meniscus_quantity{-1}, nullptr, weighted), MENISCUS_USAGE);
  EXPECT_EQ(meniscus_surface_gradient(surface.get(), meniscus_quantity{0}, nullptr, nullptr), MENISCUS_USAGE);
  EXPECT_NEAR(weighted[3], 2 * gradient[3], 1e-12);  // The gradient stays unchanged.
  const SurfaceOf square = computed(made.get(), testing::ring(4, 3.4));
  double of_square[12];
  EXPECT_EQ(meniscus_surface_gradient(square.get(), MENISCUS_GRADIENT_VOLUME, nullptr, of_square), MENISCUS_INPUT);
  EXPECT_NE(std::strstr(meniscus_last_error(), "4 atoms at once"), nullptr) << meniscus_last_error();
}

TEST(CApi, RefusesNullAndUnknownTables) {
  const Computer made = computer();
  const SurfaceOf surface = computed(made.get(), testing::two_atoms(4.0));
  meniscus_array array{};
  meniscus_summary summary{};
  double number = 0.0;
  std::int32_t element = 0;
  EXPECT_EQ(meniscus_compute(nullptr, nullptr, nullptr), MENISCUS_USAGE);
  EXPECT_EQ(meniscus_surface_summary(nullptr, &summary), MENISCUS_USAGE);
  EXPECT_EQ(meniscus_surface_summary(surface.get(), &summary), MENISCUS_USAGE);  // Its size is missing.
  EXPECT_EQ(meniscus_surface_table(surface.get(), meniscus_surface_table_id{15}, &array), MENISCUS_USAGE);
  EXPECT_EQ(meniscus_surface_table(surface.get(), meniscus_surface_table_id{-1}, &array), MENISCUS_USAGE);
  EXPECT_EQ(meniscus_surface_table(surface.get(), MENISCUS_COMPONENTS, nullptr), MENISCUS_USAGE);
  EXPECT_EQ(meniscus_surface_distance(surface.get(), 1, nullptr, &number, nullptr), MENISCUS_USAGE);
  EXPECT_EQ(meniscus_surface_mesh(nullptr, nullptr, nullptr), MENISCUS_USAGE);
  EXPECT_EQ(meniscus_mesh_table(nullptr, MENISCUS_MESH_POSITIONS, &array), MENISCUS_USAGE);
  EXPECT_EQ(meniscus_element_of_symbol(nullptr, &element), MENISCUS_USAGE);
  EXPECT_EQ(meniscus_element_radius(119, &number, nullptr), MENISCUS_INPUT);
  meniscus_surface_release(nullptr);
  EXPECT_EQ(meniscus_surface_retain(nullptr), nullptr);
}

// A caller with an older header passes such structs: unknown fields have their defaults.
TEST(CApi, TakesAStructOfAnOlderHeader) {
  meniscus_options options = default_options();
  options.size = offsetof(meniscus_options, kind);
  options.probe_radius = 2.0;
  options.kind = MENISCUS_VDW;  // The field lies behind the end and must not be read.
  const Computer made = computer(options);
  const testing::Balls balls = testing::two_atoms(4.0);
  EXPECT_EQ(summary_of(computed(made.get(), balls)).area, compute_surface_cpu(balls, 2.0).area);

  const SurfaceOf surface = computed(made.get(), balls);
  meniscus_summary summary{};
  summary.size = offsetof(meniscus_summary, volume);
  summary.volume = -1.0;
  ASSERT_EQ(meniscus_surface_summary(surface.get(), &summary), MENISCUS_OK);
  EXPECT_GT(summary.area, 0.0);
  EXPECT_EQ(summary.volume, -1.0);
  EXPECT_EQ(summary.size, offsetof(meniscus_summary, volume));
}

TEST(CApi, TakesAStructOfANewerHeaderThatAsksForNothingNew) {
  struct Newer {
    meniscus_options known;
    double unknown;
  } newer{default_options(), 0.0};
  newer.known.size = sizeof newer;
  meniscus_computer* made = nullptr;
  EXPECT_EQ(meniscus_computer_new(&newer.known, &made), MENISCUS_OK) << meniscus_last_error();
  meniscus_computer_release(made);
  made = nullptr;
  newer.unknown = 1.0;
  EXPECT_EQ(meniscus_computer_new(&newer.known, &made), MENISCUS_USAGE);
  EXPECT_EQ(made, nullptr);
}

TEST(CApi, KnowsRadiiByElement) {
  std::int32_t element = -1;
  double radius = 0.0;
  const char* source = nullptr;
  ASSERT_EQ(meniscus_element_of_symbol("zn", &element), MENISCUS_OK);
  EXPECT_EQ(element, 30);
  ASSERT_EQ(meniscus_element_radius(element, &radius, &source), MENISCUS_OK);
  EXPECT_EQ(radius, 1.39);
  EXPECT_STREQ(source, "Bondi 1964, 1966");
  ASSERT_EQ(meniscus_element_of_symbol("Q", &element), MENISCUS_OK);
  EXPECT_EQ(element, 0);
}

TEST(CApi, DistancesAreThoseOfTheOracle) {
  const testing::Balls balls = testing::ubiquitin();
  const testing::SphereTracer oracle(balls, 1.4, 2.0);
  const Computer made = computer();
  const SurfaceOf surface = computed(made.get(), balls);
  std::vector<double> points, distances(balls.size()), nearest(3 * balls.size());
  for (const double aside : {0.0, 0.1}) {
    points.clear();
    for (const Ball& ball : balls)
      for (int axis = 0; axis < 3; ++axis) points.push_back(ball.center[axis] + aside);
    ASSERT_EQ(meniscus_surface_distance(surface.get(), balls.size(), points.data(), distances.data(), nearest.data()),
              MENISCUS_OK);
    for (std::size_t n = 0; n < balls.size(); ++n) {
      const glm::dvec3 point(points[3 * n], points[3 * n + 1], points[3 * n + 2]);
      const double to_probe = oracle.nearest(point).distance;
      if (to_probe < oracle.reach()) {
        EXPECT_NEAR(distances[n], 1.4 - to_probe, 1e-9);
      }
      const glm::dvec3 foot(nearest[3 * n], nearest[3 * n + 1], nearest[3 * n + 2]);
      EXPECT_NEAR(glm::distance(point, foot), -distances[n], 1e-9);
      EXPECT_NEAR(oracle.nearest(foot).distance, 1.4, 1e-9);
    }
  }
  points[5] = 1e160;
  EXPECT_EQ(meniscus_surface_distance(surface.get(), balls.size(), points.data(), distances.data(), nullptr),
            MENISCUS_INPUT);
  EXPECT_NE(std::strstr(meniscus_last_error(), "z of point 1 is 1e+160 Å"), nullptr) << meniscus_last_error();
  points[4] = std::nan("");
  EXPECT_EQ(meniscus_surface_distance(surface.get(), balls.size(), points.data(), distances.data(), nullptr),
            MENISCUS_INPUT);
  EXPECT_NE(std::strstr(meniscus_last_error(), "y of point 1 is nan"), nullptr) << meniscus_last_error();
}

TEST(CApi, MeshesLieOnTheSurface) {
  const testing::Balls balls = testing::collinear(5, 1.5);
  const Computer made = computer();
  const SurfaceOf surface = computed(made.get(), balls);
  meniscus_mesh_options options{};
  options.size = sizeof options;
  ASSERT_EQ(meniscus_default_mesh_options(&options), MENISCUS_OK);
  options.tolerance = 0.05;
  meniscus_mesh* handle = nullptr;
  ASSERT_EQ(meniscus_surface_mesh(surface.get(), &options, &handle), MENISCUS_OK) << meniscus_last_error();
  const Mesh mesh(handle);
  meniscus_array positions{}, triangles{}, atoms{}, kinds{}, normals{};
  ASSERT_EQ(meniscus_mesh_table(mesh.get(), MENISCUS_MESH_POSITIONS, &positions), MENISCUS_OK);
  ASSERT_EQ(meniscus_mesh_table(mesh.get(), MENISCUS_MESH_NORMALS, &normals), MENISCUS_OK);
  ASSERT_EQ(meniscus_mesh_table(mesh.get(), MENISCUS_MESH_TRIANGLES, &triangles), MENISCUS_OK);
  ASSERT_EQ(meniscus_mesh_table(mesh.get(), MENISCUS_MESH_TRIANGLE_ATOMS, &atoms), MENISCUS_OK);
  ASSERT_EQ(meniscus_mesh_table(mesh.get(), MENISCUS_MESH_TRIANGLE_KINDS, &kinds), MENISCUS_OK);
  EXPECT_EQ(positions.count, normals.count);
  EXPECT_EQ(triangles.count, atoms.count);
  EXPECT_EQ(triangles.count, kinds.count);
  EXPECT_EQ(kinds.stride, 1u);
  EXPECT_EQ(triangles.count, 2 * positions.count - 4);  // The mesh is one sphere.
  std::vector<double> distances(positions.count);
  ASSERT_EQ(meniscus_surface_distance(surface.get(), positions.count, static_cast<const double*>(positions.data),
                                      distances.data(), nullptr),
            MENISCUS_OK);
  for (const double distance : distances) EXPECT_NEAR(distance, 0.0, 1e-12);
  options.tolerance = -1.0;
  handle = nullptr;
  EXPECT_EQ(meniscus_surface_mesh(surface.get(), &options, &handle), MENISCUS_INPUT);
  EXPECT_EQ(handle, nullptr);
}

TEST(CApi, EvenMeshesHaveTheDensityAskedFor) {
  const testing::Balls balls = testing::collinear(5, 1.5);
  const Computer made = computer();
  const SurfaceOf surface = computed(made.get(), balls);
  meniscus_summary summary{};
  summary.size = sizeof summary;
  ASSERT_EQ(meniscus_surface_summary(surface.get(), &summary), MENISCUS_OK);
  meniscus_mesh_options options{};
  options.size = sizeof options;
  ASSERT_EQ(meniscus_default_mesh_options(&options), MENISCUS_OK);
  EXPECT_EQ(options.method, MENISCUS_MESH_BY_PATCH);
  EXPECT_EQ(options.density, 0.0);
  options.method = MENISCUS_MESH_BY_DENSITY;
  options.density = 3.0;
  meniscus_mesh* handle = nullptr;
  ASSERT_EQ(meniscus_surface_mesh(surface.get(), &options, &handle), MENISCUS_OK) << meniscus_last_error();
  const Mesh mesh(handle);
  meniscus_array positions{}, triangles{}, atoms{};
  ASSERT_EQ(meniscus_mesh_table(mesh.get(), MENISCUS_MESH_POSITIONS, &positions), MENISCUS_OK);
  ASSERT_EQ(meniscus_mesh_table(mesh.get(), MENISCUS_MESH_TRIANGLES, &triangles), MENISCUS_OK);
  ASSERT_EQ(meniscus_mesh_table(mesh.get(), MENISCUS_MESH_VERTEX_ATOMS, &atoms), MENISCUS_OK);
  EXPECT_EQ(triangles.count, 2 * positions.count - 4);
  EXPECT_EQ(atoms.count, positions.count);
  EXPECT_NEAR(static_cast<double>(positions.count) / (3.0 * summary.area), 1.0, 0.2);
  for (const double density : {-1.0, 1e-9, 1e9, std::nan("")}) {
    options.density = density;
    handle = nullptr;
    EXPECT_EQ(meniscus_surface_mesh(surface.get(), &options, &handle), MENISCUS_INPUT) << density;
    EXPECT_EQ(handle, nullptr);
  }
}

TEST(CApi, AMethodOfMeshesRefusesTheNumbersOfAnother) {
  const Computer made = computer();
  const SurfaceOf surface = computed(made.get(), testing::two_atoms(4.0));
  const auto refused = [&](meniscus_mesh_method method, double tolerance, double density) {
    meniscus_mesh_options options{};
    options.size = sizeof options;
    EXPECT_EQ(meniscus_default_mesh_options(&options), MENISCUS_OK);
    options.method = method;
    options.tolerance = tolerance;
    options.density = density;
    meniscus_mesh* handle = nullptr;
    EXPECT_EQ(meniscus_surface_mesh(surface.get(), &options, &handle), MENISCUS_USAGE);
    EXPECT_EQ(handle, nullptr);
    return std::string(meniscus_last_error());
  };
  EXPECT_TRUE(refused(MENISCUS_MESH_BY_PATCH, 0.05, 1.0).starts_with("density is 1"));
  EXPECT_TRUE(refused(MENISCUS_MESH_EVEN, 0.05, 1.0).starts_with("density is 1"));
  EXPECT_TRUE(refused(MENISCUS_MESH_BY_DENSITY, 0.05, 1.0).starts_with("tolerance is 0.05"));
  EXPECT_TRUE(refused(meniscus_mesh_method{3}, 0.01, 0.0).starts_with("method is 3"));
}

TEST(CApi, RecomputingNeedsASurface) {
  const Computer made = computer();
  const testing::Balls balls = testing::two_atoms(4.0);
  const meniscus_atoms atoms = atoms_of(balls);
  meniscus_surface* none = nullptr;
  EXPECT_EQ(meniscus_recompute(made.get(), &atoms, &none), MENISCUS_USAGE);
  EXPECT_STREQ(meniscus_last_error(), "*surface is NULL");
}

}  // namespace
TEST(CApi, AMeshIsSavedThoughItsSurfaceIsGone) {
  const testing::Balls balls = testing::collinear(5, 1.5);
  const Computer made = computer();
  SurfaceOf surface = computed(made.get(), balls);
  const auto mesh_of = [](const SurfaceOf& of) {
    meniscus_mesh* handle = nullptr;
    EXPECT_EQ(meniscus_surface_mesh(of.get(), nullptr, &handle), MENISCUS_OK) << meniscus_last_error();
    return Mesh(handle);
  };
  const TemporaryFolder folder;
  const auto save = [&](const Mesh& mesh, const char* name) {
    const std::string path = folder.path() / name;
    EXPECT_EQ(meniscus_mesh_save(mesh.get(), path.c_str(), nullptr), MENISCUS_OK) << meniscus_last_error();
    return read_bytes(path);
  };
  const Mesh mesh = mesh_of(surface);
  const std::string before = save(mesh, "before.vtp");
  meniscus_surface* in_place = surface.release();
  const testing::Balls others = testing::collinear(3, 2.5);
  const meniscus_atoms atoms = atoms_of(others);
  ASSERT_EQ(meniscus_recompute(made.get(), &atoms, &in_place), MENISCUS_OK);
  surface.reset(in_place);
  EXPECT_EQ(save(mesh, "anew.vtp"), before);
  EXPECT_NE(save(mesh_of(surface), "other.vtp"), before);
  surface.reset();
  EXPECT_EQ(save(mesh, "gone.vtp"), before);
}

TEST(CApi, WhatCannotBeSavedIsSaid) {
  const Computer made = computer();
  const SurfaceOf surface = computed(made.get(), testing::collinear(3, 1.5));
  meniscus_mesh* handle = nullptr;
  ASSERT_EQ(meniscus_surface_mesh(surface.get(), nullptr, &handle), MENISCUS_OK);
  const Mesh mesh(handle);
  const TemporaryFolder folder;
  const std::string path = folder.path() / "mesh.ply";
  meniscus_mesh_file defaults{};
  EXPECT_EQ(meniscus_default_mesh_file(&defaults), MENISCUS_USAGE);
  defaults.size = sizeof defaults;
  ASSERT_EQ(meniscus_default_mesh_file(&defaults), MENISCUS_OK);
  EXPECT_EQ(defaults.scale, 1.0);
  EXPECT_STREQ(defaults.attributes, "usual");
  EXPECT_EQ(meniscus_mesh_save(nullptr, path.c_str(), nullptr), MENISCUS_USAGE);
  EXPECT_EQ(meniscus_mesh_save(mesh.get(), nullptr, nullptr), MENISCUS_USAGE);
  EXPECT_EQ(meniscus_mesh_save(mesh.get(), "", nullptr), MENISCUS_USAGE);
  const auto said = [&](meniscus_status status, const char* sentence, const auto& change) {
    meniscus_mesh_file file = defaults;
    change(file);
    EXPECT_EQ(meniscus_mesh_save(mesh.get(), path.c_str(), &file), status) << sentence;
    EXPECT_NE(std::strstr(meniscus_last_error(), sentence), nullptr) << meniscus_last_error();
    EXPECT_TRUE(folder.entries().empty());
  };
  said(MENISCUS_USAGE, "size", [](meniscus_mesh_file& file) { file.size = 0; });
  said(MENISCUS_USAGE, "format is 'step'", [](meniscus_mesh_file& file) { file.format = "step"; });
  said(MENISCUS_USAGE, "not an attribute", [](meniscus_mesh_file& file) { file.attributes = "mass"; });
  said(MENISCUS_USAGE, "bare atoms", [](meniscus_mesh_file& file) { file.attributes = "all,charge"; });
  said(MENISCUS_INPUT, "scale is -1", [](meniscus_mesh_file& file) { file.scale = -1.0; });
  said(MENISCUS_INPUT, "scale is nan", [](meniscus_mesh_file& file) { file.scale = std::nan(""); });
  said(MENISCUS_INPUT, "color is 1.5", [](meniscus_mesh_file& file) { file.color[1] = 1.5f; });
  const std::vector<float> colors{0, 0, 0, 0, 0, -2, 0, 0, 0};
  said(MENISCUS_INPUT, "channel 2 of the colour of atom 1 is -2",
       [&](meniscus_mesh_file& file) { file.atom_colors = colors.data(); });
  EXPECT_EQ(meniscus_mesh_save(mesh.get(), path.c_str(), &defaults), MENISCUS_OK) << meniscus_last_error();
  EXPECT_EQ(meniscus_mesh_save(mesh.get(), path.c_str(), &defaults), MENISCUS_OUTPUT);
  defaults.replace = 1;
  EXPECT_EQ(meniscus_mesh_save(mesh.get(), path.c_str(), &defaults), MENISCUS_OK) << meniscus_last_error();
}

}  // namespace meniscus
