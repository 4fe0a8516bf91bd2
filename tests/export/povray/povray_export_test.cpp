// SPDX-License-Identifier: BSD-3-Clause
// Exported scenes rendered by POV-Ray, pixel by pixel against the sphere-tracing oracle; every picture they offer.
#include <cmath>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "tests/export/povray/exported_scene.h"
#include "tests/support/run_program.h"

namespace meniscus::testing {
namespace {

constexpr double kAspect = 4.0 / 3.0;

void expect_identical(const BufferDifference& d, std::size_t odd_layers = 0) {
  EXPECT_GT(d.surface, d.pixels / 20);
  EXPECT_EQ(d.position, 0u);
  EXPECT_EQ(d.normal, 0u);
  EXPECT_EQ(d.kind, 0u);
  EXPECT_EQ(d.color, 0u);
  EXPECT_LE(d.odd_layers, odd_layers);
  EXPECT_LT(d.largest_position_error, 1e-3);
}

class SmallMolecule : public ::testing::TestWithParam<NamedBalls> {};

TEST_P(SmallMolecule, EveryPixelAgreesInPerspectiveAndOrthographic) {
  const ExportedScene scene(GetParam());
  ASSERT_TRUE(scene.surface().certificate.closed);
  for (const Projection projection : {Projection::perspective, Projection::orthographic})
    expect_identical(scene.difference(oblique_camera(scene.surface(), projection, kAspect), 240, 180));
}

INSTANTIATE_TEST_SUITE_P(PovrayExport, SmallMolecule, ::testing::ValuesIn(patch_molecules()),
                         [](const auto& instance) { return instance.param.name; });

// Sizes coincide, or another probe rolls. All of degenerate_molecules() agree; these few stand for them, since every
// start of POV-Ray takes a second.
TEST(PovrayExport, DegenerateMoleculesAndOtherProbes) {
  const std::set<std::string> chosen{"two, circle radius equal to the probe's",
                                     "two, SAS spheres overlap by 1e-7",
                                     "coincident",
                                     "triangle, probe just fits",
                                     "octahedron, centre just touched",
                                     "lattice 3x3x3 with cavities",
                                     "square, large probe",
                                     "cube, small probe",
                                     "lattice 3x3x3, vdW"};
  std::size_t tried = 0;
  for (const NamedBalls& m : degenerate_molecules()) {
    if (!chosen.contains(m.name)) continue;
    SCOPED_TRACE(m.name);
    ++tried;
    const ExportedScene scene(m);
    // Between vdW spheres a ray may leave one and enter the next within POV-Ray's smallest step (1e-4): the second
    // crossing is lost to it, however exact the text.
    const Camera camera = oblique_camera(scene.surface(), Projection::perspective, kAspect);
    expect_identical(scene.difference(camera, 160, 120), m.probe_radius == 0.0 ? 4 : 0);
  }
  EXPECT_EQ(tried, chosen.size());
}

TEST(PovrayExport, CavityFromInsideAndTallPicture) {
  const ExportedScene scene({"c60", c60()});
  Camera camera;
  camera.position = {0.05, -0.03, 0.02};
  camera.target = {1.0, 0.4, -0.3};
  camera.vertical_fov = 100.0;
  expect_identical(scene.difference(camera, 120, 200));
}

// At most one pixel in ten thousand may differ; a real fault in one kind of patch touches more (povray_fault_test).
void expect_as_good_as_identical(const BufferDifference& d) {
  const std::size_t tolerated = d.pixels / 10000;
  EXPECT_GT(d.surface, d.pixels / 20);
  EXPECT_LE(d.position, tolerated);
  EXPECT_LE(d.normal, tolerated);
  EXPECT_LE(d.kind, tolerated);
  EXPECT_LE(d.color, tolerated);
  EXPECT_LE(d.odd_layers, tolerated);
}

class Protein : public ::testing::TestWithParam<NamedBalls> {};

TEST_P(Protein, PixelsAgreeFromThreeSides) {
  const ExportedScene scene(GetParam());
  for (const int turn : {0, 1, 2}) {
    const Projection projection = turn == 2 ? Projection::orthographic : Projection::perspective;
    expect_as_good_as_identical(scene.difference(oblique_camera(scene.surface(), projection, kAspect, turn), 320, 240));
  }
}

INSTANTIATE_TEST_SUITE_P(PovrayExport, Protein,
                         ::testing::Values(NamedBalls{"ubiquitin", ubiquitin()},
                                           NamedBalls{"enterotoxin", enterotoxin()}),
                         [](const auto& instance) { return instance.param.name; });

TEST(PovrayExport, EverySectionOfTheIniRendersWithoutWarning) {
  const ExportedScene scene(cut_probes());
  const test::TemporaryFolder scratch;
  const std::filesystem::path folder = scratch.path() / "scene";
  const povray::SceneReport report =
      scene.write(oblique_camera(scene.surface(), Projection::perspective, kAspect), 64, 48, folder);
  for (const std::string section :
       {"", "opaque", "ghost", "glass", "wax", "flat", "position", "normal", "group", "layers"}) {
    const PovrayRun run = run_povray(folder, {section.empty() ? "surface.ini" : "surface.ini[" + section + "]"});
    EXPECT_EQ(run.exit_code, 0) << section << run.log;
    EXPECT_TRUE(run.warnings.empty()) << section << ": " << run.warnings.front();
    EXPECT_EQ(run.finite_objects, report.object_count) << section;
    EXPECT_EQ(read_rgb(folder / (section.empty() ? "surface.png" : "surface_" + section + ".png")).size(), 64u * 48u);
  }
}

// The command the exporter prints works from a folder elsewhere, whatever the folder is called.
TEST(PovrayExport, PrintedCommandRendersFromAnywhere) {
  const ExportedScene scene(three_atoms());
  const test::TemporaryFolder folder;
  const std::filesystem::path odd = folder.path() / "it's a $HOME";
  const Camera camera = oblique_camera(scene.surface(), Projection::perspective, kAspect);
  const povray::SceneReport report = scene.write(camera, 64, 48, odd);
  const test::ProgramResult run = test::run_program("/bin/sh", {"-c", report.command});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  std::size_t colored = 0;
  for (const glm::dvec3& c : read_rgb(odd / "surface.png")) colored += c.x - c.z > 0.1;
  EXPECT_GT(colored, 200u);
}

TEST(PovrayExport, SwitchesOfTheCommandLineAreUnderstood) {
  const ExportedScene scene({"gas", gas(3, 12, 8.0, 1.2, 1.8)});  // Some atoms shade others.
  const test::TemporaryFolder folder;
  const std::filesystem::path path = folder.path() / "scene";
  scene.write(oblique_camera(scene.surface(), Projection::perspective, kAspect), 32, 24, path);
  const auto render = [&](const std::vector<std::string>& switches) {
    std::vector<std::string> arguments{"surface.ini", "-A"};
    arguments.insert(arguments.end(), switches.begin(), switches.end());
    const PovrayRun run = run_povray(path, arguments);
    EXPECT_EQ(run.exit_code, 0) << run.log;
    // POV-Ray calls its subsurface light experimental.
    if (switches.size() < 2) {
      EXPECT_TRUE(run.warnings.empty()) << run.warnings.front();
    }
    return read_rgb(path / "surface.png");
  };
  const std::vector<glm::dvec3> plain = render({}), shadows = render({"Declare=Meniscus_Shadows=1"});
  EXPECT_NE(plain, shadows);
  const std::vector<glm::dvec3> soft = render({"Declare=Meniscus_Shadows=1", "Declare=Meniscus_Shadow_Softness=9"});
  EXPECT_NE(soft, shadows);
  EXPECT_NE(soft, plain);
  EXPECT_NE(render({"Declare=Meniscus_Shadows=0.5"}), shadows);
  EXPECT_NE(plain, render({"Declare=Meniscus_Material=3", "Declare=Meniscus_Subsurface=1"}));
  // A narrower picture of the same height keeps its middle columns.
  const std::vector<glm::dvec3> narrow = render({"Declare=Meniscus_Fit_Aspect=1", "+W16"});
  ASSERT_EQ(narrow.size(), 16u * 24u);
  for (std::size_t n = 0; n < narrow.size(); ++n)
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(narrow[n][k], plain[n / 16 * 32 + 8 + n % 16][k], 2.0 / 255.0);
}

// sRGB colours come out as they went in: a flat material shows exactly the palette on a background of its own.
TEST(PovrayExport, UsersOverrideMaterialsAndColoursAreExact) {
  const ExportedScene scene(one_atom());
  const test::TemporaryFolder scratch;
  const std::filesystem::path folder = scratch.path() / "scene";
  scene.write(oblique_camera(scene.surface(), Projection::perspective, kAspect), 64, 48, folder);
  write_text(folder / "mine.pov",
             "#version 3.7;\nglobal_settings { assumed_gamma 1.0 }\n#declare Meniscus_Custom_Settings = 1;\n"
             "#declare Meniscus_Finish = finish { emission 1 "
             "ambient 0 diffuse 0 }\n"
             "#declare Meniscus_Background = srgb <0, 1, 0>;\n#include \"surface.pov\"\n");
  const PovrayRun run = run_povray(folder, {"+Imine.pov", "+Omine.png", "+W64", "+H48", "-A"});
  ASSERT_EQ(run.exit_code, 0) << run.log;
  EXPECT_TRUE(run.warnings.empty()) << run.warnings.front();
  const std::vector<glm::dvec3> picture = read_rgb(folder / "mine.png");
  const glm::vec3 expected = turning_colors(1, 3).atom[0];
  const glm::dvec3 middle = picture[24 * 64 + 32], corner = picture[0];
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(middle[k], expected[k], 0.5 / 255.0 + 1e-4);
  EXPECT_EQ(corner, glm::dvec3(0, 1, 0));
}

}  // namespace
}  // namespace meniscus::testing
