// SPDX-License-Identifier: BSD-3-Clause
// Reads pictures, and hands them to the encoder in the order of the run.
#include "app/farm/verify.h"

#include <algorithm>
#include <cstddef>
#include <stdexcept>

#include <fmt/format.h>

#include "app/farm/bundle_folder.h"
#include "app/film/film.h"
#include "core/image/image_codec.h"

namespace meniscus::farm {
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
