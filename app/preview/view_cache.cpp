// SPDX-License-Identifier: BSD-3-Clause
// Draws missing pictures, computes exposed areas on a thread, and computes coloured surfaces on the CPU for pages.
#include "app/preview/view_cache.h"

#include "core/base/error.h"
#include "core/queries/surface_parts.h"
#include "core/reduced_surface/reduced_surface.h"
#include "core/scene/surface_computer.h"
#include "core/surface/compute_surface.h"
#include "exporters/page/scene_page.h"

namespace meniscus {
namespace {

constexpr std::size_t kKept = 16;  // frames and probes

std::future<std::vector<double>> begin_areas(const AtomsInView& atoms) {
  if (atoms.surface)
    return std::async(std::launch::async, [surface = atoms.surface] { return atom_areas(*surface).surface; });
  return std::async(std::launch::async, [balls = atoms.balls, radius = rolling_probe(atoms.kind, atoms.probe_radius)] {
    return atom_areas(compute_surface_cpu(balls, radius)).surface;
  });
}

}  // namespace

std::optional<double> ExposedAreas::of(const AtomsInView& atoms, std::size_t atom, bool wait, bool wanted) {
  const Key key{atoms.frame, atoms.group, atoms.kind, atoms.probe_radius};
  const bool begun = pending_.valid() && pending_key_ == key;
  if (!wanted && !atoms.surface && !begun && !known_.contains(key)) return {};
  wait = wait && wanted;
  if (pending_.valid() && (wait || pending_.wait_for(std::chrono::seconds(0)) == std::future_status::ready)) {
    try {
      keep();
    } catch (const Error&) {
      if (pending_key_ == key) throw;  // the error of another surface is no longer of interest
    }
  }
  if (!known_.contains(key) && !pending_.valid()) {
    pending_key_ = key;
    pending_ = begin_areas(atoms);
    if (wait) keep();
  }
  const auto found = known_.find(key);
  if (found == known_.end()) return {};
  return found->second[atom];
}

void ExposedAreas::keep() {
  known_.insert_or_assign(pending_key_, pending_.get());
  order_.push_back(pending_key_);
  if (order_.size() <= kKept) return;
  known_.erase(order_.front());
  order_.erase(order_.begin());
}

void ViewCache::take(const PreviewState& state, const ShownMolecule& molecule, Renewal renewal, bool moves) {
  if (moves) renderer_->set_atoms(molecule.balls());
  if (renewal >= Renewal::colors) {
    Coloring coloring = molecule.coloring(state);
    coloring.in_patch = molecule.patch_marks(state);
    renderer_->set_coloring(std::move(coloring));
  }
  if (renewal >= Renewal::cuts) renderer_->set_figure(state.figure, molecule.extras());
}

namespace {

/// Returns a picture of the balls in their colours, darker where they turn away from the viewer; rows from the top.
std::vector<std::uint8_t> draw_balls(std::span<const Ball> balls, const Coloring& coloring, const Camera& camera,
                                     glm::ivec2 size, const glm::vec3& background) {
  const std::size_t pixels = static_cast<std::size_t>(size.x) * size.y;
  std::vector<std::uint8_t> rgba;
  for (std::size_t p = 0; p < pixels; ++p)
    for (const float channel : {background.x, background.y, background.z, 1.0f})
      rgba.push_back(static_cast<std::uint8_t>(std::lround(255.0f * channel)));
  std::vector<float> nearest(pixels, std::numeric_limits<float>::max());
  const ViewBasis view = view_basis(camera);
  const bool flat = camera.projection == Projection::orthographic;
  const double half_height = half_extent(camera, static_cast<double>(size.x) / size.y).y;
  for (std::size_t a = 0; a < balls.size(); ++a) {
    const glm::dvec3 from_eye = balls[a].center - camera.position;
    const double depth = glm::dot(from_eye, view.forward);
    if (depth <= balls[a].radius || !coloring.shows(static_cast<std::uint32_t>(a))) continue;
    const double scale = 0.5 * size.y / (flat ? half_height : half_height * depth);  // pixels per Å
    const double radius = scale * balls[a].radius;
    const double x = 0.5 * size.x + scale * glm::dot(from_eye, view.right);
    const double y = 0.5 * size.y - scale * glm::dot(from_eye, view.up);
    const auto within = [](double value, int end) { return static_cast<int>(std::clamp<double>(value, 0.0, end)); };
    const glm::vec3 color = 255.0f * coloring.atom[a];
    for (int row = within(std::ceil(y - radius - 0.5), size.y), end = within(y + radius + 0.5, size.y); row < end;
         ++row)
      for (int column = within(std::ceil(x - radius - 0.5), size.x), last = within(x + radius + 0.5, size.x);
           column < last; ++column) {
        const double dx = (column + 0.5 - x) / radius, dy = (row + 0.5 - y) / radius, rest = 1.0 - dx * dx - dy * dy;
        if (rest < 0.0) continue;
        const double front = std::sqrt(rest);
        const auto distance = static_cast<float>(depth - front * balls[a].radius);
        const std::size_t pixel = static_cast<std::size_t>(row) * size.x + column;
        if (distance >= nearest[pixel]) continue;
        nearest[pixel] = distance;
        const float light = 0.35f + 0.65f * static_cast<float>(front);
        for (int c = 0; c < 3; ++c) rgba[4 * pixel + c] = static_cast<std::uint8_t>(light * color[c]);
      }
  }
  return rgba;
}

/// Returns a look without the effects that take time.
Look without_effects(Look look) {
  look.ambient_occlusion = look.shadows = look.silhouettes = look.patch_lines = 0.0f;
  look.outer_lines = look.inner_lines = look.part_lines = {};
  return look;
}

}  // namespace

bool ViewCache::wants_balls(const PreviewState& state, const ShownMolecule& molecule) const {
  constexpr std::size_t kMany = 20'000;  // the surface of so many atoms takes more than half a second
  return !has_surface_ && renderer_->draws_on_cpu() && !state.figure.hides_surface && molecule.balls().size() > kMany &&
         molecule.structure().instances.empty();
}

bool ViewCache::draw(const PreviewState& state, const ShownMolecule& molecule, Quality quality,
                     const std::function<bool()>& stop) {
  if (is_drawn(state, quality)) return true;
  drawn_.revision = 0;
  const auto begin = std::chrono::steady_clock::now();
  const glm::ivec2 size = molecule.picture_size(state);
  const auto end = [&] {
    milliseconds_ = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
    drawn_ = {state.revision, quality, molecule.legend()};
    return true;
  };
  if (quality == Quality::balls) {
    balls_ = {size,
              draw_balls(molecule.balls(), molecule.coloring(state), state.camera, size, state.shown_background())};
    return end();
  }
  RenderSettings settings;
  settings.size = quality == Quality::draft ? glm::max(size / 2, glm::ivec2(1)) : size;
  settings.samples = quality == Quality::full ? state.image.samples : 1;
  settings.look = quality == Quality::full ? state.full_look() : without_effects(state.full_look());
  settings.timing = quality == Quality::draft ? StageTiming::rough : StageTiming::exact;
  if (!renderer_->draw(state.rolling_radius(), state.camera, settings, stop)) return false;
  if (quality != Quality::draft || stages_.empty()) stages_ = renderer_->times();
  has_surface_ = true;
  balls_ = {};
  return end();
}

std::vector<std::uint8_t> ViewCache::rgba() const {
  std::vector<std::uint8_t> molecule = shows_balls() ? balls_.rgba : renderer_->rgba();
  return drawn_.legend ? drawn_.legend->around(molecule, molecule_size()) : molecule;
}

glm::ivec2 ViewCache::size() const {
  return drawn_.legend ? drawn_.legend->whole_size(molecule_size()) : molecule_size();
}

std::optional<PickedPoint> ViewCache::pick(const PreviewState& state, const ShownMolecule& molecule, glm::ivec2 pixel) {
  if (drawn_.revision != state.revision || drawn_.quality <= Quality::draft) draw(state, molecule, Quality::plain);
  const glm::ivec2 shown = renderer_->size();
  return pixel.x < shown.x && pixel.y < shown.y ? renderer_->pick(pixel) : std::nullopt;
}

std::optional<double> ViewCache::exposed_area(const PreviewState& state, const ShownMolecule& molecule,
                                              std::uint32_t atom, bool wait, bool wanted) {
  const std::vector<Instances>& copies = molecule.structure().instances;
  if (copies.empty())
    return areas_.of({state.frame, 0, state.molecule.surface.kind, state.molecule.surface.probe_radius,
                      molecule.balls(), renderer_->surface()},
                     atom, wait, wanted);
  // An atom of a copy has the area that it has in its group alone.
  std::size_t group = 0;
  while (!std::ranges::binary_search(copies[group].atoms, atom)) ++group;
  const std::vector<std::uint32_t>& atoms = copies[group].atoms;
  std::vector<Ball> balls;
  balls.reserve(atoms.size());
  for (const std::uint32_t a : atoms) balls.push_back(molecule.balls()[a]);
  const auto place = static_cast<std::size_t>(std::ranges::lower_bound(atoms, atom) - atoms.begin());
  return areas_.of(
      {state.frame, group, state.molecule.surface.kind, state.molecule.surface.probe_radius, balls, nullptr}, place,
      wait, wanted);
}

namespace {

/// Returns the share of the molecule's depth that each plane across the view takes away, by the planes' indices; the
/// page keeps these shares when the view turns.
nlohmann::json depths_of(const FigureRequest& figure) {
  nlohmann::json depths = nlohmann::json::object();
  for (std::size_t n = 0; n < figure.cuts.size() && !figure.hides_surface; ++n) {
    const Cut& cut = figure.cuts[n];
    if (cut.direction == glm::dvec3(0.0) && cut.place == Cut::Place::bound && !cut.keeps_less)
      depths[std::to_string(n)] = cut.bound;
  }
  return depths;
}

/// An exception that ends the computation of a surface that is given up.
struct GivenUp {};

}  // namespace

/// Computes the surface; returns false if it was given up.
bool FigureTables::compute(const PreviewState& state, const ShownMolecule& molecule,
                           const std::function<bool()>& stop) {
  const double probe = state.rolling_radius();
  const auto is_same = [](const Ball& a, const Ball& b) { return a.center == b.center && a.radius == b.radius; };
  if (object_.surface.probe_radius == probe && std::ranges::equal(balls_, molecule.balls(), is_same)) return true;
  balls_.clear();
  object_ = {};
  SurfaceRequest request;
  request.probe_radius = probe;  // the balls are grown already
  request.cpu = true;
  SurfaceComputer computer(request);
  computer.before_stages([&stop] {
    if (stop && stop()) throw GivenUp();
  });
  try {
    object_.surface = computer.compute(molecule.balls());
  } catch (const GivenUp&) {
    return false;
  }
  require_closed(object_.surface);
  object_.atom.resize(object_.surface.atoms.size());
  std::iota(object_.atom.begin(), object_.atom.end(), 0u);
  balls_ = molecule.balls();
  return true;
}

void FigureTables::color(const Structure& structure, const PreviewState& state, const ShownMolecule& molecule) {
  Coloring& coloring = object_.coloring = molecule.coloring(state);
  // The molecule numbers the parts of all models in one series; a page numbers them from 0 in each frame.
  const std::uint32_t first_part = coloring.part.empty() ? 0 : *std::ranges::min_element(coloring.part);
  for (std::uint32_t& part : coloring.part) part -= first_part;
  const MoleculeRequest& request = state.molecule;
  if (request.patches)
    coloring.in_patch = atoms_of_patches(object_.surface, request.patches->evaluate(structure), request.least_patch);
}

std::shared_ptr<const page::PackedFrame> FigureTables::packed(const PreviewState& state, const ShownMolecule& molecule,
                                                              const std::function<bool()>& stop) {
  constexpr std::size_t kMostAtoms = 200'000;  // their tables take about 150 MB
  if (!molecule.structure().instances.empty())
    throw RequestError("The browser cannot turn copies of one surface by itself; the program draws its pictures.");
  if (molecule.balls().size() > kMostAtoms)
    throw RequestError("This molecule is too large for the browser to turn by itself; the program draws its pictures.");
  try {
    const Scene scene = rendered_scene(state, {state.size, state.image.samples});
    page::check_scene(scene);
    if (!compute(state, molecule, stop) || (stop && stop())) return nullptr;
    Figure figure;
    figure.molecule.structure = molecule.annotated_structure();
    figure.molecule.color = state.molecule.color;
    if (molecule.extras()) figure.extras = *molecule.extras();
    color(figure.molecule.structure, state, molecule);
    const page::SceneFrame frame{state.camera, {}, molecule.key(state), {}, {}};
    page::PackedFrame made = page::scene_frame(scene, figure, object_, frame, {}, page::Packing::plain);
    (*made.description)["depths"] = depths_of(state.figure);
    return std::make_shared<const page::PackedFrame>(std::move(made));
  } catch (const RequestError&) {
    throw RequestError("The browser cannot turn this figure by itself; the program draws its pictures.");
  }
}

}  // namespace meniscus
