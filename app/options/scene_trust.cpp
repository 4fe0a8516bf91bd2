// SPDX-License-Identifier: BSD-3-Clause
// Reads scene files, and checks the files that they name.
#include "app/options/scene_trust.h"

#include "app/options/named_files.h"
#include "core/base/error.h"
#include "core/base/text_file.h"
#include "core/image/png_file.h"

namespace meniscus {
namespace {

constexpr std::size_t kLargestScene = std::size_t{16} << 20;

}  // namespace

std::string read_scene_text(const std::string& file) {
  std::string text = png_note(file, kSceneNote).value_or("");
  if (!text.empty()) return text;
  if (is_png(file))
    throw InputError(file, 0,
                     "is a picture that carries no scene; pictures made with --no-provenance, frames of runs and "
                     "pictures of other programs have none");
  return std::string(read_text_file(file, kLargestScene).text);
}

void guard_files(const CLI::App& command, const std::string& file, std::span<const SceneSetting> settings) {
  NamedFiles files(command);
  if (!file.empty()) files.read(file);
  for (const SceneSetting& setting : settings)
    for (const std::string& text : setting.texts) {
      if (setting.property->type == ValueType::new_file)
        files.write(std::string(setting.property->long_option()), text);
      else if (setting.property->type == ValueType::file || setting.property->type == ValueType::camera)
        files.read(text);
    }
  files.check();
}

}  // namespace meniscus
