// SPDX-License-Identifier: BSD-3-Clause
// Times frames from a turning camera, with a changing probe, and with moving atoms.
#include "app/bench/paper_bench.h"
#include "core/gpu/egl_context.h"

#ifdef MENISCUS_WITH_GL

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <iostream>
#include <numbers>
#include <optional>
#include <span>

#include <fmt/format.h>
#include <fmt/ostream.h>
#include <glm/geometric.hpp>

#include "core/base/text.h"
#include "core/render/gl_renderer.h"
#include "core/visible_surface/view_pipeline.h"
#include "core/color/coloring.h"

namespace meniscus {
namespace {

/// Frames per second in the paper's table 1, on a GeForce GTX 285.
struct PaperFigure {
  const char* name;
  double frames_per_second;
};
constexpr PaperFigure kPaper[] = {{"1A3I", 68}, {"1CRN", 31}, {"1RWE", 16}, {"1J4N", 7}, {"1VIS", 5}, {"1TII", 3}};

std::optional<double> paper_figure(const std::string& name) {
  const std::string upper = upper_case(name.substr(0, 4));
  for (const PaperFigure& figure : kPaper)
    if (upper == figure.name) return figure.frames_per_second;
  return {};
}

/// The paper's four groups of stages, and ray casting.
constexpr std::array kGroups = {"visible atoms", "potential", "faces", "primitives", "ray cast"};

std::size_t group_of(const std::string& stage) {
  if (stage == "neighbors" || stage == "circles" || stage == "doubtful circles") return 1;
  if (stage == "fixed probes") return 2;
  if (stage == "primitives") return 3;
  if (stage == "tile lists" || stage == "ray cast" || stage == "finish") return 4;
  return 0;  // frame, upload, visible atoms
}

struct FrameTime {
  double total = 0.0;  ///< ms of wall-clock time
  std::array<double, kGroups.size()> groups{};
};

FrameTime median(std::vector<FrameTime> times) {
  const auto middle = times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2);
  std::nth_element(times.begin(), middle, times.end(), [](auto& a, auto& b) { return a.total < b.total; });
  return *middle;
}

/// The change from frame to frame.
enum class FrameChange { camera, probe, atoms };

class MoleculeBench {
 public:
  MoleculeBench(const PaperBenchMolecule& molecule, const PaperBenchSettings& settings)
      : molecule_(molecule), settings_(settings) {
    const double aspect = static_cast<double>(settings.size.x) / settings.size.y;
    camera_ = frame_camera(molecule.balls, aspect);
    first_position_ = camera_.position;
    picture_.size = settings.size;
    view_.set_atoms(molecule.balls);
    Coloring coloring;
    coloring.atom.assign(molecule.balls.size(), glm::vec3(0.8f));
    view_.set_coloring(coloring);
  }

  /// Measures groups one by one, with the GPU idle between them, and whole frames as a viewer draws them.
  FrameTime measure(Extent extent, FrameChange change) {
    view_.set_surface(settings_.probe_radius, extent);
    draw();  // the first picture compiles kernels and allocates buffers
    FrameTime result = median(draw_frames(extent, change, StageTiming::exact));
    result.total = median(draw_frames(extent, change, StageTiming::rough)).total;
    return result;
  }

  const ViewStats& stats() const { return view_.stats(); }

 private:
  void draw() { renderer_.draw(view_, camera_, picture_); }

  std::vector<FrameTime> draw_frames(Extent extent, FrameChange change, StageTiming timing) {
    picture_.timing = timing;
    std::vector<FrameTime> times;
    for (int n = 1; n <= settings_.runs; ++n) {
      const double turn = 2.0 * std::numbers::pi * n / settings_.runs;
      std::vector<Ball> moved;
      if (change == FrameChange::camera) turn_camera(turn);
      if (change == FrameChange::probe) view_.set_surface(settings_.probe_radius * (1.0 + 1e-3 * n), extent);
      if (change == FrameChange::atoms) {
        moved = molecule_.balls;
        for (std::size_t a = 0; a < moved.size(); ++a) moved[a].center.x += 1e-3 * n * std::sin(static_cast<double>(a));
      }
      const auto begin = std::chrono::steady_clock::now();
      if (change == FrameChange::atoms) view_.set_atoms(std::move(moved));
      draw();
      const std::chrono::duration<double, std::milli> elapsed = std::chrono::steady_clock::now() - begin;
      FrameTime time{elapsed.count(), {}};
      for (const StageTime& stage : renderer_.times()) time.groups[group_of(stage.name)] += stage.milliseconds;
      times.push_back(time);
    }
    camera_.position = first_position_;
    if (change == FrameChange::atoms) view_.set_atoms(molecule_.balls);
    return times;
  }

  void turn_camera(double angle) {
    const glm::dvec3 axis = glm::normalize(camera_.up), d = first_position_ - camera_.target;
    camera_.position = camera_.target + d * std::cos(angle) + glm::cross(axis, d) * std::sin(angle) +
                       axis * (glm::dot(axis, d) * (1.0 - std::cos(angle)));
  }

  const PaperBenchMolecule& molecule_;
  const PaperBenchSettings& settings_;
  ViewPipeline view_;
  GlRenderer renderer_;
  Camera camera_;
  RenderSettings picture_;
  glm::dvec3 first_position_{0.0};
};

void print_head(std::size_t width) {
  fmt::print(std::cout, "{:<{}} {:>9} {:<9} {:>6}", "molecule", width, "atoms", "extent", "kept");
  for (const char* group : kGroups) fmt::print(std::cout, " {:>13}", group);
  fmt::print(std::cout, " {:>9} {:>7} {:>7} {:>9} {:>9}\n", "total ms", "fps", "paper", "new probe", "new atoms");
}

void print_row(MoleculeBench& bench, const PaperBenchMolecule& molecule, std::size_t width, Extent extent) {
  // A complete surface does not depend on the camera, so only new atoms require all of it again.
  const FrameTime turned = bench.measure(extent, extent == Extent::complete ? FrameChange::atoms : FrameChange::camera);
  const ViewStats stats = bench.stats();
  const FrameTime probe = bench.measure(extent, FrameChange::probe), moved = bench.measure(extent, FrameChange::atoms);
  fmt::print(std::cout, "{:<{}} {:>9} {:<9} {:>5.0f}%", escaped(molecule.name), width,
             with_thousands(molecule.balls.size()), extent == Extent::complete ? "complete" : "visible",
             100.0 * static_cast<double>(stats.kept_atoms) / static_cast<double>(stats.atoms));
  for (const double group : turned.groups) fmt::print(std::cout, " {:>13.2f}", group);
  const auto paper = paper_figure(molecule.name);
  fmt::print(std::cout, " {:>9.2f} {:>7.1f} {:>7} {:>9.2f} {:>9.2f}\n", turned.total, 1000.0 / turned.total,
             paper ? fmt::format("{:.0f}", *paper) : "-", probe.total, moved.total);
  std::cout.flush();
}

}  // namespace

void print_paper_tables(const std::vector<PaperBenchMolecule>& molecules, const PaperBenchSettings& settings) {
  const EglContext context(settings.device);
  std::size_t width = 8;
  for (const PaperBenchMolecule& molecule : molecules) width = std::max(width, escaped(molecule.name).size());
  fmt::print(
      std::cout,
      "Frames of {}x{} pixels, probe {} \u00c5, on {}, GL {}. Milliseconds, medians of {} frames.\n"
      "visible atoms, potential (arcs in place of faces), faces, primitives: the paper's groups of stages; ray "
      "cast: with tile lists. Each group is timed alone, the GPU idle before and after it; total and fps are of whole\n"
      "frames as a viewer draws them. The camera turns; in the last two columns the probe changes, or all atoms move.\n"
      "paper: frames per second of table 1 in Krone, Dachsbacher & Ertl 2010, GeForce GTX 285.\n\n",
      settings.size.x, settings.size.y, settings.probe_radius, context.renderer(), context.version(), settings.runs);
  print_head(width);
  for (const PaperBenchMolecule& molecule : molecules) {
    MoleculeBench bench(molecule, settings);
    for (const Extent extent : {Extent::complete, Extent::visible}) print_row(bench, molecule, width, extent);
  }
}

}  // namespace meniscus

#else

namespace meniscus {

void print_paper_tables(const std::vector<PaperBenchMolecule>&, const PaperBenchSettings& settings) {
  const EglContext context(settings.device);  // throws: this build has no GL
}

}  // namespace meniscus

#endif
