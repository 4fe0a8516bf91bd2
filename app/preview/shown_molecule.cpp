// SPDX-License-Identifier: BSD-3-Clause
// Computes the parts of the molecule that another state changes, and draws the legend around the molecule's picture.
#include "app/preview/shown_molecule.h"

#include "core/queries/copies.h"
#include "core/queries/surface_parts.h"
#include "core/reduced_surface/reduced_surface.h"
#include "core/surface/compute_surface.h"

namespace meniscus {

LegendStrip::LegendStrip(const ColorKey& key, glm::ivec2 size, const LegendStyle& style, const glm::vec3& background)
    : size_(size) {
  const Legend legend(key, size, style);
  molecule_size_ = legend.molecule_size();
  Framebuffer nothing;
  nothing.size = molecule_size_;
  nothing.color.assign(static_cast<std::size_t>(molecule_size_.x) * molecule_size_.y, glm::vec4(0.0f));
  const Framebuffer whole = legend.add_to(nothing, background);
  picture_.resize(4 * whole.color.size());
  display_bytes(whole.color, background, 4, picture_.data());
}

glm::ivec2 LegendStrip::whole_size(glm::ivec2 size) const {
  return size == molecule_size_ ? size_ : glm::max(size_ / 2, glm::ivec2(1));
}

std::vector<std::uint8_t> LegendStrip::around(std::span<const std::uint8_t> molecule, glm::ivec2 size) const {
  const glm::ivec2 whole = whole_size(size);
  const int step = whole == size_ ? 1 : 2;
  std::vector<std::uint8_t> picture(static_cast<std::size_t>(4) * whole.x * whole.y);
  for (int y = 0; y < whole.y; ++y) {
    for (int x = 0; x < whole.x; ++x) {
      std::uint8_t* const to = &picture[4 * (static_cast<std::size_t>(y) * whole.x + x)];
      if (x < size.x && y < size.y) {
        std::copy_n(&molecule[4 * (static_cast<std::size_t>(y) * size.x + x)], 4, to);
        continue;
      }
      for (std::size_t c = 0; c < 4; ++c) {
        int sum = 0;
        for (int n = 0; n < step * step; ++n)
          sum += picture_[4 * (static_cast<std::size_t>(step * y + n / step) * size_.x + step * x + n % step) + c];
        to[c] = static_cast<std::uint8_t>((sum + step * step / 2) / (step * step));
      }
    }
  }
  return picture;
}

namespace {

/// Returns the balls of frames all over a trajectory, or of the farthest copies. atoms: into structure.atoms.
std::vector<Ball> sampled_balls(const TrajectoryPositions& trajectory, const Structure& structure,
                                const std::vector<std::uint32_t>& atoms) {
  constexpr std::size_t kSamples = 16;  // few enough to begin at once, enough to see where the molecule goes
  const std::size_t frames = trajectory.numbers.size(), count = std::min(kSamples, frames);
  std::vector<Ball> sampled;
  for (std::size_t n = 0; n < count; ++n) {
    const std::size_t frame = count == 1 ? 0 : n * (frames - 1) / (count - 1);
    try {
      if (trajectory.structure) {
        const std::vector<Ball> balls = balls_of(trajectory.structure(frame));
        sampled.insert(sampled.end(), balls.begin(), balls.end());
        continue;
      }
      const std::vector<glm::dvec3> positions = trajectory.positions(frame);
      std::vector<Ball> balls;
      for (const std::uint32_t a : atoms) balls.push_back({positions[a], structure.atoms[a].radius});
      if (!structure.instances.empty()) balls = reaching_balls(balls, structure.instances);
      sampled.insert(sampled.end(), balls.begin(), balls.end());
    } catch (const InputError&) {
      if (n == 0) throw;  // an error of a later frame is reported when it is shown
    }
  }
  return sampled;
}

/// Returns the objects next to the surface. before: the objects so far; only_colors changes nothing but their colours.
std::shared_ptr<const FigureExtras> extras_of(const Structure& marked, const PreviewFigure& figure, bool only_colors,
                                              const std::shared_ptr<const FigureExtras>& before) {
  const ColorScheme& scheme = figure.molecule.color;
  if (!only_colors) return std::make_shared<const FigureExtras>(make_extras(marked, figure.figure, scheme));
  auto extras = std::make_shared<FigureExtras>(*before);
  color_extras(marked, figure.figure, scheme, *extras);
  return extras;
}

/// Returns the models that are shown one after another; the atoms of several files are shown together.
std::vector<AtomGroup> models_of(const Structure& structure) {
  if (structure.added.empty()) return group_atoms(structure, Grouping::model);
  AtomGroup all;
  all.atoms.resize(structure.atoms.size());
  std::iota(all.atoms.begin(), all.atoms.end(), 0u);
  return {all};
}

/// Returns the balls that the figure shows: of all copies, which selections of atoms never cut, or of the shown atoms.
std::vector<Ball> balls_shown(const ShownMolecule& molecule, const PreviewFigure& figure) {
  const std::vector<Ball>& balls = molecule.balls();
  return molecule.structure().instances.empty() ? shown_balls(balls, molecule.coloring(figure)) : balls;
}

std::size_t count_of(const std::vector<bool>& shown, const PreviewFigure& figure, const ShownMolecule& molecule) {
  const auto count = static_cast<std::size_t>(std::ranges::count(shown, true));
  if (count > 0) return count;
  throw RequestError("nothing would be left of the surface of {}; {}", in_quotes(figure.molecule.show->text()),
                     figure.molecule.show->why_none(molecule.atoms_in_view()));
}

}  // namespace

ShownMolecule::ShownMolecule(Structure structure, std::optional<TrajectoryPositions> trajectory, ReadShown read_shown,
                             const PreviewState& state)
    : structure_(std::move(structure)),
      models_(models_of(structure_)),
      trajectory_(std::move(trajectory)),
      read_shown_(std::move(read_shown)) {
  if (state.copies_apart) require_apart(structure_, state.probe_reach());
  if (trajectory_) sampled_ = sampled_balls(*trajectory_, structure_, atoms());
  become(state, Renewal::frame);
  // This throws if the selection shows no atoms.
  if (state.molecule.show) hidden_atoms(*state.molecule.show, marked_ ? *marked_ : structure_);
}

bool ShownMolecule::become(const PreviewState& state, Renewal renewal) {
  Made next = renewal == Renewal::frame ? made_at(state) : made(state, renewal, frame_);
  if (next.coloring) coloring_ = std::move(*next.coloring);
  marked_ = std::move(next.marked);
  extras_ = std::move(next.extras);
  const bool moves = renewal == Renewal::frame || growth_ != state.growth();
  if (moves) place_balls(state);
  if (renewal >= Renewal::legend) lay_out_legend(state);
  return moves;
}

ShownMolecule::Made ShownMolecule::made_at(const PreviewState& state) {
  // Frames are read first: one that cannot be read changes nothing.
  std::vector<glm::dvec3> positions;
  std::optional<Structure> other;
  if (trajectory_ && trajectory_->structure)
    other = trajectory_->structure(state.frame);
  else if (trajectory_)
    positions = trajectory_->positions(state.frame);
  std::size_t frame = state.frame;
  std::optional<std::uint64_t> number;  // number of the frame by which a file may list its numbers
  if (trajectory_) number = number_of(state.frame);
  if (other) other->frame = number;
  const auto exchange = [&] {
    if (other) {
      std::swap(structure_, *other);
      models_ = models_of(structure_);
    } else {
      std::swap(structure_.frame, number);
    }
    for (std::size_t n = 0; n < positions.size(); ++n) std::swap(structure_.atoms[n].position, positions[n]);
    std::swap(frame_, frame);
  };
  exchange();
  try {
    if (state.copies_apart && trajectory_) require_apart(structure_, state.probe_reach());
    return made(state, Renewal::frame, state.frame);
  } catch (...) {
    exchange();
    throw;
  }
}

ShownMolecule::Made ShownMolecule::made(const PreviewFigure& figure, Renewal renewal, std::size_t frame) const {
  Made made{{}, marked_, extras_};
  if (renewal < Renewal::legend) return made;
  if (!structure_.instances.empty() && !(figure.figure.plain() && figure.molecule.color.opacities.empty()))
    throw RequestError("copies of one surface (--instances) are shown whole and opaque; leave --instances out");
  require_colors_shared(structure_, figure.molecule.color);
  if (renewal >= Renewal::shapes) {
    made.marked.reset();
    const bool has_companions =
        structure_.companions != Companions::none && read_shown_ && structure_.file != "standard input";
    if (!figure.figure.representations.empty() || !figure.figure.objects.empty() || has_companions) {
      if (!read_shown_)
        throw RequestError("this molecule cannot be read again, so nothing can be drawn in addition to its surface");
      Structure marked = read_shown_(figure.figure, frame);
      marked.frame = structure_.frame;
      made.marked = std::make_shared<const Structure>(std::move(marked));
      if (made.marked->atoms.size() != atoms().size())
        throw InputError(structure_.file, 0, "has other atoms than when the preview began; start the preview again");
    }
  }
  // Rules such as "within 4 of ligand" see the atoms next to the surface, unless the file has several models.
  const bool is_whole = made.marked && made.marked->atoms.size() == structure_.atoms.size();
  if (renewal >= Renewal::colors)
    made.coloring = color_atoms(is_whole ? *made.marked : structure_, figure.molecule.color);
  if (!made.marked)
    made.extras.reset();
  else if (renewal >= Renewal::colors)
    made.extras = extras_of(*made.marked, figure, renewal == Renewal::colors, extras_);
  if (uses_atoms(figure.figure.cuts)) {
    FigureExtras extras = made.extras ? *made.extras : FigureExtras{};
    extras.cut_atoms = cut_atoms(figure.figure.cuts, made.marked ? *made.marked : frame_structure());
    made.extras = std::make_shared<const FigureExtras>(std::move(extras));
  }
  if (figure.figure.hides_surface && (!made.extras || made.extras->empty()))
    throw RequestError("without the surface nothing would be shown; draw something else first");
  if (renewal == Renewal::colors || renewal == Renewal::shapes)
    count_of(part_shown(figure, made.marked.get()), figure, *this);
  return made;
}

/// Returns which atoms of the surface the figure shows. marked: atoms on which that may depend; nullptr: the frame's.
std::vector<bool> ShownMolecule::part_shown(const PreviewFigure& figure, const Structure* marked) const {
  if (!figure.molecule.show) return std::vector<bool>(atoms().size(), true);
  std::vector<bool> shown = figure.molecule.show->evaluate(marked ? shown_atoms(*marked) : frame_structure().atoms);
  shown.resize(atoms().size());
  return shown;
}

std::size_t ShownMolecule::count_shown(const PreviewFigure& figure) const {
  return count_of(part_shown(figure, marked_.get()), figure, *this);
}

void ShownMolecule::place_balls(const PreviewFigure& figure) {
  growth_ = figure.growth();
  balls_.clear();
  for (const std::uint32_t a : atoms()) balls_.push_back({structure_.atoms[a].position, structure_.atoms[a].radius});
  balls_ = grown(balls_, growth_);
  framing_balls_.clear();
  if (!structure_.instances.empty()) framing_balls_ = reaching_balls(balls_, structure_.instances);
}

ColorKey ShownMolecule::key(const PreviewFigure& figure) const {
  const Structure& structure = marked_ ? *marked_ : structure_;
  DrawnAtoms drawn{std::vector<bool>(structure.atoms.size(), true), {{"surface", atoms()}}};
  const std::vector<bool> shown = part_shown(figure, marked_.get());
  for (std::size_t n = 0; n < shown.size(); ++n)
    if (!shown[n]) drawn.atoms[marked_ ? n : atoms()[n]] = false;
  return figure_key(structure, figure.molecule.color, std::move(drawn), figure.figure,
                    extras_ ? *extras_ : FigureExtras());
}

void ShownMolecule::lay_out_legend(const PreviewState& state) {
  legend_.reset();
  legend_fault_.clear();
  if (!state.legend.within) return;
  const ColorKey colors = key(state);
  if (colors.empty()) return;
  try {
    legend_ = std::make_shared<const LegendStrip>(
        colors, state.size, legend_style(state.legend.style, state.annotations.letters), state.shown_background());
  } catch (const RequestError& error) {  // the size has no room for the legend
    legend_fault_ = error.what();
  }
}

Coloring ShownMolecule::coloring(const PreviewFigure& figure) const {
  Coloring coloring = coloring_of(coloring_, atoms());
  if (figure.molecule.show) {
    coloring.hidden = part_shown(figure, marked_.get());
    coloring.hidden.flip();
  }
  return coloring;
}

std::vector<bool> ShownMolecule::patch_marks(const PreviewFigure& figure) const {
  if (!figure.molecule.patches) return {};
  std::vector<bool> marks = figure.molecule.patches->evaluate(annotated_structure());
  if (figure.molecule.least_patch <= 0.0 || std::ranges::find(marks, true) == marks.end()) return marks;
  std::vector<AtomGroup> groups(1);  // groups that have a surface each: all atoms, or the atoms of each group of copies
  for (std::uint32_t a = 0; a < balls_.size(); ++a) groups[0].atoms.push_back(a);
  if (!structure_.instances.empty()) groups.clear();
  for (const Instances& group : structure_.instances) groups.push_back({{}, group.atoms});
  for (const AtomGroup& group : groups) {
    std::vector<Ball> balls;
    std::vector<bool> chosen;
    for (const std::uint32_t a : group.atoms) {
      balls.push_back(balls_[a]);
      chosen.push_back(marks[a]);
    }
    const Surface surface = compute_surface_cpu(balls, figure.rolling_radius());
    chosen = atoms_of_patches(surface, std::move(chosen), figure.molecule.least_patch);
    for (std::size_t n = 0; n < group.atoms.size(); ++n) marks[group.atoms[n]] = chosen[n];
  }
  return marks;
}

Structure ShownMolecule::frame_structure() const {
  Structure frame;
  frame.file = structure_.file;
  frame.frame = structure_.frame;
  frame.chains = structure_.chains;
  for (const std::uint32_t a : atoms()) frame.atoms.push_back(structure_.atoms[a]);
  return frame;
}

const Atom& ShownMolecule::atom_in_view(std::uint32_t atom) const {
  const std::size_t own = atoms().size();
  return atom < own ? structure_.atoms[atoms()[atom]] : marked_->extra_atoms.at(atom - own);
}

std::vector<Atom> ShownMolecule::atoms_in_view() const {
  std::vector<Atom> atoms = frame_structure().atoms;
  if (marked_) atoms.insert(atoms.end(), marked_->extra_atoms.begin(), marked_->extra_atoms.end());
  return atoms;
}

double ShownMolecule::aspect(const PreviewState& state) const {
  const glm::ivec2 size = picture_size(state);
  return static_cast<double>(size.x) / size.y;
}

Camera ShownMolecule::overview(const PreviewState& state) const {
  const std::vector<Ball> own = trajectory_ ? grown(sampled_, state.growth()) : framing_balls();
  const Camera camera = meniscus::overview(own, aspect(state), state.camera.projection);
  if (trajectory_ || !extras_) return camera;
  const std::vector<Ball> all = balls_in_view(*this);
  return zoomed_to(camera, all, all, aspect(state));
}

std::vector<ClipPlane> ShownMolecule::planes(const PreviewFigure& figure) const {
  const std::vector<Cut>& cuts = figure.figure.cuts;
  if (figure.figure.hides_surface || cuts.empty()) return {};
  const CutAtoms atoms = cut_atoms(cuts, marked_ ? *marked_ : frame_structure());
  return clip_planes(cuts, atoms, {figure.camera, framing_balls(), balls_shown(*this, figure)});
}

std::vector<std::string> ShownMolecule::ineffective_among(std::span<const Cut> cuts,
                                                          const PreviewFigure& figure) const {
  if (figure.figure.hides_surface) return {};
  const std::vector<Ball> shown = balls_shown(*this, figure);
  const CutAtoms atoms = cut_atoms(cuts, marked_ ? *marked_ : frame_structure());
  return ineffective_cuts(cuts, atoms, {figure.camera, framing_balls(), shown}, framing_balls());
}

std::vector<CameraKey> camera_keys(const ShownMolecule& molecule, const PreviewState& state) {
  std::vector<CameraKey> keys;
  for (const auto& [frame, camera] : state.keys)
    keys.push_back({static_cast<double>(molecule.number_of(frame)), camera});
  return keys;
}

std::vector<Ball> balls_in_view(const ShownMolecule& molecule) {
  std::vector<Ball> balls = molecule.framing_balls();
  if (!molecule.extras()) return balls;
  const std::vector<Ball> extras = molecule.extras()->balls();
  balls.insert(balls.end(), extras.begin(), extras.end());
  return balls;
}

void require_copies_apart(const Structure& structure, const PreviewState& state, double reach) {
  if (state.copies_apart && state.probe_reach() > reach) require_apart(structure, state.probe_reach());
}

}  // namespace meniscus
