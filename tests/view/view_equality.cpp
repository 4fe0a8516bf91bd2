// SPDX-License-Identifier: BSD-3-Clause
// Counts the pixels in which pictures of a view differ from pictures of the complete surface, from random cameras.
//
//   ninja view_equality && tests/view/view_equality 1crn.pdb 1tii.pdb --probes 0.7 1.4 3 10 --outside 200 --inside 50
//   tests/view/view_equality 1tii.pdb --extent paper --outside 100 --inside 0       what the paper's selection misses
// A row for each file and probe, then how many views there were and how many differ; exits with 1 if a visible view
// does. Bits are compared: sums of samples, normals, depths, atoms.
#include <cstring>
#include <filesystem>
#include <iostream>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ostream.h>

#include "core/gpu/egl_context.h"
#include "core/structure/formats/read_structure.h"
#include "core/render/gl_renderer.h"
#include "core/visible_surface/view_pipeline.h"
#include "tests/view/view_cameras.h"
#include "core/color/coloring.h"

namespace meniscus {
namespace {

struct Options {
  std::vector<std::string> files;
  std::vector<double> probes{1.4};
  int outside = 20, inside = 5, width = 256, height = 192;
  std::string extent = "visible";
};

/// Atoms, the extent to which they are seen, and their renderer.
struct View {
  ViewPipeline surface;
  GlRenderer renderer;

  std::vector<glm::vec4> samples(std::size_t count) const { return renderer.samples().download<glm::vec4>(count); }
  std::vector<ray_cast::Hit> hits(std::size_t count) const { return renderer.hits().download<ray_cast::Hit>(count); }
};

/// Shows the same atoms through two views, so that the complete one keeps data that do not depend on the camera.
class Comparison {
 public:
  Comparison(const std::vector<Ball>& atoms, const Options& options, double probe_radius) : atoms_(atoms) {
    settings_.size = {options.width, options.height};
    complete_.surface.set_surface(probe_radius, Extent::complete);
    view_.surface.set_surface(probe_radius, options.extent == "paper" ? Extent::paper : Extent::visible);
    Coloring coloring;
    for (std::size_t a = 0; a < atoms.size(); ++a)
      coloring.atom.emplace_back(0.1f * static_cast<float>(a % 10), 0.2f * static_cast<float>(a % 5), 0.5f);
    for (View* view : {&complete_, &view_}) {
      view->surface.set_atoms(atoms);
      view->surface.set_coloring(coloring);
    }
  }

  void compare(const Camera& camera) {
    for (View* view : {&complete_, &view_}) view->renderer.draw(view->surface, camera, settings_);
    const std::size_t count = static_cast<std::size_t>(settings_.size.x) * settings_.size.y;
    const auto expected = complete_.samples(count), found = view_.samples(count);
    const auto expected_hits = complete_.hits(count), found_hits = view_.hits(count);
    int differing = 0;
    for (std::size_t at = 0; at < count; ++at) {
      const ray_cast::Hit &a = expected_hits[at], &b = found_hits[at];
      differing += std::memcmp(&expected[at], &found[at], sizeof(glm::vec4)) != 0 || a.t != b.t ||
                   a.normal != b.normal || a.atom != b.atom;
      shown_ += expected[at].w > 0.0f;
    }
    ++cameras;
    differing_cameras += differing > 0;
    differing_pixels += differing;
    worst = std::max(worst, differing);
    const std::size_t kept = view_.surface.stats().kept_atoms;
    if (kept == atoms_.size()) ++whole;
    kept_ += static_cast<double>(kept) / static_cast<double>(atoms_.size());
  }

  double kept() const { return cameras ? kept_ / cameras : 0.0; }
  double shown() const { return cameras ? static_cast<double>(shown_) / cameras : 0.0; }

  int cameras = 0, differing_cameras = 0, worst = 0, whole = 0;
  long differing_pixels = 0;

 private:
  const std::vector<Ball>& atoms_;
  View complete_, view_;
  RenderSettings settings_;
  double kept_ = 0.0;
  long shown_ = 0;
};

int run(const Options& options) {
  const EglContext context;
  fmt::print(std::cout,
             "{}x{} pixels, {} against complete, on {}\n{:<14} {:>6} {:>8} {:>8} {:>9} {:>9} {:>6} {:>6} {:>8} {:>9}\n",
             options.width, options.height, options.extent, context.renderer(), "file", "probe", "where", "cameras",
             "differing", "pixels", "worst", "kept", "kept all", "shown px");
  int cameras = 0, differing = 0;
  for (const std::string& file : options.files) {
    const std::vector<Ball> atoms = balls_of(read_structure(file, {}));
    for (const double probe_radius : options.probes) {
      for (const bool inside : {false, true}) {
        Comparison comparison(atoms, options, probe_radius);
        std::mt19937 random(inside ? 7 : 4);
        const double aspect = static_cast<double>(options.width) / options.height;
        for (int n = 0; n < (inside ? options.inside : options.outside); ++n)
          comparison.compare(inside ? testing::camera_inside(atoms, probe_radius, random)
                                    : testing::camera_outside(atoms, aspect, random));
        if (comparison.cameras == 0) continue;
        fmt::print(std::cout, "{:<14} {:>6} {:>8} {:>8} {:>9} {:>9} {:>6} {:>5.0f}% {:>8} {:>9.0f}\n",
                   std::filesystem::path(file).filename().string(), probe_radius, inside ? "inside" : "outside",
                   comparison.cameras, comparison.differing_cameras, comparison.differing_pixels, comparison.worst,
                   100.0 * comparison.kept(), comparison.whole, comparison.shown());
        std::cout.flush();
        cameras += comparison.cameras;
        differing += comparison.differing_cameras;
      }
    }
  }
  fmt::print(std::cout, "cases {} failures {}\n", cameras, differing);
  return differing == 0 || options.extent == "paper" ? 0 : 1;
}

}  // namespace
}  // namespace meniscus

int main(int argc, char** argv) {
  CLI::App app("Pictures of views against pictures of complete surfaces");
  meniscus::Options options;
  app.add_option("FILES", options.files)->required();
  app.add_option("--probes", options.probes);
  app.add_option("--outside", options.outside);
  app.add_option("--inside", options.inside);
  app.add_option("--width", options.width);
  app.add_option("--height", options.height);
  app.add_option("--extent", options.extent);
  CLI11_PARSE(app, argc, argv);
  return meniscus::run(options);
}
