// SPDX-License-Identifier: BSD-3-Clause
// Checks the files of a bundle, removes unfinished ones, and passes the pictures to the encoder of the film.
#include "app/farm/bundle_folder.h"

#include <bit>
#include <fstream>
#include <random>
#include <set>
#include <sstream>

#include <fmt/format.h>

#include "app/film/film.h"
#include "core/base/error.h"
#include "core/base/output_file.h"
#include "core/image/image_codec.h"
#include "core/image/png_file.h"

namespace meniscus::farm {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kQuickToCheck = std::uint64_t{256} << 20;  // bytes, which take about a second

std::set<fs::path> names_in(const fs::path& folder) {
  std::set<fs::path> names;
  std::error_code none_yet;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder.empty() ? "." : folder, none_yet))
    names.insert(entry.path().filename());
  return names;
}

using HashWords = std::array<std::uint32_t, 8>;

/// Adds 64 bytes to a SHA-256 (FIPS 180-4, 6.2.2).
void add_block(HashWords& hash, const char* bytes) {
  static constexpr std::array<std::uint32_t, 64> kConstants = {
      0x428a2f98, 0x71374491, 0xb5c0fbcf, 0xe9b5dba5, 0x3956c25b, 0x59f111f1, 0x923f82a4, 0xab1c5ed5,
      0xd807aa98, 0x12835b01, 0x243185be, 0x550c7dc3, 0x72be5d74, 0x80deb1fe, 0x9bdc06a7, 0xc19bf174,
      0xe49b69c1, 0xefbe4786, 0x0fc19dc6, 0x240ca1cc, 0x2de92c6f, 0x4a7484aa, 0x5cb0a9dc, 0x76f988da,
      0x983e5152, 0xa831c66d, 0xb00327c8, 0xbf597fc7, 0xc6e00bf3, 0xd5a79147, 0x06ca6351, 0x14292967,
      0x27b70a85, 0x2e1b2138, 0x4d2c6dfc, 0x53380d13, 0x650a7354, 0x766a0abb, 0x81c2c92e, 0x92722c85,
      0xa2bfe8a1, 0xa81a664b, 0xc24b8b70, 0xc76c51a3, 0xd192e819, 0xd6990624, 0xf40e3585, 0x106aa070,
      0x19a4c116, 0x1e376c08, 0x2748774c, 0x34b0bcb5, 0x391c0cb3, 0x4ed8aa4a, 0x5b9cca4f, 0x682e6ff3,
      0x748f82ee, 0x78a5636f, 0x84c87814, 0x8cc70208, 0x90befffa, 0xa4506ceb, 0xbef9a3f7, 0xc67178f2};
  std::array<std::uint32_t, 64> words{};
  for (std::size_t n = 0; n < 64; ++n) words[n / 4] = words[n / 4] << 8 | static_cast<unsigned char>(bytes[n]);
  for (std::size_t n = 16; n < 64; ++n) {
    const std::uint32_t early = words[n - 15], late = words[n - 2];
    words[n] = words[n - 16] + (std::rotr(early, 7) ^ std::rotr(early, 18) ^ early >> 3) + words[n - 7] +
               (std::rotr(late, 17) ^ std::rotr(late, 19) ^ late >> 10);
  }
  auto [a, b, c, d, e, f, g, h] = hash;
  for (std::size_t n = 0; n < 64; ++n) {
    const std::uint32_t first =
        h + (std::rotr(e, 6) ^ std::rotr(e, 11) ^ std::rotr(e, 25)) + ((e & f) ^ (~e & g)) + kConstants[n] + words[n];
    const std::uint32_t second =
        (std::rotr(a, 2) ^ std::rotr(a, 13) ^ std::rotr(a, 22)) + ((a & b) ^ (a & c) ^ (b & c));
    h = g, g = f, f = e, e = d + first;
    d = c, c = b, b = a, a = first + second;
  }
  const HashWords step = {a, b, c, d, e, f, g, h};
  for (std::size_t n = 0; n < 8; ++n) hash[n] += step[n];
}

std::string digest_of(std::istream& bytes) {
  HashWords hash = {0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a, 0x510e527f, 0x9b05688c, 0x1f83d9ab, 0x5be0cd19};
  std::array<char, 64> block{};
  std::uint64_t bits = 0;
  for (; bytes.read(block.data(), block.size()); bits += 512) add_block(hash, block.data());
  std::string end(block.data(), static_cast<std::size_t>(bytes.gcount()));
  bits += 8 * end.size();
  end += '\x80';
  end.resize((end.size() + 8 + 63) / 64 * 64);  // zeros fill the block before the 8 bytes of the number of bits
  for (std::size_t n = 1; n <= 8; ++n, bits >>= 8) end[end.size() - n] = static_cast<char>(bits & 0xff);
  for (std::size_t n = 0; n < end.size(); n += 64) add_block(hash, &end[n]);
  std::string text;
  for (const std::uint32_t word : hash) text += fmt::format("{:08x}", word);
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
  if (error) throw OutputError(parent.string(), "no folder can be made in it: {}", error.message());
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
    const fs::path path = folder / input.path;  // an absolute path replaces `folder`
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

DecodedImage decoded(const Bundle& bundle, const fs::path& folder, std::uint64_t frame) {
  return image_codec().decode((folder / bundle.result(Step::render, frame)).string());
}

bool is_blank(const DecodedImage& picture) {
  // Every value equals that of the pixel before.
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

/// Returns sRGB values in the form that the film takes, on white if the film keeps no alpha.
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
    const auto color = [&](std::size_t c) { return picture.values[at + (channels < 3 ? 0 : c)]; };  // premultiplied
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
