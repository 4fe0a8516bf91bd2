// SPDX-License-Identifier: BSD-3-Clause
// Says in words and colours what a page shows beside the patches, and draws its still picture.
#include "exporters/page/scene_page.h"

#include <algorithm>
#include <numeric>
#include <span>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/system_file.h"
#include "core/base/text.h"
#include "core/color/color_atoms.h"
#include "core/image/color_space.h"
#include "core/image/png_file.h"
#include "core/queries/copies.h"
#include "core/render/surface_renderer.h"
#include "core/scene/annotations.h"
#include "core/scene/cut.h"
#include "core/scene/representations.h"
#include "core/scene/scene_picture.h"

namespace meniscus::page {
namespace {

/// The picture that readers see whose browser cannot draw the figure: of at most 720 pixels.
Framebuffer small_picture(std::span<const PictureObject> objects, const Camera& camera, glm::ivec2 size,
                          const Look& look) {
  constexpr int kSide = 720, kSamples = 9;
  const double share = std::min(1.0, static_cast<double>(kSide) / std::max(size.x, size.y));
  RenderSettings settings;
  settings.size = glm::max(glm::ivec2(glm::dvec2(size) * share), glm::ivec2(1));
  settings.samples = kSamples;
  settings.look = look;
  return make_cpu_renderer()->render(objects, camera, settings);
}

const char* words_of(SurfaceKind kind) {
  return kind == SurfaceKind::ses   ? "solvent-excluded"
         : kind == SurfaceKind::sas ? "solvent-accessible"
                                    : "van der Waals";
}

std::string description_of(const Molecule& molecule, const Scene& scene, std::string_view name) {
  const std::string atoms = with_thousands(molecule.structure.atoms.size());
  if (scene.figure.hides_surface) return fmt::format("{}: {} atoms", name, atoms);
  const std::string title = key_of(molecule).title;
  return fmt::format("The {} surface of {}, {} atoms, coloured by {}", words_of(scene.molecule.surface.kind), name,
                     atoms, title.empty() ? "one colour" : title);
}

std::pair<std::string, std::string> patches_fact(const Surface& surface) {
  return {"Patches", fmt::format("{} convex, {} toroidal, {} concave", with_thousands(surface.convex.size()),
                                 with_thousands(surface.toroidal.size()), with_thousands(surface.concave.size()))};
}

std::vector<std::pair<std::string, std::string>> facts_of(const Molecule& molecule, const SurfaceObject& surface,
                                                          const Scene& scene) {
  std::vector<std::pair<std::string, std::string>> facts{{"Atoms", molecule.structure.report.sentence()}};
  if (scene.figure.hides_surface) return facts;
  if (scene.molecule.surface.kind == SurfaceKind::ses)
    facts.emplace_back("Probe", fmt::format("{:g} Å", surface.surface.probe_radius));
  facts.push_back(patches_fact(surface.surface));
  facts.emplace_back("Radii", molecule.structure.radii_set);
  return facts;
}

/// Colours of one frame. Where it has none of this scheme its points have those that they have already.
PageScheme scheme_at(const OtherColors& other, const Structure& structure, const SurfaceObject* surface,
                     const ColoredShapes* shapes, const Representations& representations) {
  PageScheme made{other.name, other.key, {}, {}};
  const auto add = [&](const Coloring& coloring) {
    made.colors.insert(made.colors.end(), coloring.atom.begin(), coloring.atom.end());
  };
  try {
    if (surface) {
      const Coloring coloring = color_object(structure, surface->atom, other.scheme, 0);
      add(coloring);
      made.kind = coloring.kind;
    }
    add(shown_shapes(structure, representations, other.scheme).coloring);
  } catch (const InputError&) {
    made.colors.clear();
    if (surface) add(surface->coloring);
    if (shapes) add(shapes->coloring);
  }
  return made;
}

}  // namespace

StillPicture png_still(const Framebuffer& drawn, const Look& look) {
  constexpr std::size_t kChannels = 3;
  std::vector<std::uint8_t> pixels(kChannels * drawn.color.size());
  display_bytes(drawn.color, look.background, kChannels, pixels.data());
  ImageToEncode image;
  image.width = drawn.size.x;
  image.height = drawn.size.y;
  image.channels = {"R", "G", "B"};
  return {"image/png", encode_png(image, pixels, kChannels)};
}

void check_scene(const Scene& scene) {
  const auto refuse = [](const std::string& option, const char* why) {
    throw RequestError(fmt::format("{}: pages do not show {} yet; leave it out, or use render", option, why));
  };
  if (!scene.figure.objects.empty()) refuse(option_name("object"), "objects with looks of their own");
  if (scene.figure.cuts.size() > kMostPlanes)
    throw RequestError(fmt::format("{}: pages show at most {} planes, and there are {}; leave some out",
                                   option_name("clip"), kMostPlanes, scene.figure.cuts.size()));
}

std::vector<OtherColors> other_colors(const Structure& structure, const ColorScheme& asked,
                                      const std::function<void(ColorScheme&)>& measure) {
  std::vector<OtherColors> others;
  for (const char* const word :
       {"element", "chain", "residue", "secondary", "kind", "hydrophobicity", "bfactor", "charge", "rainbow"}) {
    ColorScheme scheme = parse_color_scheme(word).value();
    if (scheme.by == asked.by && asked.rules.empty()) continue;
    try {
      if (measure) measure(scheme);
      ColorKey key = color_key(structure, scheme, {});
      color_atoms(structure, scheme);
      others.push_back({word, std::move(scheme), std::move(key)});
    } catch (const InputError&) {
      // This molecule has no such numbers.
    }
  }
  return others;
}

PackedFrame scene_frame(const Scene& scene, Figure figure, const SceneFrame& frame, const EncodeStill& encode) {
  const std::string name = text_of_path(path_of_text(scene.molecule.file).filename());
  const std::vector<Atom> atoms = shown_atoms(figure.molecule.structure);
  PageFigure shown;
  shown.title = name;
  shown.description = description_of(figure.molecule, scene, name);
  shown.key = frame.key;
  shown.camera = frame.camera;
  shown.moment = frame.moment;
  shown.origin = frame.origin;
  shown.size = scene.picture.size();
  shown.look = look_of(scene.look, shown.size, scene.image.background,
                       hues_of(scene.molecule.color, scene.legend.asked(), uses_atoms(scene.figure.cuts)),
                       scene.molecule.patches.has_value());
  shown.views = frame.views;
  shown.fades_always = scene.look.depth_cue.has_value();
  const std::vector<Ball> balls = placed_balls(figure.molecule.objects);
  const SurfaceObject surface = merged(std::exchange(figure.molecule.objects, {}));
  shown.facts = facts_of(figure.molecule, surface, scene);
  shown.facts.insert(shown.facts.end(), frame.facts.begin(), frame.facts.end());
  const std::vector<PictureObject> objects =
      picture_objects(surface.surface, surface.coloring, scene.figure, &figure.beside, frame.camera, balls);
  for (const PictureObject& object : objects) {
    if (object.shapes) shown.shapes = &figure.beside.shapes;
    if (!object.surface) continue;
    shown.surface = &surface;
    shown.clip = object.clip;
    shown.cap = object.cap;
    shown.thickens = object.thickens;
  }
  const Annotations annotations = annotations_of(scene.annotations, figure.molecule.structure);
  shown.labels = annotations.labels;
  shown.atoms = atoms;
  shown.scheme = scheme_word(figure.molecule.color);
  for (const OtherColors& other : frame.others)
    shown.more_schemes.push_back(scheme_at(other, figure.molecule.structure, shown.surface,
                                           shown.shapes ? &figure.beside.shapes : nullptr,
                                           scene.figure.representations));
  if (encode) shown.still = encode(small_picture(objects, frame.camera, shown.size, shown.look), shown.look);
  return pack_frame(shown);
}

std::string scene_page(const Scene& asked) {
  check_scene(asked);
  SceneFigure made = made_figure(asked, nullptr);
  const Camera camera = made.aim.camera(made.scene.picture, made.given.still, made.figure.molecule.objects);
  const Molecule& molecule = made.figure.molecule;
  const SceneFrame frame{camera, {}, key_of(molecule), other_colors(molecule.structure, molecule.color), {}};
  PageWriter page;
  page.add(scene_frame(made.scene, std::move(made.figure), frame, png_still));
  return page.text();
}

std::string surface_page(const Surface& surface, const Coloring& colors, const Structure* structure, const Scene& look,
                         const Camera& camera, const EncodeStill& encode) {
  SurfaceObject object;
  object.surface = surface;
  object.coloring = colors;
  object.atom.resize(surface.atoms.size());
  std::iota(object.atom.begin(), object.atom.end(), 0u);
  std::vector<Atom> counted(structure ? 0 : surface.atoms.size());
  for (std::size_t n = 0; n < counted.size(); ++n) counted[n].index = static_cast<std::uint32_t>(n);
  PageFigure shown;
  const std::string atoms = with_thousands(surface.atoms.size()) + (surface.atoms.size() == 1 ? " atom" : " atoms");
  shown.title = structure ? text_of_path(path_of_text(structure->file).filename()) : "Surface of " + atoms;
  shown.description = "The surface of " + (structure ? shown.title + ", " : std::string()) + atoms;
  shown.facts = {{"Atoms", structure ? structure->report.sentence() : atoms}, patches_fact(surface)};
  if (surface.probe_radius > 0.0) shown.facts.emplace_back("Probe", fmt::format("{:g} Å", surface.probe_radius));
  shown.surface = &object;
  shown.atoms = structure ? std::span<const Atom>(structure->atoms) : std::span<const Atom>(counted);
  shown.camera = camera;
  shown.size = look.picture.size();
  shown.look = look_of(look.look, shown.size, look.image.background, Hues::free);
  shown.fades_always = look.look.depth_cue.has_value();
  shown.scheme = "given";
  if (structure)
    for (const OtherColors& other : other_colors(*structure, {}))
      shown.more_schemes.push_back(scheme_at(other, *structure, &object, nullptr, {}));
  std::vector<PictureObject> objects(1);
  objects.front().surface = &object.surface;
  objects.front().coloring = &object.coloring;
  shown.still = encode(small_picture(objects, camera, shown.size, shown.look), shown.look);
  return page_text(shown);
}

}  // namespace meniscus::page
