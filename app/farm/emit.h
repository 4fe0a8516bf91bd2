// SPDX-License-Identifier: BSD-3-Clause
// The engines that work on a bundle, and the job files for them. Each engine runs `meniscus work` and no more.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "app/farm/bundle.h"
#include "core/base/text.h"

namespace meniscus {

/// The files of app/farm/templates.
std::span<const TemplateFile> farm_templates();

namespace farm {

/// An engine and its templates.
struct Engine {
  const char* name;
  std::vector<const char*> files;  ///< paths in the bundle and among the templates
  const char* start;               ///< how people start it, with @DIR@ for the bundle
  bool needs_farm_path = false;    ///< true if its commands have no working directory
};

const std::vector<Engine>& engines();

/// Throws RequestError for a path with other characters than letters, digits and ._-/, which could mean more than a
/// path to some engine.
void require_plain_path(const std::string& farm_path);

/// Writes an engine's templates into the bundle's folder, with the numbers of the bundle and its path on the farm's
/// machines. A line with an unknown number is left out. Throws as require_plain_path and write_file do.
void write_job_files(const Engine& engine, const Bundle& bundle, const std::string& farm_path,
                     const std::filesystem::path& folder);

}  // namespace farm
}  // namespace meniscus
