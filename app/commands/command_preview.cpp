// SPDX-License-Identifier: BSD-3-Clause
// `meniscus preview`: look at the surface while it changes.
#include <algorithm>
#include <charconv>
#include <csignal>
#include <filesystem>
#include <iostream>
#include <iterator>
#include <memory>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include <unistd.h>

#include <fmt/format.h>

#include "app/commands/commands.h"
#include "app/options/annotation_options.h"
#include "app/options/figure_options.h"
#include "app/options/frame_options.h"
#include "app/options/look_options.h"
#include "app/options/picture_options.h"
#include "app/options/scene_file.h"
#include "core/scene/molecule.h"
#include "app/preview/command_log.h"
#include "app/preview/server/serve.h"
#include "app/preview/session.h"
#include "app/preview/window/window.h"
#include "app/process/program_error.h"
#include "core/scene/frame_run.h"
#include "core/scene/copied_atoms.h"
#include "core/base/error.h"
#include "core/base/text.h"
#include "app/reports/notes.h"
#include "app/options/molecule_options.h"
#include "core/gpu/egl_context.h"
#include "core/scene/picture_device.h"
#include "core/scene/view_aim.h"
#include "core/scene/view_renderer.h"

namespace meniscus {
namespace {

struct PreviewCommand {
  MoleculeOptions molecule;
  FrameOptions frames;
  ViewRequest picture;
  FigureRequest figure;
  LegendRequest legend;
  LookRequest look{.preset = LookPreset::classic};
  RenderInput input;
  std::optional<std::uint16_t> port;  ///< of --serve
  std::string record, commands, output_folder = ".";
  bool force = false;
};

std::uint16_t parse_port(const std::string& text) {
  if (text.empty()) return 0;
  std::uint16_t port = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), port);
  if (error != std::errc() || end != text.data() + text.size())
    throw CLI::ValidationError("--serve", in_quotes(text) + " is no port, 0 to 65535; put FILE before --serve");
  return port;
}

/// The name by which ssh may know this machine.
std::string host_name() {
  char name[256] = {};
  return ::gethostname(name, sizeof name - 1) == 0 && name[0] ? escaped(name) : "HOST";
}

/// The molecule again, at a frame, with the atoms that representations show. Files are read anew when these change.
class ShownReader {
 public:
  ShownReader(const PreviewCommand& command, bool models) : molecule_(command.molecule), frames_(command.frames) {
    if (!frames_.asked()) models_ = models;
  }

  Structure operator()(const Representations& representations, std::size_t frame) {
    if (molecule_.file == "-")
      throw RequestError(
          "a molecule from standard input cannot be read again; give FILE to draw atoms beside a surface");
    MoleculeOptions wanted = molecule_;
    representations.ask_for(wanted.reading);
    if (!frames_.asked()) {
      if (models_) {
        wanted.reading.model = {};
        wanted.reading.model.number = static_cast<int>(frame) + 1;
      }
      return read_molecule(wanted);
    }
    if (wanted.reading.model.all) wanted.reading.model = {};
    FrameRun run(wanted, frames_);
    return run.at(run.chunk()[frame]);
  }

 private:
  MoleculeOptions molecule_;
  FrameOptions frames_;
  bool models_ = false;
};

/// A molecule, where its atoms stand at the frames of a trajectory, if there is one, and the camera of a file, if one
/// is named.
struct Shown {
  Structure structure;
  std::optional<TrajectoryPositions> trajectory;
  std::optional<Camera> camera;
};

Shown read_run(PreviewCommand& command) {
  if (!command.frames.asked()) {
    // Copies have no frames: of several models the first is shown.
    if (command.molecule.division.instances != InstanceMode::none && command.molecule.reading.model.all)
      command.molecule.reading.model = {};
    return {read_and_tell(command.molecule), {}, {}};
  }
  MoleculeOptions molecule = command.molecule;
  if (molecule.reading.model.all) molecule.reading.model = {};  // the preview's default; a run has frames instead
  const auto frames = std::make_shared<FrameRun>(molecule, command.frames);
  tell_run(molecule, *frames);
  return {frames->structure(),
          TrajectoryPositions{frames->chunk(),
                              [frames](std::size_t frame) { return frames->positions(frames->chunk()[frame]); }},
          {}};
}

/// As render aims it: what stands beside the surface counts.
Camera aimed_camera(const PreviewCommand& command, const std::optional<Camera>& given, const Structure& structure) {
  const auto aimed = [&](const Structure& at) {
    return ViewAim(command.picture, command.molecule.show, at).camera(command.picture, given, balls_of(at));
  };
  if (command.figure.representations.empty()) return aimed(structure);
  return aimed(ShownReader(command, command.molecule.reading.model.all)(command.figure.representations, 0));
}

Shown read_inputs(PreviewCommand& command) {
  if (!std::filesystem::is_directory(command.output_folder))
    throw OutputError(command.output_folder, "--output-dir is no folder");
  const std::optional<Camera> camera = given_camera(command.picture);
  Shown shown = read_run(command);
  shown.camera = camera;
  const ViewRequest& picture = command.picture;
  if (picture.direction || picture.zoom_to || !picture.turns.empty())
    shown.camera = aimed_camera(command, camera, shown.structure);
  if (command.molecule.color.by == ColorScheme::By::volume)
    throw UsageError("--color-map-file is for render and export ply; leave it out");
  command.molecule.color = color_of(command.molecule);
  return shown;
}

/// Copies are drawn as atoms like all others where that is the same picture and GL may have room for them, else by the
/// CPU, which needs memory for one.
std::unique_ptr<ViewRenderer> make_renderer(const PreviewCommand& command, const Structure& structure, bool on_gl) {
  constexpr std::size_t kMostOnGl = 500'000;  // atoms
  const std::vector<Instances>& copies = structure.instances;
  if (copies.empty()) return on_gl ? make_gl_view_renderer() : make_cpu_view_renderer();
  const bool apart = command.molecule.division.instances == InstanceMode::exact;
  if (on_gl && apart && placed_count(copies) <= kMostOnGl)
    return make_placed_atoms_renderer(copies, make_gl_view_renderer());
  if (on_gl)
    say(command.molecule, fmt::format("the CPU draws the copies: {}",
                                      apart ? with_thousands(placed_count(copies)) + " atoms are too many for GL"
                                            : "each has a surface of its own"));
  return make_cpu_copies_renderer(copies);
}

/// A session as the options say.
std::unique_ptr<PreviewSession> begin_session(const PreviewCommand& command, bool on_gl, Shown shown) {
  PreviewView view;
  view.color = command.molecule.color;
  view.show = command.molecule.show;
  view.probe_radius = command.molecule.surface.probe_radius;
  view.copies_apart = command.molecule.division.instances == InstanceMode::exact;
  view.figure = command.figure;
  view.look = command.look;
  view.legend = command.legend.within;
  view.legend_style = command.legend.style;
  view.size = {command.picture.width, command.picture.height};
  view.camera.projection = command.picture.projection;
  SessionContext context;
  context.input = command.input;
  context.read_shown = ShownReader(command, command.molecule.reading.model.all);
  std::unique_ptr<ViewRenderer> renderer = make_renderer(command, shown.structure, on_gl);
  auto session = std::make_unique<PreviewSession>(std::move(renderer), std::move(shown.structure), view, shown.camera,
                                                  command.output_folder, std::move(shown.trajectory), context);
  if (!command.record.empty()) {
    auto log = std::make_shared<CommandLog>(command.record, command.force ? Existing::replace : Existing::refuse);
    session->record([log](const nlohmann::json& line) { log->write(line); });
  }
  return session;
}

void say_address(const PreviewCommand& command, const std::string& url, std::uint16_t port) {
  std::cout << url << std::endl;
  say(command.molecule, fmt::format("from another machine: ssh -L {0}:127.0.0.1:{0} {1}", port, host_name()));
  say(command.molecule, "Ctrl-C ends the preview");
}

std::vector<WrittenCommand> written_commands(const PreviewCommand& command) {
  if (command.commands.empty()) return {};
  return read_commands(command.commands);
}

void serve(PreviewCommand& command) {
  std::signal(SIGPIPE, SIG_IGN);  // whoever stops reading must not end the server
  const std::vector<WrittenCommand> commands = written_commands(command);
  Shown shown = read_inputs(command);
  const PictureDevice device(command.molecule.surface);
  const std::unique_ptr<PreviewSession> session = begin_session(command, device.context() != nullptr, std::move(shown));
  replay_commands(command.commands, commands, *session, std::cout);
  if (session->wants_to_quit()) return;
  serve_session(*session, *command.port,
                [&](const std::string& url, std::uint16_t port) { say_address(command, url, port); });
}

void say_report(const PreviewCommand& command, const WindowReport& report) {
  say(command.molecule, fmt::format("window on {}, GL {}{}", report.context.renderer, report.context.version,
                                    report.context.software ? " (software)" : ""));
  if (report.latency.pictures > 0)
    say(command.molecule,
        fmt::format(
            "from movement to picture: median {:.1f} ms, 95 % within {:.1f} ms, {} pictures; window redrawn {} times",
            report.latency.median_ms, report.latency.p95_ms, report.latency.pictures, report.redraws));
}

/// Whether GL draws for a window. It is that of its display; where that is software the CPU draws faster by itself.
bool draws_on_gl(const SurfaceRequest& surface, const EglContext& context) {
  using Kind = DeviceChoice::Kind;
  if (surface.gl.kind == Kind::gpu && context.is_software())
    throw GpuError(fmt::format("the display draws by software ({}); use --device auto, cpu or software, or --serve",
                               context.renderer()));
  if (surface.gl.kind == Kind::software && !context.is_software())
    throw GpuError(
        fmt::format("the display draws on {}; use --device auto, gpu or cpu, or --serve", context.renderer()));
  return !surface.cpu && (surface.gl.kind != Kind::automatic || !context.is_software());
}

void open_window(PreviewCommand& command) {
  const SurfaceRequest& surface = command.molecule.surface;
  if (surface.gl.index || !surface.gl.name.empty())
    throw UsageError("--device gpu:N is for --serve; a window draws on the device of its display, or on the CPU");
  const std::vector<WrittenCommand> commands = written_commands(command);
  Shown shown = read_inputs(command);
  WindowOptions options;
  options.title = fmt::format("{} - Meniscus", std::filesystem::path(command.molecule.file).filename().string());
  for (const WrittenCommand& written : commands) options.commands.push_back(written.command);
  options.size = {command.picture.width, command.picture.height};
  options.kernel_folder = command.molecule.surface.gl.kernel_folder;
  options.replied = [&](std::size_t index, const nlohmann::json& reply) {
    print_reply(command.commands, commands[index].line, reply, std::cout);
  };
  const auto make = [&](const EglContext& context) {
    return begin_session(command, draws_on_gl(surface, context), std::move(shown));
  };
  say_report(command, run_window(options, make));
}

void run(PreviewCommand& command) { command.port ? serve(command) : open_window(command); }

/// Options that the preview changes while it runs, or that render has not.
constexpr std::string_view kOwnOptions[] = {"--help",
                                            "--scene",
                                            "--camera",
                                            "--projection",
                                            "--view",
                                            "--turn",
                                            "--zoom-to",
                                            "--size",
                                            "--width",
                                            "--height",
                                            "--dpi",
                                            "--probe",
                                            "--show",
                                            "--color",
                                            "--map",
                                            "--map-file",
                                            "--color-range",
                                            "--missing-color",
                                            "--color-by-file",
                                            "--color-column",
                                            "--sticks",
                                            "--balls",
                                            "--spheres",
                                            "--tube",
                                            "--stick-radius",
                                            "--tube-radius",
                                            "--opacity",
                                            "--film-opacity",
                                            "--clip",
                                            "--cap-color",
                                            "--cap-hatching",
                                            "--preset",
                                            "--light",
                                            "--light-strength",
                                            "--ambient",
                                            "--roughness",
                                            "--specular",
                                            "--shininess",
                                            "--ambient-occlusion",
                                            "--ambient-occlusion-radius",
                                            "--silhouettes",
                                            "--outer-lines",
                                            "--inner-lines",
                                            "--part-lines",
                                            "--depth-cue",
                                            "--legend",
                                            "--legend-title",
                                            "--legend-size",
                                            "--legend-place",
                                            "--serve",
                                            "--commands",
                                            "--record",
                                            "--output-dir",
                                            "--force"};

/// As they were said.
void add_words(const CLI::Option& option, std::vector<std::string>& words) {
  if (option.empty()) return;
  const std::string name = option.get_positional() ? "" : option.get_name();
  if (option.get_expected_max() == 0) return words.push_back(name);
  for (const std::string& value : option.results()) {
    if (name.empty() || value.starts_with('-')) {
      words.push_back(name.empty() ? value : name + "=" + value);
      continue;
    }
    words.push_back(name);
    words.push_back(value);
  }
}

RenderInput render_input(const CLI::App& command) {
  RenderInput input;
  for (const CLI::Option* option : command.get_options()) {
    const std::string name = option->get_positional() ? "" : option->get_name();
    if (name == "--color-by-file" || name == "--color-column") add_words(*option, input.number_words);
    if (name == "--map-file") add_words(*option, input.map_words);
    if (std::ranges::find(kOwnOptions, name) == std::end(kOwnOptions)) add_words(*option, input.words);
  }
  return input;
}

void add_session_options(CLI::App& command, PreviewCommand& state) {
  command
      .add_option_function<std::string>(
          "--serve", [&state](const std::string& text) { state.port = parse_port(text); },
          "No window: serve a page for browsers on 127.0.0.1, at this port or at any free one")
      ->expected(0, 1)
      ->type_name("[PORT]");
  const Heading heading(command, "Session");
  command.add_option("--commands", state.commands, "Carry out these commands first, one JSON object a line")
      ->type_name("FILE");
  command.add_option("--record", state.record, "Write every command to this file, for --commands")->type_name("FILE");
  command.add_option("--output-dir", state.output_folder, "Folder of exports [.]")->type_name("FOLDER");
  command.add_flag("--force", state.force, "Let --record replace a file");
}

}  // namespace

void add_preview(CLI::App& command) {
  describe(command, "Look at the surface while it changes, in a window or in a browser",
           "  meniscus preview 1tii.pdb                           a window; h shows its keys\n"
           "  meniscus preview 1tii.pdb --serve                   prints an address to open in a browser\n"
           "  meniscus preview 1tii.pdb --serve 8080 --color chain\n"
           "  meniscus preview 1tii.pdb --color chain --tube polymer --opacity 0.3 --preset publication\n"
           "  meniscus preview 1tii.pdb --record session.jsonl    what is done, for --commands\n"
           "  meniscus preview adk.psf --trajectory adk.dcd --superpose 'name CA'   blank plays it",
           "Each model of FILE is a frame, or each frame of --trajectory. A window needs a display with OpenGL 4.5 "
           "through EGL; without one the\n"
           "exit code is 4. The page is served on 127.0.0.1 only, to whoever has the address with its token; to\n"
           "look from another machine, use the ssh line that is printed. SIGINT and SIGTERM end both.");
  auto state = std::make_shared<PreviewCommand>();
  state->molecule.reading.model.all = true;
  add_atom_options(command, state->molecule);
  command.get_option("--model")->description("Model to show; default: all of them, each a frame");
  {
    const Heading heading(command, "Surface");
    add_probe_option(command, state->molecule.surface);
    add_device_option(command, state->molecule.surface);
  }
  add_color_options(command, state->molecule);
  add_figure_options(command, state->molecule, state->figure);
  for (const char* option : {"--object", "--hide-surface"}) command.remove_option(command.get_option(option));
  add_trajectory_argument(command);
  add_frame_options(command, state->frames);
  for (const char* option : {"--only", "--progress"}) command.remove_option(command.get_option(option));
  add_picture_options(command, state->picture);
  add_look_options(command, state->look, state->picture);
  command.remove_option(command.get_option("--linear-alpha"));  // its pictures are opaque
  add_legend_options(command, state->legend, state->picture);
  command.remove_option(command.get_option("--legend-file"));
  add_session_options(command, *state);
  add_scene_options(command);
  command.callback([state, &command] {
    state->input = render_input(command);
    run(*state);
  });
}

}  // namespace meniscus
