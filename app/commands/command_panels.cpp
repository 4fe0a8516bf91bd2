// SPDX-License-Identifier: BSD-3-Clause
// `meniscus panels`: makes one picture of several scenes, side by side; `meniscus looks`: of all looks.

#include "app/commands/command_run.h"
#include "app/commands/command_table.h"
#include "app/options/scene_options.h"
#include "app/process/program_main.h"
#include "app/reports/notes.h"
#include "core/base/progress.h"
#include "core/base/text.h"
#include "core/render/image_output.h"
#include "core/scene/frame_run.h"
#include "core/scene/panel_page.h"
#include "core/scene/renderers.h"
#include "core/scene/scene_value.h"
#include "core/scene/scene_values.h"
#include "core/structure/superposition.h"

namespace meniscus {
namespace {

struct PanelsCommand : SceneCommand {
  std::vector<std::string> files;
  std::string gap;
  PanelArrangement arrangement;
  bool one_scale = false;
};
using DeclaredPanels = DeclaredCommand<PanelsCommand>;

/// Returns the words of the page's command line that apply to each panel.
std::vector<std::string> words_of_panels(const DeclaredPanels& page) {
  constexpr std::array<std::string_view, 5> kOfPage{"output.file", "image.size", "image.width", "image.height",
                                                    "molecule.superpose_on"};
  std::vector<std::string> words = shared_words(page.options, kOfPage);
  const double dots_per_inch = page.state.scene.picture.dots_per_inch;
  if (dots_per_inch > 0.0 && !page.options.typed("image.dpi"))
    words.insert(words.end(), {"--dpi", fmt::format("{}", dots_per_inch)});
  return words;
}

SceneCommand read_panel(const std::string& path, const std::vector<std::string>& words, const SceneCommand& page) {
  SceneCommand command = read_scene_file(path, words, page.reporting);
  command.scene = prepared_scene(command.scene);
  freeze_selections(command.scene);
  return command;
}

Structure read_structure(const SceneCommand& command, const std::string& path) {
  const Scene& scene = command.scene;
  if (!scene.frames.is_requested()) return read_and_log(command);
  FrameRun run(scene.molecule, scene.frames);
  log_run(command, run);
  if (run.numbers().size() != 1)
    throw UsageError(
        "{}: a panel shows one frame, and this scene has {}; make a picture of one "
        "of them with render --frames N",
        escaped(path), with_thousands(run.numbers().size()));
  return run.at(run.numbers().front());
}

/// Superposes the structures of all panels but the first on the first.
void superpose(const PanelsCommand& page, std::span<const SceneCommand> panels, std::vector<Structure>& structures) {
  const std::optional<Selection>& chosen = page.scene.molecule.reading.superpose_on;
  if (!chosen) return;
  const Structure& first = structures.front();
  const std::vector<bool> of_first = chosen->evaluate(first.atoms);
  for (std::size_t n = 1; n < structures.size(); ++n) {
    Structure& moved = structures[n];
    if (!moved.instances.empty() || panels[n].scene.molecule.color.by == ColorScheme::By::volume)
      throw UsageError("--superpose-on: {} has {}, which cannot be moved; leave one of them out",
                       escaped(page.files[n]), moved.instances.empty() ? "a volume map" : "copies as instances");
    const std::vector<AtomPair> pairs =
        corresponding_atoms(first.atoms, of_first, moved.atoms, chosen->evaluate(moved.atoms));
    if (pairs.empty())
      throw UsageError(
          "--superpose-on {}: {} has no chain that corresponds to one of {} by its sequence, "
          "with three of these atoms or more; choose other atoms",
          in_quotes(chosen->text()), escaped(page.files[n]), escaped(page.files.front()));
    const Superposition fit = superposition(first.atoms, moved.atoms, pairs);
    for (std::vector<Atom>* const atoms : {&moved.atoms, &moved.extra_atoms})
      for (Atom& atom : *atoms) atom.position = fit.motion(atom.position);
    log_line(page, fmt::format("{} is superposed on {} by {} atoms with an RMSD of {:.3f} Å", page.files[n],
                               page.files.front(), with_thousands(pairs.size()), fit.rmsd));
  }
}

std::vector<Panel> read_panels(const PanelsCommand& page, std::span<SceneCommand> panels) {
  std::vector<Structure> structures;
  std::vector<Scene> scenes;
  for (std::size_t n = 0; n < panels.size(); ++n) {
    structures.push_back(read_structure(panels[n], page.files[n]));
    scenes.push_back(panels[n].scene);
  }
  superpose(page, panels, structures);
  if (page.one_scale) share_range(scenes, structures);
  std::vector<Panel> made;
  for (std::size_t n = 0; n < panels.size(); ++n) {
    SceneCommand& command = panels[n];
    command.scene = scenes[n];
    const std::optional<Camera> given = given_camera(command.scene.picture);
    ViewAim aim(command.scene.picture, command.scene.molecule.show, structures[n]);
    Figure figure = make_figure(build_and_log(command, std::move(structures[n])), command.scene.figure);
    made.push_back({std::move(scenes[n]), std::move(figure), std::move(aim), given});
  }
  return made;
}

/// Converts lengths of the page to pixels, by its resolution.
PanelArrangement arrangement_of(const DeclaredPanels& declared, const Scene& first) {
  const Scene& scene = declared.state.scene;
  PanelArrangement arrangement = declared.state.arrangement;
  const bool has_size = declared.options.typed("image.size");
  if (has_size || declared.options.typed("image.width")) arrangement.width = scene.picture.width;
  if (has_size || declared.options.typed("image.height")) arrangement.height = scene.picture.height;
  constexpr int kUsualShare = 50;
  const int width = arrangement.width.value_or(first.picture.width * 2) / 2;
  arrangement.gap = declared.state.gap.empty()
                        ? width / kUsualShare
                        : static_cast<int>(scene_values::pixels_in_range(property_of("panels.gap"), declared.state.gap,
                                                                         first.picture.dots_per_inch, "a gap has"));
  return arrangement;
}

/// Draws the panels and writes their page.
void make_page(const PanelsCommand& page, std::span<SceneCommand> panels, const PanelArrangement& arrangement) {
  if (holds_aovs(page.scene.output))
    throw UsageError("-o: panels are written as .png, .jpg, .webp, .tif, .svg or .pdf");
  const glm::ivec2 usual = panels.front().scene.picture.size();
  for (const SceneCommand& panel : panels) {
    check_picture(panel.scene);
    check_cost(page, panel.scene, {arrangement.width.value_or(usual.x), arrangement.height.value_or(usual.y)});
  }
  check_output(page.scene.output, page.existing());
  PanelPage made(read_panels(page, panels), arrangement);
  if (!made.conflicts().empty()) log_line(page, "warning: " + made.conflicts());
  SurfaceRequest request = panels.front().scene.molecule.surface;
  for (const SceneCommand& panel : panels) request.cpu = request.cpu || picture_request(panel.scene).cpu;
  PictureDevice device(request);
  const Scene& first = panels.front().scene;
  ImageSettings image{first.image.background, page.existing(), first.look.has_linear_alpha()};
  image.dots_per_inch = first.picture.dots_per_inch;
  image.tiff = first.image.tiff;
  Progress progress(progress_on_stderr(page), "panels", panels.size());
  made.write(page.scene.output, device.renderer(), image, [&] { progress.advance(); });
  log_line(page, fmt::format("{} panels in {} x {} pixels: {}", panels.size(), made.size().x, made.size().y,
                             page.scene.output));
}

void run(const DeclaredPanels& declared) {
  check_image_path(declared.state.scene.output);
  std::vector<SceneCommand> panels;
  for (const std::string& file : declared.state.files)
    panels.push_back(read_panel(file, words_of_panels(declared), declared.state));
  make_page(declared.state, panels, arrangement_of(declared, panels.front().scene));
}

/// Returns the selection that a look needs but that has no atoms in the drawn structure; empty if nothing is missing.
std::string lacking(const Preset& preset, const Scene& scene, const Structure& structure) {
  if (preset.needs.empty()) return {};
  const bool is_elsewhere = scene.picture.zoom_to && preset.sets("camera.zoom_to");
  for (const std::string_view needed : {std::string_view("polymer"), preset.needs}) {
    const std::vector<bool> found = parse_selection(needed).evaluate(shown_atoms(structure));
    if (std::ranges::find(found, true) == found.end() && (needed == "polymer" || !is_elsewhere))
      return std::string(needed);
  }
  return {};
}

/// Makes the page of a molecule in each look that it can have. The word of a look takes the place of a letter.
void run_looks(DeclaredPanels& declared) {
  PanelsCommand& page = declared.state;
  Scene& scene = page.scene;
  if (scene.molecule.file == "-") throw UsageError("standard input cannot be read for each look; name a file");
  if (scene.output.empty()) scene.output = std::filesystem::path(scene.molecule.file).stem().string() + "_looks.png";
  if (!declared.options.typed("image.size")) scene.picture.width = 640, scene.picture.height = 480;
  SceneCommand reading = page;
  reading.scene = prepared_scene(scene);
  const Structure structure = read_and_log(reading);
  std::vector<SceneCommand> panels;
  for (const Preset& preset : kPresets) {
    if (const std::string lack = lacking(preset, scene, structure); !lack.empty()) {
      log_line(page, fmt::format("{} is left out: no atom is {}", preset.word, in_quotes(lack)));
      continue;
    }
    SceneCommand& panel = panels.emplace_back(page);
    panel.reporting.quiet = true;
    panel.scene.annotations.panel = preset.word;
    set_value(panel.scene, property_of("look.preset"), std::array{std::string(preset.word)});
    complete(panel.scene);
    panel.scene = prepared_scene(panel.scene);
    page.files.push_back(scene.molecule.file);
  }
  make_page(page, panels, arrangement_of(declared, panels.front().scene));
}

}  // namespace

void add_looks(CLI::App& command) {
  describe(command, "  meniscus looks 1tii.pdb\n  meniscus looks complex.pdb --zoom-to 'resname ATP' -o atp.png");
  auto declared = std::make_shared<DeclaredPanels>(
      command, TakenProperties({"molecule.file", "molecule.select", "molecule.assembly", "molecule.warnings",
                                "molecule.quiet", "Computing", "-surface.verify", "surface.color", "camera.zoom_to",
                                "image.size", "image.samples", "image.background", "output.file", "output.force"},
                               {fixed_size_need()}));
  declared->options.describe_output("Picture to write [FILE's name here, as _looks.png]", OutputName::optional);
  declared->options.option("image.size")->description("Size of the page in pixels [640x480 for each look]");
  command.callback([declared] {
    declared->options.take();
    run_looks(*declared);
  });
}

void add_panels(CLI::App& command) {
  describe(
      command,
      "  meniscus panels apo.png holo.png -o figure.pdf --width 180mm\n"
      "  meniscus panels apo.png holo.png -o figure.png --superpose-on 'name CA' --one-camera --one-scale --legend\n"
      "  meniscus panels a.json b.json c.json d.json -o figure.png --columns 2 --letters lower --background white",
      "A panel is a scene file, or a picture of meniscus render, which carries its scene. Each panel is drawn again\n"
      "in its size on the page. Options of scenes apply to all panels.");
  const TakenProperties shared{"Computing", "-surface.verify", "Legend", "-legend.file"};
  auto declared = std::make_shared<DeclaredPanels>(
      command,
      shared.with({"molecule.superpose_on", "molecule.warnings", "molecule.quiet", "annotations.letter_size",
                   "annotations.letter_color", "annotations.font", "annotations.font_file", "image.size", "image.width",
                   "image.height", "image.dpi", "image.samples", "image.background", "image.tiff_compression",
                   "image.tiff_bits", "picture.any_cost", "output.file", "output.force", "scene.trust"},
                  {fixed_size_need()}));
  PanelsCommand& state = declared->state;
  declared->options.describe_output("Picture to write: .png, .jpg, .webp, .tif, .svg, .pdf");
  PropertyOptions options(command);
  options.add("panels.scenes", state.files)->required();
  options.add("panels.columns", state.arrangement.columns);
  options.add("panels.gap", state.gap);
  options.add_word("panels.letters", state.arrangement.letters,
                   {PanelLetters::upper, PanelLetters::lower, PanelLetters::none});
  options.add("panels.one_camera", state.arrangement.one_camera);
  options.add("panels.one_scale", state.one_scale);
  declared->options.option("image.size")->description("Size of the page in pixels [by the size of the first panel]");
  declared->options.option("image.width")->description("Width of the page: 180mm, 18cm, 7in or 2000px");
  declared->options.option("image.height")->description("Height of the page in the same units");
  declared->options.option("molecule.superpose_on")
      ->description(
          "Superpose the molecules on that of the first panel by these atoms. 'name CA' takes alpha carbons. "
          "Chains are paired and aligned by sequence; the number of atoms and the RMSD are printed");
  command.callback([declared] {
    declared->options.take();
    run(*declared);
  });
}

}  // namespace meniscus
