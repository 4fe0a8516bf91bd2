// SPDX-License-Identifier: BSD-3-Clause
// Files of meshes before and after they are written: colours, normals, numbers, points inside.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <map>
#include <numbers>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/mesh/even_mesh.h"
#include "core/mesh/mesh_colors.h"
#include "core/mesh/tessellate.h"
#include "core/queries/distance.h"
#include "core/queries/surface_parts.h"
#include "core/structure/structure.h"
#include "core/surface/compute_surface.h"
#include "exporters/mesh_files/mesh_formats.h"
#include "tests/support/molecules.h"
#include "tests/support/run_program.h"

namespace meniscus::testing {
namespace {

SurfaceObject object_of(const Surface& surface, const Coloring& coloring) {
  SurfaceObject object;
  object.name = "surface";
  object.surface = surface;
  object.coloring = coloring;
  for (std::uint32_t a = 0; a < surface.atoms.size(); ++a) object.atom.push_back(a);
  return object;
}

std::vector<Atom> atoms_of(const Surface& surface) {
  std::vector<Atom> atoms(surface.atoms.size());
  for (std::size_t a = 0; a < atoms.size(); ++a) {
    atoms[a].position = surface.atoms[a].center;
    atoms[a].radius = surface.atoms[a].radius;
    atoms[a].name = "CA";
    atoms[a].residue_name = "ALA";
  }
  return atoms;
}

MeshFile file_of(const Surface& surface, const Coloring& coloring, double tolerance,
                 const std::vector<std::string>& numbers) {
  const std::vector<Atom> atoms = atoms_of(surface);
  MeshFileMaker maker({{tolerance, {}, 0.0, false}, numbers, 1.0, atoms, {}, true}, "a test");
  maker.add(object_of(surface, coloring));
  return maker.take();
}

Coloring gray(const Surface& surface) {
  Coloring coloring;
  coloring.atom.assign(surface.atoms.size(), glm::vec3(0.5f));
  return coloring;
}

/// Normal and colour of a vertex in a binary PLY file.
struct PlyVertex {
  glm::vec3 normal;
  std::array<std::uint8_t, 3> color;
};

std::vector<PlyVertex> ply_vertices(const Surface& surface, const TriangleMesh& mesh, const Coloring& coloring) {
  const test::TemporaryFolder folder;
  const std::string path = (folder.path() / "a.ply").string();
  const MeshFile made = file_of(surface, coloring, mesh.tolerance, {"ses_kind", "ses_component"});
  write_mesh_file(*mesh_format("ply"), path, Existing::refuse, made);
  const std::string file = test::read_bytes(path);
  constexpr std::string_view kEnd = "end_header\n";
  constexpr std::size_t kRow = 6 * sizeof(float) + 3 + 2 * sizeof(float);
  const char* row = file.data() + file.find(kEnd) + kEnd.size();
  EXPECT_EQ(made.objects.front().positions.size(), mesh.positions.size());
  std::vector<PlyVertex> vertices(made.objects.front().positions.size());
  for (PlyVertex& vertex : vertices) {
    std::memcpy(&vertex.normal, row + 3 * sizeof(float), sizeof vertex.normal);
    std::memcpy(vertex.color.data(), row + 6 * sizeof(float), 3);
    row += kRow;
  }
  return vertices;
}

TEST(MeshFiles, PlyNormalsAtCuspsAreTheMeanOfThoseAround) {
  const Balls balls = two_atoms(5.3, 1.7, 1.2);
  const Surface surface = compute_surface_cpu(balls, kWater);
  const TriangleMesh mesh = tessellate(surface, {0.02, true});
  std::map<std::uint32_t, glm::dvec3> sum;
  for (std::size_t n = 0; n < mesh.sharp_corners.size(); ++n) {
    const std::uint32_t corner = mesh.sharp_corners[n];
    sum[mesh.triangles[corner / 3][corner % 3]] += mesh.sharp_corner_normals[n];
  }
  ASSERT_FALSE(sum.empty());
  Coloring gray_atoms;
  gray_atoms.atom.assign(balls.size(), glm::vec3(0.5f));
  const std::vector<PlyVertex> vertices = ply_vertices(surface, mesh, gray_atoms);
  std::size_t bent = 0;  // sharp vertices, whose normals do not cancel out
  for (const auto& [vertex, normals] : sum) {
    if (glm::length(normals) < 1e-6) continue;
    EXPECT_LT(glm::distance(glm::dvec3(vertices[vertex].normal), glm::normalize(normals)), 1e-6) << vertex;
    ++bent;
  }
  EXPECT_GT(bent, 0u);
}

TEST(MeshFiles, PlyColorsAreRoundedToTheNearestByte) {
  const Balls balls{{{0, 0, 0}, 1.5}};
  const Surface surface = compute_surface_cpu(balls, kWater);
  const TriangleMesh mesh = tessellate(surface, {0.2, true});
  Coloring coloring;
  coloring.atom = {glm::vec3(0.5f, 0.999f, 0.2f)};  // as bytes 127.5, 254.7, 51
  for (const PlyVertex& vertex : ply_vertices(surface, mesh, coloring))
    ASSERT_EQ(vertex.color, (std::array<std::uint8_t, 3>{128, 255, 51}));
}

TEST(MeshFiles, PlyColorsAreThoseOfTheAtomBelow) {
  const Balls balls{{{0, 0, 0}, 1.5}, {{20, 0, 0}, 1.5}, {{0, 20, 0}, 1.5}};
  const Surface surface = compute_surface_cpu(balls, kWater);
  const TriangleMesh mesh = tessellate(surface, {0.2, true});
  Coloring coloring;
  coloring.atom = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const std::vector<PlyVertex> vertices = ply_vertices(surface, mesh, coloring);
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    const std::size_t atom = mesh.positions[v].x > 10 ? 1 : mesh.positions[v].y > 10 ? 2 : 0;
    std::array<std::uint8_t, 3> expected{};
    expected[atom] = 255;
    ASSERT_EQ(vertices[v].color, expected) << v;
  }
}

const std::vector<float>& numbers(const FileObject& object, const std::string& name) {
  for (const VertexNumbers& column : object.numbers)
    if (column.name == name) return column.values;
  throw Error("no column " + name);
}

// Gauss and Bonnet: without cusps the Gaussian curvature of a closed surface adds up to 2 pi times its Euler
// characteristic. Two atoms bridged by a saddle, a ring with a hole through it.
TEST(Curvature, AddsUpToTheEulerCharacteristic) {
  for (const Balls& balls : {two_atoms(3.0), ring(10, 2.5), tetrahedron(3.0), ring(3, 2.8)}) {
    const Surface surface = compute_surface_cpu(balls, kWater);
    ASSERT_EQ(surface.counts().spindle, 0u);
    const TriangleMesh mesh = tessellate(surface, {0.0005, false});
    double sum = 0.0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const auto& [a, b, c] = mesh.triangles[t];
      const glm::dvec3 &x = mesh.positions[a], &y = mesh.positions[b], &z = mesh.positions[c];
      sum += 0.5 * glm::length(glm::cross(y - x, z - x)) * curvature(surface, mesh.face[t], (x + y + z) / 3.0).gaussian;
    }
    EXPECT_NEAR(sum, 2.0 * std::numbers::pi * surface.components[0].euler, 0.02) << balls.size();
  }
}

TEST(Curvature, OfASphereAFixedProbeAndATorus) {
  const Surface ball = compute_surface_cpu(Balls{{{0, 0, 0}, 2.0}}, kWater);
  EXPECT_DOUBLE_EQ(curvature(ball, 0, {2, 0, 0}).mean, 0.5);
  EXPECT_DOUBLE_EQ(curvature(ball, 0, {2, 0, 0}).gaussian, 0.25);
  const Surface three = compute_surface_cpu(ring(3, 3.0), kWater);
  for (std::uint32_t f = 0; f < three.faces.size(); ++f) {
    if (three.faces[f].kind != PatchKind::concave) continue;
    EXPECT_DOUBLE_EQ(curvature(three, f, {0, 0, 1}).mean, -1.0 / kWater);
    EXPECT_DOUBLE_EQ(curvature(three, f, {0, 0, 1}).gaussian, 1.0 / (kWater * kWater));
  }
  // Halfway between two atoms the tube faces the axis at the distance R - p.
  const Surface two = compute_surface_cpu(two_atoms(3.0), kWater);
  const double waist = two.toroidal[0].radius - kWater;
  for (std::uint32_t f = 0; f < two.faces.size(); ++f) {
    if (two.faces[f].kind != PatchKind::toroidal) continue;
    const Curvature at = curvature(two, f, two.toroidal[0].center + waist * two.toroidal[0].start);
    EXPECT_NEAR(at.mean, 0.5 * (1.0 / waist - 1.0 / kWater), 1e-12);
    EXPECT_NEAR(at.gaussian, -1.0 / (waist * kWater), 1e-12);
  }
}

// Averages of a constant are the constant for any triangles.
TEST(Curvature, SmoothedOnASphereIsThatOfTheSphere) {
  const Surface ball = compute_surface_cpu(Balls{{{0, 0, 0}, 3.0}}, kWater);
  for (const Curvature& at : smoothed_curvatures(tessellate(ball, {0.005, true}))) {
    EXPECT_NEAR(at.mean, 1.0 / 3.0, 0.01);
    EXPECT_NEAR(at.gaussian, 1.0 / 9.0, 0.01);
  }
}

// A row of atoms is a rod with waists: averaged over some of them, its mean curvature is about that of a cylinder and
// its Gaussian curvature about 0.
TEST(Curvature, SmoothedLooksPastTheAtoms) {
  const Surface rod = compute_surface_cpu(collinear(16, 1.5), kWater);
  const TriangleMesh mesh = tessellate(rod, {0.02, true});
  const std::vector<Curvature> smoothed = smoothed_curvatures(mesh);
  std::size_t looked = 0;
  double middle = 0.0;
  for (const glm::dvec3& x : mesh.positions) middle += x.x / static_cast<double>(mesh.positions.size());
  for (std::size_t v = 0; v < smoothed.size(); ++v) {
    if (std::abs(mesh.positions[v].x - middle) > 5.0) continue;
    EXPECT_NEAR(smoothed[v].gaussian, 0.0, 0.06);
    EXPECT_NEAR(smoothed[v].mean, 0.5 / 1.6, 0.06);
    ++looked;
  }
  EXPECT_GT(looked, 100u);
}

TEST(MeshFiles, AreasOfAtomsAndPatchesStandAtTheirVertices) {
  const Surface surface = compute_surface_cpu(ring(3, 2.8), kWater);
  const FileObject object = file_of(surface, gray(surface), 0.01, {"atom_area", "patch_area"}).objects.front();
  for (const float area : numbers(object, "atom_area")) EXPECT_NEAR(area, surface.area / 3.0, 1e-3);
  for (const float area : numbers(object, "patch_area"))
    EXPECT_TRUE(std::any_of(surface.faces.begin(), surface.faces.end(), [&](const Face& f) {
      return std::abs(f.area - area) < 1e-4;
    })) << area;
}

TEST(MeshFiles, TheSkyIsSeenFromOutsideAndNotFromCavities) {
  const Surface surface = compute_surface_cpu(c60(1.45, 1.0), 0.8);
  const FileObject object =
      file_of(surface, gray(surface), 0.1, {"ses_component", "open_sky", "atom_open_sky"}).objects.front();
  const std::vector<float>& part = numbers(object, "ses_component");
  double outside = 0.0, inside = 0.0;
  for (std::size_t v = 0; v < part.size(); ++v) {
    const auto component = static_cast<std::size_t>(part[v]);
    const bool is_cavity = surface.components[component].kind == ComponentKind::cavity;
    const float seen = numbers(object, "open_sky")[v];
    (is_cavity ? inside : outside) = std::max<double>(is_cavity ? inside : outside, seen);
    EXPECT_GT(numbers(object, "atom_open_sky")[v], 0.1f);  // An atom's value covers its outer part and its inner one.
    EXPECT_LT(numbers(object, "atom_open_sky")[v], 0.95f);
  }
  EXPECT_EQ(inside, 0.0);
  EXPECT_GT(outside, 0.9);
}

// A fullerene's cage has one point in its hollow and one in its wall.
TEST(MeshFiles, InnerPointsLieInCavitiesAndSolids) {
  for (const double radius : {1.0, 1.7}) {
    const Surface surface = compute_surface_cpu(c60(1.45, radius), radius == 1.0 ? 0.8 : kWater);
    const MeshFile file = file_of(surface, gray(surface), 0.05, {});
    ASSERT_EQ(file.cavities.size() + file.solids.size(), surface.components.size());
    EXPECT_GE(file.cavities.size(), 1u);
    const SurfaceDistance distance(surface);
    for (const auto& [x, component] : file.cavities) {
      EXPECT_EQ(surface.components[component].kind, ComponentKind::cavity);
      EXPECT_GT(distance(x).distance, 0.05);
    }
    for (const auto& [x, component] : file.solids) {
      EXPECT_EQ(surface.components[component].kind, ComponentKind::outer);
      EXPECT_LT(distance(x).distance, -0.05);
    }
  }
}

/// Returns whether a ray from the point leaves the component: it meets the triangles an odd number of times.
bool is_inside(const TriangleMesh& mesh, std::uint32_t component, const glm::dvec3& point) {
  const glm::dvec3 ray = glm::normalize(glm::dvec3(0.6123, 0.3517, 0.7081));
  bool inside = false;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (mesh.component[t] != component) continue;
    const auto& [i, j, k] = mesh.triangles[t];
    const glm::dvec3 a = mesh.positions[i] - point, b = mesh.positions[j] - point, c = mesh.positions[k] - point;
    const double x = glm::dot(ray, glm::cross(b, c)), y = glm::dot(ray, glm::cross(c, a)),
                 z = glm::dot(ray, glm::cross(a, b));
    const bool passes = (x > 0.0 && y > 0.0 && z > 0.0) || (x < 0.0 && y < 0.0 && z < 0.0);
    if (passes && glm::dot(a, glm::cross(b, c)) / (x + y + z) > 0.0) inside = !inside;
  }
  return inside;
}

// Triangles of a proxy leave out places inside the surface, and nearly all of a small cavity.
TEST(MeshFiles, InnerPointsLieInsideCoarseTriangles) {
  const Surface surface = compute_surface_cpu(enterotoxin(), kWater);
  for (const double density : {0.03, 0.1, 0.3}) {
    const TriangleMesh mesh = even_mesh(surface, {density, 0.0, {}}).mesh;
    const std::vector<glm::dvec3> points = inner_points(surface, mesh);
    ASSERT_EQ(points.size(), surface.components.size());
    for (std::uint32_t c = 0; c < points.size(); ++c) EXPECT_TRUE(is_inside(mesh, c, points[c])) << density << ' ' << c;
  }
}

void expect_good_estimate(const Surface& surface, const MeshFineness& fineness) {
  const double made = static_cast<double>(fine_mesh(surface, fineness).mesh.triangles.size());
  const double ratio = estimated_triangles(surface, fineness) / made;
  EXPECT_GT(ratio, 0.5) << surface.atoms.size() << ' ' << fineness.tolerance;
  EXPECT_LT(ratio, 2.0) << surface.atoms.size() << ' ' << fineness.tolerance;
}

// A warning before tens of millions of triangles has to come before they are made.
TEST(MeshFiles, TrianglesAreEstimatedToAFactorOfTwo) {
  for (const Balls& balls : {c60(), ring(10, 2.5), lattice(3, 3, 3, 3.0), gas(5, 150, 22.0, 1.2, 1.9)})
    for (const double tolerance : {0.2, 0.03, 0.005})
      expect_good_estimate(compute_surface_cpu(balls, kWater), {tolerance, {}, 0.0, false});
  for (const Balls& balls : {c60(), ring(10, 2.5), lattice(3, 3, 3, 3.0)}) {
    expect_good_estimate(compute_surface_cpu(balls, kWater), {0.05, {}, 0.0, true});
    expect_good_estimate(compute_surface_cpu(balls, kWater), {0.05, {}, 3.0, false});
  }
}

TEST(MeshFiles, FormatsAreKnownByTheirEndings) {
  EXPECT_EQ(mesh_format_of_path("a/b.c.STL"), mesh_format("stl"));
  EXPECT_EQ(mesh_format_of_path("a.3mf"), mesh_format("3mf"));
  EXPECT_EQ(mesh_format_of_path("a.xyz"), nullptr);
  EXPECT_EQ(mesh_format_of_path("stl"), nullptr);
}

TEST(MeshFiles, NamesOfNumbersAreReadOnceAndInOrder) {
  EXPECT_EQ(parse_vertex_numbers("charge,b_factor,charge"), (std::vector<std::string>{"b_factor", "charge"}));
  EXPECT_TRUE(parse_vertex_numbers("none").empty());
  const auto slow = std::ranges::count(vertex_number_kinds(), true, &VertexNumberKind::slow);
  EXPECT_EQ(slow, 2);
  EXPECT_EQ(parse_vertex_numbers("all").size() + slow, vertex_number_kinds().size());
  EXPECT_EQ(parse_vertex_numbers("all,open_sky").size() + 1, vertex_number_kinds().size());
  EXPECT_THROW(parse_vertex_numbers("charges"), RequestError);
  EXPECT_THROW(parse_vertex_numbers(""), RequestError);
  for (const std::string& name : parse_vertex_numbers("all", AtomSource::bare))
    EXPECT_THROW(parse_vertex_numbers(name + ",charge", AtomSource::bare), RequestError);
  EXPECT_EQ(parse_vertex_numbers("usual", AtomSource::bare),
            (std::vector<std::string>{"vdw_radii", "atom_index", "ses_kind", "ses_component"}));
}

}  // namespace
}  // namespace meniscus::testing
