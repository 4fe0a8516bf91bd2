// SPDX-License-Identifier: BSD-3-Clause
// Looks at the files of a bundle, removes unfinished ones, and hands the pictures to the encoder of the film.
#include "app/farm/bundle_folder.h"

#include <fstream>
#include <random>
#include <set>
#include <sstream>

#include <fmt/format.h>
#include <openssl/evp.h>

#include "app/film/film.h"
#include "core/base/error.h"
#include "core/base/output_file.h"
#include "core/image/image_codec.h"
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

namespace {

namespace fs = std::filesystem;

DecodedImage decoded(const Bundle& bundle, const fs::path& folder, std::uint64_t frame) {
  return image_codec().decode((folder / bundle.result(Step::render, frame)).string());
}

bool is_blank(const DecodedImage& picture) {
  // Every value equals the one a pixel before.
  const auto one = static_cast<std::ptrdiff_t>(picture.channels);
  return std::equal(picture.values.begin() + one, picture.values.end(), picture.values.begin());
}

std::string picture_fault(const Bundle& bundle, const fs::path& folder, std::uint64_t frame) {
  const std::string path = (folder / bundle.result(Step::render, frame)).string();
  try {
    const DecodedImage picture = decoded(bundle, folder, frame);
    if (picture.width != bundle.width || picture.height != bundle.height)
      return fmt::format("{}: is {}x{} pixels, not {}x{}", path, picture.width, picture.height, bundle.width,
                         bundle.height);
    return is_blank(picture) ? path + ": is blank: all its pixels are equal" : "";
  } catch (const std::runtime_error& error) {
    return fmt::format("{}: cannot be read as a picture: {}", path, error.what());
  }
}

/// Returns sRGB as the film takes it, on white where the film keeps no alpha.
std::vector<std::uint8_t> film_pixels(const DecodedImage& picture, const FilmPixels& pixels) {
  const auto channels = static_cast<std::size_t>(picture.channels);
  const bool keeps_alpha = pixels.channels == 4;
  std::vector<std::uint8_t> bytes;
  bytes.reserve(picture.values.size() / channels * pixels.channels * pixels.bytes);
  const auto append = [&](float value) {
    const float most = pixels.bytes == 2 ? 65535.0f : 255.0f;
    const auto word = static_cast<std::uint16_t>(std::clamp(value, 0.0f, 1.0f) * most + 0.5f);
    bytes.push_back(static_cast<std::uint8_t>(word & 0xff));
    if (pixels.bytes == 2) bytes.push_back(static_cast<std::uint8_t>(word >> 8));
  };
  for (std::size_t at = 0; at < picture.values.size(); at += channels) {
    const float alpha = channels == 2 || channels == 4 ? picture.values[at + channels - 1] : 1.0f;
    const auto color = [&](std::size_t c) { return picture.values[at + (channels < 3 ? 0 : c)]; };  // times alpha
    for (std::size_t c = 0; c < 3; ++c)
      append(keeps_alpha ? (alpha > 0.0f ? color(c) / alpha : 0.0f) : color(c) + (1.0f - alpha));
    if (keeps_alpha) append(alpha);
  }
  return bytes;
}

}  // namespace

FrameFaults faults_of(const Bundle& bundle, const fs::path& folder) {
  const Step last = bundle.steps().back();
  FrameFaults faults;
  for (const std::uint64_t frame : missing_frames(bundle, folder, last, bundle.frames))
    faults[frame] = {"is not made yet", false};
  for (const std::uint64_t frame : bundle.frames) {
    if (last == Step::surface || faults.contains(frame)) continue;
    const std::string fault = picture_fault(bundle, folder, frame);
    if (!fault.empty()) faults[frame] = {fault, true};
  }
  return faults;
}

void encode_film(const Bundle& bundle, const fs::path& folder, const FrameFaults& faults, InPlace in_place) {
  FilmWriter film((folder / bundle.film->file).string(), Existing::replace, {bundle.width, bundle.height},
                  bundle.film->format.frames_per_second, bundle.film->format);
  std::vector<std::uint8_t> shown;
  std::size_t waiting = 0;  // frames before the first good one
  for (const std::uint64_t frame : bundle.frames) {
    const bool is_bad = faults.contains(frame);
    if (is_bad && in_place == InPlace::drop) continue;
    if (!is_bad) shown = film_pixels(decoded(bundle, folder, frame), film.pixels());
    ++waiting;
    for (; waiting > 0 && !shown.empty(); --waiting) film.add(shown);
  }
  film.finish();
}

}  // namespace meniscus::farm
