// SPDX-License-Identifier: BSD-3-Clause
// Pictures of copies that are never in memory all at once are those of the merged surface, bit for bit.
#include <algorithm>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/queries/copies.h"
#include "core/queries/surface_parts.h"
#include "core/render/cpu/cpu_renderer.h"
#include "core/render/cpu/interruption.h"
#include "core/render/cpu/visible_copies.h"
#include "core/surface/compute_surface.h"
#include "tests/support/molecules.h"

namespace meniscus {
namespace {

using testing::Balls;
using testing::kWater;

SurfaceObject object_of(const Balls& balls) {
  SurfaceObject object;
  object.surface = compute_surface_cpu(balls, kWater);
  for (std::size_t n = 0; n < balls.size(); ++n)
    object.coloring.atom.push_back(n % 2 ? glm::vec3(0.8f, 0.25f, 0.2f) : glm::vec3(0.3f, 0.5f, 0.9f));
  return object;
}

/// Returns turned copies at the places of a lattice of so many columns, rows and layers.
std::vector<RigidMotion> lattice(glm::ivec3 counts, double step) {
  std::mt19937 random(3);
  std::vector<RigidMotion> motions;
  for (int x = 0; x < counts.x; ++x)
    for (int y = 0; y < counts.y; ++y)
      for (int z = 0; z < counts.z; ++z)
        motions.push_back({testing::random_rotation(random), step * glm::dvec3(x, y, z)});
  return motions;
}

/// Returns two molecules, whose copies lie among each other and into each other.
std::vector<SurfaceObject> crowd() {
  std::vector<SurfaceObject> objects{object_of(testing::ubiquitin()), object_of(testing::c60())};
  objects[0].copies = lattice({4, 3, 3}, 34.0);
  objects[1].copies = lattice({5, 4, 3}, 29.0);
  return objects;
}

void expect_same_bits(const std::vector<SurfaceObject>& objects, const Camera& camera, RenderSettings settings,
                      const std::string& name) {
  settings.size = {230, 170};  // The sides are no whole numbers of tiles.
  CpuRenderer whole, together, one_by_one(16, 1);
  const SurfaceObject all = merged(objects);
  const Framebuffer expected = whole.render(whole_surface(all.surface, all.coloring), camera, settings);
  EXPECT_EQ(together.render_copies(objects, camera, settings).color, expected.color) << name;
  EXPECT_EQ(one_by_one.render_copies(objects, camera, settings).color, expected.color) << name;
}

Camera framed(const std::vector<SurfaceObject>& objects, Projection projection) {
  return frame_camera(placed_balls(objects), 230.0 / 170.0, projection);
}

TEST(Copies, LookLikeTheMergedSurface) {
  const std::vector<SurfaceObject> objects = crowd();
  RenderSettings settings;
  settings.samples = 5;
  for (const Projection projection : {Projection::perspective, Projection::orthographic})
    expect_same_bits(objects, framed(objects, projection), settings, "from outside");
  settings.block_edge = 64;
  expect_same_bits(objects, framed(objects, Projection::perspective), settings, "in blocks");
  const glm::dvec3 inside(51.0, 36.0, 34.0);
  expect_same_bits(objects, {inside, inside + glm::dvec3(1.0, 0.3, 0.2), {0, 1, 0}, Projection::perspective, 80.0, 1.0},
                   settings, "from inside");
  expect_same_bits(objects,
                   {inside, inside + glm::dvec3(1.0, 0.3, 0.2), {0, 1, 0}, Projection::orthographic, 0.0, 60.0},
                   settings, "on a plane among them");
  const glm::dvec3 atom = objects[0].copies[7](objects[0].surface.atoms[100].center);
  expect_same_bits(objects, {atom, atom + glm::dvec3(-0.2, 1.0, 0.4), {0, 0, 1}, Projection::perspective, 70.0, 1.0},
                   settings, "from within an atom");
}

// An atom at a cavity has no surface around it when the cavity is all that is drawn.
TEST(Copies, AtomsOfPartsHideNothing) {
  std::vector<SurfaceObject> objects{object_of(testing::c60())};
  const SurfaceObject whole = objects[0];
  std::vector<bool> cavities;
  for (const Component& component : whole.surface.components)
    cavities.push_back(component.kind == ComponentKind::cavity);
  ASSERT_EQ(std::ranges::count(cavities, true), 1);
  SurfacePart part = part_of(whole.surface, cavities);
  objects[0].surface = std::move(part.surface);
  objects[0].coloring.atom.resize(part.atom.size());
  objects[0].whole = false;
  objects[0].copies = lattice({4, 3, 3}, 16.0);
  RenderSettings settings;
  settings.samples = 3;
  expect_same_bits(objects, framed(objects, Projection::perspective), settings, "cavities");
}

TEST(Copies, KeepPartsKindsAndHiddenAtomsApart) {
  std::vector<SurfaceObject> objects = crowd();
  RenderSettings settings;
  settings.samples = 2;
  settings.look.ambient_occlusion = 0.9f;
  settings.look.silhouettes = 2.5f;
  settings.look.depth_cue = 0.5f;
  for (SurfaceObject& object : objects)
    for (std::size_t n = 0; n < object.surface.atoms.size(); ++n)
      object.coloring.part.push_back(static_cast<std::uint32_t>(n / 200));
  expect_same_bits(objects, framed(objects, Projection::perspective), settings, "parts");
  for (std::size_t n = 0; n < objects[0].surface.atoms.size(); ++n) objects[0].coloring.hidden.push_back(n % 5 < 2);
  expect_same_bits(objects, framed(objects, Projection::orthographic), settings, "hidden atoms");
  for (SurfaceObject& object : objects)
    object.coloring.kind = {{{0.2f, 0.6f, 0.4f}, {0.4f, 0.6f, 0.9f}, {0.8f, 0.4f, 0.2f}}};
  expect_same_bits(objects, framed(objects, Projection::perspective), settings, "kinds");
}

TEST(Copies, NameTheAtomsAndComponentsOfTheMergedSurface) {
  std::vector<SurfaceObject> objects = crowd();
  for (SurfaceObject& object : objects)
    for (std::uint32_t n = 0; n < object.surface.atoms.size(); ++n) object.atom.push_back(7 * n + 1);
  const SurfaceObject all = merged(objects);
  ASSERT_GT(all.surface.components.size(), 90u) << "cavities of copies are components, too";
  RenderSettings settings;
  settings.size = {230, 170};
  settings.aovs = settings.mattes = true;
  settings.name_seen = [](std::uint32_t, std::uint32_t atom) { return atom; };
  settings.samples = 3;
  for (const int block_edge : {RenderSettings{}.block_edge, 64}) {
    settings.block_edge = block_edge;
    const Camera camera = framed(objects, Projection::perspective);
    const Framebuffer expected = CpuRenderer().render(whole_surface(all.surface, all.coloring), camera, settings);
    const Framebuffer found = CpuRenderer(16, 1).render_copies(objects, camera, settings);
    EXPECT_EQ(found.color, expected.color);
    EXPECT_EQ(found.z, expected.z);
    EXPECT_EQ(found.normal, expected.normal);
    EXPECT_EQ(found.position, expected.position);
    EXPECT_EQ(found.atom, expected.atom);
    EXPECT_EQ(found.kind, expected.kind);
    EXPECT_EQ(found.component, expected.component);
    EXPECT_EQ(found.seen, expected.seen);
    EXPECT_GT(std::ranges::count_if(found.seen, [](std::uint32_t atom) { return atom != kNone; }), 5000);
  }
  for (std::size_t atom = 0; atom < all.atom.size(); ++atom) ASSERT_EQ(merged_atom(objects, atom), all.atom[atom]);
}

TEST(Copies, AreDrawnAndPickedAsTheMergedSurface) {
  const std::vector<SurfaceObject> objects = crowd();
  const SurfaceObject all = merged(objects);
  const Camera camera = framed(objects, Projection::perspective);
  RenderSettings settings;
  settings.size = {230, 170};
  settings.samples = 2;
  settings.look.ambient_occlusion = 0.5f;
  CpuRenderer whole, copies;
  ASSERT_TRUE(whole.draw(whole_surface(all.surface, all.coloring), camera, settings));
  ASSERT_TRUE(copies.draw_copies(objects, camera, settings));
  EXPECT_EQ(copies.rgba(), whole.rgba());
  std::size_t picked = 0;
  for (int y = 0; y < settings.size.y; y += 3) {
    for (int x = 0; x < settings.size.x; x += 3) {
      const std::optional<PickedPoint> expected = whole.pick({x, y}), found = copies.pick({x, y});
      ASSERT_EQ(found.has_value(), expected.has_value());
      if (!found) continue;
      ++picked;
      std::size_t atom = found->atom;
      for (std::size_t n = 0; n < found->object; ++n)
        atom += objects[n].copies.size() * objects[n].surface.atoms.size();
      atom += found->copy * objects[found->object].surface.atoms.size();
      EXPECT_EQ(atom, expected->atom);
      EXPECT_EQ(found->kind, expected->kind);
      EXPECT_EQ(found->position, expected->position);
    }
  }
  EXPECT_GT(picked, 500u);
}

// A stop at any question ends the work, and the earlier picture stays.
TEST(Copies, AreGivenUp) {
  const std::vector<SurfaceObject> objects = crowd();
  const Camera camera = framed(objects, Projection::perspective);
  RenderSettings settings;
  settings.size = {96, 64};
  CpuRenderer renderer(16, 1);
  ASSERT_TRUE(renderer.draw_copies(objects, camera, settings));
  const std::vector<std::uint8_t> before = renderer.rgba();
  ASSERT_FALSE(renderer.draw_copies(objects, framed(objects, Projection::orthographic), settings, [] { return true; }));
  EXPECT_EQ(renderer.rgba(), before);
  EXPECT_FALSE(renderer.pick({48, 32}));
  int questions = 0;
  ASSERT_TRUE(renderer.draw_copies(objects, camera, settings, [&] { return ++questions < 0; }));
  EXPECT_GT(questions, 10);
  const int last = questions / 2;
  questions = 0;
  EXPECT_FALSE(renderer.draw_copies(objects, camera, settings, [&] { return ++questions > last; }));
  EXPECT_LT(questions, last + 50) << "what has begun comes to its end, and no more";
}

// Copies behind everything visible are neither moved nor packed.
TEST(Copies, BehindOthersAreLeftWhereTheyAre) {
  std::vector<SurfaceObject> objects{object_of(testing::ubiquitin())};
  const std::vector<Ball>& atoms = objects[0].surface.atoms;
  const ViewBasis basis = broad_side(atoms);
  Camera camera = frame_camera(atoms, 1.0, Projection::orthographic);
  camera.height = 4.0;  // The picture shows only the middle of the molecule.
  for (int n = 1; n < 50; ++n) objects[0].copies.push_back({glm::dmat3(1.0), 60.0 * n * basis.forward});
  const PictureFrame frame = make_picture_frame(placed_balls(objects), camera, {64, 64});
  const PackPlacement placement = place_atoms(placed_balls(objects), kWater, frame);
  VisibleCopies copies(objects, frame, placement, {}, widest_kernels(16), 1);
  const std::function<bool()> never;
  Interruption interruption(never);
  StageClock clock;
  copies.begin_block({frame, {{0, 0}, frame.size}, 4}, interruption, clock);
  const HostPack& scene = copies.scene();
  EXPECT_EQ(copies.moved(), 1u);
  EXPECT_GT(scene.packed.primitives.size(), 0u);
  EXPECT_LT(scene.packed.primitives.size(), 100u);  // There are about 4,000.
  EXPECT_EQ(scene.colors.size(), atoms.size());
}

}  // namespace
}  // namespace meniscus
