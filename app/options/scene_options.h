// SPDX-License-Identifier: BSD-3-Clause
// From a command line, and the scene file that it names, to one scene.
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

#include "app/options/property_options.h"
#include "core/base/output_file.h"
#include "core/properties/properties.h"
#include "core/scene/scene.h"
#include "core/scene/scene_json.h"

namespace meniscus {

/// How much is said about unusual things in a file: a line for every atom, a sentence for every kind, nothing.
enum class WarningDetail { full, summary, none };

/// How a run of frames reports how far it is.
enum class ProgressStyle {
  automatic,  ///< a bar on a terminal, else plain lines
  bar,
  plain,   ///< a line at every tenth
  json,    ///< a JSON object a line on standard error: start, each frame, end
  openjd,  ///< openjd_progress and openjd_status lines on standard output, as OpenJD 2023-09 defines them
  none
};

/// What is said on standard error.
struct Reporting {
  WarningDetail warnings = WarningDetail::summary;
  bool quiet = false;
  ProgressStyle progress = ProgressStyle::automatic;
};

/// What a command makes of a scene, and how. Commands keep one of these alive as long as their CLI::App.
struct SceneCommand {
  Scene scene;
  Reporting reporting;
  std::size_t jobs = 0;                 ///< frames that are made at once; 0: as cores and memory allow
  bool force = false;                   ///< outputs replace what is there
  bool any_cost = false;                ///< pictures may have more rays than kMostRays
  std::string save_scene, save_camera;  ///< paths; empty: it is not saved
  /// Files that were added to the molecule when it was read, for scenes that are saved. Copies of the command share it.
  std::shared_ptr<std::vector<AddedFile>> added = std::make_shared<std::vector<AddedFile>>();

  Existing existing() const { return force ? Existing::replace : Existing::refuse; }
};

/// A picture of more rays takes hours and needs --any-cost.
inline constexpr double kMostRays = 1e10;

/// Before anything is read. Throws UsageError for a picture of this size with more rays, unless any cost is all right.
void check_cost(const SceneCommand& command, const Scene& scene, glm::ivec2 size);

/// Must an output be named?
enum class OutputName { required, optional };

/// Options for the properties that a command has, in the order of their table, and --scene. Nothing is read before
/// take().
class SceneOptions {
 public:
  /// The command and `into` must live as long.
  SceneOptions(CLI::App& command, TakenProperties taken, SceneCommand& into);

  /// The option of a property that the command has, for what it says otherwise than the table.
  CLI::Option* option(std::string_view key) const;

  /// What -o names. Where it is optional, a scene file may name it.
  void describe_output(const std::string& what, OutputName name = OutputName::required);

  /// Says nothing of this property where a scene has it: the command shows it without an option.
  void show_anyway(std::string_view key) { shown_anyway_ = key; }
  /// Says nothing of values that may have an effect later, because the scene changes while it is shown.
  void be_live() { is_live_ = true; }

  /// Has a scene file read as if --scene named it.
  void name_file(const std::string& path) { file_ = path; }

  /// Sets the values of the scene: those of the scene file, then those of the command line; and completes it. named:
  /// words of an earlier command line, whose files the scene may name, too. Throws UsageError, CLI::ParseError,
  /// SelectionError; InputError for a file that is not a scene or names files that it may not.
  void take(const std::vector<std::string>& named = {});

  /// Whether the command line or the scene file has a value of this property.
  bool is_given(std::string_view key) const { return typed(key) || places_.contains(std::string(key)); }
  /// Whether the command line has.
  bool typed(std::string_view key) const;
  /// What the command line says of it: one text, of repeatable ones all, of a flag an empty one.
  std::vector<std::string> typed_texts(const Property& property) const;
  /// The path of the scene file; empty: there is none.
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
  std::string told_left_out() const;
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
  std::map<std::string, std::string> places_;  ///< in the scene file, by key
  std::vector<std::string> left_out_;
};

/// A command and its options; `State` is a SceneCommand with what else the command has.
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
  /// Fails before any work is done if it cannot be written: throws OutputError, UsageError for a molecule from standard
  /// input.
  explicit SceneOutput(const SceneCommand& command);  ///< must live as long
  /// Once the work is done.
  void commit();

 private:
  const SceneCommand& command_;
  std::optional<OutputFile> file_;
};

/// The scene with paths as seen from the folder of `path`, where it is to be saved. added: as for scene_text().
std::string scene_text_beside(const Scene& scene, const std::string& path, std::span<const AddedFile> added = {});

/// Returns the JSON of a scene file, or of the picture that carries it. Throws InputError.
std::string read_scene_text(const std::string& file);

/// Where indices of frames and compiled kernels are kept: beside other caches of the user, or nowhere.
std::string cache_folder();

/// What `meniscus work` passes to the programs it starts: their worker's number on this machine, from 0.
inline constexpr const char* kWorkerVariable = "MENISCUS_WORKER";
/// "off": compiled kernels are not kept beside other caches of the user.
inline constexpr const char* kKernelVariable = "MENISCUS_KERNEL_CACHE";

}  // namespace meniscus
