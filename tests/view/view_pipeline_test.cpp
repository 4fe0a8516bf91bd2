// SPDX-License-Identifier: BSD-3-Clause
// The picture of what a view needs against the picture of the complete surface, bit for bit, from any camera.
#include "core/visible_surface/view_pipeline.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "core/color/coloring.h"
#include "core/gpu/egl_context.h"
#include "core/reduced_surface/reduced_surface.h"
#include "core/render/gl_renderer.h"
#include "core/surface/compute_surface.h"
#include "tests/support/molecules.h"
#include "tests/view/view_cameras.h"

namespace meniscus {
namespace {

using testing::Balls;

constexpr glm::ivec2 kSize{160, 120};

class Views : public ::testing::Test {
 protected:
  void load(const Balls& atoms) {
    view_.set_atoms(atoms);
    view_.set_coloring(coloring_of(atoms.size()));
  }

  static Coloring coloring_of(std::size_t atom_count) {
    Coloring coloring;
    for (std::size_t a = 0; a < atom_count; ++a)
      coloring.atom.emplace_back(0.1f * static_cast<float>(a % 10), 0.2f * static_cast<float>(a % 5), 0.5f);
    return coloring;
  }

  std::vector<glm::vec4> draw(const Camera& camera, double probe_radius, Extent extent) {
    view_.set_surface(probe_radius, extent);
    RenderSettings settings;
    settings.size = kSize;
    renderer_.draw(view_, camera, settings);
    return renderer_.samples().download<glm::vec4>(static_cast<std::size_t>(kSize.x) * kSize.y);
  }

  int differing_pixels(const Camera& camera, double probe_radius) {
    const auto complete = draw(camera, probe_radius, Extent::complete);
    const auto visible = draw(camera, probe_radius, Extent::visible);
    int count = 0;
    for (std::size_t at = 0; at < complete.size(); ++at) count += complete[at] != visible[at];
    return count;
  }

  /// Counts pixels in which the complete view differs from the host's surface; n-fold probes are split in a view. With
  /// every third atom hidden, rays inside the solid see its clips of convex and toroidal patches.
  int differing_from_host(const Surface& surface, bool some_hidden) {
    Coloring coloring = coloring_of(surface.atoms.size());
    for (std::size_t a = 0; some_hidden && a < surface.atoms.size(); ++a) coloring.hidden.push_back(a % 3 == 0);
    view_.set_coloring(coloring);
    const Camera camera = frame_camera(surface.atoms, 4.0 / 3.0);
    RenderSettings settings;
    settings.size = kSize;
    const Framebuffer expected = GlRenderer().render(surface, coloring, camera, settings);
    const auto found = draw(camera, surface.probe_radius, Extent::complete);
    int count = 0;
    for (std::size_t at = 0; at < found.size(); ++at) {
      const glm::vec4 d = glm::abs(found[at] - expected.color[at]);
      count += std::max({d.x, d.y, d.z, d.w}) > 1e-4f;
    }
    return count;
  }

  const EglContext context_;
  ViewPipeline view_;
  GlRenderer renderer_;
};

TEST_F(Views, CompleteEqualsTheSurfaceOfTheHost) {
  const Balls atoms = testing::ubiquitin();
  load(atoms);
  const Surface surface = assemble_surface(atoms, 1.4, enumerate_reduced_surface(atoms, 1.4));
  EXPECT_EQ(differing_from_host(surface, true), 0);
  EXPECT_EQ(differing_from_host(surface, false), 0);
  EXPECT_EQ(view_.stats().primitives, surface.convex.size() + surface.toroidal.size() + surface.concave.size());
  EXPECT_EQ(view_.stats().probes, surface.counts().fixed_probes);
}

TEST_F(Views, DegenerateMoleculesLookAsOnTheHost) {
  for (const auto& [name, atoms, probe_radius] : testing::degenerate_molecules()) {
    load(atoms);
    const Surface surface = assemble_surface(atoms, probe_radius, enumerate_reduced_surface(atoms, probe_radius));
    for (const bool some_hidden : {false, true}) EXPECT_EQ(differing_from_host(surface, some_hidden), 0) << name;
  }
}

TEST_F(Views, GasesLookAsOnTheHost) {
  for (std::uint32_t n = 0; n < 40; ++n) {
    const auto [atoms, probe_radius, on_grid] = testing::gas_case(n);
    const Surface surface = assemble_surface(atoms, probe_radius, enumerate_reduced_surface(atoms, probe_radius));
    if (!surface.certificate.closed) continue;
    load(atoms);
    for (const bool some_hidden : {false, true}) EXPECT_LE(differing_from_host(surface, some_hidden), 0) << n;
  }
}

/// Returns a large atom between `count` others, each over a small one that meets the large one, but only inside the
/// solid.
Balls crowded_atom(int count) {
  constexpr double kRadius = 20.0;
  Balls atoms{{{0.0, 0.0, 0.0}, kRadius}};
  for (int n = 0; n < count; ++n) {
    const double z = 1.0 - (2.0 * n + 1.0) / count, longitude = 2.399963229728653 * n;  // a spiral of golden angles
    const glm::dvec3 up(std::sqrt(1.0 - z * z) * glm::dvec3(std::cos(longitude), std::sin(longitude), 0.0) +
                        glm::dvec3(0.0, 0.0, z));
    const glm::dvec3 across = glm::normalize(glm::cross(up, glm::dvec3(0.3, 0.5, 0.8)));
    atoms.push_back({(kRadius + 0.5) * up, 1.0});
    atoms.push_back({kRadius * up + 0.6 * across, 0.3});
  }
  return atoms;
}

// On llvmpipe all loops of an invocation together end after 65,535 steps: with each partner against each, the kernels
// would have to take all neighbours, which ask more of every ray.
TEST_F(Views, ManyPartnersAreNoMoreThanOneInvocationCanGoThrough) {
  const Balls atoms = crowded_atom(380);
  const ReducedSurface reduced = enumerate_reduced_surface(atoms, 1.4);
  std::set<std::uint32_t> partners;
  for (const RsArc& arc : reduced.arcs)
    if (arc.i == 0) partners.insert(arc.j);
  ASSERT_GT(partners.size() * partners.size(), 2u * 65'535u);
  ASSERT_LT(partners.size(), 400u) << "no small atom is a partner";
  const Surface surface = assemble_surface(atoms, 1.4, reduced);
  view_.set_counting(Counting::now);  // Primitives are counted when prepare() ends.
  load(atoms);
  EXPECT_EQ(differing_from_host(surface, false), 0);
  StageClock clock;
  const GpuPack& scene = view_.prepare(make_picture_frame(atoms, frame_camera(atoms, 4.0 / 3.0), kSize), clock);
  std::size_t of_the_large_one = 0;
  for (const ray_cast::Primitive& primitive :
       scene.primitives.buffer.download<ray_cast::Primitive>(scene.primitives.count()))
    if (primitive.kind == ray_cast::kConvex && primitive.atom == 0) {
      ++of_the_large_one;
      EXPECT_EQ(primitive.plane_count, partners.size());
    }
  EXPECT_EQ(of_the_large_one, 1u);
}

TEST_F(Views, VisibleEqualsCompleteFromOutside) {
  const Balls atoms = testing::ubiquitin();
  load(atoms);
  std::mt19937 random(4);
  for (const double probe_radius : {0.7, 1.4, 3.0, 10.0})
    for (int n = 0; n < 8; ++n)
      EXPECT_EQ(differing_pixels(testing::camera_outside(atoms, 4.0 / 3.0, random), probe_radius), 0);
}

TEST_F(Views, WhatStandsBesideTheEyeHidesNothingAcross) {
  load({{{-1.75, 0.0, -0.1}, 1.7}, {{5.0, 0.0, -6.0}, 1.7}, {{6.0, 1.0, -5.0}, 1.5}});
  Camera camera;
  camera.position = {0.0, 0.0, 0.0};
  camera.target = {0.0, 0.0, -1.0};
  camera.vertical_fov = 120.0;
  EXPECT_EQ(differing_pixels(camera, 0.3), 0);
  EXPECT_GT(view_.stats().arcs, 0u);
}

/// A probe under a roof, which rests on two atoms of the floor and on one far back: what it touches there lies, with
/// all places of the probe's centre around it, behind the roof, but the probe reaches out past the roof's edge.
Balls probe_under_a_roof() {
  Balls atoms{{{3.1, 0.0, 0.0}, 1.7}, {{-2.0, 1.2, -2.042}, 1.7}, {{-2.0, -1.2, -2.042}, 1.7}, {{0.5, 0.0, -3.7}, 1.7}};
  for (int x = 0; x < 3; ++x)
    for (int y = -4; y <= 4; ++y) atoms.push_back({{1.2 + x, 0.8 * y, 4.5}, 1.7});
  return atoms;
}

// The theorem needs a ball of radius r + 2p: with r + p the atom far back would be left out, and the probe with it.
TEST_F(Views, AnAtomMattersThroughAProbeThatReachesOutOfACleft) {
  const Balls atoms = probe_under_a_roof();
  Camera camera;
  camera.position = {-0.6, 0.0, 30.0};
  camera.target = {-0.6, 0.0, 0.0};
  camera.up = {0.0, 1.0, 0.0};
  camera.projection = Projection::orthographic;
  camera.height = 1.6;
  load(atoms);
  EXPECT_EQ(differing_pixels(camera, 1.4), 0);
  const auto with = draw(camera, 1.4, Extent::visible);
  load(Balls(atoms.begin() + 1, atoms.end()));
  const auto without = draw(camera, 1.4, Extent::visible);
  int different = 0;
  for (std::size_t at = 0; at < with.size(); ++at) different += with[at] != without[at];
  EXPECT_GT(different, 1000) << "the atom far back shapes what is seen";
}

TEST_F(Views, ThePaperDrawsLessAndMissesSome) {
  const Balls atoms = testing::enterotoxin();
  load(atoms);
  const Camera camera = frame_camera(atoms, 4.0 / 3.0);
  const auto complete = draw(camera, 1.4, Extent::complete);
  const ViewStats all = view_.stats();
  const auto paper = draw(camera, 1.4, Extent::paper);
  EXPECT_LT(view_.stats().probes, all.probes / 2);
  int missed = 0, shown = 0;
  for (std::size_t at = 0; at < complete.size(); ++at) {
    missed += paper[at] != complete[at];
    shown += complete[at].w > 0.0f;
  }
  EXPECT_GT(missed, 0);
  EXPECT_LT(missed, shown / 50);
  EXPECT_EQ(draw(camera, 1.4, Extent::complete), complete);  // Nothing of the selection stays.
}

TEST_F(Views, NewAtomsAndProbesLeaveNothingBehind) {
  const Balls atoms = testing::ubiquitin();
  const Camera camera = frame_camera(atoms, 4.0 / 3.0);
  load(atoms);
  const auto first = draw(camera, 1.4, Extent::visible);
  EXPECT_NE(draw(camera, 2.0, Extent::complete), first);
  load(testing::rotated(atoms, glm::dmat3(0, 1, 0, -1, 0, 0, 0, 0, 1)));
  EXPECT_NE(draw(camera, 1.4, Extent::complete), first);
  load(atoms);
  EXPECT_EQ(draw(camera, 1.4, Extent::visible), first);
}

TEST_F(Views, VisibleEqualsCompleteFromInside) {
  const Balls atoms = testing::enterotoxin();
  load(atoms);
  std::mt19937 random(5);
  for (const double probe_radius : {0.7, 1.4, 3.0})
    for (int n = 0; n < 4; ++n)
      EXPECT_EQ(differing_pixels(testing::camera_inside(atoms, probe_radius, random), probe_radius), 0);
}

}  // namespace
}  // namespace meniscus
