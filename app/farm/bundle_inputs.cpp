// SPDX-License-Identifier: BSD-3-Clause
// Names, measures and copies the inputs of a bundle.
#include "app/farm/bundle_inputs.h"

#include <algorithm>
#include <fstream>

#include <fmt/format.h>

#include "app/farm/checksum.h"
#include "app/farm/child_process.h"
#include "app/farm/inner_path.h"
#include "core/base/error.h"
#include "core/base/output_file.h"
#include "core/base/text.h"

namespace meniscus::farm {
namespace {

namespace fs = std::filesystem;

// The end of a name tells its format, so it is kept; a leading dot or dash would hide or mislead.
std::string plain(std::string name) {
  const auto fine = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' || c == '_' ||
           c == '-';
  };
  std::ranges::replace_if(
      name, [&](char c) { return !fine(c); }, '_');
  if (name.starts_with('.') || name.starts_with('-')) name.front() = '_';
  constexpr std::size_t kLongest = 100;
  return name.size() > kLongest ? name.substr(name.size() - kLongest) : name;
}

/// Copies a file by our own writes, which name a full disk.
void copy(const fs::path& source, OutputFile& file) {
  constexpr std::size_t kPiece = std::size_t{1} << 20;
  std::string piece(kPiece, '\0');
  std::ifstream stream(source, std::ios::binary);
  while (stream.read(piece.data(), kPiece) || stream.gcount() > 0)
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
    if (item.source == path) return item.inside;
  items_.push_back({"inputs/" + unique(plain(source.filename().string())), path, {}, true});
  return items_.back().inside;
}

std::string BundleInputs::unique(const std::string& name) {
  std::string result = name;
  for (int n = 2; !names_.insert(result).second; ++n) result = fmt::format("{}_{}", n, name);
  return result;
}

std::string BundleInputs::add_file_as(const std::string& name, const fs::path& source) {
  names_.insert(name);
  items_.push_back({"inputs/" + name, fs::absolute(source), {}});
  return items_.back().inside;
}

std::string BundleInputs::add_text(const std::string& name, std::string text) {
  items_.push_back({"inputs/" + unique(name), {}, std::move(text)});
  return items_.back().inside;
}

std::vector<Input> BundleInputs::measured(InputTransfer how) const {
  std::vector<Input> inputs;
  for (const Item& item : items_) {
    if (item.source.empty()) {
      inputs.push_back({item.inside, item.text.size(), sha256(item.text), {}});
    } else {
      const std::string sum = sha256_of_file(item.source);
      inputs.push_back({item.inside, fs::file_size(item.source), sum, {}});
      if (how != InputTransfer::reference || !item.is_users) continue;
      inputs.back().source = item.source.string();
      if (!is_plain_absolute_path(inputs.back().source))
        throw RequestError(
            fmt::format("--by-reference: {} has other characters than letters, digits, '.', '_' and '-', or a hidden "
                        "folder; leave the option out to copy the file",
                        in_quotes(inputs.back().source)));
    }
  }
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

void BundleInputs::transfer(const fs::path& folder, InputTransfer how) const {
  for (const Item& item : items_) {
    const StopBarrier barrier;
    const fs::path target = folder / item.inside;
    make_folders_of(target);
    if (how == InputTransfer::reference && item.is_users) continue;
    if (how == InputTransfer::link && !item.source.empty()) {
      std::error_code error;
      fs::create_hard_link(item.source, target, error);
      if (!error) continue;
      throw OutputError(target.string(), fmt::format("cannot be a link to {}: {}; leave --link out to copy",
                                                     item.source.string(), error.message()));
    }
    OutputFile file(target, Existing::refuse);
    if (item.source.empty()) {
      file.write(item.text);
    } else {
      copy(item.source, file);
    }
    file.commit();
  }
}

}  // namespace meniscus::farm
