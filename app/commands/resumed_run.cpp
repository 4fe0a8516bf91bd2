// SPDX-License-Identifier: BSD-3-Clause
// Compares the notes of the pictures that are there with what would be written.
#include "app/commands/resumed_run.h"

#include <filesystem>
#include <optional>
#include <system_error>

#include <fmt/format.h>

#include "app/farm/checksum.h"
#include "app/process/program_error.h"
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
  std::vector<std::size_t> missing;
  std::optional<std::string> other;
  std::uint64_t others = 0;
  for (std::size_t n = 0; n < paths.size(); ++n) {
    const std::string& path = paths[n];
    if (std::filesystem::path(path).extension() != ".png")
      throw UsageError("--resume: only .png pictures say of what they were made; name such, as in frame_#####.png");
    std::error_code error;
    const bool is_there = std::filesystem::exists(path, error);
    if (is_there && png_note(path, kMadeOfNote) == made_of) continue;
    missing.push_back(n);
    if (!is_there) continue;
    ++others;
    if (!other) other = path;
  }
  if (other && existing == Existing::refuse)
    throw UsageError(fmt::format(
        "--resume: {}{} made of another scene, of other files, by another version, or without --resume; "
        "choose another name, or add --force to replace {}",
        escaped(*other), others == 1 ? " was" : fmt::format(" and {} more were", with_thousands(others - 1)),
        others == 1 ? "it" : "them"));
  return missing;
}

}  // namespace meniscus
