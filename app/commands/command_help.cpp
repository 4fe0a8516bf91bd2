// SPDX-License-Identifier: BSD-3-Clause
// `meniscus help TOPIC`: shows topics in short, the help of commands, and the pages of the manual.
#include <algorithm>
#include <iostream>
#include <memory>
#include <vector>

#include <fmt/format.h>
#include <fmt/ostream.h>

#include "app/commands/commands.h"
#include "app/commands/manual_pages.h"
#include "app/options/command_tree.h"
#include "app/options/property_options.h"
#include "app/options/scene_schema.h"
#include "app/process/program_error.h"
#include "app/process/this_program.h"
#include "app/reports/man_page.h"
#include "core/base/output_file.h"
#include "core/base/text.h"
#include "core/base/version.h"
#include "core/structure/selection/selection_words.h"

namespace meniscus {
namespace {

struct Topic {
  std::string_view name;
  std::string_view summary;
  std::string (*page)();
};

constexpr const char* kAssemblies = R"(Examples:
  meniscus surface 1ihm.pdb --assembly list             what the file describes
  meniscus surface 1ihm.pdb --assembly 1                one surface of the whole capsid
  meniscus export povray 4v6x.cif --assembly 2 --instances exact -o 4v6x

A file may describe how its chains are repeated in the biological molecule: REMARK 350 of PDB, _pdbx_struct_assembly
of mmCIF. --assembly builds that molecule from the atoms that --select and the other options leave; they apply to the
chains of the file. Further copies of chain A are called A-2, A-3, as in the assembly files of the wwPDB. --color chain
gives them the colour of A; --color copy gives each its own (not with --instances, whose copies share their colours).

  without --instances  every copy becomes atoms, and all of them have one surface, which is right where copies touch;
                       at most 10,000,000 atoms
  --instances exact    one copy is computed and drawn many times. This is the surface of the whole only if no probe can
                       touch two copies; otherwise it is an error, which names the closest pair of atoms
  --instances separate the same without this check: each copy has a surface as if it were alone

Matrices must be rotations within 0.001; six decimals are rounded to the nearest exact rotation. Mirrored, sheared or
incomplete matrices are errors.
)";

constexpr const char* kExitCodes = R"(  0  done
  1  internal error: please report it
  2  wrong usage
  3  input cannot be read or is not valid: "file:line: what, value, what to do"
  4  no usable GPU or GL, no display for a window, or the driver refused or lost something
  5  a limit of the machine or of a format was reached
  6  an output cannot be written, or exists and --force was not given
  7  the surface is not closed: the atoms are named, nothing is written
  8  all whole frames are done, but the trajectory ends in mid-frame
  9  a worker of a farm was stopped (SIGTERM, SIGUSR1): run it again, and it continues where it stopped

A run of frames continues after a frame that fails. Its exit code is that of the first frame that failed.

Files are written under a temporary name in the same folder and renamed when complete; an incomplete file never has
the final name. When interrupted (Ctrl-C, SIGTERM), the program removes unfinished files and ends with 128 + the signal.
)";

constexpr const char* kFrames = R"(Examples:
  meniscus surface adk.psf adk.dcd --csv-series adk.csv                    one row per frame
  meniscus render adk.psf --trajectory adk.dcd --superpose 'name CA' -o adk.mp4
  meniscus render 1d3z.pdb --frames 0-9 -o model_##.png                    the models of a file are its frames
  meniscus render 1tii.pdb --repeat 120 --turntable 1 -o turn.mp4          once around a molecule at rest
  meniscus export povray adk.psf --trajectory adk.xtc --frames 0-999:10 -o adk
  meniscus preview adk.psf --trajectory adk.xtc --whole --center protein

FILE lists the atoms, --trajectory their positions (meniscus formats lists the formats). Selections that depend on
positions (within, x, y, z, helix, strand, coil) are evaluated in each frame, all others once. With --select-once all
are evaluated in the first frame of the run only.
Several trajectories are read one after the other; they may follow FILE on the command line. If they have only some of
FILE's atoms, --trajectory-atoms selects these, such as 'not water'.

Frames        count from 0, or from the end: -1 or last. --frames takes all, 7, 0-99, 0-99:10 (every tenth), 90- (to the
              last), -10- (the last ten), and several of these separated by commas. --begin and --end (a frame, or a
              time such as 2.5ns) and --stride N apply after that. --repeat N shows each of these frames N times.
              --only LIST makes a part of the run; camera, colours and scene stay those of the whole run.
Preparation   is done in this order: --whole joins molecules that the periodic box cuts, along the bonds of FILE and of
              standard residues (guess: by distance), and gathers them around the largest; --superpose EXPR fits atoms
              to their positions in the --reference frame (0), --center EXPR only moves; --smooth N averages over N
              frames. A prepared frame depends on its number alone, so parts of a run fit together.
Camera        By default it does not move and shows all atoms of all frames. --camera FILE sets another one,
              --camera-path FILE has key frames {"keys":[{"frame":0,"camera":{...}},...]} (cameras as --save-camera
              writes them), --turntable TURNS turns it, --follow EXPR moves it with atoms.
Files         have the number of the frame in the trajectory; with --repeat N those of frame F have F*N, F*N + 1, ...
              Pictures: -o frame_#####.png; a film: -o film.mp4 (needs ffmpeg), --fps.
Failures      A frame that fails is reported, and the run continues. The exit code is that of the first frame that
              failed. A trajectory that ends in mid-frame gives all its complete frames, and then exit code 8.
Progress      --progress bar, plain, json (one line per frame on standard error), openjd, none.
)";

std::string frames_page() { return kFrames; }
std::string selection_page() { return selection_help(); }
std::string assembly_page() { return kAssemblies; }
std::string exit_page() { return kExitCodes; }
std::string scenes_page() { return scene_help(); }

constexpr Topic kTopics[] = {
    {"selections", "the language of --select, --show and --context", selection_page},
    {"assemblies", "biological assemblies, and copies drawn as instances", assembly_page},
    {"frames", "trajectories, films, and moving cameras", frames_page},
    {"scenes", "scene files, and the option of each key", scenes_page},
    {"exit-codes", "exit codes, and which files exist after an error", exit_page},
};

/// Folders of the manual, in the order in which people read.
constexpr std::string_view kShelves[] = {"tutorials", "how-to", "reference", "explanation", "validation"};

bool is_on(std::string_view shelf, const ManualPage& page) { return page.path.starts_with(fmt::format("{}/", shelf)); }

void list_topics(const CLI::App& program) {
  fmt::print(std::cout, "meniscus help TOPIC shows a page:\n\n");
  for (const Topic& topic : kTopics) fmt::print(std::cout, "  {:<12} {}\n", topic.name, topic.summary);
  fmt::print(std::cout, "\nThe help of a command:\n\n");
  for (const CLI::App* command : program.get_subcommands({}))
    fmt::print(std::cout, "  {:<12} {}\n", command->get_name(), command->get_description());
  fmt::print(std::cout, "\nPages of the manual:\n");
  for (const std::string_view shelf : kShelves) {
    fmt::print(std::cout, "\n{}\n", shelf);
    for (const ManualPage& page : manual_pages())
      if (is_on(shelf, page)) fmt::print(std::cout, "  {:<18} {}\n", page.name(), page.title());
  }
}

/// Markdown is made to be read as it is; only its long lines are parted, outside of tables and code.
void print_markdown(std::string_view text) {
  bool code = false;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    if (line.starts_with("```")) code = !code;
    const bool item = line.starts_with("* ") || line.starts_with("- ");
    fmt::print(std::cout, "{}\n", code || line.starts_with('|') ? std::string(line) : wrapped(line, 100, item ? 2 : 0));
  }
}

/// The page of the manual that has this name; null if none has.
const ManualPage* manual_page(std::string_view name) {
  for (const std::string_view shelf : kShelves)
    for (const ManualPage& page : manual_pages())
      if (is_on(shelf, page) && page.name() == name) return &page;
  return nullptr;
}

/// Topics, commands and pages of the manual.
std::vector<std::string> page_names(const CLI::App& program) {
  std::vector<std::string> names;
  for (const Topic& topic : kTopics) names.emplace_back(topic.name);
  for (const CLI::App* command : program.get_subcommands({})) names.push_back(command->get_name());
  for (const std::string_view shelf : kShelves)
    for (const ManualPage& page : manual_pages())
      if (is_on(shelf, page)) names.emplace_back(page.name());
  return names;
}

void show(const CLI::App& program, const std::string& name) {
  for (const Topic& topic : kTopics) {
    if (name == topic.name) {
      std::cout << topic.page();
      return;
    }
  }
  for (const CLI::App* command : program.get_subcommands({})) {
    if (command->get_name() == name) {
      std::cout << command->help("meniscus");
      return;
    }
  }
  if (const ManualPage* page = manual_page(name)) return print_markdown(page->markdown);
  const std::vector<std::string> names = page_names(program);
  const std::string_view nearest = nearest_word(name, std::vector<std::string_view>(names.begin(), names.end()));
  throw UsageError(fmt::format("there is no page {}{}; meniscus help lists the pages", in_quotes(name),
                               nearest.empty() ? "" : fmt::format("; did you mean {}?", nearest)));
}

/// A page of section 1 for every command, and of section 7 for every topic.
void write_man_pages(const CLI::App& program, const std::string& folder) {
  const CommandEntry tree = command_tree(program);
  const ManMargins margins{build_date(), std::string("meniscus ") + MENISCUS_VERSION};
  OutputFolder pages(folder, Existing::replace);
  for (const CommandEntry* command : all_commands(tree))
    pages.file(man_page_name(*command) + ".1").write(command_man_page(*command, tree, kExitCodes, margins));
  for (const Topic& topic : kTopics)
    pages.file(man_page_name(topic.name) + ".7")
        .write(topic_man_page(topic.name, topic.summary, topic.page(), margins));
  pages.commit();
}

}  // namespace

void add_help(CLI::App& command) {
  describe(command,
           "  meniscus help\n"
           "  meniscus help selections\n"
           "  meniscus help --man man            a manual page of every command and topic, into the folder man");
  auto topic = std::make_shared<std::string>(), folder = std::make_shared<std::string>();
  auto schema = std::make_shared<bool>(false);
  command.add_option("TOPIC", *topic, "Page to show; without it, the list of pages")
      ->check(proposes(page_names(*command.get_parent())))
      ->type_name("");
  PropertyOptions options(command);
  options.add("help.man", *folder);
  options.add("help.scene_schema", *schema);
  command.callback([topic, folder, schema, &command] {
    const CLI::App& program = *command.get_parent();
    if (*schema) {
      std::cout << scene_schema();
    } else if (!folder->empty()) {
      write_man_pages(program, *folder);
    } else if (topic->empty()) {
      list_topics(program);
    } else {
      show(program, *topic);
    }
  });
}

}  // namespace meniscus
