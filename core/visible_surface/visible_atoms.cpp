// SPDX-License-Identifier: BSD-3-Clause
// Runs the kernels that select what one view can show: by theorem 2, and as the paper does.
#include "core/visible_surface/visible_atoms.h"

#include <bit>

#include <tbb/parallel_reduce.h>

#include "core/queries/surface_parts.h"
#include "core/reduced_surface/gpu/gpu_neighbors.h"
#include "core/reduced_surface/reduced_surface.h"

namespace meniscus {
namespace {

using kernel::kNothing;
using kernel::kTileEdge;

/// Returns a block size that is small enough for an atom of common size to cover several blocks whole.
int suitable_block_edge(const PictureFrame& frame) {
  const double radius = 1.5 / frame.pixel_size;  // in pixels
  return radius > 40.0 ? 8 : radius > 10.0 ? 4 : radius > 4.0 ? 2 : 1;
}

}  // namespace

bool VisibleAtoms::theorem_applies(std::span<const Ball> atoms, double probe_radius, const PictureFrame& frame) const {
  if (frame.camera.projection == Projection::perspective) return in_solvent(atoms, probe_radius, frame.camera.position);
  // Orthographic rays begin on a plane, all of which must lie in front of the solid.
  return std::ranges::all_of(atoms, [&](const Ball& ball) {
    return glm::dot(ball.center - frame.camera.position, frame.basis.forward) > ball.radius + probe_radius;
  });
}

void VisibleAtoms::begin_view(std::span<const Ball> atoms, const glm::dvec3& middle, double probe_radius,
                              const PictureFrame& frame, bool keep_all) {
  probe_radius_ = static_cast<float>(probe_radius);
  const glm::dvec3 eye = frame.camera.position - middle;
  const double farthest = tbb::parallel_reduce(
      tbb::blocked_range<std::size_t>(0, atoms.size(), 8192), glm::length(eye),
      [&](const auto& range, double so_far) {
        for (std::size_t n = range.begin(); n != range.end(); ++n)
          so_far = std::max(so_far, glm::distance(atoms[n].center, frame.camera.position));
        return so_far;
      },
      [](double a, double b) { return std::max(a, b); });
  tiles_ = (frame.size + (kTileEdge - 1)) / kTileEdge;
  const bool orthographic = frame.camera.projection == Projection::orthographic;
  view_ = {.eye = glm::vec3(eye),
           .pixel_scale = static_cast<float>(orthographic ? frame.pixel_size : frame.pixel_size / frame.eye_distance),
           .right = glm::vec3(frame.basis.right),
           // The margin is several times the rounding of every bound in single precision; keeping too many atoms is
           // never wrong.
           .margin = static_cast<float>(1e-3 + 4e-6 * farthest),
           .up = glm::vec3(frame.basis.up),
           .orthographic = orthographic,
           .forward = glm::vec3(frame.basis.forward),
           .block_edge = suitable_block_edge(frame),
           .picture_size = frame.size,
           .keep_all = keep_all || !theorem_applies(atoms, probe_radius, frame)};
}

void VisibleAtoms::bind(const Program& program) const {
  program.set(view_, kernel::kViewBinding);
  tile_texels_.bind(4);
  block_texels_.bind(5);
}

void VisibleAtoms::draw_occluders(const Buffer& balls, std::uint32_t atom_count, Buffer& tile_depths) {
  const int blocks_across = kTileEdge / view_.block_edge;
  const std::size_t tile_count = static_cast<std::size_t>(tiles_.x) * tiles_.y;
  block_depths_.resize(tile_count * blocks_across * blocks_across * sizeof(float));
  tile_depths.resize(tile_count * sizeof(float));
  block_depths_.fill(std::bit_cast<std::uint32_t>(kNothing));
  tile_depths.fill(std::bit_cast<std::uint32_t>(kNothing));
  tile_texels_.view(tile_depths);
  block_texels_.view(block_depths_);
  if (keeps_all()) return;

  const Program& occluders = programs_.get("gpu_shaders/visibility/occluders.comp");
  bind(occluders);
  balls.bind(0);
  block_depths_.bind(1);
  occluders.set(kernel::VisibleAtomsParameters{.atom_count = atom_count, .probe_radius = probe_radius_});
  occluders.dispatch(atom_count);

  const Program& tiles = programs_.get("gpu_shaders/visibility/tile_depths.comp");
  bind(tiles);
  block_depths_.bind(0);
  tile_depths.bind(1);
  tiles.dispatch(group_count(tile_count));
}

std::uint32_t VisibleAtoms::keep(const Buffer& balls, const Buffer& balls_low, std::uint32_t atom_count,
                                 Counting counting) {
  before.resize((atom_count + 1) * sizeof(std::uint32_t));
  kept.resize(atom_count * sizeof(std::uint32_t));
  for (int pass = 0; pass < 2; ++pass) {
    const Program& program = programs_.get("gpu_shaders/visibility/kept_atoms.comp", {{"PASS", std::to_string(pass)}});
    bind(program);
    balls.bind(0);
    balls_low.bind(1);
    before.bind(2);
    kept.bind(3);
    program.set(kernel::VisibleAtomsParameters{.atom_count = atom_count, .probe_radius = probe_radius_});
    program.dispatch(group_count(atom_count));
    if (pass == 0) prefix_sum_(before, atom_count);
  }
  trusted_ = counting == Counting::later ? most_kept(atom_count) : atom_count;
  if (counting == Counting::later) return trusted_;
  Readback readback;
  request_counts(readback);
  readback.read();
  return known_ = counted_;
}

void VisibleAtoms::request_counts(Readback& readback) {
  readback.request(before, before.byte_count() - sizeof counted_, {&counted_, 1});
}

bool VisibleAtoms::take_counts() {
  if (counted_ > trusted_) return false;
  known_ = counted_;
  return true;
}

void PaperSelection::select(const PictureFrame& frame, const VisibleAtoms& view, const Buffer& atom_balls,
                            std::uint32_t atom_count, double probe_radius, RollingBuffers& rolling) {
  visible_.resize(atom_count * kWord);
  visible_.fill(0);
  drawn_.resize(atom_count * kWord);
  drawn_.fill(0);
  selected_.resize(rolling.probe_count * kWord);
  selected_.fill(0);
  atom_balls.bind(0);
  visible_.bind(2);
  drawn_.bind(3);
  draw("visible_spheres", frame, view, atom_count, static_cast<float>(probe_radius));
  atom_balls.bind(0);
  visible_.bind(2);
  rolling.probes->bind(3);
  selected_.bind(4);
  draw("visible_faces", frame, view, rolling.probe_count, static_cast<float>(probe_radius));
  keep_arcs(rolling);
  keep_probes(rolling);
}

void PaperSelection::draw(const char* kernel, const PictureFrame& frame, const VisibleAtoms& view, std::uint32_t count,
                          float probe_radius) {
  pixel_depths_.resize(static_cast<std::size_t>(frame.size.x) * frame.size.y * sizeof(float));
  pixel_depths_.fill(std::bit_cast<std::uint32_t>(kernel::kNothing));
  pixel_depths_.bind(1);
  const Program& program = programs_.get("gpu_shaders/paper_selection/" + std::string(kernel) + ".comp");
  view.bind(program);
  for (const std::uint32_t pass : {0u, 1u}) {
    program.set(kernel::DrawParameters{.count = count, .probe_radius = probe_radius, .pass = pass});
    program.dispatch(count);
  }
}

void PaperSelection::keep_arcs(RollingBuffers& rolling) {
  const std::uint32_t table_size = std::bit_ceil(2 * rolling.probe_count + 2);
  face_table_.resize(table_size * kWord);
  face_table_.fill(0);
  kept_arcs_.resize(rolling.arc_count * sizeof(RsArc));
  counter_.resize(kWord);
  counter_.fill(0);
  arc_texels_.view(*rolling.arcs);
  const Program& table = programs_.get("gpu_shaders/paper_selection/face_table.comp");
  face_table_.bind(2);
  rolling.probes->bind(3);
  table.set(kernel::FaceTableParameters{.table_size = table_size, .count = rolling.probe_count});
  table.dispatch(group_count(rolling.probe_count));
  for (const char* pass : {"0", "1"}) {
    const Program& program = programs_.get("gpu_shaders/paper_selection/selected_arcs.comp", {{"PASS", pass}});
    arc_texels_.bind(0);
    selected_.bind(0);
    visible_.bind(1);
    face_table_.bind(2);
    rolling.probes->bind(3);
    kept_arcs_.bind(4);
    drawn_.bind(5);
    counter_.bind(6);
    program.set(kernel::FaceTableParameters{.table_size = table_size, .count = rolling.arc_count});
    program.dispatch(group_count(rolling.arc_count));
  }
  rolling.arc_count = counted();
  std::swap(*rolling.arcs, kept_arcs_);
}

void PaperSelection::keep_probes(RollingBuffers& rolling) {
  kept_probes_.resize(rolling.probes->byte_count());
  kept_balls_.resize(rolling.balls->byte_count());
  kept_balls_low_.resize(rolling.balls_low->byte_count());
  counter_.fill(0);
  const Program& program = programs_.get("gpu_shaders/paper_selection/selected_faces.comp");
  selected_.bind(0);
  rolling.balls->bind(1);
  rolling.balls_low->bind(2);
  rolling.probes->bind(3);
  kept_balls_.bind(4);
  kept_balls_low_.bind(5);
  kept_probes_.bind(6);
  counter_.bind(7);
  program.set(kernel::FaceParameters{.probe_count = rolling.probe_count});
  program.dispatch(group_count(rolling.probe_count));
  rolling.probe_count = counted();
  std::swap(*rolling.probes, kept_probes_);
  std::swap(*rolling.balls, kept_balls_);
  std::swap(*rolling.balls_low, kept_balls_low_);
}

std::uint32_t PaperSelection::counted() const { return counter_.download<std::uint32_t>(1).front(); }

}  // namespace meniscus
