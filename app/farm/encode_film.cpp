// SPDX-License-Identifier: BSD-3-Clause
// Hands the pictures of a bundle to the encoder, in the order of the run.
#include <algorithm>
#include <stdexcept>
#include <string>

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

/// 8-bit sRGB; what is transparent shows white, as in the films of `render`.
std::vector<std::uint8_t> picture_rgb(const fs::path& folder, const std::string& inner) {
  const fs::path path = folder / inner;
  if (inner_entry(folder, inner) != Entry::file || !is_png(path)) throw InputError(path.string(), 0, "is no PNG file");
  const DecodedImage picture = decoded(path);
  const auto channels = static_cast<std::size_t>(picture.channels);
  std::vector<std::uint8_t> rgb;
  rgb.reserve(3 * picture.values.size() / channels);
  for (std::size_t at = 0; at < picture.values.size(); at += channels) {
    const float ground = channels == 2 || channels == 4 ? 1.0f - picture.values[at + channels - 1] : 0.0f;
    for (std::size_t c = 0; c < 3; ++c) {
      const float value = picture.values[at + (channels < 3 ? 0 : c)] + ground;
      rgb.push_back(static_cast<std::uint8_t>(std::clamp(value, 0.0f, 1.0f) * 255.0f + 0.5f));
    }
  }
  return rgb;
}

}  // namespace

void encode_film(const Bundle& bundle, const fs::path& folder) {
  FilmWriter film((folder / bundle.film->file).string(), Existing::replace, {bundle.width, bundle.height},
                  bundle.film->frames_per_second);
  for (const std::uint64_t frame : bundle.frames)
    film.add(picture_rgb(folder, fmt::format("images/frame_{}.png", frame_digits(frame))));
  film.finish();
}

}  // namespace meniscus::farm
