// SPDX-License-Identifier: BSD-3-Clause
// The engines that work on a bundle, and the job files for them. Each engine runs `meniscus work` and no more.
#pragma once

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
  std::vector<const char*> files;  ///< in the bundle, by their names among the templates
  const char* needs_farm_path;     ///< nullptr, or why
  const char* start;               ///< for people: how to start it, with @DIR@ for the bundle
};

const std::vector<Engine>& engines();

/// A file of an engine in the bundle.
struct EngineFile {
  std::string path;  ///< relative to the bundle
  std::string text;
  bool is_executable = false;
};

/// Throws RequestError for a path that could mean more than a path to some engine: it has letters, digits and ._-/
/// only.
void require_plain_path(const std::string& farm_path);

/// The files of an engine: its templates with numbers, and with the bundle's path as the farm's machines see it. A line
/// whose number is not known is left out. Throws as require_plain_path does.
std::vector<EngineFile> emit(const Engine& engine, const Bundle& bundle, const std::string& farm_path);

}  // namespace farm
}  // namespace meniscus
