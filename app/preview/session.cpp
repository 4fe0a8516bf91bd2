// SPDX-License-Identifier: BSD-3-Clause
// Frames, colours and pictures of a session.
#include "app/preview/session.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include <fmt/format.h>
#include <glm/common.hpp>

#include "app/preview/camera_motion.h"
#include "app/preview/look_json.h"
#include "core/base/error.h"
#include "core/base/text.h"
#include "core/color/color_atoms.h"
#include "core/color/named_colors.h"
#include "core/scene/copied_atoms.h"
#include "core/scene/hidden_atoms.h"
#include "core/scene/molecule.h"
#include "core/scene/surface_objects.h"

namespace meniscus {

PreviewSession::PreviewSession(std::unique_ptr<ViewRenderer> renderer, Structure structure, PreviewView view,
                               const std::optional<Camera>& camera, std::filesystem::path export_folder,
                               std::optional<TrajectoryPositions> trajectory, SessionContext context)
    : structure_(std::move(structure)),
      frames_(group_atoms(structure_, Grouping::model)),
      trajectory_(std::move(trajectory)),
      view_(std::move(view)),
      export_folder_(std::move(export_folder)),
      context_(std::move(context)),
      coloring_(color_atoms(structure_, view_.color)),
      renderer_(std::move(renderer)) {
  if (view_.copies_apart) require_apart(structure_, view_.probe_reach());
  require_previewed(view_.color);
  if (trajectory_) sample_trajectory();
  show_frame(0);
  if (view_.show) hidden_atoms(*view_.show, marked_ ? *marked_ : structure_);  // that some are shown
  camera ? look_from(*camera) : look_at_all();
  first_color_ = view_.color;
  first_camera_ = view_.camera;
  first_overview_ = view_.overview;
}

void PreviewSession::look_from(const Camera& camera) {
  validate_camera(camera, "the view");
  view_.camera = camera;
  view_.overview = false;
}

void PreviewSession::look_at_all() {
  const std::vector<Ball> all =
      trajectory_ ? grown(sampled_, growth_of(view_.kind, view_.probe_radius)) : balls_in_view();
  look_from(overview(all, aspect(), view_.camera.projection));
  view_.overview = true;
}

void PreviewSession::sample_trajectory() {
  constexpr std::size_t kSamples = 16;  // few enough to begin at once, enough to see where the molecule goes
  const std::size_t count = std::min(kSamples, trajectory_->numbers.size());
  for (std::size_t n = 0; n < count; ++n) {
    const std::size_t frame = count == 1 ? 0 : n * (trajectory_->numbers.size() - 1) / (count - 1);
    try {
      if (trajectory_->structure) {
        const std::vector<Ball> balls = balls_of(trajectory_->structure(frame));
        sampled_.insert(sampled_.end(), balls.begin(), balls.end());
        continue;
      }
      const std::vector<glm::dvec3> positions = trajectory_->positions(frame);
      for (const std::uint32_t a : shown_atoms()) sampled_.push_back({positions[a], structure_.atoms[a].radius});
    } catch (const InputError&) {
      if (n == 0) throw;  // a later one is told when it is shown
    }
  }
}

void PreviewSession::show_frame(std::size_t frame) {
  // Read first: what cannot be read changes nothing.
  std::vector<glm::dvec3> positions;
  std::optional<Structure> other;
  if (trajectory_ && trajectory_->structure)
    other = trajectory_->structure(frame);
  else if (trajectory_)
    positions = trajectory_->positions(frame);
  const auto exchange = [&] {
    if (other) {
      std::swap(structure_, *other);
      frames_ = group_atoms(structure_, Grouping::model);
    }
    for (std::size_t n = 0; n < positions.size(); ++n) std::swap(structure_.atoms[n].position, positions[n]);
  };
  exchange();  // colours and selections may depend on where atoms stand
  Derived made;
  try {
    made = derived(view_, Changed::shapes, frame);
  } catch (...) {
    exchange();
    throw;
  }
  view_.frame = frame;
  coloring_ = std::move(*made.coloring);
  marked_ = std::move(made.marked);
  beside_ = std::move(made.beside);
  if (view_.follows_keys && !view_.keys.empty())
    look_from(CameraPath(camera_keys()).at(static_cast<double>(number_of(frame))));
  place_balls();
  renderer_->set_coloring(frame_coloring());
  renderer_->set_figure(view_.figure, beside_);
  update_legend();
}

void PreviewSession::place_balls() {
  balls_.clear();
  for (const std::uint32_t a : shown_atoms())
    balls_.push_back({structure_.atoms[a].position, structure_.atoms[a].radius});
  balls_ = grown(balls_, growth_of(view_.kind, view_.probe_radius));
  reach_.clear();
  if (!structure_.instances.empty()) reach_ = reaching_balls(balls_, structure_.instances);
  renderer_->set_atoms(balls_);
}

void PreviewSession::require_apart_in(const PreviewFigure& figure) const {
  if (view_.copies_apart && figure.probe_reach() > view_.probe_reach()) require_apart(structure_, figure.probe_reach());
}

PreviewSession::Derived PreviewSession::derived(const PreviewFigure& figure, Changed changed, std::size_t frame) const {
  if (!structure_.instances.empty() && !(figure.figure.plain() && figure.color.opacities.empty()))
    throw RequestError("copies of one surface (--instances) are shown whole and opaque; leave --instances away");
  Derived made{{}, marked_, beside_};
  require_colors_shared(structure_, figure.color);
  if (changed >= Changed::colors) made.coloring = color_atoms(structure_, figure.color);
  if (changed >= Changed::shapes) {
    made.marked.reset();
    if (!figure.figure.representations.empty() || !figure.figure.objects.empty()) {
      if (!context_.read_shown)
        throw RequestError("this molecule cannot be read again, so nothing can be drawn beside its surface");
      made.marked = std::make_shared<const Structure>(context_.read_shown(figure.figure, frame));
      if (made.marked->atoms.size() != frames_[trajectory_ ? 0 : frame].atoms.size())
        throw InputError(structure_.file, 0, "has other atoms than when the preview began; begin it anew");
    }
  }
  if (changed >= Changed::colors) made.beside = beside_of(figure, changed, made.marked.get());
  if (figure.figure.hides_surface && (!made.beside || made.beside->empty()))
    throw RequestError("without the surface nothing would be shown; draw something beside it first");
  return made;
}

std::shared_ptr<const BesideSurface> PreviewSession::beside_of(const PreviewFigure& figure, Changed changed,
                                                               const Structure* marked) const {
  if (!marked) return nullptr;
  const ColorScheme scheme = figure.told_scheme();
  if (changed == Changed::shapes)
    return std::make_shared<const BesideSurface>(make_beside(*marked, figure.figure, scheme));
  auto beside = std::make_shared<BesideSurface>(*beside_);
  color_beside(*marked, figure.figure, scheme, *beside);
  return beside;
}

std::vector<bool> PreviewSession::part_shown(const Selection& show, const Structure* marked) const {
  std::vector<Atom> atoms;
  if (marked) {
    atoms = meniscus::shown_atoms(*marked);
  } else {
    for (const std::uint32_t a : shown_atoms()) atoms.push_back(structure_.atoms[a]);
  }
  std::vector<bool> shown = show.evaluate(atoms);
  shown.resize(shown_atoms().size());
  return shown;
}

std::size_t PreviewSession::count_shown(const PreviewFigure& figure, const Structure* marked) const {
  if (!figure.show) return shown_atoms().size();
  const std::vector<bool> shown = part_shown(*figure.show, marked);
  const auto count = static_cast<std::size_t>(std::ranges::count(shown, true));
  if (count > 0) return count;
  throw RequestError(fmt::format("of the surface of {} nothing would be left; {}", in_quotes(figure.show->text()),
                                 figure.show->why_none(atoms_in_view())));
}

void PreviewSession::become(PreviewFigure next, Changed changed) {
  validate_camera(next.camera, "the view");
  Derived made = derived(next, changed, view_.frame);
  if (changed >= Changed::colors) count_shown(next, made.marked.get());
  const double growth = growth_of(next.kind, next.probe_radius);
  const bool same_balls = growth == growth_of(view_.kind, view_.probe_radius);
  static_cast<PreviewFigure&>(view_) = std::move(next);
  if (!same_balls) place_balls();
  if (made.coloring) coloring_ = std::move(*made.coloring);
  marked_ = std::move(made.marked);
  beside_ = std::move(made.beside);
  if (changed >= Changed::colors) renderer_->set_coloring(frame_coloring());
  if (changed >= Changed::cuts) renderer_->set_figure(view_.figure, beside_);
  update_legend();
  if (changed == Changed::shapes && view_.overview) look_at_all();
}

void PreviewSession::update_legend() {
  legend_.reset();
  legend_fault_.clear();
  const ColorScheme color = view_.told_scheme();
  if (!view_.legend || (color.by == ColorScheme::By::fixed && color.rules.empty())) return;
  const std::string names[] = {"surface"};
  try {
    legend_ = std::make_shared<const LegendStrip>(color_key(structure_, color, names), view_.size, view_.legend_style,
                                                  view_.background);
  } catch (const RequestError& error) {  // no room for it in this size
    legend_fault_ = error.what();
  }
}

std::vector<CameraKey> PreviewSession::camera_keys() const {
  std::vector<CameraKey> keys;
  for (const auto& [frame, camera] : view_.keys) keys.push_back({static_cast<double>(number_of(frame)), camera});
  return keys;
}

std::vector<Atom> PreviewSession::atoms_in_view() const {
  std::vector<Atom> atoms;
  for (const std::uint32_t a : shown_atoms()) atoms.push_back(structure_.atoms[a]);
  if (marked_) atoms.insert(atoms.end(), marked_->beside.begin(), marked_->beside.end());
  return atoms;
}

std::vector<Ball> PreviewSession::balls_in_view() const {
  std::vector<Ball> balls = reach();
  if (!beside_) return balls;
  const std::vector<Ball> beside = beside_->balls();
  balls.insert(balls.end(), beside.begin(), beside.end());
  return balls;
}

Structure PreviewSession::frame_structure() const {
  Structure frame;
  frame.file = structure_.file;
  for (const std::uint32_t a : shown_atoms()) frame.atoms.push_back(structure_.atoms[a]);
  return frame;
}

Coloring PreviewSession::frame_coloring() const {
  Coloring coloring;
  coloring.kind = view_.patch_kinds ? kPatchKindColors : coloring_.kind;
  for (const std::uint32_t a : shown_atoms()) {
    coloring.atom.push_back(coloring_.atom[a]);
    if (!coloring_.part.empty()) coloring.part.push_back(coloring_.part[a]);
    if (!coloring_.opacity.empty()) coloring.opacity.push_back(coloring_.opacity[a]);
  }
  if (view_.show) {
    coloring.hidden = part_shown(*view_.show, marked_.get());
    coloring.hidden.flip();
  }
  return coloring;
}

bool PreviewSession::is_drawn(Quality quality) const {
  return drawn_.revision == revision_ && drawn_.quality == quality;
}

RenderSettings PreviewSession::settings(Quality quality) const {
  RenderSettings settings;
  settings.size = quality == Quality::draft ? glm::max(molecule_size() / 2, glm::ivec2(1)) : molecule_size();
  settings.samples = quality == Quality::full ? view_.samples : 1;
  settings.look = quality == Quality::full ? look() : without_effects(look());
  settings.timing = quality == Quality::draft ? StageTiming::rough : StageTiming::exact;
  return settings;
}

bool PreviewSession::render(Quality quality, const std::function<bool()>& stop) {
  if (is_drawn(quality)) return true;
  drawn_ = {};
  const auto begin = std::chrono::steady_clock::now();
  const double probe_radius = rolling_probe(view_.kind, view_.probe_radius);
  if (!renderer_->draw(probe_radius, view_.camera, settings(quality), stop)) return false;
  if (quality != Quality::draft || stages_.empty()) stages_ = renderer_->times();
  frame_ms_ = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
  drawn_legend_ = legend_;
  drawn_ = {revision_, quality};
  return true;
}

std::vector<std::uint8_t> PreviewSession::rgba() const {
  std::vector<std::uint8_t> molecule = renderer_->rgba();
  return drawn_legend_ ? drawn_legend_->around(molecule, renderer_->size()) : molecule;
}

glm::ivec2 PreviewSession::picture_size() const {
  return drawn_legend_ ? drawn_legend_->whole_size(renderer_->size()) : renderer_->size();
}

}  // namespace meniscus
