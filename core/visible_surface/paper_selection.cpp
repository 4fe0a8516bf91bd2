// SPDX-License-Identifier: BSD-3-Clause
// Runs the kernels of gpu_shaders/paper_selection in the paper's order.
#include "core/visible_surface/paper_selection.h"

#include <bit>
#include <string>
#include <utility>

#include "core/gpu/kernel_records.h"
#include "core/reduced_surface/gpu/gpu_neighbors.h"
#include "core/reduced_surface/reduced_surface.h"

namespace meniscus {
namespace {}  // namespace

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
