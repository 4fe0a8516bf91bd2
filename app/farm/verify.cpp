// SPDX-License-Identifier: BSD-3-Clause
// Reads pictures, and hands them to the encoder in the order of the run.
#include "app/farm/verify.h"

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <unordered_set>

#include <fmt/format.h>

#include "app/farm/worker.h"
#include "app/film/film.h"
#include "core/base/error.h"
#include "core/image/image_codec.h"
#include "core/image/png_file.h"

namespace meniscus::farm {
namespace {

namespace fs = std::filesystem;

fs::path picture_path(const Bundle& bundle, const fs::path& folder, std::uint64_t frame) {
  return folder / numbered(bundle.result_pattern(Step::render), frame);
}

/// Throws InputError.
DecodedImage decoded(const fs::path& path) {
  if (path.extension() == ".png" && !is_png(path)) throw InputError(path.string(), 0, "is not a PNG file");
  try {
    return image_codec().decode(path.string());
  } catch (const Error&) {
    throw;
  } catch (const std::runtime_error& error) {
    throw InputError(path.string(), 0, std::string("cannot be read as a picture: ") + error.what());
  }
}

// Every value equals the one a pixel before.
bool is_blank(const DecodedImage& picture) {
  const auto one = static_cast<std::ptrdiff_t>(picture.channels);
  return std::equal(picture.values.begin() + one, picture.values.end(), picture.values.begin());
}

std::string picture_fault(const Bundle& bundle, const fs::path& path) {
  try {
    const DecodedImage picture = decoded(path);
    if (picture.width != bundle.width || picture.height != bundle.height)
      return fmt::format("{}: is {}x{} pixels, not {}x{}", path.string(), picture.width, picture.height, bundle.width,
                         bundle.height);
    return is_blank(picture) ? path.string() + ": is blank: all its pixels are equal" : "";
  } catch (const InputError& error) {
    return error.what();
  }
}

/// sRGB as the film takes it; what is transparent shows white where it keeps no alpha.
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

std::vector<FrameFault> faults_of(const Bundle& bundle, const fs::path& folder) {
  const Step last = bundle.steps().back();
  const std::vector<std::uint64_t> list = missing_frames(bundle, folder, last, bundle.frames);
  const std::unordered_set<std::uint64_t> missing(list.begin(), list.end());
  std::vector<FrameFault> faults;
  for (const std::uint64_t frame : bundle.frames) {
    if (missing.contains(frame)) {
      faults.push_back({frame, "is not made yet", false});
    } else if (last == Step::render) {
      const std::string fault = picture_fault(bundle, picture_path(bundle, folder, frame));
      if (!fault.empty()) faults.push_back({frame, fault, true});
    }
  }
  return faults;
}

void encode_film(const Bundle& bundle, const fs::path& folder, const std::vector<FrameFault>& faults,
                 InPlace in_place) {
  FilmWriter film((folder / bundle.film->file).string(), Existing::replace, {bundle.width, bundle.height},
                  bundle.film->frames_per_second, bundle.film->format);
  std::unordered_set<std::uint64_t> bad;
  for (const FrameFault& fault : faults) bad.insert(fault.frame);
  std::vector<std::uint8_t> shown;
  std::size_t waiting = 0;  // before the first good frame
  for (const std::uint64_t frame : bundle.frames) {
    const bool is_bad = bad.contains(frame);
    if (is_bad && in_place == InPlace::drop) continue;
    if (!is_bad) shown = film_pixels(decoded(picture_path(bundle, folder, frame)), film.pixels());
    ++waiting;
    for (; waiting > 0 && !shown.empty(); --waiting) film.add(shown);
  }
  film.finish();
}

}  // namespace meniscus::farm
