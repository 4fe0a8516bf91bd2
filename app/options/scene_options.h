// SPDX-License-Identifier: BSD-3-Clause
// Reads a scene from a command line and the scene file that it names.
#pragma once

#include "app/options/property_options.h"
#include "core/base/output_file.h"
#include "core/properties/properties.h"
#include "core/scene/scene.h"
#include "core/scene/scene_json.h"

namespace meniscus {

/// The number of warnings about a file. full: a line for every atom; summary: a sentence for every kind.
enum class WarningDetail { full, summary, none };

/// The form in which a run of frames reports its progress.
enum class ProgressStyle {
  automatic,  ///< a bar on a terminal, else plain lines
  bar,
  plain,   ///< a line at every tenth of the run
  json,    ///< a JSON object per line on standard error: start, each frame, end
  openjd,  ///< openjd_progress and openjd_status lines on standard output, as OpenJD 2023-09 defines them
  none
};

/// The messages on standard error.
struct Reporting {
  WarningDetail warnings = WarningDetail::summary;
  bool quiet = false;
  bool verbose = false;
  ProgressStyle progress = ProgressStyle::automatic;
};

/// A scene, and how a command carries it out. It must live as long as the command's CLI::App.
struct SceneCommand {
  Scene scene;
  Reporting reporting;
  std::size_t jobs = 0;                 ///< number of frames that are made at once; 0: as cores and memory allow
  bool force = false;                   ///< true: outputs may replace existing files
  bool any_cost = false;                ///< true: pictures may have more than kMostRays rays
  std::string save_scene, save_camera;  ///< paths; empty: not saved
  /// Files that were added to the molecule, for scenes that are saved. Copies of the command share this list.
  std::shared_ptr<std::vector<AddedFile>> added = std::make_shared<std::vector<AddedFile>>();

  Existing existing() const { return force ? Existing::replace : Existing::refuse; }
};

/// The number of rays above which a picture takes hours and needs --any-cost.
inline constexpr double kMostRays = 1e10;

/// Checks the number of rays before any file is read. Throws UsageError if a picture of this size has more than
/// kMostRays, unless --any-cost is set.
void check_cost(const SceneCommand& command, const Scene& scene, glm::ivec2 size);

/// The choice whether an output must be named on the command line.
enum class OutputName { required, optional };

/// The options of a command's properties, in the order of their table, and --scene. Nothing is read before take().
class SceneOptions {
 public:
  /// The command and `into` must outlive this object.
  SceneOptions(CLI::App& command, TakenProperties taken, SceneCommand& into);

  /// Returns the option of a property that the command has, in order to change its description.
  CLI::Option* option(std::string_view key) const;

  /// Sets the description of -o. If it is optional, a scene file may name the output.
  void describe_output(const std::string& what, OutputName name = OutputName::required);

  /// Suppresses the note that this property is not shown, because the command shows it without having an option for it.
  void show_anyway(std::string_view key) { shown_anyway_ = key; }
  /// Suppresses notes about values that may have an effect later, because the scene changes while it is shown.
  void be_live() { is_live_ = true; }

  /// Makes take() read this scene file as if --scene named it.
  void name_file(const std::string& path) { file_ = path; }

  /// Sets the values of the scene file, then the values of the command line, and completes the scene. named: words of
  /// an earlier command line; the scene may also name files that are among them. Throws UsageError, CLI::ParseError,
  /// SelectionError; InputError for a file that is not a scene or names files that it may not name.
  void take(const std::vector<std::string>& named = {});

  /// Returns true if the command line or the scene file has a value of this property.
  bool is_given(std::string_view key) const { return typed(key) || places_.contains(std::string(key)); }
  /// Returns true if the command line has a value of this property.
  bool typed(std::string_view key) const;
  /// Returns the texts of a property on the command line: all of a repeatable property, one of others, "" of a flag.
  std::vector<std::string> typed_texts(const Property& property) const;
  /// Returns the path of the scene file; empty if there is none.
  const std::string& file() const { return file_; }
  const CLI::App& command() const { return command_; }
  const TakenProperties& taken() const { return taken_; }
  const Scene& scene() const { return into_.scene; }

 private:
  void add_own_option(const Property& property);
  std::vector<SceneSetting> read_scene_file(const std::vector<std::string>& named);
  std::vector<SceneSetting> typed_settings() const;
  void guard_files(std::span<const SceneSetting> settings) const;
  void take_setting(const SceneSetting& setting);
  bool has_option(const Property& property) const;
  std::string left_out_note() const;
  void set(const Property& property, const std::vector<std::string>& texts);
  void check_table() const;
  void check_inputs() const;
  void turn_one_molecule();
  [[noreturn]] void refuse(std::string_view key, const std::string& what) const;

  CLI::App& command_;
  TakenProperties taken_;
  SceneCommand& into_;
  bool takes_output_of_scene_ = false, is_live_ = false;
  std::string_view shown_anyway_;
  std::string file_;
  std::map<std::string, std::string> places_;  ///< place in the scene file by key
  std::vector<std::string> left_out_;
};

/// A command and its options. `State` is a SceneCommand with further members that the command needs.
template <typename State = SceneCommand>
struct DeclaredCommand {
  State state;
  SceneOptions options;

  DeclaredCommand(CLI::App& command, TakenProperties taken) : options(command, std::move(taken), state) {}
  DeclaredCommand(const DeclaredCommand&) = delete;
  DeclaredCommand& operator=(const DeclaredCommand&) = delete;
};

/// The file of --save-scene.
class SceneOutput {
 public:
  /// Throws, before any work is done, OutputError for a bad file, and UsageError for a molecule from standard input.
  explicit SceneOutput(const SceneCommand& command);  ///< the command must outlive this object
  /// Writes the file, after the work is done.
  void commit();

 private:
  const SceneCommand& command_;
  std::optional<OutputFile> file_;
};

/// Returns the text of the scene with paths relative to the folder of its file `path`. added: see scene_text().
std::string scene_text_for(const Scene& scene, const std::string& path, std::span<const AddedFile> added = {});

/// Returns the JSON of a scene file, of a picture, or of a scene of a storyboard ("story.json#2"). Throws InputError.
std::string read_scene_text(const std::string& file);

/// Returns the user's cache folder for indices of frames and compiled kernels; empty if there is none.
std::string cache_folder();

/// The variable that `meniscus work` sets for programs: the number of their worker on this machine, from 0.
inline constexpr const char* kWorkerVariable = "MENISCUS_WORKER";
/// The variable that controls compiled kernels; "off": they are not kept among other caches of the user.
inline constexpr const char* kKernelVariable = "MENISCUS_KERNEL_CACHE";

}  // namespace meniscus
