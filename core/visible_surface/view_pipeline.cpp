// SPDX-License-Identifier: BSD-3-Clause
// Runs the stages of one view in order, each a kernel or two, with the buffers that they pass on.
#include "core/visible_surface/view_pipeline.h"

#include <cassert>

#include "core/base/error.h"
#include "core/surface/compute_surface.h"

namespace meniscus {
namespace {

constexpr std::size_t kProbeWord = 3 * kWord;  // byte offset of probe_count in GpuPack::counters

}  // namespace

void ViewPipeline::set_atoms(std::vector<Ball> atoms) {
  stats_.grown_by = 0.0;
  take_atoms(std::move(atoms));
}

void ViewPipeline::take_atoms(std::vector<Ball> atoms) {
  assert(!atoms.empty());
  trusted_ = trusted_ && atoms.size() == atoms_.size();
  atoms_ = std::move(atoms);
  swallowed_ = swallowing_.of(atoms_);
  const BallExtent box = extent_of(atoms_);
  middle_ = 0.5 * (box.low + box.high);  // the same middle as in GpuNeighbors
  extent_of_atoms_ = {box.low - middle_, box.high - middle_, box.largest_radius};
  uploaded_ = false;
}

void ViewPipeline::set_surface(double probe_radius, Extent extent) {
  assert(probe_radius >= 0.0);
  uploaded_ = uploaded_ && probe_radius == probe_radius_;
  trusted_ = trusted_ && probe_radius == probe_radius_ && extent == extent_;
  probe_radius_ = probe_radius;
  extent_ = extent;
}

const GpuPack& ViewPipeline::prepare(const PictureFrame& frame, StageClock& clock) {
  assert(scene_.atom_count == atoms_.size());
  for (int attempt = 1;; ++attempt) {
    try {
      prepare_once(frame, clock);
      return scene_;
    } catch (const OpenSurfaceError&) {
      trusted_ = false;
      if (attempt == kTieAttempts) throw;
      take_atoms(grown_balls(atoms_, attempt));
      stats_.grown_by += tie_growth(attempt);
    }
  }
}

void ViewPipeline::prepare_once(const PictureFrame& frame, StageClock& clock) {
  if (!uploaded_) upload_atoms(clock);
  find_occluders(frame, clock);
  if (!all_probes_found_ || !visible_.keeps_all() || extent_ == Extent::paper) {
    all_probes_found_ = false;
    arcs_open_ = can_trust();
    keep_atoms(clock);
    find_arcs(clock);
    find_fixed_probes(frame, clock);
    all_probes_found_ = !arcs_open_ && visible_.keeps_all() && extent_ != Extent::paper;
  }
  primitives_open_ = trusted_;
  make_primitives(frame, clock);
  trusted_ = counting_ == Counting::later && !primitives_open_ && arcs_.neighbors.known().count > 0 &&
             probe_neighbors_.known().count > 0 && arcs_.circles.stats().decided_in_quadruple == 0 &&
             extent_ != Extent::paper;
}

// True if sizes of the last view can be assumed. A frame that was given up leaves counts unknown, and the next one
// assumes nothing.
bool ViewPipeline::can_trust() const {
  return trusted_ && arcs_.neighbors.can_trust(visible_.most_kept(atom_count())) &&
         probe_neighbors_.can_trust(probes_.capacity());
}

void ViewPipeline::request_counts(Readback& readback) {
  if (arcs_open_) {
    visible_.request_counts(readback);
    arcs_.request_counts(readback);
    readback.request(probe_counters_, 0, probe_counts_);
    probe_neighbors_.request_counts(readback);
  }
  if (primitives_open_) readback.request(scene_.counters, 0, primitive_counts_);
}

bool ViewPipeline::take_counts() {
  if (!arcs_open_ && !primitives_open_) return true;
  bool had_room = !arcs_open_ || take_arc_counts();
  if (primitives_open_)
    had_room = take_list_counts({&scene_.primitives, &scene_.rows}, primitive_counts_) && primitive_counts_[2] == 0 &&
               had_room;
  stats_.primitives = scene_.primitives.count();
  all_probes_found_ = had_room && (all_probes_found_ || visible_.keeps_all());
  arcs_open_ = primitives_open_ = false;
  trusted_ = had_room;
  return had_room;
}

// False if anything needs the host's attention; the repeated frame then finds out what.
bool ViewPipeline::take_arc_counts() {
  if (!visible_.take_counts() || !arcs_.take_counts() || !take_list_counts({&probes_}, probe_counts_) || !is_closed() ||
      !probe_neighbors_.take_counts())
    return false;
  stats_.kept_atoms = visible_.known();
  stats_.circles = arcs_.circles.stats();
  stats_.arcs = arc_count_ = arcs_.circles.arcs.count();
  stats_.probes = probes_.count();
  return true;
}

void ViewPipeline::upload_atoms(StageClock& clock) {
  const GpuStage stage(clock, "upload");
  all_probes_found_ = false;
  stats_ = {};
  stats_.atoms = atoms_.size();
  if (!std::ranges::equal(atoms_, uploaded_radii_, {},
                          &Ball::radius)) {  // atoms move more often than their radii change
    uploaded_radii_.resize(atoms_.size());
    std::ranges::transform(atoms_, uploaded_radii_.begin(), &Ball::radius);
    radii_.upload(uploaded_radii_);
  }
  arcs_.upload(atoms_, swallowed_, probe_radius_);
  uploaded_ = true;
}

// Group 1 (section 3.2 of the paper).
void ViewPipeline::find_occluders(const PictureFrame& frame, StageClock& clock) {
  const GpuStage stage(clock, "visible atoms");
  visible_.begin_view(atoms_, middle_, probe_radius_, frame, extent_ != Extent::visible || scene_.some_hidden);
  visible_.draw_occluders(arcs_.neighbors.balls, atom_count(), scene_.tile_depths);
}

void ViewPipeline::keep_atoms(StageClock& clock) {
  const GpuStage stage(clock, "visible atoms");
  const std::uint32_t count = visible_.keep(arcs_.neighbors.balls, arcs_.neighbors.balls_low, atom_count(),
                                            arcs_open_ ? Counting::later : Counting::now);
  arcs_.neighbors.list_only(visible_.kept, visible_.before, count);
  stats_.kept_atoms = count;
}

// Group 2 (section 3.3): circles in place of atom triples.
void ViewPipeline::find_arcs(StageClock& clock) {
  if (arcs_open_)
    arcs_.find_later(clock);
  else
    arcs_.find(clock);
  stats_.circles = arcs_.circles.stats();
  arc_count_ = arcs_.circles.arcs.most();
  stats_.arcs = arc_count_;
  arc_texels_.view(arcs_.circles.arcs.buffer);
}

// Group 3 (section 3.3): fixed probes are RS faces.
void ViewPipeline::find_fixed_probes(const PictureFrame& frame, StageClock& clock) {
  const GpuStage stage(clock, "fixed probes");
  place_probes();
  whole_spheres_ = extent_ == Extent::paper;
  if (whole_spheres_) select_as_the_paper(frame);
  const double reach = extent_of_atoms_.largest_radius + probe_radius_;
  const BallExtent extent{extent_of_atoms_.low - reach, extent_of_atoms_.high + reach, probe_radius_};
  probe_neighbors_.count_lists(arcs_open_ ? Counting::later : Counting::now);
  if (arcs_open_)
    probe_neighbors_.adopt(probes_.most(), extent, probe_counters_, 0);
  else
    probe_neighbors_.adopt(static_cast<std::uint32_t>(stats_.probes), extent);
}

void ViewPipeline::select_as_the_paper(const PictureFrame& frame) {
  RollingBuffers rolling{&arcs_.circles.arcs.buffer,  &probes_.buffer, &probe_neighbors_.balls,
                         &probe_neighbors_.balls_low, arc_count_,      static_cast<std::uint32_t>(stats_.probes)};
  paper_.select(frame, visible_, arcs_.neighbors.balls, atom_count(), probe_radius_, rolling);
  arc_texels_.view(arcs_.circles.arcs.buffer);
  arc_count_ = rolling.arc_count;
  stats_.arcs = rolling.arc_count;
  stats_.probes = rolling.probe_count;
}

void ViewPipeline::place_probes() {
  const Program& program = programs_.get("gpu_shaders/reduced_surface/fixed_probes.comp", {{"LISTED", "1"}});
  const auto run = [&] {
    probe_neighbors_.balls.resize(probes_.capacity() * sizeof(glm::vec4));
    probe_neighbors_.balls_low.resize(probes_.capacity() * sizeof(glm::vec4));
    arcs_.circles.atoms.bind(0);
    radii_.bind(1);
    probes_.buffer.bind(2);
    probe_neighbors_.balls.bind(3);
    probe_neighbors_.balls_low.bind(4);
    probe_counters_.bind(5);
    arcs_.circles.counters().bind(6);
    arc_texels_.bind(0);
    arcs_.neighbors.bind_listed();
    visible_.bind(program);
    program.set(kernel::FixedProbeParameters{.middle = middle_,
                                             .probe_radius = probe_radius_,
                                             .arc_count = arc_count_,
                                             .probe_capacity = probes_.capacity()});
    program.dispatch(group_count(arc_count_));
  };
  if (arcs_open_) return append_later({&probes_}, probe_counters_, probe_counts_, run);
  probes_.clear();
  append_all({&probes_}, probe_counters_, probe_counts_, run);
  stats_.probes = probes_.count();
  if (!is_closed())
    throw OpenSurfaceError(
        "the part of the surface that this view needs is not closed; nothing was drawn; "
        "please report this structure");
}

// Theorem 3: three arcs end at every fixed probe, with each of its atoms once as the third.
bool ViewPipeline::is_closed() const {
  const auto end_sums = std::span(probe_counts_).subspan<1>();
  return end_sums[0] == end_sums[2] && end_sums[2] == end_sums[4] && end_sums[1] == end_sums[3] &&
         end_sums[3] == end_sums[5];
}

// Group 4 (section 3.4).
void ViewPipeline::make_primitives(const PictureFrame& frame, StageClock& clock) {
  const GpuStage stage(clock, "primitives");
  list_arcs_by_atom();
  if (!whole_spheres_) find_clips();
  static_cast<PackPlacement&>(scene_) = place_atoms(atoms_, probe_radius_, frame);
  scene_.counters.resize(kProbeWord + kWord);
  scene_.counters.copy(probe_counters_, 0, kProbeWord, kWord);
  const auto run = [&] { append_primitives(frame); };
  if (primitives_open_)
    return append_later({&scene_.primitives, &scene_.rows}, scene_.counters, primitive_counts_, run);
  scene_.primitives.clear();
  scene_.rows.clear();
  append_all({&scene_.primitives, &scene_.rows}, scene_.counters, primitive_counts_, run);
  if (primitive_counts_[2] != 0)
    throw CapacityError("a patch is cut by more others than this driver's kernels can process; use a smaller probe");
  stats_.primitives = scene_.primitives.count();
}

void ViewPipeline::list_arcs_by_atom() {
  const std::uint32_t arc_count = arc_count_;
  atom_arc_first_.resize((atom_count() + 1) * kWord);
  atom_arc_first_.fill(0);
  atom_arc_rank_.resize(arc_count * sizeof(glm::uvec2));
  atom_arcs_.resize(2 * arc_count * sizeof(glm::uvec4));
  for (int pass = 0; pass < 2; ++pass) {
    const Program& program = programs_.get("gpu_shaders/primitives/atom_arcs.comp", {{"PASS", std::to_string(pass)}});
    arc_texels_.bind(0);
    atom_arc_first_.bind(0);
    atom_arc_rank_.bind(1);
    atom_arcs_.bind(2);
    arcs_.circles.counters().bind(3);
    program.set(kernel::ArcParameters{.arc_count = arc_count});
    program.dispatch(group_count(arc_count));
    if (pass == 0) prefix_sum_(atom_arc_first_, atom_count());
  }
  atom_arc_first_texels_.view(atom_arc_first_);
  atom_arc_texels_.view(atom_arcs_);
}

// Many invocations share an atom's arcs, because the number of arcs varies between atoms.
void ViewPipeline::find_clips() {
  convex_clips_.resize(atom_count() * kWord);
  convex_clips_.fill(0);
  const Program& shown = programs_.get("gpu_shaders/primitives/shown_atoms.comp", {{"LISTED", "1"}});
  arcs_.circles.atoms.bind(0);
  radii_.bind(1);
  convex_clips_.bind(2);
  arcs_.neighbors.bind_listed();
  visible_.bind(shown);
  shown.set(convex_parameters({.first = 0, .count = arcs_.neighbors.entry_count()}));
  shown.dispatch(group_count(arcs_.neighbors.entry_count()));

  marked_arcs_.resize(atom_arcs_.byte_count());
  const auto run = [&](const char* name, const Buffer& first, const TexelBuffer& lists, const ShaderDefines& defines) {
    const Program& program = programs_.get(std::string("gpu_shaders/primitives/") + name + ".comp", defines);
    first.bind(0);
    atom_arc_rank_.bind(1);
    convex_clips_.bind(2);
    arcs_.circles.counters().bind(3);
    atom_arc_first_texels_.bind(0);
    lists.bind(1);
    arc_texels_.bind(2);
    program.set(kernel::ArcParameters{.arc_count = arc_count_});
    program.dispatch(group_count(2 * std::size_t{arc_count_}));
  };
  run("partners", marked_arcs_, atom_arc_texels_, {});
  marked_arc_texels_.view(marked_arcs_);
  run("spurious_arcs", arcs_.circles.atoms, marked_arc_texels_, {});
  run("spurious_arcs", arcs_.circles.atoms, marked_arc_texels_, {{"DOUBLE_PRECISION", "1"}});
}

kernel::ConvexParameters ViewPipeline::convex_parameters(const BallBatch& batch) const {
  return {.middle = middle_, .first_entry = batch.first, .entry_count = batch.count, .atom_count = atom_count()};
}

void ViewPipeline::append_primitives(const PictureFrame& frame) {
  if (probe_radius_ > 0.0) {  // for a probe of radius 0 tori and concave patches have no area
    const Program& toroidal = primitive_kernel("toroidal", frame);
    arcs_.circles.atoms.bind(0);
    radii_.bind(1);
    arcs_.circles.counters().bind(5);
    arc_texels_.bind(0);
    toroidal.set(kernel::ArcParameters{.arc_count = arc_count_});
    toroidal.dispatch(group_count(arc_count_));

    probe_neighbors_.for_each_batch([&](const BallBatch& batch) {
      const Program& concave = primitive_kernel("concave", frame);
      arcs_.circles.atoms.bind(0);
      probes_.buffer.bind(1);
      probe_neighbors_.first.bind(5);
      probe_neighbors_.labels.bind(6);
      probe_neighbors_.relative.bind(7);
      concave.set(kernel::ConcaveParameters{.first_probe = batch.first, .probe_count = batch.count});
      concave.dispatch(group_count(batch.count));
    });
  }
  arcs_.neighbors.for_each_batch([&](const BallBatch& batch) {
    ShaderDefines defines{{"LISTED", "1"}};
    if (whole_spheres_) defines.emplace_back("WHOLE_SPHERES", "1");
    const Program& convex = primitive_kernel("convex", frame, defines);
    (whole_spheres_ ? paper_.drawn() : convex_clips_).bind(7);
    arcs_.circles.atoms.bind(0);
    radii_.bind(1);
    atom_arc_first_texels_.bind(0);
    marked_arc_texels_.bind(1);
    arcs_.neighbors.first.bind(5);
    arcs_.neighbors.labels.bind(6);
    arcs_.neighbors.bind_listed();
    convex.set(convex_parameters(batch));
    convex.dispatch(group_count(batch.count));
  });
}

// Returns the kernel with everything that append_primitive.glsl needs.
const Program& ViewPipeline::primitive_kernel(const char* name, const PictureFrame& frame,
                                              const ShaderDefines& defines) {
  const Program& program = programs_.get(std::string("gpu_shaders/primitives/") + name + ".comp", defines);
  scene_.primitives.buffer.bind(2);
  scene_.rows.buffer.bind(3);
  scene_.counters.bind(4);
  program.set(kernel::PrimitiveParameters{.pivot = frame.pivot,
                                          .eye_distance = frame.eye_distance,
                                          .camera_position = frame.camera.position,
                                          .probe_radius = probe_radius_,
                                          .camera_forward = frame.basis.forward,
                                          .slack = scene_.slack,
                                          .orthographic = frame.camera.projection == Projection::orthographic,
                                          .primitive_capacity = scene_.primitives.capacity(),
                                          .row_capacity = scene_.rows.capacity()},
              kernel::kPrimitiveBinding);
  return program;
}

}  // namespace meniscus
