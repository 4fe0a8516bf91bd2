// SPDX-License-Identifier: BSD-3-Clause
// Makes the folder of a bundle from a parsed command, with the job files of the engines.
#pragma once

#include "app/farm/bundle.h"
#include "app/options/scene_options.h"
#include "core/base/text.h"
#include "core/render/legend.h"

namespace meniscus {

/// The files of app/farm/templates.
std::span<const TemplateFile> farm_templates();

namespace farm {

/// An engine and its templates.
struct Engine {
  const char* name;
  std::vector<const char*> files;  ///< paths in the bundle and among the templates
  const char* start;               ///< how users start it, with @DIR@ for the bundle
  bool needs_farm_path = false;    ///< true if its commands have no working directory
};

const std::vector<Engine>& engines();

/// Throws RequestError for a path with special characters for some engine: all but letters, digits and ._-/.
void require_plain_path(const std::string& farm_path);

/// Writes an engine's templates into the bundle's folder, with the numbers of the bundle and its path on the farm's
/// machines. A line with an unknown number is left out. Throws the errors of require_plain_path and write_file.
void write_job_files(const Engine& engine, const Bundle& bundle, const std::string& farm_path,
                     const std::filesystem::path& folder);

}  // namespace farm
}  // namespace meniscus

namespace meniscus::farm {

/// The command after `farm bundle ... --`.
struct BundledCommand {
  std::vector<std::string> words;     ///< {"render"}, {"export", "povray"} and others of kind_of()
  SceneCommand command;               ///< the complete scene, among others
  std::vector<std::string> further;   ///< options that scenes do not have: --provenance
  std::vector<std::string> device;    ///< options that choose where it is computed
  std::vector<std::string> renderer;  ///< words after a second --, for POV-Ray or Blender's driver
};

struct BundleOptions {
  std::filesystem::path folder;
  std::vector<Engine> engines;
  std::string farm_path;
  std::optional<Film> film;
  Chunking chunking;
  bool cores_given = false;     ///< false: the cores of a task are --threads after --, if that exists
  bool by_reference = false;    ///< files that the command reads are not copied
  std::filesystem::path addon;  ///< folder of render_mns.py
  bool force = false;
};

/// A bundle that was made, or that existed before.
struct MadeBundle {
  Bundle bundle;
  bool was_there = false;          ///< true if the same bundle existed, so that only engine files were written
  std::optional<Legend> legend;    ///< the legend of --legend-file of a new bundle, which all frames share
  std::vector<std::string> notes;  ///< sentences for people
};

/// Chooses the camera and the chunks, and writes the complete bundle or none. For chunks by time it makes and times one
/// frame. Throws UsageError, InputError, OutputError (if something other than a bundle exists, or another bundle
/// without `force`), and RunError if the trial frame fails.
MadeBundle make_bundle(const BundleOptions& options, const BundledCommand& command);

}  // namespace meniscus::farm
