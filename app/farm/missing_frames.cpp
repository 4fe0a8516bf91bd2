// SPDX-License-Identifier: BSD-3-Clause
// Lists folders, and reads the ends and the notes of pictures.
#include "app/farm/missing_frames.h"

#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <string_view>
#include <system_error>

#include <fmt/format.h>

#include "app/farm/checksum.h"
#include "app/process/program_error.h"
#include "core/base/text.h"
#include "core/base/version.h"
#include "core/image/png_file.h"
#include "core/scene/scene_json.h"
#include "core/scene/scene_values.h"

namespace meniscus::farm {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kPngEnd{"\0\0\0\0IEND\xae\x42\x60\x82", 12};  // its last chunk

bool has_its_end(const fs::path& path) {
  if (path.extension() != ".png") return true;
  std::string end(kPngEnd.size(), '\0');
  std::ifstream file(path, std::ios::binary);
  file.seekg(-static_cast<std::streamoff>(end.size()), std::ios::end);
  return file.read(end.data(), static_cast<std::streamsize>(end.size())) && end == kPngEnd;
}

std::set<fs::path> names_in(const fs::path& folder) {
  std::set<fs::path> names;
  std::error_code none_yet;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder.empty() ? "." : folder, none_yet))
    names.insert(entry.path().filename());
  return names;
}

}  // namespace

std::vector<std::size_t> missing_files(const std::vector<std::string>& paths) {
  std::map<fs::path, std::set<fs::path>> folders;
  std::vector<std::size_t> missing;
  for (std::size_t n = 0; n < paths.size(); ++n) {
    const fs::path path = paths[n];
    auto folder = folders.find(path.parent_path());
    if (folder == folders.end()) folder = folders.emplace(path.parent_path(), names_in(path.parent_path())).first;
    if (!folder->second.contains(path.filename()) || !has_its_end(path)) missing.push_back(n);
  }
  return missing;
}

std::string made_of(const Scene& scene) {
  std::string text = fmt::format("{}\n{}\n", MENISCUS_VERSION, scene_text(scene, ""));
  for (const Property* property : properties()) {
    const bool is_file = property->type == ValueType::file || property->type == ValueType::camera;
    if (!is_file || !is_scene_value(*property)) continue;
    for (const std::string& path : value_texts(scene, *property)) {
      std::error_code error;
      const std::uintmax_t size = fs::file_size(path, error);
      if (error) continue;  // a camera's JSON is no path
      const auto time = fs::last_write_time(path, error).time_since_epoch().count();
      text += fmt::format("{} {} {}\n", property->key, size, time);
    }
  }
  return sha256(text);
}

std::vector<std::size_t> missing_pictures(const std::vector<std::string>& paths, const std::string& made_of,
                                          Existing existing) {
  for (const std::string& path : paths)
    if (fs::path(path).extension() != ".png")
      throw UsageError("--resume: only .png pictures say of what they were made; name such, as in frame_#####.png");
  const std::vector<std::size_t> not_there = missing_files(paths);
  const std::set<std::size_t> absent(not_there.begin(), not_there.end());
  std::vector<std::size_t> missing, others;
  for (std::size_t n = 0; n < paths.size(); ++n) {
    const bool is_absent = absent.contains(n);  // or cut short
    const bool is_other = is_absent ? fs::exists(paths[n]) : png_note(paths[n], kMadeOfNote) != made_of;
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

}  // namespace meniscus::farm
