// SPDX-License-Identifier: BSD-3-Clause
// Hands the pictures of a bundle to the encoder, in the order of the run.
#include <algorithm>
#include <stdexcept>
#include <string>
#include <unordered_set>
#include <vector>

#include <fmt/format.h>

#include "app/farm/inner_path.h"
#include "app/farm/png_without_time.h"
#include "app/farm/verify.h"
#include "app/film/film.h"
#include "core/base/error.h"
#include "core/image/image_codec.h"

namespace meniscus::farm {
namespace {

namespace fs = std::filesystem;

DecodedImage decoded(const fs::path& path) {
  try {
    return image_codec().decode(path.string());
  } catch (const Error&) {
    throw;
  } catch (const std::runtime_error& error) {
    throw InputError(path.string(), 0, std::string("cannot be read as a picture: ") + error.what());
  }
}

/// sRGB as the film takes it; what is transparent shows white, as in the films of `render`, where it keeps no alpha.
std::vector<std::uint8_t> film_pixels(const fs::path& folder, const std::string& inner, const FilmPixels& pixels) {
  const fs::path path = folder / inner;
  if (inner_entry(folder, inner) != Entry::file || !is_png(path))
    throw InputError(path.string(), 0, "is not a PNG file");
  const DecodedImage picture = decoded(path);
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

void encode_film(const Bundle& bundle, const fs::path& folder, const FilmNote& without) {
  FilmWriter film((folder / bundle.film->file).string(), Existing::replace, {bundle.width, bundle.height},
                  bundle.film->frames_per_second, bundle.film->format);
  const std::unordered_set<std::uint64_t> missing(without.missing.begin(), without.missing.end());
  std::vector<std::uint8_t> shown;
  std::size_t waiting = 0;  // before the first good frame
  for (const std::uint64_t frame : bundle.frames) {
    if (!missing.contains(frame)) {
      shown = film_pixels(folder, fmt::format("images/frame_{}.png", frame_digits(frame)), film.pixels());
      for (; waiting > 0; --waiting) film.add(shown);
    } else if (without.in_place == InPlace::drop) {
      continue;
    } else if (shown.empty()) {
      ++waiting;
      continue;
    }
    film.add(shown);
  }
  film.finish();
}

}  // namespace meniscus::farm
