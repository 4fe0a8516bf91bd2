// SPDX-License-Identifier: BSD-3-Clause
// Names the channels of EXR files, and gathers their values from pictures.
#include "core/render/exr_channels.h"

#include <algorithm>
#include <array>
#include <initializer_list>
#include <utility>

#include <glm/mat3x3.hpp>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "core/base/constants.h"
#include "core/image/image_codec.h"

namespace meniscus {
namespace {

float index_value(std::uint32_t index) { return index == kNone ? -1.0f : static_cast<float>(index); }

float* put(std::initializer_list<float> values, float* to) { return std::ranges::copy(values, to).out; }

float* put(const glm::vec3& v, float* to) { return put({v.x, v.y, v.z}, to); }

/// GLM's columns of a matrix are the rows of its transpose, which OpenEXR has.
std::array<float, 16> in_rows(const glm::dmat4& matrix) {
  std::array<float, 16> numbers{};
  for (int n = 0; n < 16; ++n) numbers[static_cast<std::size_t>(n)] = static_cast<float>(matrix[n / 4][n % 4]);
  return numbers;
}

}  // namespace

ExrChannels::ExrChannels(const PictureLayers& layers, const std::optional<glm::vec3>& background, ExrContent content)
    : layers_(layers), background_(background), content_(std::move(content)), names_{"R", "G", "B", "A"} {
  const auto add = [&](std::initializer_list<const char*> names) {
    names_.insert(names_.end(), names.begin(), names.end());
  };
  if (layers_.aovs) add({"Z", "N.x", "N.y", "N.z", "P.x", "P.y", "P.z", "atom", "kind", "component"});
  if (has_view()) add({"Nview.x", "Nview.y", "Nview.z", "Pview.x", "Pview.y", "Pview.z"});
  if (layers_.aovs && layers_.motion) add({"forward.u", "forward.v", "forward.a"});
  if (layers_.rays == 0 || !content_.mattes) return;
  for (const Matte& matte : *content_.mattes)
    for (std::string& name : matte_channels(matte)) names_.push_back(std::move(name));
}

std::vector<float> ExrChannels::values(const Framebuffer& picture, std::size_t first, std::size_t count) const {
  std::vector<float> values(count * names_.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 1 << 12), [&](const auto& range) {
    for (std::size_t n = range.begin(); n < range.end(); ++n) {
      const std::size_t pixel = first + n;
      float* to = &values[n * names_.size()];
      const glm::vec4 color = over(picture.color[pixel], background_);
      to = put(from_rec709(glm::vec3(color), content_.primaries), to);
      *to++ = color.w;
      if (layers_.aovs) to = write_aovs(picture, pixel, to);
      if (layers_.rays > 0 && content_.mattes) to = write_mattes_of(picture, pixel, to);
    }
  });
  return values;
}

float* ExrChannels::write_aovs(const Framebuffer& picture, std::size_t pixel, float* to) const {
  *to++ = picture.z[pixel];
  to = put(picture.normal[pixel], to);
  to = put(picture.position[pixel], to);
  to = put({index_value(picture.atom[pixel]), index_value(picture.kind[pixel]), index_value(picture.component[pixel])},
           to);
  const bool is_hit = picture.kind[pixel] != kNone;
  if (has_view()) {
    const glm::dmat4& view = content_.view->to_camera;
    const glm::vec3 towards_viewer(1.0f, 1.0f, -1.0f), none(0.0f);
    to = put(glm::vec3(glm::dmat3(view) * glm::dvec3(picture.normal[pixel])) * towards_viewer, to);
    const glm::vec3 place(view * glm::dvec4(picture.position[pixel], 1.0));
    to = put(is_hit ? place * towards_viewer : none, to);
  }
  if (!layers_.motion) return to;
  // Blender reads no layers of two channels.
  return put({picture.motion[pixel].x, picture.motion[pixel].y, is_hit ? 1.0f : 0.0f}, to);
}

float* ExrChannels::write_mattes_of(const Framebuffer& picture, std::size_t pixel, float* to) const {
  const auto rays = static_cast<std::size_t>(layers_.rays);
  const auto seen = std::span(picture.seen).subspan(pixel * rays, rays);
  // Most pixels show nothing.
  const bool is_empty = std::ranges::all_of(seen, [](std::uint32_t thing) { return thing == kNone; });
  if (is_empty) return to + content_.mattes->size() * kMatteChannels;
  std::vector<std::uint32_t> ids(rays);
  for (const Matte& matte : *content_.mattes) {
    std::ranges::transform(seen, ids.begin(),
                           [&](std::uint32_t thing) { return thing == kNone ? 0 : matte.id[thing]; });
    write_mattes(ids, to);
    to += kMatteChannels;
  }
  return to;
}

void ExrChannels::describe(ImageToEncode& image) const {
  image.chromaticities = chromaticities(content_.primaries);
  image.header = {{"colorInteropID", content_.primaries == Primaries::ap1 ? "lin_ap1_scene" : "lin_rec709_scene"}};
  if (content_.view)
    image.maps = {{"worldtocamera", in_rows(content_.view->to_camera)},
                  {"worldToNDC", in_rows(content_.view->to_file)}};
  if (layers_.rays == 0 || !content_.mattes) return;
  for (const Matte& matte : *content_.mattes)
    for (auto& line : matte_header(matte)) image.header.push_back(std::move(line));
}

}  // namespace meniscus
