// SPDX-License-Identifier: BSD-3-Clause
// Writes the texts and colours of a page in addition to the patches, and draws its still picture.
#include "exporters/page/scene_page.h"

#include "core/base/system_file.h"
#include "core/image/png_file.h"
#include "core/queries/copies.h"
#include "core/render/cpu/cpu_renderer.h"
#include "core/scene/scene_json.h"
#include "core/scene/scene_picture.h"

namespace meniscus::page {
namespace {

/// Returns the look without the effects of rays: pages have light from maps. A lamp has half a degree at least.
Look page_look(Look look) {
  constexpr float kSmallestLamp = 0.5f;
  look.ambient_occlusion_rays = 0.0f;
  if (look.shadows > 0.0f) look.shadow_softness = std::max(look.shadow_softness, kSmallestLamp);
  return look;
}

/// Draws the picture for readers whose browser cannot draw the figure, with at most 720 pixels per side.
Framebuffer small_picture(std::span<const PictureObject> objects, const Camera& camera, glm::ivec2 size,
                          const Look& look) {
  constexpr int kSide = 720, kSamples = 9;
  const double share = std::min(1.0, static_cast<double>(kSide) / std::max(size.x, size.y));
  RenderSettings settings;
  settings.size = glm::max(glm::ivec2(glm::dvec2(size) * share), glm::ivec2(1));
  settings.samples = kSamples;
  settings.look = look;
  return CpuRenderer().render(objects, camera, settings);
}

const char* words_of(SurfaceKind kind) {
  return kind == SurfaceKind::ses   ? "solvent-excluded"
         : kind == SurfaceKind::sas ? "solvent-accessible"
                                    : "van der Waals";
}

std::string description_of(const Molecule& molecule, const Scene& scene, std::string_view name) {
  const std::string atoms = with_thousands(molecule.structure.atoms.size());
  if (scene.figure.hides_surface) return fmt::format("{}: {} atoms", name, atoms);
  const ColorKey key = color_key(molecule.structure, molecule.color);
  const std::string title = !key.title.empty() ? key.title : key.classes.empty() ? "one colour" : "what is chosen";
  return fmt::format("The {} surface of {}, {} atoms, coloured by {}", words_of(scene.molecule.surface.kind), name,
                     atoms, title);
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

/// Returns the colours of one frame by a scheme; points without a colour in it keep those that they have. parts: the
/// figure's colours, in the order of its parts; recolored: makes the same colours by the scheme.
PageScheme scheme_at(const OtherColors& other, const std::vector<const Coloring*>& parts,
                     const std::function<std::vector<Coloring>()>& recolored) {
  PageScheme made{other.name, other.key, {}, {}};
  const auto add = [&](const Coloring& coloring) {
    made.colors.insert(made.colors.end(), coloring.atom.begin(), coloring.atom.end());
    if (coloring.kind) made.kind = coloring.kind;
  };
  try {
    for (const Coloring& coloring : recolored()) add(coloring);
  } catch (const InputError&) {
    made.colors.clear();
    for (const Coloring* coloring : parts) add(*coloring);
  }
  return made;
}

bool is_cut_or_seen_through(const PictureObject& object) { return object.surface && needs_layers(object); }

/// Assigns the objects of a picture to the parts of a page. Throws RequestError for two with layers or other probes.
void place_objects(const std::vector<PictureObject>& objects, const SurfaceObject& whole, const FigureExtras& extras,
                   const FigureRequest& request, PageFigure& shown) {
  const auto refuse = [](const char* why) {
    throw RequestError("{}: pages show {}; make them alike, or use render", option_name("object"), why);
  };
  const bool is_cut_by_views =
      std::ranges::any_of(shown.views, [](const PageView& view) { return !view.clip.empty() || view.opacity < 1.0f; });
  const auto is_layered = [&](const PictureObject& object) {
    return is_cut_or_seen_through(object) || (object.surface == &whole.surface && is_cut_by_views);
  };
  if (std::ranges::count_if(objects, is_layered) > 1) refuse("only one surface that is cut or transparent");
  auto main = std::ranges::find_if(objects, is_layered);
  if (main == objects.end()) main = std::ranges::find_if(objects, [](const auto& o) { return o.surface != nullptr; });
  std::optional<double> probe;
  for (auto object = objects.begin(); object != objects.end(); ++object) {
    PageObject made;
    const auto same = [&](const FigureObject& other) {
      return object->surface ? other.surface && &other.surface->surface == object->surface
                             : &other.shapes.shapes == object->shapes;
    };
    const auto own = std::ranges::find_if(extras.objects, same);
    if (own != extras.objects.end())
      made = {own->surface ? &*own->surface : nullptr, own->surface ? nullptr : &own->shapes,
              request_of(request.objects, static_cast<std::size_t>(own - extras.objects.begin())).has_own_colors()};
    else
      made = {object->surface ? &whole : nullptr, object->shapes ? &extras.shapes : nullptr, false};
    if (object->surface && object->surface->probe_radius > 0.0) {
      if (probe && *probe != object->surface->probe_radius) refuse("surfaces of one probe, not of several");
      probe = object->surface->probe_radius;
    }
    if (object != main) {
      shown.extras.push_back(made);
      continue;
    }
    shown.surface = made.surface;
    shown.has_own_colors = made.has_own_colors;
    shown.clip = object->clip;
    shown.cap = object->cap;
    shown.thickens = object->thickens;
    // Views determine the cuts of the molecule's surface.
    if (made.surface != &whole)
      for (PageView& view : shown.views) {
        view.clip = object->clip;
        view.opacity = 1.0f;
      }
  }
}

const Coloring& coloring_of(const PageObject& object) {
  return object.surface ? object.surface->coloring : object.shapes->coloring;
}

void add_schemes(const std::vector<OtherColors>& others, const Figure& figure, const FigureRequest& request,
                 const SurfaceObject& whole, PageFigure& shown) {
  const Structure& structure = figure.molecule.structure;
  std::vector<PageObject> parts = shown.extras;
  if (shown.surface) parts.insert(parts.begin(), {shown.surface, nullptr, false});
  std::vector<const Coloring*> own;
  for (const PageObject& part : parts) own.push_back(&coloring_of(part));
  FigureExtras extras = figure.extras;
  // The n-th object of `extras` corresponds to the n-th object of the figure.
  const auto there = [&](const PageObject& part) -> const Coloring& {
    if (part.shapes == &figure.extras.shapes) return extras.shapes.coloring;
    for (std::size_t n = 0; n < extras.objects.size(); ++n) {
      const FigureObject& here = figure.extras.objects[n];
      if (part.shapes == &here.shapes) return extras.objects[n].shapes.coloring;
      if (here.surface && part.surface == &*here.surface) return extras.objects[n].surface->coloring;
    }
    throw std::logic_error("the page has a part that its figure lacks");
  };
  for (const OtherColors& other : others)
    shown.more_schemes.push_back(scheme_at(other, own, [&] {
      color_extras(structure, request, other.scheme, extras);
      std::vector<Coloring> made;
      for (const PageObject& part : parts)
        made.push_back(part.surface == &whole ? color_object(structure, whole.atom, other.scheme, 0) : there(part));
      return made;
    }));
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
    throw RequestError("{}: pages do not show {} yet; leave it out, or use render", option, why);
  };
  for (const FigureObjectRequest& object : scene.figure.objects) {
    const ColorScheme& color = object.color ? *object.color : scene.molecule.color;
    if (!object.material.empty()) refuse(option_name("object"), "objects of their own material");
    if (object.shapes && !object.opacities.empty())
      refuse(option_name("object"), "transparent sticks, balls, spheres and tubes");
    if (!object.shapes && color.of_points()) refuse(option_name("object"), "objects coloured by a map");
    if (object.color && color.by == ColorScheme::By::kind)
      refuse(option_name("object"), "objects coloured by kind of patch");
    if (object.cuts.size() > kMostPlanes) refuse(option_name("object"), "objects cut by so many planes");
  }
  if (scene.figure.cuts.size() > kMostPlanes)
    throw RequestError("{}: pages show at most {} planes, and there are {}; leave some out", option_name("clip"),
                       kMostPlanes, scene.figure.cuts.size());
}

std::vector<OtherColors> other_colors(const Structure& structure, const ColorScheme& requested,
                                      const std::function<void(ColorScheme&)>& measure) {
  std::vector<OtherColors> others;
  const ColorScheme::By current = resolved_scheme(structure, requested).by;
  for (const char* const word :
       {"element", "chain", "residue", "secondary", "kind", "hydrophobicity", "bfactor", "charge", "rainbow"}) {
    ColorScheme scheme = parse_color_scheme(word).value();
    if (scheme.by == current && requested.rules.empty()) continue;
    try {
      if (measure) measure(scheme);
      ColorKey key = color_key(structure, scheme);
      color_atoms(structure, scheme);
      others.push_back({word, std::move(scheme), std::move(key)});
    } catch (const InputError&) {
      // the molecule does not have the numbers of this scheme
    }
  }
  return others;
}

PackedFrame scene_frame(const Scene& scene, Figure figure, const SceneFrame& frame, const EncodeStill& encode) {
  const SurfaceObject surface = merged(std::exchange(figure.molecule.objects, {}));
  return scene_frame(scene, figure, surface, frame, encode, Packing::deflated);
}

PackedFrame scene_frame(const Scene& scene, const Figure& figure, const SurfaceObject& surface, const SceneFrame& frame,
                        const EncodeStill& encode, Packing packing) {
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
  // Colours by a scale must agree with the legend, so a scheme may have its own look.
  const auto look_by = [&](ColorScheme scheme) {
    scheme.opacities = scene.molecule.color.opacities;
    return page_look(look_of(scene.look, shown.size, scene.image.background,
                             hues_of(scheme, uses_atoms(scene.figure.cuts)), scene.molecule.patches.has_value()));
  };
  shown.look = look_by(scene.molecule.color);
  shown.views = frame.views;
  shown.fades_always = scene.look.depth_cue.has_value();
  shown.facts = facts_of(figure.molecule, surface, scene);
  shown.facts.insert(shown.facts.end(), frame.facts.begin(), frame.facts.end());
  const std::vector<PictureObject> objects = picture_objects(surface.surface, surface.coloring, scene.figure,
                                                             &figure.extras, frame.camera, surface.surface.atoms);
  place_objects(objects, surface, figure.extras, scene.figure, shown);
  const Annotations annotations = annotations_of(scene.annotations, figure.molecule.structure, figure.extras.lengths());
  shown.labels = annotations.labels;
  shown.atoms = atoms;
  const ColorScheme scheme = resolved_scheme(figure.molecule.structure, figure.molecule.color);
  shown.scheme = scheme.by == ColorScheme::By::fixed || !scheme.rules.empty() ? "given" : scheme_word(scheme);
  add_schemes(frame.others, figure, scene.figure, surface, shown);
  for (std::size_t n = 0; n < frame.others.size(); ++n)
    if (frame.others[n].scheme.uses_scale() != scene.molecule.color.uses_scale())
      shown.more_schemes[n].look = look_by(frame.others[n].scheme);
  if (encode) shown.still = encode(small_picture(objects, frame.camera, shown.size, shown.look), shown.look);
  return pack_frame(shown, packing);
}

std::string scene_page(const Scene& requested) {
  check_scene(requested);
  SceneFigure made = made_figure(requested, nullptr);
  const Camera camera = made.aim.camera(made.scene.picture, made.given.still, made.aim.viewed(made.figure));
  const Molecule& molecule = made.figure.molecule;
  const SceneFrame frame{camera,
                         {},
                         key_of(molecule, made.scene.figure, made.figure.extras),
                         other_colors(molecule.structure, molecule.color),
                         {}};
  PageWriter page;
  page.add(scene_frame(made.scene, std::move(made.figure), frame, png_still));
  return page.text(scene_text(requested, ""));
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
  shown.look = page_look(look_of(look.look, shown.size, look.image.background, Hues::free));
  shown.fades_always = look.look.depth_cue.has_value();
  shown.scheme = "given";
  ColorScheme by_element;
  by_element.by = ColorScheme::By::element;
  if (structure)
    for (const OtherColors& other : other_colors(*structure, by_element)) {
      shown.more_schemes.push_back(scheme_at(
          other, {&colors}, [&] { return std::vector{color_object(*structure, object.atom, other.scheme, 0)}; }));
      if (other.scheme.uses_scale())
        shown.more_schemes.back().look =
            page_look(look_of(look.look, shown.size, look.image.background, hues_of(other.scheme, false)));
    }
  std::vector<PictureObject> objects(1);
  objects.front().surface = &object.surface;
  objects.front().coloring = &object.coloring;
  shown.still = encode(small_picture(objects, camera, shown.size, shown.look), shown.look);
  return page_text(shown);
}

}  // namespace meniscus::page
