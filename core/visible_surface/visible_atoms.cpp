// SPDX-License-Identifier: BSD-3-Clause
// Runs the kernels of gpu_shaders/visibility: occluders, tile depths, kept atoms.
#include "core/visible_surface/visible_atoms.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include <glm/geometric.hpp>
#include <tbb/parallel_reduce.h>

#include "core/gpu/kernel_records.h"
#include "core/reduced_surface/gpu/gpu_neighbors.h"
#include "core/queries/surface_point.h"

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

void VisibleAtoms::look(std::span<const Ball> atoms, const glm::dvec3& middle, double probe_radius,
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
  ask(readback);
  readback.read();
  return known_ = counted_;
}

void VisibleAtoms::ask(Readback& readback) {
  readback.ask(before, before.byte_count() - sizeof counted_, {&counted_, 1});
}

bool VisibleAtoms::settle() {
  if (counted_ > trusted_) return false;
  known_ = counted_;
  return true;
}

}  // namespace meniscus
