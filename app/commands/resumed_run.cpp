// SPDX-License-Identifier: BSD-3-Clause
// Compares the notes of pictures with the run that is to be resumed.
#include "app/commands/resumed_run.h"

#include <set>

#include "app/farm/bundle_folder.h"
#include "app/process/program_main.h"
#include "core/base/text.h"
#include "core/base/version.h"
#include "core/image/png_file.h"
#include "core/scene/scene_json.h"
#include "core/scene/scene_values.h"

namespace meniscus {

std::string made_of(const Scene& scene) {
  std::string text = fmt::format("{}\n{}\n", MENISCUS_VERSION, scene_text(scene, ""));
  for (const Property* property : properties()) {
    const bool is_file = property->type == ValueType::file || property->type == ValueType::camera;
    if (!is_file || !is_scene_value(*property)) continue;
    for (const std::string& path : value_texts(scene, *property)) {
      std::error_code error;
      const std::uintmax_t size = std::filesystem::file_size(path, error);
      if (error) continue;  // a camera's JSON is no path
      const auto time = std::filesystem::last_write_time(path, error).time_since_epoch().count();
      text += fmt::format("{} {} {}\n", property->key, size, time);
    }
  }
  return farm::sha256(text);
}

std::vector<std::size_t> missing_pictures(const std::vector<std::string>& paths, const std::string& made_of,
                                          Existing existing) {
  for (const std::string& path : paths)
    if (std::filesystem::path(path).extension() != ".png")
      throw UsageError("--resume: only .png pictures record how they were made; use names such as frame_#####.png");
  const std::vector<std::size_t> not_there = farm::missing_files(paths);
  const std::set<std::size_t> absent(not_there.begin(), not_there.end());
  std::vector<std::size_t> missing, others;
  for (std::size_t n = 0; n < paths.size(); ++n) {
    const bool is_absent = absent.contains(n);  // or cut short
    const bool is_other = is_absent ? std::filesystem::exists(paths[n]) : png_note(paths[n], kMadeOfNote) != made_of;
    if (is_other) others.push_back(n);
    if (is_other || is_absent) missing.push_back(n);
  }
  if (!others.empty() && existing == Existing::refuse)
    throw UsageError(fmt::format(
        "--resume: {}{} made of another scene, of other files, by another version, without --resume, or cut short; "
        "choose another name, or add --force to replace {}",
        escaped(paths[others.front()]),
        others.size() == 1 ? " was" : fmt::format(" and {} more were", with_thousands(others.size() - 1)),
        others.size() == 1 ? "it" : "them"));
  return missing;
}

}  // namespace meniscus
