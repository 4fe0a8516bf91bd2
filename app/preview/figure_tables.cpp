// SPDX-License-Identifier: BSD-3-Clause
// Computes surfaces on the CPU, and colours them as the preview does.
#include "app/preview/view_cache.h"
#include "core/base/error.h"
#include "core/queries/surface_parts.h"
#include "core/scene/surface_computer.h"
#include "core/surface/compute_surface.h"
#include "exporters/page/scene_page.h"

namespace meniscus {
namespace {

/// Returns the share of the molecule's depth that planes across the view take away, by the numbers of these planes: the
/// page keeps them there when it is turned.
nlohmann::json depths_of(const FigureRequest& figure) {
  nlohmann::json depths = nlohmann::json::object();
  for (std::size_t n = 0; n < figure.cuts.size() && !figure.hides_surface; ++n) {
    const Cut& cut = figure.cuts[n];
    if (cut.direction == glm::dvec3(0.0) && cut.place == Cut::Place::bound && !cut.keeps_less)
      depths[std::to_string(n)] = cut.bound;
  }
  return depths;
}

/// Ends the computation of a surface that is given up.
struct GivenUp {};

}  // namespace

/// Returns false if the surface was given up.
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
  // The part numbers of a page begin with 0 in each frame. The molecule numbers the parts of all models in one row.
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
