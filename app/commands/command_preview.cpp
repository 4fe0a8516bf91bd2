// SPDX-License-Identifier: BSD-3-Clause
// `meniscus preview`: shows the surface in a browser while it changes.
#include <cstdlib>
#include <iostream>
#include <iterator>
#include <system_error>

#include "app/commands/command_table.h"
#include "app/commands/preview_command.h"
#include "app/options/scene_options.h"
#include "app/preview/command_json.h"
#include "app/preview/server/clients.h"
#include "app/preview/server/serve.h"
#include "app/preview/session.h"
#include "app/process/child_process.h"
#include "app/process/program_main.h"
#include "app/process/system_process.h"
#include "app/reports/notes.h"
#include "core/base/error.h"
#include "core/base/output_file.h"
#include "core/base/system_file.h"
#include "core/base/text.h"
#include "core/base/text_file.h"
#include "core/queries/copies.h"
#include "core/scene/frame_run.h"
#include "core/scene/molecule.h"
#include "core/scene/renderers.h"
#include "core/scene/run_framing.h"
#include "core/scene/view_aim.h"
#include "core/structure/formats/structure_formats.h"
#include "core/trajectory/formats/trajectory_formats.h"

namespace meniscus {
namespace {

/// Returns the name by which ssh may know this machine.
std::string host_name() {
  const std::string name = escaped(system_process::host());
  return name.empty() ? "HOST" : name;
}

/// A molecule with its trajectory, if there is one, and its first view.
struct Shown {
  Scene scene;  ///< with resolved selections and measured colours
  Structure structure;
  std::optional<TrajectoryPositions> trajectory;
  std::optional<Camera> camera;  ///< nothing: everything is shown
};

Shown read_run(PreviewCommand& command) {
  const MoleculeRequest& requested = command.scene.molecule;
  // Numbers per frame belong to a run, in which models have the atoms of the first one.
  if (command.models && requested.color.uses_file() && color_of(requested).uses_frames()) {
    command.scene.frames.frames = "all";
    command.models = false;
  }
  Scene scene = command.scene;
  if (!scene.frames.is_requested()) {
    // Copies belong to one model: of several models the first is shown.
    if (scene.molecule.division.instances != InstanceMode::none) command.models = false;
    SceneCommand reading = command;
    reading.scene.molecule = command.read_molecule_request();
    return {std::move(scene), read_and_log(reading), {}, {}};
  }
  Scene frozen = scene;
  freeze_selections(frozen);
  const auto frames = std::make_shared<FrameRun>(frozen.molecule, scene.frames);
  scene.figure = frozen.figure;
  scene.picture = frozen.picture;
  log_run(command, *frames);
  if (scene.molecule.division.instances != InstanceMode::none && frames->atoms_change())
    throw UsageError(
        "--instances: copies in the preview have the same atoms in all frames, but --select chooses others in each; "
        "add "
        "--select-once to keep those of the first");
  ColorScheme& color = scene.molecule.color;
  if (color.by == ColorScheme::By::rmsf) {
    if (color.uses_file())
      throw UsageError("the preview cannot combine --color rmsf with --color-by-file; leave one of them out");
    color.file = {.path = frames->structure().file, .numbers = fluctuations(*frames)};
  }
  TrajectoryPositions trajectory{frames->chunk(),
                                 [frames](std::size_t frame) { return frames->positions(frames->chunk()[frame]); }};
  if (frames->atoms_change()) {
    trajectory.structure = [frames](std::size_t frame) { return frames->at(frames->chunk()[frame]); };
    ShownFrames shown(scene.molecule, *frames);
    measure_colors(color, shown);
  }
  return {std::move(scene), frames->structure(), std::move(trajectory), {}};
}

/// Returns the line that is printed while the molecule is read.
std::string reading_line(const std::string& file) {
  if (file == "-") return "Reading standard input";
  std::error_code unknown;
  const auto bytes = std::filesystem::file_size(file, unknown);
  const std::string name = std::filesystem::path(file).filename().string();
  return unknown ? "Reading " + name : fmt::format("Reading {}, {:.1f} MB", name, 1e-6 * static_cast<double>(bytes));
}

Shown read_inputs(PreviewCommand& command, const std::function<void(const std::string&)>& show_status) {
  show_status(reading_line(command.scene.molecule.file));
  const std::optional<Camera> camera = given_camera(command.scene.picture);
  Shown shown = read_run(command);
  shown.camera = camera;
  ColorScheme& color = shown.scene.molecule.color;
  if (color.by == ColorScheme::By::volume)
    throw UsageError("--color-map-file is for render and export mesh; leave it out");
  color = color_of(shown.scene.molecule);
  require_previewed(color);
  show_status(fmt::format("Preparing {} atoms", with_thousands(shown.structure.atoms.size())));
  if (!command.aims) return shown;
  // All drawn atoms count; a scene's picture is framed as `meniscus render` frames it.
  const FigureRequest& figure = shown.scene.figure;
  const bool reads_again = !figure.representations.empty() || !figure.objects.empty() ||
                           (shown.structure.companions != Companions::none && command.scene.molecule.file != "-");
  shown.camera = aimed_camera(shown.scene, camera, reads_again ? ShownReader(command)(figure, 0) : shown.structure);
  return shown;
}

/// Makes the renderer. Copies are drawn as atoms like all others if that gives the same picture and GL has room for
/// them, else by the CPU, which needs memory for one copy only.
std::unique_ptr<PreviewRenderer> make_renderer(const PreviewCommand& command, const Structure& structure, bool on_gl) {
  constexpr std::size_t kMostOnGl = 500'000;  // in atoms
  const std::vector<Instances>& copies = structure.instances;
  if (copies.empty()) return on_gl ? make_gl_preview_renderer() : make_cpu_preview_renderer();
  const bool apart = command.scene.molecule.division.instances == InstanceMode::exact;
  if (on_gl && apart && placed_count(copies) <= kMostOnGl)
    return make_placed_atoms_renderer(copies, make_gl_preview_renderer());
  if (on_gl)
    log_line(command, fmt::format("the CPU draws the copies: {}",
                                  apart ? with_thousands(placed_count(copies)) + " atoms are too many for GL"
                                        : "each has a surface of its own"));
  return make_cpu_copies_renderer(copies);
}

/// A molecule whose files came from a page.
struct HandedOver {
  std::vector<std::string> read;  ///< paths of the molecule and of its trajectory, if it has one
  std::vector<std::string> kept;  ///< paths by which scenes name the files
  ReceivedFiles files{};          ///< the files, which vanish with their session

  /// Copies files that would vanish to the paths by which scenes name them. Returns the paths of the copies.
  std::vector<std::filesystem::path> keep() const {
    std::vector<std::filesystem::path> written;
    for (std::size_t n = 0; n < read.size(); ++n) {
      const std::filesystem::path path = kept[n];
      if (kept[n] == read[n] || std::filesystem::exists(path)) continue;
      const SharedFile copy{path.filename().string(), read_file_bytes(read[n])};
      write_shared_files(path.parent_path(), Existing::refuse, {&copy, 1});
      written.push_back(path);
    }
    return written;
  }
};

/// Begins a session with these options.
std::unique_ptr<PreviewSession> begin_session(DeclaredPreview& declared, bool on_gl, Shown shown,
                                              const std::shared_ptr<const HandedOver>& handed = nullptr) {
  PreviewCommand& command = declared.state;
  SessionContext context;
  context.read_shown = ShownReader(command);
  if (handed) {
    for (Scene* scene : {&command.scene, &shown.scene}) {
      scene->molecule.file = handed->kept[0];
      if (handed->kept.size() > 1) scene->frames.trajectories = {handed->kept[1]};
    }
    context.keep_files = [handed] { return handed->keep(); };
  }
  PreviewState view;
  static_cast<PreviewFigure&>(view) = PreviewFigure(shown.scene);
  view.has_size = command.has_size;
  view.copies_apart = command.scene.molecule.division.instances == InstanceMode::exact;
  view.size = command.scene.picture.size();
  context.writes_scenes = true;
  context.make_device = [request = command.scene.molecule.surface] { return std::make_unique<PictureDevice>(request); };
  context.make_film = make_film;
  context.aim = [](const Scene& scene, const Structure& structure) { return aimed_camera(scene, {}, structure); };
  context.open_scene = SceneOpener(declared);
  std::unique_ptr<PreviewRenderer> renderer = make_renderer(command, shown.structure, on_gl);
  auto session = std::make_unique<PreviewSession>(std::move(renderer), std::move(shown.structure), view, shown.camera,
                                                  command.output_folder, std::move(shown.trajectory), context);
  for (const std::string& sentence : session->ineffective_cuts()) log_line(command, "note: --clip " + sentence);
  if (!command.record.empty()) {
    auto log = std::make_shared<CommandLog>(command.record, command.existing());
    session->record([log](const nlohmann::json& line) { log->write(line); });
  }
  return session;
}

/// Returns the path in a folder for a copy of a file: its own name, unless another file has that name.
std::string kept_path(const std::filesystem::path& file, const std::filesystem::path& folder) {
  const std::string name = file.filename().string();
  std::filesystem::path path = folder / name;
  const auto is_other = [&] {
    return std::filesystem::exists(path) && (!std::filesystem::is_regular_file(path) ||
                                             std::filesystem::file_size(path) != std::filesystem::file_size(file) ||
                                             read_file_bytes(path.string()) != read_file_bytes(file.string()));
  };
  for (int number = 2; is_other(); ++number) path = folder / fmt::format("{}-{}", number, name);
  return path.string();
}

/// Returns true if the ending of this name is that of a trajectory. Throws RequestError if no format has it.
bool is_trajectory(const std::string& name) {
  const std::string plain = name.ends_with(".gz") ? name.substr(0, name.size() - 3) : name;
  const auto formats = trajectory_formats();
  for (const TrajectoryFormat* format : formats.first(formats.size() - 1))
    if (format->metadata.names(plain)) return true;
  if (std::ranges::none_of(readers(), [&](const Reader* reader) { return reader->metadata.names(plain); }))
    throw RequestError("{}: its name says no molecule and no trajectory; {} are read", name, format_names());
  return false;
}

/// Begins the session of another molecule on the same device. It opens as if the program had been started with it.
/// handed: files of the current molecule that came from a page; the files of the new molecule replace them.
std::unique_ptr<PreviewSession> open_files(const PreviewCommand& begun, const ReceivedFiles& files, bool on_gl,
                                           std::shared_ptr<const HandedOver>& handed,
                                           const std::function<void(const std::string&)>& show_status) {
  if (!begun.record.empty())
    throw RequestError("what is done here is recorded for one molecule; open the other one in a preview of its own");
  const std::filesystem::path folder = std::filesystem::absolute(begun.output_folder).lexically_normal();
  HandedOver next{{""}, {""}, files};
  for (const auto& file : files) {
    const bool is_run = is_trajectory(file->path().filename().string());
    next.read.resize(is_run ? 2 : next.read.size());
    next.kept.resize(next.read.size());
    next.read[is_run] = file->path().string();
    next.kept[is_run] = kept_path(file->path(), folder);
  }
  if (files.size() == 2 && (next.read.size() != 2 || next.read[0].empty()))
    throw RequestError("two files are a molecule and its trajectory; open other molecules one after another");
  if (next.read[0].empty()) {  // only a trajectory came: it belongs to the current molecule
    next.read[0] = handed ? handed->read[0] : begun.scene.molecule.file;
    next.kept[0] = handed ? handed->kept[0] : begun.scene.molecule.file;
    if (handed) next.files.insert(next.files.end(), handed->files.begin(), handed->files.end());
  }
  CLI::App app("", "preview");
  DeclaredPreview declared(app, preview_properties());
  add_preview_options(app, declared);
  std::vector<std::string> words{next.read[0]};
  if (next.read.size() > 1) words.insert(words.begin(), {"--trajectory", next.read[1]});
  std::ranges::reverse(words);
  app.parse(words);
  take_preview(declared);
  PreviewCommand& command = declared.state;
  command.reporting = begun.reporting;
  command.output_folder = begun.output_folder;
  command.scene.picture.width = begun.scene.picture.width;
  command.scene.picture.height = begun.scene.picture.height;
  SurfaceRequest& surface = command.scene.molecule.surface;
  surface.cpu = begun.scene.molecule.surface.cpu;
  surface.gl = begun.scene.molecule.surface.gl;
  surface.threads = begun.scene.molecule.surface.threads;
  Shown shown = read_inputs(command, show_status);
  auto kept = std::make_shared<const HandedOver>(std::move(next));
  auto session = begin_session(declared, on_gl, std::move(shown), kept);
  handed = std::move(kept);
  return session;
}

/// Prints the address of the page, and opens the page in a browser unless the user does that.
void show_address(const PreviewCommand& command, const ServedAddress& address) {
  std::cout << address.url << std::endl;
  log_line(command, fmt::format("from another machine: ssh -L {0}:127.0.0.1:{0} {1}", address.port, host_name()));
  const std::string path = address.url.substr(address.url.find('/', std::string_view("http://").size()));
  for (const std::string& host : command.trusted_hosts)
    log_line(command,
             fmt::format("through {}: the proxy's address for port {}, and then {}", host, address.port, path));
  log_line(command, "Ctrl-C ends the preview");
  if (command.port || command.no_open) return;
  // The browser may end after this function, so the callback has a copy of the command.
  open_in_browser(address.once, [reporting = SceneCommand(command)](const std::string& reason) {
    log_line(reporting, fmt::format("no browser was opened: {}; open the address above in one", reason));
  });
}

std::vector<WrittenCommand> written_commands(const PreviewCommand& command) {
  if (command.commands.empty()) return {};
  return read_commands(command.commands);
}

/// Returns the token that the user set; empty: none.
std::string token_of(const PreviewCommand& command) {
  std::string token;
  if (!command.token_file.empty()) {
    if (system_file::is_open_to_others(path_of_text(command.token_file)))
      throw InputError(command.token_file, 0,
                       "others can read or change the token; take their rights to that file, by chmod 600 or icacls");
    std::ifstream stream(command.token_file);
    if (!(stream >> token)) throw InputError(command.token_file, 0, "no token can be read");
  } else if (const char* const given = std::getenv("MENISCUS_TOKEN")) {
    token = given;
  }
  if (token.empty()) return token;
  if (const std::string fault = token_fault(token); !fault.empty())
    throw UsageError("{}: {}", command.token_file.empty() ? "MENISCUS_TOKEN" : command.token_file, fault);
  return token;
}

void require_output_folder(const PreviewCommand& command) {
  if (!std::filesystem::is_directory(command.output_folder))
    throw OutputError(command.output_folder, "--output-dir is not a folder");
}

void serve(DeclaredPreview& declared) {
  PreviewCommand& command = declared.state;
  system_process::outlive_readers();
  require_output_folder(command);
  const std::vector<WrittenCommand> commands = written_commands(command);
  ServeOptions options;
  options.port = command.port.value_or(0);
  options.address = command.address;
  options.trusted_hosts = command.trusted_hosts;
  for (const std::string& host : options.trusted_hosts)
    if (const std::string fault = host_fault(host); !fault.empty())
      throw UsageError("--trust-host {}: {}", in_quotes(host), fault);
  options.token = token_of(command);
  options.ready = [&](const ServedAddress& address) { show_address(command, address); };
  const PictureDevice device(command.scene.molecule.surface);
  const bool on_gl = device.context() != nullptr;
  std::shared_ptr<const HandedOver> handed;
  const auto make = [&](const ReceivedFiles& files, const std::function<void(const std::string&)>& show_status) {
    if (!files.empty()) return open_files(command, files, on_gl, handed, show_status);
    return begin_session(declared, on_gl, read_inputs(command, show_status));
  };
  if (commands.empty()) return serve_session(options, make);
  // Replies come before the address.
  std::unique_ptr<PreviewSession> session = make({}, [](const std::string&) {});
  replay_commands(command.commands, commands, *session, std::cout);
  if (session->wants_to_quit()) return;
  serve_session(options, [&](const ReceivedFiles& files, const auto& show_status) {
    return files.empty() ? std::move(session) : make(files, show_status);
  });
}

}  // namespace

void add_preview(CLI::App& command) {
  describe(command,
           "  meniscus preview 1tii.pdb                           opens a browser; h shows the keys\n"
           "  meniscus preview 1tii.pdb --no-open                 prints the address only\n"
           "  meniscus preview 1tii.pdb --serve 8080 --color chain\n"
           "  meniscus preview 1tii.pdb --color chain --tube polymer --opacity 0.3 --preset publication\n"
           "  meniscus preview --scene fig.json                   the figure of a scene file\n"
           "  meniscus preview 1tii.pdb --record session.jsonl    what you do, for --commands\n"
           "  meniscus preview adk.psf --trajectory adk.dcd --superpose 'name CA'   blank plays it",
           "Each model of FILE is a frame, or each frame of --trajectory. The page is served on 127.0.0.1 only and "
           "opens only\nwith the token in its address. The variable BROWSER can name another browser. Without a "
           "display no browser is\nopened: use the ssh line that is printed, to open the page on another machine. "
           "Ctrl-C ends the preview.");
  auto declared = std::make_shared<DeclaredPreview>(command, preview_properties());
  add_preview_options(command, *declared);
  command.callback([declared] {
    take_preview(*declared);
    serve(*declared);
  });
}

}  // namespace meniscus
