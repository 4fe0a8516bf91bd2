// SPDX-License-Identifier: BSD-3-Clause
// Looks at the files of a bundle, and makes and removes unfinished ones.
#include "app/farm/bundle_folder.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <map>
#include <memory>
#include <random>
#include <set>
#include <sstream>
#include <system_error>

#include <fmt/format.h>
#include <openssl/evp.h>

#include "core/base/error.h"
#include "core/base/output_file.h"
#include "core/image/png_file.h"

namespace meniscus::farm {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kQuickToCheck = std::uint64_t{256} << 20;  // bytes; a tenth of a second

std::set<fs::path> names_in(const fs::path& folder) {
  std::set<fs::path> names;
  std::error_code none_yet;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder.empty() ? "." : folder, none_yet))
    names.insert(entry.path().filename());
  return names;
}

std::string digest_of(std::istream& bytes) {
  const std::unique_ptr<EVP_MD_CTX, void (*)(EVP_MD_CTX*)> context(EVP_MD_CTX_new(), EVP_MD_CTX_free);
  bool works = context && EVP_DigestInit_ex(context.get(), EVP_sha256(), nullptr) == 1;
  std::string part(std::size_t{1} << 20, '\0');
  while (bytes.read(part.data(), std::ssize(part)) || bytes.gcount() > 0)
    works = works && EVP_DigestUpdate(context.get(), part.data(), static_cast<std::size_t>(bytes.gcount())) == 1;
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned size = 0;
  if (!works || EVP_DigestFinal_ex(context.get(), digest.data(), &size) != 1)
    throw Error("OpenSSL cannot compute SHA-256");
  std::string text;
  for (unsigned n = 0; n < size; ++n) text += fmt::format("{:02x}", digest[n]);
  return text;
}

std::string hidden_name(std::string_view name) {
  std::random_device random;
  return fmt::format(".{}.{:08x}{:08x}.part", name, random(), random());
}

bool is_whole_scene(const fs::path& folder, const std::string& list) {
  std::ifstream lines(list);
  std::uintmax_t bytes = 0;
  std::error_code none;
  for (std::string file; lines >> bytes >> file;)
    if (fs::file_size(folder / file, none) != bytes) return false;
  return true;
}

}  // namespace

HiddenFolder::HiddenFolder(const fs::path& parent, std::string_view name) : path_(parent / hidden_name(name)) {
  const StopBarrier barrier;
  std::error_code error;
  fs::create_directory(path_, error);
  if (error) throw OutputError(parent.string(), fmt::format("no folder can be made in it: {}", error.message()));
}

void write_file(const fs::path& path, std::string_view bytes) {
  const StopBarrier barrier;
  make_folders_of(path);
  OutputFile file(path, Existing::replace);
  file.write(bytes);
  file.commit();
}

std::string sha256(std::string_view bytes) {
  std::istringstream stream{std::string(bytes)};
  return digest_of(stream);
}

std::string sha256_of_file(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::string digest = digest_of(file);
  if (!file.eof()) throw InputError(path.string(), 0, "cannot be read");
  return digest;
}

std::vector<std::size_t> missing_files(const std::vector<std::string>& paths) {
  std::map<fs::path, std::set<fs::path>> folders;
  std::vector<std::size_t> missing;
  for (std::size_t n = 0; n < paths.size(); ++n) {
    const fs::path path = paths[n];
    const auto [folder, is_new] = folders.try_emplace(path.parent_path());
    if (is_new) folder->second = names_in(path.parent_path());
    if (!folder->second.contains(path.filename()) || (path.extension() == ".png" && !ends_as_png(path)))
      missing.push_back(n);
  }
  return missing;
}

std::vector<std::uint64_t> missing_frames(const Bundle& bundle, const fs::path& folder, Step step,
                                          const std::vector<std::uint64_t>& frames) {
  std::vector<std::string> paths;
  for (const std::uint64_t frame : frames) paths.push_back((folder / bundle.result(step, frame)).string());
  const std::vector<std::size_t> places = missing_files(paths);
  std::vector<std::uint64_t> missing;
  for (std::size_t n = 0; n < frames.size(); ++n)
    if (std::ranges::binary_search(places, n) || (step == Step::surface && !is_whole_scene(folder, paths[n])))
      missing.push_back(frames[n]);
  return missing;
}

void check_inputs(const Bundle& bundle, const fs::path& folder, bool thorough) {
  for (const Input& input : bundle.inputs) {
    const fs::path path = folder / input.path;  // `folder` does not count if the input's path is absolute
    std::error_code missing;
    const std::uintmax_t bytes = fs::file_size(path, missing);
    const bool quick = !thorough && bytes > kQuickToCheck;
    if (missing || bytes != input.bytes || (!quick && sha256_of_file(path) != input.sha256))
      throw InputError(
          path.string(), 0,
          "is missing, or not what was bundled (size or SHA-256); bring it there, or make the bundle again");
  }
}

void remove_leftovers(const fs::path& folder) {
  std::error_code error;
  std::vector<fs::path> found;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder, error)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with('.') && name.find(".part") != std::string::npos) found.push_back(entry.path());
  }
  for (const fs::path& path : found) fs::remove_all(path, error);
}

}  // namespace meniscus::farm
