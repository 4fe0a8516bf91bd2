// SPDX-License-Identifier: BSD-3-Clause
// Names, measures and copies the inputs of a bundle.
#include "app/farm/bundle_inputs.h"

#include <algorithm>
#include <fstream>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "app/farm/checksum.h"
#include "app/process/child_process.h"
#include "core/base/error.h"
#include "core/base/output_file.h"

namespace meniscus::farm {
namespace {

namespace fs = std::filesystem;

// The end of a name tells its format, so it is kept; a leading dot or dash would hide or mislead.
std::string plain(std::string name) {
  constexpr std::string_view kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789._-";
  constexpr std::size_t kLongest = 100;
  std::ranges::replace_if(
      name, [&](char c) { return kPlain.find(c) == std::string_view::npos; }, '_');
  if (name.starts_with('.') || name.starts_with('-')) name.front() = '_';
  return name.size() > kLongest ? name.substr(name.size() - kLongest) : name;
}

/// Copies a file by our own writes, which name a full disk.
void copy(const fs::path& source, OutputFile& file) {
  std::string piece(std::size_t{1} << 20, '\0');
  std::ifstream stream(source, std::ios::binary);
  while (stream.read(piece.data(), std::ssize(piece)) || stream.gcount() > 0)
    file.write(std::string_view(piece.data(), static_cast<std::size_t>(stream.gcount())));
  if (!stream.eof()) throw InputError(source.string(), 0, "cannot be read");
}

}  // namespace

std::string BundleInputs::add_file(const fs::path& source) {
  std::error_code error;
  const fs::path path = fs::canonical(source, error);
  if (error) throw InputError(source.string(), 0, fmt::format("cannot be bundled: {}", error.message()));
  if (!fs::is_regular_file(path)) throw InputError(source.string(), 0, "is not a regular file and cannot be bundled");
  for (const Item& item : items_)
    if (item.source == path) return item.path;
  const std::string inside = by_reference_ ? path.string() : "inputs/" + unique(plain(source.filename().string()));
  items_.push_back({inside, path, {}, true});
  return inside;
}

std::string BundleInputs::unique(const std::string& name) {
  std::string result = name;
  for (int n = 2; !names_.insert(result).second; ++n) result = fmt::format("{}_{}", n, name);
  return result;
}

void BundleInputs::add_own_file(const std::string& name, const fs::path& source) {
  items_.push_back({"inputs/" + name, fs::absolute(source), {}});
}

std::string BundleInputs::add_text(const std::string& name, std::string text) {
  items_.push_back({"inputs/" + unique(name), {}, std::move(text)});
  return items_.back().path;
}

std::vector<Input> BundleInputs::measured() const {
  std::vector<Input> inputs;
  for (const Item& item : items_)
    inputs.push_back(item.source.empty() ? Input{item.path, item.text.size(), sha256(item.text)}
                                         : Input{item.path, fs::file_size(item.source), sha256_of_file(item.source)});
  return inputs;
}

void BundleInputs::refuse_within(const fs::path& folder) const {
  std::error_code failed;
  const fs::path place = fs::weakly_canonical(folder, failed);
  for (const Item& item : items_) {
    const fs::path inside = item.source.lexically_relative(place);
    if (item.is_users && !inside.empty() && *inside.begin() != "..")
      throw OutputError(folder.string(),
                        fmt::format("holds {}, which this command reads; choose another folder", inside.string()));
  }
}

void BundleInputs::copy_to(const fs::path& folder) const {
  for (const Item& item : items_) {
    if (by_reference_ && item.is_users) continue;
    const StopBarrier barrier;
    make_folders_of(folder / item.path);
    OutputFile file(folder / item.path, Existing::refuse);
    if (item.source.empty())
      file.write(item.text);
    else
      copy(item.source, file);
    file.commit();
  }
}

}  // namespace meniscus::farm
