// SPDX-License-Identifier: BSD-3-Clause
// `meniscus export page`: writes one HTML file in which readers turn the exact surface.
#include <algorithm>
#include <iostream>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "app/commands/commands.h"
#include "app/commands/figure_run.h"
#include "app/commands/page_views.h"
#include "app/options/property_options.h"
#include "app/options/scene_options.h"
#include "app/process/program_error.h"
#include "app/reports/notes.h"
#include "core/base/error.h"
#include "core/base/output_file.h"
#include "core/base/system_file.h"
#include "core/base/text.h"
#include "core/color/color_atoms.h"
#include "core/image/color_space.h"
#include "core/image/image_codec.h"
#include "core/queries/copies.h"
#include "core/render/surface_renderer.h"
#include "core/scene/annotations.h"
#include "core/scene/cut.h"
#include "core/scene/figure.h"
#include "core/scene/representations.h"
#include "core/scene/scene_picture.h"
#include "exporters/page/page_file.h"

namespace meniscus {
namespace {

constexpr double kManyBytes = 15e6;

struct PageCommand : SceneCommand {
  std::vector<std::string> named_views;
};

/// What a page cannot show though it has the option is refused before anything is computed.
void check_page(const Scene& scene) {
  const auto refuse = [](const std::string& option, const char* why) {
    throw UsageError(fmt::format("{}: pages do not show {} yet; leave it out, or use render", option, why));
  };
  if (scene.molecule.color.by == ColorScheme::By::lipophilicity) refuse("--color lipophilicity", "colours of points");
  if (!scene.figure.objects.empty()) refuse("--object", "objects with looks of their own");
  if (scene.figure.cuts.size() > page::kMostPlanes)
    throw UsageError(fmt::format("--clip: pages show at most {} planes, and there are {}; leave some out",
                                 page::kMostPlanes, scene.figure.cuts.size()));
}

/// The picture that readers see whose browser cannot draw the figure: on white, of at most 720 pixels.
std::vector<std::uint8_t> still_picture(std::span<const PictureObject> objects, const Camera& camera, glm::ivec2 size,
                                        const Look& look) {
  constexpr int kSide = 720, kSamples = 9;
  const double share = std::min(1.0, static_cast<double>(kSide) / std::max(size.x, size.y));
  RenderSettings settings;
  settings.size = glm::max(glm::ivec2(glm::dvec2(size) * share), glm::ivec2(1));
  settings.samples = kSamples;
  settings.look = look;
  const Framebuffer drawn = make_cpu_renderer()->render(objects, camera, settings);
  std::vector<float> pixels;
  pixels.reserve(3 * drawn.color.size());
  for (const glm::vec4& pixel : drawn.color) {
    const glm::vec4 color = display_color(pixel, look.background);
    for (const float channel : {color.x, color.y, color.z}) pixels.push_back(channel);
  }
  ImageToEncode image;
  image.format = "jpeg";
  image.compression = "jpeg:80";
  image.color_space = "sRGB";
  image.width = drawn.size.x;
  image.height = drawn.size.y;
  image.channels = {"R", "G", "B"};
  const std::unique_ptr<RowEncoder> encoder = image_codec().begin(image);
  encoder->add(pixels);
  return encoder->finish();
}

std::string description_of(const Molecule& molecule, const Scene& scene, std::string_view name) {
  const char* const kind = scene.molecule.surface.kind == SurfaceKind::ses   ? "solvent-excluded"
                           : scene.molecule.surface.kind == SurfaceKind::sas ? "solvent-accessible"
                                                                             : "van der Waals";
  return scene.figure.hides_surface
             ? fmt::format("{}: {} atoms", name, with_thousands(molecule.structure.atoms.size()))
             : fmt::format("The {} surface of {}, {} atoms, coloured by {}", kind, name,
                           with_thousands(molecule.structure.atoms.size()),
                           key_of(molecule).title.empty() ? std::string("one colour") : key_of(molecule).title);
}

std::vector<std::pair<std::string, std::string>> facts_of(const Molecule& molecule, const SurfaceObject& surface,
                                                          const Scene& scene) {
  std::vector<std::pair<std::string, std::string>> facts{{"Atoms", molecule.structure.report.sentence()}};
  if (scene.figure.hides_surface) return facts;
  if (scene.molecule.surface.kind == SurfaceKind::ses)
    facts.emplace_back("Probe", fmt::format("{:g} Å", surface.surface.probe_radius));
  facts.emplace_back(
      "Patches",
      fmt::format("{} convex, {} toroidal, {} concave", with_thousands(surface.surface.convex.size()),
                  with_thousands(surface.surface.toroidal.size()), with_thousands(surface.surface.concave.size())));
  facts.emplace_back("Radii", molecule.structure.radii_set);
  return facts;
}

/// What readers can choose instead of the figure's colours: schemes that need nothing but the file.
std::vector<page::PageScheme> more_schemes(const Structure& structure, const SurfaceObject* surface,
                                           const FigureRequest& figure, const ColorScheme& asked) {
  std::vector<page::PageScheme> schemes;
  for (const char* const word :
       {"element", "chain", "residue", "secondary", "kind", "hydrophobicity", "bfactor", "charge", "rainbow"}) {
    const ColorScheme scheme = parse_color_scheme(word).value();
    if (scheme.by == asked.by && asked.rules.empty()) continue;
    try {
      page::PageScheme made{word, color_key(structure, scheme, {}), {}, {}};
      if (surface) {
        const Coloring coloring = color_object(structure, surface->atom, scheme, 0);
        made.colors = coloring.atom;
        made.kind = coloring.kind;
      }
      const Coloring beside = shown_shapes(structure, figure.representations, scheme).coloring;
      made.colors.insert(made.colors.end(), beside.atom.begin(), beside.atom.end());
      schemes.push_back(std::move(made));
    } catch (const InputError&) {
      // This molecule has no such numbers.
    }
  }
  return schemes;
}

/// What the scene file says and the page does not show, in a sentence. Throws UsageError for frames.
void tell_left_out(const SceneCommand& command, std::span<const std::string> keys) {
  std::string names;
  for (const std::string& key : keys) {
    if (key.starts_with("frames."))
      throw UsageError(
          fmt::format("{}: a page shows one molecule, not a run of frames; leave it out of the scene", key));
    const bool is_seen = key.starts_with("annotations.") || key.starts_with("look.") || key.starts_with("camera.") ||
                         (key.starts_with("legend.") && key != "legend.shown");
    if (is_seen) names += (names.empty() ? "" : ", ") + key;
  }
  if (!names.empty()) say(command, "note: the page does not show what the scene says of " + names);
}

/// Of the molecule; what it is written to.
void write_page(const SceneCommand& command, const NamedViews& views, FigureFrame frame) {
  const Scene& scene = command.scene;
  Figure& figure = frame.figure;
  const std::string name = text_of_path(path_of_text(scene.molecule.file).filename());
  const std::vector<Atom> atoms = shown_atoms(figure.molecule.structure);
  page::PageFigure shown;
  shown.title = name;
  shown.description = description_of(figure.molecule, scene, name);
  shown.key = key_of(figure.molecule);
  shown.camera = frame.camera;
  shown.size = scene.picture.size();
  shown.look = look_of(scene.look, shown.size, scene.image.background,
                       hues_of(scene.molecule.color, scene.legend.asked(), uses_atoms(scene.figure.cuts)));
  shown.views = views.aimed(scene, figure);
  shown.fades_always = scene.look.depth_cue.has_value();
  const std::vector<Ball> balls = placed_balls(figure.molecule.objects);
  const SurfaceObject surface = merged(std::exchange(figure.molecule.objects, {}));
  shown.facts = facts_of(figure.molecule, surface, scene);
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
  shown.more_schemes = more_schemes(figure.molecule.structure, shown.surface, scene.figure, figure.molecule.color);
  shown.still = still_picture(objects, frame.camera, shown.size, shown.look);
  const std::string text = page::page_text(shown);
  OutputFile file(scene.output, command.existing());
  file.write(text);
  file.commit();
  say(command, fmt::format("{} bytes", with_thousands(text.size())));
  if (static_cast<double>(text.size()) > kManyBytes)
    say(command, "warning: readers load all of it; --show or --select make a smaller page");
}

void export_page(const PageCommand& asked, std::span<const std::string> left_out, bool trusts_scenes) {
  check_page(asked.scene);
  tell_left_out(asked, left_out);
  check_output(asked.scene.output, asked.existing());
  check_saved_camera(asked);
  const NamedViews views(asked.named_views, asked, trusts_scenes);
  FigureRun run(asked);
  run.aim(asked.scene.picture, false);
  const SceneCommand& command = run.command();
  run.make({kSurfaceBytesPerAtom}, [&]() -> FigureRun::Sink {
    return [&](FigureFrame frame) -> FinishFrame {
      write_page(command, views, std::move(frame));
      return [] { return MadeFrame{}; };
    };
  });
  run.save_cameras();
  std::cout << escaped(command.scene.output) << "\n";
}

}  // namespace

void add_export_page(CLI::App& command) {
  describe(
      command,
      "  meniscus export page 1tii.pdb -o 1tii.html              then open it in a browser\n"
      "  meniscus export page 1tii.pdb -o 1tii.html --color chain --sticks ligand\n"
      "  meniscus export page --scene fig.json -o fig.html\n"
      "  meniscus export page 1tii.pdb -o 1tii.html --named-view 'Active site=site.json' --named-view Back=back.png",
      "The page fetches nothing, and casts the exact patches by WebGL 2 in the browser that opens it. Others "
      "see\na still picture that is in it.");
  auto declared = std::make_shared<DeclaredCommand<PageCommand>>(command, for_page);
  PropertyOptions(command).add("camera.named_views", declared->state.named_views);
  declared->options.describe_output("HTML file to write");
  command.callback([declared, &command] {
    declared->options.take();
    const bool trusts_scenes = command.count("--trust-scene") > 0;
    run_and_save_scene(declared->state,
                       [&] { export_page(declared->state, declared->options.left_out(), trusts_scenes); });
  });
}

}  // namespace meniscus
