// SPDX-License-Identifier: BSD-3-Clause
// The ray caster's, POV-Ray's and Blender's pictures of a molecule agree in colours, hidden parts and copies, pixel by
// pixel.
#include <algorithm>
#include <cmath>
#include <iostream>

#include <OpenImageIO/imageio.h>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "core/color/color_schemes.h"
#include "core/gpu/egl_context.h"
#include "core/image/color_space.h"
#include "core/mesh/tessellate.h"
#include "core/queries/copies.h"
#include "core/render/gl_renderer.h"
#include "core/structure/formats/read_structure.h"
#include "core/surface/compute_surface.h"
#include "exporters/blender/surface_file.h"
#include "exporters/povray/povray_scene.h"
#include "tests/export/povray/povray_render.h"
#include "tests/support/run_program.h"

namespace meniscus::testing {
namespace {

constexpr int kWidth = 280, kHeight = 210;
constexpr std::size_t kPixels = std::size_t{kWidth} * kHeight;
// Both pictures hold linear light in at least 16 bits, with an error of 2e-5; sRGB is at most 13 times as steep.
constexpr float kPovrayTolerance = 1e-3f;
// Blender keeps colours of corners as bytes of sRGB.
constexpr float kBlenderTolerance = 0.5f / 255.0f + 5e-4f;

/// Hits and colours without light that one renderer shows at each pixel's centre.
struct FlatPicture {
  std::vector<bool> hit;
  std::vector<glm::vec3> color;  ///< sRGB
};

/// Casts a picture whose albedo follows from pictures in black, white and colour, for light is linear in the albedo.
FlatPicture cast(const std::vector<SurfaceObject>& objects, const Camera& camera) {
  static EglContext context;
  GlRenderer renderer;
  RenderSettings settings;
  settings.size = {kWidth, kHeight};
  settings.aovs = true;
  const SurfaceObject whole = merged(objects);
  const auto picture_in = [&](const std::optional<glm::vec3>& paint) {
    Coloring coloring = whole.coloring;
    if (paint) {
      coloring.kind.reset();
      std::ranges::fill(coloring.atom, *paint);
    }
    return renderer.render(whole.surface, coloring, camera, settings);
  };
  const Framebuffer color = picture_in({}), black = picture_in(glm::vec3(0.0f)), white = picture_in(glm::vec3(1.0f));
  FlatPicture picture;
  for (std::size_t n = 0; n < kPixels; ++n) {
    picture.hit.push_back(color.atom[n] != kNone);
    const glm::vec3 share = glm::vec3(color.color[n] - black.color[n]) / glm::vec3(white.color[n] - black.color[n]);
    picture.color.push_back(picture.hit[n] ? srgb_from_linear(share) : glm::vec3(0.0f));
  }
  return picture;
}

FlatPicture povray(const std::vector<SurfaceObject>& objects, const Camera& camera) {
  const test::TemporaryFolder scratch;
  povray::SceneOptions options;
  options.width = kWidth;
  options.height = kHeight;
  write_scene(objects, camera, options, scratch.path() / "scene");
  write_text(scratch.path() / "scene/flat.pov",
             "#version 3.7;\n#declare Meniscus_Clear = 1;\n#declare Meniscus_Finish = finish { emission 1 "
             "ambient 0 diffuse 0 }\n"
             "#include \"surface.pov\"\n");
  const PovrayRun run =
      run_povray(scratch.path() / "scene", {"+Iflat.pov", "+Oflat.png", "+FN16", "File_Gamma=1.0", "+UA", "-A",
                                            "+W" + std::to_string(kWidth), "+H" + std::to_string(kHeight)});
  EXPECT_EQ(run.exit_code, 0) << run.log;
  EXPECT_TRUE(run.warnings.empty()) << run.warnings.front();
  FlatPicture picture;
  std::vector<double> alpha;
  for (const glm::dvec3& v : read_rgb(scratch.path() / "scene/flat.png", &alpha))
    picture.color.push_back(srgb_from_linear(glm::vec3(v)));
  for (const double a : alpha) picture.hit.push_back(a > 0.5);
  return picture;
}

FlatPicture blender(const std::vector<SurfaceObject>& objects, const Camera& camera) {
  const test::TemporaryFolder scratch;
  const std::string mns = (scratch.path() / "a.mns").string(), exr = (scratch.path() / "a.exr").string();
  std::vector<blender::MeshedObject> meshed;
  for (const SurfaceObject& object : objects)
    meshed.push_back({object, shown_part(tessellate(object.surface, {0.01, true}), object.coloring), {}, {}});
  write_objects(mns, Existing::refuse, meshed, blender::Shot{camera, kWidth, kHeight}, {});
  const auto run = test::run_program(BLENDER_PROGRAM,
                                     {"-b", "--factory-startup", "--python-exit-code", "3", "--python",
                                      BLENDER_ADDON "/render_mns.py", "--", mns, "--passes", exr},
                                     200);
  EXPECT_EQ(run.exit_code, 0) << run.out << run.err;
  FlatPicture picture;
  const auto file = OIIO::ImageInput::open(exr);
  if (!file) throw std::runtime_error("Blender wrote no passes");
  const OIIO::ImageSpec& spec = file->spec();
  std::vector<float> values(kPixels * spec.nchannels);
  EXPECT_TRUE(file->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, values.data()));
  const auto channel = [&](const std::string& name) {
    for (int c = 0; c < spec.nchannels; ++c)
      if (spec.channelnames[c].ends_with(name)) return c;
    throw std::runtime_error("no channel " + name);
  };
  const int z = channel("Depth.Z"), r = channel("DiffCol.R"), g = channel("DiffCol.G"), b = channel("DiffCol.B");
  for (std::size_t n = 0; n < kPixels; ++n) {
    const float* const v = &values[n * spec.nchannels];
    picture.hit.push_back(v[z] < 1e6f);
    picture.color.push_back(srgb_from_linear(glm::vec3(v[r], v[g], v[b])));
  }
  return picture;
}

struct Difference {
  std::size_t compared = 0;  ///< pixels away from borders: all eight around have their colour
  std::size_t color = 0;     ///< compared pixels of another colour
  std::size_t hit = 0;       ///< pixels of the picture hit in one and missed in the other
};

/// Compares with the other picture, taken `shift` pixels to the side so that the comparison can fail.
Difference compare(const FlatPicture& cast, const FlatPicture& other, float tolerance, int shift = 0) {
  Difference difference;
  for (int y = 1; y + 1 < kHeight; ++y) {
    for (int x = 1; x + 1 < kWidth - shift; ++x) {
      const std::size_t at = static_cast<std::size_t>(y) * kWidth + x, there = at + shift;
      difference.hit += cast.hit[at] != other.hit[there];
      bool alike = cast.hit[at];
      for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) {
          const std::size_t next = at + static_cast<std::ptrdiff_t>(dy) * kWidth + dx;
          alike = alike && glm::length(cast.color[next] - cast.color[at]) < 1e-3f && cast.hit[next];
        }
      if (!alike) continue;
      ++difference.compared;
      const glm::vec3 error = glm::abs(cast.color[at] - other.color[there]);
      difference.color += std::max({error.x, error.y, error.z}) > tolerance;
    }
  }
  return difference;
}

void expect_agreement(const std::vector<SurfaceObject>& objects, const Camera& camera, const std::string& name) {
  const FlatPicture picture = cast(objects, camera);
  const std::pair<FlatPicture, float> others[] = {{povray(objects, camera), kPovrayTolerance},
                                                  {blender(objects, camera), kBlenderTolerance}};
  for (const auto& [other, tolerance] : others) {
    const Difference d = compare(picture, other, tolerance), shifted = compare(picture, other, tolerance, 6);
    std::cout << name << (tolerance == kPovrayTolerance ? ", POV-Ray" : ", Blender") << ": " << d.compared
              << " px compared, colour differs in " << d.color << ", hit or miss in " << d.hit << "; six pixels aside "
              << shifted.color << " and " << shifted.hit << "\n";
    EXPECT_GT(d.compared, kPixels / 40) << name;
    EXPECT_LE(d.color, d.compared / 2000) << name;
    EXPECT_LE(d.hit, kPixels / 1000) << name;  // A mesh's silhouette lies inside of the surface by its tolerance.
    EXPECT_GT(shifted.hit, 20 * (d.hit + 5)) << name;
  }
}

/// Chains A and C of 1TII have two colours by chain and hundreds by B-factor.
Structure two_chains() {
  Structure structure = read_structure("/usr/share/pymol/data/demo/1tii.pdb");
  std::erase_if(structure.atoms, [](const Atom& atom) { return atom.chain != "A" && atom.chain != "C"; });
  return structure;
}

SurfaceObject object_of(const Structure& structure, const char* scheme) {
  SurfaceObject object{"surface", compute_surface_cpu(balls_of(structure), 1.4), {}, {}};
  for (std::uint32_t a = 0; a < structure.atoms.size(); ++a) object.atom.push_back(a);
  object.coloring = color_object(structure, object.atom, parse_color_scheme(scheme).value(), 0);
  return object;
}

Camera camera_for(const std::vector<SurfaceObject>& objects) {
  return frame_camera(placed_balls(objects), static_cast<double>(kWidth) / kHeight);
}

TEST(ColorAgreement, SchemesOfClassesOfNumbersAndOfKinds) {
  const Structure structure = two_chains();
  for (const char* scheme : {"chain", "bfactor", "kind"}) {
    const std::vector<SurfaceObject> objects{object_of(structure, scheme)};
    expect_agreement(objects, camera_for(objects), scheme);
  }
}

TEST(ColorAgreement, HiddenAtomsAreHiddenEverywhereAlike) {
  const Structure structure = two_chains();
  for (const char* scheme : {"residue", "kind"}) {
    std::vector<SurfaceObject> objects{object_of(structure, scheme)};
    // Many whole residues are hidden: most patches are cut, and the inside shows through every gap.
    for (const Atom& atom : structure.atoms) objects[0].coloring.hidden.push_back(atom.residue_number % 3 == 0);
    expect_agreement(objects, camera_for(objects), std::string("hidden, ") + scheme);
  }
}

TEST(ColorAgreement, ObjectsAndCopiesStandAlike) {
  Structure structure = two_chains();
  std::erase_if(structure.atoms, [](const Atom& atom) { return atom.chain != "C"; });
  SurfaceObject first = object_of(structure, "residue"), second = object_of(structure, "#d04030");
  const glm::dmat3 quarter(glm::dvec3(0, 1, 0), glm::dvec3(-1, 0, 0), glm::dvec3(0, 0, 1));
  const glm::dmat3 turn(glm::dvec3(0.6, 0.0, -0.8), glm::dvec3(0, 1, 0), glm::dvec3(0.8, 0.0, 0.6));
  first.copies = {{}, {quarter, {90.0, 10.0, 0.0}}, {turn * quarter, {-40.0, 20.0, 50.0}}};
  second.name = "a \"}\n#include";
  second.copies = {{turn, {10.0, 60.0, 10.0}}};
  const std::vector<SurfaceObject> objects{first, second};
  expect_agreement(objects, camera_for(objects), "copies");
}

}  // namespace
}  // namespace meniscus::testing
